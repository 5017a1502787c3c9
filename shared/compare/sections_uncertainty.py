"""Sections of the report on samples of uncertain inputs."""

import re

import numpy as np

import figures_uncertainty
from figures_uncertainty import unit_of
from results import Slab, Taylor
from tables import Table, text

# Answers that tests have measured, with the column of the file of experiments; in the unit of the figures.
MEASURED = {(Slab, "exit_velocity"): "experiment_exit_m_s", (Taylor, "final_length_ratio"): "final_length_ratio_experiment"}
SAMPLES = ("uncertainty.json", "samples.csv")  # files that figures show
MOST_SHOWN = 20  # failed runs in the table; samples.csv has all


def measured(base, answer, references):
    """Returns the measured value of an answer of the input as it is; None if there is none on record."""
    column = MEASURED.get((type(base), answer))
    row = column and (references.slab(base) if isinstance(base, Slab) else references.bar(base))
    return row.get(column) if row else None


def bounded(end, digits, scale):
    """Returns a quantile with the range that the number of samples leaves open; an end that is not bounded is open."""
    low, high = ("open" if end[side] is None else text(end[side], digits, scale) for side in ("low", "high"))
    return f"{text(end['value'], digits, scale)} [{low}; {high}]"


def band_table(record, values):
    """values: {answer: measured value in its unit, or None}"""
    rows = []
    for answer, result in record["answers"].items():
        unit, scale, digits = unit_of(answer)
        name = answer.replace("_", " ") + (f" ({unit})" if unit else "")
        if not result["count"]:
            rows.append([name, "0", str(result["without"]), *["–"] * 7])
            continue
        errors = [np.array(ends, dtype=float) - np.array(result["values"]) for ends in result["numerical"] if None not in ends]
        numerical = " to ".join(f"{scale * np.median(error):+.{digits}f}" for error in errors) if len(errors) == 2 else "–"
        rows.append([name, str(result["count"]), str(result["without"]), *(bounded(end, digits, scale) for end in result["band"]),
                     text(result["deviation"], digits, scale), numerical, text(result["as_it_is"], digits, scale),
                     text(values[answer], digits)])
    return Table("Bands", ["answer", "values", "without a value", "5 %", "median", "95 %", "standard deviation",
                           "numerical error of a run (median)", "inputs as they are", "experiment"], rows,
                 "In square brackets: where the quantile lies with 90 % confidence, whatever the distribution; 59 values bound "
                 "both ends. A projectile that is stopped has an exit velocity of 0, which counts; a depth is without a value "
                 "where the target was perforated. The numerical error (spacing and layout of the points) is not in the "
                 "band; where the layout is itself an input, its scatter is in both.")


def contribution_table(result, unranked):
    found = result["contributions"]
    order = sorted(found["shares"], key=lambda name: -found["shares"][name])
    rows = [[name, text(found["shares"][name], 1, 100), text(found["errors"][name], 1, 100),
             text(found["spearman"][name], 2, signed=True)] for name in order]
    rows.append([", ".join(["rest", *unranked]), text(1 - found["r2"], 1, 100), "–", "–"])
    return Table("Contributions", ["input", "share of the variance of the ranks (%)", "standard error (points)",
                                   "Spearman rank correlation"], rows,
                 f"Regression of the ranks of the answer on those of the inputs: R2 {found['r2']:.2f}, adjusted for "
                 f"{found['regressors']} regressors {found['r2_adjusted']:.2f}. The shares add up to R2; one without effect is "
                 "near zero, also below it. Standard errors are from samples drawn again with replacement. Correlations within "
                 f"{result['noise']:.2f} are no evidence of an effect. Inputs without order, such as random seeds, are in the rest;"
                 " of alternatives no correlation is given.")


def input_table(record):
    return Table("Uncertain inputs", ["input", "keys", "distribution"],
                 [[one["name"], ", ".join(one["keys"]), ", ".join(one["distributions"])] for one in record["inputs"]],
                 f"{record['samples']} samples of a Latin hypercube, seed {record['seed']}" + (
                     "." if record["complete_hypercube"] else
                     "; its last doubling is incomplete (complete: 25, 50, 100, 200, ...)."))


def sentence(answer, result, value):
    """Returns a sentence on the band of an answer, and on the place of the measured value in it."""
    unit, scale, digits = unit_of(answer)
    low, median, high = (text(end["value"], digits, scale) for end in result["band"])
    unit = f" {unit}" if unit else ""
    words = (f"{answer.replace('_', ' ')}: {median}{unit}, with uncertain inputs {low} to {high}{unit} "
             f"(5 to 95 % of {result['count']} samples)")
    if value is None:
        return words + "."
    share = np.mean(scale * np.array(result["values"]) < value)
    inside = scale * result["band"][0]["value"] <= value <= scale * result["band"][2]["value"]
    place = "in the band" if inside else "outside the band"
    return words + f"; the measured {value:g}{unit} lies {place}: {100 * share:.0f} % of the samples are below it."


def answer_section(out, result, answer, found, value):
    name = re.sub(r"[^A-Za-z0-9]+", "_", f"{result.name}_{answer}")
    out.draw(figures_uncertainty.distribution(answer, found, value), f"{name}_distribution", data=SAMPLES,
             caption=f"{answer.replace('_', ' ')} over the samples: number of samples, and share of samples below a value.")
    for caution in found["cautions"]:
        out.report.paragraph(f"Caution: {caution}.", "missing")
    unranked = [one["name"] for one in result.record["inputs"] if not one["ranked"]]
    if found["contributions"]["r2"] is not None:
        out.draw(figures_uncertainty.contributions(answer, found, unranked), f"{name}_contributions", data=SAMPLES,
                 caption=f"What each input contributes to the scatter of the {answer.replace('_', ' ')}, with standard errors.")
        out.report.table(contribution_table(found, unranked))
    out.draw(figures_uncertainty.convergence(answer, found, value), f"{name}_convergence", data=SAMPLES,
             caption="The band of the first samples against their number; shaded: 90 % confidence, where both ends are bounded.")


def uncertainty(out, result):
    record = result.record
    out.report.heading(f"Uncertainty: {result.name}", result)
    values = {answer: measured(result.base, answer, out.references) for answer in record["answers"]}
    for answer, found in record["answers"].items():
        if found["count"]:
            out.verdict(result.name, sentence(answer, found, values[answer]))
    out.missing(result)
    failed = record["failed"]
    if failed:
        out.odd.append((result.name, f"{len(failed)} of {record['samples']} samples failed: they are not in the band"))
    out.report.table(band_table(record, values))
    out.report.table(input_table(record))
    if failed:
        out.report.table(Table("Samples that failed", ["sample", "why"], [[str(one["sample"]), one["failure"]]
                                                                       for one in failed[:MOST_SHOWN]],
                               f"{len(failed)} of {record['samples']}; samples.csv has all of them with their inputs."))
    for answer, found in record["answers"].items():
        if found["count"]:
            answer_section(out, result, answer, found, values[answer])
        else:
            out.report.missing(f"{answer}: no sample has a value")
