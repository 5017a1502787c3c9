"""The accuracy-cost chart: error of an answer against the time it took."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from style import CYCLE, figure, save  # noqa: E402

FLOOR = 1e-4  # percent; smaller errors are drawn here, they are no longer of interest


def front(rows, key):
    """Runs that no other beats in both cost and error."""
    best, kept = float("inf"), []
    for row in sorted(rows, key=lambda r: (r["cost"], r[key])):
        if row[key] < best:
            best = row[key]
            kept.append(row)
    return kept


def draw(study, rows, answer, folder):
    key = f"error {answer}"
    drawn, axes = figure(8.0, 5.0)
    for i, series in enumerate(dict.fromkeys(row["series"] for row in rows)):
        mine = [row for row in rows if row["series"] == series]
        axes.loglog([row["cost"] for row in mine], [max(row[key], FLOOR) for row in mine], "o", markersize=5,
                    color=CYCLE[i % len(CYCLE)], label=series)
    best = front(rows, key)
    axes.loglog([row["cost"] for row in best], [max(row[key], FLOOR) for row in best], color="0.6", linewidth=1,
                zorder=0, label="not beaten by any")
    for row in rows:
        if row["default"]:
            axes.loglog(row["cost"], max(row[key], FLOOR), "*", markersize=16, color=CYCLE[1], label="default",
                        zorder=3)
    unit = "% of 1" if "damage" in answer else "%"
    axes.set(xlabel=f"{study.cost.replace('_', ' ')} (s)", ylabel=f"error of {answer} ({unit})",
             title=f"Accuracy against cost: {study.name}, {answer}")
    labels = dict(zip(*reversed(axes.get_legend_handles_labels())))
    axes.legend(labels.values(), labels.keys(), loc="best", fontsize=9)
    return save(drawn, folder, "chart_" + re.sub(r"[^A-Za-z0-9]+", "_", answer), key)
