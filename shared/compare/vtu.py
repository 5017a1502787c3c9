"""Reads the .pvd and .vtu files that the microcell writes for ParaView. Errors are ValueError."""

import base64
import pathlib
import struct
import xml.etree.ElementTree as xml
import zlib

import numpy as np

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "<u1", "UInt32": "<u4",
         "UInt64": "<u8"}


def decode(element):
    """Returns the values of a DataArray, which are zlib blocks behind a header of their sizes, in base64."""
    text = "".join(element.text.split())
    count = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    header_length = 4 * -(-4 * (3 + count) // 3)  # base64 rounds up to three bytes
    sizes = struct.unpack(f"<{3 + count}I", base64.b64decode(text[:header_length])[:4 * (3 + count)])[3:]
    packed, raw, at = base64.b64decode(text[header_length:]), b"", 0
    for size in sizes:
        raw += zlib.decompress(packed[at:at + size])
        at += size
    values = np.frombuffer(raw, TYPES[element.get("type")])
    components = int(element.get("NumberOfComponents", "1"))
    return values.reshape(-1, components) if components > 1 else values


def read_quadrilaterals(path):
    """Returns the macroscopic strain, points (n x 2), corners (m x 4) and point data of a mesh of quadrilaterals."""
    try:
        grid = xml.parse(path).getroot().find("UnstructuredGrid")
        strain = float(grid.find("FieldData/DataArray[@Name='macroscopic_strain']").text)
        piece = grid.find("Piece")
        points = decode(piece.find("Points/DataArray"))[:, :2]
        cells = {a.get("Name"): decode(a) for a in piece.find("Cells")}
        data = {a.get("Name"): decode(a) for a in piece.find("PointData")}
        return strain, points, cells["connectivity"].reshape(-1, 4), data
    except (OSError, AttributeError, KeyError, TypeError, IndexError, struct.error, zlib.error, xml.ParseError) as error:
        raise ValueError(f"no mesh of quadrilaterals that can be read: {error}") from error


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
