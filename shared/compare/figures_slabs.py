"""Figures of slabs: velocities and energies, damage, debris, craters."""

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.ticker import FuncFormatter

import cracks
import points
from figures_impact import draw_points, time_axis
from references import UNCERTAINTY
from style import CYCLE, EXPERIMENT, NMAP, OURS, figure

# The paper shows damage between these values (its Figs. 13 and 14); smaller damage is drawn as sound concrete.
SHOWN_DAMAGE, SOUND = (0.15, 1.0), "#e9e9e6"
RIGID = dict(facecolor="#b9c4d0", edgecolor="#2c3e50", linewidth=1.2, alpha=0.85, zorder=3)


def velocity(slab, row):
    """Draws the velocity of the projectile against time, with the measured and published exit velocities."""
    drawn, axes = figure()
    time = 1e3 * slab.history["time"]
    axes.plot(time, slab.history["projectile_velocity"], color=OURS, label="Spall", zorder=3)
    exit_time, exit_velocity = slab.number("time_of_exit"), slab.exit_velocity
    if exit_time is not None and exit_velocity is not None:
        axes.plot(1e3 * exit_time, exit_velocity, "o", color=OURS, zorder=4,
                  label=f"Spall, exit: {exit_velocity:.1f} m/s")
    measured, uncertainty, nmap = ((row or {}).get(key) for key in ("experiment_exit_m_s", UNCERTAINTY, "nmap_exit_m_s"))
    if measured is not None:
        axes.axhline(measured, color=EXPERIMENT, linestyle="--", linewidth=1.3,
                     label=f"measured exit velocity: {measured:g} m/s")
    if None not in (measured, uncertainty):
        axes.axhspan(measured - uncertainty, measured + uncertainty, color=EXPERIMENT, alpha=0.12, linewidth=0)
    if nmap is not None:
        axes.plot(time[-1], nmap, "D", color=NMAP, markersize=8, markerfacecolor="none",
                  markeredgewidth=2, clip_on=False, zorder=5,
                  label=f"NMAP, paper, low resolution, exit: {nmap:g} m/s (time not printed)")
    axes.set(xlabel="time (ms)", ylabel="projectile velocity (m/s)", xlim=(0, time[-1]),
             title=f"{1e3 * slab.number('thickness'):g} mm slab" if slab.number("thickness") else "slab")
    low, high = axes.get_ylim()
    axes.set_ylim(max(0.0, low - 0.08 * (high - low)) if low >= 0 else low, high)
    axes.legend(loc="upper left", bbox_to_anchor=(0, -0.16), fontsize=9)
    drawn.set_size_inches(7.5, 5.2)
    return drawn


def energy_flow(slab):
    """Draws how the projectile's energy is divided, as a stack in percent of the energy at impact."""
    history = slab.history
    (time, label_of_time), scale = time_axis(history), 100 / history["total_energy"][0]
    layers = [("kinetic, projectile", history["projectile_kinetic_energy"], "#c9d3dd"),
              ("kinetic, slab and debris", history["kinetic_energy"], CYCLE[0]),
              ("friction", history["friction_work"], CYCLE[4]), ("contact, normal", history["contact_work"], "#e8c97a")]
    if "shear_work" in history:
        elastic = [history[f"elastic_{part}_energy"] for part in ("shear", "compression", "tension")]
        layers += [("plastic flow (shear)", history["shear_work"] - elastic[0], CYCLE[1]),
                   ("crushing of pores", history["compression_work"] - elastic[1], CYCLE[8]),
                   ("opening of cracks", history["tension_work"] - elastic[2], CYCLE[3]),
                   ("elastic", sum(elastic), CYCLE[2])]
    else:
        layers.append(("work of the stresses", history["internal_energy"], CYCLE[1]))
    layers.append(("stabilisation", history["stabilization_energy"], CYCLE[5]))
    if "damping_work" in history and history["damping_work"].any():
        layers.append(("numerical damping", history["damping_work"], CYCLE[6]))
    drawn, axes = figure(9, 4.8)
    # The elastic energy of a state that has hardened can be negative for a moment; the stack needs values above 0.
    axes.stackplot(time, *(scale * np.maximum(values, 0) for _, values, _ in layers),
                   colors=[color for *_, color in layers],
                   labels=[f"{label}: {scale * values[-1]:.1f} %" for label, values, _ in layers], linewidth=0)
    floor = min(100, 0.95 * scale * history["projectile_kinetic_energy"].min())
    axes.axhline(100, color="0.2", linewidth=1)
    axes.set(xlabel=label_of_time, ylabel="energy (% of the energy at impact)", xlim=(0, time[-1]), ylim=(floor, 101),
             title="Energy flow; the axis does not begin at 0" if floor > 0 else "Energy flow")
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9,
                title="at the end")
    axes.grid(False)
    return drawn


def damages(frame):
    """Returns [(name, values)] of the damages that the frame has."""
    return [(label, frame.fields[key].astype(float)) for key, label in (
        ("shear_damage", "shear damage"), ("tensile_damage", "tensile damage")) if key in frame.fields]


def draw_damage(axes, x, y, size, values):
    discs = draw_points(axes, 1e3 * x, 1e3 * y, 1e3 * size, values, SHOWN_DAMAGE, "magma_r")
    discs.cmap = discs.cmap.copy()
    discs.cmap.set_under(SOUND)
    return discs


def damage_faces(frame):
    """Draws both faces of the whole target with the points at their present places."""
    kinds = damages(frame)
    size = points.cell_edges(frame.symmetry, frame.initial, frame.volume)
    drawn, grid = figure(9.6, 4.7 * len(kinds), len(kinds), 2, squeeze=False)
    reach = 1.03e3 * (np.abs(frame.initial[:, :2]).max() + 0.5 * size.max())
    for column, (front, face) in enumerate(((True, "front face"), (False, "back face"))):
        layer = points.face_layer(frame.initial, size, front)
        cell = spacing_of(frame, layer)
        for axes, (label, values) in zip(grid[:, column], kinds):
            (now,), (disc, damage) = points.mirrored(frame.symmetry, [frame.position[layer]], [cell, values[layer]], size[layer])
            discs = draw_damage(axes, now[:, 0], now[:, 1], disc, damage)
            axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (mm)", ylabel="y (mm)", title=f"{face}: {label}")
    drawn.colorbar(discs, ax=grid, label="damage", shrink=0.6, pad=0.02)
    return drawn


def spacing_of(frame, layer):
    """Returns the distance of each point of a face to its nearest neighbour on it: discs of this size neither overlap nor leave
    gaps."""
    plane = frame.initial[layer, :2]
    nearest = np.empty(len(plane))
    for begin in range(0, len(plane), 512):
        block = plane[begin:begin + 512]
        squared = ((block[:, None, :] - plane[None, :, :]) ** 2).sum(axis=2)
        squared[np.arange(len(block)), np.arange(begin, begin + len(block))] = np.inf
        nearest[begin:begin + len(block)] = np.sqrt(squared.min(axis=1))
    return nearest


def section(frame):
    """Returns the points of the section through the axis at their present places: x, z, sizes of their discs, and a function
    that mirrors fields in the same way."""
    size = points.cell_edges(frame.symmetry, frame.initial, frame.volume)
    layer = points.section_layer(frame.initial, size)
    planes = section_planes(frame)
    (now,), (disc,) = points.mirrored(planes, [frame.position[layer]], [size[layer]])
    return now[:, 0], now[:, 2], disc, lambda values: points.mirrored(planes, [], [values[layer]])[1][0]


def section_planes(frame):
    """Returns the planes in which the section is mirrored. Its layer lies on the positive side of y = 0, so only x = 0 is left;
    with rotational symmetry the modelled half plane is half of the section."""
    return "x" if "x" in frame.symmetry.split() or frame.symmetry == "axis" else ""


def picture_limits(frame):
    """Returns the outlines of the rigid bodies, the half width and the lowest and highest z of a picture of the section, which
    shows the target, the other bodies and the debris."""
    front, thickness = frame.initial[:, 2].min(), np.ptp(frame.initial[:, 2]) or np.cbrt(frame.volume.max())
    outlines = [points.outline_in_section(rigid) for rigid in frame.rigids]
    radius = max((rigid.outline[:, 1].max() for rigid in frame.rigids), default=0.0)
    shown = min(thickness, 10.0 * radius) if radius > 0 else thickness  # of a thick target the projectile's surroundings
    wide = max([3.0 * shown, 12.0 * radius, *(1.1 * np.abs(x).max() for x, _ in outlines)])
    reach = min(1.03 * np.abs(frame.initial[:, :2]).max(), wide)
    low, high = front - 1.5 * shown, front + thickness + 1.5 * shown
    for z in [*(z for _, z in outlines), *(cloud.position[:, 2] for cloud in frame.bodies)]:
        low, high = min(low, z.min() - 0.02), max(high, z.max() + 0.02)
    return outlines, reach, low, high


def show_side(axes, frame, title):
    outlines, reach, low, high = picture_limits(frame)
    for x, z in outlines:
        axes.fill(1e3 * x, 1e3 * z, **RIGID)
    for cloud in frame.bodies:  # draws the points beside the section
        size = points.cell_edges(frame.symmetry, cloud.initial, cloud.volume)
        layer = points.section_layer(cloud.position, size)
        (now,), (disc,) = points.mirrored(section_planes(frame), [cloud.position[layer]], [size[layer]])
        axes.add_collection(EllipseCollection(
            1e3 * disc, 1e3 * disc, np.zeros(len(disc)), units="xy", facecolors=RIGID["facecolor"], linewidths=0,
            offsets=1e3 * now[:, [0, 2]], transOffset=axes.transData, rasterized=True, zorder=3))
    axes.set(xlim=(-1e3 * reach, 1e3 * reach), ylim=(1e3 * high, 1e3 * low), xlabel="x (mm)",
             ylabel="z (mm), flight downwards", title=title)
    axes.set_aspect("equal")
    axes.grid(False)


def side_figure(frame, columns):
    _, reach, low, high = picture_limits(frame)
    return figure(5.8 * columns, 5.2 * min(1.6, (high - low) / (2 * reach)) + 0.9, 1, columns, squeeze=False)


def damage_section(frame):
    """Draws the section through the axis: the layer of points beside y = 0 at their present places, and the other bodies."""
    kinds = damages(frame)
    x, z, disc, mirror = section(frame)
    drawn, grid = side_figure(frame, len(kinds))
    for axes, (label, values) in zip(grid[0], kinds):
        discs = draw_damage(axes, x, z, disc, mirror(values))
        show_side(axes, frame, f"{label} at {1e3 * frame.time:.2f} ms")
    drawn.colorbar(discs, ax=grid, label="damage", shrink=0.8, pad=0.02)
    return drawn


def debris(frame):
    """Draws all fragments from the side, in front of the section of the remaining target (the paper's Fig. 16)."""
    number = frame.fields["fragment"].astype(int)
    speed = np.linalg.norm(frame.fields["velocity"].astype(float), axis=1)
    flying = np.flatnonzero(number > 0)
    size = points.cell_edges(frame.symmetry, frame.initial, frame.volume)
    (now,), (disc, piece, speed) = points.mirrored(frame.symmetry, [frame.position[flying]],
                                                   [size[flying], number[flying], speed[flying]], size[flying])
    x, z, slab_disc, mirror = section(frame)
    left = mirror(number) == 0
    drawn, grid = side_figure(frame, 2)
    for axes, title in zip(grid[0], ("fragments, single points grey", "speed")):
        axes.add_collection(EllipseCollection(
            1e3 * slab_disc[left], 1e3 * slab_disc[left], np.zeros(left.sum()), units="xy", facecolors="#d8d4c8",
            offsets=1e3 * np.column_stack([x, z])[left], transOffset=axes.transData, linewidths=0, rasterized=True))
        show_side(axes, frame, f"{title}, {1e3 * frame.time:.2f} ms")
    counts = np.bincount(number)
    colors = np.array([CYCLE[p % (len(CYCLE) - 1)] if counts[p] > 1 else "#8a8a8a" for p in piece])
    front = np.argsort(-now[:, 1], kind="stable")  # nearer ones cover farther ones
    grid[0, 0].add_collection(EllipseCollection(
        1e3 * disc[front], 1e3 * disc[front], np.zeros(len(front)), units="xy", facecolors=colors[front],
        offsets=1e3 * now[front][:, [0, 2]], transOffset=grid[0, 0].transData, linewidths=0, rasterized=True, zorder=2))
    discs = draw_points(grid[0, 1], 1e3 * now[:, 0], 1e3 * now[:, 2], 1e3 * disc, speed,
                        (0, max(1.0, speed.max(initial=0))), "viridis")
    drawn.colorbar(discs, ax=grid, label="speed (m/s)", shrink=0.8, pad=0.02)
    return drawn


def craters(slab):
    """Draws the outlines of the craters in plan (the paper's Fig. 18), and their depth along the radius."""
    drawn, (plan, side) = figure(11, 5.0, 1, 2)
    angle = slab.outlines["angle"]
    closed = np.append(np.arange(len(angle)), 0)
    thickness = 1e3 * slab.number("thickness")
    for face, color in (("front", OURS), ("back", CYCLE[1])):
        radius = 1e3 * slab.outlines[f"{face}_radius"]
        mean = slab.number(f"{face}_crater_diameter")
        label = f"{face} face" + (f": {1e3 * mean:.0f} mm" if mean is not None else "")
        plan.plot((radius * np.cos(angle))[closed], (radius * np.sin(angle))[closed], color=color, label=label)
        depth = 1e3 * slab.profiles[f"{face}_depth"]
        at = 1e3 * slab.profiles["radius"]
        if len(at):
            at, depth = np.append(0.0, at), np.append(depth[0], depth)
        level = depth if face == "front" else thickness - depth
        for sign in (-1, 1):
            side.plot(sign * at, level, color=color)
            side.fill_between(sign * at, level, 0 if face == "front" else thickness, color=color, alpha=0.25, linewidth=0)
    radius = slab.number("projectile_radius")
    if radius:
        turn = np.linspace(0, 2 * np.pi, 100)
        plan.plot(1e3 * radius * np.cos(turn), 1e3 * radius * np.sin(turn), color="0.5", linestyle=":", label="projectile")
    plan.set_aspect("equal")
    plan.set(xlabel="x (mm)", ylabel="y (mm)", title="Outlines of the craters")
    plan.legend(loc="upper left", fontsize=9)
    limit = 1.45 * max(1.0, *(1e3 * slab.outlines[f"{face}_radius"].max() for face in ("front", "back")))
    plan.set(xlim=(-limit, limit), ylim=(-limit, limit))
    side.set(xlabel="distance from the axis (mm)", ylabel="z (mm), flight downwards", xlim=(-limit, limit),
             ylim=(1.05 * thickness, -0.05 * thickness), title="Depth of the craters, mean over the angles")
    return drawn


def crack_spectrum(frame, harmonics):
    """Draws the damage of the back face at the initial places of its points, and the spectrum of its change with the angle."""
    drawn, (plan, bars) = figure(11.5, 5.0, 1, 2)
    layer = points.face_layer(frame.initial, np.cbrt(frame.volume), False)
    x, y = frame.initial[layer, :2].T
    discs = draw_damage(plan, x, y, spacing_of(frame, layer), frame.fields["tensile_damage"][layer].astype(float))
    reach = 1.03e3 * np.abs(frame.initial[:, :2]).max()
    turn = np.linspace(0, 2 * np.pi, 200)
    for radius in cracks.ring(frame):
        plan.plot(1e3 * radius * np.cos(turn), 1e3 * radius * np.sin(turn), color=CYCLE[0], linewidth=1.5, linestyle="--", zorder=4)
    plan.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (mm)", ylabel="y (mm)",
             title="tensile damage of the back face")
    drawn.colorbar(discs, ax=plan, label="damage", shrink=0.8, pad=0.02)
    power, layout = np.abs(harmonics) ** 2, cracks.of_layout(harmonics)
    bars.bar(cracks.ORDERS, 100 * layout, color=CYCLE[1], label=f"with the layout's symmetry, {100 * layout.sum():.0f} % in all")
    bars.bar(cracks.ORDERS, 100 * (power - layout), bottom=100 * layout, color=CYCLE[5],
             label=f"without it, {100 * (power - layout).sum():.0f} % in all")
    bars.set(xlabel="harmonic over the angle (cracks around)", ylabel="part of the spectrum (%)", xticks=cracks.ORDERS[3::4],
             title="cracks between the dashed circles", ylim=(0, 1.25 * 100 * power.max()))
    bars.legend(fontsize=9, loc="upper left")
    return drawn


def fragment_sizes(slab):
    """Draws the number of fragments above a mass, and their speeds against their masses, by the side on which they leave."""
    drawn, (number, speed) = figure(11, 4.4, 1, 2)
    found = slab.fragments
    for place, color, marker in (("debris", CYCLE[1], "o"), ("ejecta", CYCLE[0], "s"), ("loose", CYCLE[5], "^")):
        mine = np.flatnonzero(found["place"] == place)
        if not len(mine):
            continue
        order = mine[np.argsort(-found["mass"][mine], kind="stable")]
        grams, copies = 1e3 * found["mass"][order], found["copies"][order]
        number.step(np.append(grams[0], grams), np.append(0, np.cumsum(copies)), where="post", color=color,
                    label=f"{place}: {copies.sum():.0f}, {np.dot(grams, copies) / 1e3:.2f} kg")
        speed.plot(grams, found["velocity_z"][order], marker, color=color, markersize=4, alpha=0.6, linestyle="", label=place)
    lightest, heaviest = (slab.frame.volume.min(), slab.frame.volume.max()) if slab.frame is not None else (0, 0)
    for axes in (number, speed):
        if slab.density and slab.frame is not None:
            axes.axvspan(1e3 * slab.density * lightest, 1e3 * slab.density * heaviest, color="0.9", zorder=0,
                         label="masses of single points")
        axes.set(xscale="log", xlabel="mass of a fragment (g)")
    number.set(ylabel="fragments at least as heavy", yscale="log", title="Sizes")
    for axis in (number.xaxis, speed.xaxis, number.yaxis):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(FuncFormatter(lambda x, _: f"{x:g}" if f"{x:e}"[0] in "25" else ""))
    speed.set(ylabel="velocity along the flight (m/s)", title="Speeds")
    number.set_ylim(bottom=0.8)
    number.legend(fontsize=9)
    return drawn
