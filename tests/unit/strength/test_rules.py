"""The rules that make a concrete from its strength: the reference comes back, and every constant obeys its law."""

import math
import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "strength"))

import reference  # noqa: E402
import rules  # noqa: E402

DENSITY = 2267.0
STRENGTHS = [1e6 * f for f in (8.5, 20, 25, 30, 35, 38.2, 40, 48, 60, 90, 150)]


def made(strength=rules.STRENGTH, aggregate=rules.AGGREGATE, density=DENSITY):
    """Returns {key: value} of both files of a concrete."""
    concrete = rules.Concrete(strength, aggregate, density)
    afc = rules.afc(concrete)
    found = {f"AFC/{key}": text for key, text, _ in afc if key}
    return found | {f"{section}/{key}": text for section, entries in rules.microcell(concrete, afc) for key, text, _ in entries}


def numbers(found):
    return {key: reference.number(text) for key, text in found.items() if re.match(r"[\d.]+", text)}


def source_number(file, pattern):
    return float(re.search(pattern, (ROOT / file).read_text(encoding="utf-8"))[1])


class Reference(unittest.TestCase):
    def test_its_strength_aggregate_and_density_give_back_its_files(self):
        found = made()
        for folder in ("materials", "microcells"):
            for key, text in reference.keys(folder).items():
                if key != "Material/Law":
                    self.assertEqual(found.pop(key), text, key)
        self.assertEqual(found, {"AFC/Compressive strength": "38.2 MPa", "AFC/Lode fading pressure": "323 MPa",
                                 "AFC/Shear damage reference length": "0.1 m"})

    def test_numbers_outside_of_its_files_are_those_of_the_program_and_of_the_readme(self):
        self.assertEqual(rules.STRENGTH, source_number("macro/material/tensile_rate.h", r"compressive_strength = ([\d.e]+);"))
        self.assertEqual(rules.LODE_FADING, source_number("macro/material/failure_surface.h", r"lode_fading = ([\d.e]+);"))
        self.assertEqual(rules.CRUSH_LENGTH, source_number("macro/material/shear_damage.h", r"double reference = ([\d.e]+);"))
        self.assertAlmostEqual(rules.LODE_FADING / rules.STRENGTH, 8.45, delta=0.01)
        readme = "data/microcells/README.md"
        self.assertAlmostEqual(1e3 * rules.AGGREGATE, source_number(readme, r"for ([\d.]+) mm aggregate"), 12)
        self.assertAlmostEqual(rules.tensile_strength(rules.STRENGTH) / 1e6, source_number(readme, r"([\d.]+) MPa, from 3.912"), 3)
        self.assertAlmostEqual(rules.fracture_energy(rules.STRENGTH, rules.AGGREGATE),
                               source_number(readme, r"([\d.]+) N/m over its width, from 187.5"), 1)
        self.assertAlmostEqual(rules.crush_energy(rules.STRENGTH, rules.AGGREGATE) / 1e3, 24, 1)

    def test_a_reference_with_a_key_that_no_rule_scales_is_refused(self):
        with self.assertRaises(reference.Refused) as refused:
            reference.all_known({"C1": "1 MPa", "C10": "1 MPa"}, ["C1"])
        self.assertIn("(C10)", str(refused.exception))


class Laws(unittest.TestCase):
    def test_every_constant_grows_falls_or_stays_with_the_strength(self):
        falls = {"AFC/A_N", "AFC/D1", "AFC/Shear damage reference length"}
        stays = {"AFC/Density", "AFC/C3", "AFC/C4", "AFC/C7", "AFC/C9", "Material/Poisson's ratio", "Cell/Sizes",
                 "Cell/Reference size", "Cell/Initial crack"}
        rows = [numbers(made(strength)) for strength in STRENGTHS]
        self.assertTrue(falls | stays < set(rows[0]))
        for key in rows[0]:
            for low, high in zip(rows, rows[1:]):
                change = high[key] / low[key] - 1
                if key in stays:
                    self.assertLess(abs(change), 1e-5, key)
                else:
                    self.assertGreater(-change if key in falls else change, 0, key)

    def test_the_strength_surface_keeps_its_shape_over_the_strength(self):
        """Y(P; r f) = r Y(P / r; f), with the constants as they are written."""
        def surface(values, P):
            return values["AFC/C1"] - values["AFC/C2"] * math.exp(-values["AFC/A_N"] * P) + values["AFC/C4"] * P
        for base in (20e6, 30e6, 38.2e6):
            for r in (1.1, 2.0, 3.0):
                low, high = numbers(made(base)), numbers(made(r * base))
                self.assertAlmostEqual(high["AFC/C5"] / low["AFC/C5"], r, 4)
                self.assertAlmostEqual(high["AFC/D1"] * r / low["AFC/D1"], 1, 4)
                for P in (0.0, 10.0, 50.0, 200.0, 1000.0):
                    self.assertAlmostEqual(surface(high, P) / (r * surface(low, P / r)), 1, 4)

    def test_pressures_and_moduli_of_the_hydrostat_grow_with_the_root(self):
        low, high = numbers(made(20e6)), numbers(made(60e6))
        for key in ("C6", "C8", "K1", "K2", "K3", "Shear modulus"):
            self.assertAlmostEqual(high[f"AFC/{key}"] / low[f"AFC/{key}"], math.sqrt(3), 4)

    def test_the_microcell_has_the_elastic_constants_of_the_material(self):
        for strength in STRENGTHS:
            found = numbers(made(strength))
            E, nu = found["Material/Young's modulus"], found["Material/Poisson's ratio"]
            self.assertAlmostEqual(E / (3 * (1 - 2 * nu)) / (found["AFC/C6"] / found["AFC/C7"]), 1, 5)
            self.assertAlmostEqual(E / (2 * (1 + nu)) / found["AFC/Shear modulus"], 1, 5)

    def test_tension_follows_the_model_codes(self):
        self.assertAlmostEqual(rules.tensile_strength(38e6), 1.4e6 * 3 ** (2 / 3), 3)
        low, high = numbers(made(18e6)), numbers(made(88e6))
        for key in ("AFC/T_max", "Material/Tensile strength"):
            self.assertAlmostEqual(high[key] / low[key], 4, 4)
        self.assertAlmostEqual(high["Material/Fracture energy"] / low["Material/Fracture energy"], (88 / 18) ** 0.18, 4)

    def test_larger_aggregate_takes_more_fracture_energy_and_nothing_else_but_the_crush_length(self):
        low, high = numbers(made(aggregate=5e-3)), numbers(made(aggregate=40e-3))
        self.assertEqual({key for key in low if low[key] != high[key]},
                         {"Material/Fracture energy", "AFC/Shear damage reference length"})
        ratio = ((1 + 40 / 11.27) / (1 + 5 / 11.27)) ** 0.22
        for key in ("Material/Fracture energy", "AFC/Shear damage reference length"):
            self.assertAlmostEqual(high[key] / low[key], ratio, 4)
        for d, base in ((8e-3, 25), (16e-3, 30), (32e-3, 58)):
            ceb = rules.ceb_aggregate_factor(d) / rules.ceb_aggregate_factor(8e-3)
            self.assertAlmostEqual(ceb, base / 25, 2)

    def test_density_changes_itself_only(self):
        low, high = made(density=2000.0), made(density=2600.0)
        self.assertEqual({key for key in low if low[key] != high[key]}, {"AFC/Density"})
        self.assertEqual(high["AFC/Density"], "2600 kg/m3")


if __name__ == "__main__":
    unittest.main()
