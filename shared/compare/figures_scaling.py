"""Figures of runs on many ranks, and of the model that is fitted to them."""

import numpy as np

import scaling_model
from style import CYCLE, figure

RANKS = "ranks"


def seconds(axes, runs, series):
    """Draws the time of a step on one rank and two: wall time, and processor time of the busiest rank outside MPI."""
    found = [(ranks, scaling_model.best(runs, series, ranks)) for ranks in (1, 2)]
    found = [(ranks, s) for ranks, s in found if s]
    for label, key, color, marker in (("wall", "wall_seconds", CYCLE[0], "o"),
                                      ("busiest processor", "compute_seconds_max", CYCLE[1], "s")):
        axes.plot([ranks for ranks, _ in found], [1e3 * s[key] / s["steps"] for _, s in found], color=color, marker=marker,
                  label=label)
    if found:
        first = 1e3 * found[0][1]["compute_seconds_max"] / found[0][1]["steps"]
        axes.plot([1, 2], [first, first / (2 if series == "strong" else 1)], "--", color="0.5", linewidth=1, label="ideal")
    axes.set(xticks=[1, 2], xlabel=RANKS, ylabel="time of a step (ms)", ylim=(0, None))
    axes.legend()


def over_ranks(axes, summaries, lines, ylabel):
    for (label, of), color, marker in zip(lines, CYCLE, "os^v"):
        axes.plot([s["ranks"] for s in summaries], [of(s) for s in summaries], color=color, marker=marker, label=label)
    axes.set(xscale="log", xlabel=RANKS, ylabel=ylabel, ylim=(0, 1.35 * axes.get_ylim()[1]))  # room for the legend
    ticks = sorted({s["ranks"] for s in summaries})
    axes.set_xticks(ticks, [str(tick) for tick in ticks])
    axes.minorticks_off()
    axes.legend()


def ghosts(axes, summaries):
    """Draws ghost points per owned point against (points per rank)^(-1/3)."""
    several = [s for s in summaries if s["ranks"] > 1]
    x = np.array([scaling_model.points_per_rank(s) ** (-1 / 3) for s in several])
    y = np.array([s["ghost_points_max"] / scaling_model.points_per_rank(s) for s in several])
    axes.plot(x, y, "o", color=CYCLE[0])
    for s, a, b in zip(several, x, y):
        axes.annotate(f"{s['ranks']}", (a, b), xytext=(4, -10), textcoords="offset points", fontsize=8)
    axes.set(xlabel="(points per rank)^(-1/3)", ylabel="ghosts per owned point, largest", ylim=(0, None),
             xlim=(0, 1.1 * x.max() if len(x) else 1))


def communication(runs, series):
    """Draws four panels: the time on one rank and two, and bytes, messages and ghosts on many."""
    drawn, axes = figure(10.5, 7.0, 2, 2)
    summaries = scaling_model.counted(runs, series)
    seconds(axes[0, 0], runs, series)
    over_ranks(axes[0, 1], summaries,
               [("velocities sent", lambda s: 1e-3 * s["bytes_per_step_velocities"]),
                ("forces returned", lambda s: 1e-3 * s["bytes_per_step_forces"]),
                ("mean of the ranks, both", lambda s: 1e-3 * s["bytes_per_step_mean"])],
               "kB sent per rank and step")
    over_ranks(axes[1, 0], summaries,
               [("largest of any rank", lambda s: s["messages_per_step_max"]),
                ("mean of the ranks", lambda s: s["messages_per_step_mean"]),
                ("reductions", lambda s: s["collectives_per_step_reductions"])], "messages per rank and step")
    ghosts(axes[1, 1], summaries)
    drawn.suptitle({"strong": "Strong scaling: the same points on more ranks",
                    "weak": "Weak scaling: as many points more as ranks"}[series])
    return drawn


def model(c, assumptions):
    """Draws the time of a step by parts, and the share of it that is spent on computing."""
    drawn, (left, right) = figure(10.5, 4.4, 1, 2)
    ranks = np.array(assumptions["ranks"], dtype=float)
    parts = [scaling_model.step(c, assumptions, p) for p in ranks]
    for part, color in zip(scaling_model.PARTS, CYCLE):
        left.plot(ranks, [1e3 * p[part] for p in parts], color=color, marker="o", markersize=4, label=part)
    left.plot(ranks, [1e3 * sum(p.values()) for p in parts], color="black", linewidth=2.4, label="step")
    left.set(xscale="log", yscale="log", xlabel=RANKS, ylabel="time (ms)",
             title=f"Model: {assumptions['points']:.2g} points")
    left.set_ylim(top=8 * left.get_ylim()[1])  # room for the legend
    left.legend(fontsize=9, ncols=2, loc="upper right")
    right.plot(ranks, [100 * scaling_model.efficiency(p) for p in parts], color=CYCLE[0], marker="o")
    right.set(xscale="log", xlabel=RANKS, ylabel="computing, share of the step (%)", ylim=(0, 100), title="Parallel efficiency")
    return drawn
