"""Runs of slabs among each other, on synthetic results (see synthetic.py)."""

import pathlib
import sys
import unittest

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import inputs  # noqa: E402
import reading  # noqa: E402
import slab_runs  # noqa: E402
from references import References  # noqa: E402


class Runs(synthetic.InFolder):
    """Slabs among each other."""

    def run_of(self, name, exit_velocity=210.0, thickness=0.127, **changes):
        keys = {"quarter": "Scene/Symmetry planes", "table": "slab/AFC/Damage table", "model": "projectile/Model",
                "threads": "Run/Threads", "steps": "Time/Step factor", "scheme": "Integration/Scheme",
                "shear": "slab/AFC/Shear damage", "floor": "slab/AFC/Failure strain floor", "t_max": "slab/AFC/T_max",
                "rings": "slab/Rings", "friction": "Contact/Friction", "law": "slab/AFC/Damage law", "opening": "slab/AFC/Opening"}
        written = {"slab/Rings": "4"} | {keys[key]: value for key, value in changes.items()}
        return reading.read_result(synthetic.slab(self.folder / name, exit_velocity, spacing=0.04, thickness=thickness,
                                                  inputs=written))

    def test_inputs_are_read_by_section(self):
        text = "set Top = 1\nsubsection A\n  set Key = 2 mm # why\n  subsection B\n    set Key = x, y\n  end\nend\nset Last =\n"
        self.assertEqual(inputs.parse_inputs(text), {"Top": "1", "A/Key": "2 mm", "A/B/Key": "x, y", "Last": ""})

    def test_inputs_have_the_roles_of_their_bodies(self):
        text = "".join(f"subsection {name}\n  set Height = 3 mm\n  subsection AFC\n    set C1 = {i}\n  end\nend\n"
                       for i, name in enumerate(("house", "dart", "shed")))
        found = inputs.by_role(text, {"house": inputs.TARGET, "dart": inputs.PROJECTILE, None: inputs.PROJECTILE})
        self.assertEqual(found, {"Target/Height": "3 mm", "AFC/C1": "0", "Projectile/Height": "3 mm", "Projectile/AFC/C1": "1",
                                 "shed/Height": "3 mm", "shed/AFC/C1": "2"})
        self.assertEqual(inputs.length(found["Target/Height"]), 3e-3)
        for text in (None, "", "3", "3 kg", "long"):
            self.assertIsNone(inputs.length(text))

    def test_only_inputs_that_change_answers_count(self):
        runs = [self.run_of("a", threads="1", scheme="NSNI"), self.run_of("b", threads="2", scheme="DNI")]
        self.assertEqual(slab_runs.differing(runs), ["Integration/Scheme"])
        table = slab_runs.runs_table(runs)
        self.assertEqual([row[1] for row in table.rows], ["NSNI", "DNI"])

    def test_inputs_that_nothing_asks_for_do_not_count(self):
        runs = [self.run_of("a", t_max="REQUIRED"), self.run_of("b", t_max="3 MPa")]
        self.assertEqual(slab_runs.differing(runs), [])
        for run, fine in zip(runs, ("REQUIRED", "8 mm")):
            run.provenance.input += f"subsection slab\n  set Fine spacing = {fine}\nend\n"
        self.assertEqual(slab_runs.differing(runs), ["Target/Graded"])
        self.assertEqual([row[1] for row in slab_runs.runs_table(runs).rows], ["no", "yes"])
        self.assertEqual([slab_runs.method(run).endswith("graded") for run in runs], [False, True])

    def test_pairs_differ_in_one_thing_alone(self):
        runs = [self.run_of("quarter", 210.0, quarter="x, y", scheme="NSNI"), self.run_of("full", 212.5, quarter="", scheme="NSNI"),
                self.run_of("both", 220.0, quarter="", scheme="DNI")]
        self.assertEqual(slab_runs.pairs(runs), ["127 mm slab: symmetry planes x, y 210.0 m/s, symmetry planes none 212.5 m/s: "
                                                 "a difference of 2.5 m/s."])
        runs = [self.run_of("rigid", 210.0, model="rigid", steps="0.3"), self.run_of("soft", 208.0, model="deformable", steps="0.5")]
        self.assertTrue(slab_runs.pairs(runs)[0].endswith("deformable projectile 208.0 m/s: a difference of 2.0 m/s; Step factor 0.3, 0.5."))

    def test_the_band_of_an_ensemble_is_found_by_its_tables(self):
        runs = [self.run_of("w", 220.0, table="/t/mean_weak.h5"), self.run_of("m", 210.0, table="/t/mean.h5"),
                self.run_of("s", 203.0, table="/t/mean_strong.h5"), self.run_of("o", 199.0, table="/t/other.h5")]
        found = slab_runs.bands(runs)
        self.assertEqual([run.name for run in found[0]], ["w", "m", "s"])
        self.assertEqual(len(found), 1)
        self.assertIn("a band of 17.0 m/s", slab_runs.band_sentence(*found[0]))

    def test_every_set_of_inputs_and_spacing_is_a_series(self):
        runs = [self.run_of("a", scheme="DNI", rings="4"), self.run_of("b", scheme="NSNI", rings="4", thickness=0.216),
                self.run_of("c", scheme="DNI", rings="5", thickness=0.216), self.run_of("d", scheme="NSNI", rings="4"),
                self.run_of("e", scheme="DNI", rings="9", thickness=0.254), self.run_of("f", scheme="DNI", rings="9")]
        for run, spacing in zip(runs, (17.0, 18.0, 18.0, 17.0, 8.0, 8.1)):
            run.summary |= {"spacing": 1e-3 * spacing, "projectile_radius": 0.0254}
        found = slab_runs.all_series(runs)
        self.assertEqual([[run.name for run in series] for series in found], [["a", "c"], ["d", "b"], ["f", "e"]])
        self.assertIn("1.5 points over the projectile's radius", slab_runs.resolution_caution(found[0]))
        self.assertIsNone(slab_runs.resolution_caution(found[2]))
        self.assertIsNone(slab_runs.inputs_caution(found[0]))
        self.assertIn("Integration/Scheme", slab_runs.inputs_caution([runs[0], runs[1]]))

    def test_the_band_stands_beside_what_was_measured(self):
        references = References.read(synthetic.references(self.folder / "references"))
        band = [self.run_of(name, exit_velocity) for name, exit_velocity in (("w", 220.0), ("m", 210.0), ("s", 203.0))]
        self.assertEqual(slab_runs.band_table([band], references).rows, [["127", "220.0", "210.0", "203.0", "17.0", "200"]])

    def test_runs_that_differ_in_their_spacing_only_are_a_refinement(self):
        runs = [self.run_of(f"{scheme}_{rings}", exit_velocity, scheme=scheme, rings=str(rings)) for scheme, rings, exit_velocity in (
            ("NSNI", 16, 208.0), ("NSNI", 8, 210.0), ("NSNI", 4, 230.0), ("DNI", 4, 200.0), ("DNI", 8, 201.0))]
        for run in runs:
            run.summary["spacing"] = 0.2 / float(run.inputs["Target/Rings"])
        found = slab_runs.refinements(runs)
        self.assertEqual([[run.name for run in line] for line in found], [["NSNI_4", "NSNI_8", "NSNI_16"]])
        words = slab_runs.refinement_sentence(found[0])
        self.assertIn("230.0, 210.0, 208.0 m/s at 50.0, 25.0, 12.5 mm; the last step changes it by -2.0 m/s", words)

    def test_a_series_has_one_run_of_each_thickness_with_the_inputs_of_the_first(self):
        runs = [self.run_of("a", scheme="DNI"), self.run_of("b", scheme="NSNI", thickness=0.216),
                self.run_of("c", scheme="DNI", thickness=0.216)]
        self.assertEqual([run.name for run in slab_runs.one_per_thickness(runs)], ["a", "c"])

    def test_the_converged_solution_is_found_by_material_and_friction(self):
        rows = References.read(synthetic.references(self.folder / "references")).verification
        u = dict(shear="no", t_max="2.5 MPa", friction="0")
        self.assertEqual(slab_runs.verification_row(self.run_of("u", **u), rows)["exit_m_s"], 240)
        self.assertEqual(slab_runs.verification_row(self.run_of("cut", **u, opening="cut-off"), rows)["exit_m_s"], 236)
        for name, other in (("damaged", {"shear": "yes"}), ("strong", {"t_max": "3 MPa"}), ("rough", {"friction": "0.3"}),
                            ("table", {"table": "t.h5"}), ("thick", {"thickness": 0.216})):
            self.assertIsNone(slab_runs.verification_row(self.run_of(name, **(u | other)), rows), name)
        g = self.run_of("g", **(u | {"law": "exponential", "friction": "0.1", "table": "t.h5"}))
        self.assertEqual(slab_runs.verification_row(g, rows)["exit_m_s"], 205)
        self.assertEqual(slab_runs.verification_table([g], rows[2]).rows[0][-1], "+5.0")
        rows[2]["failure_strain_floor"] = 0.3  # now a reference with shear damage
        damaged = self.run_of("s", **(u | {"law": "exponential", "friction": "0.1", "shear": "yes", "floor": "0.3"}))
        self.assertEqual(slab_runs.verification_row(damaged, rows)["exit_m_s"], 205)
        self.assertIsNone(slab_runs.verification_row(g, rows))


if __name__ == "__main__":
    unittest.main()
