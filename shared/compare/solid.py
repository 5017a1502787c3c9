"""The whole body in space at the last frame: a picture of it, and the data of the view that turns in the page (page/solid.js)."""

import base64
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_hex, to_rgb

import figures_points
import points
from figures_points import SHOWN_DAMAGE, SOUND
from style import figure

MOST_POINTS, MOST_TRIANGLES = 40_000, 10_000  # of the data: 0.4 MB; the page has less than 3 MB in all
SPHERE = (3 / (4 * np.pi)) ** (1 / 3)  # radius over edge of a sphere as large as a cube
STEPS, LEVELS = 65535, 254  # of a place (16 bits) and of a radius or a damage (8 bits)
NO_DAMAGE = 255  # stands for the damage of a body that has none
COLORS = 32  # of the scale of damage
STEEL = "#8795a5"
ROOM = 1.2  # across: the picture is as wide as the bodies were at the start, times this
# The first view: shots fly to the right, seen from the side and from behind, as in shared/view. Where nothing has come through, the
# struck face is seen.
BEHIND, BEFORE, UP = np.array([-0.35, 0.75, -0.95]), np.array([-0.35, 0.75, 0.95]), np.array([-1.0, 0.0, 0.0])
LIGHT = np.array([-0.39, 0.49, 0.78])  # from where light comes: right, up, towards the reader
WIDTH, HEIGHT = 750, 600  # pixels of the picture
ARROW = 100  # pixels of the direction of flight, seen from across


@dataclass
class Scene:
    """What is shown, in mm: points of all deformable bodies (the modelled part), and the surfaces of rigid ones."""

    places: np.ndarray  # n x 3
    radius: np.ndarray  # n
    damage: np.ndarray  # n: the larger one, or NaN in a body without damage
    symmetry: str
    surfaces: list  # (places m x 3, triangles k x 3)
    time: float  # s
    ahead: np.ndarray  # 3: direction of the first view
    words: str  # on what is not shown as it is


def largest_damage(cloud):
    found = figures_points.damages(cloud)
    return np.max([values for _, values in found], axis=0) if found else np.full(len(cloud.position), np.nan)


def perforated(frame):
    """Returns whether a body reaches beyond the back of the target, a deformable one that was before it at the start."""
    back = frame.initial[:, 2].max()
    return any(surface.places[:, 2].max() > back for surface in frame.surfaces) or any(
        cloud.initial[:, 2].min() < 0 and cloud.position[:, 2].max() > back for cloud in frame.bodies)


def thinned(chosen, most):
    """Returns at most so many of the chosen points, by chance but always the same, and the factor of their radius."""
    if len(chosen) <= most:
        return chosen, 1.0
    kept = np.sort(np.random.default_rng(1).permutation(chosen)[:most])
    return kept, (len(chosen) / max(1, most)) ** (1 / 3)


def scene_of(frame):
    """Returns the scene of a frame that has damage."""
    clouds = [frame, *frame.bodies]
    place, edge = (np.concatenate([getattr(cloud, name) for cloud in clouds]) for name in ("position", "edges"))
    damage = np.concatenate([largest_damage(cloud) for cloud in clouds])
    _, low, high = figures_points.picture_limits(frame)
    wide = ROOM * max(np.hypot(*cloud.initial[:, :2].T).max() for cloud in clouds)
    inside = (place[:, 2] > low) & (place[:, 2] < high) & (np.hypot(place[:, 0], place[:, 1]) < wide)
    words = []
    if not inside.all():
        words.append(f"{(~inside).sum()} of {len(place)} computed points have flown farther and are left out")
    shown = damage >= SHOWN_DAMAGE[0]
    damaged, more = thinned(np.flatnonzero(inside & shown), MOST_POINTS)
    sound, larger = thinned(np.flatnonzero(inside & ~shown), MOST_POINTS - len(damaged))
    for kept, factor, what in ((damaged, more, "damaged"), (sound, larger, "sound")):
        if factor > 1:
            words.append(f"{len(kept)} of {round(len(kept) * factor**3)} {what} points are shown, each as much larger")
    chosen, factor = np.concatenate([damaged, sound]), np.repeat([more, larger], [len(damaged), len(sound)])
    surfaces = [(1e3 * surface.places, surface.triangles) for surface in frame.surfaces if len(surface.triangles) <= MOST_TRIANGLES]
    if len(surfaces) < len(frame.surfaces):
        words.append(f"surfaces of more than {MOST_TRIANGLES} triangles are left out")
    return Scene(1e3 * place[chosen], 1e3 * SPHERE * edge[chosen] * factor, damage[chosen], frame.symmetry, surfaces, frame.time,
                 BEHIND if perforated(frame) else BEFORE, "; ".join(words))


def encoded(values):
    return base64.b64encode(np.ascontiguousarray(values).tobytes()).decode()


def steps(places, low, high):
    """Returns places as whole numbers of 16 bits, little endian, over a box."""
    return np.rint((places - low) / np.maximum(high - low, 1e-9) * STEPS).clip(0, STEPS).astype("<u2")


def data(scene):
    """Returns what the page draws (page/solid.js): a box in mm, places over it, radii over the largest one, damage."""
    everything = np.concatenate([scene.places, *(places for places, _ in scene.surfaces)])
    low, high = everything.min(axis=0), everything.max(axis=0)
    levels = np.where(np.isnan(scene.damage), NO_DAMAGE, np.rint(LEVELS * np.nan_to_num(scene.damage).clip(0, 1))).astype("u1")
    radii, largest = scene.radius, scene.radius.max()
    colors = [to_hex(color) for color in matplotlib.colormaps["magma_r"](np.linspace(0, 1, COLORS))]
    return {"low": np.round(low, 2).tolist(), "high": np.round(high, 2).tolist(), "symmetry": scene.symmetry,
            "time": float(f"{1e3 * scene.time:.4g}"), "places": encoded(steps(scene.places, low, high)),
            "largest": float(f"{largest:.4g}"), "radius": encoded(np.rint(LEVELS * radii / largest).clip(1, LEVELS).astype("u1")),
            "damage": encoded(levels), "shown": SHOWN_DAMAGE, "sound": SOUND, "steel": STEEL,
            "colors": colors, "sphere": round(SPHERE, 4), "view": np.round(axes_of_view(scene), 5).tolist(), "light": LIGHT.tolist(),
            "surfaces": [{"places": encoded(steps(places, low, high)), "triangles": encoded(triangles.astype("<u2"))}
                         for places, triangles in scene.surfaces]}


def axes_of_view(scene):
    """Returns the first view's axes as rows: right, up, towards the reader."""
    ahead = scene.ahead / np.linalg.norm(scene.ahead)
    right = np.cross(ahead, UP) / np.linalg.norm(np.cross(ahead, UP))
    return np.array([right, np.cross(right, ahead), -ahead])


def colors_of(damage):
    scale = matplotlib.colormaps["magma_r"].copy()
    scale.set_under(SOUND)
    return np.where(np.isnan(damage)[:, None], to_rgb(STEEL), scale(Normalize(*SHOWN_DAMAGE)(np.nan_to_num(damage)))[:, :3])


def spheres(places, radius, colors):
    """Yields the pixels of spheres: columns, rows, heights towards the reader, colours. All lengths are in pixels."""
    whole = np.maximum(1, np.rint(radius)).astype(int)
    for r in np.unique(whole):
        same = np.flatnonzero(whole == r)
        line = np.arange(-r, r + 1)
        dx, dy = (grid.ravel() for grid in np.meshgrid(line, line))
        inside = dx**2 + dy**2 <= r * r
        dx, dy = dx[inside], dy[inside]
        normal = np.column_stack([dx, dy, np.sqrt(r * r - dx**2 - dy**2)]) / r
        lit = np.maximum(normal @ LIGHT, 0)
        yield ((np.rint(places[same, 0])[:, None] + dx).ravel(), (np.rint(places[same, 1])[:, None] + dy).ravel(),
               (places[same, 2][:, None] + r * normal[:, 2]).ravel(),
               (colors[same][:, None, :] * (0.45 + 0.55 * lit)[None, :, None] + 0.2 * (lit**8)[None, :, None]).reshape(-1, 3))


def surface(places, triangles):
    """Yields the pixels of triangles, as spheres() does."""
    for a, b, c in places[triangles]:
        normal = np.cross(b - a, c - a)
        size = np.linalg.norm(normal)
        if size == 0:
            continue
        count = int(np.ceil(1.5 * max(np.linalg.norm(b - a), np.linalg.norm(c - a), np.linalg.norm(c - b)))) + 1
        u, v = (grid.ravel() / count for grid in np.meshgrid(np.arange(count + 1), np.arange(count + 1)))
        u, v = u[u + v <= 1], v[u + v <= 1]
        inside = a + u[:, None] * (b - a) + v[:, None] * (c - a)
        lit = max(0.0, float(normal @ LIGHT) / size * np.sign(normal[2] or 1.0))
        color = np.array(to_rgb(STEEL)) * (0.45 + 0.55 * lit) + 0.2 * lit**8
        yield np.rint(inside[:, 0]), np.rint(inside[:, 1]), inside[:, 2], np.tile(color, (len(u), 1))


def rendered(scene):
    """Returns the first view as an array of colours HEIGHT x WIDTH x 3, and the pixels of a mm."""
    (places,), (radius, damage) = points.mirrored(scene.symmetry, [scene.places], [scene.radius, scene.damage], scene.radius / SPHERE)
    view = axes_of_view(scene)
    places, shapes = places @ view.T, [(corners @ view.T, triangles) for corners, triangles in scene.surfaces]
    everything = np.concatenate([places, *(corners for corners, _ in shapes)])
    low, high = everything.min(axis=0) - radius.max(), everything.max(axis=0) + radius.max()
    scale = min(WIDTH / (high[0] - low[0]), HEIGHT / (high[1] - low[1]))
    shift = np.array([WIDTH / 2, HEIGHT / 2, 0]) - scale * np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 0])
    pixels = [*spheres(scale * places + shift, scale * radius, colors_of(damage))]
    for corners, triangles in shapes:
        pixels += surface(scale * corners + shift, triangles)
    column, row, height, color = (np.concatenate(part) for part in zip(*pixels))
    inside = (column >= 0) & (column < WIDTH) & (row >= 0) & (row < HEIGHT)
    column, row, height, color = column[inside].astype(int), row[inside].astype(int), height[inside], color[inside]
    order = np.argsort(height, kind="stable")  # nearer ones come later and cover farther ones
    picture = np.ones((HEIGHT, WIDTH, 3))
    picture[row[order], column[order]] = color[order].clip(0, 1)
    return picture, scale


def length_of_bar(scale):
    """Returns a round length, mm, of about a sixth of the picture."""
    longest = WIDTH / 6 / scale
    power = 10.0 ** np.floor(np.log10(longest))
    return max(step * power for step in (1, 2, 5) if step * power <= longest)


def draw(scene):
    """Draws the whole body as the page shows it first."""
    picture, scale = rendered(scene)
    drawn, axes = figure(7.4, 5.2)
    axes.imshow(picture, origin="lower", interpolation="none")
    axes.axis("off")
    bar = length_of_bar(scale)
    axes.plot([8, 8 + bar * scale], [12, 12], color="black", linewidth=3, solid_capstyle="butt")
    axes.text(8 + bar * scale / 2, 20, f"{bar:g} mm", ha="center", va="bottom")
    flight = axes_of_view(scene)[:2, 2]
    axes.annotate("", (10 + ARROW * flight[0], HEIGHT - 80 + ARROW * flight[1]), (10, HEIGHT - 80), arrowprops={"arrowstyle": "->"})
    axes.text(10, HEIGHT - 80 - np.sign(flight[1]) * 12, "flight", va="top" if flight[1] > 0 else "bottom")
    axes.set_title(f"{1e3 * scene.time:.2f} ms")
    scaled = ScalarMappable(Normalize(*SHOWN_DAMAGE), "magma_r")
    drawn.colorbar(scaled, ax=axes, label="damage, the larger one", shrink=0.7, pad=0.02)
    return drawn
