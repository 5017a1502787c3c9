"""Studies of scaling: time is measured on few ranks, messages and bytes are counted on many, and a report has a model that
is fitted to both."""

import json
import math
import os
import pathlib
import subprocess
import sys
from dataclasses import dataclass, field

import sweep
from series import COMPARE
from study_file import BadStudy, count, fault_of_file, overrides, sections
from sweep import write

SERIES = ("strong", "weak")
SECTIONS = {f"{series.capitalize()} {how}": (series, how == "timed") for series in SERIES for how in ("timed", "counted")}
KEYS = ("Kind", "Program", "Input", "Fixed", "Repeats")
MODEL = ("Points", "Ranks", "Latency", "Bandwidth")  # s; bytes/s of one rank
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
# There may be more ranks than cores in counted runs: then a waiting rank must yield its core to the others.
YIELD = "OMPI_MCA_mpi_yield_when_idle"


@dataclass
class Run:
    series: str
    timed: bool
    ranks: int
    overrides: dict


@dataclass
class Scaling:
    name: str
    program: str
    input: pathlib.Path
    fixed: dict
    repeats: int  # of timed runs
    assumptions: dict
    runs: list = field(default_factory=list)


def numbers(text, kind=float):
    found = [float(word) for word in text.split("|")]
    if not all(math.isfinite(number) and number > 0 and number == kind(number) for number in found):
        raise ValueError(f"found '{text}', allowed: {'whole ' if kind is int else ''}numbers above 0")
    return [kind(number) for number in found]


def read(path):
    """Reads the study. Returns None if its kind is another one. @raises BadStudy"""
    settings, model, runs = {}, {}, []
    lines = list(sections(path))
    if not any((section, key, value) == ("Study", "Kind", "scaling") for section, _, key, value in lines):
        return None
    for section, number, key, value in lines:
        try:
            if section == "Study":
                allowed(key, KEYS)
                settings[key] = {"Repeats": lambda text: count(text, "Repeats"), "Fixed": overrides}.get(key, str)(value)
            elif section == "Model":
                allowed(key, MODEL)
                model[key.lower()] = numbers(value) if key == "Ranks" else numbers(value)[0]
            else:
                allowed(section, SECTIONS, "section")
                series, timed = SECTIONS[section]
                runs += [Run(series, timed, ranks, overrides(value)) for ranks in numbers(key, int)]
        except ValueError as error:
            raise BadStudy(f"{path}:{number}: {error}") from error
    for group, keys, title in ((settings, ("Program", "Input"), "Study"), (model, [key.lower() for key in MODEL], "Model")):
        for key in keys:
            if key not in group:
                raise BadStudy(f"{path}: key '{title}/{key.capitalize()}' must be set")
    source = path.parent / settings["Input"]
    if fault_of_file(source):
        raise BadStudy(f"{path}: Study/Input: no file '{source}'")
    if settings["Program"] != "penetrate" or not runs:
        raise BadStudy(f"{path}: a study of scaling runs penetrate, in sections {', '.join(SECTIONS)}")
    return Scaling(path.stem, "penetrate", source, settings.get("Fixed", {}), settings.get("Repeats", 1),
                   model, runs)


def allowed(found, names, what="key"):
    if found not in names:
        raise ValueError(f"unknown {what} '{found}', allowed: {', '.join(names)}")


def run_once(study, program, run, folder):
    """Runs the program and returns its summary. @raises RunFailed with the program's message."""
    words = [f"{key}={value}" for key, value in (study.fixed | run.overrides).items()]
    start = ["mpirun", "--oversubscribe", "-n", str(run.ranks)] if run.ranks > 1 else []
    environment = os.environ | ENVIRONMENT | {YIELD: "0" if run.timed else "1"}
    done = subprocess.run([*start, program, study.input, "--output", folder, "--force", *words], capture_output=True, text=True,
                          check=False, env=environment)
    if done.returncode:
        raise sweep.RunFailed(f"{run.series}, {run.ranks} ranks: exit code {done.returncode}: {done.stderr.strip()}")
    return sweep.read_summary(folder, f"{run.series}, {run.ranks} ranks")


def run(study, build, output):
    """Runs the study and returns the messages of the runs that failed."""
    program = sweep.program_of(study, build)
    output.mkdir(parents=True, exist_ok=True)
    print(f"study: {study.name}, {len(study.runs)} runs", flush=True)
    failures, record = [], {"assumptions": study.assumptions, "runs": []}
    for one in study.runs:
        for _ in range(study.repeats if one.timed else 1):
            try:
                summary = run_once(study, program, one, output / "run")
            except sweep.RunFailed as failed:
                failures.append(str(failed))
                break
            record["runs"].append({"series": one.series, "timed": one.timed, "ranks": one.ranks, "summary": summary})
            write(output / "scaling.json", json.dumps(record, indent=1))
            print(f"  {one.series} {'timed' if one.timed else 'counted'}, {one.ranks} ranks, {summary['points']} points: "
                  f"{1e3 * summary['wall_seconds'] / summary['steps']:.1f} ms per step, "
                  f"{summary['bytes_per_step_max']:.0f} bytes in {summary['messages_per_step_max']:.1f} messages", flush=True)
    write(output / "scaling.json", json.dumps(record, indent=1))
    words = [sys.executable, COMPARE, output, "--output", output / "report", "--force"]
    if subprocess.run(words, check=False).returncode:
        failures.append(f"no report in {output / 'report'}")
    return failures
