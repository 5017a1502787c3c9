"""Runs of a study side by side, on several machines, interrupted and taken up again."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "studies"))

import workers  # noqa: E402
from study_file import BadStudy  # noqa: E402

# Each run leaves a file when it begins. A/How=meet: it ends when two have begun; wait: it runs until it is ended.
PROGRAM = """#!/usr/bin/python3
import json, os, pathlib, sys, time
folder = pathlib.Path(sys.argv[sys.argv.index("--output") + 1]); folder.mkdir(parents=True, exist_ok=True)
said = {w.split("=")[0]: w.split("=")[1] for w in sys.argv if "=" in w}
here = pathlib.Path(__file__).parent
(here / f"began_{said['A/N']}_{os.getpid()}").touch()
end = time.monotonic() + 20
if said.get("A/How") == "meet":
    while len(list(here.glob("began_*"))) < 2:
        if time.monotonic() > end: sys.exit("alone")
        time.sleep(0.01)
if said.get("A/How") == "wait" and not (here / "go").exists():
    time.sleep(60)
if said["A/N"] == "3" and not (here / "repaired").exists(): sys.exit("broken")
(folder / "summary.json").write_text(json.dumps({"exit": float(said["A/N"]), "threads": said.get("Run/Threads", "all")}))
"""
STUDY = """
subsection Study
  set Kind    = tornado
  set Program = penetrate
  set Input   = case.prm
  set Answers = exit
  set Fixed   = A/N=0 A/How=HOW
end
subsection Constants
  set one = A/N=1 | A/N=2
  set two = A/N=3
end
"""


class SideBySide(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.out = self.folder / "out"
        self.program = self.folder / "build" / "macro" / "penetrate"
        self.program.parent.mkdir(parents=True)
        self.program.write_text(PROGRAM)
        self.program.chmod(0o755)
        (self.folder / "part.prm").write_text("x")
        (self.folder / "case.prm").write_text('include part.prm # a part\nset Table = "table #1.h5" # a table\n')
        (self.folder / "table #1.h5").write_bytes(b"\xff")

    def command(self, how, *more):
        (self.folder / "study.prm").write_text(STUDY.replace("HOW", how))
        return [ROOT / "shared" / "study", self.folder / "study.prm", "--build", self.folder / "build", "--output", self.out, *more]

    def study(self, how, *more, **environment):
        return subprocess.run(self.command(how, *more), capture_output=True, text=True, check=False, env=os.environ | environment)

    def began(self):
        return len(list(self.program.parent.glob("began_*")))

    def test_as_many_runs_as_jobs_are_computed_at_once(self):
        done = self.study("meet", "--jobs", "2")  # a run ends when it has seen another one
        self.assertNotIn("alone", done.stdout + done.stderr)
        self.assertEqual((done.returncode, self.began()), (0, 4), done.stderr)
        self.assertIn("4/4", done.stdout)
        self.assertIn('"threads": "1"', (self.out / "run_1" / "summary.json").read_text())

    def test_one_worker_computes_one_at_a_time(self):
        pool, inside, most = workers.Pool(workers.workers_of(1)), [], []

        def work(_, item):
            inside.append(item)
            most.append(len(inside))
            time.sleep(0.01)
            inside.remove(item)

        pool.each(work, range(5), lambda *_: None)
        self.assertEqual(most, [1] * 5)

    def test_what_is_done_is_kept_and_what_failed_is_tried_again(self):
        first = self.study("", "--jobs", "2")
        self.assertEqual((first.returncode, self.began()), (0, 4), first.stderr)
        self.assertIn("failed: A/N=3", first.stdout)
        self.assertIn("\ntwo,0,N = 3,\n", (self.out / "tornado.csv").read_text().replace("\r", ""))
        (self.program.parent / "repaired").touch()
        second = self.study("", "--jobs", "2")
        self.assertEqual((second.returncode, self.began()), (0, 5), second.stderr)
        self.assertIn("\ntwo,0,N = 3,3.0\n", (self.out / "tornado.csv").read_text().replace("\r", ""))

    def test_runs_of_other_inputs_are_not_taken_over(self):
        self.study("")
        for name in ("part.prm", "table #1.h5"):
            kept = (self.folder / name).read_bytes()
            (self.folder / name).write_bytes(b"other")
            refused = self.study("")
            self.assertEqual((refused.returncode, refused.stderr.count("\n"), self.began()), (2, 1, 4), refused.stderr)
            self.assertIn("--force", refused.stderr)
            (self.folder / name).write_bytes(kept)
        self.assertEqual((self.study("", "--force").returncode, self.began()), (0, 8))

    def test_a_damaged_record_is_refused(self):
        self.study("", "--jobs", "1")
        record = self.out / workers.RECORD
        for text in (record.read_text()[:-5], "[]", ""):
            record.write_text(text)
            refused = self.study("")
            self.assertEqual((refused.returncode, refused.stderr.count("\n"), self.began()), (2, 1, 4), refused.stderr)
            self.assertEqual(record.read_text(), text)
        self.assertEqual(self.study("", "--force").returncode, 0)

    def test_an_interrupted_study_leaves_no_run_behind(self):
        for end in (signal.SIGINT, signal.SIGTERM):
            for mark in self.program.parent.glob("began_*"):
                mark.unlink()
            # A shell lets what it starts in the background ignore SIGINT; the study must not inherit that here.
            process = subprocess.Popen(self.command("wait", "--jobs", "2", "--force"), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
            while self.began() < 2:
                time.sleep(0.01)
            process.send_signal(end)
            process.communicate(timeout=30)
            self.assertEqual(process.returncode, 130)
            for mark in self.program.parent.glob("began_*"):
                self.assertFalse(pathlib.Path(f"/proc/{mark.name.split('_')[-1]}").exists())
        (self.program.parent / "go").touch()
        self.assertEqual(self.study("wait").returncode, 0)

    def test_runs_go_to_the_hosts_of_a_list(self):
        ssh = self.folder / "bin" / "ssh"  # says where it was sent, and does it here
        ssh.parent.mkdir()
        ssh.write_text(f'#!/bin/sh\necho "$3" >> {self.folder}/hosts\nexec sh -c "$4"\n')
        ssh.chmod(0o755)
        (self.folder / "hosts.txt").write_text("node1 2  # two at a time\n\nme@node2\n")
        done = self.study("meet", "--hosts", str(self.folder / "hosts.txt"), PATH=f"{ssh.parent}:{os.environ['PATH']}")
        self.assertEqual((done.returncode, self.began()), (0, 4), done.stderr)
        self.assertEqual(set((self.folder / "hosts").read_text().split()), {"node1", "me@node2"})

    def test_bad_hosts_name_the_line(self):
        path = self.folder / "hosts.txt"
        for text, expected in [("a\nb c\n", ":2: found 'b c', allowed"), ("a 0\n", ":1: found"), ("# none\n", "no hosts"), ('"a\n', ":1: "),
                               ("-oProxyCommand=x\n", ":1: found")]:
            path.write_text(text)
            with self.assertRaisesRegex(BadStudy, expected):
                workers.read_hosts(path)
        with self.assertRaisesRegex(BadStudy, "cannot read"):
            workers.read_hosts(self.folder / "none.txt")
        self.assertEqual([worker.host for worker in workers.workers_of(2)], ["localhost"] * 2)


class TimeLeft(unittest.TestCase):
    def test_it_is_that_of_the_runs_before_and_kept_runs_do_not_count(self):
        progress = workers.Progress(12)
        progress.begin -= 100
        self.assertEqual([progress.after(True), progress.after(True)], ["1/12", "2/12"])
        self.assertEqual(progress.after(False), "3/12, about 15 min left")
        self.assertEqual([workers.duration(s) for s in (5, 600, 7200)], ["5 s", "10 min", "2.0 h"])


if __name__ == "__main__":
    unittest.main()
