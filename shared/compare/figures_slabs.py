"""Figures of slabs: velocities and energies, craters, fragments."""

import numpy as np
from matplotlib.ticker import FuncFormatter

from figures_impact import time_axis
from references import UNCERTAINTY
from style import (BLACK, BLUE, CYCLE, EXPERIMENT, GREEN, NMAP, ORANGE, OURS, PURPLE, SKY, VERMILLION, YELLOW, error_bars,
                   figure)
from tables import numerically


def velocity_of(slab):
    """Returns the velocity of the projectile in m/s, with a gap where it turns its sign at once: it is a speed, negative once an
    oblique projectile flies away from the target."""
    found = np.array(slab.history["projectile_velocity"], dtype=float)
    turned = (np.sign(found[1:]) * np.sign(found[:-1]) < 0) & (np.abs(np.diff(found)) > 0.1 * np.abs(found).max(initial=0))
    found[1:][turned] = np.nan
    return found


def velocity(slab, row):
    """Draws the velocity of the projectile against time, with the measured and published exit velocities."""
    drawn, axes = figure()
    time = 1e3 * slab.history["time"]
    flight = velocity_of(slab)
    axes.plot(time, flight, color=OURS, label="Spall; negative: away from the target" if np.isnan(flight).any() else "Spall", zorder=3)
    exit_time, exit_velocity = slab.time_of_answer, slab.exit_velocity
    if exit_time is not None and exit_velocity is not None:
        axes.plot(1e3 * exit_time, exit_velocity, "o", color=OURS, zorder=4, clip_on=False,
                  label=f"Spall, exit: {exit_velocity:.1f} m/s{numerically(slab.exit_band)}")
        error_bars(axes, [(1e3 * exit_time, exit_velocity, slab.exit_band)], OURS)
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
    axes.set_ylim(min(0.0, low), high)
    axes.legend(loc="upper left", bbox_to_anchor=(0, -0.16), fontsize=9)
    drawn.set_size_inches(7.5, 5.2)
    return drawn


def energy_flow(slab):
    """Draws how the projectile's energy is divided, as a stack in percent of the energy at impact."""
    history = slab.history
    (time, label_of_time), scale = time_axis(history), 100 / history["total_energy"][0]
    layers = [("kinetic, projectile", history["projectile_kinetic_energy"], "#dde3e9", ""),
              ("kinetic, slab and debris", history["kinetic_energy"], BLUE, "//"),
              ("friction", history["friction_work"], ORANGE, ""), ("contact, normal", history["contact_work"], YELLOW, "xx")]
    if "shear_work" in history:
        elastic = [history[f"elastic_{part}_energy"] for part in ("shear", "compression", "tension")]
        layers += [("plastic flow (shear)", history["shear_work"] - elastic[0], VERMILLION, ""),
                   ("crushing of pores", history["compression_work"] - elastic[1], SKY, "\\\\"),
                   ("opening of cracks", history["tension_work"] - elastic[2], BLACK, ""),
                   ("elastic", sum(elastic), GREEN, "..")]
    else:
        layers.append(("work of the stresses", history["internal_energy"], VERMILLION, ""))
    layers.append(("stabilisation", history["stabilization_energy"], "#ffffff", "++"))
    if "damping_work" in history and history["damping_work"].any():
        layers.append(("numerical damping", history["damping_work"], PURPLE, ""))
    drawn, axes = figure(9, 4.8)
    # The elastic energy of a state that has hardened can be negative for a moment; the stack needs values above 0.
    stack = axes.stackplot(time, *(scale * np.maximum(values, 0) for _, values, *_ in layers),
                           colors=[color for *_, color, _ in layers], edgecolor="white", linewidth=0.5,
                           labels=[f"{label}: {scale * values[-1]:.1f} %" for label, values, *_ in layers])
    for filled, (*_, color, hatch) in zip(stack, layers):
        filled.set(hatch=hatch, edgecolor="0.25" if color in (YELLOW, SKY, "#ffffff") else "white")
    floor = min(100, 0.95 * scale * history["projectile_kinetic_energy"].min())
    axes.axhline(100, color="0.2", linewidth=1)
    axes.set(xlabel=label_of_time, ylabel="energy (% of the energy at impact)", xlim=(0, time[-1]), ylim=(floor, 101),
             title="Energy flow")
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9,
                title="at the end")
    axes.grid(False)
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
    flying = 1e3 * found["mass"][found["place"] != "remainder"]
    for axes in (number, speed):
        if slab.density and slab.frame is not None:
            single = 1e3 * slab.density * slab.frame.volume
            axes.axvspan(single.min(), single.max(), facecolor="0.9", edgecolor="0.7", linewidth=0.5, zorder=0,
                         label=f"masses of single {'rings' if slab.frame.symmetry == 'axis' else 'points'}")
        axes.set_xlim(0.7 * flying.min(), 1.4 * flying.max())
        axes.set(xscale="log", xlabel="mass of a fragment (g)")
    number.set(ylabel="fragments at least as heavy", yscale="log", title="Sizes")
    for axis in (number.xaxis, speed.xaxis, number.yaxis):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(FuncFormatter(lambda x, _: f"{x:g}" if f"{x:e}"[0] in "25" else ""))
    speed.set(ylabel="velocity along the flight (m/s)", title="Speeds")
    number.set_ylim(bottom=0.8)
    number.legend(fontsize=9)
    return drawn
