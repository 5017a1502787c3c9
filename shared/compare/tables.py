"""Tables of the report. Computed, measured and published values have columns of their own."""

import csv
import io
import re
from dataclasses import dataclass

import numpy as np

OURS, EXPERIMENT, NMAP, CONVERGED = "Spall", "experiment", "NMAP (paper)", "converged reference"
CLASSES = {OURS: "ours", EXPERIMENT: "experiment", NMAP: "nmap", CONVERGED: "converged"}
# Columns of words, and of cells that are not broken into lines.
WORDS = ("why", "what", "quantity", "test", "shot", "method", "why ours differs", "formulas: smallest to largest")
WHOLE = ("when", "wall time", "program")


# A cell with the range that the numerical error leaves open (see banded), and what the report says below its table.
BANDED = re.compile(r"\d \(-?[\d.]+ to -?[\d.]+\)")
BAND_NOTE = ("In brackets: the range that the numerical error leaves open (spacing and layout of the points, measured in "
             "studies; neither the material nor the experiment).")


@dataclass
class Table:
    title: str
    columns: list
    rows: list
    note: str = ""

    def look(self, column):
        """Returns the class of a column: who its values are from."""
        return CLASSES.get(column, "words" if column in WORDS else "whole" if column in WHOLE else "")

    def words(self):
        """Returns what stands below the table."""
        banded_cells = any(BANDED.search(str(cell)) for row in self.rows for cell in row)
        return " ".join(filter(None, [self.note, banded_cells and BAND_NOTE]))

    def csv(self):
        """Returns the table as text of a CSV file."""
        lines = io.StringIO()
        csv.writer(lines, lineterminator="\n").writerows([self.columns, *self.rows])
        return lines.getvalue()

    def file_name(self):
        return (re.sub(r"[^a-z0-9]+", "_", self.title.lower()).strip("_")[:60] or "table") + ".csv"


def text(value, digits=1, scale=1.0, signed=False):
    """Returns a number as text, or a dash if there is none."""
    if value is None or not np.isfinite(value):
        return "–"
    return f"{scale * value:{'+' if signed else ''}.{digits}f}"


def band_text(band, digits=1, scale=1.0):
    """Returns the range that the numerical error leaves open, or nothing if it is not known or has no width."""
    low, high = (text(end, digits, scale) for end in band or (None, None))
    return "" if low == high else f"{low} to {high}"


def banded(value, band, digits=1, scale=1.0):
    """Returns a number as text, and behind it the range that its numerical error leaves open."""
    found = band_text(band, digits, scale)
    return text(value, digits, scale) + (f" ({found})" if found else "")


def exit_text(slab):
    """Returns the exit velocity of a run in m/s as text, with its band."""
    return banded(slab.exit_velocity, slab.exit_band)


def numerically(band, digits=1, scale=1.0):
    """Returns the words behind a number in a sentence that say which range its numerical error leaves open."""
    found = band_text(band, digits, scale)
    return f" (numerically {found})" if found else ""


def band_verdict(run, band, measured, digits=1, unit=""):
    """Returns the words on whether a measured value lies in the band of a run; nothing for runs of versions without bands."""
    if band is None:
        return f"; the numerical error is {run.band_remark}" if run.band_remark else ""
    outside = max(band[0] - measured, measured - band[1])
    place = "within the numerical band" if outside <= 0 else f"outside the numerical band, by {outside:.{digits}f}{unit}"
    return f"; the measured value lies {place}" + (f" ({run.band_remark})" if run.band_remark else "")


def with_unit(value, unit, digits=1, scale=1.0):
    """Returns a signed difference with its unit, or a dash."""
    number = text(value, digits, scale, signed=True)
    return number if number == "–" else f"{number} {unit}"


def relative(value, base):
    """Returns the relative difference in percent, or None if it has no meaning."""
    return None if value is None or not base else 100.0 * (value - base) / abs(base)


def difference(value, base):
    return None if value is None or base is None else value - base


# Beyond these limits a result is doubtful: an explicit step conserves energy to fractions of a percent, and stabilisation
# must not contribute much energy.
ENERGY_ERROR_LIMIT, STABILIZATION_LIMIT = 0.01, 0.05


def impact_warnings(run):
    """Returns sentences on energies beyond the limits of a sound run, at any time of the run."""
    history = run.history
    initial = history["total_energy"][0]
    found = []
    error = np.abs(history["energy_error"]).max()
    if not error <= ENERGY_ERROR_LIMIT:
        found.append(f"the energy balance is off by up to {100 * error:.1f} % of the initial energy "
                     f"(more than {100 * ENERGY_ERROR_LIMIT:g} %)")
    share = history["stabilization_energy"][np.argmax(np.abs(history["stabilization_energy"]))] / initial
    if not abs(share) <= STABILIZATION_LIMIT:
        effect = "adds energy to the motion" if share < 0 else "takes up much energy"
        found.append(f"the stabilisation {effect}: its work reaches {100 * share:.1f} % of the initial energy "
                     f"(more than {100 * STABILIZATION_LIMIT:g} %)")
    kinetic = (history["kinetic_energy"] + history["projectile_kinetic_energy"]).max() / initial
    if not kinetic <= 1 + ENERGY_ERROR_LIMIT:
        found.append(f"the kinetic energy grows to {100 * kinetic:.0f} % of the initial energy")
    return found


BAR = (("final length / initial length", "final_length_ratio", 4, 1.0),
       ("foot diameter (mm)", "foot_diameter", 2, 1e3),
       ("plastic strain, 95 % quantile", "plastic_strain_95", 3, 1.0),
       ("plastic strain, largest point", "max_plastic_strain", 2, 1.0))


def bar_table(bar, row):
    """Compares a bar with the references. Columns of the experiments' file: KEY_experiment, KEY_nmap, KEY_converged; lengths
    end in _mm."""
    rows = []
    for label, key, digits, scale in BAR:
        ours = bar.number(key)
        unit = "_mm" if scale == 1e3 else ""
        found = [(row or {}).get(f"{key}_{source}{unit}") for source in ("experiment", "nmap", "converged")]
        rows.append([label, banded(ours, bar.band(key), digits, scale), *(text(v, digits) for v in found)] +
                    [with_unit(relative(None if ours is None else scale * ours, v), "%") for v in found])
    return Table("Deformed bar", ["quantity", OURS, EXPERIMENT, NMAP, CONVERGED, "Spall vs experiment",
                                  "Spall vs NMAP", "Spall vs converged"], rows,
                 "The converged reference solves the same constants without friction with other methods (finite "
                 "elements; data/experiments/taylor.csv). The largest plastic strain does not converge under "
                 "refinement: it is shown, not judged.")


# Differences below this many percent get no explanation: two resolutions differ by as much.
WORTH_A_REASON = 0.8


def bar_reason(bar, ours, row, key):
    """Returns the reason why the computed value differs from the references, as far as the references show it."""
    experiment, nmap, converged = (row.get(f"{key}_{source}") for source in ("experiment", "nmap", "converged"))
    kernel = bar.summary.get("contact_scheme") == "kernel"
    found = []
    constants = relative(converged, experiment)
    if constants is not None and abs(constants) >= WORTH_A_REASON:
        found.append(f"experiment: the material's constants, with which a converged solution is {constants:+.1f} % off")
    if nmap and abs(relative(ours, nmap)) >= WORTH_A_REASON:
        found.append("NMAP: the weight of its M-SNNI, which is not printed" + (
            "" if kernel or key == "foot_diameter" else
            ", and possibly its contact by overlapping kernels, with which Spall's length depends on the initial gap"))
    numerics = relative(ours, converged)
    if numerics is not None and abs(numerics) >= WORTH_A_REASON:
        found.append("converged: " + ("overlapping kernels between bar and anvil" if kernel else
                                      "spacing of the points" + (" and the anvil, which deforms"
                                                                 if bar.has_anvil else "")))
    return "; ".join(found) or "agrees"


def bars_table(bars, references):
    """Compares every bar with all its references, with one row for the length and one for the foot."""
    rows = []
    for bar in bars:
        row = references.bar(bar)
        if row is None:
            continue
        target = f"anvil, {bar.summary.get('contact_scheme', 'surface')} contact" if bar.has_anvil else "rigid wall"
        for label, key, unit, digits, scale in (("final length / initial length", "final_length_ratio", "", 4, 1.0),
                                                ("foot diameter (mm)", "foot_diameter", "_mm", 2, 1e3)):
            ours = bar.number(key)
            if ours is None:
                continue
            columns = {f"{key}_{source}": row.get(f"{key}_{source}{unit}")
                       for source in ("experiment", "nmap", "converged")}
            rows.append([row["material"], f"{target}, {bar.summary.get('scheme', 'unknown scheme')}", label,
                         banded(ours, bar.band(key), digits, scale),
                         *(text(value, digits) for value in columns.values()),
                         bar_reason(bar, scale * ours, columns, key)])
    return Table("All Taylor bars", ["bar", "target, scheme", "quantity", OURS, EXPERIMENT, NMAP, CONVERGED, "why ours differs"],
                 rows, "Experiment: Wilkins and Guinan (1973), as printed in the paper's Table 3; NMAP: the paper's "
                 "Table 3 and section 5.1 (M-SNNI, modelled anvil); converged: other codes with the same constants on "
                 "a rigid wall without friction. The copper bar has no experiment: it verifies codes.")


def bar_verdict(bar, row):
    ours, name = bar.number("final_length_ratio"), row["material"] if row else bar.name
    if ours is None:
        return f"Taylor bar, {name}: no final length in the summary."
    band = bar.band("final_length_ratio")
    sentence = f"Taylor bar, {name}: final length ratio {ours:.4f}{numerically(band, 4)}"
    if not row:
        return f"{sentence}; no experiment at this velocity is on record."
    for source, label in (("experiment", "measured"), ("converged", "converged"), ("nmap", "NMAP's")):
        value = row.get(f"final_length_ratio_{source}")
        if value:
            sentence += f", {label} {value:g} ({relative(ours, value):+.1f} %)"
    measured = row.get("final_length_ratio_experiment")
    return sentence + (band_verdict(bar, band, measured, 4) if measured else "") + "."


def received_tables(run):
    """Returns a table for every body whose momentum was asked for: what it has received from the others."""
    tables = []
    for name in [key.removesuffix("_max_deflection") for key in run.summary if key.endswith("_max_deflection")]:
        from_others = [(match[1], run.number(key)) for key in run.summary
                       if (match := re.fullmatch(f"{re.escape(name)}_momentum_from_(.+)", key))]
        rows = [["momentum along z, in all (N s)", text(run.number(f"{name}_momentum"))],
                *([f"momentum from {other} (N s)", text(value)] for other, value in from_others),
                ["energy, kinetic and of deformation (kJ)", text(run.number(f"{name}_energy"), 2, 1e-3)],
                ["kinetic energy alone (kJ)", text(run.number(f"{name}_kinetic_energy"), 2, 1e-3)],
                ["largest deflection along z (mm)", text(run.number(f"{name}_max_deflection"), 1, 1e3)],
                ["largest plastic strain", text(run.number(f"{name}_max_plastic_strain"), 2)]]
        tables.append(Table(f"What the body '{name}' has received", ["", "at the end of the run"], rows,
                            "Values of the whole body. All are computed: there is no test to compare them with."))
    return tables


def microcell_table(result):
    """Lists peak stress, damage and energy of every cell size."""
    energy = result.constants.get("fracture_energy")
    rows = []
    for curve in result.curves:
        peak = int(np.argmax(curve["stress"]))
        rows.append([text(curve["cell_size"], 1, 1e3), text(curve["stress"][peak], 3, 1e-6),
                     f"{curve['strain'][peak]:.3g}", text(curve["damage"][0], 3), text(curve["damage"][-1], 3),
                     text(curve["damage_strength"][-1], 3), text(curve["dissipation"][-1] * curve["cell_size"], 2)])
    return Table("Microcell by size", ["cell size (mm)", "peak stress (MPa)", "strain at peak", "d, unloaded",
                                       "d, last row", "strength d, last row", "dissipated per cell area (N/m)"],
                 rows, f"Cohesive law: G_f = {text(energy, 1)} N/m, f_t = "
                 f"{text(result.constants.get('tensile_strength'), 2, 1e-6)} MPa, "
                 f"{result.constants.get('softening', 'unknown')} softening; {result.constants.get('crack_set', '')}; "
                 f"{result.constants.get('boundary', '')} boundary. Dissipation counts the ligament only, so it "
                 "ends at G_f times the uncracked part of the width once the cell has parted.")


def cost_table(results):
    rows = []
    for result in results:
        get = result.summary.get

        def first(*keys):
            return next((get(k) for k in keys if isinstance(get(k), (int, float))), None)

        rows.append([result.name, text(first("points", "dofs"), 0), text(first("steps", "load_steps"), 0),
                     text(first("wall_seconds"), 2), text(first("points_steps_per_second"), 2, 1e-6),
                     text(first("peak_memory_bytes"), 0, 2.0**-20), text(first("ranks"), 0),
                     text(first("threads"), 0), text(first("energy_balance_error"), 3, 100.0),
                     text(first("momentum_balance_error"), 3, 100.0)])
    return Table("Cost and balances", ["result", "points or unknowns", "steps", "wall time (s)",
                                       "10⁶ points × steps / s", "memory (MiB)", "ranks", "threads",
                                       "energy error (%)", "momentum error (%)"], rows)
