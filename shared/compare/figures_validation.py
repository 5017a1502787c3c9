"""Figure of the validation: measured values with their scatter, computed ones with their band, published formulas."""

from style import CYCLE, EXPERIMENT, GREY, NMAP, OURS, ORANGE, PURPLE, error_bars, figure
from validation import DEPTH, EXIT, TIP, laws_of

# Titles of the panels, and the quantities that they show.
PANELS = (("Exit velocity (m/s)", (EXIT,)), ("Depth of penetration (mm)", (DEPTH,)),
          ("Front crater: depth by the tip (mm)", (TIP,)), ("Front crater: diameter (mm)", ("diameter of the front crater (mm)",)),
          ("Rear crater: diameter (mm)", ("diameter of the rear crater (mm)",)))
MARKERS = "v^<>PXdhs*"
STEP = 0.045  # between the formulas' markers, of the distance of two shots
LAW_STEP = 0.07  # between the laws of the concrete
LAW_COLORS, LAW_MARKERS = (OURS, PURPLE, ORANGE, GREY), "oDph"


def law_style(laws, law):
    """Returns colour and marker of a law."""
    at = laws.index(law) % len(LAW_COLORS)
    return LAW_COLORS[at], LAW_MARKERS[at]


def short(check):
    """Returns the shot in a few lines, for the foot of a panel."""
    return check.shot.replace(", ", "\n").replace(" of concrete", "")


def said_of(checks, law):
    """Returns what the legend says about the numerical error of a law."""
    return "with its numerical band" if any(check.band for check in checks if check.law == law) else "numerical error not measured"


def panel(axes, title, checks, names, laws):
    """Draws the checks of one panel. names: all formulas of the figure, in the order of their colours; laws: all laws of the
    concrete."""
    tests = list(dict.fromkeys(check.test for check in checks))
    for i, test in enumerate(tests):
        of_test = [check for check in checks if check.test == test]
        first = of_test[0]
        axes.plot(i - 0.2, first.measured, "s", color=EXPERIMENT, markersize=7, zorder=4, clip_on=False)
        if first.scatter:
            axes.errorbar(i - 0.2, first.measured, yerr=first.scatter, fmt="none", color=EXPERIMENT, capsize=4, linewidth=1.3)
        if first.nmap is not None:
            axes.plot(i - 0.13, first.nmap, "x", color=NMAP, markersize=7, zorder=4, clip_on=False)
        for check in of_test:
            if check.computed is not None:
                color, marker = law_style(laws, check.law)
                x = i - 0.05 + LAW_STEP * laws.index(check.law)
                axes.plot(x, check.computed, marker, color=color, markersize=7, zorder=4, clip_on=False)
                error_bars(axes, [(x, check.computed, check.band)], color)
        begin = i + 0.06 + LAW_STEP * (len(laws) - 1)
        for name, (value, inside) in {name: said for check in reversed(of_test) for name, said in check.formulas.items()}.items():
            at = names.index(name)
            color = CYCLE[1 + at % (len(CYCLE) - 2)]
            axes.plot(begin + STEP * at, value, MARKERS[at % len(MARKERS)], color=color, markersize=5,
                      markerfacecolor=color if inside else "none", clip_on=False)
    axes.set_title(title, fontsize=11, loc="left")
    axes.set_xticks(range(len(tests)), [short(next(check for check in checks if check.test == test)) for test in tests], fontsize=8)
    axes.set_xlim(-0.5, max(len(tests) - 0.3, 0.7))
    axes.set_ylim(0, 1.08 * max(1.0, axes.get_ylim()[1]))
    axes.grid(axis="x", visible=False)


def draw(checks):
    """Returns the figure, or None if there is no number to show. checks: one per measured value."""
    panels = [(title, [check for check in checks if check.quantity in quantities]) for title, quantities in PANELS]
    panels = [(title, found) for title, found in panels if found]
    if not panels:
        return None
    laws = laws_of(checks)
    names = list(dict.fromkeys(name for _, found in panels for check in found for name in check.formulas))
    rows = -(-(len(panels) + 1) // 2)  # the last place is that of the legend
    drawn, grid = figure(12.4, 3.8 * rows, rows, 2, squeeze=False)
    places = list(grid.ravel())
    for axes, (title, found) in zip(places, panels):
        panel(axes, title, found, names, laws)
    for axes in places[len(panels):]:
        axes.axis("off")
    handles = [places[0].plot([], [], "s", color=EXPERIMENT, label="measured, with its scatter where published")[0],
               *(places[0].plot([], [], law_style(laws, law)[1], color=law_style(laws, law)[0],
                                label=f"Spall{', ' + law if len(laws) > 1 else ''}, " + said_of(checks, law))[0] for law in laws)]
    if any(check.nmap is not None for check in checks):
        handles.append(places[0].plot([], [], "x", color=NMAP, label="NMAP (paper)")[0])
    handles += [places[0].plot([], [], MARKERS[at % len(MARKERS)], color=CYCLE[1 + at % (len(CYCLE) - 2)], linestyle="",
                               markersize=5, label=name)[0] for at, name in enumerate(names)]
    places[len(panels)].legend(handles=handles, loc="center left", fontsize=10)
    return drawn
