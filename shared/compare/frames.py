"""Reads the points and rigid bodies of the last frame of fields.h5."""

import math
import re
from dataclasses import dataclass, field

import h5py
import numpy as np

import points
from files import Unreadable, attributes
from sealed import is_own, names, opened, values


@dataclass
class Cloud:
    """Points of a further deformable body, such as a projectile or a plate."""

    name: str
    initial: np.ndarray  # n x 3
    position: np.ndarray  # n x 3
    edges: np.ndarray  # n: edge of each point's cell
    fields: dict


@dataclass
class Rigid:
    """A rigid body of revolution: its contour in its own axes, its position and its attitude."""

    name: str
    outline: np.ndarray  # m x 2: z and radius of the contour from tip to tail
    origin: np.ndarray  # 3: origin of the body's axes
    quaternion: np.ndarray  # w, x, y, z: rotation from the body's axes to those of space


@dataclass
class Surface:
    """The surface of a rigid body of any shape, at its place and angle."""

    places: np.ndarray  # n x 3
    triangles: np.ndarray  # m x 3: indices of its corners


@dataclass
class Frame:
    """Points of the main body at one time (the modelled part, without mirror images), and the other bodies."""

    time: float
    initial: np.ndarray  # n x 3
    position: np.ndarray  # n x 3
    volume: np.ndarray  # n
    fields: dict
    geometry: dict  # root attributes: main_body, symmetry_planes, spacing
    bodies: list = field(default_factory=list)  # Cloud
    rigids: list = field(default_factory=list)  # Rigid
    surfaces: list = field(default_factory=list)  # Surface

    @property
    def edges(self):
        """The edge of each point's cell, m."""
        return points.cell_edges(self.symmetry, self.initial, self.volume)

    @property
    def symmetry(self):
        """The symmetry of the model. 'x y': planes of symmetry; 'axis': a half plane of rings; '': the whole body."""
        return self.geometry.get("symmetry_planes", "")


def linked(index, group, name, path):
    """Returns the file and the object that a name of the index `fields.h5` leads to: always one of its own folder `fields`.
    @raises ValueError"""
    link = group.get(name, getlink=True)
    if not isinstance(link, h5py.ExternalLink) or not re.fullmatch(r"fields/(initial|\d{3,9})\.h5", link.filename):
        raise ValueError(f"'{name}' does not lead to a file of the folder 'fields'")
    return path.parent / link.filename, link.path


def bodies_of(index):
    """Returns the names of the bodies in the index."""
    return [name for name in names(index) if name != "frames" and isinstance(index[name], h5py.Group)]


def initial_of(index, path):
    """Returns {body: {name: array}} of what the index says of the start. @raises Unreadable, ValueError"""
    found = {name: {} for name in bodies_of(index)}
    places = {linked(index, index[body], name, path)[0] for body in found for name in index[body]}
    for place in places:
        with opened(place) as start:
            for body, arrays in found.items():
                arrays |= {name: values(start[body], name) for name in index[body]
                           if linked(index, index[body], name, path) == (place, f"/{body}/{name}")}
    return found


def frame_names(index):
    """Returns the names of the frames, in their order. @raises ValueError"""
    return sorted(index["frames"], key=int) if "frames" in index and is_own(index, "frames") else []


def open_frame(index, name, path):
    """Opens a frame of the index. @raises Unreadable, ValueError"""
    return opened(linked(index, index["frames"], name, path)[0])


def read_rigids(start, frame):
    """Returns the rigid bodies that have a contour and a place in this frame."""
    found = []
    for name, arrays in start.items():
        if "outline" not in arrays:
            continue
        numbers = [float(frame.attrs.get(f"{name}_{part}", math.nan)) for part in ("x", "y", "z", "qw", "qx", "qy", "qz")]
        if np.isfinite(numbers).all():
            found.append(Rigid(name, arrays["outline"].astype(float).reshape(-1, 2), np.array(numbers[:3]), np.array(numbers[3:])))
    return found


def read_surfaces(start, group):
    """Returns the surfaces of the rigid bodies of a frame. @raises ValueError"""
    found = []
    for body in names(group):
        if "triangles" not in start.get(body, {}):
            continue
        triangles, places = start[body]["triangles"].astype(np.int64).reshape(-1, 3), values(group[body], "position").astype(float)
        if triangles.size and not 0 <= triangles.min() <= triangles.max() < len(places):
            raise ValueError(f"a triangle of {body} has a corner that is not there")
        if np.isfinite(places).all():
            found.append(Surface(places, triangles))
    return found


def read_points(arrays, group):
    """Returns initial and present positions, volumes and the other fields of a deformable body's points."""
    fields = {name: values(group, name) for name in names(group)}
    return arrays["initial_position"].astype(float), fields.pop("position").astype(float), \
        arrays["volume"].astype(float).ravel(), fields


def one_frame(index, name, path, start, geometry):
    """Returns a frame of the index. start: what initial_of() returns. @raises Unreadable, KeyError, ValueError"""
    main, symmetry = geometry["main_body"], geometry.get("symmetry_planes", "")
    with open_frame(index, name, path) as group:
        bodies = {body: read_points(start[body], group[body]) for body in names(group) if "volume" in start.get(body, {})}
        initial, position, volume, fields = bodies.pop(main)
        clouds = [Cloud(body, *found[:2], points.cell_edges(symmetry, found[0], found[2]), found[3]) for body, found in bodies.items()]
        frame = Frame(float(group.attrs["time"]), initial, position, volume, fields, geometry, clouds, read_rigids(start, group),
                      read_surfaces(start, group))
    if frame.initial.ndim != 2 or frame.initial.shape != frame.position.shape or len(frame.volume) != len(frame.position) or any(
            len(array) != len(frame.position) for array in frame.fields.values()):
        raise Unreadable(f"{path}: arrays of frame {name} differ in length")
    if not (np.isfinite(frame.position).all() and np.isfinite(frame.volume).all()):
        raise Unreadable(f"{path}: places or volumes of frame {name} are not finite")
    return frame


def some_frames(path, most):
    """Yields at most so many frames of fields.h5, evenly spread, the last one included. @raises Unreadable"""
    try:
        with opened(path) as index:
            geometry, found = attributes(index), frame_names(index)
            start = initial_of(index, path) if found else {}
            for i in np.unique(np.linspace(0, len(found) - 1, min(most, len(found))).astype(int)) if found else []:
                yield one_frame(index, found[i], path, start, geometry)
    except (OSError, KeyError, ValueError, TypeError, AttributeError) as error:
        raise Unreadable(f"{path}: {error}") from error


def read_frame(path):
    """Returns the last frame of fields.h5 (None if there is none) and the attributes of the file. @raises Unreadable"""
    try:
        with opened(path) as index:
            geometry, found = attributes(index), frame_names(index)
            return (one_frame(index, found[-1], path, initial_of(index, path), geometry) if found else None), geometry
    except (OSError, KeyError, ValueError, TypeError, AttributeError) as error:
        raise Unreadable(f"{path}: {error}") from error
