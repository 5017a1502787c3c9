"""Inputs of a run by the role of the body that they belong to.

A scene names its bodies freely (slab, wall, dart), so the sections of a resolved input have those names. The report asks
for roles instead: `Target/...` is the section of the body that the first answer is about, `Bar/...` the same of a run
that measures a bar, `Projectile/...` that of the body which hits the target. Sections inside that of the target or bar
(its material: `AFC/T_max`, `Material/Law`) lose the name of the body. All other sections keep their names.
"""

import functools

TARGET, BAR, PROJECTILE = "Target", "Bar", "Projectile"
# Value of a key in a resolved input that is not set because nothing needs it.
UNUSED = "REQUIRED"
# Metres per unit.
LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}


@functools.lru_cache(maxsize=256)
def parse_inputs(text):
    """Returns {'Section/Key': value} of a resolved input; nested sections make longer keys. Do not change the result."""
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
