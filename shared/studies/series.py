"""Runs a series of inputs and reports on all of them together."""

import pathlib
import subprocess
import sys
import time

import sweep

COMPARE = pathlib.Path(__file__).resolve().parents[1] / "compare" / "compare.py"


def command(run, program, output, name, force=False):
    """Returns the command of a run. A value that begins with `@NAME/` is a file among the results of the run NAME."""
    words = [f"{key}={output / value[1:] if value.startswith('@') else value}" for key, value in run.overrides.items()]
    return [program, run.input, "--output", output / name, *how(output / name, force), *words]


def how(folder, force):
    """Returns the option for a run with results in its folder: it goes on from what there is. A run of penetrate that has left
    no checkpoint begins anew."""
    if force or not (folder / "resolved.prm").is_file():
        return ["--force"] if force or folder.is_dir() and any(folder.iterdir()) else []
    begun, saved = (folder / "history.csv").is_file(), any(folder.glob("checkpoint*.h5"))
    return ["--force"] if begun and not saved else ["--restart"]


def run(series, build, output, force=False):
    """Runs the series and returns the messages of the runs that failed. Every run keeps its results in a folder of its name,
    also if it fails. Runs that are finished are kept, others go on, unless `force`."""
    programs = {one.program: sweep.program_of(one, build) for one in series.runs.values()}
    output.mkdir(parents=True, exist_ok=True)
    print(f"study: {series.name}, {len(series.runs)} runs", flush=True)
    failures, folders, begin = [], [], time.monotonic()
    for name, one in series.runs.items():
        done = subprocess.run(command(one, programs[one.program], output, name, force), capture_output=True, text=True, check=False)
        if done.returncode:
            failures.append(f"{name}: exit code {done.returncode}: {done.stderr.strip()}")
        if any((output / name / file).is_file() for file in ("summary.json", "history.csv")):
            folders.append(output / name)
        lines = done.stdout.splitlines()
        print("".join(f"  {name}: {line}\n" for line in (lines[1:-1] if len(lines) > 2 else lines)), end="", flush=True)
    print(f"  all runs: {time.monotonic() - begin:.0f} s", flush=True)
    if folders:
        words = [sys.executable, COMPARE, *folders, "--output", output / "report", "--force"]
        if subprocess.run(words, check=False).returncode:
            failures.append(f"no report in {output / 'report'}")
    return failures
