"""Runs a series of inputs and reports on all of them together."""

import pathlib
import subprocess
import sys
import threading
import time

import sweep
from runs import one_thread
from workers import Pool, Progress, Worker

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


def run(series, build, output, workers=None, force=False):
    """Runs the series and returns the messages of the runs that failed. Every run keeps its results in a folder of its name,
    also if it fails. Runs that are finished are kept, others go on, unless `force`. A run waits for those whose files it uses."""
    programs = {one.program: sweep.program_of(one, build) for one in series.runs.values()}
    output.mkdir(parents=True, exist_ok=True)
    print(f"study: {series.name}, {len(series.runs)} runs", flush=True)
    pool, progress, begin = Pool(workers or [Worker(1)]), Progress(len(series.runs)), time.monotonic()
    names, ended = list(series.runs), {name: threading.Event() for name in series.runs}
    failures = {}

    def work(worker, name):
        one = series.runs[name]
        try:
            for value in one.overrides.values():
                if value.startswith("@"):
                    ended[value[1:].split("/")[0]].wait()
            more = one_thread(one.program, one.overrides, pool)
            return pool.execute(worker, [*command(one, programs[one.program], output, name, force), *more])
        finally:
            ended[name].set()

    def report(index, result):
        (code, out, err), name = result, names[index]
        if code:
            failures[name] = f"{name}: exit code {code}: {err.strip()}"
        lines = out.splitlines()
        print("".join(f"  {name}: {line}\n" for line in (lines[1:-1] if len(lines) > 2 else lines)) +
              f"  {progress.after(False)}", flush=True)

    pool.each(work, names, report)
    print(f"  all runs: {time.monotonic() - begin:.0f} s", flush=True)
    told = [failures[name] for name in names if name in failures]
    folders = [output / name for name in names
               if any((output / name / file).is_file() for file in ("summary.json", "history.csv"))]
    if folders:
        words = [sys.executable, COMPARE, *folders, "--output", output / "report", "--force"]
        if subprocess.run(words, check=False).returncode:
            told.append(f"no report in {output / 'report'}")
    return told
