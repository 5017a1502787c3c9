"""A limit: the velocity that just perforates, or the thickness that is just perforated or scabbed, by bisection."""

import json
import pathlib
import statistics
from dataclasses import dataclass

import beside
import distributions
import latin_hypercube
import limit_chart
import probit
import sweep
from bisection import NoLimit, bisect, disorder, narrowest
from kind_file import existing, measure, number, program, read_kind, some_overrides, whole, with_unit
from study_file import BadStudy, overrides
from uncertainty import refusals
from workers import Pool, Worker
from writing import write

KEYS = ("Kind", "Program", "Input", "Fixed", "Key", "Low", "High", "Width", "Criterion", "Samples", "Spread", "Seed")
REQUIRED = ("Program", "Input", "Key", "Low", "High", "Width")
CRITERIA = ("perforation", "scabbing")
WANTED = ["outcome", "ended", "impact_velocity", "final_velocity", "exit_velocity", "exit_velocity_low", "exit_velocity_high", "penetration_depth",
          "back_crater_diameter", "numerical_error_percent", "numerical_error_remark", "points", "cpu_seconds"]
LOW, HIGH = "exit_velocity_low", "exit_velocity_high"
TABLE, RECORD = "limit.csv", "limit.json"
BASE = "as it is"       # name of the layout, and of the model, of the input with Fixed only
SAMPLE = "sample"       # what the table calls the runs of the statistics
FEWEST, MOST = 10, 100000
# A projectile that still moves in its target at the end time, with less than this part of its impact velocity, counts as stopped. The
# program calls a projectile that comes back with as little at rest (rest_part in macro/output/shot.cc). It has 0.25 % of its energy
# left, which moves the limit by half of that.
CREEP = 0.05
# Attribute of a formula's prediction by criterion and last part of the key.
FORMULAS = {("perforation", "Velocity"): "limit", ("perforation", "Height"): "perforation", ("scabbing", "Height"): "scabbing"}


@dataclass
class Limit:
    path: pathlib.Path
    program: str
    input: pathlib.Path
    fixed: dict
    key: str
    unit: str
    low: float
    high: float
    width: float
    criterion: str
    models: dict   # name -> overrides, the cheapest first; without the input as it is
    layouts: dict  # name -> overrides, the input as it is first
    inputs: list   # Uncertain
    samples: int
    spread: float
    seed: int

    results = "limit.csv, limit.json, limit.png, limit.svg"

    @property
    def name(self):
        return self.path.stem

    @property
    def files(self):
        return distributions.files_of(self.inputs)


def read(path):
    """Reads the study. Returns None if its kind is another one. @raises BadStudy"""
    found = read_kind(path, "limit", KEYS, REQUIRED, {"Models": some_overrides, "Layouts": some_overrides,
                                                     "Distributions": distributions.read})
    if found is None:
        return None
    settings, (models, layouts, inputs) = found[0], found[1].values()
    inputs = {name: distributions.beside(one, path.parent) for name, one in inputs.items()}
    (low, unit), (high, _), (width, _) = ends = [settings.get(key, measure) for key in ("Low", "High", "Width")]
    if any(of != unit for _, of in ends):
        raise BadStudy(f"{path}: Study/Low, High and Width: found {', '.join(repr(of) for _, of in ends)}, allowed: one unit")
    if not (0 <= low < high and 0 < width < high - low):
        raise BadStudy(f"{path}: Study/Low, High and Width: found {low:g}, {high:g} and {width:g}, allowed: 0 <= Low < High, and a Width "
                       "below their difference")
    statistical = [key for key in ("Samples", "Spread") if key in settings]
    if bool(inputs) != bool(statistical) or len(statistical) == 1:
        raise BadStudy(f"{path}: found {', '.join([*statistical, *(['Distributions'] if inputs else [])])}, allowed: Study/Samples, "
                       "Study/Spread and a section Distributions, all or none")
    spread = settings.get("Spread", lambda text: in_unit(text, unit)) if inputs else 0.0
    study = Limit(path, settings.get("Program", program), settings.get("Input", lambda text: existing(path.parent / text)),
                  settings.get("Fixed", overrides), settings.get("Key", key_of), unit, low, high, width,
                  settings.get("Criterion", criterion, CRITERIA[0]), models, {BASE: {}} | layouts, list(inputs.values()),
                  settings.get("Samples", lambda text: whole(text, FEWEST, MOST)) if inputs else 0, spread,
                  settings.get("Seed", lambda text: whole(text, 0), "1"))
    refuse(study)
    return study


def key_of(text):
    if "/" not in text or "=" in text:
        raise ValueError(f"found '{text}', allowed: Section/Key")
    return text.strip()


def in_unit(text, unit):
    value, found = measure(text)
    if found != unit or not value > 0:
        raise ValueError(f"found '{text}', allowed: a number above 0 with the unit of Low{', ' + unit if unit else ''}")
    return value


def criterion(text):
    if text not in CRITERIA:
        raise ValueError(f"found '{text}', allowed: {', '.join(CRITERIA)}")
    return text


def refuse(study):
    """@raises BadStudy for settings that contradict each other"""
    path = study.path
    if study.criterion == "scabbing" and study.models:
        raise BadStudy(f"{path}: section Models: found {len(study.models)} with Criterion = scabbing, allowed: none, as craters have no "
                       "numerical band that could decide")
    setters = [("Study/Fixed", study.fixed), *((f"Models/{name}", one) for name, one in study.models.items()),
               *((f"Layouts/{name}", one) for name, one in study.layouts.items()),
               *((f"Distributions/{one.name}", one.keys) for one in study.inputs)]
    for place, keys in setters:
        if study.key in keys:
            raise BadStudy(f"{path}: {place}: found '{study.key}', which is sought, allowed: other keys")
    if study.inputs and study.spread > study.low + 0.5 * (study.high - study.low):
        raise BadStudy(f"{path}: Study/Spread: found {study.spread:g}, allowed: less than the middle of Low and High")


def check(study, build, count):
    """Lets the program check the input at both ends, with every model, layout and end of a distribution. @raises BadStudy,
    ProgramMissing"""
    executable, pool = sweep.program_of(study, build), Pool([Worker(i + 1) for i in range(count)])
    places = [(f"{study.path}: {study.key} = {with_unit(x, study.unit)}", at(study, x)) for x in (study.low, study.high)]
    for section, some in (("Models", study.models), ("Layouts", study.layouts)):
        places += [(f"{study.path}: {section}/{name}", changes | at(study, study.high)) for name, changes in some.items()]
    places += [(f"{study.path}:{one.line}: {one.name}", end | at(study, study.high)) for one in study.inputs for end in one.ends()]
    for (place, _), refused in zip(places, refusals(study, executable, pool, [changes for _, changes in places])):
        if refused:
            raise BadStudy(f"{place}: {refused}")


def at(study, x):
    return {study.key: with_unit(x, study.unit)}


def passes(study, found):
    """Returns whether a run perforates (or scabs), None if it has no answer. One that creeps at the end time has not perforated."""
    if "failure" in found or found["outcome"] not in ("perforated", "stopped", "rebounded") and not creeps(found):
        return None
    if found["outcome"] == "perforated":
        return True
    if study.criterion == "perforation":
        return False
    diameter = number(found["back_crater_diameter"])
    return None if diameter is None else diameter > 0


def creeps(found):
    """Returns whether a projectile is as good as at rest in its target when the run ends."""
    speed, impact = number(found["final_velocity"]), number(found["impact_velocity"])
    return found["outcome"] == "moving" and None not in (speed, impact) and 0 <= speed < CREEP * impact


def may_pass(study, found):
    """Returns whether a run may perforate within its numerical error, None if that is not known."""
    return bound(study, found, HIGH)


def must_pass(study, found):
    """Returns whether a run perforates whatever its numerical error, None if that is not known."""
    return bound(study, found, LOW)


def bound(study, found, key):
    if passes(study, found) is None or study.criterion != "perforation":
        return None
    if creeps(found):  # at the limit: the error decides, where it is known
        return None if number(found["numerical_error_percent"]) is None else key == HIGH
    value = number(found[key])
    return None if value is None else value > 0


class Search:
    """The search on one layout, one run after the other."""

    def __init__(self, study, runs, worker, layout):
        self.study, self.runs, self.worker, self.layout = study, runs, worker, layout
        self.found = {}  # (model, x) -> what the run gave

    def run(self, model, x):
        """Returns what a run gives; a repeated one is taken from before."""
        if (model, x) not in self.found:
            case = self.study.models.get(model, {}) | self.study.layouts[self.layout] | at(self.study, x)
            self.found[model, x], kept = self.runs.settle(self.worker, case, WANTED)
            answer = {True: "passes", False: "does not pass", None: "no answer"}[passes(self.study, self.found[model, x])]
            print(f"  {self.layout}, {with_unit(x, self.study.unit)}, model {model}: {answer}{' (kept)' if kept else ''}", flush=True)
        return self.found[model, x]

    def cheapest(self, x):
        """Returns the answer of the cheapest model whose numerical band decides; that of the input's own model otherwise."""
        for model in self.study.models:
            found = self.run(model, x)
            if must_pass(self.study, found):
                return True
            if may_pass(self.study, found) is False:
                return False
        return passes(self.study, self.run(BASE, x))

    def known(self, question):
        """Returns {x: answer} of the runs of the input's own model."""
        return {x: question(self.study, found) for (model, x), found in self.found.items() if model == BASE}

    def limit(self):
        """Returns (Bracket whose ends the input's own model has computed, whether larger values pass). @raises NoLimit"""
        study = self.study
        bracket, rises = bisect(self.cheapest, study.low, study.high, study.width)
        own = {x: passes(study, self.run(BASE, x)) for x in (bracket.low, bracket.high)}
        if (own[bracket.low], own[bracket.high]) == (not rises, rises):
            return bracket, rises
        return bisect(lambda x: passes(study, self.run(BASE, x)), study.low, study.high, study.width)

    def range_of(self, question, rises):
        """Returns the bracket of another question, such as may_pass, from what is known already; None if it has none."""
        study = self.study
        low, high = narrowest(self.known(question), study.low, study.high, rises)
        try:
            return bisect(lambda x: question(study, self.run(BASE, x)), low, high, study.width)[0]
        except NoLimit:
            return None


def search(study, runs, worker, layout):
    """Returns what the search on a layout finds: a dict, and its runs."""
    one = Search(study, runs, worker, layout)
    try:
        bracket, rises = one.limit()
    except NoLimit as none:
        return {"layout": layout, "failure": f"{layout}: {none}"}, one.found
    result = {"layout": layout, "limit": bracket.middle, "low": bracket.low, "high": bracket.high, "rises": rises, "band": None}
    if layout == BASE and study.criterion == "perforation":
        ranges = [one.range_of(question, rises) for question in (may_pass, must_pass)]
        if None not in ranges:
            result["band"] = [min(of.low for of in ranges), max(of.high for of in ranges)]
    result["disorder"] = disorder(one.known(passes), rises)
    return result, one.found


def run(study, runs):
    """Searches the limit on all layouts side by side, then shoots the samples. Returns the messages of what failed."""
    print(f"study: {study.name}, {study.criterion} by {study.key} between {with_unit(study.low, study.unit)} and "
          f"{with_unit(study.high, study.unit)}, {len(study.layouts)} layouts", flush=True)
    results, rows, names = {}, [], list(study.layouts)

    def done(index, result):
        results[names[index]] = result[0]
        rows.extend(row(study, x, names[index], model, found) for (model, x), found in result[1].items())
        sweep.write_csv(rows, runs.output / TABLE)

    runs.pool.each(lambda worker, layout: search(study, runs, worker, layout), names, done)
    found = [results[name] for name in names]
    statistic = None
    if study.inputs and "limit" in found[0]:
        statistic = shoot(study, runs, found[0], rows)
    record = record_of(study, found, rows, statistic)
    write(runs.output / RECORD, json.dumps(record, indent=1))
    limit_chart.draw(record, rows, runs.output)
    for words in told(record):
        print(f"  {words}", flush=True)
    return [one["failure"] for one in found if "failure" in one]


def row(study, x, layout, model, found):
    """Returns a line of limit.csv."""
    answer = {True: "yes", False: "no", None: "none"}[passes(study, found)]
    return {study.key + (f" ({study.unit})" if study.unit else ""): f"{x:.10g}", "layout": layout, "model": model, "passes": answer} | {
        name: found.get(name) for name in WANTED} | {"failure": " ".join(found.get("failure", "").split())}


def shoot(study, runs, base, rows):
    """Shoots the samples at random places about the limit and returns the probit fit, a dict."""
    centre = study.width * round(base["limit"] / study.width)  # so that a limit that is found again keeps its samples
    places = {name: latin_hypercube.places(study.seed, name, study.samples) for name in [study.key, *(one.name for one in study.inputs)]}
    x = [centre + study.spread * (2 * float(u) - 1) for u in places[study.key]]
    cases = [{key: value for one in study.inputs for key, value in one.settings(places[one.name][i]).items()} | at(study, x[i])
             for i in range(study.samples)]

    def report(i, found, progress):
        rows.append(row(study, x[i], SAMPLE, BASE, found))
        sweep.write_csv(rows, runs.output / TABLE)
        print(f"  {progress}: sample {i + 1}: {with_unit(x[i], study.unit)}: {rows[-1]['passes']}", flush=True)

    answers = [passes(study, found) for found in runs.compute(cases, WANTED, report)]
    used = [i for i, answer in enumerate(answers) if answer is not None]
    fitted = probit.fit([x[i] for i in used], [answers[i] for i in used], base["rises"]) if used else probit.Probit(0, 0, remark="no answer")
    return {"count": fitted.count, "passed": fitted.passed, "without": study.samples - len(used), "v50": fitted.middle,
            "spread": fitted.spread, "slope": fitted.slope, "errors": list(fitted.errors), "remark": fitted.remark}


def record_of(study, found, rows, statistic):
    """Returns what limit.json holds; places are in the unit of the key."""
    limits = [one["limit"] for one in found if "limit" in one]
    name = FORMULAS.get((study.criterion, beside.last(study.key)))
    factor = beside.factor_of(study.key, study.unit)
    rows_of_formulas = beside.predictions(study, at(study, found[0].get("limit", study.high))) if name and factor else []
    return {"study": study.name, "input": str(study.input), "key": study.key, "unit": study.unit, "criterion": study.criterion,
            "width": study.width, "searches": found, "limit": found[0].get("limit"), "band": found[0].get("band"),
            "layouts": {"count": len(limits), "mean": statistics.fmean(limits) if limits else None,
                        "deviation": statistics.stdev(limits) if len(limits) > 1 else None},
            "statistic": statistic,
            "formulas": [{"formula": one.formula, "limit": getattr(one, name) / factor, "outside": list(one.outside)}
                         for one in rows_of_formulas if getattr(one, name) is not None],
            "remarks": sorted({one["numerical_error_remark"] for one in rows if one.get("numerical_error_remark") and
                               one["model"] == BASE}),
            "runs": len(rows), "cost": {model: sum(number(one["cpu_seconds"]) or 0 for one in rows if one["layout"] != SAMPLE and
                                                  one["model"] == model) for model in [*study.models, BASE]} | {
                SAMPLE: sum(number(one["cpu_seconds"]) or 0 for one in rows if one["layout"] == SAMPLE)}}


def told(record):
    """Returns sentences on the results."""
    unit, words = f" {record['unit']}" if record["unit"] else "", []
    if record["limit"] is not None:
        band = record["band"]
        numerically = f", numerically {band[0]:.4g} to {band[1]:.4g}{unit}" if band else ", without a numerical band"
        words.append(f"limit of {record['criterion']}: {record['limit']:.4g} +- {record['width'] / 2:.2g}{unit}{numerically}")
    layouts, statistic = record["layouts"], record["statistic"]
    if layouts["deviation"] is not None:
        words.append(f"{layouts['count']} layouts: mean {layouts['mean']:.4g}{unit}, standard deviation {layouts['deviation']:.2g}{unit}")
    words += [f"caution: {one['layout']}: answers are out of order between {one['disorder'][0]:.4g} and {one['disorder'][1]:.4g}{unit}"
              for one in record["searches"] if one.get("disorder")]
    if statistic:
        error = [f" +- {value:.2g}" if value is not None else "" for value in statistic["errors"]]
        words.append("statistics: " + (statistic["remark"] if statistic["v50"] is None else
                                       f"V50 {statistic['v50']:.4g}{error[0]}{unit}" + (
                                           f", standard deviation {statistic['spread']:.3g}{error[1]}{unit}" if statistic["spread"]
                                           else f" ({statistic['remark']})")) +
                     f"; {statistic['passed']} of {statistic['count']} shots pass, {statistic['without']} without an answer")
    words += [f"caution: {remark}" for remark in record["remarks"]]
    words.append(f"cost: {record['runs']} runs; processor time " +
                 ", ".join(f"{seconds:.0f} s ({'samples' if name == SAMPLE else 'model ' + name})"
                           for name, seconds in record["cost"].items() if seconds))
    return words
