"""The reference concrete WES5000, read from the files that Spall ships, and numbers with a unit."""

import functools
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "shared" / "empirical"))

import scene_shot  # noqa: E402, makes the modules of shared/compare known
from writing import Refused  # noqa: E402


@functools.cache
def keys(folder):
    return scene_shot.read_keys(ROOT / "data" / folder / "wes5000.prm")


def section(folder, name):
    """Returns {key: value} of a section of data/FOLDER/wes5000.prm. @raises Refused"""
    return {key.removeprefix(f"{name}/"): value for key, value in keys(folder).items() if key.startswith(f"{name}/")}


def all_known(found, known):
    """@raises Refused: the reference has a key that no rule scales, or misses one: a concrete made of it would be wrong."""
    odd = sorted(set(found) ^ set(known))
    if odd:
        raise Refused(f"data/*/wes5000.prm: found another set of keys than there are rules for ({', '.join(odd)})")


def number(text):
    """Returns the number of a value, in the value's unit."""
    return float(text.split()[0])


def times(text, factor):
    """Returns a value with a unit times a factor, with 6 digits; factor 1 gives back the digits of the value."""
    value, _, unit = text.partition(" ")
    return f"{float(value) * factor:.6g} {unit}".strip()
