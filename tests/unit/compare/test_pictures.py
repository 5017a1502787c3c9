"""What pictures of points show, and which part of them is filled, on synthetic results (see synthetic.py)."""

import pathlib
import sys
import unittest

import numpy as np

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402

import figures_points  # noqa: E402
import figures_slabs  # noqa: E402
import frames  # noqa: E402
import reading  # noqa: E402
import style  # noqa: E402

# Pictures that nobody looks at: most of the time goes into pixels and into the layout.
matplotlib.rcParams.update({"savefig.dpi": 30, "figure.constrained_layout.use": False})


def rings(radius=0.5, thickness=0.1, edge=0.01):
    """A slab of rings with a damaged core of 0.1 m, and a projectile of 0.3 m that sticks in its back."""
    x, z = (a.ravel() for a in np.meshgrid(edge * (np.arange(round(radius / edge)) + 0.5),
                                           edge * (np.arange(round(thickness / edge)) + 0.5), indexing="ij"))
    initial = np.column_stack([x, np.zeros_like(x), z])
    damage = (x < 0.1).astype(float)
    dart = frames.Rigid("dart", np.array([[0.0, 0.0], [-0.1, 0.02], [-0.3, 0.02], [-0.3, 0.0]]), np.array([0, 0, thickness]),
                        np.array([1.0, 0, 0, 0]))
    fields = {"tensile_damage": damage, "shear_damage": damage, "velocity": np.zeros_like(initial),
              "fragment": np.where(x < 0.05, 1 + np.arange(len(x)), 0)}
    return frames.Frame(1e-3, initial, initial.copy(), 2 * np.pi * x * edge**2, fields, {"symmetry_planes": "axis"}, [], [dart])


def discs(axes):
    """All points that are drawn, n x 2, mm."""
    return np.vstack([collection.get_offsets() for collection in axes.collections])


def fragments(count):
    """A slab of which `count` points are fragments of one point each."""
    frame = rings()
    number = frame.fields["fragment"]
    number[number > count] = 0
    return frame


class Filled(synthetic.InFolder):
    def test_rings_cover_the_faces_up_to_the_rim_of_the_picture(self):
        drawn = figures_points.damage_faces(rings())
        for axes in drawn.axes[:4]:
            places, reach = discs(axes), axes.get_xlim()[1]
            self.assertLess(reach, 200)  # the damage ends at 100 mm
            grid = np.stack(np.meshgrid(*[np.linspace(-0.9 * reach, 0.9 * reach, 21)] * 2), -1).reshape(-1, 2)
            nearest = np.linalg.norm(grid[:, None] - places[None], axis=2).min(axis=1)
            self.assertLess(nearest.max(), 12)  # gaps of 10 mm

    def test_faces_without_damage_are_drawn_whole(self):
        frame = rings()
        for name in ("tensile_damage", "shear_damage"):
            frame.fields[name][:] = 0
        self.assertGreater(figures_points.damage_faces(frame).axes[0].get_xlim()[1], 500)

    def test_a_section_is_filled_by_target_and_projectile_however_thick_the_target_is(self):
        for thickness in (0.05, 0.3, 1.0):
            frame = rings(thickness=thickness)
            half, low, high = figures_points.picture_limits(frame)
            body = max(thickness, 0.3)  # the projectile reaches 0.3 m out of the back
            self.assertGreaterEqual(high - low, body)
            self.assertLess(high - low, 1.1 * body)
            self.assertLessEqual(half, 1.04 * 0.505)  # no farther than the rim
            self.assertGreaterEqual(half, min(0.5, 0.5 * body))

    def test_debris_far_away_does_not_shrink_the_section(self):
        frame = rings()
        frame.position[0, 2] = 30.0
        _, low, high = figures_points.picture_limits(frame)
        self.assertLess(high - low, 1.0)

    def test_other_bodies_show_their_damage(self):
        frame = rings()
        second = rings()
        second.position[:, 2] += 0.4
        frame.bodies.append(frames.Cloud("second", second.initial, second.position, second.edges, second.fields))
        plate = rings(thickness=0.02)
        plate.position[:, 2] += 0.7
        frame.bodies.append(frames.Cloud("plate", plate.initial, plate.position, plate.edges, {}))
        axes = figures_points.damage_section(frame).axes[0]
        colored = [collection for collection in axes.collections if collection.get_array() is not None]
        self.assertEqual(len(colored), 2)
        self.assertEqual([collection.get_array().max() for collection in colored], [1, 1])
        self.assertLess(axes.get_ylim()[1], 0)
        self.assertGreater(axes.get_ylim()[0], 720)


class Fragments(synthetic.InFolder):
    def test_the_heaviest_have_colours_of_their_own_and_none_is_grey(self):
        shown = len(figures_points.PIECES)
        colors = figures_points.piece_colors(np.arange(1, 3 * shown))
        self.assertEqual(len(np.unique(colors[:shown].round(6), axis=0)), shown)
        self.assertGreater(np.ptp(colors, axis=1).min(), 0.05)
        heavy = {tuple(color) for color in colors[:shown].round(6)}
        self.assertFalse(heavy & {tuple(color) for color in colors[shown:].round(6)})

    def test_the_scale_names_the_masses_from_the_heaviest_on(self):
        frame = fragments(25)
        masses = {k: 0.1 / k for k in range(1, 26)}
        scale = figures_points.debris(frame, masses).axes[2]
        self.assertEqual(scale.get_ylabel(), "mass of a fragment (g)")
        words = [label.get_text() for label in scale.get_yticklabels()]
        self.assertEqual(words[:2] + words[-1:], ["100", "50", "15 more, pale,\n9.09 and less"])
        self.assertTrue(scale.yaxis_inverted())

    def test_without_masses_they_have_numbers(self):
        scale = figures_points.debris(fragments(2), {}).axes[2]
        self.assertEqual([label.get_text() for label in scale.get_yticklabels()], ["no. 1", "no. 2"])

    def test_a_target_without_fragments_is_drawn(self):
        self.assertEqual(len(figures_points.debris(fragments(0), {}).axes), 3)


class CutAxes(synthetic.InFolder):
    def marks(self, drawn):
        style.mark_cut_axes(drawn)
        return sum(line.get_gid() == "cut axis" for axes in drawn.axes for line in axes.lines)

    def test_an_axis_that_does_not_reach_zero_is_marked(self):
        for limits, marked in (((200, 300), True), ((0, 300), False), ((-5, 5), False), ((-300, -200), True), ((300, 0), False)):
            drawn, axes = style.figure()
            axes.set_ylim(limits)
            self.assertEqual(self.marks(drawn) > 0, marked, limits)

    def test_pictures_of_places_logarithms_and_scales_of_colours_are_not(self):
        drawn, (place, log) = style.figure(8, 4, 1, 2)
        place.set_aspect("equal")
        place.set_ylim(5, 6)
        log.set(yscale="log", ylim=(5, 6))
        drawn.colorbar(place.scatter([0], [5.5], c=[5.5], vmin=5, vmax=6), ax=place)
        self.assertEqual(self.marks(drawn), 0)

    def test_velocities_begin_at_zero(self):
        slab = reading.read_result(synthetic.slab(self.folder / "slab", 290.0))
        drawn = figures_slabs.velocity(slab, None)
        self.assertEqual(drawn.axes[0].get_ylim()[0], 0)
        self.assertEqual(self.marks(drawn), 0)


if __name__ == "__main__":
    unittest.main()
