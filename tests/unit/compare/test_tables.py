"""Numbers and sentences of the report, on synthetic results (see synthetic.py)."""

import pathlib
import sys
import unittest

import numpy as np

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402

import figures_slabs  # noqa: E402
import reading  # noqa: E402
import tables  # noqa: E402
import tables_slabs  # noqa: E402
import validation  # noqa: E402
from references import References  # noqa: E402

# Pictures that nobody looks at: most of the time goes into pixels and into the layout.
matplotlib.rcParams.update({"savefig.dpi": 30, "figure.constrained_layout.use": False})


class Numbers(synthetic.InFolder):
    def test_a_perforation_by_hand(self):
        # 2 kg from 300 to 150 m/s through 0.1 m: half the velocity, three quarters of 90 kJ.
        p = tables_slabs.Perforation(impact=300.0, exit=150.0, mass=2.0, thickness=0.1)
        self.assertAlmostEqual(p.delta_v_percent, 50.0)
        self.assertAlmostEqual(p.delta_ke_percent, 75.0)
        self.assertAlmostEqual(p.absorbed, 67.5e3)
        self.assertAlmostEqual(p.absorbed_per_thickness, 675e3)

    def test_the_measured_slab_absorbs_440_kN(self):
        # 2.34 kg, 313 -> 224 m/s, 127 mm: 0.5 * 2.34 * (313^2 - 224^2) / 0.127 = 440 kN.
        p = tables_slabs.Perforation(impact=313.0, exit=224.0, mass=2.34, thickness=0.127)
        self.assertEqual(round(p.absorbed_per_thickness / 1e3), 440)
        self.assertEqual((round(p.delta_v_percent, 1), round(p.delta_ke_percent, 1)), (28.4, 48.8))

    def read(self, exit_velocity):
        references = References.read(synthetic.references(self.folder / f"measured_{exit_velocity}"))
        slab = reading.read_result(synthetic.slab(self.folder / f"slab_{exit_velocity}", exit_velocity))
        return slab, references.slab(slab)

    def test_the_mass_comes_from_the_history(self):
        self.assertAlmostEqual(tables_slabs.projectile_mass(self.read(210.0)[0]), 2.34, places=6)

    def test_differences_are_points_and_relative(self):
        slab, row = self.read(210.0)
        cells = {r[0]: r[1:] for r in tables_slabs.slab_table(slab, row).rows}
        self.assertEqual(cells["exit velocity (m/s)"],
                         ["210.0", "200.0", "190.0", "+10.0 m/s", "+5.0 %", "-10.0 m/s", "-5.0 %"])
        # 103/313 = 32.907 %, 113/313 = 36.102 %: -3.2 points, -8.8 % of the measured change.
        self.assertEqual(cells["velocity change (% of impact velocity)"][3:5], ["-3.2 points", "-8.8 %"])

    def test_a_miss_is_said_in_words_with_its_number(self):
        self.assertIn("misses the measured 200 m/s by 10.0 m/s (too fast", tables_slabs.slab_verdict(*self.read(210.0)))
        self.assertIn("misses the measured 200 m/s by 20.0 m/s (too slow", tables_slabs.slab_verdict(*self.read(180.0)))
        self.assertIn("agrees", tables_slabs.slab_verdict(*self.read(200.2)))

    def test_a_verdict_says_the_numerical_band_and_whether_it_holds_the_measured_value(self):
        slab, row = self.read(210.0)
        self.assertNotIn("numerical", tables_slabs.slab_verdict(slab, row))  # of a version that knew no band
        slab.summary |= {"exit_velocity_low": 198.0, "exit_velocity_high": 221.0, "numerical_error_remark": ""}
        verdict = tables_slabs.slab_verdict(slab, row)
        for words in ("exit velocity of 210.0 m/s (numerically 198.0 to 221.0) misses the measured 200 m/s",
                      "; the measured value lies within the numerical band"):
            self.assertIn(words, verdict)
        slab.summary |= {"exit_velocity_low": 206.0, "numerical_error_remark": "coarser than any measured"}
        self.assertIn("lies outside the numerical band, by 6.0 m/s (coarser than any measured)", tables_slabs.slab_verdict(slab, row))
        slab.summary |= {"exit_velocity_low": None, "exit_velocity_high": None, "numerical_error_remark": "not measured for DNI"}
        self.assertIn("; the numerical error is not measured for DNI", tables_slabs.slab_verdict(slab, row))
        self.assertNotIn("numerically", tables_slabs.slab_verdict(slab, row))

    def test_tables_and_figures_show_the_band(self):
        slab, row = self.read(210.0)
        slab.summary |= {"exit_velocity_low": 198.0, "exit_velocity_high": 221.0}
        cells = {r[0]: r[1] for r in tables_slabs.slab_table(slab, row).rows}
        self.assertEqual(cells["exit velocity (m/s)"], "210.0 (198.0 to 221.0)")
        self.assertEqual(cells["velocity change (% of impact velocity)"], "32.9 (29.4 to 36.7)")  # the fastest exit loses least
        bars = [line for line in figures_slabs.velocity(slab, row).axes[0].collections if hasattr(line, "get_segments")]
        self.assertEqual([y for _, y in bars[0].get_segments()[0]], [198.0, 221.0])
        own = tables_slabs.perforations(slab, row)[0]
        self.assertAlmostEqual(own.band("absorbed")[1], 0.5 * 2.34 * (313.0**2 - 198.0**2))
        self.assertIsNone(tables_slabs.perforations(slab, row)[1].band("absorbed"))
        self.assertIn("In brackets: the range", tables_slabs.slab_table(slab, row).words())
        slab.summary["exit_velocity_low"] = None
        self.assertNotIn("In brackets", tables_slabs.slab_table(slab, row).words())

    def test_depths_and_lengths_have_their_bands(self):
        slab, _ = self.read(210.0)
        slab.summary |= {"penetration_depth": 0.09, "penetration_depth_low": 0.085, "penetration_depth_high": 0.095}
        del slab.summary["exit_velocity"]
        self.assertIn("has penetrated 90.0 mm (numerically 85.0 to 95.0) into it", tables_slabs.slab_verdict(slab, None))
        bar = reading.read_result(synthetic.taylor(self.folder / "bar"))
        row = {"material": "Al", "final_length_ratio_experiment": 0.703}
        bar.summary |= {"final_length_ratio_low": 0.7040, "final_length_ratio_high": 0.7060}
        self.assertIn("0.7050 (numerically 0.7040 to 0.7060), measured 0.703", tables.bar_verdict(bar, row))
        self.assertIn("outside the numerical band, by 0.0010", tables.bar_verdict(bar, row))
        self.assertEqual(tables.bar_table(bar, row).rows[0][1], "0.7050 (0.7040 to 0.7060)")

    def test_a_stopped_projectile_has_no_exit_velocity(self):
        slab, row = self.read(210.0)
        slab.summary |= {"perforated": False, "exit_velocity": -1.5}
        self.assertIn("no exit velocity", tables_slabs.slab_verdict(slab, row))
        self.assertIn("then -1.5 m/s; the experiment has an exit velocity of 200 m/s", tables_slabs.slab_verdict(slab, row))
        self.assertEqual(tables_slabs.slab_table(slab, row).rows[0][1], "–")

    def test_a_projectile_that_was_stopped_has_lost_everything(self):
        slab, row = self.read(210.0)
        slab.summary |= {"perforated": False, "exit_velocity": 0.0}
        self.assertEqual(tables_slabs.perforations(slab, row)[0].delta_ke_percent, 100.0)
        self.assertIn("(the projectile is stopped) misses", tables_slabs.slab_verdict(slab, row))
        slab.summary |= {"penetration_depth": 0.09, "penetration_depth_low": 0.085, "penetration_depth_high": 0.095}
        self.assertIn("(the projectile is stopped at a depth of 90.0 mm, numerically 85.0 to 95.0) misses",
                      tables_slabs.slab_verdict(slab, row))

    def test_energy_shares_add_up_to_what_the_projectile_lost(self):
        slab, _ = self.read(210.0)
        shares, lost = tables_slabs.energy_shares(slab)
        self.assertAlmostEqual(sum(value for _, value in shares), lost)
        self.assertAlmostEqual(lost, 0.5 * 2.34 * (313.0**2 - 210.0**2), delta=1e-3)
        self.assertAlmostEqual(dict(shares)["plastic flow (shear)"] / lost, 0.49, places=6)
        self.assertAlmostEqual(dict(shares)["elastic, stored"] / lost, 0.03, places=6)

    def test_the_larger_crater_is_named(self):
        slab, _ = self.read(210.0)
        self.assertIn("(380 mm) is larger than the front one (210 mm)", tables_slabs.crater_verdict(slab))
        slab.summary["front_crater_depth"] = 0.0321
        self.assertEqual(tables_slabs.crater_table(slab).rows[0], ["front face", "210", "–", "32"])
        slab.summary["front_crater_diameter"] = 0.5
        self.assertIn("is not larger", tables_slabs.crater_verdict(slab))
        slab.summary |= {"back_crater_diameter": 0.0, "exit_velocity": None}
        self.assertIn("the front one is 500 mm wide, the back face is whole", tables_slabs.crater_verdict(slab))
        slab.summary["front_crater_diameter"] = None
        self.assertIsNone(tables_slabs.crater_verdict(slab))

    def test_fragments_stand_by_place(self):
        table = tables_slabs.fragment_table(self.read(210.0)[0])
        self.assertEqual(table.rows[0], ["debris behind the back", "2", "0.50", "100.0", "3.0", "90"])
        self.assertIn("0 points are lost", table.note)

    def test_all_copies_of_a_fragment_count(self):
        slab, _ = self.read(210.0)
        number = figures_slabs.fragment_sizes(slab).axes[0]
        steps = {line.get_label(): line.get_ydata()[-1] for line in number.lines}
        self.assertEqual(steps["debris: 8, 0.24 kg"], 8)
        self.assertEqual(steps["ejecta: 2, 0.02 kg"], 2)

    def test_what_bodies_have_received_is_reported_by_giver(self):
        slab, _ = self.read(210.0)
        self.assertEqual(tables.received_tables(slab), [])
        slab.summary |= {"steel_plate_momentum": 12.34, "steel_plate_momentum_from_slab": 8.0,
                         "steel_plate_momentum_from_dart_2": 4.34, "steel_plate_max_deflection": 0.0056}
        table, = tables.received_tables(slab)
        found = dict(table.rows)
        self.assertIn("steel_plate", table.title)
        self.assertEqual([found["momentum along z, in all (N s)"], found["largest deflection along z (mm)"]], ["12.3", "5.6"])
        self.assertEqual([found["momentum from slab (N s)"], found["momentum from dart_2 (N s)"]], ["8.0", "4.3"])

    def test_a_run_that_asks_for_the_depth_alone_is_reported(self):
        slab, row = self.read(210.0)
        for key in ("exit_velocity", "time_of_exit"):
            del slab.summary[key]
        slab.summary |= {"penetration_depth": 0.0921, "outcome": "stopped", "perforated": False, "final_velocity": 0.0}
        self.assertIsNone(slab.exit_velocity)
        self.assertIn("has penetrated 92.1 mm into it; it is at rest", tables_slabs.slab_verdict(slab, row))
        check = validation.Check("slab", "a shot", validation.DEPTH, 120.0, None, 1, 92.1)
        self.assertTrue(tables_slabs.slab_verdict(slab, row, [check]).endswith(
            "it is at rest. Against the test: depth of penetration (mm): 120 measured, 92 computed."))
        self.assertEqual(tables_slabs.slab_table(slab, row).rows[-1][:2], ["penetration depth (mm)", "92.1"])
        figures_slabs.velocity(slab, row)

    def test_a_depth_beside_an_exit_velocity_is_found_by_the_names_of_the_bodies(self):
        slab, row = self.read(210.0)
        slab.summary |= {"projectile_slab_penetration_depth": 0.127, "projectile_slab_outcome": "perforated"}
        self.assertEqual(slab.penetration_depth, 0.127)
        self.assertIn("misses the measured", tables_slabs.slab_verdict(slab, row))
        self.assertEqual(tables_slabs.further_shots_table(slab).rows[0][2:6], ["perforated", "–", "–", "127.0"])

    def series(self, **exits):
        references = References.read(synthetic.references(self.folder / "references"))
        return [reading.read_result(synthetic.slab(self.folder / name, value, thickness=int(name[1:]) / 1e3,
                                                   spacing=0.03)) for name, value in exits.items()], references

    def test_the_series_is_judged_in_points_and_by_its_trend(self):
        slabs, references = self.series(s127=200.0, s216=100.0)
        words = tables_slabs.series_verdict(slabs, references)
        self.assertEqual(words.count("within the aim"), 3)
        self.assertIn("trend is off by 0.0 %", words)
        slabs, references = [reading.read_result(synthetic.slab(self.folder / "fast", 240.0))] + slabs[1:], references
        words = tables_slabs.series_verdict(slabs, references)
        # 40/313 = 12.8 points; energies (313^2 - v^2): 0.696 of the measured one against 1.
        self.assertIn("velocity change is off by at most 12.8 points (127 mm), outside the aim", words)
        self.assertIn("trend is off by 17.9 %, outside", words)

    def test_a_factor_common_to_all_slabs_is_no_error_of_the_trend(self):
        self.assertAlmostEqual(tables_slabs.trend_error([3.0, 6.0], [1.0, 2.0]), 0)
        self.assertAlmostEqual(tables_slabs.trend_error([1.1, 0.9], [1.0, 1.0]), 10)

    def test_a_bar_is_held_against_every_reference(self):
        references = References.read(synthetic.references(self.folder / "measured"))
        bar = reading.read_result(synthetic.taylor(self.folder / "bar", ratio=0.7391))
        ratio, foot = tables.bar_table(bar, references.bar(bar)).rows[:2]
        self.assertEqual(ratio[1:], ["0.7391", "0.7030", "0.7240", "0.7040", "+5.1 %", "+2.1 %", "+5.0 %"])
        self.assertEqual(foot[1:], ["16.50", "–", "–", "16.66", "–", "–", "-1.0 %"])

    def test_bars_stand_in_one_table_with_the_reason_of_a_difference(self):
        references = References.read(synthetic.references(self.folder / "measured"))
        wall = reading.read_result(synthetic.taylor(self.folder / "wall", ratio=0.705))
        anvil = reading.read_result(synthetic.taylor(self.folder / "anvil", ratio=0.74, anvil=True))
        wall.summary["scheme"] = "NSNI"
        anvil.summary |= {"contact_scheme": "kernel", "scheme": "NSNI"}
        rows = tables.bars_table([wall, anvil], references).rows
        self.assertEqual([row[1] for row in rows], ["rigid wall, NSNI"] * 2 + ["anvil, kernel contact, NSNI"] * 2)
        self.assertEqual(rows[0][3:7], ["0.7050", "0.7030", "0.7240", "0.7040"])
        self.assertTrue(rows[0][7].startswith("NMAP: the weight of its M-SNNI, which is not printed, and possibly its contact"))
        self.assertNotIn("converged", rows[0][7])  # 0.1 % is no difference
        self.assertIn("converged: overlapping kernels", rows[2][7])
        self.assertEqual(rows[1][3:7], ["16.50", "–", "–", "16.66"])

    def test_energies_that_no_sound_run_has_are_named(self):
        slab, _ = self.read(210.0)
        self.assertEqual(tables.impact_warnings(slab), [])
        initial = slab.history["total_energy"][0]
        for column, value, words in (("energy_error", -0.02, "off by up to 2.0 %"),
                                     ("stabilization_energy", -0.5 * initial, "adds energy to the motion: its work reaches -50.0 %"),
                                     ("stabilization_energy", 0.06 * initial, "takes up much energy"),
                                     ("kinetic_energy", 2 * initial, "grows to")):
            kept = slab.history[column][100]
            slab.history[column][100] = value  # in the middle: the end of the run looks sound
            found = tables.impact_warnings(slab)
            self.assertEqual(len(found), 1, column)
            self.assertIn(words, found[0])
            slab.history[column][100] = np.nan
            self.assertEqual(len(tables.impact_warnings(slab)), 1, column)
            slab.history[column][100] = kept

    def test_a_parted_cell_has_dissipated_the_fracture_energy(self):
        result = reading.read_result(synthetic.microcell(self.folder / "cell"))
        for row in tables.microcell_table(result).rows:
            self.assertAlmostEqual(float(row[-1]), synthetic.FRACTURE_ENERGY, delta=0.1)


if __name__ == "__main__":
    unittest.main()
