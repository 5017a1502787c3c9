"""Reads result folders: determines the kind of each and reads its files."""

import csv
import pathlib
import shlex

import vtu
from figures_material import COLUMNS as MATERIAL_COLUMNS
from figures_material import FILES as MATERIAL_CURVES
from files import Unreadable, attributes, modified, read_fragments, read_numbers, read_summary
from frames import read_frame
from sealed import names, opened, values
from results import PROGRAMS, CellState, Curve, Impact, Limit, Material, Microcell, Provenance, Scaling, Slab, Taylor, Uncertainty


def provenance(folder, summary, file_attributes):
    """Returns program, date and input of a run, from its summary and the attributes of a data file. The input itself is in an
    attribute or in `resolved.prm`."""
    version = str(summary.get("version", ""))
    program = str(file_attributes.get("program", summary.get("program", "unknown")))
    if version and version not in program:
        program += " " + version
    text = file_attributes.get("input", "")
    resolved = folder / "resolved.prm"
    if not text and resolved.is_file():
        text = resolved.read_bytes().decode("utf-8", errors="replace")
    created = file_attributes.get("created", summary.get("created"))
    return Provenance(program=program,
                      input_file=str(summary.get("input_file", file_attributes.get("input_file", "unknown"))),
                      created=str(created or modified(folder) + " (file date)"),
                      input=text)


def read_damage_table(path):
    """Returns the attributes of a damage table and its curves by ascending cell size."""
    curves = []
    try:
        with opened(path) as file:
            constants = attributes(file)
            for name in names(file["curves"]):
                group = file["curves"][name]
                curve = {name: values(group, name) for name in names(group)}
                numbers = {name: float(value) for name, value in group.attrs.items()}
                curves.append(curve | {"cell_size": numbers["cell_size"]} | numbers)
    except (OSError, KeyError, ValueError, TypeError) as error:
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
    if summary.get("samples"):  # an ensemble of cells has a band instead of fields
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
    """Returns the states of the rows nearest to the peak of the curve and to half of its strength, and the last one."""
    path = record
    try:
        files = vtu.series(record)
        chosen = {files[-1]} if files else set()
        for row in (curve["stress"].argmax(), (curve["damage_strength"] >= 0.5).argmax()):
            chosen |= {min(files, key=lambda file: abs(file[0] - row))} if files else set()
        states = []
        for _, path in sorted(chosen):
            states.append(CellState(*vtu.read_quadrilaterals(path)))
        return states
    except ValueError as error:
        raise Unreadable(f"{path}: {error}") from error


def describe_curve(source, path):
    """Adds the provenance in FILE.csv.prm to that of a material point. The file has the line
    `# PROGRAM, DATE: INPUT FILE ...`, then the resolved input."""
    described = path.with_name(path.name + ".prm")
    if not described.is_file():
        return
    text = described.read_text(encoding="utf-8", errors="replace")
    source.program, _, rest = text.split("\n", 1)[0].lstrip("# ").partition(", ")
    source.created, _, rest = rest.partition(": ")
    source.input_file = rest.partition(";")[0]
    _, along, strain_path = source.input_file.partition(" along ")
    if along:
        source.commands.append(shlex.join([PROGRAMS["material_point"], str(described), strain_path, "--output",
                                           str(path.with_name(f"{path.stem}_again.csv"))]))
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


def kind_of_impact(summary):
    """Returns the kind of a run of penetrate: a shot has an exit velocity or a depth of penetration, a bar has a length, and
    other runs have neither."""
    if "exit_velocity" in summary or "penetration_depth" in summary:
        return Slab
    return Taylor if "final_length_ratio" in summary else Impact


def read_history(path):
    """Returns the columns of history.csv. @raises Unreadable: one is missing that every run has"""
    history = read_numbers(path)
    for column in ("time", "total_energy", "kinetic_energy", "internal_energy", "contact_work", "friction_work"):
        if column not in history:
            raise Unreadable(f"{path}: column '{column}' is missing")
    return history


def read_impact(folder, summary):
    result = kind_of_impact(summary)(folder, summary)
    file_attributes = {}
    if (folder / "history.csv").is_file():
        result.history = read_history(folder / "history.csv")
    else:
        result.missing.append("history.csv")
    if (folder / "fields.h5").is_file():
        result.frame, file_attributes = read_frame(folder / "fields.h5")
        if result.frame is None:
            result.missing.append("fields.h5 has no frame")
    else:
        result.missing.append("fields.h5")
    if isinstance(result, Slab):
        for name, key, read in (("craters.csv", "outlines", read_numbers), ("crater_profiles.csv", "profiles", read_numbers),
                                ("fragments.csv", "fragments", read_fragments)):
            if (folder / name).is_file():
                setattr(result, key, read(folder / name))
            elif not result.not_reported:  # by a run that says that it has none
                result.missing.append(name)
        if (folder / "debris_cone.csv").is_file():
            result.cone = read_numbers(folder / "debris_cone.csv")
    result.provenance = provenance(folder, summary, file_attributes)
    return result


def read_scaling(folder):
    record = read_summary(folder, "scaling.json")
    if not all(key in record for key in ("runs", "assumptions")) or not isinstance(record["runs"], list):
        raise Unreadable(f"{folder}/scaling.json: expected 'runs' and 'assumptions'")
    last = record["runs"][-1]["summary"] if record["runs"] else {}
    result = Scaling(folder, {}, provenance(folder / "run", last, {"created": last.get("created", "unknown")}), record=record)
    if not record["runs"]:
        result.missing.append("runs")
    return result


def read_uncertainty(folder):
    record = read_summary(folder, "uncertainty.json")
    if not all(key in record for key in ("answers", "inputs", "failed", "samples")):
        raise Unreadable(f"{folder}/uncertainty.json: expected 'answers', 'inputs', 'failed' and 'samples'")
    result = Uncertainty(folder, {}, record=record)
    try:
        result.base = read_result(folder / "as_it_is")
        result.provenance = result.base.provenance
    except Unreadable as error:
        result.missing.append(f"the run of the input as it is ({error})")
    return result


def study_record(folder, name, keys):
    """Returns what a study has written. @raises Unreadable if one of the keys is not there"""
    record = read_summary(folder, name)
    if lacking := [key for key in keys if key not in record]:
        raise Unreadable(f"{folder}/{name}: '{lacking[0]}' is missing")
    return record


def first_run(folder):
    """Returns the provenance of the first run of a study, whose folder is kept; an unknown one if there is none."""
    run = folder / "run_1"
    return provenance(run, read_summary(run), {}) if (run / "summary.json").is_file() else Provenance()


def read_curve(folder):
    record = study_record(folder, "curve.json", ("study", "input", "key", "unit", "answers"))
    return Curve(folder, {}, first_run(folder), record=record)


def read_limit(folder):
    record = study_record(folder, "limit.json", ("study", "input", "key", "unit", "criterion", "searches", "limit", "formulas"))
    result = Limit(folder, {}, first_run(folder), record=record)
    try:
        with open(folder / "limit.csv", encoding="utf-8", newline="") as table:
            result.rows = list(csv.DictReader(table))
        for row in result.rows:
            for name in ("exit_velocity", "exit_velocity_low", "exit_velocity_high"):
                row[name] = float(row[name]) if row[name] else None
    except (OSError, KeyError, TypeError, ValueError, csv.Error) as error:
        result.rows = []
        result.missing.append(f"limit.csv ({error})")
    return result


def read_result(folder):
    """Reads a result folder of any kind. @raises Unreadable."""
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
    if (folder / "history.csv").is_file():  # penetrate writes the summary at its end
        return read_impact(folder, {"program": "penetrate", "ended": "no summary: it has not ended, or was killed"})
    if (folder / "scaling.json").is_file():
        return read_scaling(folder)
    if (folder / "uncertainty.json").is_file():
        return read_uncertainty(folder)
    if (folder / "curve.json").is_file():
        return read_curve(folder)
    if (folder / "limit.json").is_file():
        return read_limit(folder)
    if any(folder.glob("tension_*.csv")):
        return read_material(folder)
    raise Unreadable(f"{folder}: no result: neither summary.json nor tension_*.csv")
