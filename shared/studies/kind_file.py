"""Reads a study of a kind that has a module of its own: its settings, and the lines of its other sections."""

import math
import re

from study_file import PROGRAMS, BadStudy, fault_of_file, overrides, sections, words


class Settings:
    """The keys of the section Study, with the lines that set them."""

    def __init__(self, path, values):
        self.path, self.values = path, values

    def __contains__(self, key):
        return key in self.values

    def get(self, key, convert, default=""):
        """Returns what convert makes of a value. @raises BadStudy with the line if it raises ValueError"""
        value, number = self.values.get(key, (default, 0))
        try:
            return convert(value)
        except ValueError as error:
            raise BadStudy(f"{self.path}:{number}: Study/{key}: {error}") from error


def read_kind(path, kind, keys, required, others):
    """Returns (Settings, {section: what was read}), or None if the study is of another kind. keys, required: of the section Study.
    others: {section: function of key, value and line number that returns what is kept under the key}; a function raises ValueError.
    @raises BadStudy"""
    lines = list(sections(path))
    if {key: value for section, _, key, value in lines if section == "Study"}.get("Kind") != kind:
        return None
    values, found = {}, {section: {} for section in others}
    for section, number, key, value in lines:
        if section == "Study":
            if key not in keys:
                raise BadStudy(f"{path}:{number}: unknown key '{key}', allowed: {', '.join(keys)}")
            values[key] = (value, number)
        elif section in others:
            try:
                found[section][key] = others[section](key, value, number)
            except ValueError as error:
                raise BadStudy(f"{path}:{number}: {key}: {error}") from error
        else:
            raise BadStudy(f"{path}:{number}: section '{section}', allowed: {', '.join(['Study', *others])}")
    for key in required:
        if key not in values:
            raise BadStudy(f"{path}: key 'Study/{key}' must be set")
    return Settings(path, values), found


def program(text):
    if text not in PROGRAMS:
        raise ValueError(f"found '{text}', allowed: {', '.join(PROGRAMS)}")
    return text


def existing(source):
    if fault_of_file(source):
        raise ValueError(f"found no file '{source}', allowed: an input of the program")
    return source


def answers(text):
    found = words(text)
    if not found or len(set(found)) < len(found):
        raise ValueError(f"found '{text}', allowed: keys of summary.json, or COLUMN@STRAIN of curve.csv, between commas")
    return found


def whole(text, least, most=2**63):
    if not text.isdigit() or not least <= int(text) <= most:
        limit = f", at most {most}" if most < 2**63 else ""
        raise ValueError(f"found '{text}', allowed: a whole number of {least} or more{limit}")
    return int(text)


def some_overrides(key, value, number):
    """Reads a line NAME = Section/Key=value ..."""
    if not (found := overrides(value)):
        raise ValueError(f"found '{value}', allowed: Section/Key=value ...")
    return found


def measure(text):
    """Returns (number, unit) of `12.5 mm`; the unit is empty if there is none. @raises ValueError"""
    match = re.fullmatch(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?:\s*([^\s\d].*))?", text.strip())
    if not match or not math.isfinite(float(match[1])):
        raise ValueError(f"found '{text.strip()}', allowed: a number with its unit")
    return float(match[1]), (match[2] or "").strip()


def with_unit(value, unit):
    """Returns a number as a program reads it."""
    return f"{value:.10g}" + (f" {unit}" if unit else "")


def number(value):
    """Returns a finite number, or None for anything else."""
    good = isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    return float(value) if good else None
