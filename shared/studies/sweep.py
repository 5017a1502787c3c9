"""Runs the cases of a study one after the other, so that they do not disturb each other's times, and collects answers."""

import csv
import io
import json
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from writing import write  # noqa: E402


class ProgramMissing(Exception):
    pass


class RunFailed(Exception):
    pass


PROGRAMS = {"microcell": "micro/microcell", "penetrate": "macro/penetrate"}


def program_of(study, build):
    program = build / PROGRAMS[study.program]
    if not os.access(program, os.X_OK):
        raise ProgramMissing(f"'{program}' does not exist: build first, or set --build DIR")
    return program


def answer(folder, summary, name):
    """Returns the value of a key of the summary or, for COLUMN@STRAIN, of a column of curve.csv at a strain (by linear
    interpolation where the strain rises)."""
    if "@" not in name:
        value = summary.get(name)
        if not isinstance(value, (int, float)):
            raise RunFailed(f"{folder}/summary.json has no number '{name}'")
        return value
    column, strain = name.split("@")
    strain = float(strain)
    try:
        with open(folder / "curve.csv", newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
        if not rows or column not in rows[0]:
            raise RunFailed(f"{folder}/curve.csv has no column '{column}'")
        for a, b in zip(rows, rows[1:]):
            x, y = float(a["strain"]), float(b["strain"])
            if x <= strain <= y and x < y:
                share = (strain - x) / (y - x)
                return float(a[column]) + share * (float(b[column]) - float(a[column]))
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise RunFailed(f"{folder}/curve.csv: {error}") from error
    raise RunFailed(f"{folder}/curve.csv does not reach strain {strain:g}")


def run_once(study, program, overrides, folder):
    """Runs the program in a folder of the study, in place of an earlier run, and returns its summary. @raises RunFailed with the
    program's message."""
    words = [f"{key}={value}" for key, value in (study.fixed | overrides).items()]
    done = subprocess.run([program, study.input, "--output", folder, "--force", *words], capture_output=True, text=True,
                          check=False)
    if done.returncode:
        raise RunFailed(f"{' '.join(words)}: exit code {done.returncode}: {done.stderr.strip()}")
    return read_summary(folder, " ".join(words))


def read_summary(folder, words):
    """@raises RunFailed if there is none."""
    try:
        return json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise RunFailed(f"{words}: {folder}/summary.json: {error}") from error


def run_case(study, program, overrides, folder):
    """Returns the answers and the lowest cost of the repeats. @raises RunFailed"""
    costs = {cost: [] for cost in study.costs}
    for _ in range(max(1, study.repeats)):
        summary = run_once(study, program, overrides, folder)
        for cost in study.costs:
            costs[cost].append(answer(folder, summary, cost))
    return {name: answer(folder, summary, name) for name in study.answers} | {
        f"cost {cost}": min(values) for cost, values in costs.items()}


def error(name, value, exact):
    """Returns the error in percent of the exact value, or of 1 if the answer is a damage."""
    scale = 1.0 if "damage" in name else abs(exact)
    return 100 * abs(value - exact) / scale if scale else abs(value - exact)


def run(study, build, output):
    """Returns the rows of results and the messages of the runs that failed. study.csv has them after every run, whatever happens
    to the next one. @raises RunFailed if the reference fails."""
    program = program_of(study, build)
    output.mkdir(parents=True, exist_ok=True)
    print(f"study: {study.name}, {len(study.cases)} cases", flush=True)
    exact = study.exact or run_case(study, program, study.reference, output / "reference")
    print(f"  reference: {exact}", flush=True)
    rows, failures = [], []
    for i, case in enumerate(study.cases):
        label = ", ".join(f"{key}={value}" for key, value in case.overrides.items())
        try:
            found = run_case(study, program, case.overrides, output / "run")
        except RunFailed as failed:
            failures.append(str(failed))
            write_study(rows, failures, output)
            continue
        row = {"series": case.series, "label": label, "family": family_of(study, case, i),
               "default": is_default(study, case)} | found
        for name in study.answers:
            row[f"error {name}"] = error(name, found[name], exact[name])
        rows.append(row)
        write_study(rows, failures, output)
        costs = ", ".join(f"{row[f'cost {cost}']:.3g} {cost}" for cost in study.costs)
        errors = ", ".join(f"{name} {row[f'error {name}']:.3g} %" for name in study.answers)
        print(f"  {i + 1}/{len(study.cases)}: {label}: {costs}; {errors}", flush=True)
    return rows, failures


def family_of(study, case, number):
    """Returns the name of the family of a case: the runs that differ from it in refinement only."""
    if not study.refined_by:
        return str(number)
    return ", ".join(f"{key}={value}" for key, value in sorted((study.fixed | case.overrides).items())
                     if key not in study.refined_by)


def is_default(study, case):
    """Tells whether the case has the settings of the default and no others."""
    settings = study.fixed | case.overrides
    return bool(study.default) and case.overrides.keys() <= study.default.keys() and all(
        settings.get(key) == value for key, value in study.default.items())


def write_csv(rows, path):
    """@raises Unwritten"""
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, list(dict.fromkeys(key for row in rows for key in row)) or ["nothing"])
    writer.writeheader()
    writer.writerows(rows)
    write(path, text.getvalue())


def write_study(rows, failures, output):
    """Writes the rows, and those of the runs that failed with the reason."""
    write_csv([row | {"failure": ""} for row in rows] +
              [{"label": failure.split(": ", 1)[0], "failure": failure} for failure in failures], output / "study.csv")
