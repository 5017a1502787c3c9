"""The shipped tests in tension with penetrate, and what shared/tension reads off: closed forms.

Argument: the build folder."""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "compare"))
sys.dont_write_bytecode = True

import numpy as np  # noqa: E402

import tension_command  # noqa: E402

BUILD = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else ROOT / "build"
SCENES = ROOT / "data" / "scenes"


def elastic(body):
    """Returns words that make a body elastic aluminium without lateral motion, in which waves have one dimension."""
    return [f"{body}/Material/Law=J2", f"{body}/J2/Young's modulus=78.6 GPa", f"{body}/J2/Poisson's ratio=0",
            f"{body}/J2/Yield stress=100 GPa", f"{body}/J2/Hardening modulus=0 MPa", f"{body}/J2/Density=2700 kg/m3"]


class Tension(unittest.TestCase):
    def run_scene(self, name, *words):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / name
        subprocess.run([str(BUILD / "macro" / "penetrate"), str(SCENES / f"{name}.prm"), "--output", str(folder), "Run/Threads=1",
                        *words], check=True, capture_output=True)
        return tension_command.Result(folder)

    def test_a_free_end_of_an_elastic_bar_gets_the_velocity_of_the_striker(self):
        """Equal bars: the pulse has half of the striker's velocity, v, and stress rho c v / 2; the free end doubles its velocity. The
        step is kept for 2 L / c: here 52 us behind the arrival."""
        result = self.run_scene("spall_bar", *elastic("bar"), *elastic("incident"), *elastic("striker"), "bar/Rings=5",
                                "bar/Layers=35", "incident/Rings=5", "incident/Layers=84", "striker/Rings=5", "striker/Layers=20",
                                "striker/Height=140 mm", "striker/Velocity=4 m/s", "Time/End time=0.24 ms")
        found, speed, density = tension_command.evaluate_spall(result)
        self.assertAlmostEqual(speed, math.sqrt(78.6e9 / 2700), 3)
        self.assertAlmostEqual(found.wave_speed / speed, 1, delta=0.01)
        bar = result.bar("bar")
        end = bar.velocity[:, -1]
        arrival = 0.85 / speed
        inside = (bar.time > arrival + 12e-6) & (bar.time < arrival + 0.28 / speed - 12e-6)
        self.assertGreater(inside.sum(), 8)
        self.assertAlmostEqual(end[inside].mean(), 4, delta=0.04)
        self.assertAlmostEqual(end[bar.time < arrival - 12e-6].max(), 0, delta=0.04)
        tenth = len(bar.place) // 10
        arrival = (0.6 + bar.place[tenth] - bar.place[0]) / speed
        inside = (bar.time > arrival + 12e-6) & (bar.time < arrival + 0.28 / speed - 12e-6)
        stress = -bar.force_below(tenth)[inside].mean() / bar.area
        self.assertAlmostEqual(stress / (density * speed * 2), 1, delta=0.02)
        self.assertLess(abs(found.opening), 1e-6)

    def test_a_bar_that_is_pulled_apart_has_the_strength_of_the_law(self):
        """T_max, 2.47 MPa, limits the principal stress at rest; the ends hold the bar sideways, so that it breaks a little earlier."""
        result = self.run_scene("direct_tension", "Time/End time=1 ms")
        found = tension_command.evaluate_pull(result)
        self.assertAlmostEqual(found.strength / 2.47e6, 1, delta=0.04)
        self.assertAlmostEqual(found.rate, 0.4, delta=0.02)
        self.assertGreater(found.left, 0)

    def test_a_pulled_bar_breaks_in_one_band_and_carries_nothing_then(self):
        """A jump between two layers of points is a strain of both: the crack is there, and the rest of the bar has hardly opened. One
        point of the law takes 119 N/m."""
        for groove in (False, True):
            result = self.run_scene("notched_bar" if groove else "direct_tension", "Output/Frame interval=80 us")
            found = tension_command.evaluate_pull(result)
            self.assertEqual(found.left, 0)
            self.assertAlmostEqual(found.fracture_energy / 119, 1, delta=0.2)
            bar = result.bar("bar")
            steps = np.diff(bar.displacement[-1])
            widest = int(np.argmax(steps))
            around = steps[max(0, widest - 1):widest + 2].sum()
            self.assertGreater(around / steps.sum(), 0.85)
            if groove:
                self.assertAlmostEqual(bar.place[widest:widest + 2].mean(), 0.05, delta=0.008)

    def test_cracks_without_directions_take_more_as_other_layers_are_damaged_before_one_breaks(self):
        found = tension_command.evaluate_pull(self.run_scene("direct_tension", "bar/AFC/Crack model=isotropic", "Output/Frame interval=80 us"))
        self.assertEqual(found.left, 0)
        self.assertLess(found.fracture_energy, 1.8 * 119)
        self.assertGreater(found.fracture_energy, 1.2 * 119)

    def test_a_cube_splits_at_the_strength_of_the_law(self):
        """Tests have f_ct = 0.9 f_ct,sp (Eurocode 2)."""
        result = self.run_scene("splitting_cube", "Time/End time=2.6 ms", "Output/Frame interval=40 us")
        self.assertEqual(result.kind(), "split")
        found = tension_command.evaluate_split(result)
        self.assertAlmostEqual(0.9 * found.strength / 2.47e6, 1, delta=0.1)
        self.assertLess(found.left, 0.95)

    def test_a_coarse_bar_spalls_once_with_the_dynamic_strength_of_the_law(self):
        """4.07 T_max = 10.05 MPa in the plane of the crack; the free end reads it within a quarter."""
        result = self.run_scene("spall_bar", "bar/Rings=6", "bar/Layers=41", "incident/Rings=6", "incident/Layers=99",
                                "striker/Rings=6", "striker/Layers=13")
        found, _, _ = tension_command.evaluate_spall(result)
        self.assertTrue(found.open)
        self.assertAlmostEqual(found.carried / 10.05e6, 1, delta=0.1)
        self.assertAlmostEqual(found.strength / 10.05e6, 1, delta=0.25)
        self.assertGreater(found.pulse_out / found.pulse_in, 0.8)


if __name__ == "__main__":
    unittest.main()
