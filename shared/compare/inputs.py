"""Inputs of a run by the role of the body that they belong to.

A scene names its bodies freely (slab, wall, dart), so the sections of a resolved input have those names. The report asks
for roles instead: `Target/...` is the section of the body that the first answer is about, `Bar/...` the same of a run
that measures a bar, `Projectile/...` that of the body which hits the target. Sections inside that of the target or bar
(its material: `AFC/T_max`, `Material/Law`) lose the name of the body. All other sections keep their names.
"""

import functools
import re

TARGET, BAR, PROJECTILE = "Target", "Bar", "Projectile"
# Value of a key in a resolved input that is not set because nothing needs it.
UNUSED = "REQUIRED"
# Metres per unit.
LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}


def without_comment(text):
    """Returns the text before the comment, trimmed. A comment begins with #, at the start or after a blank; after a text in double
    quotes, in which "" is a double quote, it begins behind them, and they go. @raises ValueError: a quote is not closed"""
    text = text.strip()
    if not text.startswith('"'):
        return re.split(r"(?:^|\s)#", text, maxsplit=1)[0].strip()
    match = re.fullmatch(r'"((?:[^"]|"")*)"\s*(?:#.*)?', text)
    if not match:
        raise ValueError(f"found {text}, allowed: a text in double quotes, then a comment or nothing")
    return match[1].replace('""', '"')


@functools.lru_cache(maxsize=256)
def parse_inputs(text):
    """Returns {'Section/Key': value} of a resolved input; nested sections make longer keys. Do not change the result."""
    inputs, sections = {}, []
    for line in text.splitlines():
        words = line.strip() if line.strip().startswith("set ") else without_comment(line)
        if words.startswith("subsection "):
            sections.append(words[len("subsection "):].strip())
        elif words == "end" and sections:
            sections.pop()
        elif words.startswith("set ") and "=" in words:
            key, _, value = line.strip()[len("set "):].partition("=")
            inputs["/".join([*sections, key.strip()])] = without_comment(value)
    return inputs


def by_role(text, roles):
    """Returns the inputs with roles instead of the names of bodies. roles: {name of a body: role}."""
    found = {}
    for key, value in parse_inputs(text).items():
        name, _, rest = key.partition("/")
        role = roles.get(name)
        if role in (TARGET, BAR) and "/" in rest:
            found[rest] = value
        else:
            found[key if role is None else f"{role}/{rest}"] = value
    return found


def number(text):
    """Returns the number at the beginning of a value, in the value's unit; None if there is none."""
    try:
        return float(text.split()[0])
    except (AttributeError, IndexError, ValueError):
        return None


def length(text):
    """Returns a length in m, or None if the text is not a length."""
    value, words = number(text), (text or "").split()
    return value * LENGTHS[words[1]] if value is not None and len(words) == 2 and words[1] in LENGTHS else None
