"""The command shared/formulas: scenes, numbers, refusals and the CSV file."""

import contextlib
import csv
import io
import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "empirical"))

import formulas_command  # noqa: E402
import scene_shot  # noqa: E402
import writing  # noqa: E402

SCENES = ROOT / "data" / "scenes"
NUMBERS = ("--diameter", "50.8mm", "--mass", "2.34kg", "--velocity", "313m/s", "--thickness", "127mm", "--strength", "38.2MPa",
           "--density", "2267kg/m3", "--crh", "3")


class Command(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_command(self, *arguments):
        out, error = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
            code = writing.run_script("formulas", lambda: formulas_command.main([str(a) for a in arguments]))
        return code, out.getvalue(), error.getvalue()

    def table(self, *arguments):
        """Returns {formula: {column: text}} of the CSV file of a command."""
        path = self.folder / "table.csv"
        self.assertEqual(self.run_command(*arguments, "--csv", path, "--force")[::2], (0, ""))
        with open(path, encoding="utf-8") as stream:
            return {row.pop("formula"): row for row in csv.DictReader(stream)}

    def refused(self, *arguments):
        code, out, error = self.run_command(*arguments)
        self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
        return error

    def test_a_scene_and_its_numbers_give_the_same_table(self):
        table = self.table(SCENES / "slab_127.prm")
        self.assertEqual(table, self.table(*NUMBERS))
        self.assertEqual(len(table), 10)
        self.assertAlmostEqual(float(table["Forrestal 1994"]["residual_m_s"]), 196.98, 2)
        self.assertAlmostEqual(float(table["modified NDRC"]["depth_mm"]), 159.517, 3)
        self.assertEqual(table["Chang"]["depth_mm"], "")
        code, out, _ = self.run_command(SCENES / "slab_127.prm")
        self.assertEqual(code, 0)
        self.assertIn("strength: the nominal 38.2 MPa", out)
        self.assertRegex(out, r"\nForrestal 1994 +178 +- +178 +241 +197 ")

    def test_keys_and_options_replace_those_of_the_scene(self):
        base = self.table(SCENES / "slab_127.prm")
        changed = self.table(SCENES / "slab_127.prm", "projectile/Velocity=400 m/s")
        self.assertEqual(changed, self.table(SCENES / "slab_127.prm", "--velocity", "400m/s"))
        self.assertGreater(float(changed["ACE"]["depth_mm"]), float(base["ACE"]["depth_mm"]))
        stronger = self.table(SCENES / "slab_127.prm", "slab/AFC/Compressive strength=60 MPa")
        self.assertEqual(stronger, self.table(SCENES / "slab_127.prm", "--strength", "60MPa"))
        self.assertEqual(stronger, self.table(SCENES / "slab_127.prm", "AFC/Compressive strength=60 MPa", "--strength", "60MPa"))

    def test_the_mass_of_the_plug_slows_recht_and_ipson(self):
        one, other = self.table(*NUMBERS), self.table(*NUMBERS, "--plug", "2.34kg")
        self.assertAlmostEqual(float(other["ACE"]["residual_m_s"]) / float(one["ACE"]["residual_m_s"]), 0.5, 4)
        self.assertEqual(other["Forrestal 1994"], one["Forrestal 1994"])

    def test_shapes_of_scenes(self):
        for name, words in (("sphere_140", "hemisphere nose (N* 0.5), 859 m/s; concrete: 140 mm thick"),
                            ("depth_block", "26.9 mm, 0.906 kg, sharp nose (N* 0.156), 277 m/s; concrete: 500 mm thick"),
                            ("slab_127_oblique", "note: the obliquity is left out"),
                            ("slab_127_deformable", "note: the projectile counts as rigid")):
            code, out, error = self.run_command(SCENES / f"{name}.prm")
            self.assertEqual((code, error), (0, ""))
            self.assertIn(words, out)
        for words, said in (("projectile/Nose=flat", "flat nose (N* 1)"), ("projectile/Nose=hemisphere", "hemisphere nose")):
            self.assertIn(said, self.run_command(SCENES / "slab_127.prm", words)[1])
        cone = self.run_command(SCENES / "slab_127.prm", "projectile/Nose=cone", "projectile/Nose length=50.8 mm")
        self.assertIn("sharp nose (N* 0.2)", cone[1])

    def test_a_result_folder_is_read(self):
        (self.folder / "resolved.prm").write_text(
            "subsection Answers\n set Exit = dart through wall\nend\nsubsection wall\n set Height = 0.1 m\n subsection AFC\n"
            "  set Density = 2400 kg/m3\n  set Compressive strength = 3e7 Pa\n end\nend\nsubsection dart\n set Shape = sphere\n"
            " set Diameter = 0.02 m\n set Mass = REQUIRED\n set Mean density = 7850 kg/m3\n set Velocity = 800 m/s\nend\n")
        code, out, error = self.run_command(self.folder)
        self.assertEqual((code, error), (0, ""))
        self.assertIn("20 mm, 0.032882 kg, hemisphere nose", out)
        self.assertIn("100 mm thick, 30 MPa, 2400 kg/m3", out)
        self.assertNotIn("note:", out)

    def test_refusals_name_what_was_found_and_what_is_allowed(self):
        scene = SCENES / "slab_127.prm"
        for arguments, words in (
                (("--diameter", "50mm"), "found no --mass, --velocity, --strength, --crh, --cone or --nose"),
                ((*NUMBERS[:-2], "--crh", "0.4"), "--crh: found '0.4', allowed: a number >= 0.5"),
                ((scene, "--strength", "40"), "--strength: found '40', allowed: a number with its unit (Pa, kPa, MPa, GPa) > 0"),
                ((scene, "--mass", "0kg"), "--mass: found '0kg'"), ((scene, "--velocity", "nanm/s"), "--velocity: found"),
                ((scene, "--plug", "-1kg"), "expected one argument"), ((scene, "--plug=-1kg"), "--plug: found '-1kg'"),
                ((scene, "projectile/Velocity"), "found 'projectile/Velocity', allowed: Section/Key=value"),
                ((scene, "slab/Heigth=1 m"), "found 'slab/Heigth=1 m', allowed: a key that the scene sets"),
                ((scene, "projectile/Velocity=0 m/s"), "projectile/Velocity: found '0 m/s'"),
                ((scene, "projectile/Shape=profile"), "projectile/Shape: found 'profile', allowed: projectile, sphere or cylinder"),
                ((SCENES / "taylor_copper.prm",), "found no shot"), ((SCENES / "none.prm",), "No such file"),
                ((scene, "slab/Material/Law=J2"), "found no --strength")):
            with self.subTest(words):
                code, _, error = self.run_command(*arguments)
                self.assertEqual(code, 2)
                self.assertIn(words, error)
        path = self.folder / "kept.csv"
        path.write_text("kept")
        self.assertIn("allowed: a new one, or --force", self.refused(*NUMBERS, "--csv", path))
        self.assertEqual(path.read_text(), "kept")
        (self.folder / "loop.prm").write_text("include loop.prm\n")
        self.assertIn("includes itself", self.refused(self.folder / "loop.prm"))

    def test_a_file_that_cannot_be_written_gives_3(self):
        code, _, error = self.run_command(*NUMBERS, "--csv", self.folder / "none" / "table.csv")
        self.assertEqual(code, 3)
        self.assertIn("cannot write", error)

    def test_the_nominal_strength_is_the_default_of_the_program(self):
        source = (ROOT / "macro" / "material" / "tensile_rate.h").read_text(encoding="utf-8")
        default = re.search(r"compressive_strength = ([\d.e]+);", source)
        self.assertEqual(float(default[1]), scene_shot.DEFAULT_STRENGTH)


if __name__ == "__main__":
    unittest.main()
