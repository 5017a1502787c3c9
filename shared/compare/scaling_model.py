"""A model of the time of a step on many ranks, whose coefficients come from runs on few ranks.

The time of a step is that of the busiest rank,

  t(P) = compute + imbalance + copies + surface + latency + gathering
  compute    a n / P                   a: processor time per point and step outside MPI, on one rank
  imbalance  (i - 1) a n / P           i: busiest rank over the mean one, in processor time outside MPI
  copies     b k(n / P)                b: processor time that the copy of another rank's point costs in a step
  surface    48 k(n / P) / bandwidth   bytes sent in a step: three numbers out, three back
  latency    (m + r log2 P) latency    m: messages of a rank and step; r: calls in which all ranks take part
  gathering  g P / bandwidth           g: bytes that each rank gives to all others, per step (refreshes)

for n points on P ranks. The e^3 points of a rank are taken for a cube that is surrounded by the points of other ranks, w
points deep: a rank keeps k = (e + 2 w)^3 - e^3 copies and sends as many, about 6 w (n / P)^(2/3) for large parts. Computing
and sending do not overlap, and every message waits for the one before it. Latency and bandwidth (of one rank while all
others send as well) are assumptions; all other coefficients are counted or timed."""

import math
from dataclasses import dataclass

import numpy as np

PARTS = ("compute", "imbalance", "copies", "surface", "latency", "gathering")
# With fewer ranks (3 x 3 x 3) no rank has neighbours on all sides, so their surfaces differ from those of many ranks.
FEWEST_FOR_SURFACE = 27
# With fewer ranks a rank has too few neighbours to be typical of many ranks.
FEWEST_FOR_IMBALANCE = 8
BYTES_PER_COPY = 48


@dataclass
class Coefficients:
    point_seconds: float  # a, s
    imbalance: float      # i
    copy_seconds: float   # b, s
    depth: float          # w
    surface_error: float  # largest relative residual of the bytes
    messages: float       # m
    reductions: float     # r
    gathered: float       # g, bytes


def points_per_rank(summary):
    return summary["points"] / summary["ranks"]


def copies(share, depth):
    """Returns the number of copies of other ranks' points around a part with `share` points."""
    return (share ** (1 / 3) + 2 * depth) ** 3 - share


def fit_surface(summaries):
    """Returns the mean depth w that follows from the bytes sent by each run, and the largest relative residual of the bytes."""
    share = np.array([points_per_rank(s) for s in summaries])
    sent = np.array([s["bytes_per_step_max"] for s in summaries]) / BYTES_PER_COPY
    depth = float((0.5 * ((sent + share) ** (1 / 3) - share ** (1 / 3))).mean())
    return depth, float(np.abs(copies(share, depth) / sent - 1).max())


def best(runs, series, ranks):
    """Returns the fastest repeat of the timed run of a series on so many ranks, or None."""
    found = [run["summary"] for run in runs if run["timed"] and run["series"] == series and run["ranks"] == ranks]
    return min(found, key=lambda s: s["compute_seconds_max"] / (s["points"] * s["steps"]), default=None)


def counted(runs, series=None):
    found = [run["summary"] for run in runs if not run["timed"] and series in (None, run["series"])]
    return sorted(found, key=lambda s: s["ranks"])


def coefficients(runs):
    """Fits the coefficients. @raises ValueError with the reason if the runs do not determine them."""
    one, two = best(runs, "strong", 1), best(runs, "strong", 2)
    many = [s for s in counted(runs) if s["ranks"] >= FEWEST_FOR_SURFACE]
    if one is None or two is None or not many:
        raise ValueError(
            f"a model needs timed strong runs on one rank and two and counted ones on {FEWEST_FOR_SURFACE} or more")
    depth, error = fit_surface(many)
    most = max(many, key=lambda s: (s["ranks"], s["points"]))
    fullest = max((s for s in counted(runs) if s["ranks"] >= FEWEST_FOR_IMBALANCE), key=points_per_rank)
    point_seconds = one["compute_seconds_max"] / (one["points"] * one["steps"])
    extra = two["compute_seconds_max"] / two["steps"] - point_seconds * two["owned_points_max"]
    return Coefficients(
        point_seconds=point_seconds,
        imbalance=fullest["compute_seconds_max"] / fullest["compute_seconds_mean"],
        copy_seconds=max(0, extra / two["ghost_points_max"]),
        depth=depth, surface_error=error,
        messages=max(s["messages_per_step_max"] + s["messages_per_step_refreshes"] for s in many),
        reductions=most["collectives_per_step_reductions"] + most["collectives_per_step_refreshes"],
        gathered=most["gathered_bytes_per_step_refreshes"])


def step(c, assumptions, ranks):
    """Returns the seconds of each part of a step on so many ranks."""
    share = assumptions["points"] / ranks
    compute = c.point_seconds * share
    return {"compute": compute, "imbalance": (c.imbalance - 1) * compute,
            "copies": c.copy_seconds * copies(share, c.depth),
            "surface": BYTES_PER_COPY * copies(share, c.depth) / assumptions["bandwidth"],
            "latency": (c.messages + c.reductions * math.log2(ranks)) * assumptions["latency"],
            "gathering": c.gathered * ranks / assumptions["bandwidth"]}


def efficiency(parts):
    """Returns the share of the step that is spent on computing."""
    return parts["compute"] / sum(parts.values())


def speed_up(runs, series):
    """Returns the speed-up of two ranks against one, by wall time and by processor time of the busiest rank. Weak runs have
    twice the points on two ranks. Returns None unless there are runs on one rank and on two."""
    one, two = best(runs, series, 1), best(runs, series, 2)
    if one is None or two is None:
        return None

    def rate(s, seconds):
        return s["points"] * s["steps"] / s[seconds]
    return {"wall": rate(two, "wall_seconds") / rate(one, "wall_seconds"),
            "processor": rate(two, "compute_seconds_max") / rate(one, "compute_seconds_max")}
