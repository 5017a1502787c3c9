"""The accuracy-cost chart: error of an answer against the cost of its run."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from style import CYCLE, figure, save  # noqa: E402

FLOOR = 1e-4  # percent; smaller errors do not matter and are drawn at this height
MARKERS = "osD^vPXd<>p"
ALL = "all answers"  # the largest error of all answers


def add_lasting_errors(rows, answers):
    """Adds `error all answers`, and `lasting X` for each answer X: the largest error of a run and of all dearer runs of its
    family, which differ from it in refinement only. An answer that is accurate by chance has a large lasting error."""
    costs = [key for key in rows[0] if key.startswith("cost ")] if rows else []
    for row in rows:
        row[f"error {ALL}"] = max(row[f"error {answer}"] for answer in answers)
    for row in rows:
        finer = [other for other in rows if other["family"] == row["family"] and other[costs[0]] >= row[costs[0]]]
        for answer in [*answers, ALL]:
            row[f"lasting {answer}"] = max(other[f"error {answer}"] for other in finer)


def front(rows, error, cost):
    """Returns the runs for which no other run has both a lower cost and a smaller error."""
    best, kept = float("inf"), []
    for row in sorted(rows, key=lambda r: (r[cost], r[error])):
        if row[error] < best:
            best = row[error]
            kept.append(row)
    return kept


def unit(cost):
    return "s" if "second" in cost else "bytes" if "byte" in cost else ""


def draw(study, rows, answer, cost, folder):
    error, lasting, price = f"error {answer}", f"lasting {answer}", f"cost {cost}"

    def height(row, key=error):
        return max(row[key], FLOOR)

    drawn, axes = figure(9.5, 5.0)
    axes.set(xscale="log", yscale="log")
    for i, series in enumerate(dict.fromkeys(row["series"] for row in rows)):
        mine = [row for row in rows if row["series"] == series]
        color = CYCLE[i % len(CYCLE)]
        axes.plot([row[price] for row in mine], [height(row) for row in mine], MARKERS[i % len(MARKERS)],
                  markersize=5, color=color, label=series)
        for row in mine:
            if height(row, lasting) > height(row):
                axes.plot([row[price]] * 2, [height(row), height(row, lasting)], color=color, linewidth=0.8, alpha=0.6)
    best = front(rows, lasting, price)
    axes.plot([row[price] for row in best], [height(row, lasting) for row in best], color="0.6", linewidth=1, zorder=0,
              label="best for their cost")
    for row in rows:
        if row["default"]:
            axes.plot(row[price], height(row), "*", markersize=16, color=CYCLE[1], label="default", zorder=3)
    axes.set(xlabel=f"{cost.replace('_', ' ')} ({unit(cost)})",
             ylabel=f"error of {answer} ({'% of 1' if 'damage' in answer else '%'})",
             title=f"Accuracy against cost: {study.name}, {answer}")
    if any(height(row, lasting) > height(row) for row in rows):
        axes.plot([], [], color="0.3", linewidth=0.8, label="largest error under refinement")
    labels = dict(zip(*reversed(axes.get_legend_handles_labels())))
    axes.legend(labels.values(), labels.keys(), loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9)
    name = f"chart_{answer}" + (f"_{cost}" if cost != study.costs[0] else "")
    return save(drawn, folder, re.sub(r"[^A-Za-z0-9]+", "_", name), error)
