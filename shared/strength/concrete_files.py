"""Text of the files that shared/concrete writes."""

import os

import reference
import rules


def set_lines(entries, indent="  "):
    """Returns the lines `set KEY = VALUE  # reason`, aligned; an entry without a key is a heading."""
    known = [(key, value) for key, value, _ in entries if key]
    widths = [max(len(one[i]) for one in known) for i in (0, 1)]
    return [f"{indent}set {key.ljust(widths[0])} = {value.ljust(widths[1])}  # {reason}" if key else f"\n{indent}# {reason}"
            for key, value, reason in entries]


def head(concrete, what, notes):
    lines = [f"Concrete of {concrete.strength / 1e6:g} MPa (mean of cylinders), largest aggregate {1e3 * concrete.aggregate:g} mm, "
             f"{concrete.density:g} kg/m3: {what}.",
             f"Made by shared/concrete from WES5000 ({rules.STRENGTH / 1e6:g} MPa, {1e3 * rules.AGGREGATE:g} mm) by published "
             "rules; none was adjusted to penetration.",
             "Sources, doubts and a comparison: data/README.md, \"A concrete from its strength\". "
             f"r = f / {rules.STRENGTH / 1e6:g} MPa = {rules.factors(concrete).strength:.6g}.",
             f"Good for {notes[0]}.", *(f"Warning: {note}." for note in notes[1:])]
    return [f"# {line}" for line in lines] + [""]


def texts(concrete, afc, cell, folder, notes):
    """Returns the texts of concrete.prm, microcell.prm and block.prm. notes: range of the rules, then warnings."""
    material = [*head(concrete, "constants of the AFC law", notes), "subsection Material", "  set Law = AFC", "end", "",
                "subsection AFC", *set_lines(afc), "end"]
    micro = head(concrete, "its microcell", notes)
    for section, entries in cell:
        micro += [f"subsection {section}", *set_lines(entries), "end", ""]
    scene = os.path.relpath(reference.ROOT / "data" / "scenes" / "depth_block.prm", folder.resolve())
    block = [*head(concrete, "depth of a projectile in a block of it", notes), f"include {scene}", "", "subsection slab",
             "  include concrete.prm", "  subsection AFC", "    set Damage table = microcell/damage_table.h5", "  end", "end"]
    return ["\n".join(lines).rstrip("\n") + "\n" for lines in (material, micro, block)]
