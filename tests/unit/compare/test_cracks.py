"""The spectrum of cracks, on faces whose cracks are drawn at angles that are known."""

import pathlib
import sys
import unittest

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import cracks  # noqa: E402

WIDTH = 0.02
INNER, OUTER = 0.2, 0.7


def rings():
    """Points at gaps of WIDTH on rings of multiples of four, as the polar layout has them."""
    found = []
    for r in WIDTH * (np.arange(int(0.76 / WIDTH)) + 0.5):
        count = 4 * max(1, round(np.pi * r / (2 * WIDTH)))
        angle = 2 * np.pi * (np.arange(count) + 0.5) / count
        found.append(r * np.column_stack([np.cos(angle), np.sin(angle)]))
    return np.vstack(found)


def cracked(position, angles):
    """Damage of radial cracks two points wide."""
    radius, angle = np.hypot(*position.T), np.arctan2(position[:, 1], position[:, 0])
    away = np.abs((angle[:, None] - np.asarray(angles) + np.pi) % (2 * np.pi) - np.pi).min(axis=1)
    return np.clip(1.5 - radius * away / WIDTH, 0, 1)


def share(position, damage):
    return cracks.of_layout(harmonics(position, damage)).sum()


def harmonics(position, damage):
    return cracks.harmonics(position, np.ones(len(position)), damage, INNER, OUTER, WIDTH)


class Spectrum(unittest.TestCase):
    def test_cracks_with_the_symmetry_of_the_layout_are_all_of_it(self):
        eighth = np.array([0.0, 0.3, 0.6])
        angles = [sign * angle + i * np.pi / 2 for i in range(4) for angle in eighth for sign in (1, -1)]
        self.assertAlmostEqual(share(rings(), cracked(rings(), angles)), 1, places=9)

    def test_equal_quarters_without_mirrors_are_of_it_in_part(self):
        angles = [angle + i * np.pi / 2 for i in range(4) for angle in (0.1, 0.6)]
        found = harmonics(rings(), cracked(rings(), angles))
        self.assertAlmostEqual((np.abs(found[cracks.ORDERS % 4 == 0]) ** 2).sum(), 1, places=9)
        self.assertLess(cracks.of_layout(found).sum(), 0.9)

    def test_cracks_anywhere_leave_it_an_eighth(self):
        rng, position = np.random.default_rng(3), rings()
        found = [share(position, cracked(position, rng.uniform(0, 2 * np.pi, 9))) for _ in range(300)]
        mean, deviation = cracks.chance()
        self.assertEqual(mean, 0.125)
        self.assertAlmostEqual(np.mean(found), mean, delta=4 * deviation / np.sqrt(300))
        self.assertAlmostEqual(np.std(found), deviation, delta=0.3 * deviation)

    def test_a_number_of_equal_cracks_is_its_harmonic(self):
        power = np.abs(harmonics(rings(), cracked(rings(), 2 * np.pi * np.arange(5) / 5))) ** 2
        self.assertGreater(power[cracks.ORDERS % 5 == 0].sum(), 0.98)
        self.assertAlmostEqual(power.sum(), 1)

    def test_damage_that_depends_on_the_radius_alone_counts_nothing(self):
        position = rings()[3:]  # the innermost ring is no longer whole
        damage = np.floor(np.hypot(*position.T) / WIDTH) / 40
        self.assertIsNone(harmonics(position, damage))

    def test_a_quarter_turn_and_a_mirror_change_nothing(self):
        position, damage = rings(), cracked(rings(), [0.1, 1.5, 2.8, 4.0])
        for operation in ([[0, 1], [-1, 0]], [[1, 0], [0, -1]]):
            self.assertAlmostEqual(share(position, damage), share(position @ np.array(operation), damage), places=9)

    def test_the_verdict_says_whether_they_follow(self):
        for part, words in ((1.0, "points, they follow it ("), (0.6, "they follow it in part"), (0.2, "do not follow it")):
            layout = cracks.ORDERS % cracks.OF_LAYOUT == 0
            found = np.sqrt(np.where(layout, part / layout.sum(), (1 - part) / (~layout).sum())).astype(complex)
            self.assertIn(words, cracks.verdict(found))


if __name__ == "__main__":
    unittest.main()
