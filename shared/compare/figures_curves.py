"""Figures of the microcell and of the material point: curves against strain."""

import numpy as np
from matplotlib.collections import PolyCollection

from style import CYCLE, figure


def size_label(size):
    return f"l = {1e3 * size:g} mm" if size else "reference cell"


def shown_strain(curve):
    """Last strain worth drawing: where damage passes 0.97, so that the long tail does not squeeze the rest."""
    above = np.flatnonzero(curve["damage_strength"] > 0.97)
    return curve["strain"][above[0] if len(above) else -1]


def damage_definitions(curve):
    drawn, axes = figure()
    for (column, label), color, line in zip(
            [("damage", "stiffness: 1 − ψ/Y (Eq. 27)"),
             ("damage_renormalised", "stiffness, 0 for the unloaded cell"),
             ("damage_strength", "strength: 1 − stress/peak"),
             ("damage_path", "path: 1 − dψ/dY (never used)")],
            CYCLE, ["-", "--", "-", ":"]):
        axes.plot(curve["strain"], curve[column], color=color, linestyle=line, label=label)
    axes.axhline(1.0, color="0.6", linewidth=0.8)
    axes.set(xlabel="macroscopic strain", ylabel="damage $d_t$", xlim=(0, shown_strain(curve)),
             ylim=(-0.03, max(1.05, min(1.5, 1.05 * curve["damage_path"].max()))),
             title=f"Damage, {size_label(curve['cell_size'])}")
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
    axes.legend(loc="upper left", bbox_to_anchor=(0, -0.18), ncol=2, fontsize=9)
    drawn.set_size_inches(7.5, 5.0)
    return drawn


def damage_sizes(curves):
    """Strength damage of every cell size; strain on a logarithmic axis since it scales with 1/size."""
    drawn, axes = figure()
    for i, curve in enumerate(curves):
        rising = curve["strain"] > 0
        axes.semilogx(curve["strain"][rising], curve["damage_strength"][rising], color=CYCLE[i % len(CYCLE)],
                      linestyle=["-", "--", ":"][i // len(CYCLE) % 3], label=size_label(curve["cell_size"]))
    onset = min((c["strain"][c["damage_strength"] > 0][0] for c in curves if c["damage_strength"].max() > 0),
                default=1e-5)
    axes.set(xlabel="macroscopic strain", ylabel="strength damage $d_t$", ylim=(-0.03, 1.05),
             title="Strength damage by cell size")
    axes.set_xlim(left=0.5 * onset)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=9)
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
    """Stress and strength damage of many random cells: mean and band."""
    drawn, row = figure(10.5, 4.2, 1, 2)
    for axes, column, factor, label in ((row[0], "stress", 1e-6, "stress along the pull (MPa)"),
                                        (row[1], "damage_strength", 1, "strength damage $d_t$")):
        weak, strong = band["weak"], band["strong"]
        axes.fill_between(weak["strain"], factor * weak[column], factor * strong[column], color=CYCLE[0], alpha=0.25,
                          linewidth=0, label="band")
        axes.plot(mean["strain"], factor * mean[column], color=CYCLE[0], label=f"mean of {samples} cells")
        axes.set(xlabel="macroscopic strain", ylabel=label, xlim=(0, shown_strain(mean)), ylim=(0, None))
        axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
        axes.legend(loc="best")
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
    """States of the cell side by side, displacements magnified, coloured by the stress along the pull."""
    drawn, row = figure(4.75 * len(states), 4.8, 1, len(states), squeeze=False)
    # One scale for all: the last state is free of stress. A crack tip's singularity would take all colours.
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
        axes.autoscale_view()
        axes.set_aspect("equal")
        axes.grid(False)
        axes.set(xlabel="x (mm)", ylabel="y (mm)", title=f"strain {state.strain:.3g},\ndisplacement × {factor:g}")
    drawn.colorbar(cells, ax=row[0].tolist(), label="stress along the pull (MPa)", shrink=0.85)
    return drawn


def tension(tensions):
    """The paper's Fig. 8. tensions: {'afc': columns, 'midm': columns}, either may be absent."""
    drawn, axes = figure()
    for name, label, color, line in (("afc", "AFC alone", CYCLE[1], "--"),
                                     ("midm", "AFC with the damage table (MIDM)", CYCLE[0], "-")):
        if name in tensions:
            axes.plot(tensions[name]["exx"], 1e-6 * tensions[name]["sxx"], color=color, linestyle=line,
                      label=label)
    axes.set(xlabel="axial strain", ylabel="axial stress (MPa)", xlim=(0, None), ylim=(0, None),
             title="Concrete in uniaxial tension (as in Fig. 8 of the paper)")
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
    axes.set_ylim(top=1.25 * axes.get_ylim()[1])
    axes.legend(loc="upper right")
    return drawn
