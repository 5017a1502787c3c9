"""The sweep tool on a program that answers at once."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "studies"))

import chart  # noqa: E402
import runs  # noqa: E402
import series  # noqa: E402
import stability_map  # noqa: E402
import study_file  # noqa: E402
import sweep  # noqa: E402
import tornado  # noqa: E402
import workers  # noqa: E402
import writing  # noqa: E402

# Error 1 / n^2, cost n; fails for n = 7. The curve is damage = strain / n.
PROGRAM = """#!/usr/bin/python3
import json, pathlib, sys
folder = pathlib.Path(sys.argv[sys.argv.index("--output") + 1]); folder.mkdir(parents=True, exist_ok=True)
n = [float(w.split("=")[1]) for w in sys.argv if w.startswith("Mesh/Elements=")][-1]
if n == 7: sys.exit("no luck")
(folder / "summary.json").write_text(json.dumps({"peak_stress": 2 + 2 / n**2, "wall_seconds": n, "balance": -1 / n}))
(folder / "words").write_text(" ".join(sys.argv))
(folder / "curve.csv").write_text(f"strain,damage\\n0,0\\n1,{1 / n}\\n")
"""
STUDY = """
subsection Study
  set Program   = microcell
  set Input     = case.prm   # a comment
  set Reference = Mesh/Elements=1000000
  set Answers   = peak_stress, damage@0.5
  set Fixed     = Output/Field states=0 Cell/Sizes=16 mm
  set Default   = Mesh/Elements=4
end
subsection Sweep mesh
  set Mesh/Elements = 2 | 4 | 7
end
"""
MAP = """
subsection Study
  set Kind      = map
  set Program   = microcell
  set Input     = case.prm
  set Reference = Mesh/Elements=1000000
  set Answers   = peak_stress 5 %
  set Limits    = balance 0.4
  set Physical  = Mesh/Load
end
subsection Rows
  set plain = Mesh/Elements=1000000
end
subsection Sweep mesh
  set Mesh/Elements = 2 | 4 | 7 | 8
end
subsection Sweep load
  set Mesh/Load + Mesh/Other = 1, 3 | 2, 4
end
"""
TORNADO = """
subsection Study
  set Kind    = tornado
  set Program = microcell
  set Input   = case.prm
  set Answers = peak_stress
  set Fixed   = Mesh/Elements=2
end
subsection Constants
  set fine   = Mesh/Elements=4
  set coarse = Mesh/Elements=1 | Mesh/Elements=2 Mesh/Other=3
  set bad    = Mesh/Elements=7 | Mesh/Elements=3
end
"""

SERIES = """
subsection Study
  set Kind    = series
  set Program = microcell
  set Fixed   = Mesh/Other=3
end
subsection Runs
  set fine = case.prm Mesh/Elements=4
  set bad  = case.prm Mesh/Elements=7
  set shot = penetrate case.prm Mesh/Elements=1 AFC/Damage table=@fine/table.h5
end
"""


class Study(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)
        (self.folder / "case.prm").write_text("")
        for name in ("micro/microcell", "macro/penetrate"):
            program = self.folder / "build" / name
            program.parent.mkdir(parents=True)
            program.write_text(PROGRAM)
            program.chmod(0o755)

    def write(self, text):
        path = self.folder / "sweep.prm"
        path.write_text(text)
        return path

    def runs(self, study, count=2, force=False):
        return runs.Runs(study, self.folder / "build", self.folder / "out", workers.workers_of(count), force)

    def test_overrides_may_hold_spaces(self):
        self.assertEqual(study_file.overrides("Output/Field states=0 Cell/Sizes=16 mm"),
                         {"Output/Field states": "0", "Cell/Sizes": "16 mm"})

    def test_keys_of_sections_inside_sections_are_told_from_units(self):
        self.assertEqual(study_file.overrides("plate/J2/Density=11248 kg/m3 slab/AFC/Shear damage=no A/B=1 1/s plate/J2/Yield stress=3 MPa"),
                         {"plate/J2/Density": "11248 kg/m3", "slab/AFC/Shear damage": "no", "A/B": "1 1/s",
                          "plate/J2/Yield stress": "3 MPa"})
        self.assertEqual(study_file.places("x", 1, "a/J2/E + a/Rings", "2 Pa, 3 | 4 Pa, 5"),
                         [{"a/J2/E": "2 Pa", "a/Rings": "3"}, {"a/J2/E": "4 Pa", "a/Rings": "5"}])

    def test_errors_costs_and_failures(self):
        study = study_file.read_study(self.write(STUDY))
        self.assertEqual(study.fixed, {"Output/Field states": "0", "Cell/Sizes": "16 mm"})
        rows, failures = sweep.run(study, self.runs(study))
        self.assertEqual([row["cost wall_seconds"] for row in rows], [2, 4])
        self.assertAlmostEqual(rows[0]["error peak_stress"], 25, places=6)
        self.assertAlmostEqual(rows[1]["error damage@0.5"], 12.5, places=3)
        self.assertEqual([row["default"] for row in rows], [False, True])
        self.assertEqual(len({row["family"] for row in rows}), 2)
        study.refined_by = ["Mesh/Elements"]
        self.assertEqual({sweep.family_of(study, case, 0) for case in study.cases},
                         {"Cell/Sizes=16 mm, Output/Field states=0"})
        self.assertEqual(len(failures), 1)
        self.assertIn("no luck", failures[0])

    def test_known_values_need_no_reference_run(self):
        study = study_file.read_study(self.write(STUDY.replace("Reference = Mesh/Elements=1000000",
                                                               "Exact = peak_stress 2, damage@0.5 0")))
        rows, _ = sweep.run(study, self.runs(study))
        self.assertAlmostEqual(rows[0]["error peak_stress"], 25)
        self.assertEqual(len(self.runs(study).record.done), 2)  # of two cases that did not fail

    def test_front_holds_what_nothing_beats(self):
        rows = [{"cost": c, "e": e} for c, e in [(1, 9), (2, 10), (3, 4), (4, 4), (5, 1)]]
        self.assertEqual([row["cost"] for row in chart.front(rows, "e", "cost")], [1, 3, 5])

    def test_an_error_that_refinement_undoes_does_not_last(self):
        rows = [{"family": s, "cost t": c, "error a": a, "error b": b}
                for s, c, a, b in [("x", 1, 3, 1), ("x", 2, 0.1, 2), ("x", 4, 5, 1), ("y", 9, 7, 8)]]
        chart.add_lasting_errors(rows, ["a", "b"])
        self.assertEqual([row["error all answers"] for row in rows], [3, 2, 5, 8])
        self.assertEqual([row["lasting a"] for row in rows], [5, 5, 5, 7])
        self.assertEqual([row["lasting b"] for row in rows], [2, 2, 1, 8])

    def test_names_may_hold_the_sign_of_a_comment(self):
        (self.folder / "a#1.prm").write_text("\ufeff" + STUDY, encoding="utf-8")
        (self.folder / "case #2.prm").touch()
        study = study_file.read_study(self.write('include a#1.prm # all of it\nsubsection Study # but\n'
                                                 '  set Input = "case #2.prm" # this\n  set Fixed = A/B=c#d #\nend\n'))
        self.assertEqual((study.input.name, study.fixed), ("case #2.prm", {"A/B": "c#d"}))

    def test_bad_studies_name_the_line(self):
        for text, expected in [(STUDY.replace("Answers", "Anwers"), ":6: unknown key 'Anwers'"),
                               (STUDY.replace("case.prm", "none.prm"), "no file"), (STUDY.replace("case.prm", "x" * 300), "no file"),
                               (STUDY.replace("Mesh/Elements = 2", "Elements = 2"), "allowed: Section/Key"),
                               (STUDY.split("subsection Sweep")[0], "needs a section Constants and no Sweep"),
                               (TORNADO.split("subsection Constants")[0], "needs a section Constants and no Sweep"),
                               (TORNADO.replace("fine   = Mesh/Elements=4", "fine = 4"), ":10: found '4', allowed: Section/Key"),
                               (TORNADO.replace("=2 Mesh", "=2 | Mesh"), ":11: found"),
                               (MAP.replace("2, 4", "2"), ":18: found '2', allowed: 2 values"),
                               (STUDY.replace("Reference", "Exact    "), "NAME NUMBER"),
                               (STUDY.replace("set Reference = Mesh/Elements=1000000", ""), "Study/Exact"),
                               (MAP.replace("balance 0.4", "balance"), "allowed: NAME NUMBER"),
                               (STUDY.replace("subsection Sweep mesh\n", "subsection Sweep mesh\ninclude a.prm\n"),
                                "found 'include a.prm' in the section 'Sweep mesh', allowed: outside of sections"),
                               (STUDY.replace("Elements = 2", "Elements = \"2"), "found \".*, allowed:"),
                               (MAP.replace("set Kind ", "set Repeats = 2\n set Kind "), "unknown key 'Repeats'")]:
            with self.assertRaisesRegex(study_file.BadStudy, expected):
                study_file.read_study(self.write(text))

    def test_map_tells_how_a_run_goes_bad(self):
        study = study_file.read_study(self.write(MAP))
        cells = stability_map.run(study, self.runs(study))
        found = {(cell["row"], cell["value"]): cell for cell in cells if cell["axis"] == "mesh"}
        # 100 / n^2 percent: beyond the tolerance of 5 % below n = 4.5; |balance| = 1 / n is allowed up to 0.4.
        self.assertEqual([found["plain", n]["state"] for n in ("2", "4", "7", "8")],
                         ["warned", "inexact", "failed", "holds"])
        self.assertIn("balance", found["plain", "2"]["why"])
        self.assertIn("no luck", found["plain", "7"]["why"])
        # A physical key changes the reference as well, so nothing is off.
        self.assertEqual({cell["state"] for cell in cells if cell["axis"] == "load"}, {"holds"})
        stability_map.draw(study, cells, self.folder / "out")
        self.assertGreater(os.path.getsize(self.folder / "out" / "map_sweep.png"), 0)

    def test_tornado_sorts_constants_by_what_they_change(self):
        study = study_file.read_study(self.write(TORNADO))
        rows = tornado.run(study, self.runs(study))
        self.assertEqual(rows[0]["peak_stress"], 2.5)  # 2 + 2 / n^2 at n = 2
        bars = tornado.changes(rows, "peak_stress")
        self.assertEqual([constant for constant, _ in bars], ["bad", "fine", "coarse"])
        self.assertEqual(bars[2][1], [(1.5, "Elements = 1"), (0.0, "Elements = 2, Other = 3")])
        self.assertAlmostEqual(bars[0][1][0][0], 2 / 9 - 0.5)  # the side that ran
        tornado.draw(study, rows, "peak_stress", self.folder / "out")
        self.assertGreater(os.path.getsize(self.folder / "out" / "tornado_peak_stress.png"), 0)

    def test_an_included_study_can_be_changed_in_part(self):
        (self.folder / "other.prm").write_text("include sweep.prm\nsubsection Study\n  set Fixed = Mesh/Elements=3\nend\n")
        self.write(TORNADO)
        first, other = (study_file.read_study(self.folder / f"{name}.prm") for name in ("sweep", "other"))
        self.assertEqual((first.fixed, other.fixed), ({"Mesh/Elements": "2"}, {"Mesh/Elements": "3"}))
        self.assertEqual((other.constants, other.answers), (first.constants, first.answers))
        self.write(TORNADO.replace("fine   = Mesh/Elements=4", "fine = 4"))
        with self.assertRaisesRegex(study_file.BadStudy, "other.prm:sweep.prm:10: found '4'"):
            study_file.read_study(self.folder / "other.prm")

    def test_series_keeps_every_run_and_tells_which_failed(self):
        series = study_file.read_series(self.write(SERIES))
        self.assertIsNone(study_file.read_series(self.write(STUDY)))
        self.assertEqual(series.runs["fine"], study_file.Run("microcell", self.folder / "case.prm",
                                                             {"Mesh/Other": "3", "Mesh/Elements": "4"}))
        self.assertEqual(series.runs["shot"].overrides, {"Mesh/Elements": "1", "AFC/Damage table": "@fine/table.h5"})
        self.write(SERIES)
        done = subprocess.run([ROOT / "shared" / "study", self.folder / "sweep.prm", "--build", self.folder / "build",
                               "--output", self.folder / "out"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("bad: exit code 1: no luck", done.stdout)
        self.assertTrue((self.folder / "out" / "fine" / "summary.json").is_file())
        self.assertIn("no report", done.stdout)  # these are no results of a microcell
        words = (self.folder / "out" / "shot" / "words").read_text()
        self.assertIn("macro/penetrate", words)
        self.assertIn(f"AFC/Damage table={self.folder / 'out' / 'fine' / 'table.h5'}", words)
        for wrong in (SERIES.replace("case.prm", "none.prm"), SERIES.replace("Fixed ", "Fixes "),
                      SERIES.replace("@fine", "@later"),
                      SERIES[:SERIES.index("subsection Runs")]):
            with self.assertRaises(study_file.BadStudy):
                study_file.read_series(self.write(wrong))

    def test_program_writes_charts_and_reports_failures(self):
        done = subprocess.run([ROOT / "shared" / "study", self.write(STUDY), "--build", self.folder / "build",
                               "--output", self.folder / "out"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 3, done.stderr)
        for name in ("study.csv", "chart_peak_stress.png", "chart_damage_0_5.svg"):
            self.assertGreater(os.path.getsize(self.folder / "out" / name), 0)
        done = subprocess.run([ROOT / "shared" / "study", self.write(STUDY), "--build", self.folder / "none"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1)

    def study(self, text, *more):
        return subprocess.run([ROOT / "shared" / "study", self.write(text), "--build", self.folder / "build", "--output",
                               self.folder / "out", *more], capture_output=True, text=True, check=False)

    def test_results_of_a_study_are_not_replaced_unasked(self):
        self.assertEqual(self.study(STUDY).returncode, 3)
        (self.folder / "out" / "study.csv").write_text("old")
        (self.folder / "out" / workers.RECORD).unlink()
        done = self.study(STUDY)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("--force", done.stderr)
        self.assertEqual((self.folder / "out" / "study.csv").read_text(), "old")
        self.assertEqual(self.study(STUDY, "--force").returncode, 3)
        self.assertIn("peak_stress", (self.folder / "out" / "study.csv").read_text())

    def test_a_run_that_failed_is_a_row_with_its_reason(self):
        self.study(STUDY)
        with open(self.folder / "out" / "study.csv", newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([(row["label"], row["peak_stress"] != "") for row in rows],
                         [("Mesh/Elements=2", True), ("Mesh/Elements=4", True),
                          ("Output/Field states=0 Cell/Sizes=16 mm Mesh/Elements=7", False)])
        self.assertIn("no luck", rows[2]["failure"])

    def test_an_interrupted_study_keeps_what_it_has(self):
        for n, text in ((4, STUDY), (3, TORNADO)):
            program = PROGRAM.replace("if n == 7:", f"if n == {n}: import os, signal; os.kill(os.getppid(), signal.SIGTERM)\nif n == 7:")
            (self.folder / "build" / "micro" / "microcell").write_text(program)
            # One run after another: those before the interrupted one have ended.
            self.assertEqual(self.study(text, "--force", "--jobs", "1").returncode, 130)
        self.assertIn("Mesh/Elements=2", (self.folder / "out" / "study.csv").read_text())
        self.assertIn("coarse", (self.folder / "out" / "tornado.csv").read_text())

    def test_a_run_without_a_readable_summary_or_curve_fails_alone(self):
        program = self.folder / "build" / "micro" / "microcell"
        for harm in ('(folder / "summary.json").write_text("{")', '(folder / "curve.csv").unlink()'):
            program.write_text(PROGRAM + f"if n == 4: {harm}\n")
            done = self.study(STUDY, "--force")
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("1 runs; results in", done.stdout)
            self.assertEqual(done.stderr, "")

    def test_runs_of_a_series_go_on_from_what_is_there(self):
        folder = self.folder / "run"
        self.assertEqual(series.how(folder, False), [])
        folder.mkdir()
        self.assertEqual(series.how(folder, False), [])
        for file, expected in (("resolved.prm", ["--restart"]), ("history.csv", ["--force"]), ("checkpoint.h5", ["--restart"])):
            (folder / file).write_text("")
            self.assertEqual(series.how(folder, False), expected)
        self.assertEqual(series.how(folder, True), ["--force"])

    def test_a_folder_in_use_is_refused(self):
        (self.folder / "out").mkdir()
        with writing.own(self.folder / "out", [], False):
            done = self.study(SERIES)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("belongs to another run", done.stderr)
        self.assertEqual(list((self.folder / "out").iterdir()), [])


if __name__ == "__main__":
    unittest.main()
