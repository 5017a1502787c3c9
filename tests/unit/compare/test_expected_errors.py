"""Stated and found numerical errors, on synthetic results (see synthetic.py)."""

import json
import pathlib
import sys
import unittest

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import expected_errors  # noqa: E402
import reading  # noqa: E402
from references import References  # noqa: E402

SET_U = {"AFC/Opening": "cut-off", "AFC/Damage table": "", "AFC/Shear damage": "no", "AFC/T_max": "2.5 MPa",
         "Contact/Friction": "0", "Scene/Symmetry planes": "axis"}


class StatedErrors(synthetic.InFolder):
    def setUp(self):
        super().setUp()
        self.references = References.read(synthetic.references(self.folder / "references"))

    def result(self, folder, **more):
        path = folder / "summary.json"
        path.write_text(json.dumps(json.loads(path.read_text()) | more))
        return reading.read_result(folder)

    def test_of_a_shot_it_is_that_of_the_absorbed_energy(self):
        run = self.result(synthetic.slab(self.folder / "u", 240.0, spacing=0.04, inputs=SET_U), numerical_error_percent=6.0)
        one, = expected_errors.collect([run], self.references)
        self.assertAlmostEqual(one.actual, 100 * (1 - (313**2 - 240**2) / (313**2 - 236**2)), places=6)
        self.assertEqual((one.expected, one.quantity), (6.0, "resistance"))

    def test_of_a_bar_it_is_that_of_the_shortening(self):
        run = self.result(synthetic.taylor(self.folder / "bar", 0.707), numerical_error_percent=0.5)
        one, = expected_errors.collect([run], self.references)
        self.assertAlmostEqual(one.actual, 100 * 0.003 / 0.296, places=6)

    def test_runs_without_a_converged_solution_or_a_stated_error_are_left_out(self):
        runs = [self.result(synthetic.slab(self.folder / "other", 240.0, spacing=0.04), numerical_error_percent=6.0),
                self.result(synthetic.taylor(self.folder / "unstated", 0.707))]
        self.assertEqual(expected_errors.collect(runs, self.references), [])

    def test_the_table_counts_what_is_within(self):
        runs = [self.result(synthetic.taylor(self.folder / f"bar{i}", ratio), numerical_error_percent=0.5)
                for i, ratio in enumerate((0.704, 0.705, 0.707))]
        compared = expected_errors.collect(runs, self.references)
        self.assertIn("2 of 3 are within", expected_errors.table(compared).note)
        self.assertGreater(len(expected_errors.draw(compared).axes[0].lines), 0)


if __name__ == "__main__":
    unittest.main()
