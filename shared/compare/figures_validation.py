"""Figure of the validation: measured values with their scatter, computed ones with their band, published formulas."""

from style import CYCLE, EXPERIMENT, OURS, error_bars, figure
from validation import DEPTH, EXIT, TIP

# Titles of the panels, and the quantities that they show.
PANELS = (("Exit velocity (m/s)", (EXIT,)), ("Depth of penetration (mm)", (DEPTH,)),
          ("Front crater: depth by the tip (mm)", (TIP,)), ("Front crater: diameter (mm)", ("diameter of the front crater (mm)",)),
          ("Rear crater: diameter (mm)", ("diameter of the rear crater (mm)",)))
MARKERS = "v^<>PXdhs*"
STEP = 0.045  # between the formulas' markers, of the distance of two shots


def short(check):
    """Returns the shot in a few lines, for the foot of a panel."""
    return check.shot.replace(", ", "\n").replace(" of concrete", "")


def panel(axes, title, checks, names):
    """Draws the checks of one panel. names: all formulas of the figure, in the order of their colours."""
    for i, check in enumerate(checks):
        axes.plot(i - 0.2, check.measured, "s", color=EXPERIMENT, markersize=7, zorder=4, clip_on=False)
        if check.scatter:
            axes.errorbar(i - 0.2, check.measured, yerr=check.scatter, fmt="none", color=EXPERIMENT, capsize=4, linewidth=1.3)
        if check.computed is not None:
            axes.plot(i - 0.05, check.computed, "o", color=OURS, markersize=7, zorder=4, clip_on=False)
            error_bars(axes, [(i - 0.05, check.computed, check.band)], OURS)
        for name, (value, inside) in check.formulas.items():
            at = names.index(name)
            color = CYCLE[1 + at % (len(CYCLE) - 2)]
            axes.plot(i + 0.06 + STEP * at, value, MARKERS[at % len(MARKERS)], color=color, markersize=5,
                      markerfacecolor=color if inside else "none", clip_on=False)
    axes.set_title(title, fontsize=11, loc="left")
    axes.set_xticks(range(len(checks)), [short(check) for check in checks], fontsize=8)
    axes.set_xlim(-0.5, max(len(checks) - 0.3, 0.7))
    axes.set_ylim(0, 1.08 * max(1.0, axes.get_ylim()[1]))
    axes.grid(axis="x", visible=False)


def draw(checks):
    """Returns the figure, or None if there is no number to show. checks: one per measured value."""
    panels = [(title, [check for check in checks if check.quantity in quantities]) for title, quantities in PANELS]
    panels = [(title, found) for title, found in panels if found]
    if not panels:
        return None
    names = list(dict.fromkeys(name for _, found in panels for check in found for name in check.formulas))
    rows = -(-(len(panels) + 1) // 2)  # the last place is that of the legend
    drawn, grid = figure(12.4, 3.8 * rows, rows, 2, squeeze=False)
    places = list(grid.ravel())
    for axes, (title, found) in zip(places, panels):
        panel(axes, title, found, names)
    for axes in places[len(panels):]:
        axes.axis("off")
    handles = [places[0].plot([], [], "s", color=EXPERIMENT, label="measured, with its scatter where published")[0],
               places[0].plot([], [], "o", color=OURS, label="Spall, with its numerical band")[0]]
    handles += [places[0].plot([], [], MARKERS[at % len(MARKERS)], color=CYCLE[1 + at % (len(CYCLE) - 2)], linestyle="",
                               markersize=5, label=name)[0] for at, name in enumerate(names)]
    places[len(panels)].legend(handles=handles, loc="center left", fontsize=10)
    return drawn
