"""Runs one case of the catalogue: a command in a folder of its own, and whether it ended as the contract says.

The contract of all programs: 0 done; 2 bad input, one line that says what, nothing on the disk changed; 3 failed, what was
computed is kept and a line says why; 130 interrupted. Never a signal, a traceback, or a word that a terminal would obey."""

import hashlib
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "shared" / "compare"))  # for sealed.py

PROGRAMS = {"penetrate": "macro/penetrate", "microcell": "micro/microcell", "material_point": "macro/material_point"}
SCRIPTS = {"study": "shared/study", "compare.py": "shared/compare/compare.py", "sealed.py": "shared/compare/sealed.py", "formulas": "shared/formulas",
           "concrete": "shared/concrete", "tension": "shared/tension", "run": "shared/run"}
# One thread each: the cases run side by side.
ENVIRONMENT = os.environ | {"DEAL_II_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MPLBACKEND": "Agg", "PYTHONDONTWRITEBYTECODE": "1",
                            "OPENBLAS_NUM_THREADS": "1"}
LONGEST_LINE = 2000  # characters of a message
SECONDS = 40  # that a case may take on a busy machine


@dataclass
class Case:
    """A command and how it must end."""

    kind: str
    name: str
    program: str
    words: list  # arguments; {data}, {fixtures} and {here} stand for folders
    code: int = 2
    says: list = field(default_factory=list)  # parts of what is said on standard error
    hides: list = field(default_factory=list)  # parts that must not be said
    files: dict = field(default_factory=dict)  # made in the folder before: name -> text or bytes
    before: object = None  # called with the folder before the command; may return a lock that is held until its end
    after: object = None  # called with the folder afterwards; returns what is wrong
    limits: dict = field(default_factory=dict)  # RLIMIT_... -> value
    environment: dict = field(default_factory=dict)
    streams: dict = field(default_factory=dict)  # descriptor -> "closed", or a file that it is opened on
    signal: object = None  # called with the process and the folder: sends signals
    memory: int = 8 << 30  # address space, bytes


def snapshot(folder):
    """Returns what is in a folder: names, kinds, contents and times."""
    found = {}
    for path in sorted(folder.rglob("*")):
        status = path.lstat()
        content = b""
        if path.is_symlink():
            content = os.readlink(path).encode()
        elif path.is_file():
            content = hashlib.sha256(path.read_bytes()).digest()
        found[str(path.relative_to(folder))] = (status.st_mode, content, status.st_mtime_ns if path.is_file() else 0)
    return found


def is_visible(text):
    """Whether a terminal only shows a text: no control characters but the ends of lines."""
    return not re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ufffd]", text)


class Server:
    """A process that runs one program, or the scripts, again and again (fork_server.cc, script_server.py)."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=ENVIRONMENT)

    def run(self, folder, words, memory):
        """Returns how the command has ended in folder/work: an exit code, minus a signal, or "no end"."""
        texts = [folder / "work", folder / "stdout", folder / "stderr", memory, *words]
        (folder / "request").write_bytes(b"".join(os.fsencode(str(text) if not isinstance(text, bytes) else text) + b"\0"
                                                  for text in texts))
        self.process.stdin.write(os.fsencode(folder / "request") + b"\n")
        self.process.stdin.flush()
        child = int(self.process.stdout.readline())
        late = []

        def end():
            late.append(child)
            os.kill(child, signal.SIGKILL)

        timer = threading.Timer(SECONDS, end)
        timer.start()
        code = int(self.process.stdout.readline())
        timer.cancel()
        return "no end" if late else code

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Runner:
    """Runs cases below a scratch folder, in as many threads as call it."""

    def __init__(self, build, scratch, fixtures):
        self.build, self.scratch, self.fixtures = build, scratch, fixtures
        self.number, self.guard = 0, threading.Lock()
        self.own, self.servers = threading.local(), []

    def server(self, program):
        """The server of a program for this thread."""
        name = f"serve_{program}" if program in PROGRAMS else "scripts"
        if not hasattr(self.own, name):
            command = ([self.build / "tests" / "robustness" / name] if program in PROGRAMS
                       else [sys.executable, "-B", pathlib.Path(__file__).with_name("script_server.py")])
            setattr(self.own, name, Server(command))
            with self.guard:
                self.servers.append(getattr(self.own, name))
        return getattr(self.own, name)

    def close(self):
        for server in self.servers:
            server.close()

    def folder(self):
        with self.guard:
            self.number += 1
            folder = self.scratch / str(self.number)
        (folder / "work").mkdir(parents=True)
        return folder

    def command(self, case, work):
        program = self.build / PROGRAMS[case.program] if case.program in PROGRAMS else ROOT / SCRIPTS[case.program]
        places = {"{data}": ROOT / "data", "{fixtures}": self.fixtures, "{here}": work, "{build}": self.build}
        words = []
        for word in case.words:
            for name, place in places.items():
                word = word.replace(name, str(place)) if isinstance(word, str) else word
            words.append(word)
        return [str(program), *words]

    def run(self, case):
        """Returns what is wrong, one text for each fault; empty: it ended as the contract says."""
        folder = self.folder()
        try:
            return self.judge(case, folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def judge(self, case, folder):
        work = folder / "work"
        for name, content in case.files.items():
            (work / name).parent.mkdir(parents=True, exist_ok=True)
            (work / name).write_bytes(content.encode() if isinstance(content, str) else content)
        held = case.before(work) if case.before else None
        before = snapshot(work)
        code, said, _ = self.execute(case, folder, work)
        if hasattr(held, "close"):
            held.close()
        wrong = self.faults(case, code, said)
        if code == 2 and snapshot(work) != before:
            after = snapshot(work)
            changed = sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
            wrong.append(f"changed {', '.join(changed[:5])}")
        try:
            if not wrong and case.after and (fault := case.after(work)):
                wrong.append(fault)
        except Exception as error:  # whatever it looks at is damaged
            wrong.append(f"{type(error).__name__}: {error}")
        return [f"{text}; said: {said[-600:]!r}" for text in wrong]

    def execute(self, case, folder, work):
        """Returns the exit code, standard error and standard output."""
        special = case.streams or case.limits or case.environment or case.signal or case.program == "run"
        words = self.command(case, work)
        code = self.start(case, folder, work, words) if special else self.server(case.program).run(folder, words, case.memory)
        return code, *((folder / name).read_bytes().decode("utf-8", "replace") for name in ("stderr", "stdout"))

    @staticmethod
    def start(case, folder, work, words):
        """Starts a program of its own, for cases that are about its start, its end or its limits."""
        def prepare():
            for number, place in case.streams.items():
                if place == "closed":
                    os.close(number)
                else:
                    os.dup2(os.open(place, os.O_RDWR), number)
            for limit, value in ({resource.RLIMIT_AS: case.memory} | case.limits).items():
                resource.setrlimit(limit, (value, value))

        with open(folder / "stdout", "wb") as out, open(folder / "stderr", "wb") as error:
            process = subprocess.Popen(words, cwd=work, stdin=subprocess.DEVNULL, stdout=out, stderr=error, preexec_fn=prepare,
                                       env=ENVIRONMENT | case.environment)
            try:
                if case.signal:
                    case.signal(process, work)
                return process.wait(SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                return "no end"

    @staticmethod
    def faults(case, code, said):
        wrong = []
        if code not in (case.code if isinstance(case.code, tuple) else (case.code,)):
            ending = signal.Signals(-code).name if isinstance(code, int) and code < 0 else code
            wrong.append(f"ended with {ending}, expected {case.code}")
        if "Traceback" in said:
            wrong.append("a traceback")
        if not is_visible(said):
            wrong.append("a character that a terminal obeys, or that is no UTF-8")
        if code == 2 and case.program != "run" and 2 not in case.streams:
            lines = [line for line in said.splitlines() if not line.startswith("usage: ") and not line.startswith(" ")]
            if len(lines) != 1 or not lines[0].startswith(case.program + ": "):
                wrong.append(f"{len(lines)} lines instead of one that begins with the program's name")
            elif len(lines[0]) > LONGEST_LINE:
                wrong.append(f"a line of {len(lines[0])} characters")
        for part in case.says:
            if part not in said:
                wrong.append(f"does not say {part!r}")
        wrong += [f"says {part!r}" for part in case.hides if part in said]
        return wrong
