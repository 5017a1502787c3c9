"""Measured values and those of the paper. The names of the columns state their units."""

import math
import pathlib
import re
from dataclasses import dataclass, field

from files import Unreadable, read_table

UNCERTAINTY = "experiment_exit_uncertainty_m_s"
EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "data" / "experiments"


# Columns that each file must have.
NEEDED = {"perforation": ("thickness_mm", "impact_m_s", "experiment_exit_m_s"),
          "taylor": ("material", "impact_velocity_m_s", "final_length_ratio_converged"),
          "peer_codes": ("code", "method", "cost_ns", "final_length_ratio", "remark"),
          "slab_verification": ("set", "friction", "thickness_mm", "impact_m_s", "exit_m_s"),
          "penetration_depth": ("impact_m_s", "projectile_mass_kg", "experiment_depth_mm"),
          "sphere_craters": ("thickness_mm", "impact_m_s", "projectile_mass_kg", "experiment_front_diameter_mm",
                             "experiment_rear_diameter_mm"),
          "steel_plates": ("thickness_mm", "impact_m_s", "projectile_mass_kg", "experiment_exit_m_s")}


def read_rows(path, needed=()):
    """Returns the rows of a .csv as dicts, with numbers where the text is a number, or [] if there is no such file. Capitals in
    the names of the columns do not matter. @raises Unreadable: a column is missing, or a number has a decimal comma"""
    if not path.is_file():
        return []
    columns = {name.lower(): texts for name, texts in read_table(path).items()}
    for name in needed:
        if name not in columns:
            raise Unreadable(f"{path}: column '{name}' is missing, found: {', '.join(columns)}")

    def value(text):
        try:
            return float(text)
        except ValueError:
            if re.fullmatch(r"[+-]?\d*,\d+(e[+-]?\d+)?", text, re.IGNORECASE):
                raise Unreadable(f"{path}: found '{text}', allowed: a number with a decimal point, no comma") from None
            return text or None

    return [dict(zip(columns, map(value, row))) for row in zip(*columns.values())]


# What defines a shot: column of perforation.csv, penetration_depth.csv and sphere_craters.csv, key of the summary, factor from the
# key's SI unit to the column's, and the tolerance in the column's unit or, with "%", in percent. Velocities and masses of
# nominally equal tests scatter by about a percent; diameters and lengths are nominal.
SHOT = [("thickness_mm", "thickness", 1e3, "1 %"), ("impact_m_s", "impact_velocity", 1.0, "1 %"),
        ("target_diameter_mm", "diameter", 1e3, "2 %"), ("projectile_mass_kg", "projectile_mass", 1.0, "2 %"),
        ("projectile_diameter_mm", "projectile_radius", 2e3, "1 %"),
        ("projectile_length_mm", "projectile_length", 1e3, "2 %"),
        ("obliquity_deg", "obliquity", 180 / math.pi, "1"), ("angle_of_attack_deg", "angle_of_attack", 180 / math.pi, "1")]


def is_test_of(row, result, but=()):
    """Returns whether a row of a file of shots is a test of the shot of a run. An angle that is not stated is 0; any other
    quantity that the row does not state is not compared, nor are the columns `but`."""
    for column, key, factor, tolerance in SHOT:
        if column in but:
            continue
        unstated = 0.0 if column.endswith("_deg") else None
        measured, computed = row.get(column), result.number(key)
        measured, computed = (unstated if value is None else value for value in (measured, computed))
        if measured is None:
            continue
        if computed is None:
            return False
        allowed = float(tolerance.rstrip(" %")) * (abs(measured) / 100 if tolerance.endswith("%") else 1)
        if abs(measured - factor * computed) > allowed:
            return False
    return True


def mean_row(rows):
    """Returns one row for several tests of a shot: means of the columns that have numbers, and the number of `tests`; None
    for no row. The uncertainty is the larger of the stated one and half the range of the tests."""
    if not rows:
        return None
    one = dict(rows[0], tests=len(rows))
    for column in one:
        numbers = [row[column] for row in rows if isinstance(row.get(column), float)]
        if numbers and column != "tests":
            one[column] = sum(numbers) / len(numbers)
    exits = [row["experiment_exit_m_s"] for row in rows if row.get("experiment_exit_m_s") is not None]
    stated = [row[UNCERTAINTY] for row in rows if row.get(UNCERTAINTY) is not None]
    ranges = [0.5 * (max(exits) - min(exits))] if len(exits) > 1 else []
    one[UNCERTAINTY] = max(stated + ranges, default=None)
    return one


@dataclass
class References:
    """Measured values and those of the paper, one dict per row of the files in data/experiments."""

    perforation: list
    taylor: list
    peers: list
    verification: list  # converged solutions of slabs
    depths: list = field(default_factory=list)  # of penetration
    craters: list = field(default_factory=list)
    plates: list = field(default_factory=list)  # of steel
    digitised: list = field(default_factory=list)  # curves read off the paper's figures (digitised.py)

    @classmethod
    def read(cls, folder=EXPERIMENTS):
        folder = pathlib.Path(folder)
        if not folder.is_dir():
            raise Unreadable(f"{folder}: no such folder of references")
        return cls(*(read_rows(folder / f"{name}.csv", needed) for name, needed in NEEDED.items()))

    def slab(self, result):
        """Returns the row of the tests of this shot, the mean of several, or None if there is no such test. A row of a
        test agrees with the run in every quantity of SHOT that it states."""
        if result.has_bonded_layer:
            return None
        return mean_row([row for row in self.perforation + self.plates if is_test_of(row, result)])

    def shots(self, result):
        """Returns [(name of the file, row)] of all tests of this shot, in the order of the files."""
        if result.has_bonded_layer:
            return []
        return [(name, row) for name, rows in (("perforation", self.perforation), ("penetration_depth", self.depths),
                                               ("sphere_craters", self.craters), ("steel_plates", self.plates)) for row in rows if is_test_of(row, result)]

    def bar(self, result):
        """Returns the row of the Taylor bar with this impact velocity, or None."""
        velocity = result.number("impact_velocity")
        for row in self.taylor:
            if velocity is not None and abs(row["impact_velocity_m_s"] - velocity) < 0.5:
                return row
        return None
