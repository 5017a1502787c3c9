"""Reads the tables, summaries and attributes that the programs write. Everything is SI unless a name says otherwise."""

import csv
import datetime
import json
import os
import pathlib
import stat

import numpy as np


class Unreadable(Exception):
    """Its message is one line that names the file or folder that cannot be read, and the reason."""


LARGEST_TEXT = 256 << 20  # bytes of a text that is read


def fault_of_file(path):
    """Returns what is wrong with a file that is to be read, or "": it is not there, a folder, a pipe or a device. Never waits."""
    try:
        handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY)
    except OSError as error:
        return error.strerror
    except ValueError as error:  # a NUL in the name
        return str(error)
    try:
        mode = os.fstat(handle).st_mode
    finally:
        os.close(handle)
    if stat.S_ISDIR(mode):
        return "is a folder, a file is needed"
    return "" if stat.S_ISREG(mode) else "is a pipe or a device, a file is needed"


def read_text(path):
    """Returns a whole text file in UTF-8, without a byte order mark. @raises Unreadable"""
    path = pathlib.Path(path)
    if fault := fault_of_file(path):
        raise Unreadable(f"{path}: {fault}")
    try:
        with open(path, "rb") as stream:
            content = stream.read(LARGEST_TEXT + 1)
        text = content.decode("utf-8-sig")
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise Unreadable(f"{path}: is no text in UTF-8") from error
    if len(content) > LARGEST_TEXT or "\0" in text:
        raise Unreadable(f"{path}: is no text: " + ("it holds NUL bytes" if "\0" in text else "it is too large"))
    return text


def separator(lines):
    """Returns what separates the cells: commas, or semicolons if the header line has no comma."""
    header = next((line for line in lines if line.strip()), "")
    return ";" if ";" in header and "," not in header else ","


def read_table(path):
    """Returns the columns of a .csv with a header line, as text; lines that start with # are comments. Cells are separated by
    commas, or by semicolons if the header line has no comma; quotes and blanks around them and a byte order mark do not matter."""
    try:
        lines = [line for line in read_text(path).splitlines() if not line.startswith("#")]
        rows = [row for row in csv.reader(lines, delimiter=separator(lines), skipinitialspace=True) if row]
    except csv.Error as error:
        raise Unreadable(f"{path}: {error}") from error
    if not rows:
        raise Unreadable(f"{path}: the file is empty")
    names, rows = rows[0], rows[1:]
    for i, row in enumerate(rows):
        if len(row) != len(names):
            hint = " (a number has a decimal point, no comma)" if len(row) > len(names) else ""
            raise Unreadable(f"{path}: data row {i + 1} has {len(row)} columns, the header {len(names)}{hint}")
    names = [name.strip() for name in names]
    if len(set(names)) < len(names):
        raise Unreadable(f"{path}: the header names a column twice")
    return {name: [row[i].strip() for row in rows] for i, name in enumerate(names)}


def read_numbers(path):
    """Returns the columns of a .csv as arrays."""
    try:
        return {name: np.array(values, dtype=float) for name, values in read_table(path).items()}
    except ValueError as error:
        raise Unreadable(f"{path}: {error}") from error


def read_fragments(path):
    """Returns the columns of fragments.csv as arrays, `place` as text."""
    columns = read_table(path)
    try:
        return {name: np.array(values, dtype=str if name == "place" else float) for name, values in columns.items()}
    except ValueError as error:
        raise Unreadable(f"{path}: {error}") from error


def read_summary(folder, name="summary.json"):
    path = folder / name
    try:
        summary = json.loads(read_text(path))
    except (ValueError, RecursionError) as error:
        raise Unreadable(f"{path}: {error}") from error
    if not isinstance(summary, dict):
        raise Unreadable(f"{path}: expected one object of keys and values")
    return summary


def modified(path):
    return datetime.datetime.fromtimestamp(path.stat().st_mtime).strftime("%Y-%m-%d %H:%M:%S")


def attributes(group):
    """Returns the attributes of an HDF5 group; text is decoded."""
    plain = {}
    for key, value in group.attrs.items():
        if isinstance(value, bytes):
            value = value.decode("utf-8", "replace")
        plain[key] = value.item() if isinstance(value, np.generic) else value
    return plain
