"""The body in space: the picture of it and the data of the view that turns."""

import base64
import json
import pathlib
import sys
import unittest

import numpy as np
import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import frames  # noqa: E402
import solid  # noqa: E402


def numbers(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


class Solid(synthetic.InFolder):
    def setUp(self):
        super().setUp()
        self.path = synthetic.slab(self.folder / "slab") / "fields.h5"

    def scene(self):
        return solid.scene_of(frames.read_frame(self.path)[0])

    def test_places_radii_and_damage_are_those_of_the_points(self):
        scene = self.scene()
        data = solid.data(scene)
        low, high = np.array(data["low"]), np.array(data["high"])
        places = low + numbers(data["places"], "<u2").reshape(-1, 3) / 65535 * (high - low)
        np.testing.assert_allclose(places, scene.places, atol=0.02)  # mm
        np.testing.assert_allclose(numbers(data["radius"], "u1") / 254 * data["largest"], scene.radius, rtol=0.01)
        np.testing.assert_allclose(numbers(data["damage"], "u1") / 254, scene.damage, atol=0.002)

    def test_the_data_is_small(self):
        scene = self.scene()
        text = json.dumps(solid.data(scene))
        self.assertLess(len(text), 8 * 4 / 3 * len(scene.radius) + 2000)  # 8 bytes a point, three of which are four letters
        self.assertLess(8 * 4 / 3 * solid.MOST_POINTS, 0.5e6)

    def test_spheres_have_the_volume_of_the_points(self):
        frame, scene = frames.read_frame(self.path)[0], self.scene()
        self.assertAlmostEqual((4 / 3 * np.pi * scene.radius**3).sum(), 1e9 * frame.volume.sum(), delta=1e-6 * 1e9 * frame.volume.sum())

    def test_many_points_are_thinned_keep_their_volume_and_it_is_said(self):
        whole, most = self.scene(), solid.MOST_POINTS
        self.addCleanup(setattr, solid, "MOST_POINTS", most)
        self.assertEqual(whole.words, "")
        damaged = int((whole.damage >= 0.15).sum())
        solid.MOST_POINTS = damaged + 300
        fewer = self.scene()
        self.assertEqual(len(fewer.radius), solid.MOST_POINTS)
        self.assertIn(f"300 of {len(whole.radius) - damaged} sound points", fewer.words)
        self.assertAlmostEqual((fewer.radius**3).sum() / (whole.radius**3).sum(), 1, places=6)
        np.testing.assert_array_equal(fewer.places, self.scene().places)

    def test_points_that_have_flown_far_are_left_out_and_it_is_said(self):
        with synthetic.changed_fields(self.path) as file:
            file["frames/001/slab/position"][0] = 50.0, 0.0, 0.0
        scene = self.scene()
        self.assertTrue(scene.words.startswith("1 of "), scene.words)
        self.assertLess(np.abs(scene.places).max(), 2000)

    def test_a_body_without_damage_is_steel(self):
        synthetic.add_cloud(self.path, "plate", np.array([[0.01, 0.01, 0.2], [0.02, 0.01, 0.2]]), np.full(2, 1e-6))
        data = solid.data(self.scene())
        self.assertEqual((numbers(data["damage"], "u1") == solid.NO_DAMAGE).sum(), 2)

    def test_a_surface_is_drawn_at_its_place_in_front_of_what_is_behind_it(self):
        frame = frames.read_frame(self.path)[0]
        middle = np.array([0.0, 0.0, 0.06])
        low = frames.Surface(np.array([[0, 0, 0.3], [0.01, 0, 0.3], [0, 0.01, 0.3]]), np.array([[0, 1, 2]]))  # it has come through
        frame.surfaces = [low]
        right, up, towards = 0.1 * solid.axes_of_view(solid.scene_of(frame))
        bare, bare_scale = solid.rendered(solid.scene_of(frame))

        def seen(height):
            """Returns the area in mm2 of a triangle of 20,000 mm2 that can be seen, at some height towards the reader."""
            corners = middle + height * towards + np.array([-right - up, right - up, up])
            frame.surfaces = [low, frames.Surface(corners, np.array([[0, 1, 2]]))]
            picture, scale = solid.rendered(solid.scene_of(frame))
            self.assertEqual(scale, bare_scale)
            return (picture != bare).any(axis=2).sum() / scale**2

        self.assertAlmostEqual(seen(5), 20000, delta=1200)  # its rim is half a pixel wide
        self.assertLess(seen(-5), 4000)  # behind the slab, but for its hole

    def test_the_struck_face_is_seen_where_nothing_has_come_through(self):
        frame = frames.read_frame(self.path)[0]
        corners = np.array([[0, 0, 0.0], [0.01, 0, 0.0], [0, 0.01, 0.0]])
        for depth, behind in ((0.1, False), (0.2, True)):
            frame.surfaces = [frames.Surface(corners + [0, 0, depth], np.array([[0, 1, 2]]))]
            towards = solid.axes_of_view(solid.scene_of(frame))[2]
            self.assertEqual(towards[2] > 0, behind)

    def test_triangles_without_corners_are_refused(self):
        with synthetic.changed_fields(self.path) as file:
            file["projectile/triangles"] = np.array([[0, 1, 99]])
        with self.assertRaises(frames.Unreadable):
            frames.read_frame(self.path)


if __name__ == "__main__":
    unittest.main()
