"""Studies of scaling with a program and a launcher that answer at once."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "studies"))

import scaling  # noqa: E402
import study_file  # noqa: E402

# Dies on three ranks; otherwise the first rank answers how many it is one of.
PROGRAM = """#!/usr/bin/python3
import json, os, pathlib, sys
ranks = int(os.environ.get("RANKS", 1))
if ranks == 3: sys.exit("no luck")
folder = pathlib.Path(sys.argv[sys.argv.index("--output") + 1]); folder.mkdir(parents=True, exist_ok=True)
keys = ("wall_seconds compute_seconds_max compute_seconds_mean owned_points_max ghost_points_max bytes_per_step_max "
        "bytes_per_step_mean messages_per_step_max messages_per_step_mean bytes_per_step_velocities "
        "bytes_per_step_forces bytes_per_step_refreshes messages_per_step_refreshes collectives_per_step_reductions "
        "collectives_per_step_refreshes gathered_bytes_per_step_refreshes").split()
(folder / "summary.json").write_text(json.dumps(dict.fromkeys(keys, 1.5) | {
    "ranks": ranks, "points": 1000, "steps": 10, "created": "today",
    "yields": os.environ.get("OMPI_MCA_mpi_yield_when_idle", "0"), "words": sys.argv[1:]}))
"""
LAUNCHER = """#!/bin/sh
[ "$1 $2" = "--oversubscribe -n" ] || exit 1
export RANKS=$3
shift 3
exec "$@"
"""
STUDY = """
subsection Study
  set Kind    = scaling
  set Program = penetrate
  set Input   = case.prm
  set Fixed   = Run/Threads=1
  set Repeats = 2
end
subsection Strong timed
  set 1 | 2 = slab/Rings=30
end
subsection Weak counted
  set 3 = slab/Rings=9
  set 8 = slab/Rings=20
end
subsection Model
  set Points    = 1e8
  set Ranks     = 1000 | 10000
  set Latency   = 2e-6
  set Bandwidth = 1e9   # bytes/s
end
"""


class Scaling(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "case.prm").write_text("")
        for path, text in (("build/macro/penetrate", PROGRAM), ("bin/mpirun", LAUNCHER)):
            (self.folder / path).parent.mkdir(parents=True)
            (self.folder / path).write_text(text)
            (self.folder / path).chmod(0o755)

    def read(self, text):
        path = self.folder / "study.prm"
        path.write_text(text)
        return scaling.read(path)

    def test_lines_are_runs(self):
        study = self.read(STUDY)
        self.assertEqual([(run.series, run.timed, run.ranks, run.overrides) for run in study.runs],
                         [("strong", True, 1, {"slab/Rings": "30"}), ("strong", True, 2, {"slab/Rings": "30"}),
                          ("weak", False, 3, {"slab/Rings": "9"}), ("weak", False, 8, {"slab/Rings": "20"})])
        self.assertEqual(study.assumptions, {"points": 1e8, "ranks": [1000, 10000], "latency": 2e-6, "bandwidth": 1e9})
        self.assertIsNone(self.read(STUDY.replace("= scaling", "= series")))

    def test_bad_studies_name_the_line(self):
        for text, expected in [(STUDY.replace("Fixed", "Fixes"), ":6: unknown key 'Fixes'"),
                               (STUDY.replace("Weak counted", "Weak"), ":13: unknown section 'Weak'"),
                               (STUDY.replace("set 8", "set eight"), ":14: "),
                               (STUDY.replace("  set Latency   = 2e-6\n", ""), "'Model/Latency' must be set"),
                               (STUDY.replace("case.prm", "none.prm"), "no file"), (STUDY.replace("case.prm", "x" * 300), "no file")]:
            with self.assertRaisesRegex(study_file.BadStudy, expected):
                self.read(text)

    def test_runs_are_repeated_recorded_and_reported(self):
        self.read(STUDY)
        path = f"{self.folder / 'bin'}:{os.environ['PATH']}"
        done = subprocess.run([ROOT / "shared" / "study", self.folder / "study.prm", "--build", self.folder / "build",
                               "--output", self.folder / "out"], capture_output=True, text=True, check=False,
                              env=os.environ | {"PATH": path})
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("weak, 3 ranks: exit code 1: no luck", done.stdout)
        record = json.loads((self.folder / "out" / "scaling.json").read_text())
        self.assertEqual([(run["ranks"], run["summary"]["ranks"], run["summary"]["yields"]) for run in record["runs"]],
                         [(1, 1, "0"), (1, 1, "0"), (2, 2, "0"), (2, 2, "0"), (8, 8, "1")])
        self.assertIn("Run/Threads=1", record["runs"][0]["summary"]["words"])
        self.assertTrue((self.folder / "out" / "report" / "report.html").is_file())


if __name__ == "__main__":
    unittest.main()
