"""Figures of a shot: force and deceleration over the depth of the tip, and the debris by the angle of its flight."""

import numpy as np

from style import CYCLE, OURS, figure
from tables_slabs import projectile_mass

MEAN_PATH = 0.25  # radii of the projectile: forces of single steps jump as points come into contact and leave it


def mean_force(time, position, velocity, mass, path):
    """Returns (depth, force) of means over stretches of a path in which the body advances, from its loss of momentum, SI."""
    places, forces, begin = [], [], 0
    for i in range(1, len(time)):
        if abs(position[i] - position[begin]) < path:
            continue
        places.append(0.5 * (position[i] + position[begin]))
        forces.append(mass * (velocity[begin] - velocity[i]) / (time[i] - time[begin]))
        begin = i
    return np.array(places), np.array(forces)


def force_over_depth(slab):
    """Draws force and deceleration against the depth of the tip; None where the run does not know its target's face or the mass."""
    face, mass, radius = slab.number("struck_face"), projectile_mass(slab), slab.number("projectile_radius")
    if None in (face, mass, radius):
        return None
    history = slab.history
    depth, force = mean_force(history["time"], history["projectile_position"] - face, history["projectile_velocity"], mass,
                              MEAN_PATH * radius)
    if len(depth) < 2:
        return None
    drawn, axes = figure()
    axes.plot(1e3 * depth, 1e-3 * force, color=OURS)
    thickness = slab.number("thickness")
    if thickness and depth.max() > thickness:
        axes.axvline(1e3 * thickness, color="0.4", linestyle="--", linewidth=1.2)
        axes.annotate("back of the target", (1e3 * thickness, 1), (4, -4), xycoords=("data", "axes fraction"),
                      textcoords="offset points", va="top", fontsize=9, color="0.4")
    axes.set(xlabel="depth of the tip (mm)", ylabel="force on the projectile (kN)", title="Force and deceleration")
    other = axes.secondary_yaxis("right", functions=(lambda kilonewton: kilonewton / mass, lambda deceleration: deceleration * mass))
    other.set_ylabel("deceleration (1000 m/s²)")
    return drawn


def debris_cone(slab):
    """Draws mass and kinetic energy of the debris by the angle of its flight, and the cones that hold half and most of the energy."""
    found = slab.cone
    last = max(np.flatnonzero(found["mass"] > 0), default=0) + 1
    drawn, (left, right) = figure(11.0, 4.0, 1, 2)
    middle = np.degrees(0.5 * (found["angle_from"] + found["angle_to"]))[:last]
    width = np.degrees(found["angle_to"][0] - found["angle_from"][0])
    for axes, name, words, color in ((left, "mass", "mass (kg)", CYCLE[5]), (right, "kinetic_energy", "kinetic energy (J)", OURS)):
        axes.bar(middle, found[name][:last], width=0.9 * width, color=color)
        axes.set(xlabel="angle of the flight from the axis (degrees)", ylabel=f"{words} per {width:g} degrees",
                 title=f"total {found[name].sum():.3g} {words.split('(')[1].rstrip(')')}")
    for key, share, color in (("debris_half_angle_50", "half", CYCLE[1]), ("debris_half_angle_90", "90 %", CYCLE[4])):
        angle = slab.number(key)
        if angle is not None:
            right.axvline(np.degrees(angle), color=color, linestyle="--", label=f"{share} of the energy within {np.degrees(angle):.1f}°")
    right.legend(fontsize=9)
    return drawn
