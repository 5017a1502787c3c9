"""What runs give beside every measured value of their shot, and beside the published formulas. Lengths in mm, velocities in m/s."""

import pathlib
import sys
from dataclasses import dataclass, field, replace

from tables import EXPERIMENT, NMAP, OURS, Table, band_text, text
from writing import Refused

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "empirical"))

import scene_shot  # noqa: E402
from predictions import predict  # noqa: E402
from shot import Shot  # noqa: E402

EXIT, DEPTH = "exit velocity (m/s)", "depth of penetration (mm)"
TIP = "depth of the front crater (mm), by the tip of the projectile"
SCAB = "crater on the rear face"
# A target whose thickness over the measured depth is at least this counts as thick.
THICK = 1.5


@dataclass
class Check:
    """One quantity of one run. None: not known. Of SCAB: 1 yes, 0 no."""

    run: str                  # name of the result
    shot: str                 # in words
    quantity: str
    measured: float
    scatter: float | None     # half of the range of the measured values, or their stated uncertainty
    tests: int
    computed: float | None
    band: tuple | None = None  # range of the computed value that the numerical error leaves open
    formulas: dict = field(default_factory=dict)  # name: (value, whether the shot is within the tests of the formula)
    test: tuple = ()          # what names the test, whichever run computes it
    place: tuple = ()         # among others: diameter of the projectile, thickness, impact velocity
    law: str = "AFC"          # of the concrete
    nmap: float | None = None  # computed by the paper

    @property
    def agrees(self):
        """Returns whether the ranges of the measured and the computed value meet, None without a computed value."""
        if self.computed is None:
            return None
        low, high = self.band or (self.computed, self.computed)
        return low <= self.measured + (self.scatter or 0) and high >= self.measured - (self.scatter or 0)


def measured_value(rows, column):
    """Returns (mean, scatter, number of tests) of a column experiment_NAME_UNIT over the tests of a shot, None without a value.
    The scatter is the larger of half the range and the stated experiment_NAME_uncertainty_UNIT; None if neither is known."""
    values = [row[column] for row in rows if isinstance(row.get(column), float)]
    if not values:
        return None
    unit = "m_s" if column.endswith("_m_s") else "mm"
    stated = [row.get(f"{column.removesuffix('_' + unit)}_uncertainty_{unit}") for row in rows]
    scatter = [value for value in stated if isinstance(value, float)]
    scatter += [0.5 * (max(values) - min(values))] if len(values) > 1 else []
    return sum(values) / len(values), max(scatter, default=None), len(values)


def shot_words(run):
    """Returns a shot in words."""
    diameter = run.number("projectile_radius")
    return (f"{text(diameter and 2e3 * diameter, 1)} mm, {text(run.number('impact_velocity'), 0)} m/s, "
            f"{text(run.number('thickness'), 0, 1e3)} mm of concrete")


def formula_rows(run, row):
    """Returns what the published formulas say about a run's shot, with the concrete and the nose of the test where its row states
    them: strength_mpa, density_kg_m3, crh. Returns [] if the inputs of the run do not have the numbers."""
    try:
        found = scene_shot.read(run.folder)
    except Refused:
        return []
    if "strength" not in found and not row.get("strength_mpa"):
        return []
    for column, name, factor in (("strength_mpa", "strength", 1e6), ("density_kg_m3", "density", 1.0)):
        if isinstance(row.get(column), float):
            found[name] = factor * row[column]
    if isinstance(row.get("crh"), float):
        found |= scene_shot.shots.ogive(row["crh"])
    return predict(Shot(**found))


def said(rows, name, factor=1.0):
    """Returns {formula: (value, within its tests)} of a quantity of the predictions."""
    return {row.formula: (factor * getattr(row, name), not row.outside) for row in rows if getattr(row, name) is not None}


def scabs(rows, thickness):
    return {row.formula: (float(thickness < row.scabbing), not row.outside) for row in rows if row.scabbing is not None}


def scaled_band(band):
    return None if band is None else (1e3 * band[0], 1e3 * band[1])


def computed_values(run, name, rows):
    """Returns [(column, quantity, computed, band, formulas)] of the files' columns that a run answers."""
    depth = run.penetration_depth
    tip = None if depth is None else 1e3 * depth, scaled_band(run.band(run.depth_key))
    if name == "perforation":
        return [("experiment_exit_m_s", EXIT, run.exit_velocity, run.exit_band, said(rows, "residual"))]
    if name == "penetration_depth":
        return [("experiment_depth_mm", DEPTH, *tip, said(rows, "depth", 1e3))]
    found = []
    for face, ours in (("front", "front"), ("rear", "back")):
        for what in ("diameter", "depth"):
            value, band = run.number(f"{ours}_crater_{what}"), run.band(f"{ours}_crater_{what}")
            found.append((f"experiment_{face}_{what}_mm", f"{what} of the {face} crater (mm)", None if value is None else 1e3 * value,
                          scaled_band(band), {}))
    return [*found, ("experiment_front_depth_mm", TIP, *tip, said(rows, "depth", 1e3))]


def scab_check(run, rows, shot, predictions):
    """Returns the check on whether there is a crater on the rear face at all."""
    values = [row["experiment_rear_diameter_mm"] for row in rows if isinstance(row.get("experiment_rear_diameter_mm"), float)]
    if not values:
        return None
    computed, thickness = run.number("back_crater_diameter"), run.number("thickness")
    return Check(run.name, shot, SCAB, float(sum(value > 0 for value in values) > len(values) / 2), None, len(values),
                 None if computed is None else float(computed > 0), formulas={} if thickness is None else scabs(
                     predictions, thickness))


def checks_of(run, references):
    """Returns the checks of one run: of all files that have a test of its shot."""
    found, shot, shots = [], shot_words(run), references.shots(run)
    for name in dict.fromkeys(name for name, _ in shots):
        rows = [row for file, row in shots if file == name]
        predictions = formula_rows(run, rows[0])
        for column, quantity, computed, band, formulas in computed_values(run, name, predictions):
            value = measured_value(rows, column)
            if value is None or (column == "experiment_depth_mm" and not thick(run, value[0])):
                continue
            nmap = measured_value(rows, column.replace("experiment", "nmap", 1))
            found.append(Check(run.name, shot, quantity, *value, computed, band, formulas, nmap=nmap and nmap[0]))
        scab = scab_check(run, rows, shot, predictions) if name == "sphere_craters" else None
        found += [scab] if scab else []
    place = tuple(run.number(key) or 0.0 for key in ("projectile_radius", "thickness", "impact_velocity"))
    law = run.inputs.get("Material/Law", "AFC")
    return [replace(check, test=(check.shot, check.quantity), place=place, law=law) for check in found]


def thick(run, depth):
    """Returns whether a target is thick enough for a measured depth, mm."""
    thickness = run.number("thickness")
    return thickness is not None and 1e3 * thickness >= THICK * depth


def collect(runs, references):
    """Returns the checks of all runs: exit velocities, depths, then craters, each by the size of the projectile, the thickness and
    the velocity."""
    order = {EXIT: 0, DEPTH: 1}
    return sorted((check for run in runs for check in checks_of(run, references)),
                  key=lambda check: (order.get(check.quantity, 2), check.place))


def one_per_test(checks, spacings):
    """Returns one check of each measured value and law of the concrete: that of the run with the finest spacing. spacings: {name of
    a run: m or None}."""
    best = {}
    for check in checks:
        known = best.get((check.test, check.law))
        if known is None or (spacings.get(check.run) or 1e9) < (spacings.get(known.run) or 1e9):
            best[check.test, check.law] = check
    return list(best.values())


def number(check, value):
    if value is None:
        return "–"
    return ("yes" if value else "no") if check.quantity == SCAB else text(value, 0)


def formulas_text(check):
    """Returns the smallest and the largest value of the formulas with their names; an asterisk: outside of the tests of the
    formula."""
    values = sorted((value, name + ("" if inside else "*")) for name, (value, inside) in check.formulas.items())
    if not values:
        return "–"
    if check.quantity == SCAB:
        return "; ".join(f"{word}: {', '.join(names)}" for word, names in (
            ("yes", [name for value, name in values if value]), ("no", [name for value, name in values if not value])) if names)
    return " to ".join(f"{value:.0f} ({name})" for value, name in dict.fromkeys((values[0], values[-1])))


def table(checks):
    rows = []
    for check in checks:
        band = band_text(check.band, 0)
        words = {True: "yes", False: "no", None: "–"}[check.agrees]
        rows.append([check.run, check.law, check.shot, check.quantity, number(check, check.measured), text(check.scatter, 0),
                     number(check, check.computed) + (f" ({band})" if band else ""), words, text(check.nmap, 0),
                     formulas_text(check)])
    return Table("Measured, computed, and by published formulas",
                 ["result", "law", "shot", "quantity", EXPERIMENT, "± measured", OURS, "ranges meet", NMAP,
                  "formulas: smallest to largest"],
                 rows,
                 "'± measured' is half of the range of several tests or the stated uncertainty, a dash where neither is published. "
                 "'ranges meet': measured value with its scatter, computed value with its numerical band. The formulas have the "
                 "strength of the test's concrete; an asterisk: the shot is outside of the tests that the formula was fitted to. "
                 "Craters are those of the end of a run: places that belong to fragments or have moved by more than half a "
                 "spacing, pressed concrete ahead of the projectile included.")


def verdict(checks):
    """Returns a sentence on how many values agree, for each law of the concrete."""
    sentences = []
    laws = laws_of(checks)
    for law in laws:
        known = [check for check in checks if check.agrees is not None and check.law == law]
        numbers, scabbing = ([check for check in known if (check.quantity == SCAB) == yes] for yes in (False, True))
        words = [f"{sum(check.agrees for check in part)} of {len(part)} {what}" for part, what in (
            (numbers, "computed numbers meet the measured ones within scatter and numerical band"),
            (scabbing, "answers on a crater on the rear face are right")) if part]
        sentences += [(f"{law}: " if len(laws) > 1 else "") + "; ".join(words) + "."] if words else []
    return " ".join(sentences) or None


def laws_of(checks):
    """Returns the laws of the concrete in the checks, AFC first."""
    return sorted({check.law for check in checks}, key=lambda law: (law != "AFC", law))
