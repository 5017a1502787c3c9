"""Results read from their files, on synthetic ones (see synthetic.py)."""

import pathlib
import sys
import unittest

import numpy as np

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402

import figures_material  # noqa: E402
import figures_runs  # noqa: E402
import figures_points  # noqa: E402
import figures_slabs  # noqa: E402
import reading  # noqa: E402
import tables_slabs  # noqa: E402
import vtu  # noqa: E402
from references import References  # noqa: E402

# Pictures that nobody looks at: most of the time goes into pixels and into the layout.
matplotlib.rcParams.update({"savefig.dpi": 30, "figure.constrained_layout.use": False})


class Reading(synthetic.InFolder):
    def test_each_kind_is_recognised_by_its_content(self):
        kinds = [type(reading.read_result(f)).__name__ for f in synthetic.everything(self.folder)]
        self.assertEqual(kinds, ["Microcell", "Material", "Slab", "Taylor"])

    def test_runs_of_penetrate_are_told_apart_by_their_answers(self):
        for answers, kind in (({"exit_velocity": None}, "Slab"), ({"penetration_depth": 0.1}, "Slab"),
                              ({"final_length_ratio": 0.7}, "Taylor"), ({"plate_momentum": 3.0}, "Impact")):
            folder = self.folder / kind
            folder.mkdir(exist_ok=True)
            synthetic.write_summary(folder, program="penetrate", **answers)
            self.assertEqual(type(reading.read_result(folder)).__name__, kind)

    def test_curves_come_back_as_written_in_ascending_size(self):
        sizes = (0.008, 0.016, 0.032)
        result = reading.read_result(synthetic.microcell(self.folder / "cell", sizes))
        self.assertEqual(tuple(c["cell_size"] for c in result.curves), sizes)
        for curve in result.curves:
            for name, values in synthetic.bar_curve(curve["cell_size"]).items():
                np.testing.assert_array_equal(curve[name], values)

    def test_the_last_frame_is_read(self):
        frame = reading.read_result(synthetic.slab(self.folder / "slab")).frame
        self.assertEqual(frame.time, 2e-3)
        self.assertGreater(frame.fields["tensile_damage"].max(), 0.9)
        self.assertEqual(frame.initial.shape, frame.position.shape)

    def test_further_bodies_are_read_and_drawn(self):
        folder = synthetic.slab(self.folder / "slab")
        position = np.array([[0.01, 0.005, 0.3], [0.01, 0.2, 0.3]])
        synthetic.add_cloud(folder / "fields.h5", "plate", position, np.full(2, 1e-6))
        frame = reading.read_result(folder).frame
        self.assertEqual([cloud.name for cloud in frame.bodies], ["plate"])
        np.testing.assert_array_equal(frame.bodies[0].position, position)
        axes = figures_points.damage_section(frame).axes[0]
        drawn = [c.get_offsets() for c in axes.collections if len(c.get_offsets()) == 2]
        np.testing.assert_allclose(np.sort(drawn[0][:, 0]), [-10, 10])  # the far one is not in the section

    def test_provenance_holds_program_file_date_and_input(self):
        cell = reading.read_result(synthetic.microcell(self.folder / "cell")).provenance
        self.assertEqual((cell.program, cell.created), ("microcell synthetic", "2000-01-01T00:00:00Z"))
        slab = reading.read_result(synthetic.slab(self.folder / "slab")).provenance
        self.assertEqual((slab.program, slab.input_file), ("penetrate synthetic", "synthetic.prm"))
        self.assertIn("Thickness", slab.input)
        point = reading.read_result(synthetic.material(self.folder / "material")).provenance
        self.assertEqual((point.program, point.created, point.input_file),
                         ("material_point synthetic", "2000-01-01T00:00:00Z", "synthetic.prm along path.csv"))
        for line in ("set Law = afc", "set Law = midm"):
            self.assertIn(line, point.input)

    def test_stress_difference_and_compression_of_a_material_point(self):
        # 100 MPa all round and 60 MPa more along x; a rotation of that by 45 degrees has shear and the same measures.
        for stress in ({"sxx": -160.0, "syy": -100.0, "sxy": 0.0}, {"sxx": -130.0, "syy": -130.0, "sxy": 30.0}):
            columns = stress | {"szz": -100.0, "syz": 0.0, "sxz": 0.0, "exx": -0.02, "eyy": 0.001, "ezz": -0.001}
            self.assertAlmostEqual(figures_material.equivalent(columns), 60)
            self.assertAlmostEqual(figures_material.compression(columns), 0.02)

    def test_what_is_missing_is_named_and_the_rest_is_read(self):
        folder = synthetic.slab(self.folder / "slab")
        (folder / "fields.h5").unlink()
        result = reading.read_result(folder)
        self.assertEqual(result.missing, ["fields.h5"])
        self.assertIsNotNone(result.history)

    def assert_refused(self, folder, *words):
        with self.assertRaises(reading.Unreadable) as caught:
            reading.read_result(folder)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_what_cannot_be_read_is_refused_by_name(self):
        self.assert_refused(self.folder / "absent", "absent")
        self.assert_refused(self.folder, "neither")
        slab = synthetic.slab(self.folder / "slab")
        (slab / "summary.json").write_text("{")
        self.assert_refused(slab, "summary.json")
        (slab / "summary.json").write_text('{"program": "other"}')
        self.assert_refused(slab, "other")
        cell = synthetic.microcell(self.folder / "cell")
        whole = (cell / "damage_table.h5").read_bytes()
        (cell / "damage_table.h5").write_bytes(whole[:len(whole) // 2])
        self.assert_refused(cell, "damage_table.h5")
        bar = synthetic.taylor(self.folder / "bar")
        with open(bar / "history.csv", "a", encoding="utf-8") as stream:
            stream.write("1,2\n")
        self.assert_refused(bar, "history.csv", "columns")

    def test_measured_values_are_found_by_thickness_and_velocity(self):
        references = References.read(synthetic.references(self.folder / "measured"))
        slab = reading.read_result(synthetic.slab(self.folder / "slab"))
        self.assertEqual(references.slab(slab)["experiment_exit_m_s"], 200)
        slab.summary["impact_velocity"] = 400.0
        self.assertIsNone(references.slab(slab))

    def test_oblique_shots_and_layered_targets_have_no_experiment(self):
        references = References.read(synthetic.references(self.folder / "measured"))
        slab = reading.read_result(synthetic.slab(self.folder / "slab", inputs={"mortar/Bonded to": "", "slab/Bonded to": ""}))
        self.assertIsNotNone(references.slab(slab))
        slab.summary["obliquity"] = 0.35
        self.assertIsNone(references.slab(slab))
        layered = reading.read_result(synthetic.slab(self.folder / "layered", inputs={"mortar/Bonded to": "slab"}))
        self.assertIsNone(references.slab(layered))

    def measured(self, rows):
        """References with own rows: text of perforation.csv after the head."""
        folder = self.folder / f"own{len(list(self.folder.iterdir()))}"
        folder.mkdir()
        (folder / "perforation.csv").write_text(
            "thickness_mm,impact_m_s,target_diameter_mm,projectile_mass_kg,projectile_diameter_mm,obliquity_deg,"
            f"experiment_exit_m_s,experiment_exit_uncertainty_m_s,nmap_exit_m_s\n{rows}\n", encoding="utf-8")
        return References.read(folder)

    def test_every_quantity_that_defines_the_shot_must_agree(self):
        slab = reading.read_result(synthetic.slab(self.folder / "slab"))
        slab.summary |= {"projectile_mass": 2.34, "projectile_radius": 0.0254}
        references = self.measured("127,313,1520,2.34,50.8,0,224,,205")
        self.assertEqual(references.slab(slab)["experiment_exit_m_s"], 224.0)
        for key, other in (("thickness", 0.13), ("impact_velocity", 300.0), ("diameter", 0.8), ("projectile_mass", 10.0),
                           ("projectile_radius", 0.02), ("obliquity", 0.35)):
            with self.subTest(key):
                usual = slab.summary.get(key)
                slab.summary[key] = other
                self.assertIsNone(references.slab(slab))
                slab.summary[key] = usual
        del slab.summary["projectile_mass"]
        self.assertIsNone(references.slab(slab))

    def test_own_rows_may_have_empty_columns(self):
        slab = reading.read_result(synthetic.slab(self.folder / "slab"))
        row = self.measured("127,313,,,,,224,,").slab(slab)
        self.assertIn("misses the measured 224 m/s", tables_slabs.slab_verdict(slab, row))
        self.assertNotIn("NMAP", tables_slabs.slab_verdict(slab, row))
        self.assertEqual(tables_slabs.slab_table(slab, row).rows[0][3], "–")
        figures_slabs.velocity(slab, row)
        figures_runs.velocities([slab], [row])
        self.assertIsNone(self.measured("127,313,,,,20,224,,").slab(slab))
        nothing = self.measured("127,313,,,,,,,190").slab(slab)
        self.assertIn("no test of this shot", tables_slabs.slab_verdict(slab, nothing))

    def test_several_tests_of_one_shot_are_their_mean_with_an_uncertainty(self):
        slab = reading.read_result(synthetic.slab(self.folder / "slab"))
        row = self.measured("127,313,1520,,,0,220,2,\n127,314,1520,,,0,230,,").slab(slab)
        self.assertEqual((row["experiment_exit_m_s"], row["experiment_exit_uncertainty_m_s"], row["tests"]), (225.0, 5.0, 2))
        self.assertIn("uncertainty of 2 test(s) is 5.0 m/s", tables_slabs.slab_verdict(slab, row))


class Cell(synthetic.InFolder):
    def test_a_mesh_comes_back_as_written(self):
        path = self.folder / "cell.vtu"
        synthetic.write_cell(path, 0.016, 5e-6)
        strain, nodes, corners, data = vtu.read_quadrilaterals(path)
        self.assertEqual((strain, nodes.shape, corners.shape), (1e-4, (30, 2), (16, 4)))
        np.testing.assert_allclose(nodes[corners].mean(axis=(0, 1)), [0.008, 0.008], rtol=1e-6)
        # Every quadrilateral is one of the sixteen squares, whichever half it is in.
        a, b, c, d = (nodes[corners[:, i]] for i in range(4))
        area = 0.5 * np.abs(np.cross(c - a, d - b))
        np.testing.assert_allclose(area, 0.004**2, rtol=1e-5)
        np.testing.assert_allclose(np.unique(data["displacement"][:, 1]), [0, 5e-6], rtol=1e-6)

    def test_a_broken_mesh_is_refused_by_name(self):
        folder = synthetic.microcell(self.folder / "cell")
        path = folder / "fields_001.vtu"
        path.write_text(path.read_text()[:-200])
        with self.assertRaisesRegex(reading.Unreadable, "fields_001.vtu"):
            reading.read_result(folder)

    def test_the_states_near_the_peak_and_at_the_end_are_read(self):
        result = reading.read_result(synthetic.microcell(self.folder / "cell"))
        self.assertEqual([state.strain for state in result.states], [1e-4, 3e-3])


if __name__ == "__main__":
    unittest.main()
