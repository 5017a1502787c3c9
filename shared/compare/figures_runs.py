"""Figures that compare several slabs: a series with the experiments, bands, refinement."""

import numpy as np

from figures_slabs import velocity_of
from style import CONVERGED, CYCLE, EXPERIMENT, NMAP, OURS, error_bars, figure


def draw_band(axes, slab, weak, strong, color):
    """Fills the range of the velocities with the weak, mean and strong table, up to the end of the shortest run."""
    end = min(run.history["time"][-1] for run in (slab, weak, strong))
    time = slab.history["time"][slab.history["time"] <= end]
    curves = [np.interp(time, run.history["time"], run.history["projectile_velocity"]) for run in (weak, slab, strong)]
    exits = [run.exit_velocity for run in (weak, slab, strong)]
    label = "" if None in exits else f": {min(exits):.0f} to {max(exits):.0f} m/s"
    axes.fill_between(1e3 * time, np.min(curves, axis=0), np.max(curves, axis=0), color=color, alpha=0.3, linewidth=0,
                      label=f"weak to strong concrete{label}")


def velocities(slabs, rows, bands=(), resolution=""):
    """Draws the velocities of all slabs in one figure (the paper's Figs. 15 and 17), with the exit velocities of the tests and
    of NMAP at the right. bands: (weak, mean, strong) runs with the tables of an ensemble."""
    drawn, axes = figure(8.5, 4.8)
    end = max(1e3 * slab.history["time"][-1] for slab in slabs)
    for i, (slab, row) in enumerate(zip(slabs, rows)):
        color = CYCLE[i % len(CYCLE)]
        time = 1e3 * slab.history["time"]
        axes.plot(time, velocity_of(slab), color=color,
                  label=f"{1e3 * slab.number('thickness'):g} mm, {slab.name}")
        error_bars(axes, [(time[-1], slab.exit_velocity, slab.exit_band)], color)
        for weak, mean, strong in bands:
            if mean is slab and None not in (weak.history, strong.history):
                draw_band(axes, slab, weak, strong, color)
        row = {key: value for key, value in (row or {}).items() if value is not None}
        if "experiment_exit_m_s" in row:
            axes.plot([time[-1], end], [row["experiment_exit_m_s"]] * 2, color=color, linestyle="--", linewidth=1)
        for key, marker, face in (("experiment_exit_m_s", "s", color), ("nmap_exit_m_s", "D", "none")):
            if key in row:
                axes.plot(end, row[key], marker, color=color, markerfacecolor=face, markersize=8, clip_on=False, zorder=5)
    axes.plot([], [], "s", color="0.4", label="measured exit velocity")
    axes.plot([], [], "D", color="0.4", markerfacecolor="none", label="NMAP, paper, low resolution")
    axes.axhline(0, color="0.6", linewidth=0.8)
    axes.set(xlabel="time (ms)", ylabel="projectile velocity (m/s)", xlim=(0, end))
    axes.set_title(f"Velocity of the projectile\n{resolution}", fontsize=11, loc="left")
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=9)
    return drawn


def absorbed(slabs, found, resolution=""):
    """Draws the absorbed energy per thickness, which is nearly constant in the tests. found: (ours, experiment, NMAP) of every
    slab."""
    drawn, axes = figure(7.5, 4.2)
    thickness = [1e3 * slab.number("thickness") for slab in slabs]
    for column, label, color, marker, line in ((1, "experiment", EXPERIMENT, "s", "--"),
                                               (2, "NMAP, paper, low resolution", NMAP, "D", ":"),
                                               (0, "Spall", OURS, "o", "-")):
        known = [(t, 1e-3 * f[column].absorbed_per_thickness) for t, f in zip(thickness, found) if f[column]]
        if known:
            error_bars(axes, [(t, 1e-3 * f[column].absorbed_per_thickness, f[column].band("absorbed_per_thickness", 1e-3))
                              for t, f in zip(thickness, found) if f[column]], color)
            axes.plot(*zip(*known), marker=marker, color=color, linestyle=line, label=label, markersize=7,
                      markerfacecolor="none" if column == 2 else color)
    axes.set(xlabel="thickness (mm)", ylabel="absorbed energy / thickness (kN)")
    axes.set_title(f"Resistance of the slabs\n{resolution}", fontsize=11, loc="left")
    axes.set_ylim(0, 1.08 * axes.get_ylim()[1])
    axes.legend(fontsize=9)
    return drawn


def convergence(runs, reference):
    """Draws exit velocity against spacing, with one line per scheme. runs: [(label, spacing, exit velocity, band)]."""
    drawn, axes = figure(8.5, 4.6)
    exact, tolerance = reference["exit_m_s"], reference.get("tolerance_m_s") or 0.0
    axes.axhline(exact, color=CONVERGED, linestyle="--", label=f"finite elements, converged: {exact:g} m/s")
    if tolerance:
        axes.axhspan(exact - tolerance, exact + tolerance, color=CONVERGED, alpha=0.15, linewidth=0,
                     label=f"aim: within {tolerance:g} m/s")
    for i, label in enumerate(sorted({run[0] for run in runs})):
        line = sorted(((1e3 * spacing, exit_velocity, band) for name, spacing, exit_velocity, band in runs if name == label),
                      key=lambda point: point[:2])
        error_bars(axes, line, CYCLE[i % len(CYCLE)])
        axes.plot(*list(zip(*line))[:2], "o-", color=CYCLE[i % len(CYCLE)], label=label)
    axes.set(xlabel="spacing of the points (mm)", ylabel="exit velocity (m/s)",
             title=f"Set {reference['set']}, friction {reference['friction']:g}, "
                   f"{reference['thickness_mm']:g} mm slab: convergence")
    axes.set_xlim(left=0)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9)
    return drawn


def refinement(lines, rows):
    """Draws exit velocity against spacing for each slab, beside the measured one. lines: [(name, [(spacing, exit velocity,
    band)])]; rows: their experiments, or None."""
    drawn, axes = figure(8.5, 4.6)
    for i, ((name, line), row) in enumerate(zip(lines, rows)):
        color = CYCLE[i % len(CYCLE)]
        spacings, exits, _ = zip(*line)
        axes.plot([1e3 * spacing for spacing in spacings], exits, "o-", color=color, label=name)
        error_bars(axes, [(1e3 * spacing, *rest) for spacing, *rest in line], color)
        if row and row.get("experiment_exit_m_s") is not None:
            axes.axhline(row["experiment_exit_m_s"], color=color, linestyle="--", linewidth=1.2,
                         label=f"measured: {row['experiment_exit_m_s']:g} m/s")
    axes.set(xlabel="spacing of the points (mm)", ylabel="exit velocity (m/s)",
             title="One material set under refinement")
    axes.set_xlim(left=0)
    axes.set_ylim(0, 1.08 * axes.get_ylim()[1])
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9)
    return drawn
