"""Measured, computed and formulas side by side, from stand-in results (see synthetic.py)."""

import pathlib
import sys
import unittest

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import figures_validation  # noqa: E402
import validation  # noqa: E402
from reading import read_result  # noqa: E402
from references import EXPERIMENTS, References  # noqa: E402

INPUTS = {"Answers/Exit": "projectile through slab", "slab/Height": "0.127 m", "slab/AFC/Density": "2267 kg/m3",
          "slab/AFC/Compressive strength": "38.2 MPa", "slab/Material/Law": "AFC", "projectile/Shape": "projectile",
          "projectile/Nose": "ogive", "projectile/Caliber radius head": "3", "projectile/Diameter": "50.8 mm",
          "projectile/Mass": "2.34 kg", "projectile/Velocity": "313 m/s", "projectile/Model": "rigid"}
SPHERE = INPUTS | {"Answers/Exit": "", "Answers/Penetration": "projectile into slab", "slab/Height": "140 mm",
                   "projectile/Shape": "sphere", "projectile/Diameter": "20.6 mm", "projectile/Mass": "35.9 g",
                   "projectile/Velocity": "859 m/s"}
DEPTH = INPUTS | {"Answers/Exit": "", "Answers/Penetration": "projectile into slab", "slab/Height": "500 mm",
                  "projectile/Caliber radius head": "2", "projectile/Diameter": "26.9 mm", "projectile/Mass": "0.906 kg",
                  "projectile/Velocity": "277 m/s"}
OF_DEPTH = dict(thickness=0.5, diameter=1.37, projectile_mass=0.906, projectile_radius=0.01345, projectile_length=0.2424,
                impact_velocity=277.0, exit_velocity=None, penetration_depth=0.150, penetration_depth_low=0.140,
                penetration_depth_high=0.175)
OF_SPHERE = dict(thickness=0.14, diameter=1.0, projectile_mass=0.0359, projectile_radius=0.0103, projectile_length=0.0206,
                 impact_velocity=859.0, exit_velocity=None, penetration_depth=0.05, front_crater_diameter=0.180,
                 front_crater_depth=0.08, back_crater_diameter=0.0, back_crater_depth=0.0)


class Validation(synthetic.InFolder):
    def run_of(self, name, inputs=None, **summary):
        folder = synthetic.slab(self.folder / name, inputs=inputs if inputs is not None else INPUTS)
        sizes = dict(projectile_mass=2.34, projectile_radius=0.0254, projectile_length=0.3556)
        synthetic.change_summary(folder, **(sizes | summary))
        return read_result(folder)

    def checks(self, *runs, references=None):
        return validation.collect(runs, references or References.read(EXPERIMENTS))

    def named(self, checks, quantity):
        return next(check for check in checks if check.quantity == quantity)

    def test_an_exit_velocity_stands_beside_the_measured_one_and_the_formulas(self):
        found, = self.checks(self.run_of("slab", exit_velocity_low=200.0, exit_velocity_high=225.0))
        self.assertEqual((found.measured, found.computed, found.band, found.scatter), (224, 210, (200, 225), None))
        self.assertTrue(found.agrees)
        self.assertAlmostEqual(found.formulas["Forrestal 1994"][0], 196.98, 2)
        self.assertEqual(found.formulas["modified NDRC"][1], True)
        self.assertEqual(found.formulas["Chang"][1], False)
        row = validation.table([found]).rows[0]
        self.assertEqual(row[4:9], ["224", "–", "210 (200 to 225)", "yes", "205"])
        self.assertEqual(row[9], "197 (Forrestal 1994*) to 308 (Hughes)")

    def test_without_a_band_the_numbers_must_agree_themselves(self):
        found, = self.checks(self.run_of("slab"))
        self.assertIsNone(found.band)
        self.assertIs(found.agrees, False)
        found.scatter = 14.0
        self.assertIs(found.agrees, True)
        found.computed = None
        self.assertIsNone(found.agrees)

    def test_a_depth_has_the_formulas_with_the_concrete_of_the_test(self):
        """NDRC 137 and Forrestal 168 mm with 35.2 MPa and 2370 kg/m3, not with the 38.2 MPa of the run."""
        found, = self.checks(self.run_of("depth", DEPTH, **OF_DEPTH))
        self.assertEqual((found.quantity, found.measured, found.computed, found.band), (validation.DEPTH, 173, 150, (140, 175)))
        self.assertEqual([round(found.formulas[name][0]) for name in ("modified NDRC", "Forrestal 1994")], [137, 168])
        self.assertTrue(found.agrees)

    def test_a_thin_target_gives_no_depth(self):
        self.assertEqual(self.checks(self.run_of("thin", DEPTH, **(OF_DEPTH | {"thickness": 0.2}))), [])

    def test_craters_and_whether_the_rear_face_scabs(self):
        checks = self.checks(self.run_of("sphere", SPHERE, **OF_SPHERE))
        front = self.named(checks, "diameter of the front crater (mm)")
        self.assertEqual((front.measured, front.scatter, front.computed, front.agrees), (190, 12.5, 180, True))
        self.assertEqual(self.named(checks, "diameter of the rear crater (mm)").computed, 0)
        banded = OF_SPHERE | dict(front_crater_diameter=0.14, front_crater_diameter_low=0.09, front_crater_diameter_high=0.18)
        front = self.named(self.checks(self.run_of("banded", SPHERE, **banded)), "diameter of the front crater (mm)")
        self.assertEqual((front.computed, front.band, front.agrees), (140, (90, 180), True))
        self.assertEqual((self.named(checks, validation.TIP).measured, self.named(checks, validation.TIP).computed), (42, 50))
        scab = self.named(checks, validation.SCAB)
        self.assertEqual((scab.measured, scab.computed, scab.agrees), (1, 0, False))
        self.assertEqual(scab.formulas["Hughes"][0], 1)
        self.assertEqual(validation.table([scab]).rows[0][4:8], ["yes", "–", "no", "no"])
        scabbed = self.checks(self.run_of("scabbed", SPHERE, **(OF_SPHERE | {"back_crater_diameter": 0.2})))
        self.assertTrue(self.named(scabbed, validation.SCAB).agrees)
        self.assertIn("0 of 1 answers on a crater", validation.verdict(checks))
        self.assertIn("1 of 1 answers on a crater", validation.verdict(scabbed))

    def test_a_run_that_reports_no_craters_is_not_judged_on_them(self):
        silent = {key: None for key in OF_SPHERE if "crater" in key}
        checks = self.checks(self.run_of("sphere", SPHERE, **(OF_SPHERE | silent)))
        self.assertIsNone(self.named(checks, validation.SCAB).agrees)
        self.assertEqual(validation.table([self.named(checks, validation.SCAB)]).rows[0][6:8], ["–", "–"])

    def test_another_shot_has_no_check(self):
        for change in ({"impact_velocity": 330.0}, {"projectile_mass": 3.0}, {"projectile_radius": 0.02}, {"thickness": 0.15}):
            self.assertEqual(self.checks(self.run_of("_".join(change), **change)), [])

    def test_rows_of_users_are_found_and_several_tests_are_averaged(self):
        folder = synthetic.references(self.folder / "own")
        (folder / "penetration_depth.csv").write_text(
            "Impact_m_s;projectile_mass_kg;projectile_diameter_mm;experiment_depth_mm;experiment_depth_uncertainty_mm\n"
            "277;0.906;26.9;160;5\n277;0.9;26.9;180;\n277;5;26.9;999;\n", encoding="utf-8")
        found, = self.checks(self.run_of("depth", DEPTH, **OF_DEPTH), references=References.read(folder))
        self.assertEqual((found.measured, found.scatter, found.tests), (170, 10, 2))

    def test_a_run_without_inputs_has_no_formulas(self):
        found, = self.checks(self.run_of("slab", inputs={"slab/Model": "deformable"}))
        self.assertEqual((found.formulas, found.measured), ({}, 224))
        self.assertEqual(validation.table([found]).rows[0][9], "–")

    def test_the_finest_run_of_a_shot_is_shown(self):
        coarse, fine = self.run_of("coarse", spacing=0.01), self.run_of("fine", spacing=0.005)
        checks = self.checks(coarse, fine)
        shown = validation.one_per_test(checks, {run.name: run.number("spacing") for run in (coarse, fine)})
        self.assertEqual(([check.run for check in checks], [check.run for check in shown]), (["coarse", "fine"], ["fine"]))

    def test_laws_of_the_concrete_stand_side_by_side(self):
        afc = self.run_of("afc", exit_velocity_low=200.0, exit_velocity_high=225.0)
        hjc = self.run_of("hjc", INPUTS | {"slab/Material/Law": "HJC"}, spacing=0.001, exit_velocity=150.0)
        checks = self.checks(hjc, afc)
        shown = validation.one_per_test(checks, {run.name: run.number("spacing") for run in (afc, hjc)})
        self.assertEqual({check.law for check in shown}, {"AFC", "HJC"})
        said = "computed numbers meet the measured ones within scatter and numerical band."
        self.assertEqual(validation.verdict(shown), f"AFC: 1 of 1 {said} HJC: 0 of 1 {said}")
        axes = figures_validation.draw(shown).axes[0]
        self.assertEqual(len(axes.get_xticks()), 1)
        self.assertEqual([line.get_ydata()[0] for line in axes.get_lines() if line.get_marker() in "oD" and len(line.get_ydata())],
                         [150, 210])

    def test_the_figure_has_a_panel_for_each_kind_of_number(self):
        runs = [self.run_of("slab"), self.run_of("depth", DEPTH, **OF_DEPTH), self.run_of("sphere", SPHERE, **OF_SPHERE)]
        drawn = figures_validation.draw(self.checks(*runs))
        titles = [axes.get_title(loc="left") for axes in drawn.axes if axes.get_title(loc="left")]
        self.assertEqual(titles, [title for title, _ in figures_validation.PANELS])
        exits = drawn.axes[0].get_lines()
        self.assertEqual([float(line.get_ydata()[0]) for line in exits[:3]], [224, 205.4, 210])
        scab = self.named(self.checks(runs[2]), validation.SCAB)
        self.assertIsNone(figures_validation.draw([scab]))


if __name__ == "__main__":
    unittest.main()
