"""The command shared/concrete: its files, whether the programs take them, refusals, and what it does not replace."""

import contextlib
import csv
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "strength"))

import concrete_command  # noqa: E402
import reference  # noqa: E402
import rules  # noqa: E402
import scene_shot  # noqa: E402
import writing  # noqa: E402

BUILD = pathlib.Path(os.environ.get("SPALL_BUILD", ROOT / "build"))
MICROCELL, POINT, PENETRATE = (BUILD / name for name in ("micro/microcell", "macro/material_point", "macro/penetrate"))
NUMBERS = ("--strength", "35 MPa", "--aggregate", "9.5 mm", "--density", "2320 kg/m3")


def changed(name, text):
    """Returns NUMBERS with another value of one option."""
    words = list(NUMBERS)
    words[words.index(name) + 1] = text
    return words


class Command(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name) / "concrete"

    def run_command(self, *arguments, output=True):
        out, error = io.StringIO(), io.StringIO()
        words = [str(a) for a in arguments] + (["--output", str(self.folder)] if output else [])
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
            code = writing.run_script("concrete", lambda: concrete_command.main(words))
        return code, out.getvalue(), error.getvalue()

    def refused(self, *arguments):
        code, out, error = self.run_command(*arguments)
        self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
        return error

    def program(self, path, *arguments):
        if not path.exists():
            self.skipTest(f"{path.name} is not built")
        done = subprocess.run([str(path), *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_the_reference_is_written_with_the_numbers_of_its_files(self):
        code, out, error = self.run_command("--strength", "38.2 MPa", "--aggregate", "9.5 mm", "--density", "2267 kg/m3")
        self.assertEqual((code, error), (0, ""))
        self.assertIn("C1 501.05 MPa", out)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["block.prm", "concrete.prm", "microcell.prm"])
        written = scene_shot.read_keys(self.folder / "concrete.prm")
        self.assertEqual(written, written | reference.keys("materials"))
        self.assertEqual(scene_shot.read_keys(self.folder / "microcell.prm"), reference.keys("microcells"))

    def test_every_number_has_its_reason(self):
        self.assertEqual(self.run_command(*NUMBERS)[0], 0)
        for name in ("concrete.prm", "microcell.prm"):
            for line in (self.folder / name).read_text(encoding="utf-8").splitlines():
                if line.lstrip().startswith("set ") and "Law" not in line:
                    self.assertRegex(line, r" # \S")

    def test_material_point_takes_the_material(self):
        self.assertEqual(self.run_command(*NUMBERS)[0], 0)
        path = ROOT / "data" / "experiments" / "hydrostatic.csv"
        rows = list(csv.DictReader(io.StringIO(self.program(POINT, self.folder / "concrete.prm", path))))
        first = rows[1]
        K = float(first["pressure"]) / -sum(float(first[name]) for name in ("exx", "eyy", "ezz"))
        self.assertAlmostEqual(K / (55.14e6 / 0.0025 * (35 / 38.2) ** 0.5), 1, 4)

    def test_the_microcell_has_the_strength_and_the_energy_of_the_concrete(self):
        """Far from the reference too: the factor between ligament and cell hardly depends on the other constants."""
        self.program(MICROCELL, "--version")
        for strength, aggregate in ((20, 5), (60, 40)):
            words = ("--strength", f"{strength} MPa", "--aggregate", f"{aggregate} mm", "--density", "2300 kg/m3")
            out = self.program(ROOT / "shared" / "concrete", *words, "--output", self.folder, "--run", "--force", "--build", BUILD)
            self.assertNotIn("build/micro/microcell", out.split("next:")[1])
            summary = json.loads((self.folder / "microcell" / "summary.json").read_text(encoding="utf-8"))
            self.assertAlmostEqual(summary["peak_stress"] / rules.tensile_strength(1e6 * strength), 1, delta=0.005)
        self.assertIn("numerical error", self.program(PENETRATE, self.folder / "block.prm", "--plan"))

    def test_the_exit_code_of_microcell_is_handed_on(self):
        program = self.folder.parent / "build" / "micro" / "microcell"
        program.parent.mkdir(parents=True)
        for body, code in (("exit 3", 3), ("kill -9 $$", 3), ("exit 0", 0)):
            program.write_text(f"#!/bin/sh\n{body}\n")
            program.chmod(0o755)
            done = self.run_command(*NUMBERS, "--run", "--force", "--build", program.parents[1])
            self.assertEqual(done[0], code)
            self.assertEqual("next:" in done[1], code == 0)

    def test_refusals_are_one_line_and_nothing_is_written(self):
        for arguments, words in (
                (changed("--strength", "35"), "--strength: found '35', allowed: a number with its unit (Pa, kPa, MPa, GPa) > 0"),
                (changed("--strength", "8 MPa"), "--strength: found '8 MPa', allowed: > 8 and <= 150 MPa"),
                (changed("--strength", "151 MPa"), "found '151 MPa'"), (changed("--strength", "nan MPa"), "found 'nan MPa'"),
                (changed("--aggregate", "0 mm"), "--aggregate: found '0 mm'"),
                (changed("--aggregate", "9.5"), "(m, cm, mm, um)"), (changed("--aggregate", "1 m"), "> 0 and <= 150 mm"),
                (changed("--density", "2.3 kg/m3"), "> 500 and <= 6000 kg/m3"),
                ((*NUMBERS, "--run", "--build", self.folder / "none"), "--run: found no program")):
            with self.subTest(words):
                self.assertIn(words, self.refused(*arguments))
        self.assertEqual(self.run_command(*NUMBERS, output=False)[0], 2)
        self.assertEqual(self.run_command(*NUMBERS[2:])[0], 2)
        self.assertFalse(self.folder.exists())

    def test_outside_of_the_range_it_warns_in_the_words_and_in_the_files(self):
        for name, text in (("--strength", "19.9 MPa"), ("--strength", "61 MPa"), ("--aggregate", "4.9 mm"),
                           ("--aggregate", "41 mm"), ("--density", "1900 kg/m3"), ("--density", "2.7 g/cm3")):
            code, out, error = self.run_command(*changed(name, text), "--force")
            self.assertEqual((code, error.count("\n")), (0, 1))
            self.assertIn(f"warning: {name}: ", error)
            self.assertIn(f"Warning: {name}: ", (self.folder / "concrete.prm").read_text(encoding="utf-8"))
        for words in (("20 MPa", "5 mm", "2000 kg/m3"), ("60 MPa", "40 mm", "2600 kg/m3")):
            named = [word for pair in zip(("--strength", "--aggregate", "--density"), words) for word in pair]
            self.assertEqual(self.run_command(*named, "--force")[::2], (0, ""))

    def test_results_are_not_replaced_unasked(self):
        self.assertEqual(self.run_command(*NUMBERS)[0], 0)
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        self.assertIn("not replaced unasked", self.refused(*changed("--strength", "50 MPa")))
        self.assertEqual(before, {path: path.read_bytes() for path in self.folder.iterdir()})
        (self.folder / "microcell").mkdir()
        (self.folder / "microcell" / "damage_table.h5").write_text("old")
        code, _, error = self.run_command(*NUMBERS, "--force")
        self.assertEqual(code, 0)
        self.assertIn("is older than these files", error)
        for path in before:
            path.unlink()
        self.assertIn("damage_table.h5", self.refused(*NUMBERS))

    def test_a_folder_that_cannot_be_made_is_refused(self):
        self.folder.write_text("a file")
        code, _, error = self.run_command(*NUMBERS, "--output", self.folder / "below", output=False)
        self.assertEqual((code, error.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()
