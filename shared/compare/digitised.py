"""Curves that users have read off the paper's figures, and numbers for how far ours are from them.

The format is described in data/digitised/README.md. No curve is shipped: the paper prints them as pictures only."""

import csv
import math
import pathlib
import re
from dataclasses import dataclass

import numpy as np

from figures_material import DAMAGE, HYDROSTAT, compression, equivalent
from files import Unreadable, read_text, separator

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "data" / "digitised"


@dataclass(frozen=True)
class Form:
    """What a file of a curve holds, and which of our curves it is compared with."""

    figure: int  # of the paper
    columns: tuple  # the two names, with units
    label: str
    ours: tuple = ()  # files of material_point, without .csv
    thickness: float | None = None  # of the slab, mm: the curve is compared with runs


HISTORY = ("time_ms", "velocity_m_s")
FORMS = {
    "fig04_hydrostat": Form(4, ("volumetric_strain", "pressure_mpa"), "hydrostat", tuple(HYDROSTAT)),
    "fig05_surface_slow": Form(5, ("mean_pressure_mpa", "stress_difference_mpa"), "0.001 s⁻¹", ("surface_slow",)),
    "fig05_surface_fast": Form(5, ("mean_pressure_mpa", "stress_difference_mpa"), "100 s⁻¹", ("surface_fast",)),
    "fig07_damage": Form(7, ("strain", "damage"), "tensile damage", tuple(DAMAGE)),
    "fig08_tension_afc": Form(8, ("strain", "stress_mpa"), "original AFC", ("tension_afc", "tension_printed")),
    "fig08_tension_midm": Form(8, ("strain", "stress_mpa"), "AFC with MIDM", ("tension_midm",)),
    "fig15_low": Form(15, HISTORY, "NMAP, low resolution", thickness=127),
    "fig15_high": Form(15, HISTORY, "NMAP, high resolution", thickness=127),
    "fig15_cel": Form(15, HISTORY, "Sherburn and others", thickness=127),
    "fig17_127": Form(17, HISTORY, "NMAP, 127 mm", thickness=127),
    "fig17_216": Form(17, HISTORY, "NMAP, 216 mm", thickness=216),
    "fig17_254": Form(17, HISTORY, "NMAP, 254 mm", thickness=254),
}

# Our curve in the columns of a form, from those of material_point.
OURS = {
    4: lambda columns: (compression(columns), 1e-6 * columns["pressure"]),
    5: lambda columns: (1e-6 * columns["pressure"][1:], 1e-6 * equivalent(columns)[1:]),  # row 0 is the state at rest
    7: lambda columns: (columns["exx"], columns["tensile_damage"]),
    8: lambda columns: (columns["exx"], 1e-6 * columns["sxx"]),
}


@dataclass
class Curve:
    """A curve of the paper: `y` over rising `x`, in the units of the form's columns."""

    name: str
    form: Form
    x: np.ndarray
    y: np.ndarray


@dataclass
class Difference:
    """How far our curve is from one of the paper, in the unit of the paper's second column."""

    first: float  # common range of the abscissa
    last: float
    mean_square_root: float
    largest: float
    place: float  # abscissa of the largest
    peak: float  # largest absolute value of the paper's curve in the common range


def refuse(path, line, column, found, allowed):
    raise Unreadable(f"{path}:{line}: column {column}: found '{found}', allowed: {allowed}")


def number_of(path, line, column, text):
    """Returns a cell as a finite number. @raises Unreadable"""
    text = text.strip()
    comma = re.fullmatch(r"[+-]?\d*,\d+(e[+-]?\d+)?", text, re.IGNORECASE)
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        refuse(path, line, f"'{column}'", text, "a finite number" + (" with a decimal point, no comma" if comma else ""))
    return value


def read_curve(path):
    """Returns the curve of one file. @raises Unreadable: one line with file, line, column, what was found and what is allowed"""
    form = FORMS.get(path.stem)
    if form is None:
        raise Unreadable(f"{path}: found a curve named '{path.stem}', allowed: {', '.join(FORMS)}")
    lines = read_text(path).splitlines()
    kept = [(i, line) for i, line in enumerate(lines, 1) if line.strip() and not line.startswith("#")]
    between = separator([line for _, line in kept])
    try:
        cells = [(i, next(csv.reader([line], delimiter=between, skipinitialspace=True))) for i, line in kept]
    except csv.Error as error:
        raise Unreadable(f"{path}: {error}") from error
    if not cells:
        refuse(path, max(1, len(lines)), "1", "the end of the file", f"the header {','.join(form.columns)}")
    line, header = cells[0]
    for i in range(max(len(header), 2)):
        name = header[i].strip().lower() if i < len(header) else "nothing"
        if i > 1 or name != form.columns[i]:
            refuse(path, line, i + 1, name, form.columns[i] if i < 2 else f"two columns, {','.join(form.columns)}")
    points = []
    for line, row in cells[1:]:
        if len(row) != 2:
            refuse(path, line, min(len(row), 2) + 1, row[2] if len(row) > 2 else "nothing",
                   "two numbers" + (" with decimal points, no commas" if len(row) > 2 else ""))
        points.append([number_of(path, line, *pair) for pair in zip(form.columns, row)])
        if len(points) > 1 and not points[-1][0] > points[-2][0]:
            refuse(path, line, f"'{form.columns[0]}'", row[0].strip(), f"more than {points[-2][0]:g}, the row before")
    if len(points) < 2:
        refuse(path, len(lines), "1", "the end of the file", "two rows of numbers or more")
    return Curve(path.stem, form, *np.array(points).T)


def read(folder=FOLDER):
    """Returns all curves of a folder, by the paper's figures. @raises Unreadable"""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise Unreadable(f"{folder}: no such folder of digitised curves")
    curves = [read_curve(path) for path in sorted(folder.glob("*.csv"))]
    return sorted(curves, key=lambda curve: list(FORMS).index(curve.name))


def first_passage(x, y):
    """Returns the points of a curve at which x exceeds all earlier ones: loading without the unloadings."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    new = np.ones(len(x), dtype=bool)
    new[1:] = x[1:] > np.maximum.accumulate(x)[:-1]
    return x[new], y[new]


def difference(curve, x, y):
    """Returns how far the curve (x, y) is from one of the paper where both are; None if they have no common range.

    Both are straight between their points, so their difference is straight between the points of both, and its mean square
    is the sum of h (a^2 + a b + b^2) / 3 over the intervals, divided by the range: it does not depend on how closely a
    curve was read off."""
    x, y = first_passage(x, y)
    if not len(x):
        return None
    first, last = max(x[0], curve.x[0]), min(x[-1], curve.x[-1])
    if not first < last:
        return None
    places = np.unique(np.concatenate([x, curve.x, [first, last]]))
    places = places[(places >= first) & (places <= last)]
    paper = np.interp(places, curve.x, curve.y)
    apart = np.interp(places, x, y) - paper
    a, b = apart[:-1], apart[1:]
    square = np.sum(np.diff(places) * (a * a + a * b + b * b)) / (3 * (last - first))
    worst = int(np.argmax(np.abs(apart)))
    return Difference(first + 0.0, last + 0.0, math.sqrt(max(0.0, square)), abs(apart[worst]), places[worst], np.abs(paper).max())


def shot_of(curve, run, references):
    """Returns whether a run is of the shot whose history the curve shows."""
    row = references.slab(run)
    return row is not None and abs(row["thickness_mm"] - curve.form.thickness) < 0.5
