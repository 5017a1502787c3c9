"""Sections of the report on runs on many ranks."""

import figures_scaling
import scaling_model
from tables import Table, text

NAMES = {"strong": "Strong scaling", "weak": "Weak scaling"}


def counts_table(runs, series):
    columns = ["ranks", "points", "owned, most", "ghosts, most", "messages per step, most", "bytes per step, most",
               "reductions per step", "refreshes: messages, bytes per step", "busiest / mean processor"]
    rows = [[s["ranks"], s["points"], s["owned_points_max"], s["ghost_points_max"], text(s["messages_per_step_max"]),
             text(s["bytes_per_step_max"], 0), text(s["collectives_per_step_reductions"]),
             f"{text(s['messages_per_step_refreshes'])}, {text(s['bytes_per_step_refreshes'], 0)}",
             text(s["compute_seconds_max"] / s["compute_seconds_mean"], 3)]
            for s in scaling_model.counted(runs, series)]
    return Table(f"{NAMES[series]}: what is sent", columns, rows,
                 "Messages and bytes are counted in MPI's profiling interface, with more ranks than cores, so times are not "
                 "given. 'Most' is the largest value of any rank. In a step velocities are sent and forces are returned. "
                 "Refreshes rebuild neighbours and shape functions; their messages are spread over all steps.")


def coefficients_table(c):
    rows = [["a: processor time per point and step", f"{1e9 * c.point_seconds:.0f} ns", "timed on one rank"],
            ["i: busiest rank over the mean", text(c.imbalance, 3),
             f"counted run with most points per rank on {scaling_model.FEWEST_FOR_IMBALANCE} ranks or more"],
            ["b: processor time per copied point and step", f"{1e9 * c.copy_seconds:.0f} ns",
             "timed strong run on two ranks: time of the busiest rank beyond a for its own points"],
            ["w: depth of others' points around a part", f"{text(c.depth, 2)} points",
             f"mean of the counted runs from {scaling_model.FEWEST_FOR_SURFACE} ranks on; the bytes of the worst are off by "
             f"{100 * c.surface_error:.0f} %"],
            ["m: messages per rank and step", text(c.messages), "largest of the counted runs, refreshes included"],
            ["r: calls of all ranks together per step", text(c.reductions, 2), "run with most ranks, refreshes included"],
            ["g: bytes given to all others per step", text(c.gathered, 1), "run with most ranks, refreshes"]]
    return Table("Coefficients of the model", ["coefficient", "value", "from"], rows)


def model_table(c, assumptions):
    rows = []
    for ranks in assumptions["ranks"]:
        parts = scaling_model.step(c, assumptions, ranks)
        rows.append([f"{ranks:,.0f}", f"{assumptions['points'] / ranks:,.0f}",
                     *(text(1e3 * parts[part], 3) for part in scaling_model.PARTS), text(1e3 * sum(parts.values()), 2),
                     text(100 * scaling_model.efficiency(parts), 0)])
    return Table("Model: milliseconds of a step", ["ranks", "points per rank", *scaling_model.PARTS, "step", "efficiency (%)"],
                 rows)


def speed_ups(runs):
    found = [(series, scaling_model.speed_up(runs, series)) for series in NAMES]
    return [f"Two ranks against one, {series}: {text(s['wall'], 2)} times as many point-steps per second on the wall, "
            f"{text(s['processor'], 2)} times by the busiest rank's processor time outside MPI." for series, s in found if s]


def scaling(out, result):
    runs, assumptions = result.record["runs"], result.record["assumptions"]
    out.report.heading(f"Many ranks: {result.name}", result)
    out.missing(result)
    for sentence in speed_ups(runs):
        out.report.paragraph(sentence, "verdict")
    for series, name in NAMES.items():
        if scaling_model.counted(runs, series):
            out.draw(figures_scaling.communication(runs, series), f"{result.name}_{series}", data=("scaling.json",),
                     caption=f"{name}: time of a step on one rank and two; messages and bytes of a rank in a step, and its copies of "
                     "other ranks' points, on up to "
                     f"{max(s['ranks'] for s in scaling_model.counted(runs, series))} ranks.")
            out.report.table(counts_table(runs, series))
    try:
        c = scaling_model.coefficients(runs)
    except ValueError as reason:
        out.report.missing(f"the model: {reason}")
        return
    out.draw(figures_scaling.model(c, assumptions), f"{result.name}_model", data=("scaling.json",),
             caption="Time of a step on many ranks by the model, by parts; all time but that of computing is lost.")
    out.report.paragraph(
        "Model: a step of n points on P ranks takes a n/P + (i - 1) a n/P + b k + 48 k / bandwidth + (m + r log2 P) latency + "
        "g P / bandwidth: computing, imbalance, work for copies of other ranks' points, their transfer (three numbers sent, "
        "three returned), messages and reductions, bounding boxes that refreshes send to all ranks. The e^3 = n/P points of a "
        "rank are taken for a cube that is surrounded by other ranks' points, w points deep: k = (e + 2 w)^3 - e^3, of the order "
        "of 6 w (n/P)^(2/3). Computing and sending do not overlap, and every message waits for the one before it."
        f" Assumed: latency {1e6 * assumptions['latency']:g} us, bandwidth {1e-9 * assumptions['bandwidth']:g} GB/s, "
        f"{assumptions['points']:.3g} points. Output and the checks of the critical step (every 500 steps, about ten steps "
        "each) are left out.")
    out.report.table(coefficients_table(c))
    out.report.table(model_table(c, assumptions))
