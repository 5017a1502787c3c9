"""The tornado chart: the change of an answer when each constant alone takes its other values."""

import pathlib
import re
import sys

import sweep

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from style import CYCLE, figure, save  # noqa: E402

BASE = "as it is"
# Summaries have SI numbers without their unit.
UNITS = {"velocity": "m/s", "percent": "points", "energy": "J", "diameter": "m", "time": "s"}


def label(overrides):
    return ", ".join(f"{key.split('/')[-1]} = {value}" for key, value in overrides.items())


def run(study, runs):
    """Returns one row per run with constant, side (0, 1), label and answers. The first row is the input as it is.

    A run that fails leaves its answers empty. @raises RunFailed if the first one fails."""
    print(f"study: {study.name}, {len(study.constants)} constants", flush=True)
    rows = [{"constant": BASE, "side": 0, "label": ""}]
    cases = [{}]
    for constant, sides in study.constants.items():
        for side, overrides in enumerate(sides):
            rows.append({"constant": constant, "side": side, "label": label(overrides)})
            cases.append(overrides)

    def report(i, found, progress):
        try:
            found = sweep.checked(found, study.answers)
        except sweep.RunFailed as failed:
            print(f"  {progress}: failed: {failed}", flush=True)
            found = {}
        rows[i] |= {name: found.get(name) for name in study.answers}
        sweep.write_csv([row for row in rows if study.answers[0] in row], runs.output / "tornado.csv")
        words = ", ".join(f"{name} {found[name]:.6g}" for name in found)
        print(f"  {progress}: {rows[i]['constant']}: {rows[i]['label']}: {words}", flush=True)

    sweep.checked(runs.compute(cases, study.answers, report)[0], study.answers)
    return rows


def changes(rows, answer):
    """Returns [(constant, [(change, label), ...])] with the largest change last. Constants whose runs all failed are left out."""
    base = rows[0][answer]
    found = {}
    for row in rows[1:]:
        if row[answer] is not None:
            found.setdefault(row["constant"], []).append((row[answer] - base, row["label"]))
    return sorted(found.items(), key=lambda item: max(abs(change) for change, _ in item[1]))


def draw(study, rows, answer, folder):
    bars = changes(rows, answer)
    drawn, axes = figure(10.5, 1.6 + 0.55 * len(bars))
    reach = max((abs(change) for _, sides in bars for change, _ in sides), default=0) or 1
    for y, (_, sides) in enumerate(bars):
        # Two changes of the same sign would cover each other, so each gets half of the bar's height.
        same = len(sides) == 2 and sides[0][0] * sides[1][0] >= 0
        for side, (change, text) in enumerate(sides):
            offset = (0.2 if side else -0.2) if same else 0
            axes.barh(y + offset, change, height=0.36 if same else 0.7, color=CYCLE[side])
            left = change < 0
            axes.annotate(f"{change:+.3g}  ({text})" if not left else f"({text})  {change:+.3g}", (change, y + offset),
                          (-4 if left else 4, 0), textcoords="offset points", ha="right" if left else "left",
                          va="center", fontsize=8)
    axes.axvline(0, color="black", linewidth=1)
    axes.set_yticks(range(len(bars)), [constant for constant, _ in bars])
    unit = next((unit for word, unit in UNITS.items() if word in answer), "")
    axes.set(xlim=(-1.9 * reach, 1.9 * reach), xlabel=f"change of {answer.replace('_', ' ')}" + (f" ({unit})" if unit else ""),
             title=f"{study.name}: {answer.replace('_', ' ')} {rows[0][answer]:.4g} {unit} as it is")
    axes.grid(axis="y", visible=False)
    return save(drawn, folder, re.sub(r"[^A-Za-z0-9]+", "_", f"tornado_{answer}"), "tornado chart")
