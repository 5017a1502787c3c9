"""Figures of all penetrate runs, and of bars: histories, and pictures of the points at the last frame."""

import numpy as np
from matplotlib.collections import EllipseCollection

from style import CONVERGED, CYCLE, EXPERIMENT, NMAP, OURS, figure


def time_axis(history):
    """Returns the times in ms for long runs and in µs for short ones, and the label of the axis."""
    long = history["time"][-1] > 5e-4
    return (1e3 if long else 1e6) * history["time"], "time (ms)" if long else "time (µs)"


def energies(run):
    """Draws how the energy is divided, in percent of the initial total."""
    history = run.history
    drawn, axes = figure(8.5, 4.4)
    (time, label_of_time), initial = time_axis(history), history["total_energy"][0]
    lines = [(history[key], label) for key, label in (
        ("kinetic_energy", "kinetic"), ("internal_energy", "internal"), ("stabilization_energy", "stabilisation"),
        ("friction_work", "friction"), ("contact_work", "contact"), ("damping_work", "numerical damping"))
             if key in history and (key != "damping_work" or history[key].any())]
    for i, (values, label) in enumerate(lines):
        axes.plot(time, 100 * values / initial, color=CYCLE[i % len(CYCLE)],
                  linestyle="-" if i < 3 else ["--", "-.", ":"][i % 3], label=label)
    axes.plot(time, 100 * history["total_energy"] / initial, color="0.4", linewidth=1, label="total")
    axes.set(xlabel=label_of_time, ylabel="energy (% of the initial total)", xlim=(0, time[-1]),
             title="Energy flow")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9)
    return drawn


def balances(run):
    """Draws the energy error, and the momentum gained by the points beside the impulse of contact, and of supports, on them."""
    history = run.history
    drawn, (left, right) = figure(9.5, 3.8, 1, 2)
    time, label_of_time = time_axis(history)
    left.plot(time, 100 * history["energy_error"], color=OURS)
    left.axhline(0, color="0.6", linewidth=0.8)
    left.set(xlabel=label_of_time, ylabel="energy error (% of initial kinetic energy)", title="Energy balance",
             xlim=(0, time[-1]))
    supports = history["support_impulse"] if "support_impulse" in history else np.zeros_like(time)
    right.plot(time, history["impulse"] + supports, color="#f0b27a", linewidth=5,
               label="impulse of contact and supports" if supports.any() else "impulse of the contact")
    right.plot(time, history["momentum"] - history["momentum"][0], color=CYCLE[0], label="momentum gained")
    right.set(xlabel=label_of_time, ylabel="momentum, impulse (N s)", title="Momentum balance",
              xlim=(0, time[-1]))
    low, high = right.get_ylim()
    right.set_ylim(low, high + 0.3 * (high - low))
    right.legend(loc="upper left", fontsize=9)
    return drawn


def draw_points(axes, x, y, size, values, limits, colors):
    """Draws points as discs whose sizes are in data units."""
    order = np.argsort(values, kind="stable")  # damaged points are drawn last, so that undamaged ones do not cover them
    discs = EllipseCollection(size[order], size[order], np.zeros(len(x)), units="xy",
                              offsets=np.column_stack([x, y])[order], transOffset=axes.transData,
                              array=values[order], cmap=colors, clim=limits, linewidths=0, rasterized=True)
    axes.add_collection(discs)
    axes.set_aspect("equal")
    axes.grid(False)
    return discs


def taylor_shape(run, row):
    """Draws the deformed bar with every point at its radius on both sides of the axis, and the measured length."""
    frame = run.frame
    strain = frame.fields["plastic_strain"].astype(float)
    radius = np.hypot(frame.position[:, 0], frame.position[:, 1])
    size = frame.edges
    drawn, axes = figure(6.2, 7.0)
    discs = draw_points(axes, 1e3 * np.concatenate([radius, -radius]),
                        1e3 * np.concatenate([frame.position[:, 2]] * 2), 1e3 * np.concatenate([size] * 2),
                        np.concatenate([strain] * 2), (0, max(1e-9, np.quantile(strain, 0.99))), "viridis")
    ratio = run.number("final_length_ratio")
    if row and ratio:
        length = 1e3 * run.initial_length
        for key, label, color, line in (
                ("final_length_ratio_experiment", "measured length", EXPERIMENT, "--"),
                ("final_length_ratio_nmap", "NMAP length (paper)", NMAP, "-."),
                ("final_length_ratio_converged", "converged length", CONVERGED, ":")):
            if row.get(key):
                axes.axhline(length * row[key], color=color, linestyle=line, linewidth=1.5, label=label)
        axes.legend(loc="upper left", bbox_to_anchor=(0, -0.12), fontsize=9)
    reach = 1.15e3 * (radius.max() + 0.5 * size.max())
    axes.axhline(0, color="0.3", linewidth=2)
    axes.set(xlim=(-reach, reach), ylim=(-1, 1.08e3 * frame.position[:, 2].max()), xlabel="radius (mm)",
             ylabel="height above the wall (mm)", title=f"{row['material'] if row else run.name}, "
             f"{1e6 * frame.time:.0f} µs")
    drawn.colorbar(discs, ax=axes, label="plastic strain (colours end at the 99 % quantile)", shrink=0.8)
    return drawn
