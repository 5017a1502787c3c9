"""Figures of penetrate runs: histories, and pictures of the points at the last frame."""

import numpy as np
from matplotlib.collections import EllipseCollection

import points
from style import CONVERGED, CYCLE, EXPERIMENT, NMAP, OURS, figure


def time_axis(history):
    """Times in ms or µs, whichever reads better, and the label."""
    long = history["time"][-1] > 5e-4
    return (1e3 if long else 1e6) * history["time"], "time (ms)" if long else "time (µs)"


def velocity(slab, row):
    """Velocity of the projectile against time; measured and published exit velocities as marks of their own."""
    drawn, axes = figure()
    time = 1e3 * slab.history["time"]
    axes.plot(time, slab.history["projectile_velocity"], color=OURS, label="Spall", zorder=3)
    exit_time, exit_velocity = slab.number("time_of_exit"), slab.exit_velocity
    if exit_time is not None and exit_velocity is not None:
        axes.plot(1e3 * exit_time, exit_velocity, "o", color=OURS, zorder=4,
                  label=f"Spall, exit: {exit_velocity:.1f} m/s")
    if row:
        axes.axhline(row["experiment_exit_m_s"], color=EXPERIMENT, linestyle="--", linewidth=1.3,
                     label=f"measured exit velocity: {row['experiment_exit_m_s']:g} m/s")
        axes.plot(time[-1], row["nmap_exit_m_s"], "D", color=NMAP, markersize=8, markerfacecolor="none",
                  markeredgewidth=2, clip_on=False, zorder=5,
                  label=f"NMAP, paper, low resolution, exit: {row['nmap_exit_m_s']:g} m/s (time not printed)")
    axes.set(xlabel="time (ms)", ylabel="projectile velocity (m/s)", xlim=(0, time[-1]),
             title=f"{1e3 * slab.number('thickness'):g} mm slab" if slab.number("thickness") else "slab")
    low, high = axes.get_ylim()
    axes.set_ylim(max(0.0, low - 0.08 * (high - low)) if low >= 0 else low, high)
    axes.legend(loc="upper left", bbox_to_anchor=(0, -0.16), fontsize=9)
    drawn.set_size_inches(7.5, 5.2)
    return drawn


def energies(run):
    """Where the energy goes, in percent of the initial total."""
    history = run.history
    drawn, axes = figure(8.5, 4.4)
    (time, label_of_time), initial = time_axis(history), history["total_energy"][0]
    slab = run.summary.get("scene") == "slab"
    lines = [(history["projectile_kinetic_energy"], "kinetic, projectile")] if slab else []
    lines.append((history["kinetic_energy"], "kinetic, slab" if slab else "kinetic"))
    lines += [(history[key], label) for key, label in (
        ("internal_energy", "internal"), ("stabilization_energy", "stabilisation"),
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
    """Energy error, and the momentum the points gained against the impulse of the contact on them."""
    history = run.history
    drawn, (left, right) = figure(9.5, 3.8, 1, 2)
    time, label_of_time = time_axis(history)
    left.plot(time, 100 * history["energy_error"], color=OURS)
    left.axhline(0, color="0.6", linewidth=0.8)
    left.set(xlabel=label_of_time, ylabel="energy error (% of initial kinetic energy)", title="Energy balance",
             xlim=(0, time[-1]))
    right.plot(time, history["impulse"], color="#f0b27a", linewidth=5, label="impulse of the contact")
    right.plot(time, history["momentum"] - history["momentum"][0], color=CYCLE[0], label="momentum gained")
    right.set(xlabel=label_of_time, ylabel="momentum, impulse (N s)", title="Momentum balance",
              xlim=(0, time[-1]))
    low, high = right.get_ylim()
    right.set_ylim(low, high + 0.3 * (high - low))
    right.legend(loc="upper left", fontsize=9)
    return drawn


def draw_points(axes, x, y, size, values, limits, colors):
    """Points as discs of their own size, in data units."""
    order = np.argsort(values, kind="stable")  # damage is drawn last: a crack must not hide behind sound points
    discs = EllipseCollection(size[order], size[order], np.zeros(len(x)), units="xy",
                              offsets=np.column_stack([x, y])[order], transOffset=axes.transData,
                              array=values[order], cmap=colors, clim=limits, linewidths=0, rasterized=True)
    axes.add_collection(discs)
    axes.set_aspect("equal")
    axes.grid(False)
    return discs


def damage_faces(frame, damage):
    """Both faces of the whole slab, seen from in front and from behind, points where they are now."""
    size = np.cbrt(frame.volume)
    drawn, both = figure(10, 5.2, 1, 2)
    reach = 1.03e3 * (np.abs(frame.initial[:, :2]).max() + 0.5 * size.max())
    for axes, front, title in zip(both, (True, False), ("front face", "back face")):
        layer = points.face_layer(frame.initial, size, front)
        (now,), (disc, values) = points.mirrored(
            frame.geometry.get("symmetry_planes", ""), [frame.position[layer]],
            [spacing_of(frame.initial[layer, :2]), damage[layer]])
        discs = draw_points(axes, 1e3 * now[:, 0], 1e3 * now[:, 1], 1e3 * disc, values, (0, 1), "magma_r")
        axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (mm)", ylabel="y (mm)", title=title)
    drawn.colorbar(discs, ax=both, label="damage", shrink=0.85, pad=0.02)
    return drawn


def spacing_of(plane):
    """Distance of each point (n x 2) to its nearest neighbour: disc sizes that neither overlap nor leave gaps."""
    nearest = np.empty(len(plane))
    for begin in range(0, len(plane), 512):
        block = plane[begin:begin + 512]
        squared = ((block[:, None, :] - plane[None, :, :]) ** 2).sum(axis=2)
        squared[np.arange(len(block)), np.arange(begin, begin + len(block))] = np.inf
        nearest[begin:begin + len(block)] = np.sqrt(squared.min(axis=1))
    return nearest


def damage_section(frame, damage):
    """Section through the axis: the layer of points beside y = 0 where they are now, and the projectile."""
    size = np.cbrt(frame.volume)
    layer = points.section_layer(frame.initial, size)
    # The layer lies on the positive side of y = 0, so only x = 0 can mirror it.
    planes = "x" if "x" in frame.geometry.get("symmetry_planes", "") else ""
    (now,), (disc, values) = points.mirrored(planes, [frame.position[layer]], [size[layer], damage[layer]])
    thickness = float(frame.geometry.get("thickness") or frame.initial[:, 2].max())
    outline = points.projectile_outline(frame.geometry, frame.projectile_position)
    radius = float(frame.geometry.get("projectile_radius") or 0.0)
    reach = min(np.abs(frame.initial[:, :2]).max() + size.max(), max(3.0 * thickness, 12.0 * radius))
    low, high = -1.5 * thickness, 2.5 * thickness
    if outline is not None:
        low, high = min(low, outline[1].min() - 0.02), max(high, outline[1].max() + 0.02)
    drawn, axes = figure(9, 9 * min(1.1, (high - low) / (2 * reach)) + 0.4)
    discs = draw_points(axes, 1e3 * now[:, 0], 1e3 * now[:, 2], 1e3 * disc, values, (0, 1), "magma_r")
    if outline is not None:
        axes.fill(1e3 * outline[0], 1e3 * outline[1], facecolor="#b9c4d0", edgecolor="#2c3e50", linewidth=1.2,
                  alpha=0.85, zorder=3)
    axes.set(xlim=(-1e3 * reach, 1e3 * reach), ylim=(1e3 * high, 1e3 * low), xlabel="x (mm)",
             ylabel="z (mm), flight downwards", title=f"Section through the axis at {1e3 * frame.time:.2f} ms")
    drawn.colorbar(discs, ax=axes, label="damage", shrink=0.8, pad=0.02)
    return drawn


def taylor_shape(run, row):
    """The deformed bar: every point at its radius, drawn on both sides of the axis, and the measured length."""
    frame = run.frame
    strain = frame.fields["plastic_strain"].astype(float)
    initial_length = float(frame.geometry.get("thickness") or frame.initial[:, 2].max())
    radius = np.hypot(frame.position[:, 0], frame.position[:, 1])
    size = np.cbrt(frame.volume)
    drawn, axes = figure(6.2, 7.0)
    discs = draw_points(axes, 1e3 * np.concatenate([radius, -radius]),
                        1e3 * np.concatenate([frame.position[:, 2]] * 2), 1e3 * np.concatenate([size] * 2),
                        np.concatenate([strain] * 2), (0, max(1e-9, np.quantile(strain, 0.99))), "viridis")
    ratio = run.number("final_length_ratio")
    if row and ratio:
        length = 1e3 * initial_length
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
