"""Figures of samples of uncertain inputs: distribution of an answer, contributions of the inputs, convergence."""

import numpy as np

from style import CYCLE, EXPERIMENT, OURS, figure

# Keys of the summary have SI numbers without their unit: word of the key -> unit in figures, factor to it, digits.
UNITS = {"velocity": ("m/s", 1.0, 1), "percent": ("points", 1.0, 2), "energy": ("J", 1.0, 1), "stress": ("MPa", 1e-6, 3),
         "diameter": ("mm", 1e3, 2), "depth": ("mm", 1e3, 1), "time": ("ms", 1e3, 3), "momentum": ("N s", 1.0, 2)}
PALE = "#a9c4e4"


def unit_of(answer):
    """Returns the unit of an answer, the factor from SI to it, and the digits worth showing."""
    return next((found for word, found in UNITS.items() if word in answer), ("", 1.0, 4))


def axis_label(answer):
    unit = unit_of(answer)[0]
    return answer.replace("_", " ") + (f" ({unit})" if unit else "")


def shares_below(values):
    """Returns the corners of the steps of the empirical distribution: sorted numbers and the share of values up to each."""
    ordered = np.sort(values)
    return np.concatenate([[ordered[0]], ordered]), np.arange(len(ordered) + 1) / len(ordered)


def marks(axes, result, scale, measured):
    """Draws the input as it is, and the measured value in its unit, as vertical lines."""
    if result["as_it_is"] is not None:
        axes.axvline(scale * result["as_it_is"], color=CYCLE[1], linestyle="--", linewidth=1.4, label="inputs as they are")
    if measured is not None:
        axes.axvline(measured, color=EXPERIMENT, linewidth=1.8, label="experiment")


def quantile(axes, end, scale):
    """Draws a quantile at its level, with the range that the number of samples leaves open."""
    here = scale * end["value"]
    low, high = (here if end[side] is None else scale * end[side] for side in ("low", "high"))
    axes.errorbar(here, end["level"], xerr=[[here - low], [high - here]], color=OURS, capsize=4, linewidth=1.3,
                  fmt="<" if end["low"] is None else ">" if end["high"] is None else "o", markersize=6)


def distribution(answer, result, measured=None):
    """Draws histogram and empirical distribution with the band. result: an entry of `answers` in uncertainty.json (SI); measured:
    in the unit of the figure."""
    scale = unit_of(answer)[1]
    values = scale * np.array(result["values"])
    ends = [scale * end["value"] for end in result["band"]]
    drawn, (left, right) = figure(11.0, 4.4, 1, 2)
    bars = int(np.clip(np.ceil(2 * len(values) ** (1 / 3)), 4, 30))
    left.hist(values, bins=bars, color=PALE, edgecolor="white", linewidth=0.6)
    left.axvspan(ends[0], ends[2], color=OURS, alpha=0.12, linewidth=0, label="5 to 95 %")
    left.axvline(ends[1], color=OURS, label="median")
    marks(left, result, scale, measured)
    left.set(xlabel=axis_label(answer), ylabel="samples", title=f"{result['count']} samples")
    left.legend(fontsize=9)
    right.step(*shares_below(values), where="post", color=OURS, label="scatter of the inputs")
    low, high = result["numerical"]
    if None not in low and None not in high:
        (x, y), (upper, _) = (shares_below(scale * np.array(end)) for end in (low, high))
        right.fill_betweenx(y, x, upper, color=CYCLE[2], alpha=0.18, linewidth=0, step="pre", label="numerical error of the runs")
    for end in result["band"]:
        quantile(right, end, scale)
    right.plot([], [], "o-", color=OURS, markersize=5, linewidth=1.3,
               label="quantile, 90 % confidence\n(triangle: open at that side)")
    marks(right, result, scale, measured)
    right.set(xlabel=axis_label(answer), ylabel="share of samples below", ylim=(0, 1), title="5, 50 and 95 % quantiles")
    right.legend(fontsize=9, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return drawn


def contributions(answer, result, unranked=()):
    """Draws the share of variance and the rank correlation of each input, the largest share on top. unranked: names of the inputs
    without order, whose share is in the rest."""
    found = result["contributions"]
    order = sorted(found["shares"], key=lambda name: found["shares"][name])
    rest = 1 - found["r2"]
    drawn, (left, right) = figure(10.5, 1.8 + 0.36 * (len(order) + 1), 1, 2, sharey=True)
    for y, name in enumerate(order, 1):
        left.barh(y, 100 * found["shares"][name], height=0.65, color=OURS)
        if found["errors"][name] is not None:
            left.errorbar(100 * found["shares"][name], y, xerr=100 * found["errors"][name], color=CYCLE[1], capsize=3,
                          linewidth=1.3)
        if found["spearman"][name] is None:
            right.text(0.03, y, "no order", ha="left", va="center", fontsize=8, color="0.4")
        else:
            right.barh(y, found["spearman"][name], height=0.65, color=OURS)
    left.barh(0, 100 * rest, height=0.65, color="0.7")
    left.axvline(0, color="black", linewidth=1)
    right.axvline(0, color="black", linewidth=1)
    right.axvspan(-result["noise"], result["noise"], color="0.85", linewidth=0, zorder=0)
    left.set_yticks(range(len(order) + 1), [", ".join(["rest", *unranked]), *order])
    left.set(xlabel="share of the variance of the ranks (%)", title=f"{answer.replace('_', ' ')}: R² = {found['r2']:.2f}")
    right.set(xlim=(-1, 1), xlabel="Spearman rank correlation")
    right.set_title("grey: as large without an effect", fontsize=10)
    for axes in (left, right):
        axes.grid(axis="y", visible=False)
    return drawn


def convergence(answer, result, measured=None):
    """Draws the band of the first samples against their number."""
    scale = unit_of(answer)[1]
    drawn, axes = figure(7.5, 4.2)
    counts = [step["samples"] for step in result["growth"]]
    for k, color in enumerate((CYCLE[3], OURS, CYCLE[2])):
        ends = [step["band"][k] for step in result["growth"]]
        axes.plot(counts, [scale * end["value"] for end in ends], "o-", markersize=3, color=color,
                  label=f"{100 * ends[0]['level']:.0f} %")
        bounded = [(n, scale * end["low"], scale * end["high"]) for n, end in zip(counts, ends)
                   if None not in (end["low"], end["high"])]
        if bounded:
            axes.fill_between(*zip(*bounded), color=color, alpha=0.15, linewidth=0)
    if measured is not None:
        axes.axhline(measured, color=EXPERIMENT, linewidth=1.8, label="experiment")
    axes.set(xscale="log", xlabel="samples", ylabel=axis_label(answer), title="Band against the number of samples")
    ticks = [n for n in (10, 25, 50, 100, 200, 400, 1000, 3000, 10000, 30000, 100000) if counts[0] <= n <= counts[-1]]
    axes.set_xticks(ticks, [str(n) for n in ticks])
    axes.minorticks_off()
    axes.legend(fontsize=9, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return drawn
