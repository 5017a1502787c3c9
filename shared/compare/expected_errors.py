"""The numerical error that a run states, beside the one that it has: of runs whose converged solution is known."""

from dataclasses import dataclass

from results import Slab, Taylor
from slab_runs import SYMMETRY, method, verification_row
from style import CYCLE, figure
from tables import Table, text

SMALLEST = 0.05  # percent; smaller errors are drawn there


@dataclass
class Compared:
    name: str
    method: str
    quantity: str
    expected: float  # percent
    actual: float    # percent, of the converged value


def of_slab(slab, references):
    """Returns the errors of the absorbed energy, or None."""
    row = verification_row(slab, references.verification)
    expected, into, out = slab.number("numerical_error_percent"), slab.number("impact_velocity"), slab.exit_velocity
    if row is None or None in (expected, into, out):
        return None
    converged = row["impact_m_s"]**2 - row["exit_m_s"]**2
    return Compared(slab.name, method(slab), "resistance", expected, 100 * abs((into**2 - out**2) / converged - 1))


def of_bar(bar, references):
    """Returns the errors of the shortening, or None."""
    row, expected, ratio = references.bar(bar), bar.number("numerical_error_percent"), bar.number("final_length_ratio")
    converged = (row or {}).get("final_length_ratio_converged")
    if None in (expected, ratio, converged):
        return None
    axis = bar.inputs.get(SYMMETRY) == "axis"
    return Compared(bar.name, f"bar, {bar.summary.get('scheme', '')}, {'axisymmetric' if axis else '3D'}", "shortening", expected,
                    100 * abs((1 - ratio) / (1 - converged) - 1))


def collect(results, references):
    found = [of_slab(one, references) if isinstance(one, Slab) else of_bar(one, references) for one in results
             if isinstance(one, (Slab, Taylor))]
    return [one for one in found if one]


def table(compared):
    within = sum(one.actual <= one.expected for one in compared)
    return Table("Numerical error: stated and found", ["result", "method", "of the", "stated (%)", "found (%)"],
                 [[one.name, one.method, one.quantity, text(one.expected, 2), text(one.actual, 2)] for one in compared],
                 f"Found: against converged finite elements. {within} of {len(compared)} are within what the run states.")


def draw(compared):
    drawn, axes = figure(7.5, 5.2)
    for i, name in enumerate(dict.fromkeys(one.method for one in compared)):
        mine = [one for one in compared if one.method == name]
        axes.plot([one.expected for one in mine], [max(one.actual, SMALLEST) for one in mine], "osD^vPX"[i % 7],
                  color=CYCLE[i % len(CYCLE)], markersize=6, label=name)
    reach = [min(one.expected for one in compared) / 2, 2 * max(max(one.expected, one.actual) for one in compared)]
    axes.plot(reach, reach, color="0.5", linewidth=1, label="found as stated")
    axes.fill_between(reach, reach, [max(reach)] * 2, color="0.5", alpha=0.12, linewidth=0, label="larger than stated")
    axes.set(xscale="log", yscale="log", xlim=reach, xlabel="numerical error that the run states (%)",
             ylabel="error against converged finite elements (%)", title="Numerical error: stated and found")
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=9)
    return drawn
