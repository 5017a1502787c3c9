"""Sections of the report on studies of curves and limits."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "studies"))

import curve_chart  # noqa: E402
import limit_chart  # noqa: E402
from figures_uncertainty import unit_of  # noqa: E402
from tables import Table, banded, text  # noqa: E402


def band_of(point):
    """Returns the range that the numerical error of a run leaves open; None if it is not known."""
    return None if None in (point["low"], point["high"]) else (point["low"], point["high"])


def points_table(record, answer, found):
    unit, scale, digits = unit_of(answer)
    measured = {x: value for x, value, _ in found["measured"]}
    rows = [[f"{point['x']:g}", banded(point["value"], band_of(point), digits, scale), text(measured.get(point["x"]), digits, scale),
             point["failure"] or point["state"]] for point in found["points"]]
    return Table(answer.replace("_", " "), [curve_chart.label_of_key(record), f"Spall ({unit})" if unit else "Spall", "experiment", "outcome"], rows)


def measured_sentences(record, answer, found):
    """Returns a sentence for each measured point at which there is a run."""
    unit, scale, digits = unit_of(answer)
    sentences = []
    for x, value, _ in found["measured"]:
        for point in found["points"]:
            if point["x"] != x or point["value"] is None:
                continue
            words = (f"{answer.replace('_', ' ')} at {x:g} {record['unit']}: "
                     f"{banded(point['value'], band_of(point), digits, scale)} {unit}, measured {text(value, digits, scale)} {unit}")
            if band := band_of(point):
                words += ", within the numerical band" if band[0] <= value <= band[1] else ", outside the numerical band"
            sentences.append(words + ".")
    return sentences


def curve(out, result):
    record = result.record
    out.report.heading(f"Curve: {result.name}")
    out.missing(result)
    for answer, found in record["answers"].items():
        for sentence in measured_sentences(record, answer, found):
            out.verdict(result.name, sentence)
        name = re.sub(r"[^A-Za-z0-9]+", "_", f"{result.name}_{answer}")
        out.draw(curve_chart.chart(record, answer), name, data=("curve.csv", "curve.json"),
                 caption=f"{answer.replace('_', ' ').capitalize()} against {curve_chart.label_of_key(record)}: computed with its numerical error, "
                 "fitted, measured, and by published formulas.")
        out.report.table(points_table(record, answer, found))
        if found["fits"]:
            out.report.table(Table("Fits", ["fit", "constants with standard errors"],
                                   [words.split(": ", 1) for words in (fit["words"] for fit in found["fits"])]))


def limit_sentence(record):
    what = f"{record['criterion']} by {record['key']}"
    if record["limit"] is None:
        return f"{what}: no limit was found."
    words = f"{what}: limit {record['limit']:.4g} ± {record['width'] / 2:.2g} {record['unit']}"
    if record["band"]:
        words += f", numerically {record['band'][0]:.4g} to {record['band'][1]:.4g}"
    layouts = record["layouts"]
    if layouts and layouts["count"] > 1:
        words += f"; {layouts['count']} layouts: mean {layouts['mean']:.4g}, standard deviation {layouts['deviation']:.2g} {record['unit']}"
    return words + "."


def searches_table(record):
    unit = record["unit"]
    rows = [[one["layout"], *(text(one.get(key), 1) for key in ("limit", "low", "high")),
             " to ".join(text(end, 1) for end in one["disorder"]) if one.get("disorder") else "–"] for one in record["searches"]]
    return Table("Limits by layout", ["layout of the points", f"limit ({unit})", "does not pass below", "passes above", "answers out of order"], rows,
                 "Near a limit answers can be out of order: a faster projectile stops where a slower one passes. A limit is then no sharper "
                 "than that range.")


def limit(out, result):
    record = result.record
    out.report.heading(f"Limit: {result.name}")
    out.verdict(result.name, limit_sentence(record))
    for one in record["searches"]:
        if one.get("disorder"):
            out.cautions.append({"name": result.name, "text": f"{one['layout']}: answers are out of order between "
                                 f"{' and '.join(text(end, 1) for end in one['disorder'])} {record['unit']}"})
    out.missing(result)
    if result.rows:
        out.draw(limit_chart.chart(record, result.rows), result.name, data=("limit.csv", "limit.json"),
                 caption="What passes and what does not, the limit with its numerical range and those of other layouts, and the limits of published "
                 "formulas.")
    out.report.table(searches_table(record))
    if record["formulas"]:
        out.report.table(Table("Limits by published formulas", ["formula", f"limit ({record['unit']})", "within its tests"],
                               [[one["formula"], text(one["limit"], 1), "no" if one["outside"] else "yes"]
                                for one in sorted(record["formulas"], key=lambda one: one["limit"])]))
