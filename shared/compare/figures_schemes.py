"""The figure of one bar computed by several integration schemes: bent columns of points show hourglass modes."""

import numpy as np

from style import figure


def slice_of(frame):
    """Returns (radius, height, index) of one column of points per ring, from the axis outwards and from the foot upwards: of
    each ring the column nearest to 45 degrees. Returns None for points that are not on rings."""
    initial = frame.initial.astype(float)
    grain = 1e-2 * np.cbrt(frame.volume.min())  # positions are in single precision, so smaller differences count as equal
    ring = np.round(np.hypot(initial[:, 0], initial[:, 1]) / grain)
    columns = []
    for radius in np.unique(ring):
        members = np.flatnonzero(ring == radius)
        angle = np.round(np.abs(np.arctan2(initial[members, 1], initial[members, 0]) - np.pi / 4), 4)
        column = members[angle == angle.min()]
        # Two columns can be equally near to 45 degrees; the first one is taken.
        first = column[np.argsort(np.round(np.arctan2(initial[column, 1], initial[column, 0]), 4), kind="stable")]
        _, unique = np.unique(np.round(initial[first, 2] / grain), return_index=True)
        columns.append(first[unique])
    if len({len(column) for column in columns}) != 1:
        return None
    index = np.array(columns)
    return np.hypot(frame.position[index, 0], frame.position[index, 1]), frame.position[index, 2], index


def comparable(bars):
    """Returns groups of bars of one material and speed that were computed by more than one scheme and have points on rings."""
    groups = {}
    for bar in bars:
        if bar.frame is not None and "plastic_strain" in bar.frame.fields and slice_of(bar.frame) is not None:
            key = (bar.number("impact_velocity"), bar.number("points"), bar.has_anvil)
            groups.setdefault(key, []).append(bar)
    return [group for group in groups.values() if len({bar.summary.get("scheme") for bar in group}) > 1]


def foot_columns(bars):
    """Draws the lower part of each bar, with lines along the columns and layers that were straight at the start."""
    drawn, all_axes = figure(4.2 * len(bars) + 1, 4.2, 1, len(bars), squeeze=False, sharey=True)
    strains = np.concatenate([bar.frame.fields["plastic_strain"] for bar in bars])
    limits = (0, float(np.quantile(strains, 0.99)))
    reach = max(slice_of(bar.frame)[0].max() for bar in bars)
    for axes, bar in zip(all_axes[0], bars):
        radius, height, index = slice_of(bar.frame)
        low = height[:, 0].min()
        lines = {"color": "0.6", "linewidth": 0.7, "zorder": 1}
        axes.plot(1e3 * radius.T, 1e3 * (height.T - low), **lines)
        axes.plot(1e3 * radius, 1e3 * (height - low), **lines)
        dots = axes.scatter(1e3 * radius, 1e3 * (height - low), c=bar.frame.fields["plastic_strain"][index], s=14,
                            cmap="viridis", vmin=limits[0], vmax=limits[1], zorder=2, linewidths=0)
        rough = bar.number("plastic_strain_saw_tooth")
        note = "" if rough is None else f"saw-tooth of the plastic strain {rough:.3f}"
        axes.set(xlim=(0, 1.05e3 * reach), ylim=(-0.2, 6.0), xlabel="radius (mm)",
                 title=f"{bar.summary.get('scheme', bar.name)}\n{note}".strip())
        axes.set_aspect("equal")
        axes.grid(False)
    all_axes[0][0].set_ylabel("height (mm)")
    drawn.colorbar(dots, ax=list(all_axes[0]), label="plastic strain", shrink=0.8)
    return drawn
