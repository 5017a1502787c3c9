"""Runs the cases of a study and collects answers and costs."""

import csv
import io
import json
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from files import Unreadable, read_text  # noqa: E402
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


def read_summary(folder, words):
    """@raises RunFailed if there is none."""
    try:
        return json.loads(read_text(folder / "summary.json"))
    except (Unreadable, ValueError, RecursionError) as error:
        raise RunFailed(f"{words}: {folder}/summary.json: {error}") from error


def error(name, value, exact):
    """Returns the error in percent of the exact value, or of 1 if the answer is a damage."""
    scale = 1.0 if "damage" in name else abs(exact)
    return 100 * abs(value - exact) / scale if scale else abs(value - exact)


def run(study, runs):
    """Returns the rows of results and the messages of the runs that failed. study.csv has them after every run, whatever happens
    to the next one. @raises RunFailed if the reference fails."""
    print(f"study: {study.name}, {len(study.cases)} cases", flush=True)
    wanted, repeats = [*study.answers, *study.costs], max(1, study.repeats)
    exact = study.exact or checked(runs.compute([study.reference], study.answers)[0], study.answers)
    print(f"  reference: {exact}", flush=True)
    results = [None] * len(study.cases)

    def report(i, found, progress):
        case = study.cases[i]
        label = ", ".join(f"{key}={value}" for key, value in case.overrides.items())
        try:
            row = row_of(study, i, label, checked(found, wanted), exact)
        except RunFailed as failed:
            results[i] = f"{label}: {failed}" if label not in str(failed) else str(failed)
            print(f"  {progress}: {label}: failed", flush=True)
        else:
            results[i] = row
            costs = ", ".join(f"{row[f'cost {cost}']:.3g} {cost}" for cost in study.costs)
            errors = ", ".join(f"{name} {row[f'error {name}']:.3g} %" for name in study.answers)
            print(f"  {progress}: {label}: {costs}; {errors}", flush=True)
        write_study(*parted(results), runs.output)

    runs.compute([case.overrides for case in study.cases], wanted, report, repeats)
    return parted(results)


def checked(found, names):
    """Returns the numbers of a run. @raises RunFailed if it failed or one is missing."""
    if "failure" in found:
        raise RunFailed(found["failure"])
    for name in names:
        if not isinstance(found[name], (int, float)):
            raise RunFailed(f"summary.json has no number '{name}'")
    return found


def row_of(study, number, label, found, exact):
    case = study.cases[number]
    return {"series": case.series, "label": label, "family": family_of(study, case, number),
            "default": is_default(study, case)} | {name: found[name] for name in study.answers} | {
                f"cost {cost}": found[cost] for cost in study.costs} | {
                    f"error {name}": error(name, found[name], exact[name]) for name in study.answers}


def parted(results):
    """Returns the rows, and the messages of failures, of the runs that have ended, in the order of the study."""
    return [row for row in results if isinstance(row, dict)], [text for text in results if isinstance(text, str)]


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
