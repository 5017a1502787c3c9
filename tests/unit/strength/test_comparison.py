"""The table of data/README.md that compares the rules with published concretes, computed again."""

import bisect
import csv
import io
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "strength"))

import concrete_files  # noqa: E402
import reference  # noqa: E402
import rules  # noqa: E402
import scene_shot  # noqa: E402

POINT = pathlib.Path(os.environ.get("SPALL_BUILD", ROOT / "build")) / "macro" / "material_point"
RATE, PRESSURES, STRAINS = 1e-3, (50, 100, 200), (0.01, 0.05, 0.1)


def constants(law):
    """Returns {key: number} of a section of a material file, in the units that it is written in."""
    name = {"HJC": "concrete_48_hjc.prm", "RHT": "concrete_35_rht.prm"}[law]
    keys = scene_shot.read_keys(ROOT / "data" / "materials" / name)
    return {key.removeprefix(f"{law}/"): reference.number(text) for key, text in keys.items() if key.startswith(f"{law}/")}


def afc(c, P):
    return (c["C1"] - c["C2"] * math.exp(-c["A_N"] * P) + c["C4"] * P) * (1 + c["C3"] * math.log(RATE))


def hjc(c, P):
    """Eq. of macro/material/hjc.h at D = 0; its reference rate is 1/s."""
    return c["fc"] * min(c["SFMAX"], (c["A"] + c["B"] * (P / c["fc"]) ** c["N"]) * (1 + c["C"] * math.log(RATE)))


def rht(c, P):
    """Eq. of macro/material/rht_surface.h for 3 P* >= F."""
    F = (RATE / c["Reference rate in compression"]) ** c["beta_c"]
    return c["fc"] * c["A"] * (P / c["fc"] - F / 3 + (c["A"] / F) ** (-1 / c["N"])) ** c["N"]


def pressures(path):
    """Returns the pressures (MPa) of first loading at STRAINS, by material_point."""
    done = subprocess.run([str(POINT), str(path), str(ROOT / "data/experiments/hydrostatic.csv")], capture_output=True, text=True,
                          check=True)
    rows = [(-3 * float(row["exx"]), float(row["pressure"]) / 1e6) for row in csv.DictReader(io.StringIO(done.stdout))]
    first = next(i for i in range(1, len(rows)) if rows[i][0] < rows[i - 1][0])  # where the path unloads
    found = []
    for strain in STRAINS:
        behind = bisect.bisect([mu for mu, _ in rows[:first]], strain)
        (a, low), (b, high) = rows[behind - 1], rows[behind]
        found.append(low + (high - low) * (strain - a) / (b - a))
    return found


class Comparison(unittest.TestCase):
    def setUp(self):
        if not POINT.exists():
            self.skipTest("material_point is not built")
        self.readme = (ROOT / "data" / "README.md").read_text(encoding="utf-8")

    def expect(self, name, strengths, crushing, path):
        row = " | ".join([name, ", ".join(f"{s:.0f}" for s in strengths), f"{crushing:.1f}",
                          ", ".join(f"{p:.0f}" for p in pressures(path))])
        self.assertTrue(f"| {row} |\n" in self.readme, row)

    def test_the_table_is_what_the_rules_and_the_programs_give(self):
        for law, surface, begin in (("HJC", hjc, "Pcrush"), ("RHT", rht, "Pel")):
            other = constants(law)
            concrete = rules.Concrete(1e6 * other["fc"], rules.AGGREGATE, other["Density"])
            lines = rules.afc(concrete)
            ours = {key: reference.number(text) for key, text, _ in lines if key and key != "Readings"}
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "concrete.prm"
                path.write_text(concrete_files.texts(concrete, lines, rules.microcell(concrete, lines), path.parent, [""])[0])
                self.expect(f"{other['fc']:.0f} MPa by the rules", [afc(ours, P) for P in PRESSURES], ours["C6"], path)
            file = f"concrete_{other['fc']:.0f}_{law.lower()}.prm"
            self.expect(f"`{file}`", [surface(other, P) for P in PRESSURES], other[begin], ROOT / "data" / "materials" / file)
            ratios = ", ".join(f"{afc(ours, P) / surface(other, P):.2f}" for P in PRESSURES)
            self.assertIn(f"{ratios} of {law}", self.readme)


if __name__ == "__main__":
    unittest.main()
