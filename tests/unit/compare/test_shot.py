"""Figures and tables of a shot: force over depth, debris cone, perforations."""

import pathlib
import sys
import unittest

import numpy as np
import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import figures_impact  # noqa: E402
import figures_shot  # noqa: E402
import figures_slabs  # noqa: E402
import reading  # noqa: E402
import tables_slabs  # noqa: E402


class Force(synthetic.InFolder):
    def test_a_constant_force_is_found_whatever_the_steps(self):
        time = np.sort(np.concatenate([np.linspace(0, 1e-3, 400), np.linspace(0, 1e-3, 37)[1:-1] + 1e-9]))
        velocity = 300 - 2e5 * time
        position = 300 * time - 1e5 * time**2
        depth, force = figures_shot.mean_force(time, position, velocity, 2.0, 5e-3)
        np.testing.assert_allclose(force, 4e5, rtol=1e-9)
        self.assertTrue(np.all(np.diff(depth) >= 5e-3 * 0.99))
        self.assertGreater(len(depth), 20)

    def test_the_forces_over_time_are_the_loss_of_momentum(self):
        time = np.linspace(0, 1e-3, 500)
        velocity = 200 + 100 * np.cos(3000 * time)
        position = np.concatenate([[0], np.cumsum(0.5 * (velocity[1:] + velocity[:-1]) * np.diff(time))])
        depth, force = figures_shot.mean_force(time, position, velocity, 1.5, 1e-2)
        last = np.searchsorted(position, depth[-1])
        # Work over the path up to there, from the trapezoids between the places of the means.
        work = np.trapezoid(force, depth) if hasattr(np, "trapezoid") else np.trapz(force, depth)
        first = np.searchsorted(position, depth[0])
        self.assertAlmostEqual(work, 0.75 * (velocity[first]**2 - velocity[last]**2), delta=0.05 * abs(work))

    def test_a_report_draws_force_debris_and_perforations_of_runs_that_have_them(self):
        folder = synthetic.slab(self.folder / "slab")
        before = reading.read_result(folder)
        self.assertIsNone(figures_shot.force_over_depth(before))  # older runs do not say where their target is
        self.assertIsNone(tables_slabs.perforation_table(before))
        synthetic.change_summary(folder, struck_face=0.0, projectile_radius=0.0254, projectile_mass=2.34, slab_perforated=True,
                                 slab_perforated_by="projectile", slab_perforated_at=5e-4, debris_half_angle_50=0.1,
                                 debris_half_angle_90=0.4, exit_axis=0.2, exit_direction=0.1, exit_angular_velocity=30.0)
        width = np.pi / 36
        (folder / "debris_cone.csv").write_text("angle_from,angle_to,mass,momentum,kinetic_energy\n" + "".join(
            f"{i * width},{(i + 1) * width},{1 if i < 4 else 0},{1 if i < 4 else 0},{10 - i if i < 4 else 0}\n" for i in range(36)))
        slab = reading.read_result(folder)
        axes = figures_shot.force_over_depth(slab).axes[0]
        self.assertGreater(axes.lines[0].get_ydata().max(), 0)
        left, right = figures_shot.debris_cone(slab).axes
        self.assertAlmostEqual(sum(bar.get_height() for bar in right.patches), 34)
        self.assertIn("total 4", left.get_title())
        table = tables_slabs.perforation_table(slab)
        self.assertEqual(table.rows, [["slab", "projectile", "0.500"]])
        self.assertIn("its axis at 11.5°", table.note)


class Velocity(synthetic.InFolder):
    def test_the_line_has_a_gap_where_the_sign_turns_at_once(self):
        slab = reading.read_result(synthetic.slab(self.folder / "slab"))
        np.testing.assert_array_equal(figures_slabs.velocity_of(slab), slab.history["projectile_velocity"])
        slab.history["projectile_velocity"] = np.array([150.0, 140.0, -139.0, -139.0])
        slab.history["time"] = np.arange(4.0)
        np.testing.assert_array_equal(figures_slabs.velocity_of(slab), [150, 140, np.nan, -139])
        slab.history["projectile_velocity"] = np.array([150.0, 5.0, -2.0, -3.0])  # a rebound
        np.testing.assert_array_equal(figures_slabs.velocity_of(slab), [150, 5, -2, -3])


class Balance(synthetic.InFolder):
    def test_the_impulse_of_supports_counts(self):
        slab = reading.read_result(synthetic.slab(self.folder / "slab"))
        slab.history["support_impulse"] = 3.0 * np.arange(len(slab.history["time"]))
        slab.history["momentum"] = slab.history["impulse"] + slab.history["support_impulse"]
        given, gained = figures_impact.balances(slab).axes[1].lines
        np.testing.assert_allclose(given.get_ydata(), gained.get_ydata() + given.get_ydata()[0])
        self.assertIn("supports", given.get_label())


if __name__ == "__main__":
    unittest.main()
