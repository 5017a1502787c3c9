"""What is to be shown of a result folder: files, bodies, colours, symmetry, magnification. Needs no ParaView."""

import pathlib
import sys
import xml.etree.ElementTree as xml

import matplotlib
import numpy as np
from matplotlib.colors import to_rgb

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

import vtu  # noqa: E402
from figures_points import SHOWN_DAMAGE, SOUND  # noqa: E402
from files import Unreadable, attributes, read_numbers  # noqa: E402
from sealed import opened  # noqa: E402

KINDS = {"polyvertex": "points", "triangle": "surface", "polyline": "lines"}
DAMAGES = ("tensile_damage", "shear_damage", "damage")
# Fields by which points are coloured, the first that a body has: (name, title of its scale).
OTHERS = (("plastic_strain", "plastic strain"), ("equivalent_stress", "equivalent stress (Pa)"))
COLORS, STEP = 17, 1e-6  # nodes of the scale; the smallest distance between two
SHARE = 0.15  # of the cell's size that the largest magnified displacement of a microcell takes


def bodies_of(record):
    """Returns the bodies of fields.xdmf in the order of its blocks: name, kind and fields. @raises Unreadable"""
    try:
        grids = xml.parse(record).getroot().findall("Domain/Grid/Grid")
        if not grids:
            raise ValueError("it has no frame")
        return [{"name": grid.get("Name"), "kind": KINDS.get(grid.find("Topology").get("TopologyType").lower(), "lines"),
                 "fields": [field.get("Name") for field in grid.findall("Attribute")]} for grid in grids[-1].findall("Grid")]
    except (OSError, xml.ParseError, AttributeError, ValueError) as error:
        raise Unreadable(f"{record}: no frames of bodies that can be read: {error}") from error


def scale(low=0.0):
    """Returns the colours of the report's pictures as ParaView takes them: value, red, green, blue, and so on, for values from 0 to 1.
    Below `low` points have the colour of sound concrete."""
    nodes = [(0.0, to_rgb(SOUND)), (low - STEP, to_rgb(SOUND))] if low else []
    nodes += [(low + (1 - low) * share, matplotlib.colormaps["magma_r"](share)[:3]) for share in np.linspace(0, 1, COLORS)]
    return [float(number) for value, colour in nodes for number in (value, *colour)]


def colour_of(bodies):
    """Returns what points are coloured by: fields whose largest value counts, the title of the scale, its fixed range, and its colours."""
    found = {name for body in bodies if body["kind"] == "points" for name in body["fields"]}
    damages = [name for name in DAMAGES if name in found]
    if damages:
        return {"fields": damages, "title": "damage", "range": [0, 1], "scale": scale(SHOWN_DAMAGE[0])}
    for name, title in OTHERS:
        if name in found:
            return {"fields": [name], "title": title, "range": None, "scale": scale()}
    return {"fields": [], "title": "", "range": None, "scale": scale()}


def plan_of_run(folder):
    """Returns what to show of a run of penetrate. @raises Unreadable"""
    record, index = folder / "fields.xdmf", folder / "fields.h5"
    with opened(index) as file:
        symmetry = attributes(file).get("symmetry_planes", "").split()
    bodies = bodies_of(record)
    return {"kind": "run", "file": str(record.resolve()), "bodies": bodies, "symmetry": symmetry, "colour": colour_of(bodies)}


def plan_of_cell(folder):
    """Returns what to show of a microcell: the state that has lost half of its strength, its displacement magnified by a round
    number so that the largest takes SHARE of the cell. @raises Unreadable"""
    record = folder / "fields.pvd"
    try:
        states = vtu.series(record)
        if not states:
            raise ValueError("it names no state")
        half = int((read_numbers(folder / "curve.csv")["damage_strength"] >= 0.5).argmax()) or states[-1][0]
        row, path = min(states, key=lambda state: abs(state[0] - half))
        strain, points, _, data = vtu.read_quadrilaterals(path)
        largest = np.linalg.norm(data["displacement"], axis=1).max()
    except (ValueError, KeyError) as error:
        raise Unreadable(f"{record}: {error}") from error
    factor = float(f"{SHARE * np.ptp(points[:, 0]) / largest:.1g}") if largest > 0 else 1.0
    return {"kind": "cell", "file": str(record.resolve()), "time": row, "strain": strain, "factor": factor}


def plan_of(folder):
    """Returns what to show of a result folder, as plain values. @raises Unreadable"""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise Unreadable(f"{folder}: no such folder")
    if (folder / "fields.xdmf").is_file():
        return plan_of_run(folder) | {"name": folder.resolve().name}
    if (folder / "fields.pvd").is_file():
        return plan_of_cell(folder) | {"name": folder.resolve().name}
    raise Unreadable(f"{folder}: found neither fields.xdmf nor fields.pvd, allowed: a result folder of penetrate or of microcell")
