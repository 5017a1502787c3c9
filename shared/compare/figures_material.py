"""The paper's Figs. 4, 5, 7 and 8 with results of material_point. All curves are computed by Spall, because the paper gives
its curves as pictures only."""

import numpy as np

from style import CYCLE, EXPERIMENT, OURS, figure

NOMINAL_STRENGTH = 38.2e6  # Pa, unconfined, of the paper's concrete (its section 3.2)

# Files of a folder of material_point (NAME.csv) by figure, with the label of each curve.
HYDROSTAT = {"hydrostat": "Eq. 21 from (C7, C6) in μ − C7", "hydrostat_printed": "Eq. 21 as printed"}
SURFACE = {"surface_slow": "0.001 s⁻¹", "surface_fast": "100 s⁻¹"}
DAMAGE = {"damage_strength": "strength (default)", "damage_stiffness": "stiffness (Eq. 29 to the letter)",
          "damage_renormalised": "stiffness, 0 for the unloaded cell"}
TENSION = {"tension_afc": "AFC alone", "tension_midm": "AFC with the damage table (MIDM)",
           "tension_printed": "AFC alone, Eq. 24 as printed: fails at once"}
FILES = [*HYDROSTAT, *SURFACE, *DAMAGE, *TENSION]
COLUMNS = ("exx", "eyy", "ezz", "sxx", "syy", "szz", "sxy", "syz", "sxz", "pressure")


def compression(columns):
    """Returns the volumetric strain of Eq. 20, positive in compression."""
    return -(columns["exx"] + columns["eyy"] + columns["ezz"])


def equivalent(columns):
    """Returns the von Mises stress."""
    x, y, z = (columns[name] for name in ("sxx", "syy", "szz"))
    shear = sum(columns[name] ** 2 for name in ("sxy", "syz", "sxz"))
    return np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3 * shear)


def lines(axes, curves, labels, values, styles=("-", "--", ":")):
    for (name, label), color, style in zip(labels.items(), CYCLE, styles):
        if name in curves:
            axes.plot(*values(curves[name]), color=color, linestyle=style, label=label)


def hydrostat(curves):
    """Draws Fig. 4: pressure against volumetric strain with two unloadings, and beside it the start of crushing."""
    drawn, row = figure(11.5, 4.2, 1, 2)
    for axes in row:
        lines(axes, curves, HYDROSTAT, lambda columns: (compression(columns), 1e-6 * columns["pressure"]))
        axes.set(xlabel="volumetric strain μ", ylabel="pressure (MPa)", xlim=(0, None), ylim=(0, None))
    row[0].set_title("Loading, unloading and reloading, locking at μ = C9 = 0.25")
    row[0].legend(loc="upper left")
    row[1].set(xlim=(0, 0.02), xticks=[0, 0.005, 0.01, 0.015, 0.02], ylim=(0, 150), title="Where crushing begins: (C7, C6)")
    drawn.suptitle("Hydrostat (as in Fig. 4 of the paper)")
    return drawn


def failure_surface(curves):
    """Draws Fig. 5: strength against mean pressure in triaxial compression."""
    drawn, row = figure(11.5, 4.2, 1, 2)
    for axes in row:
        lines(axes, curves, SURFACE, lambda columns: (1e-6 * columns["pressure"][1:], 1e-6 * equivalent(columns)[1:]))
        axes.plot(1e-6 * NOMINAL_STRENGTH / 3, 1e-6 * NOMINAL_STRENGTH, "o", color=EXPERIMENT, markersize=6,
                  label="nominal unconfined strength, measured")
        axes.set(xlabel="mean pressure (MPa)", ylabel="stress difference (MPa)", ylim=(0, None))
    row[0].set_title("Intact concrete")
    row[0].legend(loc="lower right")
    top = np.array([-4.0, 40.0])
    row[1].plot(top, 3 * top, color="0.6", linewidth=1, label="uniaxial stress: q = 3 P")
    row[1].plot(top, -3 * top, color="0.6", linewidth=1)
    row[1].set(xlim=(-4, 40), ylim=(0, 110), title="Low pressure")
    row[1].legend(loc="upper left", fontsize=9)
    drawn.suptitle("Failure surface at two strain rates (as in Fig. 5 of the paper)")
    return drawn


def tensile_damage(curves):
    """Draws Fig. 7: tensile damage against strain in uniaxial strain, by definition."""
    drawn, axes = figure()
    lines(axes, curves, DAMAGE, lambda columns: (columns["exx"], columns["tensile_damage"]))
    axes.set(xlabel="strain", ylabel="damage", xlim=(0, None), ylim=(-0.03, 1.05),
             title="Tensile damage of a material point (as in Fig. 7 of the paper)")
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
    axes.legend(loc="lower right")
    return drawn


def tension(curves):
    """Draws Fig. 8: uniaxial tension with free sides."""
    drawn, axes = figure()
    for name, color, style in zip(TENSION, (CYCLE[1], OURS, CYCLE[2]), ("--", "-", ":")):
        if name in curves:
            axes.plot(curves[name]["exx"], 1e-6 * curves[name]["sxx"], color=color, linestyle=style,
                      label=TENSION[name])
    axes.set(xlabel="axial strain", ylabel="axial stress (MPa)", xlim=(0, None), ylim=(0, None),
             title="Concrete in uniaxial tension (as in Fig. 8 of the paper)")
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-3, -3))
    axes.set_ylim(top=1.25 * axes.get_ylim()[1])
    axes.legend(loc="upper right")
    return drawn


# What no figure shows, as the paper's curves are pictures only.
PAPER = " The paper's own curve is not in it: it is compared in a section of its own, if data/digitised holds it."

# For each figure: the function that draws it, the name of its file, the files it needs, and the caption.
FIGURES = [
    (hydrostat, "hydrostat", HYDROSTAT,
     "Pressure against volumetric strain (the paper's Fig. 4). Both curves are computed by Spall: with its default "
     "interpretation, and with Eq. 21 as printed, which is not continuous where crushing begins." + PAPER),
    (failure_surface, "surface", SURFACE,
     "Failure surface in triaxial compression at two strain rates, without shear damage (the paper's Fig. 5). The curves "
     "are computed by Spall; the dot is the nominal strength of the concrete." + PAPER),
    (tensile_damage, "damage", DAMAGE,
     "Tensile damage of a material point in uniaxial strain with the damage table, for each definition (the paper's "
     "Fig. 7). All curves are computed by Spall." + PAPER),
    (tension, "tension", TENSION,
     "Uniaxial tension with free sides, with and without the damage table (the paper's Fig. 8). All curves are computed by "
     "Spall. The paper says of AFC alone that it has a sharp discontinuity and no softening, which is Eq. 24 without a floor." + PAPER),
]
