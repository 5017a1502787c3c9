"""Sections of the report on slabs: one for each, then all of them together."""

import charts
import cracks
import figures_points
import figures_runs
import figures_shot
import figures_slabs
import film
import layouts
import slab_runs
import solid
import tables
import tables_slabs
import validation
from files import Unreadable

HISTORY, FIELDS = ("history.csv",), ("fields.h5",)  # files that figures show
# What the error bars of the figures mean.
BARS = " Error bars: the range that the numerical error leaves open, where it is measured."


def states_over_time(out, slab):
    """Returns the states of the damage over time; says so where an earlier frame than the last one cannot be read."""
    try:
        return film.states_of(slab.folder / "fields.h5", slab.frame)
    except Unreadable as error:
        out.report.missing(f"the damage over time: {error}")
        return []


def pictures(out, slab):
    frame, name = slab.frame, slab.name
    if not figures_points.damages(frame):
        out.report.missing(f"tensile_damage and shear_damage in {slab.folder}/fields.h5")
    else:
        out.draw(figures_points.damage_faces(frame), f"{name}_faces", data=FIELDS,
                 caption="Damage on both faces at the last frame, with the modelled part mirrored, as far out as there is damage to "
                 "see. Colours go from 0.15 to 1, as in the paper's Figs. 13 and 14; less damaged concrete is drawn as sound.")
        states = states_over_time(out, slab)
        if states:
            out.draw(film.draw(states), f"{name}_film", data=FIELDS, film=film.data(states),
                     caption="Damage in the section through the axis over time, colours from 0.15 to 1, with the projectile at its "
                     "place and angle.")
        out.draw(figures_points.damage_section(frame), f"{name}_section", data=FIELDS,
                 caption="Damage in the section through the axis at the last frame, colours from 0.15 to 1.")
        scene = solid.scene_of(frame)
        out.draw(solid.draw(scene), f"{name}_solid", data=FIELDS, solid=solid.data(scene),
                 caption="The whole body at the last frame, seen from behind, or from before it where nothing has come through: points as spheres of the volume of their "
                 "cells, coloured by the larger damage from 0.15 to 1, with the rigid bodies at their place and angle" +
                 (f"; {scene.words}." if scene.words else "."))
    harmonics = cracks.back_face(frame)
    if harmonics is not None:
        out.report.paragraph(cracks.verdict(harmonics), "verdict")
        out.draw(figures_points.crack_spectrum(frame, harmonics), f"{name}_cracks", data=FIELDS,
                 caption="Test whether cracks follow the layout of the points. Left: tensile damage of the back face at the initial places "
                 "of the points. Right: the spectrum over the angle of the damage between the dashed circles, less the mean of every "
                 "ring. The part with the layout's symmetry stays the same after quarter turns and in the mirrors x = 0 and x = y.")
    if "fragment" in frame.fields and not slab.not_reported:
        out.draw(figures_points.debris(frame, masses(slab)), f"{name}_debris", data=("fields.h5", "fragments.csv"),
                 caption="Debris and ejecta of the whole slab from the side (the paper's Fig. 16), in front of the section of the "
                 "remaining slab. Left: the heaviest fragments have a colour each, which mirror images share; lighter ones repeat "
                 "the colours in a pale shade. Right: by speed.")


def masses(slab):
    """Returns the masses of the fragments, kg, by their numbers in the frame."""
    found = slab.fragments
    return {} if found is None or "id" not in found else dict(zip(found["id"].astype(int), found["mass"]))


def slab(out, result):
    solved = slab_runs.verification_row(result, out.references.verification)
    row = None if solved else out.references.slab(result)
    out.report.heading(f"Slab: {result.name}", result)
    out.verdict(result.name, slab_runs.verification_verdict(result, solved) if solved else
                tables_slabs.slab_verdict(result, row, validation.checks_of(result, out.references)))
    if not solved and tables_slabs.crater_verdict(result):
        out.report.paragraph(tables_slabs.crater_verdict(result), "verdict")
    out.warnings(result)
    if row is None and not solved and not out.references.shots(result):
        out.report.missing("an experiment with this thickness and impact velocity in data/experiments/perforation.csv")
    out.missing(result)
    out.report.table(tables_slabs.slab_table(result, row))
    explorer = charts.explorer(result)
    if explorer:
        out.report.explorer(explorer)
    if result.history is not None:
        out.draw(figures_slabs.velocity(result, row), f"{result.name}_velocity", data=HISTORY,
                 caption="Velocity of the projectile. The horizontal line is the measured exit velocity; the paper prints "
                 "NMAP's exit velocity without a time. Its velocity over time (the paper's Figs. 15 and 17) is compared in a section of "
                 "its own, if data/digitised holds it." + BARS)
        force = figures_shot.force_over_depth(result)
        if force is not None:
            out.draw(force, f"{result.name}_force", data=HISTORY,
                     caption="Force on the projectile and its deceleration against the depth of its tip below "
                     "the struck face, from its loss of momentum over stretches of a quarter of its radius.")
    if result.frame is not None:
        pictures(out, result)
    if None not in (result.outlines, result.profiles, result.number("thickness")):
        out.draw(figures_slabs.craters(result), f"{result.name}_craters", data=("craters.csv", "crater_profiles.csv"),
                 caption="Craters: outlines in plan (the paper's Fig. 18) and depth along the radius, at the end of the run.")
    if result.not_reported:
        out.report.paragraph(f"Craters and fragments are {result.not_reported}. Pictures show the end of the run.", "missing")
    else:
        out.report.table(tables_slabs.crater_table(result))
    if tables_slabs.fragment_table(result):
        out.report.table(tables_slabs.fragment_table(result))
    if result.fragments is not None and len(result.fragments["place"]) > 1:
        out.draw(figures_slabs.fragment_sizes(result), f"{result.name}_fragments", data=("fragments.csv",),
                 caption="Fragments of the whole slab at the end of the run, without the remaining slab. Where most fragments are single "
                 "points, their sizes are those of the model's points, not those of real debris.")
    if result.cone is not None and result.cone["mass"].any():
        out.draw(figures_shot.debris_cone(result), f"{result.name}_debris_cone", data=("debris_cone.csv",),
                 caption="Debris behind the target by the angle between its flight and the axis, at the end of the run.")
    for table in [tables_slabs.perforation_table(result), tables_slabs.further_shots_table(result), *tables.received_tables(result)]:
        if table is not None:
            out.report.table(table)
    if result.history is not None:
        out.draw(figures_slabs.energy_flow(result), f"{result.name}_energy", data=HISTORY,
                 caption="Distribution of the energy at impact. Elastic energy is the work of the stresses that unloading would "
                 "release.")
        out.report.table(tables_slabs.energy_table(result))
        out.balances(result)


def verification(out, slabs):
    """Compares runs with the converged solution of another program for the same material, if there is one."""
    for row in out.references.verification:
        runs = [run for run in slabs if slab_runs.verification_row(run, out.references.verification) is row]
        if not runs:
            continue
        known = [(slab_runs.method(run), run.number("spacing"), run.exit_velocity, run.exit_band) for run in runs
                 if None not in (run.number("spacing"), run.exit_velocity)]
        out.report.heading(f"Convergence: set {row['set']}, friction {row['friction']:g}", *runs)
        if known:
            out.draw(figures_runs.convergence(known, row), f"convergence_{row['set']}_{row['friction']:g}", data=("summary.json",),
                     caption="Exit velocity under refinement, against the converged solution of another program." + BARS)
        out.report.table(slab_runs.verification_table(runs, row))


def between(out, slabs):
    """Compares runs of several slabs: bands of an ensemble, layouts of the points, refinement."""
    bands, lines, groups = slab_runs.bands(slabs), slab_runs.refinements(slabs), layouts.groups(slabs)
    if bands:
        out.report.heading("Exit band of the microcells' scatter")
        out.report.table(slab_runs.band_table(bands, out.references))
    if groups:
        out.report.heading("Scatter over layouts of the points")
        out.report.table(layouts.table(groups, out.references))
    if lines:
        out.report.heading("Refinement with one material set", *(run for line in lines for run in line))
        for line in lines:
            out.report.paragraph(slab_runs.refinement_sentence(line), "verdict")
        thick = [f"{1e3 * line[0].number('thickness'):g} mm, {slab_runs.method(line[0])}" for line in lines]
        points = [[(run.number("spacing"), run.exit_velocity, run.exit_band) for run in line] for line in lines]
        out.draw(figures_runs.refinement(list(zip(thick, points)), [out.references.slab(line[0]) for line in lines]),
                 "refinement", data=("summary.json",),
                 caption="Exit velocity under refinement with all other inputs the same. Dashed: measured." + BARS)


def one_series(out, series, bands, suffix):
    """Compares slabs of several thicknesses and one set of inputs with the experiments."""
    out.report.heading(f"All slabs: {slab_runs.resolution(series[0])}", *series)
    verdict = tables_slabs.series_verdict(series, out.references)
    if verdict:
        out.report.paragraph(verdict, "verdict")
    for caution in (slab_runs.inputs_caution(series), slab_runs.resolution_caution(series)):
        if caution:
            out.report.paragraph(caution, "missing")
    out.report.table(tables_slabs.slabs_table(series, out.references))
    rows = [out.references.slab(run) for run in series]
    if all(run.history is not None for run in series):
        out.draw(figures_runs.velocities(series, rows, bands, slab_runs.resolution(series[0])), f"slabs_velocity{suffix}", data=HISTORY,
                 caption="Velocity of the projectile in all slabs. Dashed lines and squares: measured exit velocities; diamonds: "
                 "NMAP's. Neither is given with a time." + BARS)
    found = [tables_slabs.perforations(*pair) for pair in zip(series, rows)]
    out.draw(figures_runs.absorbed(series, found, slab_runs.resolution(series[0])), f"slabs_absorbed{suffix}", data=("summary.json",),
             caption="Absorbed energy per thickness." + BARS)


def every_series(out, slabs):
    for i, series in enumerate(slab_runs.all_series(slabs)):
        one_series(out, series, slab_runs.bands(slabs), f"_{i + 1}" if i else "")


def one_task(out, group):
    """Compares runs of one thickness and impact velocity."""
    out.report.heading(f"Runs of the {1e3 * group[0].number('thickness'):g} mm slab", *group)
    for sentence in slab_runs.pairs(group) + [slab_runs.band_sentence(*band) for band in slab_runs.bands(group)]:
        out.report.paragraph(sentence, "verdict")
    out.report.table(slab_runs.runs_table(group))
    if cracks.comparison(group):
        out.report.table(cracks.comparison(group))


def all_slabs(out, slabs):
    if not slabs:
        return
    judged = [run for run in slabs if slab_runs.verification_row(run, out.references.verification) is None]
    out.attempt("slabs of all thicknesses", lambda: every_series(out, judged))
    out.attempt("bands and refinements of slabs", lambda: between(out, judged))
    for group in slab_runs.same_task(judged):
        if len(group) > 1:
            out.attempt(f"runs like {group[0].name}", lambda: one_task(out, group))
    out.attempt("verification of slabs", lambda: verification(out, slabs))
    out.report.heading("Soundness of the slabs")
    out.attempt("soundness of slabs", lambda: out.report.table(tables_slabs.soundness_table(slabs)))
