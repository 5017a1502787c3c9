"""Reads the .pvd and .vtu files that the microcell writes for ParaView. Errors are ValueError."""

import pathlib
import xml.etree.ElementTree as xml

import meshio


def read_quadrilaterals(path):
    """Returns the macroscopic strain, points (n x 2), corners (m x 4) and point data of a mesh of quadrilaterals."""
    try:
        mesh = meshio.vtu.read(path)
        strain = float(mesh.field_data["macroscopic_strain"].ravel()[0])
        return strain, mesh.points[:, :2], mesh.cells_dict["quad"], {name: data.squeeze() for name, data in mesh.point_data.items()}
    except Exception as error:  # meshio promises no kind of error for a damaged file
        raise ValueError(f"no mesh of quadrilaterals that can be read: {type(error).__name__}: {error}") from error


def series(record):
    """Returns [(row of curve.csv, path)] of a .pvd file in ascending order."""
    try:
        sets = xml.parse(record).getroot().iter("DataSet")
        found = sorted((float(s.get("timestep")), s.get("file")) for s in sets)
        if outside := [name for _, name in found if pathlib.PurePath(name).name != name]:
            raise ValueError(f"'{outside[0]}' is no file of the same folder")
        return [(row, record.parent / name) for row, name in found]
    except (OSError, xml.ParseError, TypeError) as error:
        raise ValueError(f"no series of files that can be read: {error}") from error
