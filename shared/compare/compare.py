#!/usr/bin/python3
"""Draws results and compares them with experiments and the paper: figures (PNG, SVG) and report.html."""

import argparse
import os
import pathlib
import sys

import figures_cost
import figures_curves
import figures_impact
import figures_material
import figures_schemes
import sections_scaling
import sections_slabs
import tables
from files import Unreadable
from reading import read_result
from references import EXPERIMENTS, References
from report import Report
from results import Impact, Material, Microcell, Scaling, Slab, Taylor
from style import save


class Writer:
    """Adds figures and tables to the report, and writes the figures to disk."""

    def __init__(self, folder, references):
        self.folder, self.references, self.report = folder, references, Report()

    def draw(self, drawn, name, caption):
        self.report.picture(save(drawn, self.folder, name, caption))

    def missing(self, result):
        if result.summary.get("complete") is False:
            self.report.missing(f"the end of the run: {result.summary.get('reason', 'unknown')}")
        if isinstance(result, Impact) and result.ended_early:
            self.report.missing(f"the end of the run: {result.ended_early}")
        for what in result.missing:
            self.report.missing(f"{what} in {result.folder}")

    def warnings(self, result):
        for warning in tables.impact_warnings(result) if result.history is not None else []:
            self.report.paragraph(f"Caution: {warning}.", "missing")

    def balances(self, result):
        self.draw(figures_impact.balances(result), f"{result.name}_balance", "Errors of energy and momentum balance.")


def microcell(out, result):
    out.report.heading(f"Microcell: {result.name}")
    out.missing(result)
    name, curve = result.name, result.reference
    if curve is not None:
        out.draw(figures_curves.homogenised_stress(curve), f"{name}_stress",
                 "Homogenised stress of the reference cell in uniaxial strain.")
        out.draw(figures_curves.damage_definitions(curve), f"{name}_damage",
                 "Damage of the reference cell in all definitions.")
        out.draw(figures_curves.free_energies(curve), f"{name}_energies",
                 "Free energies of the reference cell, dissipation and work.")
    if result.band and curve is not None:
        out.draw(figures_curves.ensemble_band(curve, result.band, result.summary["samples"]), f"{name}_band",
                 "Random cells: mean and band of the stress; remaining strength in the simulation of the slab with each of the "
                 "three tables; stiffness damage.")
    if result.states:
        out.draw(figures_curves.opened_cell(result.states), f"{name}_cell",
                 "The cell near its peak stress, about half broken and at the last state, displacements magnified.")
    if result.curves:
        out.draw(figures_curves.damage_sizes(result.curves), f"{name}_sizes",
                 "Strength damage, the column that the simulation of the slab uses by default, and stiffness damage for every "
                 "cell size of the table.")
        out.report.table(tables.microcell_table(result))


def material(out, result):
    out.report.heading(f"Concrete at a material point: {result.name}")
    out.missing(result)
    for draw, name, files, caption in figures_material.FIGURES:
        if any(file in result.curves for file in files):
            out.draw(draw(result.curves), f"{result.name}_{name}", caption)


def impact(out, result):
    """Reports on a run that neither follows a shot nor measures a bar."""
    out.report.heading(f"Impact: {result.name}")
    out.warnings(result)
    out.missing(result)
    for table in tables.received_tables(result):
        out.report.table(table)
    if result.history is not None:
        out.draw(figures_impact.energies(result), f"{result.name}_energy", "Conversion of the initial energy.")
        out.balances(result)


def taylor(out, result):
    row = out.references.bar(result)
    out.report.heading(f"Taylor bar: {result.name}")
    out.report.paragraph(tables.bar_verdict(result, row), "verdict")
    out.warnings(result)
    if row is None:
        out.report.missing("an experiment with this impact velocity in data/experiments/taylor.csv")
    out.missing(result)
    for table in [tables.bar_table(result, row), *tables.received_tables(result)]:
        out.report.table(table)
    if result.frame is not None:
        if "plastic_strain" in result.frame.fields:
            out.draw(figures_impact.taylor_shape(result, row), f"{result.name}_shape",
                     "Deformed bar, each point at its distance from the axis, drawn on both sides.")
        else:
            out.report.missing(f"plastic_strain in {result.folder}/fields.h5")
    if result.history is not None:
        out.draw(figures_impact.energies(result), f"{result.name}_energy", "Conversion of the initial energy.")
        out.balances(result)


def schemes(out, bars):
    """Shows bars that differ in the integration scheme side by side."""
    for i, group in enumerate(figures_schemes.comparable(bars)):
        out.report.heading(f"Integration schemes: {group[0].name} and others")
        out.draw(figures_schemes.foot_columns(group), f"schemes_{i + 1}",
                 "Foot of the bar by each scheme: one column of points per ring, joined along what were straight columns "
                 "and flat layers. Zigzag columns are hourglass modes, as in the paper's Fig. 11 for SNNI.")


def peers(out, bars):
    """Compares the cost with that of other codes, if the bar on which they were measured is among the results."""
    rows = [(bar, out.references.bar(bar)) for bar in bars]
    same = [(bar, row) for bar, row in rows if row and row["material"] == "Al 6061-T6" and figures_cost.cost_ns(bar)]
    if same and out.references.peers:
        out.draw(figures_cost.peers([bar for bar, _ in same], same[0][1], out.references.peers), "peer_codes",
                 "Error of the final length (against the converged reference) and cost, ours and those of other open "
                 "codes on the same bar. Theirs are for about 22,000 points, measured on a quiet machine of this kind "
                 "(data/experiments/peer_codes.csv); ours count all processor time of this run, refreshes and output "
                 f"included. Without a length: {figures_cost.without_length(out.references.peers)}.")


SECTIONS = {Microcell: microcell, Material: material, Slab: sections_slabs.slab, Taylor: taylor, Impact: impact,
            Scaling: sections_scaling.scaling}


def compare(folders, output, references):
    """Makes the report of all folders. Reads everything first, so that nothing is overwritten if an input cannot be read.
    @raises Unreadable."""
    results = [read_result(folder) for folder in folders]
    for i, result in enumerate(results):  # folders with the same name must not share figure files
        same = sum(result.folder.resolve().name == r.folder.resolve().name for r in results[:i])
        result.name += f"_{same + 1}" if same else ""
    output.mkdir(parents=True, exist_ok=True)
    out = Writer(output, references)
    slabs = [r for r in results if isinstance(r, Slab)]
    for kind, section in SECTIONS.items():
        for result in results:
            if type(result) is kind:
                section(out, result)
    sections_slabs.all_slabs(out, slabs)
    bars = [r for r in results if isinstance(r, Taylor)]
    if any(references.bar(bar) for bar in bars):
        out.report.heading("All Taylor bars")
        out.report.table(tables.bars_table(bars, references))
    out.report.heading("Cost")
    out.report.table(tables.cost_table([r for r in results if r.summary]))
    schemes(out, bars)
    peers(out, bars)
    out.report.heading("Origin of the results")
    for result in results:
        out.report.provenance(result)
    target = output / "report.html"
    part = target.with_suffix(".part")
    part.write_text(out.report.html("Spall: results against experiment and paper"), encoding="utf-8")
    os.replace(part, target)
    return target


def main(arguments):
    parser = argparse.ArgumentParser(prog="compare.py", description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULTS",
                        help="folder of microcell, of penetrate, or with tension_*.csv and others of material_point")
    parser.add_argument("--output", default="out/report", metavar="DIR", help="default: %(default)s")
    parser.add_argument("--references", default=EXPERIMENTS, metavar="DIR",
                        help="folder with perforation.csv, taylor.csv, peer_codes.csv (default: data/experiments)")
    options = parser.parse_args(arguments)
    try:
        target = compare(options.results, pathlib.Path(options.output), References.read(options.references))
    except (Unreadable, OSError) as error:
        print(f"compare.py: {error}", file=sys.stderr)
        return 2
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
