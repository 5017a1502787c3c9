"""The published formulas against numbers that were evaluated apart from them, at their branches, and under scaling."""

import pathlib
import sys
import unittest
from dataclasses import replace

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "empirical"))

import cavity_formulas  # noqa: E402
import limit_formulas as limits  # noqa: E402
import predictions  # noqa: E402
import shot as shots  # noqa: E402

# The semi-armour-piercing projectile at 313 m/s; in inches the slabs are 5, 8.5 and 10 thick.
SLABS = [shots.Shot(0.0508, 2.34, 313, 38.2e6, thickness, 2267, **shots.ogive(3)) for thickness in (0.127, 0.2159, 0.254)]
DEPTHS = [shots.Shot(0.0269, mass, velocity, strength, None, 2370, **shots.ogive(2))
          for mass, velocity, strength in ((0.906, 277, 35.2e6), (0.905, 642, 34.7e6))]


def of(rows, name):
    return next(row for row in rows if row.formula == name)


def residuals(name):
    return [of(predictions.predict(slab), name).residual for slab in SLABS]


def scaled(shot, factor):
    """The same shot, geometrically similar."""
    thickness = None if shot.thickness is None else factor * shot.thickness
    return replace(shot, diameter=factor * shot.diameter, mass=factor**3 * shot.mass, thickness=thickness)


class KnownNumbers(unittest.TestCase):
    def close(self, found, wanted, digits=0):
        self.assertEqual([round(value, digits) for value in found], wanted)

    def test_residual_velocities_of_three_slabs(self):
        for name, wanted in ((predictions.FORRESTAL, [197, 0, 0]), (predictions.PLUG, [283, 163, 0]), (limits.NDRC, [298, 197, 93]),
                             (limits.CHANG, [278, 117, 0]), (limits.CEA, [277, 107, 0])):
            with self.subTest(name):
                self.close(residuals(name), wanted)

    def test_depths_of_two_shots(self):
        for name, wanted in ((limits.NDRC, [137, 532]), (predictions.FORRESTAL, [168, 699])):
            with self.subTest(name):
                self.close([1e3 * of(predictions.predict(shot), name).depth for shot in DEPTHS], wanted)

    def test_forrestal_is_near_the_measured_depths(self):
        """173 and 620 mm, of the tests that the formula was published with."""
        for shot, measured in zip(DEPTHS, (0.173, 0.620)):
            self.assertLess(abs(cavity_formulas.forrestal(shot).depth() / measured - 1), 0.13)

    def test_numbers_over_the_diameter(self):
        """Evaluated with a calculator, 127 mm slab: G = 3.8e-5 1.14 2.34 / (0.0508 6180.6) 6161.4^1.8 = 2.1401, I = 449.098."""
        shot = SLABS[0]
        x = limits.ndrc_depth(shot)
        found = [limits.impact_factor(shot, 1.14), x, limits.ndrc_perforation(x), limits.ndrc_scabbing(x),
                 limits.degen_perforation(x), limits.ace_depth(shot), limits.hughes_number(shot), limits.hughes_depth(shot),
                 limits.chang_perforation(shot), limits.chang_scabbing(shot), limits.cea_perforation(shot),
                 limits.ukaea_depth(shot)]
        self.close(found, [2.1401, 3.1401, 5.2137, 6.3905, 4.7407, 3.4494, 449.098, 3.5019, 4.4954, 6.8667, 4.4522, 3.0796], 4)

    def test_noses(self):
        ogive, hemisphere, cone = shots.ogive(3), shots.hemisphere(), shots.cone(1)
        self.assertAlmostEqual(ogive["nose_factor"], 23 / 216)  # (8 CRH - 1) / (24 CRH^2)
        self.assertAlmostEqual(ogive["nose_length"], 1.6583, 4)
        self.assertEqual((hemisphere["nose"], hemisphere["nose_factor"], hemisphere["nose_length"]), ("hemisphere", 0.5, 0.5))
        self.assertAlmostEqual(cone["nose_factor"], 0.2)
        self.assertEqual([shots.ogive(crh)["nose"] for crh in (0.5, 1.2, 1.3)], ["hemisphere", "blunt", "sharp"])


class Branches(unittest.TestCase):
    """Formulas of two branches: the jump where they meet is the rounding of the published coefficients."""

    def jump(self, function, place):
        return abs(function(place * (1 + 1e-9)) - function(place * (1 - 1e-9)))

    def test_limits_over_depth(self):
        for function, place, allowed in ((limits.ndrc_scabbing, 0.65, 1e-3), (limits.ndrc_perforation, 1.35, 5e-3),
                                         (limits.degen_perforation, 1.52, 1e-3), (limits.hughes_scabbing, 0.7, 0.02),
                                         (limits.hughes_perforation, 0.7, 0.02)):
            with self.subTest(function.__name__):
                self.assertLess(self.jump(function, place), allowed)

    def velocity(self, factor):
        """The velocity at which the NDRC factor of the first slab's shot has this value."""
        shot = SLABS[0]
        return shot.velocity * (factor / limits.impact_factor(shot, 1.14)) ** (1 / 1.8)

    def test_ndrc_depth_below_at_and_above_g_of_one(self):
        for factor, wanted in ((0.25, 1.0), (1.0, 2.0), (2.5, 3.5)):
            self.assertAlmostEqual(limits.ndrc_depth(replace(SLABS[0], velocity=self.velocity(factor))), wanted, 6)

    def test_ukaea_depth_in_its_three_branches(self):
        for factor, wanted in ((0.0356, 0.075), (0.0726, 0.22), (0.3105, 1.0), (1.0605, 2.0), (2.0, 2.9395)):
            found = limits.ukaea_depth(replace(SLABS[0], velocity=self.velocity(factor)))
            self.assertAlmostEqual(found, wanted, 3)

    def test_both_forms_of_cea_edf_agree(self):
        """The limit velocity is published as 1.3 rho^(1/6) sqrt(f) (d H^2 / M)^(2/3): the same law, other coefficients."""
        for slab in SLABS:
            other = 1.3 * slab.density ** (1 / 6) * slab.strength**0.5 * (slab.diameter * slab.thickness**2 / slab.mass) ** (2 / 3)
            self.assertLess(abs(of(predictions.predict(slab), limits.CEA).limit / other - 1), 4e-3)


class Scaling(unittest.TestCase):
    def test_similar_shots(self):
        """Depths over the diameter stay the same, but those of NDRC grow as G with the length to the power of 0.2, and those of ACE
        less its 0.5 with that of 0.215."""
        small, large = SLABS[0], scaled(SLABS[0], 3.0)
        for function in (limits.hughes_depth, limits.chang_perforation, limits.chang_scabbing, limits.cea_perforation):
            self.assertAlmostEqual(function(large) / function(small), 1.0, 9)
        self.assertAlmostEqual(limits.impact_factor(large, 1) / limits.impact_factor(small, 1), 3**0.2, 9)
        self.assertAlmostEqual((limits.ace_depth(large) - 0.5) / (limits.ace_depth(small) - 0.5), 3**0.215, 9)
        for name in (predictions.FORRESTAL, predictions.LI_CHEN, predictions.PLUG):
            one, other = of(predictions.predict(small), name), of(predictions.predict(large), name)
            if name != predictions.PLUG:
                self.assertAlmostEqual(other.depth / one.depth, 3.0, 6)
            self.assertAlmostEqual(other.perforation / one.perforation, 3.0, 5)
            self.assertAlmostEqual(other.limit / one.limit, 1.0, 5)
            self.assertAlmostEqual(other.residual / one.residual, 1.0, 5)


class CavityPhases(unittest.TestCase):
    def test_force_and_velocity_are_continuous_and_keep_the_energy(self):
        cavity = cavity_formulas.forrestal(DEPTHS[0])
        end, edge = cavity.depth(), cavity.crater_depth
        self.assertLess(edge, end)
        for function in (cavity.force, cavity.squared_velocity):
            self.assertAlmostEqual(function(edge * (1 + 1e-9)) / function(edge * (1 - 1e-9)), 1.0, 6)
        self.assertAlmostEqual(cavity.squared_velocity(end) / DEPTHS[0].velocity**2, 0.0, 9)
        steps = 20000
        work = sum(cavity.force((i + 0.5) * end / steps) for i in range(steps)) * end / steps
        self.assertAlmostEqual(work / (0.5 * DEPTHS[0].mass * DEPTHS[0].velocity**2), 1.0, 6)

    def test_the_closed_form_of_1994(self):
        """x = M / (2 pi a^2 N* rho) ln(1 + N* rho V1^2 / (S f)) + 4 a, V1^2 = (M V^2 - 4 pi a^3 S f) / (M + 4 pi a^3 N* rho)."""
        import math
        a, mass, velocity, inertia = 0.01345, 0.906, 277.0, (1 / 6 - 1 / 96) * 2370
        static = 82.6 * 35.2**-0.544 * 35.2e6
        squared = (mass * velocity**2 - 4 * math.pi * a**3 * static) / (mass + 4 * math.pi * a**3 * inertia)
        depth = mass / (2 * math.pi * a**2 * inertia) * math.log(1 + inertia * squared / static) + 4 * a
        self.assertAlmostEqual(cavity_formulas.forrestal(DEPTHS[0]).depth(), depth, 9)

    def test_the_dimensionless_form_of_2003(self):
        """x / d = sqrt((1 + k pi / (4 N)) / (1 + I / N) 4 k I / pi) up to k, then
        2 N / pi ln((1 + I / N) / (1 + k pi / (4 N))) + k."""
        import math
        for velocity, deep in ((277.0, True), (60.0, False)):
            shot = replace(DEPTHS[0], velocity=velocity)
            k, mass_number = 0.707 + math.sqrt(1.75), shot.mass / ((1 / 6 - 1 / 96) * 2370 * shot.diameter**3)
            impact = shot.mass * velocity**2 / (72 * 35.2**-0.5 * 35.2e6 * shot.diameter**3)
            near = 1 + k * math.pi / (4 * mass_number)
            wanted = 2 * mass_number / math.pi * math.log((1 + impact / mass_number) / near) + k if deep else \
                math.sqrt(near / (1 + impact / mass_number) * 4 * k * impact / math.pi)
            self.assertEqual(wanted > k, deep)
            self.assertAlmostEqual(cavity_formulas.li_chen(shot).depth() / shot.diameter, wanted, 9)

    def test_a_plug_parts_where_the_force_reaches_its_strength(self):
        cavity = cavity_formulas.forrestal(SLABS[1])
        velocity = cavity.behind_plug()
        end = SLABS[1].thickness
        x = next(i * end / 20000 for i in range(1, 20001) if cavity.force(i * end / 20000) >= cavity.plug_force(i * end / 20000))
        self.assertLess(x, end)
        self.assertAlmostEqual(velocity, cavity.squared_velocity(x) ** 0.5, 1)
        self.assertEqual(cavity.plug_force(end), 0)


class Limits(unittest.TestCase):
    def test_a_limit_just_perforates(self):
        """At the ballistic limit the perforation limit is the thickness, and the residual velocity is 0 below and grows above."""
        for slab in SLABS:
            for row in predictions.predict(slab):
                if row.limit is None:
                    continue
                with self.subTest(row.formula):
                    at = of(predictions.predict(replace(slab, velocity=row.limit)), row.formula)
                    self.assertLess(abs(at.perforation / slab.thickness - 1), 2e-3)
                    below, above = (of(predictions.predict(replace(slab, velocity=factor * row.limit)), row.formula).residual
                                    for factor in (0.999, 1.05))
                    self.assertEqual(below, 0)
                    self.assertGreater(above, 0)

    def test_recht_and_ipson(self):
        self.assertEqual(predictions.recht_ipson(2.0, 100.0, 100.0), 0)
        self.assertAlmostEqual(predictions.recht_ipson(2.0, 125.0, 100.0), 75.0)
        self.assertAlmostEqual(predictions.recht_ipson(2.0, 125.0, 100.0, plug=1.0), 50.0)

    def test_a_thick_target_has_no_residual_velocity(self):
        for row in predictions.predict(DEPTHS[0]):
            self.assertEqual((row.limit, row.residual), (None, None))

    def test_shots_outside_of_the_tests_are_named(self):
        rows = predictions.predict(SLABS[0])
        self.assertEqual(of(rows, limits.NDRC).outside, ())
        self.assertIn("for flat noses", of(rows, limits.CHANG).outside)
        self.assertIn("thickness over diameter 2.5 not in 3 to 18", of(rows, limits.ACE).outside)
        flat = predictions.predict(replace(SLABS[0], velocity=150.0, **shots.flat()))
        self.assertEqual((of(flat, limits.CHANG).outside, of(flat, limits.CEA).outside), ((), ()))
        self.assertIn("for sharp noses", of(flat, predictions.FORRESTAL).outside)


if __name__ == "__main__":
    unittest.main()
