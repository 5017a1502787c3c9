"""Colours of the figures, and the data of the page's charts and slider, on synthetic results (see synthetic.py)."""

import base64
import itertools
import json
import pathlib
import sys
import unittest

import numpy as np
import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402
from matplotlib.colors import to_rgb  # noqa: E402

import charts  # noqa: E402
import figures_slabs  # noqa: E402
import film  # noqa: E402
import reading  # noqa: E402
import style  # noqa: E402

matplotlib.rcParams.update({"savefig.dpi": 30, "figure.constrained_layout.use": False})

# What people without one kind of cones see, in linear RGB: Machado, Oliveira and Fernandes (2009), severity 1.
SEEN = {"all": np.eye(3),
        "no long waves": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
        "no middle waves": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]),
        "no short waves": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]])}
JUST_SEEN = 2.3  # smallest distance in CIELAB that is seen
XYZ = np.array([[0.412456, 0.357576, 0.180438], [0.212673, 0.715152, 0.072175], [0.019334, 0.119192, 0.950304]])


def lab(color, seen):
    """Returns a colour as it is seen, in CIELAB (D65)."""
    rgb = np.array(to_rgb(color))
    linear = np.clip(seen @ np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4), 0, 1)
    x, y, z = (XYZ @ linear) / (XYZ @ np.ones(3))
    f = [np.cbrt(t) if t > 0.008856 else 7.787 * t + 16 / 116 for t in (x, y, z)]
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def nearest(colors):
    """Returns the smallest distance of two of the colours, for whoever sees it smallest."""
    return min(np.linalg.norm(lab(a, seen) - lab(b, seen)) for seen in SEEN.values() for a, b in itertools.combinations(colors, 2))


class Colours(synthetic.InFolder):
    def test_the_measure_finds_colours_that_are_confused(self):
        self.assertLess(nearest(["#c0392b", "#7f5539"]), nearest([style.BLUE, style.VERMILLION]) / 2)

    def test_all_lines_of_a_figure_differ_for_all_eyes(self):
        self.assertGreater(nearest(style.CYCLE), 3 * JUST_SEEN)
        self.assertGreater(nearest([style.OURS, style.EXPERIMENT, style.NMAP, style.CONVERGED]), 5 * JUST_SEEN)
        looks = [tuple(style.line_look(i).values()) for i in range(len(style.CYCLE) * len(style.LINES))]
        self.assertEqual(len(set(looks)), len(looks))

    def test_neighbours_in_the_flow_of_energy_differ_for_all_eyes_and_in_their_hatches(self):
        slab = reading.read_result(synthetic.slab(self.folder / "slab"))
        layers = figures_slabs.energy_flow(slab).axes[0].collections
        self.assertGreater(len(layers), 7)
        for below, above in zip(layers, layers[1:]):
            self.assertGreater(nearest([below.get_facecolor()[0], above.get_facecolor()[0]]), 5 * JUST_SEEN)
            self.assertNotEqual(below.get_hatch() or "", above.get_hatch() or "")


class Ticks(unittest.TestCase):
    def test_ticks_of_logarithms_are_numbers(self):
        drawn, axes = style.figure()
        axes.loglog([1e-4, 1], [1, 1e5])
        style.plain_logarithms(drawn)
        words = [label.get_text() for axis in (axes.xaxis, axes.yaxis) for label in axis.get_ticklabels(which="both")]
        self.assertIn("0.01", words)
        self.assertFalse([word for word in words if "$" in word])


class Lines(synthetic.InFolder):
    def test_a_line_keeps_its_shape_with_few_corners(self):
        drawn, axes = style.figure()
        x = np.linspace(0, 10, 5000)
        y = 300 - 40 * np.tanh(3 * (x - 4)) + 5 * np.sin(6 * x)
        axes.plot(x, y, linestyle="--", color=style.BLUE, label="one")
        axes.axhline(250, label="measured")
        one, measured = charts.of_figure(drawn)[0]["lines"]
        self.assertLess(len(one["x"]), 400)
        fine = np.linspace(0, 10, 20000)
        away = np.hypot((x[::10, None] - fine) / np.ptp(axes.get_xlim()),
                        (y[::10, None] - np.interp(fine, one["x"], one["y"])) / np.ptp(axes.get_ylim())).min(axis=1)
        self.assertLess(away.max(), 2 * charts.TOLERANCE)
        self.assertEqual((one["color"], one["dash"], one["label"]), (style.BLUE, charts.DASHES["--"], "one"))
        self.assertEqual(measured["y"], [250, 250])
        np.testing.assert_allclose(measured["x"], axes.get_xlim(), rtol=1e-3)

    def test_pictures_and_bars_have_no_chart(self):
        for draw in (lambda axes: axes.bar([1, 2, 3], [1, 2, 3]), lambda axes: axes.set_aspect("equal")):
            drawn, axes = style.figure()
            axes.plot([1, 2, 3], [1, 2, 3])
            draw(axes)
            self.assertEqual(charts.of_figure(drawn), [])

    def test_the_chart_of_a_shot_has_the_numbers_of_its_history(self):
        folder = synthetic.slab(self.folder / "slab")
        synthetic.change_summary(folder, struck_face=0.0, projectile_radius=0.0254, projectile_mass=2.34)
        slab = reading.read_result(folder)
        found = charts.explorer(slab)
        columns = {column["label"]: column["values"] for column in found["across"] + found["up"]}
        self.assertEqual(len({len(values) for values in columns.values()}), 1)
        np.testing.assert_allclose(columns["velocity of the projectile (m/s)"][-1], slab.history["projectile_velocity"][-1], rtol=1e-3)
        np.testing.assert_allclose(columns["depth of the tip (mm)"][-1], 1e3 * slab.history["projectile_position"][-1], rtol=1e-3)
        depth, force = 1e-3 * np.array(columns["depth of the tip (mm)"]), 1e3 * np.array(columns["force on the projectile (kN)"])
        lost = 1.17 * (313.0**2 - 210.0**2)
        self.assertAlmostEqual(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(depth)) / lost, 1, delta=0.05)  # work of the force


class Slider(synthetic.InFolder):
    def test_the_states_are_those_of_the_frames(self):
        folder = synthetic.slab(self.folder / "slab")
        last = reading.read_result(folder).frame
        states = film.states_of(folder / "fields.h5", last)
        self.assertEqual([state.time for state in states], [0.0, last.time])
        data = film.data(states)
        self.assertLess(len(json.dumps(data)), 2 * film.BYTES)
        count, names = data["count"], data["names"]
        raw = base64.b64decode(data["states"][-1]["points"])
        self.assertEqual(len(raw), (4 + len(names)) * count)
        x, z = np.frombuffer(raw[:4 * count], "<u2").reshape(2, -1)
        inside = x < film.STEPS
        self.assertGreater(inside.sum(), count / 4)
        width, height = 2 * data["half"], data["high"] - data["low"]
        np.testing.assert_allclose(x[inside] / (film.STEPS - 1) * width - data["half"], states[-1].x[inside], atol=2e-4 * width)
        np.testing.assert_allclose(z[inside] / (film.STEPS - 1) * height + data["low"], states[-1].z[inside], atol=2e-4 * height)
        damage = np.frombuffer(raw[4 * count:], "u1").reshape(len(names), -1) / film.LEVELS
        for name, values in zip(names, damage):
            np.testing.assert_allclose(values, states[-1].damage[name], atol=1 / 255)

    def test_other_bodies_are_shown_and_steel_has_no_damage(self):
        path = synthetic.slab(self.folder / "slab") / "fields.h5"
        alone = film.states_of(path, reading.read_result(path.parent).frame)
        synthetic.add_cloud(path, "plate", np.array([[0.01, 0.001, 0.2], [0.02, 0.001, 0.2], [0.02, 0.2, 0.2]]), np.full(3, 1e-6))
        states = film.states_of(path, reading.read_result(path.parent).frame)
        data = film.data(states)
        self.assertEqual(data["count"], len(alone[0].x) + 4)  # two of its points lie in the section, and their mirror images
        for state in data["states"]:
            damage = np.frombuffer(base64.b64decode(state["points"])[4 * data["count"]:], "u1").reshape(2, -1)
            self.assertEqual([(row == film.NO_DAMAGE).sum() for row in damage], [4, 4])

    def test_a_run_without_damage_has_no_slider(self):
        folder = synthetic.slab(self.folder / "slab")
        last = reading.read_result(folder).frame
        for name in ("shear_damage", "tensile_damage"):
            last.fields.pop(name)
        self.assertEqual(film.states_of(folder / "fields.h5", last), [])


if __name__ == "__main__":
    unittest.main()
