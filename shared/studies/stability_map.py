"""The stability map: for each row (such as a scheme) and each value on an axis it shows whether a run holds, and how it
fails if it does not."""

import itertools
import pathlib
import re
import sys

import sweep

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from style import figure, save  # noqa: E402

# The state of a run, from best to worst, and its colour.
STATES = {"holds": "#cfe8cf", "inexact": "#f7e3a1", "warned": "#f0a860", "failed": "#7a1f1f"}


def judge(study, summary, exact):
    """Returns the state of a run, the text of its cell, and the reason."""
    beyond = [f"{key} {summary[key]:.2g}" if isinstance(summary.get(key), (int, float)) else f"no number '{key}' in the summary"
              for key, limit in study.limits.items()
              if not isinstance(summary.get(key), (int, float)) or not abs(summary[key]) <= limit]
    errors = {}
    for name in study.answers:
        value = summary.get(name)
        if not isinstance(value, (int, float)):
            return "failed", "-", f"no number '{name}' in the summary"
        errors[name] = sweep.error(name, value, exact[name])
    worst = max(errors, key=lambda name: errors[name] / study.tolerances[name])
    text = f"{errors[worst]:.2g}"
    if beyond:
        return "warned", text, ", ".join(beyond)
    if errors[worst] > study.tolerances[worst]:
        return "inexact", text, f"{worst} off by {errors[worst]:.2g} %"
    return "holds", text, ""


def short_reason(message):
    """Returns the reason in a message of the program, without the words of the command."""
    return message.split("exit code", 1)[-1].split("; everything up to then", 1)[0].split(": ", 2)[-1].strip()


def run(study, runs):
    """Returns [{axis, keys, value, row, state, text, why}] in the order of the study. @raises RunFailed if a reference
    fails."""
    cells, changes = [], []  # cells of the picture, and the overrides of each
    for title, places in study.axes.items():
        for row, at in itertools.product(study.rows, places):
            cells.append({"axis": title, "keys": ", ".join(at), "value": next(iter(at.values())), "row": row})
            changes.append(at)
    physical = [tuple((key, value) for key, value in at.items() if key in study.physical) for at in changes]
    physics = sorted(set(physical))
    print(f"study: {study.name}, {len(cells)} runs and {len(physics)} references", flush=True)
    references = runs.compute([study.reference | dict(case) for case in physics], study.answers)
    exact = {case: sweep.checked(found, study.answers) for case, found in zip(physics, references)}
    ended = [None] * len(cells)

    def report(i, found, progress):
        if "failure" in found:
            state, text, why = "failed", "x", short_reason(found["failure"])
        else:
            state, text, why = judge(study, found, exact[physical[i]])
        ended[i] = cells[i] | {"state": state, "text": text, "why": why}
        sweep.write_csv([cell for cell in ended if cell], runs.output / "stability.csv")
        if state != "holds":
            print(f"  {progress}: {cells[i]['row']}, {cells[i]['keys']}={cells[i]['value']}: {state}: {why}", flush=True)

    wanted = list(dict.fromkeys([*study.answers, *study.limits]))
    runs.compute([study.rows[cell["row"]] | at for cell, at in zip(cells, changes)], wanted, report)
    return ended


def draw(study, cells, folder):
    """Draws one panel per axis, in which rows are schemes and columns are values. The number is the largest error in percent."""
    titles = list(dict.fromkeys(cell["axis"] for cell in cells))
    names = list(study.rows)
    columns = 2 if len(titles) > 1 else 1
    lines = -(-len(titles) // columns)
    height = lines * (0.9 + 0.27 * len(names)) + 1.0
    drawn, axes = figure(7.0 * columns, height, lines, columns, squeeze=False)
    drawn.get_layout_engine().set(rect=(0, 0.6 / height, 1, 1 - 0.6 / height))  # leaves room for the legend below
    for panel in axes.flat[len(titles):]:
        panel.set_visible(False)
    for panel, title in zip(axes.flat, titles):
        mine = [cell for cell in cells if cell["axis"] == title]
        values = list(dict.fromkeys(cell["value"] for cell in mine))
        for cell in mine:
            x, y = values.index(cell["value"]), names.index(cell["row"])
            panel.fill([x, x + 1, x + 1, x], [y, y, y + 1, y + 1], color=STATES[cell["state"]], linewidth=0)
            panel.text(x + 0.5, y + 0.5, cell["text"], ha="center", va="center", fontsize=8,
                       color="white" if cell["state"] == "failed" else "black")
        panel.set(xlim=(0, len(values)), ylim=(len(names), 0), title=title, xlabel=mine[0]["keys"])
        panel.set_xticks([i + 0.5 for i in range(len(values))], values, fontsize=8)
        panel.set_yticks([i + 0.5 for i in range(len(names))], names, fontsize=8)
        panel.grid(False)
    answers = ", ".join(f"{name} {bound:g} %" for name, bound in study.tolerances.items())
    limits = ", ".join(f"{key} {limit:g}" for key, limit in study.limits.items())
    handles = [axes.flat[0].fill([0], [0], color=colour)[0] for colour in STATES.values()]
    drawn.legend(handles, [f"holds: within {answers}", "inexact: beyond that",
                           f"warned: beyond {limits}" if limits else "warned", "failed (stability.csv gives the reason)"],
                 loc="lower center", ncols=2, fontsize=9)
    drawn.suptitle(f"Where each scheme holds and how it fails: {study.name} (numbers: largest error, %)")
    return save(drawn, folder, re.sub(r"[^A-Za-z0-9]+", "_", f"map_{study.name}"), "stability map")
