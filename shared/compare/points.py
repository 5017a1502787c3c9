"""Geometry of the points and bodies in a picture."""

import numpy as np


def mirrored(planes, vectors, scalars, edges=None):
    """Returns points and their images in the symmetry planes ('x y': x = 0 and y = 0) or around the z axis ('axis').

    vectors: arrays n x 3 whose normal component changes sign; scalars: arrays of n. Points of a half plane
    represent rings: `edges` (n) is the distance between the images on a ring.
    """
    if planes == "axis":
        return turned(vectors, scalars, edges)
    for axis in planes.split():
        sign = np.ones(3)
        sign["xyz".index(axis)] = -1.0
        vectors = [np.concatenate([v, v * sign]) for v in vectors]
        scalars = [np.concatenate([s, s]) for s in scalars]
    return vectors, scalars


def turned(vectors, scalars, edges):
    """Repeats each point around the z axis at equal gaps of about its edge. The first of the vectors are the positions."""
    count = np.maximum(1, np.rint(2 * np.pi * np.hypot(vectors[0][:, 0], vectors[0][:, 1]) / edges)).astype(int)
    index = np.repeat(np.arange(len(count)), count)
    angle = 2 * np.pi * (np.arange(len(index)) - np.repeat(np.cumsum(count) - count, count)) / count[index]
    c, s = np.cos(angle), np.sin(angle)
    around = [np.column_stack([c * v[index, 0] - s * v[index, 1], s * v[index, 0] + c * v[index, 1], v[index, 2]])
              for v in vectors]
    return around, [values[index] for values in scalars]


def cell_edges(planes, initial, volume):
    """Returns the edge of each point's cell, m. With rotational symmetry ('axis') the volume of a point is that of its ring, so
    the edge is that of the ring's cross section."""
    return np.sqrt(volume / (2 * np.pi * np.maximum(initial[:, 0], 1e-12))) if planes == "axis" else np.cbrt(volume)


def face_layer(initial, size, front):
    """Returns the indices of the points that lay in the layer at the lower face (front) or at the upper one.

    The slab is cut into columns about 1.5 points wide and the outermost points of each are taken, so graded
    and unstructured layouts need no special case. size: edge of each point's cell.
    """
    z = initial[:, 2] if front else -initial[:, 2]
    width = 1.5 * np.quantile(size, 0.9)
    cell = np.floor(initial[:, :2] / width).astype(np.int64)
    cell -= cell.min(axis=0)
    column = cell[:, 0] * (cell[:, 1].max() + 1) + cell[:, 1]
    outermost = np.full(column.max() + 1, np.inf)
    np.minimum.at(outermost, column, z)
    return np.flatnonzero(z < outermost[column] + 0.5 * size)


def section_layer(initial, size):
    """Returns the indices of the points that lay in the first layer beside the plane y = 0, on its positive side."""
    return np.flatnonzero((initial[:, 1] >= -1e-9) & (initial[:, 1] < 0.75 * size))


def axes_of(quaternion):
    """Returns the matrix 3 x 3 that turns a body's axes into those of space, from the quaternion w, x, y, z."""
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def outline_in_section(rigid):
    """Returns the closed outline (x, z) of a rigid body of revolution at its place and angle, seen along y: the contour on
    both sides of its axis."""
    axis = axes_of(rigid.quaternion)[:, 2]
    across = np.cross([0.0, 1.0, 0.0], axis)
    across /= np.linalg.norm(across)
    z, r = rigid.outline.T
    sides = np.concatenate([r, -r[::-1]])
    outline = rigid.origin + np.outer(np.concatenate([z, z[::-1]]), axis) + np.outer(sides, across)
    return outline[:, 0], outline[:, 2]
