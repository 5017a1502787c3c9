"""Scatter over layouts of the points, on synthetic results (see synthetic.py)."""

import pathlib
import sys
import unittest

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import layouts  # noqa: E402
import reading  # noqa: E402
from references import References  # noqa: E402


class Layouts(synthetic.InFolder):
    def run_of(self, name, exit_velocity, thickness=0.127, rings=4, **changes):
        keys = {"jitter": "slab/Jitter", "seed": "slab/Jitter seed", "boundary": "slab/Boundary points", "scheme": "Integration/Scheme"}
        written = {"slab/Rings": str(rings), "Integration/Scheme": "NSNI"} | {keys[key]: value for key, value in changes.items()}
        return reading.read_result(synthetic.slab(self.folder / name, exit_velocity, spacing=0.04, thickness=thickness,
                                                  inputs=written))

    def test_runs_that_differ_in_the_layout_alone_give_mean_and_scatter(self):
        same = [self.run_of("rows", 210.0), self.run_of("shifted", 204.0, boundary="on surface"),
                self.run_of("jitter", 213.0, jitter="0.2", seed="2")]
        others = [self.run_of("other", 190.0, jitter="0.2", scheme="DNI"), self.run_of("thick", 100.0, 0.216),
                  self.run_of("refined", 190.0, rings=8)]
        found = layouts.groups(others[:1] + same + others[1:])
        self.assertEqual([[run.name for run in group] for group in found], [["rows", "shifted", "jitter"]])
        row = layouts.table(found, References.read(synthetic.references(self.folder / "references"))).rows[0]
        self.assertEqual([row[0], row[3], row[4], row[5], row[6], row[7], row[-1]],
                         ["127", "3", "209.0", "4.6", "204.0", "213.0", "200"])

    def test_two_layouts_have_no_scatter(self):
        self.assertEqual(layouts.groups([self.run_of("a", 210.0), self.run_of("b", 204.0, jitter="0.2")]), [])


if __name__ == "__main__":
    unittest.main()
