"""Pictures of the points of a shot at the last frame: faces and section of the target, its fragments, its cracks."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.colors import BoundaryNorm, ListedColormap, to_rgb

import cracks
import points
from figures_impact import draw_points
from style import CYCLE, figure

# The paper shows damage between these values (its Figs. 13 and 14); smaller damage is drawn as sound concrete.
SHOWN_DAMAGE, SOUND = (0.15, 1.0), "#e9e9e6"
RIGID = dict(facecolor="#b9c4d0", edgecolor="#2c3e50", linewidth=1.2, alpha=0.85, zorder=3)
# Colours of the heaviest fragments, from the heaviest on. Lighter fragments repeat them in a pale shade.
PIECES = ["#d62728", "#1f77b4", "#2ca02c", "#ff7f0e", "#9467bd", "#17becf", "#e377c2", "#8c564b", "#bcbd22", "#393b79"]
LEAST_HEIGHT = 3.2  # inches of a figure of sections: its scales need room
PALE = 0.55  # part of white in a pale shade


def damages(frame):
    """Returns [(name, values)] of the damages that the frame has."""
    return [(label, frame.fields[key].astype(float)) for key, label in (
        ("shear_damage", "shear damage"), ("tensile_damage", "tensile damage")) if key in frame.fields]


def draw_damage(axes, x, y, size, values):
    discs = draw_points(axes, 1e3 * x, 1e3 * y, 1e3 * size, values, SHOWN_DAMAGE, "magma_r")
    discs.cmap = discs.cmap.copy()
    discs.cmap.set_under(SOUND)
    return discs


def draw_discs(axes, x, y, size, color, zorder=1):
    """Draws points as discs of one colour; all lengths are in m."""
    axes.add_collection(EllipseCollection(
        1e3 * size, 1e3 * size, np.zeros(len(size)), units="xy", facecolors=color, linewidths=0,
        offsets=1e3 * np.column_stack([x, y]), transOffset=axes.transData, rasterized=True, zorder=zorder))


def damage_faces(frame):
    """Draws both faces of the whole target with the points at their present places, as far out as there is damage to see."""
    kinds = damages(frame)
    drawn, grid = figure(9.6, 4.7 * len(kinds), len(kinds), 2, squeeze=False)
    layers = [points.face_layer(frame.initial, frame.edges, front) for front in (True, False)]
    reach = 1e3 * faces_reach(frame, np.concatenate(layers))
    for column, (layer, face) in enumerate(zip(layers, ("front face", "back face"))):
        cell = spacing_of(frame, layer)
        for axes, (label, values) in zip(grid[:, column], kinds):
            (now,), (disc, damage) = points.mirrored(frame.symmetry, [frame.position[layer]], [cell, values[layer]],
                                                     frame.edges[layer])
            discs = draw_damage(axes, now[:, 0], now[:, 1], disc, damage)
            axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (mm)", ylabel="y (mm)", title=f"{face}: {label}")
    drawn.colorbar(discs, ax=grid, label="damage", shrink=0.6, pad=0.02)
    return drawn


def faces_reach(frame, layer):
    """Returns how far from the axis the faces are drawn, m: a half farther than the damage that is shown, at most to their
    rims."""
    rim = 1.03 * (np.abs(frame.initial[:, :2]).max() + 0.5 * frame.edges.max())
    seen = np.zeros(len(layer), bool)
    for _, values in damages(frame):
        seen |= values[layer] >= SHOWN_DAMAGE[0]
    return min(rim, 1.5 * np.abs(frame.position[layer[seen], :2]).max()) if seen.any() else rim


def spacing_of(frame, layer):
    """Returns the distance of each point of a face to its nearest neighbour on it: discs of this size neither overlap nor leave
    gaps."""
    plane = frame.initial[layer, :2]
    nearest = np.empty(len(plane))
    for begin in range(0, len(plane), 512):
        block = plane[begin:begin + 512]
        squared = ((block[:, None, :] - plane[None, :, :]) ** 2).sum(axis=2)
        squared[np.arange(len(block)), np.arange(begin, begin + len(block))] = np.inf
        nearest[begin:begin + len(block)] = np.sqrt(squared.min(axis=1))
    return nearest


def section_planes(frame):
    """Returns the planes in which the section is mirrored. Its layer lies on the positive side of y = 0, so only x = 0 is left;
    with rotational symmetry the modelled half plane is half of the section."""
    return "x" if "x" in frame.symmetry.split() or frame.symmetry == "axis" else ""


def section(frame, cloud, layer):
    """Returns points of a body at their present places in the section: x, z, sizes of their discs, and a function that mirrors
    fields in the same way."""
    planes = section_planes(frame)
    (now,), (disc,) = points.mirrored(planes, [cloud.position[layer]], [cloud.edges[layer]])
    return now[:, 0], now[:, 2], disc, lambda values: points.mirrored(planes, [], [values[layer]])[1][0]


def target_section(frame):
    return section(frame, frame, points.section_layer(frame.initial, frame.edges))


def picture_limits(frame):
    """Returns half the width, the lowest and the highest z of a picture of the section, m: it is filled by the target, the other
    bodies and the debris near them, and as wide as needed for that, at most up to the rim of the target."""
    size, z = frame.edges.max(), frame.position[:, 2]
    front, back = frame.initial[:, 2].min() - 0.5 * size, frame.initial[:, 2].max() + 0.5 * size
    outlines = [points.outline_in_section(rigid) for rigid in frame.rigids]
    others = [front, back, *(end for _, y in outlines for end in (y.min(), y.max())),
              *(end for cloud in frame.bodies for end in (cloud.position[:, 2].min(), cloud.position[:, 2].max()))]
    near = 1.5 * (back - front)  # debris that has flown farther is left out
    low, high = (np.clip(end, min(others) - near, max(others) + near) for end in (min(z.min(), *others), max(z.max(), *others)))
    margin = 0.04 * (high - low)
    low, high = low - margin, high + margin
    rim = 1.03 * (np.abs(frame.initial[:, :2]).max() + 0.5 * size)
    widest = 1.2 * max([np.abs(x).max() for x, _ in outlines], default=0.0)
    return max(widest, min(rim, 0.55 * (high - low))), low, high


def show_side(axes, frame, title):
    reach, low, high = picture_limits(frame)
    for rigid in frame.rigids:
        x, z = points.outline_in_section(rigid)
        axes.fill(1e3 * x, 1e3 * z, **RIGID)
    axes.set(xlim=(-1e3 * reach, 1e3 * reach), ylim=(1e3 * high, 1e3 * low), xlabel="x (mm)", title=title)
    axes.set_aspect("equal")
    axes.grid(False)


def others_in_section(frame):
    """Returns (body, section) of the other deformable bodies: of their points that are beside the section now."""
    return [(cloud, section(frame, cloud, points.section_layer(cloud.position, cloud.edges))) for cloud in frame.bodies]


def side_figure(frame, columns):
    reach, low, high = picture_limits(frame)
    drawn, grid = figure(5.8 * columns, max(LEAST_HEIGHT, 5.0 * min(1.8, (high - low) / (2 * reach)) + 0.9), 1, columns, squeeze=False)
    grid[0, 0].set_ylabel("z (mm), flight downwards")
    return drawn, grid


def damage_section(frame):
    """Draws the section through the axis: the layer of points beside y = 0 at their present places, and the other bodies."""
    kinds = damages(frame)
    x, z, disc, mirror = target_section(frame)
    drawn, grid = side_figure(frame, len(kinds))
    for axes, (label, values) in zip(grid[0], kinds):
        for cloud, (other_x, other_z, other_disc, other_mirror) in others_in_section(frame):
            other = dict(damages(cloud)).get(label)
            if other is None:
                draw_discs(axes, other_x, other_z, other_disc, RIGID["facecolor"])
            else:
                draw_damage(axes, other_x, other_z, other_disc, other_mirror(other))
        discs = draw_damage(axes, x, z, disc, mirror(values))
        show_side(axes, frame, f"{label} at {1e3 * frame.time:.2f} ms")
    drawn.colorbar(discs, ax=grid, label="damage", shrink=0.8, pad=0.02)
    return drawn


def piece_colors(number):
    """Returns the colour (n x 3) of each point from the number of its fragment, 1 for the heaviest."""
    colors = np.array([to_rgb(color) for color in PIECES])
    pale = np.where(number > len(PIECES), PALE, 0.0)[:, None]
    return pale + (1 - pale) * colors[(number - 1) % len(PIECES)]


def mark_pieces(drawn, axes, count, masses):
    """Adds the scale of the fragments' colours: number and mass of the heaviest, and the others together."""
    shown = min(count, len(PIECES))
    colors = PIECES[:shown] + (["#d9d9d9"] if count > shown else [])
    scale = ScalarMappable(BoundaryNorm(np.arange(len(colors) + 1), len(colors)), ListedColormap(colors))
    names = [f"{1e3 * masses[k]:.3g}" if k in masses else f"no. {k}" for k in range(1, shown + 1)]
    lighter = [1e3 * masses[k] for k in range(shown + 1, count + 1) if k in masses]
    if count > shown:
        names.append(f"{count - shown} more, pale" + (f",\n{max(lighter):.3g} and less" if lighter else ""))
    bar = drawn.colorbar(scale, ax=axes, label="mass of a fragment (g)" if masses else "fragment", shrink=0.8, pad=0.02)
    bar.set_ticks(np.arange(len(colors)) + 0.5, labels=names, fontsize=8)
    bar.ax.invert_yaxis()
    bar.ax.minorticks_off()


def debris(frame, masses):
    """Draws all fragments from the side, in front of the section of the remaining target (the paper's Fig. 16). masses: kg by
    number of the fragment; may be empty."""
    number = frame.fields["fragment"].astype(int)
    speed = np.linalg.norm(frame.fields["velocity"].astype(float), axis=1)
    flying = np.flatnonzero(number > 0)
    (now,), (disc, piece, speed) = points.mirrored(frame.symmetry, [frame.position[flying]],
                                                   [frame.edges[flying], number[flying], speed[flying]], frame.edges[flying])
    x, z, slab_disc, mirror = target_section(frame)
    left = mirror(number) == 0
    drawn, grid = side_figure(frame, 2)
    drawn.set_figwidth(13.0)  # room for two scales
    for axes, title in zip(grid[0], ("fragments", "speed")):
        draw_discs(axes, x[left], z[left], slab_disc[left], "#d8d4c8")
        for _, (other_x, other_z, other_disc, _) in others_in_section(frame):
            draw_discs(axes, other_x, other_z, other_disc, RIGID["facecolor"])
        show_side(axes, frame, f"{title} at {1e3 * frame.time:.2f} ms")
    front = np.argsort(-now[:, 1], kind="stable")  # nearer ones cover farther ones
    draw_discs(grid[0, 0], now[front, 0], now[front, 2], disc[front], piece_colors(piece[front]), zorder=2)
    if len(piece):
        mark_pieces(drawn, grid[0, 0], number.max(), masses)
    discs = draw_points(grid[0, 1], 1e3 * now[:, 0], 1e3 * now[:, 2], 1e3 * disc, speed,
                        (0, max(1.0, speed.max(initial=0))), "viridis")
    drawn.colorbar(discs, ax=grid[0, 1], label="speed (m/s)", shrink=0.8, pad=0.02)
    return drawn


def crack_spectrum(frame, harmonics):
    """Draws the damage of the back face at the initial places of its points, and the spectrum of its change with the angle."""
    drawn, (plan, bars) = figure(11.5, 5.0, 1, 2)
    layer = points.face_layer(frame.initial, frame.edges, False)
    x, y = frame.initial[layer, :2].T
    discs = draw_damage(plan, x, y, spacing_of(frame, layer), frame.fields["tensile_damage"][layer].astype(float))
    reach = 1.03e3 * np.abs(frame.initial[:, :2]).max()
    turn = np.linspace(0, 2 * np.pi, 200)
    for radius in cracks.ring(frame):
        plan.plot(1e3 * radius * np.cos(turn), 1e3 * radius * np.sin(turn), color=CYCLE[0], linewidth=1.5, linestyle="--", zorder=4)
    plan.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (mm)", ylabel="y (mm)",
             title="tensile damage of the back face")
    drawn.colorbar(discs, ax=plan, label="damage", shrink=0.8, pad=0.02)
    power, layout = np.abs(harmonics) ** 2, cracks.of_layout(harmonics)
    bars.bar(cracks.ORDERS, 100 * layout, color=CYCLE[1], label=f"with the layout's symmetry, {100 * layout.sum():.0f} % in all")
    bars.bar(cracks.ORDERS, 100 * (power - layout), bottom=100 * layout, color=CYCLE[5],
             label=f"without it, {100 * (power - layout).sum():.0f} % in all")
    bars.set(xlabel="harmonic over the angle (cracks around)", ylabel="part of the spectrum (%)", xticks=cracks.ORDERS[3::4],
             title="cracks between the dashed circles", ylim=(0, 1.25 * 100 * power.max()))
    bars.legend(fontsize=9, loc="upper left")
    return drawn
