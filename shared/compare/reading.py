"""Reads result folders. Everything is SI unless a name says otherwise."""

import csv
import datetime
import json
import math
import pathlib
from dataclasses import dataclass, field

import h5py
import numpy as np

import vtu
from figures_material import COLUMNS as MATERIAL_COLUMNS
from figures_material import FILES as MATERIAL_CURVES


class Unreadable(Exception):
    """One line: which file or folder and what is wrong with it."""


@dataclass
class Provenance:
    program: str = "unknown"
    input_file: str = "unknown"
    created: str = "unknown"
    input: str = ""  # every key with its resolved value


@dataclass
class Result:
    """What all kinds share. `missing` names what was expected and is not there."""

    folder: pathlib.Path
    summary: dict
    provenance: Provenance = field(default_factory=Provenance)
    missing: list = field(default_factory=list)
    name: str = ""  # in headings and file names

    def __post_init__(self):
        self.name = self.name or self.folder.resolve().name


@dataclass
class CellState:
    """The deformed cell at one macroscopic strain: a mesh of quadrilaterals."""

    strain: float
    points: np.ndarray  # n x 2
    corners: np.ndarray  # m x 4
    data: dict  # displacement, stress_yy, ... at the points


@dataclass
class Microcell(Result):
    constants: dict = field(default_factory=dict)  # root attributes of the damage table
    curves: list = field(default_factory=list)  # dicts of columns and 'cell_size', ascending size
    reference: dict | None = None  # the curve of the case's own cell
    states: list = field(default_factory=list)  # the reference cell near its peak stress, half broken and at the end
    band: dict = field(default_factory=dict)  # {'weak': curve, 'strong': curve} of the reference cell of an ensemble


@dataclass
class Material(Result):
    curves: dict = field(default_factory=dict)  # name of the file (figures_material.FILES) -> columns


@dataclass
class Frame:
    """Points at one time: the modelled part of the body, not yet mirrored."""

    time: float
    projectile_position: float  # z of the nose tip
    initial: np.ndarray  # n x 3
    position: np.ndarray  # n x 3
    volume: np.ndarray  # n
    fields: dict
    geometry: dict  # root attributes: symmetry_planes, spacing, projectile_...
    bodies: list = field(default_factory=list)  # (position n x 3, volume n) of further bodies, such as a projectile

    @property
    def symmetry(self):
        """'x y': planes of symmetry; 'axis': a half plane of rings; '': the whole body."""
        return self.geometry.get("symmetry_planes", "")


def parse_inputs(text):
    """{'Section/Key': value} of a resolved input."""
    inputs, sections = {}, []
    for line in text.splitlines():
        words = line.split("#")[0].strip()
        if words.startswith("subsection "):
            sections.append(words[len("subsection "):].strip())
        elif words == "end" and sections:
            sections.pop()
        elif words.startswith("set ") and "=" in words:
            key, _, value = words[len("set "):].partition("=")
            inputs["/".join([*sections, key.strip()])] = value.strip()
    return inputs


@dataclass
class Impact(Result):
    """A penetrate run; `scene` of the summary says which of the two below."""

    history: dict | None = None
    frame: Frame | None = None  # the last one

    @property
    def inputs(self):
        return parse_inputs(self.provenance.input)

    def number(self, key):
        """A number of the summary, None if it is absent or null."""
        value = self.summary.get(key)
        number = isinstance(value, (int, float)) and not isinstance(value, bool)
        return value if number and math.isfinite(value) else None


@dataclass
class Slab(Impact):
    outlines: dict | None = None  # craters.csv: angle, front_radius, back_radius
    profiles: dict | None = None  # crater_profiles.csv: radius, front_depth, back_depth
    fragments: dict | None = None  # fragments.csv: place (text), copies, mass, velocity_z, ...; one entry per fragment

    @property
    def exit_velocity(self):
        """m/s, 0 if the projectile was stopped; None if it was still on its way."""
        value = self.number("exit_velocity")
        return value if self.summary.get("perforated") is not False or value == 0 else None


class Taylor(Impact):
    pass


@dataclass
class Scaling(Result):
    """Runs on many ranks (shared/study, Kind = scaling): their summaries and what the model assumes."""
    record: dict = field(default_factory=dict)


def read_table(path):
    """Columns of a .csv with a header line as text; lines starting with # are comments."""
    try:
        with open(path, newline="", encoding="utf-8") as stream:
            rows = [row for row in csv.reader(line for line in stream if not line.startswith("#")) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise Unreadable(f"{path}: {error}") from error
    if not rows:
        raise Unreadable(f"{path}: empty")
    names, rows = rows[0], rows[1:]
    for i, row in enumerate(rows):
        if len(row) != len(names):
            raise Unreadable(f"{path}: data row {i + 1} has {len(row)} columns, the header {len(names)}")
    return {name.strip(): [row[i] for row in rows] for i, name in enumerate(names)}


def read_numbers(path):
    """Columns of a .csv as arrays."""
    try:
        return {name: np.array(values, dtype=float) for name, values in read_table(path).items()}
    except ValueError as error:
        raise Unreadable(f"{path}: {error}") from error


def read_summary(folder, name="summary.json"):
    path = folder / name
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Unreadable(f"{path}: {error}") from error
    if not isinstance(summary, dict):
        raise Unreadable(f"{path}: expected one object of keys and values")
    return summary


def modified(path):
    return datetime.datetime.fromtimestamp(path.stat().st_mtime).strftime("%Y-%m-%d %H:%M:%S")


def attributes(group):
    """Attributes of an HDF5 group; text is decoded."""
    plain = {}
    for key, value in group.attrs.items():
        if isinstance(value, bytes):
            value = value.decode("utf-8", "replace")
        plain[key] = value.item() if isinstance(value, np.generic) else value
    return plain


def provenance(folder, summary, file_attributes):
    """From the summary and a data file's attributes; a `resolved.prm` or a file attribute holds the input."""
    version = str(summary.get("version", ""))
    program = str(file_attributes.get("program", summary.get("program", "unknown")))
    if version and version not in program:
        program += " " + version
    text = file_attributes.get("input", "")
    resolved = folder / "resolved.prm"
    if not text and resolved.is_file():
        text = resolved.read_text(encoding="utf-8", errors="replace")
    created = file_attributes.get("created", summary.get("created"))
    return Provenance(program=program,
                      input_file=str(summary.get("input_file", file_attributes.get("input_file", "unknown"))),
                      created=str(created or modified(folder / "summary.json") + " (file date)"),
                      input=text)


def read_damage_table(path):
    """Its attributes and its curves by ascending size."""
    curves = []
    try:
        with h5py.File(path, "r") as file:
            constants = attributes(file)
            for group in file["curves"].values():
                curve = {name: data[:] for name, data in group.items()}
                numbers = {name: float(value) for name, value in group.attrs.items()}
                curves.append(curve | {"cell_size": numbers["cell_size"]} | numbers)
    except (OSError, KeyError, ValueError) as error:
        raise Unreadable(f"{path}: {error}") from error
    return constants, sorted(curves, key=lambda curve: curve["cell_size"])


def read_microcell(folder, summary):
    result = Microcell(folder, summary)
    path = folder / "damage_table.h5"
    if path.is_file():
        result.constants, result.curves = read_damage_table(path)
    else:
        result.missing.append("damage_table.h5")
    path = folder / "curve.csv"
    if path.is_file():
        result.reference = read_numbers(path) | {"cell_size": summary.get("cell_size")}
    else:
        result.missing.append("curve.csv")
        if result.curves:
            result.reference = result.curves[0]
    if summary.get("samples"):  # many cells have no fields, but a band
        for side in ("weak", "strong"):
            _, curves = read_damage_table(folder / f"damage_table_{side}.h5")
            result.band[side] = min(curves, key=lambda curve: abs(curve["cell_size"] - summary["cell_size"]))
    elif (folder / "fields.pvd").is_file() and result.reference is not None:
        result.states = read_states(folder / "fields.pvd", result.reference)
    else:
        result.missing.append("fields.pvd")
    result.provenance = provenance(folder, summary, result.constants)
    return result


def read_states(record, curve):
    """The states nearest to the peak of the curve and to half of its strength, and the last one."""
    path = record
    try:
        files = vtu.series(record)
        peak = curve["strain"][curve["stress"].argmax()]
        half = curve["strain"][(curve["damage_strength"] >= 0.5).argmax()]
        chosen = {files[-1]} if files else set()
        for strain in (peak, half):
            chosen |= {min(files, key=lambda file: abs(file[0] - strain))} if files else set()
        states = []
        for strain, path in sorted(chosen):
            states.append(CellState(strain, *vtu.read_quadrilaterals(path)))
        return states
    except ValueError as error:
        raise Unreadable(f"{path}: {error}") from error


def describe_curve(source, path):
    """Adds what FILE.csv.prm says of FILE.csv: `# PROGRAM, DATE: INPUT FILE ...`, then the resolved input."""
    described = path.with_name(path.name + ".prm")
    if not described.is_file():
        return
    text = described.read_text(encoding="utf-8", errors="replace")
    source.program, _, rest = text.split("\n", 1)[0].lstrip("# ").partition(", ")
    source.created, _, rest = rest.partition(": ")
    source.input_file = rest.partition(";")[0]
    source.input = f"{source.input}\n# ---- {path.name}\n{text}".lstrip()


def read_material(folder):
    result = Material(folder, {})
    for name in MATERIAL_CURVES:
        path = folder / f"{name}.csv"
        if path.is_file():
            result.curves[name] = read_numbers(path)
            for column in MATERIAL_COLUMNS:
                if column not in result.curves[name]:
                    raise Unreadable(f"{path}: column '{column}' is missing")
            describe_curve(result.provenance, path)
        else:
            result.missing.append(path.name)
    return result


def read_frame(path):
    """The last frame of fields.h5, None if it holds no frame. With it: the attributes of the file."""
    try:
        with h5py.File(path, "r") as file:
            geometry = attributes(file)
            frames = sorted(file["frames"], key=int) if "frames" in file else []
            if not frames:
                return None, geometry
            group = file["frames"][frames[-1]]
            bodies = [(group[name]["position"][:].astype(float), file[name]["volume"][:].astype(float).ravel())
                      for name, data in group.items() if isinstance(data, h5py.Group)]
            arrays = {name: data[:] for name, data in group.items() if isinstance(data, h5py.Dataset)}
            position = arrays.pop("position").astype(float)
            frame = Frame(float(group.attrs["time"]),
                          float(group.attrs.get("projectile_position", math.nan)),
                          file["initial_position"][:].astype(float), position,
                          file["volume"][:].astype(float).ravel(), arrays, geometry, bodies)
    except (OSError, KeyError, ValueError) as error:
        raise Unreadable(f"{path}: {error}") from error
    if frame.initial.shape != frame.position.shape or len(frame.volume) != len(frame.position):
        raise Unreadable(f"{path}: arrays of frame {frames[-1]} differ in length")
    return frame, geometry


def read_impact(folder, summary):
    kinds = {"slab": Slab, "taylor": Taylor}
    scene = summary.get("scene")
    if scene not in kinds:
        raise Unreadable(f"{folder}/summary.json: scene '{scene}', expected slab or taylor")
    result = kinds[scene](folder, summary)
    file_attributes = {}
    if (folder / "history.csv").is_file():
        result.history = read_numbers(folder / "history.csv")
    else:
        result.missing.append("history.csv")
    if (folder / "fields.h5").is_file():
        result.frame, file_attributes = read_frame(folder / "fields.h5")
        if result.frame is None:
            result.missing.append("fields.h5 has no frame")
    else:
        result.missing.append("fields.h5")
    if isinstance(result, Slab):
        for name, key in (("craters.csv", "outlines"), ("crater_profiles.csv", "profiles")):
            if (folder / name).is_file():
                setattr(result, key, read_numbers(folder / name))
            else:
                result.missing.append(name)
        if (folder / "fragments.csv").is_file():
            result.fragments = read_fragments(folder / "fragments.csv")
        else:
            result.missing.append("fragments.csv")
    result.provenance = provenance(folder, summary, file_attributes)
    return result


def read_fragments(path):
    """Columns as arrays, `place` as text."""
    columns = read_table(path)
    try:
        return {name: np.array(values, dtype=str if name == "place" else float) for name, values in columns.items()}
    except ValueError as error:
        raise Unreadable(f"{path}: {error}") from error


def read_scaling(folder):
    record = read_summary(folder, "scaling.json")
    if not all(key in record for key in ("runs", "assumptions")):
        raise Unreadable(f"{folder}/scaling.json: expected 'runs' and 'assumptions'")
    last = record["runs"][-1]["summary"] if record["runs"] else {}
    result = Scaling(folder, {}, provenance(folder / "run", last, {"created": last.get("created", "unknown")}), record=record)
    if not record["runs"]:
        result.missing.append("runs")
    return result


def read_result(folder):
    """Any result folder. @raises Unreadable."""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise Unreadable(f"{folder}: no such folder")
    if (folder / "summary.json").is_file():
        summary = read_summary(folder)
        program = str(summary.get("program", "")).split(" ")[0]
        if program == "microcell":
            return read_microcell(folder, summary)
        if program == "penetrate":
            return read_impact(folder, summary)
        raise Unreadable(f"{folder}/summary.json: program '{program}', expected microcell or penetrate")
    if (folder / "scaling.json").is_file():
        return read_scaling(folder)
    if any(folder.glob("tension_*.csv")):
        return read_material(folder)
    raise Unreadable(f"{folder}: no result: neither summary.json nor tension_*.csv")
