"""The chart of a limit: what passes and what does not, the limit with its bands, the formulas, and the statistics."""

import pathlib
import sys

import numpy as np
from probit import phi

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from curve_chart import label_of_key  # noqa: E402
from style import CYCLE, OURS, error_bars, figure, save  # noqa: E402

ANSWERS = {"yes": ("o", OURS), "no": ("v", "white"), "none": ("x", OURS)}


def runs(axes, record, rows, title):
    """Draws the exit velocities of all runs but the samples; those of cheaper models are small and grey."""
    for answer, (marker, face) in ANSWERS.items():
        for own, color, size in ((False, "0.6", 4), (True, OURS, 6)):
            mine = [one for one in rows if one["passes"] == answer and (one["model"] == "as it is") == own and one["layout"] != "sample"]
            if mine:
                words = {"yes": "passes", "no": "does not pass", "none": "no answer"}[answer]
                axes.plot([float(one[title]) for one in mine], [one["exit_velocity"] or 0 for one in mine], marker, color=color,
                          markersize=size, markerfacecolor=face if own or answer == "no" else color, linestyle="", clip_on=False,
                          zorder=4 if own else 3, label=words if own else f"{words}, cheaper model")
    base = [one for one in rows if one["model"] == "as it is" and one["layout"] == "as it is"]
    error_bars(axes, [(float(one[title]), one["exit_velocity"], (one["exit_velocity_low"], one["exit_velocity_high"])) for one in base
                      if None not in (one["exit_velocity"], one["exit_velocity_low"], one["exit_velocity_high"])], OURS)


def limits(axes, record):
    unit = f" {record['unit']}" if record["unit"] else ""
    if record["limit"] is not None:
        axes.axvline(record["limit"], color=OURS, linewidth=1.6, label=f"limit {record['limit']:.4g} ± {record['width'] / 2:.2g}{unit}")
    if record["band"]:
        axes.axvspan(*record["band"], color=OURS, alpha=0.12, linewidth=0,
                     label=f"numerical error: {record['band'][0]:.4g} to {record['band'][1]:.4g}{unit}")
    others = [one["limit"] for one in record["searches"][1:] if "limit" in one]
    for i, place in enumerate(others):
        axes.axvline(place, color=CYCLE[2], linewidth=0.8, linestyle="--", label="limits of other layouts" if i == 0 else None)


def formulas(axes, record, rows, title):
    """Lists the formulas at their limits, those outside of their tests in grey."""
    found = sorted(record["formulas"], key=lambda one: one["limit"])
    for y, one in enumerate(found):
        color = "0.6" if one["outside"] else CYCLE[1]
        axes.plot(one["limit"], y, "s", color=color, markersize=6)
        axes.annotate(one["formula"] + (" *" if one["outside"] else ""), (one["limit"], y), (6, 0), textcoords="offset points",
                      va="center", fontsize=8, color=color)
    axes.set_ylim(-0.7, len(found) - 0.3)
    axes.set_yticks([])
    axes.set_ylabel("formulas\n(* outside of\ntheir tests)", fontsize=8)


def statistics(axes, record, rows, title):
    found, rises = record["statistic"], record["searches"][0]["rises"]
    shots = [(float(one[title]), one["passes"]) for one in rows if one["layout"] == "sample" and one["passes"] != "none"]
    for answer, (marker, face) in ANSWERS.items():
        mine = [x for x, passes in shots if passes == answer]
        if not mine:
            continue
        axes.plot(mine, [1 if answer == "yes" else 0] * len(mine), marker, color=CYCLE[3], markerfacecolor=face if answer == "no" else
                  CYCLE[3], markersize=4, linestyle="", clip_on=False)
    if found["spread"] is not None and shots:
        x = np.linspace(min(x for x, _ in shots), max(x for x, _ in shots), 200)
        sign = 1 if rises else -1
        axes.plot(x, [phi(sign * (one - found["v50"]) / found["spread"]) for one in x], color=CYCLE[3],
                  label=f"V50 {found['v50']:.4g} ± {found['errors'][0]:.2g}, standard deviation {found['spread']:.3g} ± "
                        f"{found['errors'][1]:.2g} {record['unit']}\n({found['count']} shots with random inputs)")
    axes.set(ylim=(-0.03, 1.03), ylabel="share\nthat passes")


def chart(record, rows):
    """Returns the figure. record: the contents of limit.json; rows: those of limit.csv"""
    title = record["key"] + (f" ({record['unit']})" if record["unit"] else "")
    parts = [(limits_and_runs, 3.2)] + [(of, height) for of, height, wanted in (
        (statistics, 1.5, record["statistic"]), (formulas, 0.6 + 0.2 * len(record["formulas"]), record["formulas"])) if wanted]
    heights = [height for _, height in parts]
    drawn, panels = figure(10.5, 1.0 + sum(heights), len(parts), 1, sharex=True, gridspec_kw={"height_ratios": heights}, squeeze=False)
    for (part, _), axes in zip(parts, panels[:, 0]):
        part(axes, record, rows, title)
        handles, labels = axes.get_legend_handles_labels()
        if handles:
            axes.legend(handles, labels, loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)
    places = [float(one[title]) for one in rows] + [one["limit"] for one in record["formulas"]]
    margin = max(places) - min(places)
    panels[-1, 0].set_xlim(min(places) - 0.03 * margin, max(places) + 0.15 * margin)  # room for the name of a formula
    panels[-1, 0].set_xlabel(label_of_key(record))
    panels[0, 0].set_title(f"{record['study']}: {record['criterion']}", fontsize=11, loc="left")
    return drawn


def draw(record, rows, folder):
    return save(chart(record, rows), folder, "limit", "limit")


def limits_and_runs(axes, record, rows, title):
    limits(axes, record)
    runs(axes, record, rows, title)
    axes.set(ylabel="exit velocity (m/s)")
    axes.set_ylim(bottom=0)
