"""Uncertainty: the band of the answers over random values of the uncertain inputs, and which input contributes how much."""

import json
import pathlib
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

import numpy as np

import distributions
import latin_hypercube
import scatter
import sweep
from kind_file import answers, existing, number, program, read_kind, whole
from series import COMPARE
from study_file import BadStudy, overrides
from sweep import write
from workers import Pool, Worker

KEYS = ("Kind", "Program", "Input", "Answers", "Fixed", "Samples", "Seed")
REQUIRED = ("Program", "Input", "Answers", "Samples")
MOST = 100000  # samples
TABLE, RECORD = "samples.csv", "uncertainty.json"
AS_IT_IS = "as_it_is"  # folder of the run of the input with Fixed only
# How a program checks its inputs: penetrate without computing anything, a microcell takes less than a second.
CHECK = {"penetrate": ["--plan"]}


@dataclass
class Uncertainty:
    path: pathlib.Path
    program: str
    input: pathlib.Path
    answers: list
    fixed: dict
    samples: int
    seed: int
    inputs: list = field(default_factory=list)  # Uncertain

    results = "samples.csv, uncertainty.json, report"

    @property
    def name(self):
        return self.path.stem

    @property
    def files(self):
        return distributions.files_of(self.inputs)


def read(path):
    """Reads the study. Returns None if its kind is another one. @raises BadStudy"""
    found = read_kind(path, "uncertainty", KEYS, REQUIRED, {"Distributions": distributions.read})
    if found is None:
        return None
    settings, inputs = found[0], found[1]["Distributions"]
    if not inputs:
        raise BadStudy(f"{path}: a study of uncertainty needs a section Distributions: set NAME = Section/Key=DISTRIBUTION")
    study = Uncertainty(path, settings.get("Program", program), settings.get("Input", lambda text: existing(path.parent / text)),
                        settings.get("Answers", answers), settings.get("Fixed", overrides),
                        settings.get("Samples", lambda text: whole(text, 1, MOST)),
                        settings.get("Seed", lambda text: whole(text, 0), "1"),
                        [distributions.beside(one, path.parent) for one in inputs.values()])
    refuse_clashes(study)
    return study


def refuse_clashes(study):
    """@raises BadStudy if a key would be set twice"""
    setters = {key: "Study/Fixed" for key in study.fixed}
    for one in study.inputs:
        for key in one.keys:
            if key in setters:
                raise BadStudy(f"{study.path}:{one.line}: {one.name}: found '{key}', which {setters[key]} sets, allowed: a key "
                               "that is set once")
            setters[key] = one.name


def check(study, build, count):
    """Lets the program check every input at the ends of its distribution, `count` at a time, before anything is computed.
    @raises BadStudy with the line of the study and the words of the program, ProgramMissing"""
    executable, pool = sweep.program_of(study, build), Pool([Worker(i + 1) for i in range(count)])
    ends = [one.ends() for one in study.inputs]
    # All inputs are at an end at once. Only if that is refused is it worth while to try each alone.
    corners = [{key: value for of_one in ends for key, value in of_one[k % len(of_one)].items()}
               for k in range(max(map(len, ends)))]
    if not any(refusals(study, executable, pool, corners)):
        return
    places = [(f"{study.path}: Study/Input, Study/Fixed", {})]
    places += [(f"{study.path}:{one.line}: {one.name}", end) for one, of_one in zip(study.inputs, ends) for end in of_one]
    for (place, _), refused in zip(places, refusals(study, executable, pool, [end for _, end in places])):
        if refused:
            raise BadStudy(f"{place}: {refused}")


def refusals(study, executable, pool, cases):
    """Returns for each case what the program says if it refuses its inputs (exit code 2), or an empty text."""
    found = [""] * len(cases)

    def one(worker, case):
        with tempfile.TemporaryDirectory() as folder:
            how = CHECK.get(study.program) or ["--output", folder, "--force"]
            changes = [f"{key}={value}" for key, value in (study.fixed | case).items()]
            return pool.execute(worker, [executable, study.input, *how, *changes])

    def done(index, result):
        code, _, err = result
        if code == 2:
            found[index] = (err.strip().splitlines() or ["refused"])[-1]

    pool.each(one, cases, done)
    return found


def places(study):
    """Returns {name of an input: its places in (0, 1)}, arrays of study.samples numbers."""
    return {one.name: latin_hypercube.places(study.seed, one.name, study.samples) for one in study.inputs}


def wanted(study):
    """Returns the keys that a run is asked for: the answers, and the ends of their numerical bands."""
    return [*study.answers, *(f"{name}_{end}" for name in study.answers if "@" not in name for end in ("low", "high"))]


def run(study, runs):
    """Runs the samples, writes their table after each and the results at the end, and returns the messages of runs that failed.
    The first run is that of the input as it is; it keeps all its results."""
    at, names = places(study), wanted(study)
    print(f"study: {study.name}, {study.samples} samples of {len(study.inputs)} inputs", flush=True)
    base = runs.compute([{}], names, folder=AS_IT_IS)[0]
    print("  as it is: " + (base["failure"] if "failure" in base else told(study, base)), flush=True)
    drawn = [{name: at[name][i] for name in at} for i in range(study.samples)]
    cases = [{key: value for one in study.inputs for key, value in one.settings(u[one.name]).items()} for u in drawn]
    found = [None] * len(cases)

    def report(i, result, progress):
        found[i] = result
        write_table(study, drawn, found, names, runs.output / TABLE)
        words_of_it = "failed: " + result["failure"] if "failure" in result else told(study, result)
        print(f"  {progress}: sample {i + 1}: {words_of_it}", flush=True)

    runs.compute(cases, names, report)
    record = results(study, at, found, base)
    write(runs.output / RECORD, json.dumps(record, indent=1))
    for name, result in record["answers"].items():
        print(f"  {name}: {in_words(result)}", flush=True)
    failures = [f"sample {i + 1}: {result['failure']}" for i, result in enumerate(found) if "failure" in result]
    failures += [f"as it is: {base['failure']}"] if "failure" in base else []
    compare = [sys.executable, COMPARE, runs.output, "--output", runs.output / "report", "--force"]
    if subprocess.run(compare, check=False).returncode:
        failures.append(f"no report in {runs.output / 'report'}")
    return failures


def told(study, result):
    return ", ".join(f"{name} {result[name]:.6g}" if number(result[name]) is not None else f"{name} none" for name in study.answers)


def in_words(result):
    if not result["count"]:
        return "no values"
    low, median, high = (end["value"] for end in result["band"])
    return f"5 % {low:.6g}, median {median:.6g}, 95 % {high:.6g} of {result['count']} values"


def write_table(study, drawn, found, names, path):
    """Writes the samples that have ended: values of the inputs, answers, state, and why a run failed."""
    rows = []
    for i, (u, result) in enumerate(zip(drawn, found)):
        if result is not None:
            inputs = {title: text for one in study.inputs for title, text in one.columns(u[one.name]).items()}
            rows.append({"sample": i + 1} | inputs | {name: number(result.get(name)) for name in names} |
                        {"state": "failed" if "failure" in result else "done",
                         "failure": " ".join(result.get("failure", "").split())})
    sweep.write_csv(rows, path)


def results(study, at, found, base):
    """Returns what uncertainty.json holds. Numbers are SI, as in summary.json; shares are of 1."""
    return {"study": study.name, "program": study.program, "input": str(study.input), "samples": study.samples, "seed": study.seed,
            "complete_hypercube": latin_hypercube.is_complete(study.samples), "confidence": scatter.CONFIDENCE,
            "inputs": [{"name": one.name, "keys": list(one.keys), "distributions": [law.words for law in one.laws],
                        "ranked": one.is_choice or one.has_order} for one in study.inputs],
            "failed": [{"sample": i + 1, "failure": " ".join(result["failure"].split())}
                       for i, result in enumerate(found) if "failure" in result],
            "answers": {name: result_of(study, name, at, found, base) for name in study.answers}}


def result_of(study, name, at, found, base):
    """Returns the band of an answer, its contributions, its convergence and the numerical error of its runs. Runs that failed and
    runs without a number (a depth where the slab was perforated) have no part in them, but are counted."""
    finished = [i for i, result in enumerate(found) if "failure" not in result]
    used = np.array([i for i in finished if number(found[i][name]) is not None], dtype=int)
    values = np.array([found[i][name] for i in used], dtype=float)
    result = {"count": len(used), "without": len(finished) - len(used), "as_it_is": number(base.get(name)),
              "samples": [int(i) + 1 for i in used], "values": values.tolist(), "numerical": numerical(name, used, found)}
    if not len(used):
        return result
    inputs = {one.name: (np.array([one.number(u) for u in at[one.name][used]], dtype=float), one.is_choice)
              for one in study.inputs if one.is_choice or one.has_order}
    parts = scatter.contributions(inputs, values)
    parts["errors"] = scatter.share_errors(inputs, values)
    return result | {"mean": float(values.mean()), "deviation": float(values.std(ddof=1)) if len(used) > 1 else None,
                     "band": scatter.band(values), "growth": scatter.growth(values, used), "contributions": parts,
                     "noise": scatter.noise(len(used)), "cautions": scatter.cautions(len(used), parts)}


def numerical(name, used, found):
    """Returns the ends of the numerical bands of the runs, one for each value, or None where a run states none."""
    return [[number(found[i].get(f"{name}_{end}")) for i in used] for end in ("low", "high")]
