"""Section of the report that sets our curves beside those that users have read off the paper's figures."""

import digitised
from figures_material import DAMAGE, HYDROSTAT, SURFACE, TENSION
from results import Material, Slab
from style import CYCLE, NMAP, figure
from tables import Table, text

LABELS = HYDROSTAT | SURFACE | DAMAGE | TENSION  # of our curves at a material point, by file
AXES = {"volumetric_strain": "volumetric strain μ", "pressure_mpa": "pressure (MPa)", "mean_pressure_mpa": "mean pressure (MPa)",
        "stress_difference_mpa": "stress difference (MPa)", "strain": "strain", "damage": "damage", "stress_mpa": "stress (MPa)",
        "time_ms": "time (ms)", "velocity_m_s": "projectile velocity (m/s)"}
NOTE = ("Over the range where both curves are: the root mean square of their difference as an integral, and the largest difference, "
        "in percent of the largest value of the paper's curve there. Of ours the first loading counts, without unloadings. A curve "
        "that is read off a picture is itself wrong by 0.5 to 1 % of its axis (data/digitised/README.md).")


def of_material(result, curves):
    """Returns [(curve of the paper, label of ours, x, y)] for the curves of one folder of material_point."""
    return [(curve, LABELS[name], *digitised.OURS[curve.form.figure](result.curves[name]))
            for curve in curves for name in curve.form.ours if name in result.curves]


def of_run(run, curves, references):
    """Returns the same for a run of a slab."""
    if run.history is None:
        return []
    return [(curve, f"Spall, {run.name}", 1e3 * run.history["time"], run.history["projectile_velocity"])
            for curve in curves if curve.form.thickness and digitised.shot_of(curve, run, references)]


def draw(pairs):
    """Draws curves of one figure of the paper, dashed, and ours; pairs as of_material() returns them."""
    drawn, axes = figure()
    papers = list({curve.name: curve for curve, *_ in pairs}.values())
    for curve, dashes in zip(papers, ("--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))):
        axes.plot(curve.x, curve.y, color=NMAP, linestyle=dashes, zorder=3, label=f"paper, Fig. {curve.form.figure}: {curve.form.label}")
    left, right = min(curve.x[0] for curve in papers), max(curve.x[-1] for curve in papers)
    for (label, (x, y)), color in zip({label: (x, y) for _, label, x, y in pairs}.items(), CYCLE):
        x, y = digitised.first_passage(x, y)
        shown = (x >= left) & (x <= right)  # the rest would set the scale
        axes.plot(x[shown], y[shown], color=color, label=label)
    axes.set(**dict(zip(("xlabel", "ylabel"), (AXES[name] for name in papers[0].form.columns))))
    axes.set_xlim(left, right)
    if right < 0.1:
        axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
    axes.legend(loc="upper left", bbox_to_anchor=(0, -0.16), fontsize=9, ncol=2)
    drawn.set_size_inches(7.5, 5.2)
    return drawn


def row_of(curve, label, x, y):
    found = digitised.difference(curve, x, y)
    begin = [f"{curve.form.figure}", curve.form.label, label]
    if found is None:
        return begin + ["no common range"] + ["–"] * 4
    percent = 100 / found.peak if found.peak > 0 else None
    return begin + [f"{found.first:.3g} to {found.last:.3g}", f"{found.mean_square_root:.3g}",
                    text(percent and percent * found.mean_square_root), f"{found.largest:.3g} at {found.place:.3g}",
                    text(percent and percent * found.largest)]


def section(out, results):
    """Reports on the results that have a digitised curve beside them."""
    curves = out.references.digitised
    materials = [(f"{result.name}_figure_{number}", of_material(result, [c for c in curves if c.form.figure == number]))
                 for result in results if isinstance(result, Material) for number in digitised.OURS]
    runs = [(f"{run.name}_figures_15_17", of_run(run, curves, out.references)) for run in results if isinstance(run, Slab)]
    found = [(name, pairs) for name, pairs in materials + runs if pairs]
    if not found:
        return
    out.report.heading("Against the paper's figures")
    columns = ["figure", "curve of the paper", "ours", "common range", "root mean square", "in % of the peak", "largest",
               "largest in % of the peak"]
    out.report.table(Table("Difference from digitised curves of the paper", columns,
                           [row_of(*pair) for _, pairs in found for pair in pairs], NOTE))
    for name, pairs in found:
        numbers = ", ".join(sorted({f"Fig. {curve.form.figure}" for curve, *_ in pairs}))
        out.draw(draw(pairs), name, f"Curves read off the paper's {numbers} (dashed; data/digitised) and ours (solid).")
