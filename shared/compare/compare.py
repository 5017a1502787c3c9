#!/usr/bin/python3
"""Draws results and compares them with experiments and the paper: figures (PNG, SVG) and report.html."""

import pathlib
import sys

import charts
import digitised
import expected_errors
import figures_cost
import figures_curves
import figures_impact
import figures_material
import figures_schemes
import overview
import sections_curves
import sections_digitised
import sections_scaling
import sections_slabs
import sections_tension
import sections_uncertainty
import sections_validation
import tables
from files import Unreadable
from reading import read_result
from references import EXPERIMENTS, References
from report import HOME, Report, read_library
from results import Curve, Impact, Limit, Material, Microcell, Scaling, Slab, Taylor, Uncertainty
from style import save
from writing import Parser, Refused, Unwritten, own, run_script, visible, write


# Files that figures show.
HISTORY, FIELDS, CURVE, TABLES = ("history.csv",), ("fields.h5",), ("curve.csv",), ("damage_table.csv", "damage_table.h5")


class Writer:
    """Adds figures and tables to the report, and writes the figures to disk."""

    def __init__(self, folder, references):
        self.folder, self.references, self.report = folder, references, Report(folder)
        self.verdicts = []  # {name, sentence} on single results against experiment or reference
        self.cautions = []  # {name, text} of doubts about single results
        self.odd = []  # (name, reason) of runs that are not what they should be

    def attempt(self, name, draw):
        """Draws a part of the report. If it cannot be drawn, the report says so and goes on. Returns whether it could."""
        before = len(self.report.sections)
        try:
            draw()
            return True
        except Unwritten:
            raise
        except Exception as error:  # whatever it is, the other parts are to be seen
            reason = f"cannot be reported in full ({type(error).__name__}: {error})"
            if len(self.report.sections) == before:
                self.report.heading(name)
            self.report.missing(f"the rest of this section: it {reason}")
            self.odd.append((name, reason))
            return False

    def draw(self, drawn, name, caption, data=(), **more):
        """Writes a figure and adds it to the report. data: names of the files in the results' folders that it shows; more: see Report.picture."""
        found = charts.of_figure(drawn)
        self.report.picture(save(drawn, self.folder, name, caption), data, found, **more)

    def verdict(self, name, sentence):
        """Adds a sentence on one result against its experiment or reference to the head of the report and to verdict.txt."""
        self.verdicts.append({"name": name, "sentence": sentence})

    def missing(self, result):
        if result.unfinished:
            self.report.missing(f"the end of the run: {result.unfinished}")
        if result.missing:
            self.report.missing(f"{', '.join(result.missing)} in {result.folder}")

    def warnings(self, result):
        """Adds what is doubtful about a result to the head of the report."""
        self.cautions += [{"name": result.name, "text": text} for text in overview.cautions(result)]

    def balances(self, result):
        self.draw(figures_impact.balances(result), f"{result.name}_balance", "Errors of energy and momentum balance.",
                  HISTORY)


def microcell(out, result):
    out.report.heading(f"Microcell: {result.name}", result)
    out.missing(result)
    name, curve = result.name, result.reference
    if curve is not None:
        out.draw(figures_curves.homogenised_stress(curve), f"{name}_stress", data=CURVE,
                 caption="Homogenised stress of the reference cell in uniaxial strain.")
        out.draw(figures_curves.damage_definitions(curve), f"{name}_damage", data=CURVE,
                 caption="Damage of the reference cell in all definitions.")
        out.draw(figures_curves.free_energies(curve), f"{name}_energies", data=CURVE,
                 caption="Free energies of the reference cell, dissipation and work.")
    if result.band and curve is not None:
        out.draw(figures_curves.ensemble_band(curve, result.band, result.summary["samples"]), f"{name}_band", data=TABLES,
                 caption="Random cells: mean and band of the stress; remaining strength in the simulation of the slab with each of the "
                 "three tables; stiffness damage.")
    if result.states:
        out.draw(figures_curves.opened_cell(result.states), f"{name}_cell", data=("fields.pvd",),
                 caption="The cell near its peak stress, about half broken and at the last state, displacements magnified.")
    if result.curves:
        out.draw(figures_curves.damage_sizes(result.curves), f"{name}_sizes", data=TABLES,
                 caption="Strength damage, the column that the simulation of the slab uses by default, and stiffness damage for every "
                 "cell size of the table.")
        out.report.table(tables.microcell_table(result))


def material(out, result):
    out.report.heading(f"Concrete at a material point: {result.name}", result)
    out.missing(result)
    for draw, name, files, caption in figures_material.FIGURES:
        if any(file in result.curves for file in files):
            out.draw(draw(result.curves), f"{result.name}_{name}", caption, [f"{file}.csv" for file in files])


def impact(out, result):
    """Reports on a run that neither follows a shot nor measures a bar."""
    out.report.heading(f"Impact: {result.name}", result)
    out.warnings(result)
    out.missing(result)
    for table in tables.received_tables(result):
        out.report.table(table)
    if result.history is not None:
        out.draw(figures_impact.energies(result), f"{result.name}_energy", data=HISTORY, caption="Conversion of the initial energy.")
        out.balances(result)


def taylor(out, result):
    row = out.references.bar(result)
    out.report.heading(f"Taylor bar: {result.name}", result)
    out.verdict(result.name, tables.bar_verdict(result, row))
    out.warnings(result)
    if row is None:
        out.report.missing("an experiment with this impact velocity in data/experiments/taylor.csv")
    out.missing(result)
    for table in [tables.bar_table(result, row), *tables.received_tables(result)]:
        out.report.table(table)
    if result.frame is not None:
        if "plastic_strain" in result.frame.fields:
            out.draw(figures_impact.taylor_shape(result, row), f"{result.name}_shape", data=FIELDS,
                     caption="Deformed bar, each point at its distance from the axis, drawn on both sides.")
        else:
            out.report.missing(f"plastic_strain in {result.folder}/fields.h5")
    if result.history is not None:
        out.draw(figures_impact.energies(result), f"{result.name}_energy", data=HISTORY, caption="Conversion of the initial energy.")
        out.balances(result)


def schemes(out, bars):
    """Shows bars that differ in the integration scheme side by side."""
    for i, group in enumerate(figures_schemes.comparable(bars)):
        out.report.heading(f"Integration schemes: {group[0].name} and others", *group)
        out.draw(figures_schemes.foot_columns(group), f"schemes_{i + 1}", data=FIELDS,
                 caption="Foot of the bar by each scheme: one column of points per ring, joined along what were straight columns "
                 "and flat layers. Zigzag columns are hourglass modes, as in the paper's Fig. 11 for SNNI.")


def peers(out, bars):
    """Compares the cost with that of other codes, if the bar on which they were measured is among the results."""
    rows = [(bar, out.references.bar(bar)) for bar in bars]
    same = [(bar, row) for bar, row in rows if row and row["material"] == "Al 6061-T6" and figures_cost.cost_ns(bar)]
    if same and out.references.peers:
        out.draw(figures_cost.peers([bar for bar, _ in same], same[0][1], out.references.peers), "peer_codes", data=("summary.json",),
                 caption="Error of the final length (against the converged reference) and cost, ours and those of other open "
                 "codes on the same bar. Theirs are for about 22,000 points, measured on a quiet machine of this kind "
                 "(data/experiments/peer_codes.csv); ours count all processor time of this run, refreshes and output "
                 f"included. Without a length: {figures_cost.without_length(out.references.peers)}.")


# Sections of single results. What slabs and bars rest on, concrete and microcell, comes behind what compares these.
ANSWERS = {Slab: sections_slabs.slab, Taylor: taylor, Impact: impact, Uncertainty: sections_uncertainty.uncertainty,
           Curve: sections_curves.curve, Limit: sections_curves.limit, Scaling: sections_scaling.scaling}
BASIS = {Material: material, Microcell: microcell}


def read_all(folders):
    """Returns the results that can be read, and (folder, reason) of the others. @raises Unreadable if a folder is not there, or if
    there is nothing else"""
    results, odd = [], []
    for folder in folders:
        if not pathlib.Path(folder).is_dir():
            raise Unreadable(f"{folder}: no such folder")
        try:
            results.append(read_result(folder))
        except Unreadable as error:
            odd.append((str(folder), str(error)))
        except Exception as error:  # damaged in a way that nobody has thought of
            odd.append((str(folder), f"cannot be read ({type(error).__name__}: {error})"))
    if not results:
        raise Unreadable(odd[0][1])
    for i, result in enumerate(results):  # folders of one name must not share figure files
        same = sum(result.folder.resolve().name == r.folder.resolve().name for r in results[:i])
        result.name += f"_{same + 1}" if same else ""
    return results, odd


def sections(out, results, kinds):
    """Draws the section of each result of some kinds. Returns those that are sound enough to be compared with others."""
    sound = []
    for kind, section in kinds.items():
        for result in results:
            if type(result) is kind and out.attempt(result.name, lambda: one_section(out, result, section)) and not result.empty:
                sound.append(result)
    return sound


def one_section(out, result, section):
    if result.unfinished:
        out.odd.append((result.name, f"has not come to its end: {result.unfinished}"))
    if result.empty:
        out.odd.append((result.name, result.empty))
        out.report.heading(f"{type(result).__name__}: {result.name}", result)
        out.report.missing(f"what could be drawn: {result.empty}")
    else:
        section(out, result)


def taylor_bars(out, bars):
    if any(out.references.bar(bar) for bar in bars):
        out.report.heading("All Taylor bars")
        out.report.table(tables.bars_table(bars, out.references))


def stated_errors(out, results):
    """Compares the errors that runs state with those they have, where a converged solution is known."""
    compared = expected_errors.collect(results, out.references)
    if not compared:
        return
    out.report.heading("Numerical error: stated and found")
    out.report.table(expected_errors.table(compared))
    if len(compared) > 1:
        out.draw(expected_errors.draw(compared), "stated_errors", data=("summary.json",),
                 caption="The error that each run states, from its scheme and spacing, and the one it has. In the shaded part it is "
                 f"larger than stated. Errors below {expected_errors.SMALLEST} % are drawn at that height.")


def odd_runs(odd):
    return tables.Table("Runs that are odd or have not ended", ["result", "why"], [list(row) for row in dict.fromkeys(odd)],
                        "They are left out where they cannot be compared.")


def compare(results, odd, output, references, library):
    """Writes the report on what read_all() has returned. library: what read_library() returns. @raises Unwritten"""
    out = Writer(output, references)
    out.odd += odd
    sound = sections(out, results, ANSWERS)
    slabs, bars = ([r for r in sound if isinstance(r, kind)] for kind in (Slab, Taylor))
    sections_slabs.all_slabs(out, slabs)
    out.attempt("validation", lambda: sections_validation.section(out, slabs))
    out.attempt("concrete in tension", lambda: sections_tension.section(out, [r for r in sound if type(r) is Impact]))
    out.attempt("all Taylor bars", lambda: taylor_bars(out, bars))
    sound += sections(out, results, BASIS)
    out.attempt("digitised figures", lambda: sections_digitised.section(out, sound))
    out.attempt("stated errors", lambda: stated_errors(out, sound))
    out.report.heading("Cost")
    out.attempt("costs", lambda: out.report.table(tables.cost_table([r for r in results if r.summary])))
    out.attempt("integration schemes", lambda: schemes(out, bars))
    out.attempt("other codes", lambda: peers(out, bars))
    out.report.heading("Where the numbers come from")
    for result in results:
        out.attempt(result.name, lambda result=result: out.report.provenance(result))
    first = head(out, results, sound)
    for name, reason in dict.fromkeys(out.odd):
        print(f"odd: {visible(name)}: {visible(reason)}")
    write(output / "verdict.txt", "".join(f"{one['name']}: {one['sentence']}\n" for one in out.verdicts))
    pages = out.report.html("Spall: results against experiment and paper", library, **first)
    for name, text in pages.items():
        write(output / name, text)
    return output / HOME


def rows_of(out, results, rows):
    """Returns the rows of all results in a table of the head. rows: function of a result; where it fails, the result is odd."""
    found = []
    for result in results:
        try:
            found += rows(result)
        except Exception as error:  # the answers of the others are to be seen
            out.odd.append((result.name, f"cannot be listed ({type(error).__name__}: {error})"))
    return found


def head(out, results, sound):
    """Returns what the page begins with, by the names that page/page.html has for it."""
    answers = rows_of(out, sound, lambda result: overview.answers(result, out.references))
    computed = rows_of(out, results, lambda result: [overview.computed(result)])
    return {"verdicts": out.verdicts, "cautions": out.cautions, "answers": overview.answer_table(answers),
            "computed": overview.computed_table(computed), "odd": odd_runs(out.odd) if out.odd else None,
            "command": overview.command(results, out.folder)}


def main(arguments):
    parser = Parser(prog="compare.py", description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULTS",
                        help="folder of microcell, of penetrate, or with tension_*.csv and others of material_point")
    parser.add_argument("--output", default="out/report", metavar="DIR", help="default: %(default)s")
    parser.add_argument("--references", default=EXPERIMENTS, metavar="DIR",
                        help="folder with perforation.csv, penetration_depth.csv and the others (default: data/experiments)")
    parser.add_argument("--digitised", default=digitised.FOLDER, metavar="DIR",
                        help="folder with curves read off the paper's figures (default: data/digitised)")
    parser.add_argument("--force", action="store_true", help="replaces a report that is there")
    options = parser.parse_args(arguments)
    try:
        references = References.read(options.references)
        references.digitised = digitised.read(options.digitised)
        results, odd = read_all(options.results)
        library = read_library()
    except (Unreadable, OSError) as error:
        raise Refused(error) from error
    with own(options.output, [HOME, "result_*.html"], options.force):
        print(compare(results, odd, pathlib.Path(options.output), references, library))
    return 0


if __name__ == "__main__":
    sys.exit(run_script("compare.py", lambda: main(sys.argv[1:])))
