"""What the report begins with: the answers beside measured and published values, what was computed and how long it took, warnings."""

import shlex

import slab_runs
import tables
import validation
from results import Curve, Impact, Limit, Material, Microcell, Slab, Taylor
from tables import CONVERGED, EXPERIMENT, NMAP, OURS, Table, banded, text, with_unit

FORMULAS = "formulas: smallest to largest"


def measured_text(value, scatter, digits):
    return text(value, digits) + ("" if scatter is None else f" ± {text(scatter, digits)}")


def row(result, quantity, ours, measured=(None, None), formulas="–", nmap=None, converged=None, digits=1, unit=""):
    """Returns one row of the answers. ours: (value, band); measured: (value, scatter); all in the unit of the table."""
    value, band = ours
    miss = None if None in (value, measured[0]) else value - measured[0]
    within = "–" if band is None or miss is None else "yes" if band[0] <= measured[0] <= band[1] else "no"
    return [result.name, quantity, banded(value, band, digits), measured_text(*measured, digits),
            with_unit(miss, unit, digits).strip(), within, formulas, text(nmap, digits), text(converged, digits)]


def range_of(formulas):
    """Returns the smallest and the largest value of the formulas, with their names."""
    return validation.formulas_text(validation.Check("", "", "", 0.0, None, 0, None, formulas=formulas))


def slab_answers(slab, references):
    """Returns the rows of a shot: exit velocity, depth of penetration."""
    solved = slab_runs.verification_row(slab, references.verification)
    tests = None if solved else references.slab(slab)
    predictions = [] if solved else validation.formula_rows(slab, tests or {})
    checks = {check.quantity: check for check in ([] if solved else validation.checks_of(slab, references))}
    rows = []
    if slab.exit_velocity is not None:
        check = checks.get(validation.EXIT)
        rows.append(row(slab, "exit velocity (m/s)", (slab.exit_velocity, slab.exit_band),
                        (check.measured, check.scatter) if check else (None, None),
                        range_of(validation.said(predictions, "residual")), (tests or {}).get("nmap_exit_m_s"),
                        solved["exit_m_s"] if solved else None, unit="m/s"))
    if slab.penetration_depth is not None:
        check = checks.get(validation.DEPTH)
        rows.append(row(slab, "depth of penetration (mm)",
                        (1e3 * slab.penetration_depth, validation.scaled_band(slab.band(slab.depth_key))),
                        (check.measured, check.scatter) if check else (None, None),
                        range_of(validation.said(predictions, "depth", 1e3)), unit="mm"))
    return rows


def bar_answers(bar, references):
    """Returns the row of a bar: its final length over the initial one."""
    ratio, known = bar.number("final_length_ratio"), references.bar(bar) or {}
    if ratio is None:
        return []
    values = [known.get(f"final_length_ratio_{source}") for source in ("experiment", "nmap", "converged")]
    return [row(bar, "final length / initial length", (ratio, bar.band("final_length_ratio")), (values[0], None), "–", *values[1:],
                digits=4)]


COLUMNS = ["result", "quantity", OURS, EXPERIMENT, "Spall − experiment", "measured value in the band", FORMULAS, NMAP, CONVERGED]
NOTES = {EXPERIMENT: "± is half of the range of several tests or the stated uncertainty.",
         FORMULAS: "An asterisk: the shot is outside of the tests that the formula was fitted to.",
         NMAP: "NMAP: the paper's run of low resolution."}


def answers(result, references):
    """Returns the rows of a result in the table of answers."""
    if isinstance(result, Slab):
        return slab_answers(result, references)
    return bar_answers(result, references) if isinstance(result, Taylor) else []


def answer_table(rows):
    """Returns the table of answers without the columns that are empty; None without an answer."""
    used = [i for i in range(len(COLUMNS)) if any(one[i] != "–" for one in rows)]
    return Table("Answers", [COLUMNS[i] for i in used], [[one[i] for i in used] for one in rows],
                 " ".join(words for name, words in NOTES.items() if COLUMNS.index(name) in used)) if rows else None


def what(result):
    """Returns in words what a result is."""
    if isinstance(result, Slab):
        return f"shot: {validation.shot_words(result)}"
    if isinstance(result, Taylor):
        return f"Taylor bar, {text(result.number('impact_velocity'), 0)} m/s"
    if isinstance(result, Microcell):
        return f"damage table of a cracked cell of {text(result.summary.get('cell_size'), 1, 1e3)} mm, {len(result.curves)} sizes"
    if isinstance(result, Material):
        return f"a material point along {len(result.curves)} strain paths"
    if isinstance(result, Curve):
        runs = max(len(found["points"]) for found in result.record["answers"].values())
        return f"{', '.join(result.record['answers']).replace('_', ' ')} against {result.record['key']}, {runs} runs"
    if isinstance(result, Limit):
        return f"limit of {result.record['criterion']} by {result.record['key']}, {len(result.rows)} runs"
    return type(result).__name__.lower()


def duration(seconds):
    """Returns a time in words that fit its size."""
    if seconds is None:
        return "–"
    return f"{seconds:.1f} s" if seconds < 100 else f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def computed(result):
    """Returns the row of a result in the table of what was computed."""
    get = result.summary.get
    points = next((get(key) for key in ("points", "dofs") if isinstance(get(key), (int, float))), None)
    seconds = get("wall_seconds")
    work = f"{get('ranks')} × {get('threads')}" if "ranks" in result.summary else "–"
    return [result.name, what(result), slab_runs.resolution(result) if isinstance(result, Slab) else str(get("scheme", "–")),
            text(points, 0), work, duration(seconds if isinstance(seconds, (int, float)) else None), result.provenance.program,
            result.provenance.created.replace("T", " ").rstrip("Z")[:16]]


def computed_table(rows):
    """Returns the table of what was computed, with which program, on what, and how long it took."""
    return Table("What was computed", ["result", "what", "method", "points or unknowns", "processes × threads", "wall time", "program",
                                       "when"], rows)


def cautions(result):
    """Returns the sentences that warn of a result: those of the program, and what its energies say."""
    found = list(tables.impact_warnings(result)) if isinstance(result, Impact) and result.history is not None else []
    said = str(result.summary.get("warnings") or "")
    return found + ([said] if said else [])


def command(results, folder):
    """Returns the command that makes the report again."""
    return shlex.join(["shared/compare/compare.py", *(str(result.folder) for result in results), "--output", str(folder), "--force"])
