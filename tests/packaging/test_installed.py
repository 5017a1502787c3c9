"""An installed Spall, used from another folder.

Arguments: the build folder, cmake."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CMAKE = sys.argv.pop(2) if len(sys.argv) > 2 else "cmake"
BUILD = pathlib.Path(sys.argv.pop(1) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2] / "build")


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.user = cls.place / "user"
        cls.user.mkdir()
        subprocess.run([CMAKE, "--install", str(BUILD), "--prefix", str(cls.place / "prefix")], check=True, capture_output=True)

    def spall(self, *words):
        return subprocess.run([str(self.place / "prefix" / "bin" / "spall"), *words], cwd=self.user, capture_output=True, text=True)

    def data(self):
        return pathlib.Path(self.spall("data").stdout.strip())

    def test_everything_that_the_tree_has_is_there(self):
        here = pathlib.Path(__file__).resolve().parents[2] / "data"
        for path in here.rglob("*"):
            if path.is_file() and "__pycache__" not in path.parts:
                self.assertTrue((self.data() / path.relative_to(here)).is_file(), path)

    def test_programs_and_tools_work_from_another_folder(self):
        data = self.data()
        for words in (("penetrate", f"{data}/scenes/slab_127.prm", "--plan"), ("formulas", f"{data}/scenes/slab_127.prm"),
                      ("microcell", f"{data}/microcells/case_a.prm", "Mesh/Degree=1"),
                      ("penetrate", f"{data}/scenes/taylor_aluminium.prm", "bar/Rings=3", "bar/Layers=18", "--output", "bar"),
                      ("compare", "out/case_a", "bar", "--output", "report"),
                      ("concrete", "--strength", "35 MPa", "--aggregate", "9.5 mm", "--density", "2320 kg/m3", "--output", "mine"),
                      ("study", "--help"), ("tension", "--help"), ("view", "--help"), ("help",)):
            done = self.spall(*words)
            self.assertEqual(done.returncode, 0, (words, done.stderr))
        self.assertTrue((self.user / "report" / "report.html").is_file())
        self.assertTrue((self.user / "out" / "case_a" / "damage_table.h5").is_file())

    def test_the_main_job_writes_into_the_folder_of_the_user_and_needs_no_compiler(self):
        done = self.spall("run", "help")
        self.assertEqual(done.returncode, 0)
        for word in ("test", "build", "install"):
            done = self.spall("run", word)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)

    def test_unknown_commands_are_refused(self):
        done = self.spall("shoot")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()
