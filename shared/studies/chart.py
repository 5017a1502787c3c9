"""The accuracy-cost chart: error of an answer against what it cost."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from style import CYCLE, figure, save  # noqa: E402

FLOOR = 1e-4  # percent; smaller errors are drawn here, they are no longer of interest
MARKERS = "osD^vPX"


def front(rows, error, cost):
    """Runs that no other beats in both cost and error."""
    best, kept = float("inf"), []
    for row in sorted(rows, key=lambda r: (r[cost], r[error])):
        if row[error] < best:
            best = row[error]
            kept.append(row)
    return kept


def unit(cost):
    return "s" if "second" in cost else "bytes" if "byte" in cost else ""


def draw(study, rows, answer, cost, folder):
    error, price = f"error {answer}", f"cost {cost}"

    def height(row):
        return max(row[error], FLOOR)

    drawn, axes = figure(8.0, 5.0)
    for i, series in enumerate(dict.fromkeys(row["series"] for row in rows)):
        mine = [row for row in rows if row["series"] == series]
        axes.loglog([row[price] for row in mine], [height(row) for row in mine], MARKERS[i % len(MARKERS)],
                    markersize=5, color=CYCLE[i % len(CYCLE)], label=series)
    best = front(rows, error, price)
    axes.loglog([row[price] for row in best], [height(row) for row in best], color="0.6", linewidth=1, zorder=0,
                label="not beaten by any")
    for row in rows:
        if row["default"]:
            axes.loglog(row[price], height(row), "*", markersize=16, color=CYCLE[1], label="default", zorder=3)
    axes.set(xlabel=f"{cost.replace('_', ' ')} ({unit(cost)})",
             ylabel=f"error of {answer} ({'% of 1' if 'damage' in answer else '%'})",
             title=f"Accuracy against cost: {study.name}, {answer}")
    labels = dict(zip(*reversed(axes.get_legend_handles_labels())))
    axes.legend(labels.values(), labels.keys(), loc="best", fontsize=9)
    name = f"chart_{answer}" + (f"_{cost}" if cost != study.costs[0] else "")
    return save(drawn, folder, re.sub(r"[^A-Za-z0-9]+", "_", name), error)
