"""The tutorial: its commands and files are taken out of the page and run, coarser and fewer."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop())
PAGE = (ROOT / "shared" / "manual" / "tutorial.md").read_text(encoding="utf-8")

# What makes the shot and the study short. Everything else is as printed.
COARSE = {
    "set Rings    = 75 ": "set Rings    = 24 ", "set Layers   = 19": "set Layers   = 6", "set Samples = 20": "set Samples = 4",
    "set Height   = 150 mm": "set Height   = 100 mm",
}


def files():
    """Returns {path: text} of the files that the page asks to save."""
    return dict(re.findall(r"[Ss]ave this as\s+`(out/[\w.]+)`:\n\n```\n(.*?)```", PAGE, re.DOTALL))


class Tutorial(unittest.TestCase):
    def test_every_command_of_the_page_runs(self):
        with tempfile.TemporaryDirectory() as scratch:
            here = pathlib.Path(scratch)
            for name in ("shared", "data"):
                shutil.copytree(ROOT / name, here / name)
            (here / "build").symlink_to(BUILD)
            (here / "out").mkdir()
            self.assertEqual(set(files()), {"out/my_wall.prm", "out/my_band.prm"})
            for path, text in files().items():
                for printed, coarse in COARSE.items():
                    text = text.replace(printed, coarse)
                (here / path).write_text(text)
            commands = re.findall(r"```sh\n(.*?)\n```", PAGE, re.DOTALL)
            self.assertEqual(len(commands), 7)
            for command in commands:
                done = subprocess.run(["bash", "-c", command], cwd=here, capture_output=True, text=True, check=False,
                                      env=os.environ | {"MPLBACKEND": "Agg"})
                self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")
            python = re.search(r"```python\n(.*?)```", PAGE, re.DOTALL)[1]
            done = subprocess.run(["/usr/bin/python3", "-c", python], cwd=here, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            low, value, high = (float(done.stdout.split()[i]) for i in (1, 0, 2))
            self.assertTrue(low < value < high, done.stdout)
            report = (here / "out/my_report/report.html").read_text(encoding="utf-8")
            for shown in ("my_wall", "my_band", "friction"):
                self.assertIn(shown, report)

    def test_what_is_made_coarser_is_on_the_page(self):
        for printed in COARSE:
            self.assertIn(printed, PAGE)


if __name__ == "__main__":
    unittest.main()
