"""Reads the points and rigid bodies of the last frame of fields.h5."""

import math
from dataclasses import dataclass, field

import h5py
import numpy as np

import points
from files import Unreadable, attributes


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

    @property
    def edges(self):
        """The edge of each point's cell, m."""
        return points.cell_edges(self.symmetry, self.initial, self.volume)

    @property
    def symmetry(self):
        """The symmetry of the model. 'x y': planes of symmetry; 'axis': a half plane of rings; '': the whole body."""
        return self.geometry.get("symmetry_planes", "")


def read_rigids(file, frame):
    """Returns the rigid bodies that have a contour and a place in this frame."""
    found = []
    for name, group in file.items():
        if not isinstance(group, h5py.Group) or "outline" not in group:
            continue
        numbers = [float(frame.attrs.get(f"{name}_{part}", math.nan)) for part in ("x", "y", "z", "qw", "qx", "qy", "qz")]
        if np.isfinite(numbers).all():
            found.append(Rigid(name, group["outline"][:].astype(float).reshape(-1, 2), np.array(numbers[:3]),
                               np.array(numbers[3:])))
    return found


def read_points(body, group):
    """Returns initial and present positions, volumes and the other fields of a deformable body's points."""
    fields = {name: data[:] for name, data in group.items()}
    return body["initial_position"][:].astype(float), fields.pop("position").astype(float), \
        body["volume"][:].astype(float).ravel(), fields


def read_frame(path):
    """Returns the last frame of fields.h5 (None if there is none) and the attributes of the file."""
    try:
        with h5py.File(path, "r") as file:
            geometry = attributes(file)
            names = sorted(file["frames"], key=int) if "frames" in file else []
            if not names:
                return None, geometry
            group, main = file["frames"][names[-1]], geometry["main_body"]
            bodies = {name: read_points(file[name], group[name]) for name in group if "volume" in file[name]}
            initial, position, volume, fields = bodies.pop(main)
            symmetry = geometry.get("symmetry_planes", "")
            clouds = [Cloud(name, *body[:2], points.cell_edges(symmetry, body[0], body[2]), body[3])
                      for name, body in bodies.items()]
            frame = Frame(float(group.attrs["time"]), initial, position, volume, fields, geometry, clouds,
                          read_rigids(file, group))
    except (OSError, KeyError, ValueError) as error:
        raise Unreadable(f"{path}: {error}") from error
    if frame.initial.shape != frame.position.shape or len(frame.volume) != len(frame.position):
        raise Unreadable(f"{path}: arrays of frame {names[-1]} differ in length")
    return frame, geometry
