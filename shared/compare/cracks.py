"""Tests whether the radial cracks of a face follow the layout of its points.

Rings and lattices look the same after a quarter turn and in the mirrors x = 0 and x = y. If cracks follow them, the damage
has the same symmetry, and its only harmonics over the angle are cos(4 n angle). Cracks that are independent of the layout
have an eighth of their spectrum there.
"""

import numpy as np

import points
from tables import Table, exit_text, text

# Orders of the harmonics: their cracks are at least 15 degrees apart on average, and several points wide even at the inner
# radius.
ORDERS = np.arange(1, 25)
OF_LAYOUT = 4
# A sum of harmonics below this part of the sum of its terms is round-off.
ROUND_OFF = 1e-9
# The spectrum is taken between these parts of the slab's radius: outside the craters, and inside the zone that the rim
# breaks.
INNER, OUTER = 0.25, 0.9


def harmonics(position, weight, damage, inner, outer, width):
    """Returns sum w (d - mean d of the ring) exp(-i m angle) for every order m, over inner < r < outer, scaled so that the
    squares add up to 1.

    position is n x 2 (m), weight and damage have n values. The mean is taken over rings that are `width` (m) wide, so that
    damage which depends on the radius alone has no harmonics, however the points lie. Returns None if there is no other
    damage.
    """
    radius, angle = np.hypot(*position.T), np.arctan2(position[:, 1], position[:, 0])
    inside = (radius > inner) & (radius < outer)
    if not inside.any():
        return None
    ring = ((radius[inside] - inner) / width).astype(int)
    w, d = weight[inside], damage[inside]
    total = np.bincount(ring, w)
    mean = np.bincount(ring, w * d) / np.where(total > 0, total, 1)
    sums = np.exp(-1j * np.outer(ORDERS, angle[inside])) @ (w * (d - mean[ring]))
    length = np.linalg.norm(sums)
    return sums / length if length > ROUND_OFF * np.abs(w).sum() else None


def of_layout(found):
    """Returns the part of the spectrum, by order, that has the symmetry of the layout."""
    return np.where(ORDERS % OF_LAYOUT == 0, found.real**2, 0)


def chance():
    """Returns mean and standard deviation of the sum of that part if cracks are independent of the layout and of each other:
    harmonics of equal strength and random phase have a beta distribution."""
    layout, others = 0.5 * (ORDERS % OF_LAYOUT == 0).sum(), len(ORDERS)
    mean = layout / others
    return mean, np.sqrt(mean * (1 - mean) / (others + 1))


def ring(frame):
    """Returns the two radii between which the spectrum is taken, m."""
    radius = np.hypot(*frame.initial[:, :2].T).max()
    return INNER * radius, OUTER * radius


def back_face(frame):
    """Returns the harmonics of the tensile damage on the back of a whole slab. Returns None for a part of a slab: symmetry
    planes force their symmetry on the cracks."""
    if "tensile_damage" not in frame.fields or frame.symmetry:
        return None
    size = frame.edges
    layer = points.face_layer(frame.initial, size, False)
    inner, outer = ring(frame)
    return harmonics(frame.initial[layer, :2], size[layer] ** 2, frame.fields["tensile_damage"][layer].astype(float),
                     inner, outer, np.median(size))


def verdict(found):
    """Returns a sentence on whether the cracks follow the layout."""
    share, (mean, deviation) = of_layout(found).sum(), chance()
    words = "they follow it" if share > 0.9 else "they follow it in part" if share > mean + 2 * deviation else \
        "not significantly more than independent cracks: they do not follow it"
    return (f"Radial cracks on the back face: {100 * share:.0f} % of their spectrum has the symmetry of the layout of the points, "
            f"{words} (independent cracks: {100 * mean:.1f} +- {100 * deviation:.1f} %).")


def comparison(slabs):
    """Compares layouts of the points in a table. Returns None unless two whole slabs have cracks."""
    found = [(slab, back_face(slab.frame)) for slab in slabs if slab.frame is not None]
    rows = [[slab.name, slab.inputs.get("Target/Layout", "?"), slab.inputs.get("Target/Jitter", "?"),
             text(100 * of_layout(harmonics).sum(), 0), exit_text(slab)]
            for slab, harmonics in found if harmonics is not None]
    mean, deviation = chance()
    return None if len(rows) < 2 else Table(
        "Radial cracks on the back face and the layout of the points",
        ["result", "layout", "jitter", "of the layout's symmetry (%)", "exit velocity (m/s)"], rows,
        f"Cracks that are independent of the layout have {100 * mean:.1f} +- {100 * deviation:.1f} %.")
