"""Reads a shot from the input of penetrate: a scene, or the resolved.prm of a result folder.

The text is read as the program reads it: `include FILE` stands for the lines of that file, also inside a section; a later
line replaces an earlier one; `set A/B = c` is a longer key. Only the keys that the formulas need are looked at, so that errors in
other keys are not found here (`penetrate SCENE --plan` finds them).
"""

import math
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

import shot as shots  # noqa: E402
from files import Unreadable, read_text  # noqa: E402
from inputs import UNUSED, without_comment  # noqa: E402
from writing import Refused  # noqa: E402

UNITS = {"length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}, "mass": {"kg": 1.0, "g": 1e-3},
         "velocity": {"m/s": 1.0, "mm/us": 1e3}, "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
         "density": {"kg/m3": 1.0, "kg/m^3": 1.0, "g/cm3": 1e3}, "angle": {"deg": math.pi / 180, "rad": 1.0}}
DEEPEST_INCLUDE = 32  # files one inside the other
# The default of AFC/Compressive strength in penetrate, Pa.
DEFAULT_STRENGTH = 38.2e6
# Keys that are looked at, by their last part.
USED = ("Diameter", "Mass", "Mean density", "Velocity", "Obliquity", "Model", "Shape", "Nose", "Caliber radius head", "Nose length",
        "Height", "Density", "Compressive strength", "Law", "Exit", "Penetration")


def quantity(text, dimension, where, least=0.0):
    """Returns a number with its unit in SI, above `least` unless that is None. where: words for the message. @raises Refused"""
    units = UNITS[dimension]
    match = re.fullmatch(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S+)\s*", text or "")
    value = float(match[1]) * units[match[2]] if match and match[2] in units else None
    if value is None or not math.isfinite(value) or (least is not None and value <= least):
        raise Refused(f"{where}: found '{text}', allowed: a number with its unit ({', '.join(units)})" +
                      ("" if least is None else f" > {least:g}"))
    return value


def plain(text, where, least):
    """Returns a number without a unit, at least `least`. @raises Refused"""
    try:
        value = float(text)
    except (TypeError, ValueError):
        value = math.nan
    if not (math.isfinite(value) and value >= least):
        raise Refused(f"{where}: found '{text}', allowed: a number >= {least:g}")
    return value


def lines(path, including=()):
    """Yields (file, line number, text without its comment) of a file and of those that it includes. @raises Refused"""
    path = pathlib.Path(path)
    try:
        text = read_text(path)
        identity = path.resolve()
    except (Unreadable, OSError, RuntimeError) as error:
        raise Refused(error) from error
    if identity in including or len(including) >= DEEPEST_INCLUDE:
        raise Refused(f"{path}: " + ("includes itself" if identity in including else "is included too deep"))
    for number, line in enumerate(text.splitlines(), 1):
        begin = re.match(r"\s*(include\s+|set\s+[^=#]*=\s*)", line)
        try:
            words = begin[1].strip() + " " + without_comment(line[begin.end():]) if begin else without_comment(line)
        except ValueError as error:
            raise Refused(f"{path}:{number}: {error}") from error
        if words.startswith("include "):
            yield from lines(path.parent / words.removeprefix("include ").strip(), (*including, identity))
        elif words:
            if not re.match(r"(subsection\s|set\s.*=|end$)", words):
                # Lines of a file that is no input are nobody's business.
                found = f"found '{words}'" if not including or path.suffix == ".prm" else "found another line"
                raise Refused(f"{path}:{number}: {found}, allowed: include FILE, subsection NAME, set KEY = VALUE, end")
            yield path, number, words


def read_keys(path):
    """Returns {'section/key': value} of an input. @raises Refused"""
    found, sections = {}, []
    for file, number, words in lines(path):
        if words.startswith("subsection "):
            sections.append(words.removeprefix("subsection ").strip())
        elif words == "end" and sections:
            sections.pop()
        elif words.startswith("set ") and "=" in words:
            key, _, value = words.removeprefix("set ").partition("=")
            found["/".join([*sections, key.strip()])] = value.strip()
        else:
            raise Refused(f"{file}:{number}: found '{words}', allowed: include FILE, subsection NAME, set KEY = VALUE, end")
    return found


def override(keys, words):
    """Changes keys by words `Section/Key=value`; outer sections may be left out where one key fits. @raises Refused"""
    for word in words:
        key, equals, value = word.partition("=")
        key = key.strip()
        if not equals or "/" not in key:
            raise Refused(f"found '{word}', allowed: Section/Key=value")
        fitting = [one for one in keys if one == key] or [one for one in keys if one.endswith("/" + key)]
        if len(fitting) > 1:
            raise Refused(f"{key}: found several keys ({', '.join(fitting)}), allowed: one of them")
        if not fitting and key.rpartition("/")[2] not in USED:
            raise Refused(f"found '{word}', allowed: a key that the scene sets, or one that the formulas use: {', '.join(USED)}")
        keys[fitting[0] if fitting else key] = value.strip()


def answer(keys, path):
    """Returns (projectile, target) of the first shot that the scene asks about. @raises Refused"""
    for key, between in (("Answers/Exit", " through "), ("Answers/Penetration", " into ")):
        names = keys.get(key, "").split(",")[0].split(between)
        if len(names) == 2:
            return names[0].strip(), names[1].strip()
    raise Refused(f"{path}: found no shot, allowed: Answers/Exit = BODY through TARGET or Answers/Penetration = BODY into TARGET")


class Body:
    """The keys of one body of an input."""

    def __init__(self, keys, name, path):
        self.keys, self.name, self.path = keys, name, path

    def text(self, key, default=None):
        value = self.keys.get(f"{self.name}/{key}", default)
        return default if value in (UNUSED, "") else value

    def where(self, key):
        return f"{self.path}: {self.name}/{key}"

    def number(self, key, dimension, least=0.0):
        if self.text(key) is None:
            raise Refused(f"{self.where(key)}: not set, and the formulas need it")
        return quantity(self.text(key), dimension, self.where(key), least)

    def optional(self, key, dimension):
        return None if self.text(key) is None else self.number(key, dimension)


def nose_of(body, diameter):
    """Returns (entries of Shot on the nose, doubts). @raises Refused: no formula knows the shape"""
    shape = body.text("Shape")
    if shape == "sphere":
        return shots.hemisphere(), ()
    if shape == "cylinder":
        return shots.flat(), ()
    if shape != "projectile":
        raise Refused(f"{body.where('Shape')}: found '{shape}', allowed: projectile, sphere or cylinder")
    kind = body.text("Nose", "ogive")
    if kind in ("ogive", "truncated ogive"):
        nose = shots.ogive(plain(body.text("Caliber radius head"), body.where("Caliber radius head"), 0.5))
        return nose, () if kind == "ogive" else ("the flat tip of the ogive is left out",)
    if kind == "cone":
        return shots.cone(body.number("Nose length", "length") / diameter), ()
    if kind == "blunt":
        return shots.flat() | {"nose": "blunt"}, ("the rounded edge counts in the coefficients of blunt noses only",)
    return (shots.hemisphere() if kind == "hemisphere" else shots.flat()), ()


def mass_of(body, diameter):
    """Returns the mass in kg; of a sphere also from its mean density. @raises Refused"""
    mass = body.optional("Mass", "mass")
    if mass is None and body.text("Shape") == "sphere":
        return body.number("Mean density", "density") * math.pi * diameter**3 / 6
    if mass is None:
        raise Refused(f"{body.where('Mass')}: found none, allowed: a mass, or --mass")
    return mass


def strength_of(target):
    """Returns (cylinder strength in Pa, doubts), or (None, ()) if the target is not of concrete."""
    if target.text("Material/Law", "AFC") != "AFC":
        return None, ()
    found = target.optional("AFC/Compressive strength", "stress")
    if found is not None:
        return found, ()
    return DEFAULT_STRENGTH, (f"strength: the nominal {1e-6 * DEFAULT_STRENGTH:g} MPa, as the scene does not set "
                              f"{target.name}/AFC/Compressive strength",)


def read(path, words=(), given=None):
    """Returns the entries of Shot that an input has, a dict. given: names of entries that are stated elsewhere, so that they
    are not needed here. path: a scene, or a folder with resolved.prm. @raises Refused"""
    path, given = pathlib.Path(path), given or ()
    keys = read_keys(path / "resolved.prm" if path.is_dir() else path)
    override(keys, words)
    projectile, target = (Body(keys, name, path) for name in answer(keys, path))
    found, doubts = {}, []
    diameter = projectile.number("Diameter", "length")
    for name, value in (("diameter", lambda: diameter), ("mass", lambda: mass_of(projectile, diameter)),
                        ("velocity", lambda: projectile.number("Velocity", "velocity")),
                        ("thickness", lambda: target.optional("Height", "length")),
                        ("density", lambda: target.optional("AFC/Density", "density"))):
        found[name] = None if name in given else value()
    found["strength"], said = strength_of(target) if "strength" not in given else (None, ())
    doubts += said
    if "nose" not in given:
        nose, said = nose_of(projectile, diameter)
        found |= nose
        doubts += said
    if projectile.text("Obliquity") and projectile.number("Obliquity", "angle", None) != 0:
        doubts.append("the obliquity is left out: all formulas are for normal impact")
    if projectile.text("Model") == "deformable":
        doubts.append("the projectile counts as rigid")
    return {name: value for name, value in found.items() if value is not None} | {"doubts": tuple(doubts)}
