"""Compares runs of slabs: the inputs in which they differ, and the effect on the exit velocity."""

import pathlib

import inputs
from tables import Table, exit_text, numerically, text

# Sections that do not affect the answers.
SILENT = ("Answers/", "Output/", "Run/")
# Inputs of the projectile, and those that a deformable one needs other values of, as its steel asks for shorter steps.
PROJECTILE, STEPS = (f"{inputs.PROJECTILE}/",), ("Time/", "Integration/Refresh interval")
SYMMETRY, TABLE = "Scene/Symmetry planes", "AFC/Damage table"
FINE_SPACING = f"{inputs.TARGET}/Fine spacing"
GRADED = f"{inputs.TARGET}/Graded"  # an entry beside the inputs: whether there is a fine spacing
REFINEMENT = (f"{inputs.TARGET}/Rings", f"{inputs.TARGET}/Layers", f"{inputs.TARGET}/Spacing", FINE_SPACING)
OF_THICKNESS = (f"{inputs.TARGET}/Height", "Time/End time", *REFINEMENT)


def answer_inputs(slab):
    """Returns the inputs that are in use, by key. The damage table is named by its last folder and file, as the same table may
    be given by several paths."""
    found = {key: value for key, value in slab.inputs.items() if not key.startswith(SILENT) and value != inputs.UNUSED}
    if found.get(TABLE):
        found[TABLE] = "/".join(pathlib.Path(found[TABLE]).parts[-2:])
    return found | {GRADED: "yes" if FINE_SPACING in found else "no"}


def differing(slabs):
    """Returns the keys whose value is not the same in all runs that have them, in the order of the inputs."""
    found = [answer_inputs(slab) for slab in slabs]
    keys = list(dict.fromkeys(key for one in found for key in one))  # some keys may be missing in a run
    return [key for key in keys if len({one[key] for one in found if key in one}) > 1]


def same_task(slabs):
    """Returns groups of runs of one thickness and impact velocity, each in the order given."""
    groups = {}
    for slab in slabs:
        task = slab.number("thickness"), slab.number("impact_velocity")
        if None not in task:
            groups.setdefault(task, []).append(slab)
    return [groups[task] for task in sorted(groups)]


def one_per_thickness(slabs):
    """Returns one run of each thickness at one impact velocity: the first run given, and of each other thickness the run whose
    inputs differ least from it."""
    groups = same_task(slabs)
    if not groups:
        return []
    first = next(slab for slab in slabs if slab in sum(groups, []))
    chosen = [min(group, key=lambda slab: len(differing([first, slab]))) for group in groups]
    return [slab for slab in chosen if slab.number("impact_velocity") == first.number("impact_velocity")]


def beyond_thickness(slabs):
    """Returns the keys that differ, apart from those that depend on the thickness."""
    return [key for key in differing(slabs) if key not in OF_THICKNESS]


def same_spacing(one, other):
    """Tells whether the spacings agree within a tenth, as whole numbers of layers do not fit every thickness alike."""
    spacings = one.number("spacing"), other.number("spacing")
    return spacings[0] == spacings[1] or (None not in spacings and abs(spacings[1] / spacings[0] - 1) < 0.1)


def all_series(slabs):
    """Returns series of runs with the same inputs, one run of each thickness, from thin to thick. Runs with the weak and strong
    table of an ensemble are left out. If no two thicknesses have the same inputs, the runs most alike make one series."""
    sides = [run for band in bands(slabs) for run in (band[0], band[2])]
    found = []
    for slab in sum(same_task([slab for slab in slabs if slab not in sides]), []):
        for series in found:
            if slab.number("thickness") not in [run.number("thickness") for run in series] and \
                    slab.number("impact_velocity") == series[0].number("impact_velocity") and \
                    same_spacing(series[0], slab) and not beyond_thickness([series[0], slab]):
                series.append(slab)
                break
        else:
            found.append([slab])
    found = [series for series in found if len(series) > 1]
    if not found:
        found = [series for series in [one_per_thickness(slabs)] if len(series) > 1]
    return sorted(found, key=lambda series: slabs.index(series[0]))


# Points over the projectile's radius from which on exit velocities are within about 8 m/s (see `penetrate --plan`).
RESOLVED = 3


def points_over_radius(slab):
    radius, spacing = slab.number("projectile_radius"), slab.number("spacing")
    return radius / spacing if radius and spacing else None


def resolution(slab):
    """Returns a description of the resolution of a run."""
    across = points_over_radius(slab)
    return f"{text(slab.number('spacing'), 1, 1e3)} mm, {method(slab)}" + (
        f", {across:.1f} points over the projectile's radius" if across else "")


def inputs_caution(series):
    keys = beyond_thickness(series)
    return f"Caution: the inputs of this series are not the same; these differ: {', '.join(keys)}." if keys else None


def resolution_caution(series):
    across = points_over_radius(series[0])
    return None if across is None or across >= RESOLVED else \
        (f"Caution: {across:.1f} points over the projectile's radius. No scheme has converged there, so differences from the "
         f"experiments include the error of the spacing; use at least {RESOLVED} points for about 8 m/s of error.")


def alike_but_for(keys, slabs):
    """Returns lists of runs of one thickness and impact velocity whose inputs differ from those of the first in these keys
    alone."""
    found = []
    for task in same_task(slabs):
        groups = []
        for slab in task:
            group = next((one for one in groups if not set(differing([one[0], slab])) - set(keys)), None)
            if group is None:
                groups.append([slab])
            else:
                group.append(slab)
        found += groups
    return found


def refinements(slabs):
    """Returns lists of runs of one slab that differ in the spacing only, from coarse to fine, with at least three spacings."""
    known = [slab for slab in slabs if None not in (slab.number("spacing"), slab.exit_velocity)]
    lines = [sorted(line, key=lambda slab: -slab.number("spacing")) for line in alike_but_for(REFINEMENT, known)]
    return [line for line in lines if len({round(slab.number("spacing"), 5) for slab in line}) > 2]


def refinement_sentence(line):
    """Returns a sentence on how much the last refinement changes the exit velocity."""
    coarse, fine = line[-2:]
    return (f"{text(fine.number('thickness'), 0, 1e3)} mm slab under refinement ({method(fine)}): " + ", ".join(
        map(exit_text, line)) + " m/s at " + ", ".join(
        text(slab.number("spacing"), 1, 1e3) for slab in line) + " mm; the last step changes it by "
        f"{fine.exit_velocity - coarse.exit_velocity:+.1f} m/s.")


def readable(key, value):
    if value is None:
        return "–"
    return pathlib.Path(value).name if key == TABLE else value


def runs_table(slabs):
    """Compares runs of one slab, with the inputs in which they differ."""
    keys = differing(slabs)
    base = slabs[0].exit_velocity
    rows = []
    for slab in slabs:
        exit_velocity = slab.exit_velocity
        change = "–" if slab is slabs[0] or None in (exit_velocity, base) else f"{exit_velocity - base:+.1f}"
        rows.append([slab.name, *(readable(key, answer_inputs(slab).get(key)) for key in keys), text(slab.number("points"), 0),
                     exit_text(slab), change, text(slab.number("back_crater_diameter"), 0, 1e3),
                     text(slab.number("cpu_seconds"), 0)])
    return Table(f"Runs of the {text(slabs[0].number('thickness'), 0, 1e3)} mm slab",
                 ["result", *(key.split("/", 1)[-1] for key in keys), "points", "exit velocity (m/s)",
                  "against the first (m/s)", "back crater (mm)", "processor time (s)"], rows)


def pair(one, other):
    """Names each of two runs by the one thing in which they differ: symmetry, or the model of the projectile. Returns None if
    they differ in anything else."""
    keys = differing([one, other])
    if keys == [SYMMETRY]:
        return [f"symmetry planes {slab.inputs.get(SYMMETRY) or 'none'}" for slab in (one, other)]
    model = f"{inputs.PROJECTILE}/Model"
    if model in keys and all(key.startswith(PROJECTILE + STEPS) for key in keys):
        return [f"{slab.inputs[model]} projectile" for slab in (one, other)]
    return None


def pairs(slabs):
    """Returns a sentence for each run that differs in one thing only from an earlier run."""
    found = []
    known = [slab for slab in slabs if slab.exit_velocity is not None]
    for i, other in enumerate(known):
        one = next((slab for slab in known[:i] if pair(slab, other)), None)
        if one is None:
            continue
        what, steps = pair(one, other), [key for key in differing([one, other]) if key.startswith(STEPS)]
        found.append(f"{text(one.number('thickness'), 0, 1e3)} mm slab: {what[0]} {exit_text(one)} m/s, {what[1]} "
                     f"{exit_text(other)} m/s: a difference of {abs(other.exit_velocity - one.exit_velocity):.1f} m/s" +
                     "".join(f"; {key.split('/')[-1]} {one.inputs.get(key)}, {other.inputs.get(key)}" for key in steps) + ".")
    return found


def bands(slabs):
    """Returns [(weak, mean, strong)]: runs that differ only in the table of an ensemble of microcells."""
    found = []
    for mean in slabs:
        sides = {}
        table = pathlib.Path(mean.inputs.get(TABLE, ""))
        for other in slabs:
            if differing([mean, other]) != [TABLE]:
                continue
            for side in ("weak", "strong"):
                if pathlib.Path(other.inputs[TABLE]).name == f"{table.stem}_{side}{table.suffix}":
                    sides[side] = other
        if len(sides) == 2:
            found.append((sides["weak"], mean, sides["strong"]))
    return found


def band_sentence(weak, mean, strong):
    velocities = [slab.exit_velocity for slab in (weak, mean, strong)]
    if None in velocities:
        return (f"{text(mean.number('thickness'), 0, 1e3)} mm slab: there is no exit band, as a run with a table of the ensemble "
                "has no exit velocity.")
    order = "" if velocities[0] >= velocities[1] >= velocities[2] else (
        " The exit velocity does not fall throughout with the strength of the concrete: the band is within the scatter of "
        "crack patterns.")
    return (f"{text(mean.number('thickness'), 0, 1e3)} mm slab: the ensemble of microcells gives an exit velocity of "
            f"{velocities[1]:.1f} m/s{numerically(mean.exit_band)}, {velocities[0]:.1f} m/s with its weak and "
            f"{velocities[2]:.1f} m/s with its strong table: a band of {max(velocities) - min(velocities):.1f} m/s.{order}")


def band_table(bands, references):
    """Lists the exit velocities with the tables of an ensemble beside the measured ones."""
    rows = []
    for runs in bands:
        measured = references.slab(runs[1])
        exits = [run.exit_velocity for run in runs]
        width = None if None in exits else max(exits) - min(exits)
        rows.append([text(runs[1].number("thickness"), 0, 1e3), *map(exit_text, runs), text(width),
                     text((measured or {}).get("experiment_exit_m_s"), 0)])
    return Table("Exit band of the ensemble of microcells (m/s)",
                 ["slab (mm)", "weak table", "mean", "strong table", "band", "experiment"], rows,
                 "The band is the effect of the scatter of the microcells alone; it is not the uncertainty of the model.")


def method(slab):
    """Names the method that the runs on one line of the convergence figure share."""
    planes = slab.inputs.get(SYMMETRY, "")
    return (f"{slab.summary.get('scheme', 'unknown scheme')}, "
            f"{'axisymmetric' if planes == 'axis' else '3D'}{', graded' if answer_inputs(slab)[GRADED] == 'yes' else ''}")


def verification_row(slab, rows):
    """Returns the row of the converged solution for this target's material, friction, size and velocity, or None."""
    found = slab.inputs
    tensile = "exponential" if found.get("AFC/Damage law") == "exponential" else "table" if found.get(TABLE) else "none"
    floor = None if found.get("AFC/Shear damage") == "no" else inputs.number(found.get("AFC/Failure strain floor")) or 0.0
    wanted = {"opening": found.get("AFC/Opening", "cracks"), "tensile_damage": tensile, "failure_strain_floor": floor,
              "t_max_mpa": inputs.number(found.get("AFC/T_max")), "friction": inputs.number(found.get("Contact/Friction"))}
    thickness, impact = slab.number("thickness"), slab.number("impact_velocity")
    if None in (thickness, impact):
        return None
    for row in rows:
        if all(row.get(key) == value for key, value in wanted.items()) and \
                abs(row["thickness_mm"] - 1e3 * thickness) < 0.5 and abs(row["impact_m_s"] - impact) < 0.5:
            return row
    return None


def verification_verdict(slab, row):
    found = "no exit velocity" if slab.exit_velocity is None else \
        f"exit velocity {slab.exit_velocity:.1f} m/s{numerically(slab.exit_band)}, " \
        f"{slab.exit_velocity - row['exit_m_s']:+.1f} m/s off the converged solution"
    return (f"Verification, set {row['set']} with friction {row['friction']:g}: {found} of {row['exit_m_s']:g} m/s. This material "
            "is not meant for comparison with an experiment.")


def verification_table(slabs, row):
    rows = [[slab.name, method(slab), text(slab.number("spacing"), 2, 1e3), text(slab.number("points"), 0),
             exit_text(slab), text(row["exit_m_s"], 0),
             text(None if slab.exit_velocity is None else slab.exit_velocity - row["exit_m_s"], 1, signed=True)]
            for slab in sorted(slabs, key=lambda s: (method(s), -(s.number("spacing") or 0)))]
    return Table(f"Set {row['set']}, friction {row['friction']:g}: against converged finite elements",
                 ["result", "method", "spacing (mm)", "points", "Spall", "converged reference", "difference (m/s)"], rows,
                 "The reference is another program's solution of the same equations, not an experiment "
                 "(data/experiments/slab_verification.csv).")
