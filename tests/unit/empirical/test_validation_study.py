"""The study data/studies/validation.prm computes every test on record, and nothing else."""

import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[3]
for folder in ("studies", "compare", "empirical"):
    sys.path.insert(0, str(ROOT / "shared" / folder))

import scene_shot  # noqa: E402
import study_file  # noqa: E402
from references import References  # noqa: E402


class ValidationStudy(unittest.TestCase):
    def test_every_row_of_the_experiments_has_one_run(self):
        found = References.read()
        tests = {(row["impact_m_s"], row["projectile_mass_kg"], row["projectile_diameter_mm"], row.get("thickness_mm"))
                 for row in found.perforation + found.depths + found.craters}
        self.assertEqual(len(tests), 12)
        computed, bars = set(), set()
        for name, run in study_file.read_series(ROOT / "data" / "studies" / "validation.prm").runs.items():
            if run.input.stem in ("spall_bar", "direct_tension") or run.input.stem.startswith("taylor"):
                bars.add(run.input.stem)
                continue
            words = [f"{key}={value}" for key, value in run.overrides.items() if key.startswith("projectile/")]
            shot = scene_shot.read(run.input, words)
            thickness = None if name.startswith("depth") else round(1e3 * shot["thickness"], 6)
            computed.add((shot["velocity"], shot["mass"], round(1e3 * shot["diameter"], 6), thickness))
        self.assertEqual(computed, tests)
        measured = {row["impact_velocity_m_s"] for row in found.taylor if row.get("final_length_ratio_experiment")}
        self.assertEqual(len(measured), 2)  # aluminium and steel; the copper bar has no experiment
        self.assertEqual(bars, {"spall_bar", "direct_tension", "taylor_aluminium", "taylor_steel"})

    def test_blocks_are_thick_and_as_wide_as_those_of_the_tests(self):
        for row in References.read().depths:
            name = "depth_block" if row["impact_m_s"] < 300 else f"depth_block_{row['impact_m_s']:g}"
            keys = scene_shot.read_keys(ROOT / "data" / "scenes" / f"{name}.prm")
            self.assertGreater(scene_shot.quantity(keys["slab/Height"], "length", ""), 2e-3 * row["experiment_depth_mm"])
            self.assertAlmostEqual(scene_shot.quantity(keys["slab/Diameter"], "length", ""), 1e-3 * row["target_diameter_mm"], 6)


if __name__ == "__main__":
    unittest.main()
