"""Strength and fracture energy read off histories of bars with a known crack."""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.dont_write_bytecode = True
SHARED = pathlib.Path(__file__).resolve().parents[3] / "shared"
sys.path.insert(0, str(SHARED / "compare"))

import sections_tension  # noqa: E402
import synthetic  # noqa: E402
import tension  # noqa: E402
import tension_command  # noqa: E402
from writing import Refused  # noqa: E402

DENSITY, MODULUS, LENGTH, RADIUS = 2267.0, 18.7e9, 0.25, 0.037
SPEED, AREA = math.sqrt(MODULUS / DENSITY), math.pi * RADIUS**2
STRENGTH, ENERGY = 10e6, 150.0


def softened(gap, h, strength, widest):
    """Returns (stress, widest opening) of an elastic spring in series with a crack of linear softening, which closes to its origin."""
    last = 2 * ENERGY / strength
    trial = (MODULUS * gap / h - strength) / (MODULUS / h - strength / last)
    widest = max(widest, min(trial, last))
    envelope = strength * (1 - widest / last)
    if widest == 0:
        return MODULUS * gap / h, 0.0
    return (gap / (h / MODULUS + widest / envelope) if envelope > 0 else 0.0), widest


def chain(layers, velocity, pulse, end, strength=STRENGTH):
    """Returns a Bar: a chain of masses that a half sine of a pulse (largest velocity, duration) enters from below. One spring, 26 mm
    from the free end (where tension first reaches STRENGTH, as the formula of the pull-back takes for granted), is a crack with linear softening of STRENGTH and ENERGY that unloads to its origin."""
    h = LENGTH / layers
    mass, step = DENSITY * h, 0.5 * h / SPEED
    crack = layers - round(0.026 / h)  # the spring below this layer
    u, v, widest, frames = np.zeros(layers), np.zeros(layers), 0.0, []
    for n in range(int(end / step)):
        gap = np.diff(u)
        stress = MODULUS * gap / h
        if strength is not None and gap[crack - 1] > 0:
            stress[crack - 1], widest = softened(gap[crack - 1], h, strength, widest)
        time = n * step
        # A non-reflecting end: pressure of the incoming pulse and of what comes back.
        incoming = velocity * math.sin(math.pi * time / pulse) if time < pulse else 0.0
        below = -DENSITY * SPEED * (2 * incoming - v[0])
        v = v + step / mass * np.diff(np.concatenate([[below], stress, [0.0]]))
        u = u + step * v
        frames.append((time, u.copy(), v.copy()))
    time, u, v = (np.array([frame[i] for frame in frames]) for i in range(3))
    place = h * (np.arange(layers) + 0.5)
    return tension.Bar(time, place, np.full(layers, mass * AREA), u, v, AREA, DENSITY)


class SpallBar(unittest.TestCase):
    def test_strength_and_fracture_energy_of_a_known_crack(self):
        found = tension.spall(chain(125, 3.0, 50e-6, 400e-6), SPEED)
        self.assertAlmostEqual(found.carried / STRENGTH, 1, delta=0.03)
        self.assertAlmostEqual(found.fracture_energy / ENERGY, 1, delta=0.05)
        self.assertAlmostEqual(found.distance, 0.026, delta=0.003)
        self.assertTrue(found.open)
        self.assertEqual(found.cracks, 1)
        # The pull-back reads the strength late, as the crack goes on pulling while it opens.
        self.assertAlmostEqual(found.strength / STRENGTH, 1, delta=0.15)
        self.assertAlmostEqual(found.wave_speed / SPEED, 1, delta=0.02)
        self.assertAlmostEqual(found.pulse_in / (DENSITY * SPEED * 3.0), 1, delta=0.02)

    def test_planes_that_have_broken_side_by_side_are_as_many_cracks(self):
        """A plane beside a wider one belongs to its crack, and one that has hardly taken work is none."""
        for gaps, works, cracks in (([1, 9, 3, 1], [5, 120, 60, 5], 1), ([8, 1, 9, 1, 5], [110, 9, 120, 9, 100], 3),
                                    ([1, 9, 1, 2, 1], [9, 120, 9, 50, 9], 1), ([4, 4], [80, 80], 1), ([0, 0], [0, 0], 1)):
            self.assertEqual(tension.count_cracks(np.array(gaps, float), np.array(works, float)), cracks, gaps)

    def test_a_bar_that_holds_has_neither(self):
        found = tension.spall(chain(125, 3.0, 50e-6, 200e-6, strength=None), SPEED)
        self.assertIsNone(found.strength)
        self.assertAlmostEqual(found.top, 6.0, delta=0.1)  # a free end doubles the velocity of the wave
        self.assertFalse(found.open)


class PulledBar(unittest.TestCase):
    def test_the_work_ends_where_the_force_has_gone(self):
        opening = np.linspace(0, 100e-6, 400)
        stress = np.interp(opening, [0, 5e-6, 60e-6, 1.0], [0, 3e6, 0, 0])
        time = np.linspace(0, 1e-2, 400)
        momentum = np.concatenate([[0], np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(time))]) * AREA
        found = tension.pull(time, opening, momentum, AREA, 0.1)
        self.assertAlmostEqual(found.strength / 3e6, 1, delta=0.05)
        self.assertAlmostEqual(found.fracture_energy / (0.5 * 3e6 * 60e-6), 1, delta=0.02)
        self.assertEqual(found.left, 0)
        self.assertAlmostEqual(found.rate, 0.1)

    def test_a_force_that_stays_is_said(self):
        work, left = tension.opening_work(np.array([0.0, 2.0, 1.0, 1.0]), np.array([0.0, 1.0, 2.0, 3.0]))
        self.assertEqual((work, left), (3.5, 0.5))


class SplitCube(unittest.TestCase):
    def test_the_strength_is_that_of_the_elastic_disc_at_the_largest_force(self):
        time = np.linspace(0, 1e-3, 101)
        force = 30e3 * np.sin(np.pi * time / 1.5e-3)
        momentum = np.concatenate([[0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(time))])
        found = tension.split(time, 0.04 * time, momentum, 0.1, 0.2)
        self.assertAlmostEqual(found.strength / (2 * 30e3 / (np.pi * 0.1 * 0.2)), 1, 3)
        self.assertAlmostEqual(found.closing, 0.04 * 0.75e-3, 6)
        self.assertAlmostEqual(found.left, np.sin(np.pi / 1.5), delta=0.01)


def write_result(folder, bar):
    """Writes a bar as the result of a spall test: one ring of points to a layer, a quarter of the volume, and a striker."""
    pathlib.Path(folder, "resolved.prm").write_text(
        "subsection bar\n  set Shape = cylinder\n  set Diameter = 74 mm\n  set Height = 0.25 m\n  subsection Material\n"
        "    set Law = J2\n  end\n  subsection J2\n    set Density = 2267 kg/m3\n    set Young's modulus = 18.7 GPa\n  end\nend\n"
        "subsection striker\n  set Before = bar\nend\n", encoding="utf-8")
    with synthetic.changed_fields(pathlib.Path(folder, "fields.h5"), "w") as file:
        file.attrs["main_body"] = "bar"
        count = len(bar.place)
        for name in ("bar", "striker"):
            file[f"{name}/volume"] = 0.25 * bar.mass / DENSITY
            file[f"{name}/initial_position"] = np.column_stack([np.zeros((count, 2)), bar.place])
            file[f"{name}/spacing"] = np.full(count, bar.place[1] - bar.place[0])
        for frame, time in enumerate(bar.time):
            group = file.create_group(f"frames/{frame:03}")
            group.attrs["time"] = time
            for field, values in (("displacement", bar.displacement), ("velocity", bar.velocity)):
                group[f"bar/{field}"] = np.column_stack([np.zeros((count, 2)), values[frame]])


class Report(unittest.TestCase):
    def test_a_spall_bar_stands_beside_the_measured_one(self):
        class Run:
            name = "bar"

        with tempfile.TemporaryDirectory() as Run.folder:
            bar = chain(50, 3.0, 50e-6, 300e-6)
            write_result(Run.folder, bar)
            kind, found, why = sections_tension.evaluated(Run)
            expected = tension.spall(bar, SPEED)
            self.assertEqual((kind, why), ("spall", None))
            self.assertAlmostEqual(found.strength / expected.strength, 1, 6)
            self.assertAlmostEqual(found.fracture_energy / expected.fracture_energy, 1, 4)
            rows = sections_tension.rows_of("bar", kind, found)
            self.assertEqual([row[3] for row in rows], ["13.20", "175"])
            self.assertEqual(float(rows[0][4]), round(1e-6 * found.strength, 2))
            with self.assertRaises(Refused):
                tension_command.main(["pull", Run.folder])

    def test_a_bar_with_too_few_frames_says_so(self):
        class Run:
            name = "bar"

        with tempfile.TemporaryDirectory() as Run.folder:
            bar = chain(50, 3.0, 50e-6, 300e-6)
            bar.time = bar.time[:2]
            write_result(Run.folder, bar)
            kind, found, why = sections_tension.evaluated(Run)
        self.assertEqual((kind, found), ("spall", None))
        self.assertIn("found 2 frames", why)

    def test_another_run_is_left_out(self):
        class Run:
            name, folder = "slab", "/nowhere"

        self.assertIsNone(sections_tension.evaluated(Run))


class Command(unittest.TestCase):
    def test_layers(self):
        place = np.array([0.3, 0.1, 0.2, 0.101, 0.299])
        self.assertEqual(tension_command.layers_of(place, 0.1).tolist(), [2, 0, 1, 0, 2])

    def test_the_measured_rows(self):
        self.assertEqual(tension_command.measured("pull")["tensile_strength_mpa"], 3.24)
        self.assertEqual(tension_command.measured("spall")["fracture_energy_n_m"], 175.3)

    def test_refusals_are_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            for arguments in (["spall", folder], ["pull", folder], ["twist", folder], []):
                done = subprocess.run([str(SHARED / "tension"), *arguments], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 2, arguments)
                self.assertEqual(done.stdout, "")
                self.assertIn("tension: ", done.stderr)
            with self.assertRaises(Refused):
                tension_command.main(["spall", folder])


if __name__ == "__main__":
    unittest.main()
