"""What a step costs on many ranks: a model whose coefficients come from runs on few.

The time of a step is that of the busiest rank,

  t(P) = compute + imbalance + surface + latency + gathering
  compute    a n / P                      a: processor time per point and step outside MPI, on one rank
  imbalance  (i - 1) a n / P              i: busiest rank over the mean one, in processor time outside MPI
  surface    c (n / P)^(2/3) / bandwidth  c: bytes that the rank with most of them sends in a step
  latency    (m + r log2 P) latency       m: messages of a rank and step; r: calls in which all ranks take part
  gathering  g P / bandwidth              g: bytes that each rank gives to all others, per step (refreshes)

for n points on P ranks: nothing overlaps, every message waits for the one before it. Latency and bandwidth (of one rank
while all others send as well) are assumptions; all else is counted or timed."""

import math
from dataclasses import dataclass

import numpy as np

PARTS = ("compute", "imbalance", "surface", "latency", "gathering")
# Fewer ranks than these have none with neighbours on all sides: their surfaces say little of those of many.
FEWEST_FOR_SURFACE = 8


@dataclass
class Coefficients:
    point_seconds: float  # a, s
    imbalance: float      # i
    surface: float        # c, bytes
    surface_error: float  # largest relative residual of the fit
    messages: float       # m
    reductions: float     # r
    gathered: float       # g, bytes


def points_per_rank(summary):
    return summary["points"] / summary["ranks"]


def fit_surface(summaries):
    """c of bytes = c (n / P)^(2/3) by least squares, and the largest relative residual."""
    x = np.array([points_per_rank(s) ** (2 / 3) for s in summaries])
    y = np.array([s["bytes_per_step_max"] for s in summaries])
    c = float(x @ y / (x @ x))
    return c, float(np.abs(c * x / y - 1).max())


def best(runs, series, ranks):
    """The timed run of a series on so many ranks, the fastest of its repeats; None if there is none."""
    found = [run["summary"] for run in runs if run["timed"] and run["series"] == series and run["ranks"] == ranks]
    return min(found, key=lambda s: s["compute_seconds_max"] / (s["points"] * s["steps"]), default=None)


def counted(runs, series=None):
    found = [run["summary"] for run in runs if not run["timed"] and series in (None, run["series"])]
    return sorted(found, key=lambda s: s["ranks"])


def coefficients(runs):
    """@raises ValueError in words if the runs do not determine them."""
    one = best(runs, "strong", 1)
    many = [s for s in counted(runs) if s["ranks"] >= FEWEST_FOR_SURFACE]
    if one is None or not many:
        raise ValueError(f"a model needs a timed strong run on one rank and counted ones on {FEWEST_FOR_SURFACE} or more")
    c, error = fit_surface(many)
    most = max(many, key=lambda s: (s["ranks"], s["points"]))
    return Coefficients(
        point_seconds=one["compute_seconds_max"] / (one["points"] * one["steps"]),
        imbalance=max(s["compute_seconds_max"] / s["compute_seconds_mean"] for s in many),
        surface=c, surface_error=error,
        messages=max(s["messages_per_step_max"] + s["messages_per_step_refreshes"] for s in many),
        reductions=most["collectives_per_step_reductions"] + most["collectives_per_step_refreshes"],
        gathered=most["collective_bytes_per_step_refreshes"])


def step(c, assumptions, ranks):
    """Seconds of each part of a step on so many ranks."""
    share = assumptions["points"] / ranks
    compute = c.point_seconds * share
    return {"compute": compute, "imbalance": (c.imbalance - 1) * compute,
            "surface": c.surface * share ** (2 / 3) / assumptions["bandwidth"],
            "latency": (c.messages + c.reductions * math.log2(ranks)) * assumptions["latency"],
            "gathering": c.gathered * ranks / assumptions["bandwidth"]}


def efficiency(parts):
    """Of the ranks, against one rank that has no others to wait for."""
    return parts["compute"] / sum(parts.values())


def speed_up(runs, series):
    """Two ranks against one: of the wall time, and of what the processors alone would allow (busiest rank); weak runs
    have twice the points on two. None without both."""
    one, two = best(runs, series, 1), best(runs, series, 2)
    if one is None or two is None:
        return None

    def rate(s, seconds):
        return s["points"] * s["steps"] / s[seconds]
    return {"wall": rate(two, "wall_seconds") / rate(one, "wall_seconds"),
            "processor": rate(two, "compute_seconds_max") / rate(one, "compute_seconds_max")}
