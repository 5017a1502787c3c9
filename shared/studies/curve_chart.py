"""The chart of a curve: an answer against a swept key, computed, fitted, measured and by formulas."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from figures_uncertainty import unit_of  # noqa: E402
from style import CYCLE, EXPERIMENT, OURS, error_bars, figure, save  # noqa: E402

FIT_STYLES = {"Recht-Ipson": "-", "Lambert-Jonas": "--", "linear": ":"}
# State: (marker, whether it is filled, words). Others, such as 'perforated' and 'done', are plain points.
STATES = {"stopped": ("v", False, "stopped"), "rebounded": ("<", False, "rebounded"),
          "unfinished": ("^", False, "unfinished: no answer"), "failed": ("x", True, "failed")}
PLAIN = ("o", True, "Spall")
NOTE = "bars: numerical error"
FORMULA_NOTE = "\nformulas: dashed outside of the tests\nthat they were fitted to, * throughout"


def label_of_key(record):
    name = record["key"].replace("/", " ").lower()
    return name + (f" ({record['unit']})" if record["unit"] else "")


def label_of_fit(words):
    return words.split(", scatter")[0].replace("+-", "±").replace(": ", ":\n", 1)


def formulas(axes, found, scale):
    """Draws a thin line for each formula, dashed where the shot is outside of the tests that it was fitted to."""
    colors = [color for color in CYCLE if color != OURS]
    for i, (name, line) in enumerate(found.items()):
        color = colors[i % len(colors)]
        inside = any(within for *_, within in line)
        axes.plot([x for x, *_ in line], [scale * value for _, value, _ in line], color=color, linewidth=0.9, linestyle="--",
                  alpha=0.7, label=name + ("" if inside else " *"), zorder=1)
        part = [scale * value if within else float("nan") for _, value, within in line]
        axes.plot([x for x, *_ in line], part, color=color, linewidth=1.1, alpha=0.8, zorder=1)


def computed(axes, points, scale):
    """Draws the runs with their numerical bands. Those without an answer stand at the foot of the chart."""
    for state in dict.fromkeys(point["state"] for point in points):
        marker, filled, words = STATES.get(state, PLAIN)
        mine = [point for point in points if point["state"] == state]
        heights = [0 if point["value"] is None else scale * point["value"] for point in mine]
        axes.plot([point["x"] for point in mine], heights, marker, color=OURS, markerfacecolor=OURS if filled else "white",
                  markersize=7, markeredgewidth=1.6, linestyle="", label=words if state not in STATES else f"Spall, {words}", zorder=4,
                  clip_on=False)
    error_bars(axes, [(point["x"], scale * point["value"], (scale * point["low"], scale * point["high"])) for point in points
                      if None not in (point["value"], point["low"], point["high"])], OURS)


def measured_points(axes, found, scale):
    for i, (x, value, scatter) in enumerate(found):
        axes.errorbar(x, scale * value, yerr=None if scatter is None else scale * scatter, fmt="D", color=EXPERIMENT, markersize=7,
                      capsize=4, label="measured" if i == 0 else None, zorder=5)


def chart(record, answer):
    """Returns the figure. record: the contents of curve.json"""
    found = record["answers"][answer]
    unit, scale, _ = unit_of(answer)
    drawn, axes = figure(10.5, 5.2)
    formulas(axes, found["formulas"], scale)
    for fit in found["fits"]:
        axes.plot([x for x, _ in fit["line"]], [scale * y for _, y in fit["line"]], FIT_STYLES[fit["name"]], color=OURS,
                  linewidth=1.6, label=label_of_fit(fit["words"]), zorder=3)
    computed(axes, found["points"], scale)
    measured_points(axes, found["measured"], scale)
    axes.set(xlabel=label_of_key(record), ylabel=answer.replace("_", " ") + (f" ({unit})" if unit else ""), title=record["study"])
    values = [scale * top for point in found["points"] for top in (point["value"], point["high"]) if top is not None]
    values += [scale * value for _, value, _ in found["measured"]]
    axes.set_ylim(0, 1.25 * max(values, default=1) or 1)
    shown = [x for x, *_ in found["measured"]] + [point["x"] for point in found["points"]]
    margin = 0.04 * (max(shown) - min(shown))
    axes.set_xlim(min(shown) - margin, max(shown) + margin)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8, title=NOTE + (FORMULA_NOTE if found["formulas"] else ""),
                title_fontsize=8, alignment="left")
    return drawn


def draw(record, answer, folder):
    return save(chart(record, answer), folder, re.sub(r"[^A-Za-z0-9]+", "_", f"curve_{answer}"), "curve")
