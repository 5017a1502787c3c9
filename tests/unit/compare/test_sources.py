"""Laws of the sources that keep results safe: every write goes through the few places that check it."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
LAUNCHERS = [ROOT / "shared" / name for name in ("concrete", "formulas", "study", "view")]
# Files that may do what others may not.
ALLOWED = {"shared/hdf5_file.cc", "shared/seal.cc", "macro/restart/checkpoint.cc", "shared/compare/writing.py"}


def sources(*suffixes):
    for top in ("shared", "micro", "macro"):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix in suffixes or (".py" in suffixes and path in LAUNCHERS):
                yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")


def uses(pattern, *suffixes):
    return [file for file, text in sources(*suffixes) if file not in ALLOWED and re.search(pattern, text)]


class Sources(unittest.TestCase):
    def test_programs_write_files_that_are_checked(self):
        """Text by write_atomically() or RowFile, HDF5 by write_hdf5_atomically(), checkpoints in two parts of their own."""
        self.assertEqual(uses(r"ofstream|\bfopen\b|std::fstream|Mode::create", ".cc", ".h"), [])

    def test_scripts_write_files_that_are_checked(self):
        self.assertEqual(uses(r"write_text\(|write_bytes\(|open\([^)]*[\"'][wax]b?\+?[\"']|savefig\([^,)]*[/\"']", ".py"), [])

    def test_programs_and_scripts_begin_and_end_in_one_place(self):
        mains = [(file, text) for file, text in sources(".cc") if re.search(r"^int main\(", text, re.M)]
        self.assertEqual(len(mains), 3)
        for file, text in mains:
            body = text[text.index("int main("):]
            self.assertRegex(body, r"^int main\(int argc, char\*\* argv\) {\s*(const bool \w+ = )?spall::hold_standard_streams\(\);",
                             file)
            self.assertIn("run_program(", body, file)
        scripts = [(file, text) for file, text in sources(".py") if "__main__" in text]
        self.assertEqual([file for file, _ in scripts],
                         ["shared/compare/compare.py", "shared/compare/sealed.py", "shared/concrete", "shared/formulas",
                          "shared/manual/pages.py", "shared/study", "shared/view", "shared/viewing/view_scene.py"])
        for file, text in scripts:
            self.assertIn("sys.exit(run_script(", text, file)


if __name__ == "__main__":
    unittest.main()
