"""Figures of the microcell: curves against strain."""

import numpy as np
from matplotlib.collections import PolyCollection

from style import CYCLE, figure, line_look


def size_label(size):
    return f"l = {1e3 * size:g} mm" if size else "reference cell"


def shown_strain(curve):
    """Returns the last strain that is drawn, at which damage exceeds 0.97, because a long tail would compress the rest."""
    above = np.flatnonzero(curve["damage_strength"] > 0.97)
    return curve["strain"][above[0] if len(above) else -1]


def damage_definitions(curve):
    drawn, axes = figure()
    for (column, label), color, line, width in zip(
            [("damage", "stiffness: 1 − ψ/Y (Eq. 27)"),
             ("damage_renormalised", "stiffness, 0 for the unloaded cell"),
             ("damage_strength", "strength: 1 − stress/peak"),
             ("damage_path", "path: 1 − dψ/dY (for comparison only)"),
             ("damage_plus", "tensile energy: ψ = (1 − d) Ψ₀⁺ + Ψ₀⁻ (Eq. 28)")],
            CYCLE, ["-", "--", "-", ":", (0, (1, 5))], [None, None, None, None, 4.0]):
        if column in curve:  # damage_plus equals the first curve where all strains are tensile, so wide dots keep both visible
            axes.plot(curve["strain"], curve[column], color=color, linestyle=line, label=label, linewidth=width)
    axes.axhline(1.0, color="0.6", linewidth=0.8)
    axes.set(xlabel="macroscopic strain", ylabel="damage", xlim=(0, shown_strain(curve)),
             ylim=(-0.03, max(1.05, min(1.5, 1.05 * curve["damage_path"].max()))),
             title=f"Damage, {size_label(curve['cell_size'])}")
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
    axes.legend(loc="upper left", bbox_to_anchor=(0, -0.18), ncol=2, fontsize=9)
    drawn.set_size_inches(7.5, 5.0)
    return drawn


def damage_sizes(curves):
    """Draws the damage of strength and of stiffness for every cell size. The axis of strain is logarithmic because the strain
    scales with 1/size."""
    drawn, row = figure(11.5, 4.2, 1, 2)
    onset = min((c["strain"][c["damage_strength"] > 0][0] for c in curves if c["damage_strength"].max() > 0),
                default=1e-5)
    for axes, column, label, left in ((row[0], "damage_strength", "strength damage", 0.5 * onset),
                                      (row[1], "damage", "stiffness damage", 0.1 * onset)):
        for i, curve in enumerate(curves):
            rising = curve["strain"] > 0
            axes.semilogx(curve["strain"][rising], curve[column][rising], **line_look(i), label=size_label(curve["cell_size"]))
        axes.set(xlabel="macroscopic strain", ylabel=label, ylim=(-0.03, 1.05))
        axes.set_xlim(left=left)
    row[1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9)
    drawn.suptitle("Damage by cell size")
    return drawn


def homogenised_stress(curve):
    drawn, axes = figure()
    axes.plot(curve["strain"], 1e-6 * curve["stress"], color=CYCLE[0], label="homogenised stress")
    peak = int(np.argmax(curve["stress"]))
    axes.plot(curve["strain"][peak], 1e-6 * curve["stress"][peak], "o", color=CYCLE[0], markersize=5,
              label=f"peak {1e-6 * curve['stress'][peak]:.3f} MPa at {curve['strain'][peak]:.3g}")
    axes.set(xlabel="macroscopic strain", ylabel="stress along the pull (MPa)", ylim=(0, None),
             xlim=(0, shown_strain(curve)), title=f"Homogenised stress, {size_label(curve['cell_size'])}")
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
    axes.legend(loc="upper right")
    return drawn


def ensemble_band(mean, band, samples):
    """Draws mean and band of many random cells: stress, remaining strength (the factor on the mean's strength that the
    penetration uses) and damage of stiffness."""
    drawn, row = figure(13.5, 4.2, 1, 3)

    def strength_left(curve):
        return curve.get("relative_strength", 1.0) * (1 - curve["damage_strength"])

    for axes, values, label in ((row[0], lambda curve: 1e-6 * curve["stress"], "stress along the pull (MPa)"),
                                (row[1], strength_left, "remaining strength over that of the mean"),
                                (row[2], lambda curve: curve["damage"], "stiffness damage")):
        weak, strong = band["weak"], band["strong"]
        axes.fill_between(weak["strain"], values(weak), values(strong), color=CYCLE[0], alpha=0.25, linewidth=0,
                          label="band")
        axes.plot(mean["strain"], values(mean), color=CYCLE[0], label=f"mean of {samples} cells")
        axes.set(xlabel="macroscopic strain", ylabel=label, xlim=(0, shown_strain(mean)), ylim=(0, None))
        axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
        axes.legend(loc="best")
    # The stiffness damage of initial cracks is visible at strains far below the strain at peak stress.
    row[2].set_xlim(0, min(0.25, 10 * mean["strain"][int(np.argmax(mean["stress"]))] / shown_strain(mean))
                    * shown_strain(mean))
    drawn.suptitle(f"Random cells, {size_label(mean['cell_size'])}")
    return drawn


def free_energies(curve):
    drawn, axes = figure()
    for (column, label), color, line in zip(
            [("psi", "free energy ψ"), ("psi_bulk", "bulk part"), ("psi_cohesive", "cohesive part"),
             ("dissipation", "dissipated"), ("work", "work done")], CYCLE, ["-", "--", "-.", "-", ":"]):
        axes.plot(curve["strain"], curve[column], color=color, linestyle=line, label=label)
    top = 1.15 * max(curve[name].max() for name in ("psi", "work"))
    axes.plot(curve["strain"], curve["psi_undamaged"], color="0.5", linewidth=1.0,
              label="uncracked cell, Y (leaves the frame)")
    axes.set(xlabel="macroscopic strain", ylabel="energy per volume (J/m³)", ylim=(0, top),
             xlim=(0, shown_strain(curve)), title=f"Energies (Eq. 26), {size_label(curve['cell_size'])}")
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9)
    drawn.set_size_inches(8.5, 4.2)
    return drawn


def opened_cell(states):
    """Draws states of the cell side by side, with magnified displacements and coloured by the stress along the pull.
    Aggregates are darker."""
    tall, wide = np.ptp(states[0].points[:, 1]), np.ptp(states[0].points[:, 0])
    drawn, row = figure(4.2 * len(states) + 1.1, 4.2 * tall / wide + 1, 1, len(states), squeeze=False)
    # All states have the colour scale of the first one, as the last state is free of stress. Quantiles leave out the
    # singularity of the crack tip.
    limits = np.quantile(1e-6 * states[0].data["stress_yy"], [0.01, 0.99])
    for axes, state in zip(row[0], states):
        points, corners = state.points, state.corners
        shift, stress = state.data["displacement"][:, :2], 1e-6 * state.data["stress_yy"]
        size = np.ptp(points[:, 0])
        factor = 0.12 * size / max(np.abs(shift).max(), 1e-30)
        factor = float(f"{factor:.1g}")  # a round number for the title
        cells = PolyCollection(1e3 * (points + factor * shift)[corners], array=stress[corners].mean(axis=1),
                               cmap="viridis", clim=limits, linewidths=0, antialiased=False, rasterized=True)
        axes.add_collection(cells)
        inclusions = state.data.get("material", np.zeros(len(points)))[corners].max(axis=1) > 0
        axes.add_collection(PolyCollection(1e3 * (points + factor * shift)[corners[inclusions]], color="black",
                                           alpha=0.25, linewidths=0, antialiased=False, rasterized=True))
        axes.autoscale_view()
        axes.set_aspect("equal")
        axes.grid(False)
        axes.set(xlabel="x (mm)", ylabel="y (mm)", title=f"strain {state.strain:.3g},\ndisplacement × {factor:g}")
    drawn.colorbar(cells, ax=row[0].tolist(), label="stress along the pull (MPa)", shrink=0.85)
    return drawn
