"""Curves of the paper that users have read off: format, numbers, report. The curves here are made up."""

import math
import pathlib
import subprocess
import sys
import unittest

import numpy as np

import synthetic

sys.dont_write_bytecode = True
COMPARE = pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"
sys.path.insert(0, str(COMPARE))

import digitised  # noqa: E402
import sections_digitised  # noqa: E402
from files import Unreadable  # noqa: E402
from reading import read_result  # noqa: E402
from references import EXPERIMENTS, References  # noqa: E402

MIDM = "fig08_tension_midm"


class Curves(synthetic.InFolder):
    def write(self, name, text):
        path = self.folder / f"{name}.csv"
        path.write_text(text, encoding="utf-8")
        return path

    def curve(self, x, y, name=MIDM):
        return digitised.Curve(name, digitised.FORMS[name], np.array(x, float), np.array(y, float))


class Files(Curves):
    def test_comments_capitals_and_semicolons_are_read(self):
        path = self.write(MIDM, "# made up\n\"Strain\"; STRESS_MPA\n0;0\n\n1e-4; 2.5\n")
        curve = digitised.read_curve(path)
        self.assertEqual((curve.form.figure, list(curve.x), list(curve.y)), (8, [0, 1e-4], [0, 2.5]))

    def test_what_is_wrong_is_said_in_one_line_with_its_place(self):
        for text, words in (
                ("", [":1: column 1: found 'the end of the file'", "strain,stress_mpa"]),
                ("strain,stress_pa\n0,0\n1,1\n", [":1: column 2: found 'stress_pa', allowed: stress_mpa"]),
                ("strain\n0\n1\n", [":1: column 2: found 'nothing', allowed: stress_mpa"]),
                ("strain,stress_mpa,more\n", [":1: column 3: found 'more'", "two columns"]),
                ("# x\nstrain,stress_mpa\n0,0\n1e-4,x\n", [":4: column 'stress_mpa': found 'x', allowed: a finite number"]),
                ("strain,stress_mpa\n0,0\n1e-4,nan\n", [":3: column 'stress_mpa': found 'nan'"]),
                ("strain;stress_mpa\n0;0\n0,1;1\n", [":3: column 'strain': found '0,1'", "no comma"]),
                ("strain,stress_mpa\n0,0\n0,1,1\n", [":3: column 3: found '1'", "no commas"]),
                ("strain,stress_mpa\n0,0\n1\n", [":3: column 2: found 'nothing', allowed: two numbers"]),
                ("strain,stress_mpa\n0,0\n2,1\n2,0\n", [":4: column 'strain': found '2', allowed: more than 2"]),
                ("strain,stress_mpa\n0,0\n", [":2: column 1: found 'the end of the file', allowed: two rows"])):
            with self.assertRaises(Unreadable) as refused:
                digitised.read_curve(self.write(MIDM, text))
            for word in [f"{MIDM}.csv", *words]:
                self.assertIn(word, str(refused.exception), text)
            self.assertNotIn("\n", str(refused.exception))

    def test_a_curve_that_is_of_no_figure_is_refused(self):
        with self.assertRaisesRegex(Unreadable, "fig09.*allowed: fig04_hydrostat"):
            digitised.read_curve(self.write("fig09", "a,b\n0,0\n1,1\n"))

    def test_nothing_is_shipped_and_the_readme_states_every_file_with_its_columns(self):
        readme = (digitised.FOLDER / "README.md").read_text(encoding="utf-8")
        tracked = subprocess.run(["git", "ls-files", "*.csv"], cwd=digitised.FOLDER, capture_output=True, text=True)
        self.assertEqual(tracked.stdout, "")
        for name, form in digitised.FORMS.items():
            line, = [line for line in readme.splitlines() if f"`{name}.csv`" in line]
            self.assertIn(f"| `{','.join(form.columns)}` |", line)
            for ours in form.ours:
                self.assertIn(f"`{ours}.csv`", line)

    def test_a_bad_file_ends_the_report_before_it_is_begun(self):
        synthetic.material(self.folder / "material")
        bad = self.write(MIDM, "strain,stress_mpa\n0,0\n1e-4,two\n")
        ran = subprocess.run(["/usr/bin/python3", COMPARE / "compare.py", self.folder / "material", "--digitised", self.folder,
                              "--output", self.folder / "report"], capture_output=True, text=True)
        self.assertEqual((ran.returncode, ran.stderr), (2, f"compare.py: {bad}:3: column 'stress_mpa': found 'two', allowed: a "
                                                           "finite number\n"))
        self.assertFalse((self.folder / "report").exists())

    def test_a_good_file_is_in_the_report(self):
        """Of material points and of a slab, which the report treats at different places."""
        synthetic.material(self.folder / "material")
        slab = synthetic.slab(self.folder / "slab")
        synthetic.change_summary(slab, projectile_mass=2.34, projectile_radius=0.0254, projectile_length=0.3556)
        self.write(MIDM, "strain,stress_mpa\n0,0\n1e-4,3\n")
        self.write("fig17_127", "time_ms,velocity_m_s\n0,313\n1,250\n")
        subprocess.run(["/usr/bin/python3", COMPARE / "compare.py", self.folder / "material", slab, "--digitised", self.folder,
                        "--output", self.folder / "report"], capture_output=True, check=True)
        page = (self.folder / "report" / "report.html").read_text(encoding="utf-8")
        for words in ("Difference from digitised curves", "AFC with MIDM", "NMAP, 127 mm"):
            self.assertIn(words, page)


class Numbers(Curves):
    def test_a_curve_differs_from_itself_by_nothing(self):
        curve = self.curve([0, 1, 3], [0, 4, 2])
        found = digitised.difference(curve, curve.x, curve.y)
        self.assertEqual((found.mean_square_root, found.largest, found.peak), (0, 0, 4))

    def test_a_shift_is_both_numbers_and_a_wedge_has_the_mean_of_its_square(self):
        curve = self.curve([0, 2], [10, 10])
        shift = digitised.difference(curve, [0, 0.3, 2], [11, 11, 11])
        self.assertAlmostEqual(shift.mean_square_root, 1)
        self.assertAlmostEqual(shift.largest, 1)
        wedge = digitised.difference(curve, [0, 2], [10, 13])
        self.assertAlmostEqual(wedge.mean_square_root, 3 / math.sqrt(3))
        self.assertEqual((wedge.largest, wedge.place), (3, 2))

    def test_points_added_on_either_curve_change_nothing(self):
        x, y = np.array([0, 1, 2, 3.0]), np.array([0, 3, 1, 1.0])
        curve = self.curve([0.5, 2.5], [1, 2])
        coarse = digitised.difference(curve, x, y)
        fine = np.linspace(0, 3, 3001)
        fine = digitised.difference(self.curve(np.linspace(0.5, 2.5, 777), np.linspace(1, 2, 777)), fine, np.interp(fine, x, y))
        self.assertAlmostEqual(coarse.mean_square_root, fine.mean_square_root, 12)
        self.assertAlmostEqual(coarse.largest, fine.largest, 12)
        self.assertEqual((coarse.first, coarse.last), (0.5, 2.5))

    def test_only_the_common_range_counts(self):
        curve = self.curve([1, 2], [5, 5])
        self.assertEqual(digitised.difference(curve, [0, 1, 2, 3], [100, 5, 5, 100]).largest, 0)
        self.assertIsNone(digitised.difference(curve, [2, 3], [5, 5]))
        self.assertIsNone(digitised.difference(curve, [], []))

    def test_unloading_is_left_out(self):
        x, y = digitised.first_passage([0, 1, 0.5, 1, 2], [0, 10, 1, 10, 20])
        self.assertEqual((list(x), list(y)), ([0, 1, 2], [0, 10, 20]))


class Section(Curves):
    """What the report says, with a made-up curve of each kind."""

    def run_of(self, name, thickness):
        folder = synthetic.slab(self.folder / name, thickness=thickness)
        synthetic.change_summary(folder, projectile_mass=2.34, projectile_radius=0.0254, projectile_length=0.3556)
        return read_result(folder)

    class Out:
        def __init__(self, curves):
            self.references = References.read(EXPERIMENTS)
            self.references.digitised = curves
            self.report, self.tables, self.names = self, [], []

        def heading(self, _):
            pass

        def table(self, table):
            self.tables.append(table)

        def draw(self, drawn, name, _):
            self.names.append(name)
            drawn.canvas.draw()

    def test_every_curve_has_a_result_beside_it_and_a_row(self):
        for name, form in digitised.FORMS.items():
            end = 1 if form.thickness else 1e-3
            self.write(name, f"{','.join(form.columns)}\n0,10\n{end},20\n")
        results = [read_result(synthetic.material(self.folder / "material"))]
        for thickness in (127, 216, 254):
            results.append(self.run_of(f"slab_{thickness}", 1e-3 * thickness))
        out = self.Out(digitised.read(self.folder))
        sections_digitised.section(out, results)
        table, = out.tables
        self.assertEqual({row[1] for row in table.rows}, {form.label for form in digitised.FORMS.values()})
        self.assertEqual({len(row) for row in table.rows}, {len(table.columns)})
        self.assertEqual(len(out.names), 4 + 3)
        of_254 = [row for row in table.rows if row[2] == "Spall, slab_254"]
        self.assertEqual([row[0] for row in of_254], ["17"])

    def test_a_run_of_another_shot_and_no_curves_leave_no_section(self):
        run = self.run_of("thin", 0.1)
        self.write("fig15_low", "time_ms,velocity_m_s\n0,313\n1,200\n")
        out = self.Out(digitised.read(self.folder))
        sections_digitised.section(out, [run])
        self.assertEqual((out.tables, out.names), ([], []))

    def test_the_number_is_that_of_the_two_curves(self):
        """Both linear in the strain: 2 MPa apart at the end, nothing at the start."""
        self.write("fig04_hydrostat", "volumetric_strain,pressure_mpa\n0,0\n1e-3,12\n")
        folder = synthetic.material(self.folder / "material")
        zero = np.zeros(2)
        synthetic.write_csv(folder / "hydrostat.csv", {"time": np.array([0, 1.0]), "exx": np.array([0, -1e-3])} | {
            name: zero for name in ("eyy", "ezz", "sxx", "syy", "szz", "sxy", "syz", "sxz")} | {"pressure": np.array([0, 10e6])})
        out = self.Out(digitised.read(self.folder))
        sections_digitised.section(out, [read_result(folder)])
        row = next(row for row in out.tables[0].rows if row[2].startswith("Eq. 21 from"))
        self.assertEqual(row[3:], ["0 to 0.001", "1.15", "9.6", "2 at 0.001", "16.7"])


if __name__ == "__main__":
    unittest.main()
