"""Damage in the section through the axis over time: a figure of a few states, and the data of the page's time slider."""

import base64
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.colors import to_hex

import figures_points
import frames
import points
from style import figure

PRINTED = 4  # states in the figure
MOST_STATES, BYTES = 24, 150_000  # of the slider: fewer states where there are many points
STEPS = 65535  # of a place, which has 16 bits; the largest one: the point is outside of the picture
COLORS = 32  # of the scale of damage
LEVELS, NO_DAMAGE = 254, 255  # of a damage, which has 8 bits; what stands for that of a body without damage
POINT_BYTES = 6  # of a point in a state: x, z of 16 bits, two damages of 8 bits


@dataclass
class State:
    """The section of all deformable bodies at one time: places in mm, sizes of the discs in mm, {name: damage, NaN in bodies without
    damage}, outlines of the rigid bodies."""

    time: float
    x: np.ndarray
    z: np.ndarray
    size: np.ndarray
    damage: dict
    outlines: list
    limits: tuple  # half the width, lowest and highest z of a picture of this state, mm


def state_of(frame):
    target, kinds = figures_points.target_section(frame), figures_points.damages(frame)
    parts = [(*target[:3], {name: target[3](values) for name, values in kinds})]
    for cloud in frame.bodies:
        # The layer is the one that lay in the section at the start: the same points at all times.
        x, z, size, mirror = figures_points.section(frame, cloud, points.section_layer(cloud.initial, cloud.edges))
        own = dict(figures_points.damages(cloud))
        parts.append((x, z, size, {name: mirror(own[name]) if name in own else np.full(len(x), np.nan) for name, _ in kinds}))
    x, z, size = (1e3 * np.concatenate([part[k] for part in parts]) for k in range(3))
    outlines = [tuple(1e3 * end for end in points.outline_in_section(rigid)) for rigid in frame.rigids]
    return State(frame.time, x, z, size, {name: np.concatenate([part[3][name] for part in parts]) for name, _ in kinds},
                 outlines, tuple(1e3 * end for end in figures_points.picture_limits(frame)))


def states_of(path, last):
    """Returns the states of a run, at most MOST_STATES, the first and the last among them. last: its last frame. Returns [] without
    damage or with one frame only. @raises Unreadable"""
    if not figures_points.damages(last):
        return []
    count = max(1, len(state_of(last).x))
    most = int(np.clip(BYTES / (POINT_BYTES * count), PRINTED, MOST_STATES))
    found = [state_of(frame) for frame in frames.some_frames(path, most)]
    found = [state for state in found if state.damage]
    return found if len(found) > 1 else []


def window(states):
    """Returns (half the width, lowest, highest z) in mm of a picture that holds all states."""
    return max(state.limits[0] for state in states), min(state.limits[1] for state in states), max(state.limits[2] for state in states)


def draw(states):
    """Draws the larger damage at a few times side by side."""
    chosen = states if len(states) <= PRINTED else [states[i] for i in np.linspace(0, len(states) - 1, PRINTED + 1).astype(int)[1:]]
    half, low, high = window(states)
    tall = max(figures_points.LEAST_HEIGHT, 3.0 * (high - low) / (2 * half) + 1)
    drawn, row = figure(3.1 * len(chosen) + 1, tall, 1, len(chosen), squeeze=False)
    for axes, state in zip(row[0], chosen):
        damage = np.fmax.reduce(list(state.damage.values()))
        x, z, size, known = 1e-3 * state.x, 1e-3 * state.z, 1e-3 * state.size, np.isfinite(damage)
        figures_points.draw_discs(axes, x[~known], z[~known], size[~known], figures_points.RIGID["facecolor"])
        discs = figures_points.draw_damage(axes, x[known], z[known], size[known], damage[known])
        for x, z in state.outlines:
            axes.fill(x, z, **figures_points.RIGID)
        axes.set(xlim=(-half, half), ylim=(high, low), xlabel="x (mm)", title=f"{1e3 * state.time:.2f} ms")
    row[0][0].set_ylabel("z (mm), flight downwards")
    drawn.colorbar(discs, ax=row[0].tolist(), label="damage, the larger one", shrink=0.8, pad=0.02)
    return drawn


def packed(state, half, low, high, names):
    """Returns a state as base64 text: x, then z (16 bits each, little endian, over the picture), then each damage (8 bits: LEVELS, or
    NO_DAMAGE)."""
    across, down = (state.x + half) / (2 * half), (state.z - low) / (high - low)
    inside = (across >= 0) & (across <= 1) & (down >= 0) & (down <= 1)
    places = [np.where(inside, np.clip(values, 0, 1) * (STEPS - 1), STEPS).astype("<u2").tobytes() for values in (across, down)]
    levels = [np.where(np.isnan(values), NO_DAMAGE, np.rint(LEVELS * np.nan_to_num(values).clip(0, 1))).astype("u1").tobytes()
              for values in (state.damage[name] for name in names)]
    return base64.b64encode(b"".join([*places, *levels])).decode()


def data(states):
    """Returns what the slider draws (page/page.js): lengths in mm, times in ms."""
    half, low, high = window(states)
    names = [name for name in states[-1].damage if all(name in state.damage for state in states)]
    scale = matplotlib.colormaps["magma_r"](np.linspace(0, 1, COLORS))
    return {"half": round(half, 1), "low": round(low, 1), "high": round(high, 1), "names": names, "count": len(states[-1].x),
            "shown": figures_points.SHOWN_DAMAGE, "sound": figures_points.SOUND, "steel": figures_points.RIGID["facecolor"],
            "colors": [to_hex(color) for color in scale],
            "sizes": [float(f"{size:.3g}") for size in states[-1].size],
            "states": [{"time": float(f"{1e3 * state.time:.4g}"), "points": packed(state, half, low, high, names),
                        "outlines": [[np.round(end, 1).tolist() for end in outline] for outline in state.outlines]}
                       for state in states]}
