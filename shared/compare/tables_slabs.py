"""Tables of slabs: comparison with experiment and paper, craters, fragments, energies, soundness of a run."""

from dataclasses import dataclass, replace

import numpy as np

import validation
from references import UNCERTAINTY
from tables import (EXPERIMENT, NMAP, OURS, Table, band_text, band_verdict, banded, difference, numerically, relative, text,
                    with_unit)


def projectile_mass(slab):
    """Returns the mass in kg from the summary, or from the initial kinetic energy and velocity; None without either."""
    if slab.number("projectile_mass") is not None:
        return slab.number("projectile_mass")
    if slab.history is None or len(slab.history["time"]) == 0 or slab.history["projectile_velocity"][0] == 0:
        return None
    return 2.0 * slab.history["projectile_kinetic_energy"][0] / slab.history["projectile_velocity"][0] ** 2


@dataclass
class Perforation:
    """One perforation, computed or measured. Velocities in m/s, energies in J, thickness in m."""

    impact: float
    exit: float
    mass: float | None
    thickness: float | None
    exits: tuple | None = None  # range of the exit velocity that the numerical error leaves open

    def band(self, name, scale=1.0):
        """Returns the range of a quantity that the numerical error leaves open, or None."""
        ends = [getattr(replace(self, exit=end), name) for end in self.exits or ()]
        return None if not ends or None in ends else (scale * min(ends), scale * max(ends))

    @property
    def delta_v_percent(self):
        return 100.0 * (self.impact - self.exit) / self.impact

    @property
    def delta_ke_percent(self):
        return 100.0 * (1.0 - (self.exit / self.impact) ** 2)

    @property
    def absorbed(self):
        return None if self.mass is None else 0.5 * self.mass * (self.impact**2 - self.exit**2)

    @property
    def absorbed_per_thickness(self):
        return self.absorbed / self.thickness if self.absorbed is not None and self.thickness else None


def perforations(slab, row):
    """Returns (ours, experiment, NMAP), None where there is no value. All have the mass of our projectile."""
    mass, thickness = projectile_mass(slab), slab.number("thickness")
    impact, exit_velocity = slab.number("impact_velocity"), slab.exit_velocity
    ours = Perforation(impact, exit_velocity, mass, thickness, slab.exit_band) \
        if impact is not None and exit_velocity is not None else None
    if not row:
        return ours, None, None
    return ours, *(None if row.get(key) is None else Perforation(row["impact_m_s"], row[key], mass, thickness)
                   for key in ("experiment_exit_m_s", "nmap_exit_m_s"))


def slab_table(slab, row):
    ours, experiment, nmap = perforations(slab, row)
    quantities = [("exit velocity (m/s)", "exit", 1, 1.0, "m/s"),
                  ("velocity change (% of impact velocity)", "delta_v_percent", 1, 1.0, "points"),
                  ("change of kinetic energy (%)", "delta_ke_percent", 1, 1.0, "points"),
                  ("absorbed energy (kJ)", "absorbed", 2, 1e-3, "kJ"),
                  ("absorbed energy per thickness (kN)", "absorbed_per_thickness", 0, 1e-3, "kN")]
    rows = []
    for label, name, digits, scale, unit in quantities:
        values = [getattr(p, name) if p else None for p in (ours, experiment, nmap)]
        cells = [label, banded(values[0], ours and ours.band(name), digits, scale), *(text(v, digits, scale) for v in values[1:])]
        for value in (values[0], values[2]):
            cells.append(with_unit(difference(value, values[1]), unit, digits, scale))
            cells.append(with_unit(relative(value, values[1]), "%"))
        rows.append(cells)
    if slab.penetration_depth is not None:
        rows.append(["penetration depth (mm)", banded(slab.penetration_depth, slab.band(slab.depth_key), 1, 1e3)] + 6 * ["–"])
    return Table("Exit velocity and energy against experiment and paper",
                 ["quantity", OURS, EXPERIMENT, NMAP, "Spall − experiment", "Spall, relative",
                  "NMAP − experiment", "NMAP, relative"], rows,
                 "'Points' are percentage points; 'relative' is the difference divided by the measured value. "
                 "Percentages are recomputed from the velocities. Absorbed energies of all columns use the mass "
                 f"of our projectile ({text(projectile_mass(slab), 3)} kg).")


def penetration_verdict(slab, checks=()):
    """Returns a sentence on the depth of penetration, for runs that were not asked for an exit velocity. checks: the measured values of
    the shot (validation.checks_of)."""
    outcome, last = slab.summary.get("outcome"), slab.number("final_velocity")
    state = {"perforated": "it has left the target", "stopped": "it is at rest", "rebounded": "it has rebounded"}.get(
        outcome, "it was still moving when the run ended")
    moving = "" if last is None or outcome == "stopped" else f"; its velocity was then {last:.1f} m/s"
    asked = "" if outcome in ("stopped", "rebounded") else " The run was not asked for an exit velocity."
    measured = "; ".join(f"{check.quantity}: {text(check.measured, 0)} measured, {text(check.computed, 0)} computed" for check in checks
                         if check.computed is not None and (check.quantity in (validation.DEPTH, validation.TIP) or
                                                            check.quantity.startswith("diameter")))
    return (f"{text(slab.number('thickness'), 0, 1e3)} mm {slab.target}: the {slab.projectile} has penetrated "
            f"{text(slab.penetration_depth, 1, 1e3)} mm{numerically(slab.band(slab.depth_key), 1, 1e3)} into it; "
            f"{state}{moving}.{asked}" + (f" Against the test: {measured}." if measured else ""))


def stopped_words(slab):
    """Returns the words behind an exit velocity of 0 that say that, and where, the projectile is stopped."""
    if slab.exit_velocity != 0:
        return ""
    if slab.penetration_depth is None:
        return " (the projectile is stopped)"
    band = band_text(slab.band(slab.depth_key), 1, 1e3)
    return (f" (the projectile is stopped at a depth of {text(slab.penetration_depth, 1, 1e3)} mm" +
            (f", numerically {band}" if band else "") + ")")


def slab_verdict(slab, row, checks=()):
    """Returns a sentence on the difference between the exit velocity, or the depth, and the experiment. checks: as of
    penetration_verdict()."""
    ours, experiment, nmap = perforations(slab, row)
    thickness = text(slab.number("thickness"), 0, 1e3)
    if slab.penetration_depth is not None and "exit_velocity" not in slab.summary:
        return penetration_verdict(slab, checks)
    if ours is None:
        measured = f"; the experiment has an exit velocity of {experiment.exit:g} m/s" if experiment else ""
        last = slab.number("exit_velocity")
        moving = f", its velocity was then {last:.1f} m/s" if last is not None else ""
        return (f"{thickness} mm slab: there is no exit velocity, as the projectile had not left the slab when the run "
                f"ended{moving}{measured}.")
    if experiment is None:
        return (f"{thickness} mm slab: computed exit velocity {ours.exit:.1f} m/s{numerically(ours.exits)}{stopped_words(slab)}; "
                "no test of this shot is on record (thickness, width of the target, mass, size and velocity of the projectile, "
                "angle).")
    miss = ours.exit - experiment.exit
    if abs(miss) < 0.5:  # the measured values are printed in whole m/s
        sentence = (f"{thickness} mm slab: the computed exit velocity of {ours.exit:.1f} m/s{numerically(ours.exits)} agrees "
                    f"with the measured {experiment.exit:g} m/s to the digits printed")
    else:
        sentence = (f"{thickness} mm slab: the computed exit velocity of {ours.exit:.1f} m/s{numerically(ours.exits)}"
                    f"{stopped_words(slab)} misses the measured {experiment.exit:g} m/s by {abs(miss):.1f} m/s "
                    f"(too {'fast' if miss > 0 else 'slow'}, "
                    f"{abs(relative(ours.exit, experiment.exit)):.1f} % of the measured value); the velocity "
                    f"change is off by {abs(ours.delta_v_percent - experiment.delta_v_percent):.1f} points, the "
                    f"change of kinetic energy by {abs(ours.delta_ke_percent - experiment.delta_ke_percent):.1f} points")
    sentence += band_verdict(slab, ours.exits, experiment.exit, unit=" m/s")
    if row.get(UNCERTAINTY) is not None:
        sentence += f"; the uncertainty of {row['tests']} test(s) is {row[UNCERTAINTY]:.1f} m/s"
    if nmap is not None:
        sentence += f". NMAP's low-resolution run misses it by {abs(nmap.exit - experiment.exit):.1f} m/s"
    return sentence + "."


def crater_verdict(slab):
    """Returns a sentence on whether the back crater of a perforated slab is larger than the front one, as expected from spalling, or
    whether there is one at all in a target that has held. Returns None without craters."""
    front, back = (slab.number(f"{face}_crater_diameter") for face in ("front", "back"))
    if front is None or back is None:
        return None
    if not slab.exit_velocity and not back > 0:
        return f"Craters: the front one is {text(front, 0, 1e3)} mm wide, the back face is whole."
    found = f"the back crater ({text(back, 0, 1e3)} mm) is {'larger' if back > front else 'not larger'} than the " \
            f"front one ({text(front, 0, 1e3)} mm)"
    return f"Craters: {found}, {'as' if back > front else 'unlike what is'} expected from spalling at the free back."


def crater_table(slab):
    rows = [[label] + [banded(slab.number(f"{key}_crater_{what}"), slab.band(f"{key}_crater_{what}"), 0, 1e3)
                       for what in ("diameter", "largest_diameter", "depth")]
            for label, key in (("front face", "front"), ("back face", "back"))]
    return Table("Craters (mm)", ["face", "diameter of a circle of equal area", "largest diameter", "largest depth"], rows,
                 "A place belongs to a crater if its point belongs to a fragment, has moved by more than half a spacing, or lies above "
                 "cracks that have opened by more than Output/Loose opening. All values are computed: the "
                 "paper gives crater profiles as a picture only (its Fig. 18), without numbers to compare with.")


PLACES = (("debris", "debris behind the back"), ("ejecta", "ejecta before the front"),
          ("loose", "loose between the faces"), ("remainder", "remaining slab"))


def fragment_table(slab):
    """Lists the fragments by place. Returns None if the summary has none."""
    if slab.number("debris_mass") is None:
        return None
    rows = [[label, text(slab.number(f"{key}_fragments") if key != "remainder" else 1.0, 0),
             text(slab.number(f"{key}_mass"), 2), text(slab.number(f"{key}_heaviest"), 1, 1e3),
             text(slab.number(f"{key}_momentum"), 1), text(slab.number(f"{key}_kinetic_energy"), 0)]
            for key, label in PLACES]
    lost = slab.number("lost_points")
    return Table("Fragments", ["where", "number", "mass (kg)", "heaviest (g)", "momentum (N s)", "kinetic energy (J)"],
                 rows, f"Values of the whole slab; {text(slab.number('lone_points'), 0)} fragments are single points, "
                 f"{text(lost, 0)} points are lost. Every fragment is a line of fragments.csv.")


def further_shots_table(slab):
    """Lists the answers about further bodies and targets of the run, whose keys begin with the names of the bodies. Returns
    None without any."""
    prefixes = [key.removesuffix("outcome") for key in slab.summary if key.endswith("_outcome")]
    rows = [[slab.summary.get(f"{prefix}projectile", "–"), slab.summary.get(f"{prefix}target", "–"),
             slab.summary.get(f"{prefix}outcome", "–"), text(slab.number(f"{prefix}impact_velocity")),
             *(banded(slab.number(f"{prefix}{key}"), slab.band(f"{prefix}{key}"), 1, scale)
               for key, scale in (("exit_velocity", 1.0), ("penetration_depth", 1e3))),
             text(slab.number(f"{prefix}final_velocity"))] for prefix in prefixes]
    return Table("Further shots of this run", ["body", "target", "outcome", "impact velocity (m/s)", "exit velocity (m/s)",
                                               "depth (mm)", "velocity at the end (m/s)"], rows) if rows else None


def angle(slab, key):
    value = slab.number(key)
    return None if value is None else np.degrees(value)


def perforation_table(slab):
    """Returns a table of which body perforated which target, when, and in which attitude it left."""
    targets = [key.removesuffix("_perforated_by") for key in slab.summary if key.endswith("_perforated_by")]
    rows = [[target.replace("_", " "), slab.summary[f"{target}_perforated_by"] or "none",
             text(slab.number(f"{target}_perforated_at"), 3, 1e3)] for target in targets]
    note = "The time is that at which the foremost point passes the place of the target's back."
    if slab.number("exit_axis") is not None:
        note += (f" The {slab.projectile} leaves the {slab.target} at {angle(slab, 'exit_direction'):.1f}° from the normal, its axis at "
                 f"{angle(slab, 'exit_axis'):.1f}°, turning by {slab.number('exit_angular_velocity'):.0f} rad/s.")
    return Table("Perforations", ["target", "perforated by", "time (ms)"], rows, note) if rows else None


def energy_shares(slab):
    """Returns [(share, J)] at the end of the history, which add up to the projectile's loss of energy, and that loss."""
    last = {key: values[-1] for key, values in slab.history.items()}
    shares = [("friction", last["friction_work"]), ("contact, normal", last["contact_work"])]
    if "shear_work" in last:
        shares += [("plastic flow (shear)", last["shear_work"] - last["elastic_shear_energy"]),
                   ("crushing of pores", last["compression_work"] - last["elastic_compression_energy"]),
                   ("opening of cracks", last["tension_work"] - last["elastic_tension_energy"]),
                   ("elastic, stored", sum(last[f"elastic_{part}_energy"] for part in ("shear", "compression", "tension")))]
    else:
        shares.append(("work of the stresses", last["internal_energy"]))
    shares += [("stabilisation", last["stabilization_energy"]), ("numerical damping", last.get("damping_work", 0.0))]
    moving = [(f"kinetic, {label}", slab.number(f"{key}_kinetic_energy")) for key, label in PLACES]
    known = all(value is not None for _, value in moving)
    shares += moving if known else [("kinetic, slab", last["kinetic_energy"])]
    lost = slab.history["projectile_kinetic_energy"][0] - last["projectile_kinetic_energy"]
    shares.append(("not accounted for", lost - sum(value for _, value in shares)))
    return [(label, value) for label, value in shares if label != "numerical damping" or value], lost


def energy_table(slab):
    shares, lost = energy_shares(slab)
    return Table("Distribution of the projectile's lost energy", ["", "J", "% of its loss"],
                 [[label, text(value, 0), text(100 * value / lost if lost else None)] for label, value in shares] +
                 [["in all", text(lost, 0), text(100.0 if lost else None)]],
                 "Kinetic energies are those of the points at the end of the run. The part that is not accounted for is the "
                 "error of the energy balance, and the change between the last half steps.")


def slabs_table(slabs, references):
    """Compares every slab with the experiment and NMAP, in percentage points and relative."""
    rows = []
    for slab in slabs:
        ours, experiment, nmap = perforations(slab, references.slab(slab))
        for label, name, digits, scale, unit in (("velocity change (%)", "delta_v_percent", 1, 1.0, "points"),
                                                 ("kinetic energy (%)", "delta_ke_percent", 1, 1.0, "points"),
                                                 ("absorbed energy (kJ)", "absorbed", 1, 1e-3, "kJ"),
                                                 ("absorbed per thickness (kN)", "absorbed_per_thickness", 0, 1e-3, "kN")):
            values = [getattr(p, name) if p else None for p in (ours, experiment, nmap)]
            rows.append([text(slab.number("thickness"), 0, 1e3), label,
                         banded(values[0], ours and ours.band(name), digits, scale),
                         *(text(v, digits, scale) for v in values[1:])] +
                        [cell for value in (values[0], values[2]) for cell in (
                            with_unit(difference(value, values[1]), unit, digits, scale),
                            with_unit(relative(value, values[1]), "%"))])
    return Table("All slabs", ["mm", "quantity", OURS, EXPERIMENT, NMAP, "Spall − experiment", "Spall, relative",
                               "NMAP − experiment", "NMAP, relative"], rows)


def trend_error(values, measured):
    """Returns the largest deviation of value / measured from its mean over the slabs, %: 0 if all are off by one factor."""
    ratio = np.array(values) / np.array(measured)
    return 100.0 * np.abs(ratio / ratio.mean() - 1).max()


# The aim for a series of slabs: percentage points of velocity change and of kinetic energy, and percent of the trend.
AIM_POINTS, AIM_TREND = 5.0, 5.0


def series_verdict(slabs, references):
    """Returns sentences on how well one set of inputs fits all slabs."""
    found = [perforations(slab, references.slab(slab)) for slab in slabs]
    found = [f for f in found if None not in f[:2]]
    if len(found) < 2:
        return None
    worst = {name: max((abs(getattr(o, name) - getattr(e, name)), o.thickness) for o, e, _ in found)
             for name in ("delta_v_percent", "delta_ke_percent")}
    sentences = []
    for name, words in (("delta_v_percent", "velocity change"), ("delta_ke_percent", "change of kinetic energy")):
        miss, thickness = worst[name]
        sentences.append(f"the {words} is off by at most {miss:.1f} points ({text(thickness, 0, 1e3)} mm), "
                         f"{'within' if miss <= AIM_POINTS else 'outside'} the aim of {AIM_POINTS:g}")
    with_nmap = all(nmap is not None for _, _, nmap in found)
    columns = list(zip(*[[p.absorbed_per_thickness for p in f if p is not None] for f in found]))
    kilonewtons = ["/".join(text(v, 0, 1e-3) for v in column) for column in columns]
    ours = trend_error(columns[0], columns[1])
    sentences.append(f"the absorbed energy per thickness is {kilonewtons[0]} kN where the tests have {kilonewtons[1]}" +
                     (f" (NMAP {kilonewtons[2]})" if with_nmap else "") +
                     f": its trend is off by {ours:.1f} %, {'within' if ours <= AIM_TREND else 'outside'} "
                     f"the aim of {AIM_TREND:g} %" +
                     (f" (NMAP {trend_error(columns[2], columns[1]):.1f} %)" if with_nmap else ""))
    known = [(ours.exits[0] <= experiment.exit <= ours.exits[1]) for ours, experiment, _ in found if ours.exits]
    if known:
        sentences.append(f"the measured exit velocity lies within the numerical band of {sum(known)} of {len(known)} slabs")
    return "All slabs with one set of inputs: " + "; ".join(sentences) + "."


def soundness_table(slabs):
    """Lists the balances and detectors that show whether a run is sound."""
    keys = (("energy error, largest (%)", "largest_energy_error", 3, 100.0),
            ("momentum error (millionths)", "momentum_balance_error", 3, 1e6),
            ("volume between the points, off on average (%)", "volume_mismatch", 3, 100.0),
            ("alternating from cell to cell (%)", "volume_alternation", 3, 100.0),
            ("stabilisation (% of the impact energy)", "stabilization_work_fraction", 1, 100.0),
            ("lost points", "lost_points", 0, 1.0))
    return Table("Soundness of every slab", ["result", *(label for label, *_ in keys)],
                 [[slab.name, *(text(slab.number(key), digits, scale) for _, key, digits, scale in keys)]
                  for slab in slabs],
                 "The volume between the points is compared with the integrated one; the largest difference of the run counts.")
