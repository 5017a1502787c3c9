"""What pictures show of points and rigid bodies, on synthetic results (see synthetic.py)."""

import math
import pathlib
import sys
import unittest

import numpy as np

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402

import figures_points  # noqa: E402
import frames  # noqa: E402
import points  # noqa: E402
import reading  # noqa: E402

# Pictures that nobody looks at: most of the time goes into pixels and into the layout.
matplotlib.rcParams.update({"savefig.dpi": 30, "figure.constrained_layout.use": False})


class Points(synthetic.InFolder):
    def test_mirroring_in_two_planes_makes_four_symmetric_copies(self):
        rng = np.random.default_rng(1)
        quarter, damage = rng.random((50, 3)) + 0.01, rng.random(50)
        (whole,), (values,) = points.mirrored("x y", [quarter], [damage])
        self.assertEqual((len(whole), len(values)), (200, 200))
        together = np.column_stack([whole, values])
        for axis in (0, 1):
            image = together.copy()
            image[:, axis] *= -1
            self.assertEqual(set(map(tuple, image)), set(map(tuple, together)))
        np.testing.assert_array_equal(np.sort(whole[:, 2]), np.sort(np.tile(quarter[:, 2], 4)))

    def test_a_whole_body_is_left_alone(self):
        (whole,), _ = points.mirrored("", [np.eye(3)], [])
        np.testing.assert_array_equal(whole, np.eye(3))

    def test_faces_and_section_of_a_lattice_are_its_outer_layers(self):
        frame = reading.read_result(synthetic.slab(self.folder / "slab")).frame
        size, z = np.cbrt(frame.volume), frame.initial[:, 2]
        for front, level in ((True, z.min()), (False, z.max())):
            layer = points.face_layer(frame.initial, size, front)
            np.testing.assert_array_equal(layer, np.flatnonzero(np.abs(z - level) < 1e-9))
        section = points.section_layer(frame.initial, size)
        y = frame.initial[:, 1]
        np.testing.assert_array_equal(section, np.flatnonzero(np.abs(y - y.min()) < 1e-9))

    def test_faces_of_a_graded_lattice_hold_one_point_per_column(self):
        # Columns of 4 mm beside columns of 16 mm, layers of the same edge as the column is wide.
        fine = np.stack(np.meshgrid(*[0.004 * (np.arange(n) + 0.5) for n in (8, 8, 32)]), -1).reshape(-1, 3)
        coarse = np.stack(np.meshgrid(*[0.016 * (np.arange(n) + 0.5) for n in (4, 4, 8)]), -1).reshape(-1, 3)
        coarse[:, 0] += 0.032
        initial = np.vstack([fine, coarse])
        size = np.r_[np.full(len(fine), 0.004), np.full(len(coarse), 0.016)]
        self.assertEqual(len(points.face_layer(initial, size, True)), 8 * 8 + 4 * 4)
        self.assertEqual(len(points.face_layer(initial, size, False)), 8 * 8 + 4 * 4)

    def test_faces_of_a_half_plane_are_its_outer_layers(self):
        # Rings of 10 mm by 10 mm, 5 layers: their volumes grow with the radius, their cross sections do not.
        edge = 0.01
        x, z = (a.ravel() for a in np.meshgrid(edge * (np.arange(60) + 0.5), edge * (np.arange(5) + 0.5), indexing="ij"))
        initial = np.column_stack([x, np.zeros_like(x), z])
        size = points.cell_edges("axis", initial, 2 * np.pi * x * edge**2)
        np.testing.assert_allclose(size, edge)
        for front, level in ((True, z.min()), (False, z.max())):
            np.testing.assert_array_equal(points.face_layer(initial, size, front), np.flatnonzero(z == level))

    def test_rings_are_drawn_around_the_axis_at_gaps_of_their_edge(self):
        plane = np.array([[0.5, 0.0, 1.0], [2.0, 0.0, 3.0]])
        (whole,), (values,) = points.mirrored("axis", [plane], [np.array([7.0, 8.0])], np.array([0.1, 0.1]))
        self.assertEqual([(values == v).sum() for v in (7.0, 8.0)], [round(np.pi / 0.1), round(4 * np.pi / 0.1)])
        np.testing.assert_allclose(np.hypot(whole[:, 0], whole[:, 1]), np.where(values == 7, 0.5, 2.0))
        np.testing.assert_array_equal(whole[:, 2], np.where(values == 7, 1.0, 3.0))
        np.testing.assert_allclose(whole[:, :2].mean(axis=0), 0, atol=1e-12)

    def test_an_outline_is_closed_symmetric_and_where_the_body_is(self):
        body = frames.Rigid("p", synthetic.ogive(), np.array([0.0, 0.0, 0.5]), np.array([1.0, 0, 0, 0]))
        x, z = points.outline_in_section(body)
        self.assertAlmostEqual(x[0], 0.0)
        self.assertAlmostEqual(z[0], 0.5)
        self.assertAlmostEqual(z[0] - z.min(), 0.3556)
        self.assertAlmostEqual(x.max(), 0.0254)
        np.testing.assert_allclose(x, -x[::-1], atol=1e-15)
        np.testing.assert_allclose(z, z[::-1], atol=1e-15)

    def test_an_oblique_body_is_drawn_at_its_angle(self):
        # Turned by 30 degrees about y, from z towards x: a point of the axis goes along (sin 30, cos 30).
        half = math.radians(15)
        body = frames.Rigid("p", np.array([[0.0, 0.0], [-1.0, 0.1], [-1.0, 0.0]]), np.array([0.2, 0.0, 0.3]),
                            np.array([math.cos(half), 0.0, math.sin(half), 0.0]))
        x, z = points.outline_in_section(body)
        tail = 0.2 - 0.5, 0.3 - math.sqrt(0.75)
        np.testing.assert_allclose([(x[2], z[2])], [tail])  # the middle of the tail
        across = np.array([x[1] - x[-2], z[1] - z[-2]])  # from side to side of the tail
        np.testing.assert_allclose(across, 0.2 * np.array([math.sqrt(0.75), -0.5]), atol=1e-12)

    def test_rigid_bodies_are_read_with_their_place_and_only_those_with_an_outline(self):
        folder = synthetic.slab(self.folder / "slab")
        turn = (math.cos(0.1), 0.0, math.sin(0.1), 0.0)
        synthetic.add_rigid(folder / "fields.h5", "my dart", synthetic.ogive(0.01, 0.05), (0.1, 0.0, -0.1), turn)
        with synthetic.changed_fields(folder / "fields.h5") as file:
            file["frames/001"].attrs["wall_x"] = 0.0  # a body without an outline
        found = {body.name: body for body in reading.read_result(folder).frame.rigids}
        self.assertEqual(set(found), {"projectile", "my dart"})
        np.testing.assert_allclose(found["my dart"].quaternion, turn)
        np.testing.assert_allclose(found["my dart"].origin, [0.1, 0.0, -0.1])
        axes = figures_points.damage_section(reading.read_result(folder).frame).axes[0]
        self.assertEqual(len(axes.patches), 2)


if __name__ == "__main__":
    unittest.main()
