"""Runs a series of inputs and reports on all of them together."""

import pathlib
import subprocess
import sys
import time

import sweep

COMPARE = pathlib.Path(__file__).resolve().parents[1] / "compare" / "compare.py"


def command(run, program, output, name):
    """Returns the command of a run. A value that begins with `@NAME/` is a file among the results of the run NAME."""
    words = [f"{key}={output / value[1:] if value.startswith('@') else value}" for key, value in run.overrides.items()]
    return [program, run.input, "--output", output / name, *words]


def run(series, build, output):
    """Runs the series and returns the messages of the runs that failed. Every run keeps its results in a folder of its name,
    also if it fails."""
    programs = {one.program: sweep.program_of(one, build) for one in series.runs.values()}
    output.mkdir(parents=True, exist_ok=True)
    print(f"study: {series.name}, {len(series.runs)} runs", flush=True)
    failures, folders, begin = [], [], time.monotonic()
    for name, one in series.runs.items():
        done = subprocess.run(command(one, programs[one.program], output, name), capture_output=True, text=True, check=False)
        if done.returncode:
            failures.append(f"{name}: exit code {done.returncode}: {done.stderr.strip()}")
        if (output / name / "summary.json").is_file():
            folders.append(output / name)
        print("".join(f"  {name}: {line}\n" for line in done.stdout.splitlines()[1:-1]), end="", flush=True)
    print(f"  all runs: {time.monotonic() - begin:.0f} s", flush=True)
    if folders:
        words = [sys.executable, COMPARE, *folders, "--output", output / "report"]
        if subprocess.run(words, check=False).returncode:
            failures.append(f"no report in {output / 'report'}")
    return failures
