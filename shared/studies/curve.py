"""A curve: answers against a swept key, with fits of residual velocities, measured points and the formulas of engineers."""

import json
import pathlib
import sys
from dataclasses import dataclass, field

import numpy as np

import beside
import curve_chart
import sweep
from kind_file import answers, existing, measure, number, program, read_kind, with_unit
from study_file import BadStudy, overrides, places, words
from uncertainty import refusals
from workers import Pool, Worker
from writing import write

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "empirical"))

import residual_fits  # noqa: E402

KEYS = ("Kind", "Program", "Input", "Answers", "Fixed", "Fits")
REQUIRED = ("Program", "Input", "Answers")
SECTION = "Curve"
TABLE, RECORD = "curve.csv", "curve.json"
DRAWN = 60  # places of a formula or a fit in the chart
# States of a run. Those that have no answer are drawn at the foot of the chart.
FAILED, UNFINISHED = "failed", "unfinished"
FITTED = "exit_velocity"
STATE_KEYS = ["outcome", "ended", "numerical_error_remark", "cpu_seconds"]


@dataclass
class Curve:
    path: pathlib.Path
    program: str
    input: pathlib.Path
    answers: list
    fixed: dict
    fits: list
    unit: str
    points: list                              # (x, overrides), ascending
    keys: list = field(default_factory=list)  # the swept one first, then those that change with it

    results = "curve.csv, curve.json, curve_*.png, curve_*.svg"

    @property
    def name(self):
        return self.path.stem


def swept(path):
    """Returns the function that reads the line of the section Curve: `Section/Key = 100 | 200 | 300 m/s`. A number without a unit has
    that of the last one. Further keys that change with it stand behind ` + `."""
    def line(key, value, number_of_line):
        found = places(path, number_of_line, key, value)
        first = next(iter(found[0]))
        numbers = [measure(one[first]) for one in found]
        unit = numbers[-1][1]
        if any(of not in ("", unit) for _, of in numbers):
            raise ValueError(f"found several units, allowed: one, {unit or 'or none'}")
        points = sorted(((x, one | {first: with_unit(x, unit)}) for (x, _), one in zip(numbers, found)), key=lambda point: point[0])
        if len(points) < 2 or any(a[0] == b[0] for a, b in zip(points, points[1:])):
            raise ValueError(f"found '{value}', allowed: two values or more that differ, between |")
        return unit, points, list(found[0])
    return line


def read(path):
    """Reads the study. Returns None if its kind is another one. @raises BadStudy"""
    found = read_kind(path, "curve", KEYS, REQUIRED, {SECTION: swept(path)})
    if found is None:
        return None
    settings, lines = found[0], list(found[1][SECTION].values())
    if len(lines) != 1:
        raise BadStudy(f"{path}: section '{SECTION}': found {len(lines)} lines, allowed: one, set Section/Key = VALUE | VALUE ...")
    unit, points, keys = lines[0]
    asked, fixed = settings.get("Answers", answers), settings.get("Fixed", overrides)
    if clash := [key for key in keys if key in fixed]:
        raise BadStudy(f"{path}: Study/Fixed: found '{clash[0]}', which the section {SECTION} sets, allowed: a key that is set once")
    return Curve(path, settings.get("Program", program), settings.get("Input", lambda text: existing(path.parent / text)), asked, fixed,
                 settings.get("Fits", lambda text: fits(text, "Fits" in settings, asked, keys)), unit, points, keys)


def fits(text, stated, asked, keys):
    """Returns the names of the fits: those that are stated, or all where they apply. @raises ValueError"""
    applies = FITTED in asked and beside.last(keys[0]) == "Velocity"
    if not stated:
        return list(residual_fits.POWERS) if applies else []
    names = words(text)
    allowed = {name.lower(): name for name in residual_fits.POWERS}
    if any(name.lower() not in allowed for name in names):
        raise ValueError(f"found '{text}', allowed: {', '.join(residual_fits.POWERS)}, or nothing")
    if names and not applies:
        raise ValueError(f"found '{text}', allowed: nothing, unless the answer {FITTED} is swept over a Velocity")
    return [allowed[name.lower()] for name in names]


def check(study, build, count):
    """Lets the program check the input at every place before anything is computed. @raises BadStudy, ProgramMissing"""
    executable, pool = sweep.program_of(study, build), Pool([Worker(i + 1) for i in range(count)])
    for (x, _), refused in zip(study.points, refusals(study, executable, pool, [changes for _, changes in study.points])):
        if refused:
            raise BadStudy(f"{study.path}: {study.keys[0]} = {with_unit(x, study.unit)}: {refused}")


def wanted(study):
    bands = [f"{name}_{end}" for name in study.answers if "@" not in name for end in ("low", "high")]
    return [*study.answers, *bands, *STATE_KEYS, *beside.IDENTITY]


def state_of(found, answer):
    """Returns the state of a run: its outcome, FAILED or UNFINISHED; 'done' where nothing flies at a target."""
    if "failure" in found:
        return FAILED
    outcome = found.get("outcome")
    if outcome == "moving" or number(found[answer]) is None and found.get("ended") == "end time":
        return UNFINISHED
    return outcome or "done"


def run(study, runs):
    """Runs the places, writes their table after each and the chart at the end. Returns the messages of the runs that failed."""
    print(f"study: {study.name}, {len(study.points)} values of {study.keys[0]}", flush=True)
    found = [None] * len(study.points)

    def report(i, result, progress):
        found[i] = result
        write_table(study, found, runs.output / TABLE)
        values = ", ".join(f"{name} {'none' if number(result.get(name)) is None else f'{result[name]:.6g}'}" for name in study.answers)
        print(f"  {progress}: {with_unit(study.points[i][0], study.unit)}: {state_of(result, study.answers[0])}, " +
              (result["failure"] if "failure" in result else values), flush=True)

    runs.compute([changes for _, changes in study.points], wanted(study), report)
    record = results(study, found)
    write(runs.output / RECORD, json.dumps(record, indent=1))
    for answer in study.answers:
        if "@" not in answer:
            curve_chart.draw(record, answer, runs.output)
    for words_of_it in told(record):
        print(f"  {words_of_it}", flush=True)
    return [result["failure"] for result in found if "failure" in result]


def write_table(study, found, path):
    """Writes the runs that have ended: place, state, answers with their bands (SI), and why a run failed."""
    rows = []
    for (x, changes), result in zip(study.points, found):
        if result is not None:
            title = study.keys[0] + (f" ({study.unit})" if study.unit else "")
            rows.append({title: f"{x:.10g}"} | {key: changes[key] for key in study.keys[1:]} |
                        {"state": state_of(result, study.answers[0])} |
                        {name: number(result.get(name)) for name in wanted(study)[:-len(STATE_KEYS + beside.IDENTITY)]} |
                        {"cpu_seconds": number(result.get("cpu_seconds")), "failure": " ".join(result.get("failure", "").split())})
    sweep.write_csv(rows, path)


def results(study, found):
    """Returns what curve.json holds. Numbers are SI, as in summary.json, x in its unit."""
    ended = [result for result in found if "failure" not in result]
    places_drawn = np.linspace(study.points[0][0], study.points[-1][0], DRAWN)
    record = {"study": study.name, "input": str(study.input), "key": study.keys[0], "unit": study.unit,
              "cpu_seconds": sum(number(result["cpu_seconds"]) or 0 for result in ended),
              "remarks": sorted({result["numerical_error_remark"] for result in ended if result.get("numerical_error_remark")}),
              "answers": {}}
    for answer in study.answers:
        summary = ended[0] if ended else {}
        record["answers"][answer] = {
            "points": [{"x": x, "state": state_of(result, answer), "value": number(result.get(answer)),
                        "low": number(result.get(f"{answer}_low")), "high": number(result.get(f"{answer}_high")),
                        "failure": result.get("failure", "")} for (x, _), result in zip(study.points, found)],
            "measured": beside.measured(study, study.keys[0], study.unit, answer, summary) if ended else [],
            "formulas": beside.formula_lines(study, answer, study.keys, places_drawn, study.unit),
            "fits": fitted(study, answer, found)}
    return record


def fitted(study, answer, found):
    """Returns the fits of the exit velocities, with the drawn line of each, [] where none applies. Velocities are SI."""
    factor = beside.factor_of(study.keys[0], study.unit)
    if answer != FITTED or not study.fits or factor is None:
        return []
    known = [(factor * x, result[answer]) for (x, _), result in zip(study.points, found)
             if "failure" not in result and number(result[answer]) is not None]
    made = [residual_fits.fit(name, *zip(*known)) for name in study.fits] if known else []
    places_drawn = [study.points[0][0], *np.linspace(study.points[0][0], study.points[-1][0], 5 * DRAWN)]
    return [{"name": one.name, "limit": one.limit, "factor": one.factor, "power": one.power, "errors": list(one.errors),
             "deviation": one.deviation, "count": one.count, "remark": one.remark, "words": residual_fits.in_words(one),
             "line": [(float(x), float(one.at(factor * x))) for x in places_drawn]} for one in made if one is not None]


def told(record):
    """Returns sentences on the results."""
    found = [f"cost: {record['cpu_seconds']:.3g} s of processor time", *(f"caution: {remark}" for remark in record["remarks"])]
    for answer in record["answers"].values():
        found += [one["words"] for one in answer["fits"]]
    return found
