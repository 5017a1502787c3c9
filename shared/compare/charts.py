"""Data of the interactive charts of the page: the lines of a figure, and a chart of a shot whose axes the reader chooses.

All numbers are those of the figures, in the units of their axes; lines have as many corners as the eye can tell apart."""

import numpy as np
from matplotlib.colors import to_hex

import figures_shot
from tables_slabs import projectile_mass

DIGITS = 4  # of a value
TOLERANCE = 1.5e-3  # of the height of a chart: a line that is simplified stays within it, about a pixel
MOST_ROWS = 400  # of the explorer
DASHES = {"-": [], "--": [7, 4], "-.": [7, 3, 2, 3], ":": [2, 3], "None": None}


def rounded(values, digits=DIGITS):
    """Returns numbers with this many significant digits; None where there is no number."""
    return [float(f"{value:.{digits}g}") if np.isfinite(value) else None for value in values]


def corners(x, y):
    """Returns the indices of the points that a line through x, y needs to stay within TOLERANCE of itself; x, y: over the size of
    the chart."""
    keep, parts = {0, len(x) - 1}, [(0, len(x) - 1)]
    while parts:
        first, last = parts.pop()
        if last - first < 2:
            continue
        dx, dy = x[last] - x[first], y[last] - y[first]
        px, py = x[first + 1:last] - x[first], y[first + 1:last] - y[first]
        length = np.hypot(dx, dy)
        far = np.abs(px * dy - py * dx) / length if length > 0 else np.hypot(px, py)
        worst = int(np.argmax(far))
        if far[worst] > TOLERANCE:
            middle = first + 1 + worst
            keep.add(middle)
            parts += [(first, middle), (middle, last)]
    return np.array(sorted(keep))


def scaled(values, limits, log):
    """Returns values over the length of their axis; a logarithmic axis in decades."""
    low, high = limits
    if log:
        values, low, high = np.log10(np.maximum(values, 1e-300)), np.log10(low), np.log10(high)
    return (values - low) / ((high - low) or 1)


def line_of(axes, line):
    """Returns a line of a figure; a line across all of the axes ends at their limits."""
    x, y = (np.asarray(values, dtype=float) for values in line.get_data(orig=False))
    if line.get_transform() == axes.get_yaxis_transform():
        x = np.array(axes.get_xlim())
    elif line.get_transform() == axes.get_xaxis_transform():
        y = np.array(axes.get_ylim())
    log = axes.get_xscale() == "log", axes.get_yscale() == "log"
    fine = np.isfinite(x) & np.isfinite(y) & ((x > 0) | (not log[0])) & ((y > 0) | (not log[1]))
    x, y = x[fine], y[fine]
    marker = line.get_marker() not in (None, "None", "", " ")
    if len(x) > 2 and not marker:
        kept = corners(scaled(x, axes.get_xlim(), log[0]), scaled(y, axes.get_ylim(), log[1]))
        x, y = x[kept], y[kept]
    label = str(line.get_label())
    return {"label": "" if label.startswith("_") else label, "color": to_hex(line.get_color()), "marker": marker,
            "dash": DASHES.get(line.get_linestyle(), []), "x": rounded(x), "y": rounded(y)}


def of_axes(axes):
    """Returns the chart of one pair of axes; None if it shows more than lines, or no line worth reading off."""
    pictures = axes.get_aspect() != "auto" or axes.patches or axes.images or hasattr(axes, "_colorbar")
    lines = [line for line in axes.lines if line.get_gid() != "cut axis" and len(line.get_xdata())]
    if pictures or not any(len(line.get_xdata()) > 2 for line in lines):
        return None
    return {"title": axes.get_title() or axes.get_title(loc="left"), "x": axes.get_xlabel(), "y": axes.get_ylabel(),
            "log": [axes.get_xscale() == "log", axes.get_yscale() == "log"], "range": [rounded(axes.get_xlim(), 6),
                                                                                     rounded(axes.get_ylim(), 6)],
            "lines": [found for found in (line_of(axes, line) for line in lines) if found["x"]]}


def of_figure(drawn):
    """Returns the charts of a figure, one for each pair of axes; none if a part of it is more than lines, as filled layers are."""
    found = [of_axes(axes) for axes in drawn.axes]
    return [] if None in found else found


def explorer(slab):
    """Returns the columns of a chart of a shot: time and depth to choose from for one axis; velocity, force and energies for the
    other. None without a history."""
    history = slab.history
    if history is None or "projectile_velocity" not in history or len(history["time"]) < 3:
        return None
    face, mass, radius = slab.number("struck_face"), projectile_mass(slab), slab.number("projectile_radius")
    time, position, velocity = history["time"], history["projectile_position"], history["projectile_velocity"]
    rows = np.unique(np.linspace(0, len(time) - 1, min(MOST_ROWS, len(time))).astype(int))
    depth = position - (face if face is not None else position[0])
    across = [("time (ms)", 1e3 * time)]
    across.append(("depth of the tip (mm)" if face is not None else "path of the projectile (mm)", 1e3 * depth))
    up = [("velocity of the projectile (m/s)", velocity)]
    if None not in (mass, radius):
        at, force = figures_shot.mean_force(time, depth, velocity, mass, figures_shot.MEAN_PATH * radius)
        if len(at) > 1 and np.all(np.diff(depth) >= 0):
            up.append(("force on the projectile (kN)", 1e-3 * np.interp(depth, at, force)))
    up += [(words, 1e-3 * history[key]) for key, words in (
        ("projectile_kinetic_energy", "kinetic energy of the projectile (kJ)"), ("kinetic_energy", "kinetic energy of the target (kJ)"),
        ("internal_energy", "internal energy (kJ)"), ("friction_work", "work of friction (kJ)")) if key in history]
    return {"name": slab.name, "across": [{"label": label, "values": rounded(values[rows])} for label, values in across],
            "up": [{"label": label, "values": rounded(values[rows])} for label, values in up]}
