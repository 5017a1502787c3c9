"""Runs of a study side by side, on the cores of this machine and of others, and the record of what is done."""

import hashlib
import json
import os
import pathlib
import queue
import re
import shlex
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass

from study_file import BadStudy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from files import Unreadable, fault_of_file, read_text  # noqa: E402
from inputs import without_comment  # noqa: E402
from writing import write  # noqa: E402

HERE = "localhost"
RECORD = "runs.json"


@dataclass(frozen=True)
class Worker:
    """A place for one run at a time."""
    number: int
    host: str = HERE

    def command(self, words):
        """Returns the command of a run. That of another machine goes there by ssh, into the same folder, which both must see."""
        words = [str(word) for word in words]
        if self.host == HERE:
            return words
        return ["ssh", "-o", "BatchMode=yes", self.host, f"cd {shlex.quote(os.getcwd())} && exec {shlex.join(words)}"]


def workers_of(count, hosts=None):
    """Returns `count` workers of this machine, or those of a file of hosts. @raises BadStudy"""
    return [Worker(i + 1, host) for i, host in enumerate(read_hosts(hosts) if hosts else [HERE] * count)]


def read_hosts(path):
    """Reads a file with lines `HOST [RUNS AT A TIME]`; localhost is this machine. @raises BadStudy"""
    found = []
    try:
        lines = read_text(path).splitlines()
    except Unreadable as error:
        raise BadStudy(f"hosts: cannot read {error}") from error
    for number, line in enumerate(lines, 1):
        try:
            line = without_comment(line)
        except ValueError as error:
            raise BadStudy(f"{path}:{number}: {error}") from error
        if not line:
            continue
        match = re.fullmatch(r"([A-Za-z0-9][\w.@-]*)(?:\s+(\d{1,4}))?", line)
        if not match or match[2] == "0":
            raise BadStudy(f"{path}:{number}: found '{line}', allowed: HOST [RUNS AT A TIME]")
        found += [match[1]] * int(match[2] or 1)
    if not found:
        raise BadStudy(f"{path}: no hosts, allowed: lines HOST [RUNS AT A TIME]")
    return found


def contents(path, seen=()):
    """Yields the bytes of an input, of what it includes, and of the files that its keys name, such as a damage table."""
    data = path.read_bytes()
    yield data
    if path.suffix != ".prm":
        return
    for line in data.decode("utf-8", errors="replace").splitlines():
        if not (match := re.match(r"\s*(?:include\s|set\s[^=]*=)(.+)", line)):
            continue
        try:
            other = (path.parent / without_comment(match[1])).resolve()
        except ValueError:  # a quote that is not closed, which the program refuses
            continue
        if other not in seen and not fault_of_file(other):
            yield from contents(other, (*seen, other))


def digest_of(program, *inputs):
    """Returns a digest of a program and of its inputs: runs of another one are not taken over."""
    whole = hashlib.sha256(pathlib.Path(program).read_bytes())
    for path in inputs:
        for data in contents(path):
            whole.update(data)
    return whole.hexdigest()


class Record:
    """What is done: the numbers of each run by its words, in OUTPUT/runs.json."""

    def __init__(self, folder, digest, force):
        """@raises BadStudy if the record is damaged, or of another program or other inputs"""
        self.path, self.digest, self.done, self.guard = folder / RECORD, digest, {}, threading.Lock()
        if force or not self.path.exists():
            return
        try:
            kept = json.loads(read_text(self.path))
            found, self.done = kept["digest"], dict(kept["runs"])
        except (Unreadable, ValueError, TypeError, KeyError, RecursionError) as error:
            raise BadStudy(f"'{self.path}' cannot be read ({error}): --force replaces it, --output DIR writes elsewhere") from error
        if found != digest:
            raise BadStudy(f"output folder '{folder}' holds runs of another program or of other inputs, which are not replaced "
                           "unasked: --force replaces them, --output DIR writes elsewhere")

    def add(self, words, found):
        """Adds a run; any thread may. @raises Unwritten"""
        with self.guard:
            self.done[words] = found
            write(self.path, json.dumps({"digest": self.digest, "runs": self.done}, indent=1))


class Pool:
    """Workers that compute runs. An interruption (SIGINT, SIGTERM) ends the runs that have begun, which save themselves."""

    def __init__(self, workers):
        self.free, self.count = queue.Queue(), len(workers)
        for worker in workers:
            self.free.put(worker)
        self.running, self.guard, self.ended = set(), threading.Lock(), False

    def execute(self, worker, words, environment=None):
        """Runs a command and returns (exit code, standard output, standard error)."""
        with self.guard:
            if self.ended:
                return 130, "", "interrupted"
            process = subprocess.Popen(worker.command(words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                       env=environment)
            self.running.add(process)
        try:
            out, err = process.communicate()
        finally:
            with self.guard:
                self.running.discard(process)
        return process.returncode, out, err

    def end(self):
        with self.guard:
            self.ended = True
            for process in self.running:
                process.terminate()

    def each(self, work, items, done):
        """Computes work(worker, item) for all items and calls done(index, result) in this thread after each. An interruption loses
        no item that had ended: done is called for those too."""
        def compute(item):
            worker = self.free.get()
            try:
                return work(worker, item)
            finally:
                self.free.put(worker)

        def interrupted(*_):
            raise KeyboardInterrupt

        def report(future):
            done(futures[future], future.result())
            del futures[future]

        earlier = {number: signal.signal(number, interrupted) for number in (signal.SIGTERM, signal.SIGHUP)}
        pool, futures = ThreadPoolExecutor(self.count), {}
        try:
            futures |= {pool.submit(compute, item): index for index, item in enumerate(items)}
            for future in as_completed(list(futures)):
                report(future)
        except BaseException as error:
            ended = [future for future in futures if future.done()]
            pool.shutdown(wait=False, cancel_futures=True)
            self.end()
            if isinstance(error, KeyboardInterrupt):
                for future in ended:
                    report(future)
            raise
        finally:
            pool.shutdown(wait=True)
            for number, handler in earlier.items():
                signal.signal(number, handler)


class Progress:
    """How much of a study is done, and how long the rest will take if its runs last as long as those before."""

    def __init__(self, total):
        self.total, self.computed, self.kept, self.begin = total, 0, 0, time.monotonic()

    def after(self, kept):
        """Returns words for one more run; kept: it was computed earlier."""
        self.kept, self.computed = self.kept + kept, self.computed + (not kept)
        left = self.total - self.kept - self.computed
        passed = time.monotonic() - self.begin
        rest = f", about {duration(passed / self.computed * left)} left" if self.computed and left else ""
        return f"{self.kept + self.computed}/{self.total}{rest}"


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"
