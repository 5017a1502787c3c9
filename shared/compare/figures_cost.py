"""The figure of processor time per point and step, of Spall and of other codes on the same bar."""

from style import CYCLE, OURS, figure


def cost_ns(result):
    """Returns the processor time in ns per point and step, summed over all cores, or None if the summary lacks it."""
    values = [result.number(key) for key in ("cpu_seconds", "points", "steps")]
    if None in values or not values[1] * values[2]:
        return None
    return 1e9 * values[0] / (values[1] * values[2])


def peers(bars, row, codes):
    """Draws the error of the final length against cost, for Spall's bars and for the codes that reported a length."""
    drawn, axes = figure(8.0, 4.8)
    exact = row["final_length_ratio_converged"]

    def error(ratio):
        return 100 * abs(ratio / exact - 1)

    ours = [(cost_ns(bar), error(bar.number("final_length_ratio")), bar) for bar in bars
            if cost_ns(bar) and bar.number("final_length_ratio")]
    known = [(code["cost_ns"], error(code["final_length_ratio"]), code) for code in codes
             if isinstance(code["final_length_ratio"], float)]
    for cost, miss, bar in ours:
        axes.loglog(cost, miss, "o", color=OURS, markersize=8)
        axes.annotate(f"Spall: {bar.name}, {bar.number('points'):,.0f} points", (cost, miss), fontsize=9,
                      xytext=(7, -3), textcoords="offset points")
    for cost, miss, code in known:
        axes.loglog(cost, miss, "s", color=CYCLE[1], markersize=7)
        axes.annotate(f"{code['code']}, {code['method']}", (cost, miss), fontsize=9, xytext=(7, -3),
                      textcoords="offset points")
    misses = [miss for _, miss, _ in [*ours, *known]]
    axes.set(xlabel="processor time per point and step (ns)", ylabel="error of the final length (%)",
             xlim=(100, 1e5), ylim=(0.4 * min(misses), 3 * max(misses)),
             title=f"{row['material']} bar: accuracy against cost beside other codes")
    return drawn


def without_length(codes):
    """Returns a text with the cost of the codes without a final length, and the reason why they have none."""
    return "; ".join(f"{code['code']}, {code['method']} ({code['cost_ns']:,.0f} ns): {code['remark']}"
                     for code in codes if not isinstance(code["final_length_ratio"], float))
