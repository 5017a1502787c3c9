"""Command line of shared/formulas."""

import argparse
import csv
import io
import pathlib

import scene_shot  # first: it makes the modules of shared/compare known
import shot as shots
from predictions import predict
from writing import Parser, Refused, write

EPILOG = """examples:

  shared/formulas data/scenes/slab_127.prm
  shared/formulas data/scenes/slab_127.prm projectile/Velocity="400 m/s" --strength 45MPa --csv formulas.csv
  shared/formulas out/slab_127                    # a result folder: its resolved.prm
  shared/formulas --diameter 50.8mm --mass 2.34kg --velocity 313m/s --thickness 127mm --strength 38.2MPa --crh 3

A number on the command line replaces that of the scene. Without a thickness, only depths and limits are given. The strength
is that of cylinders; a scene without AFC/Compressive strength has the program's nominal 38.2 MPa, and the table says so.

Columns: depth of penetration into a thick target; thickness that is just scabbed; thickness that is just perforated;
ballistic limit, the velocity that just perforates the slab; residual velocity behind it, by Recht and Ipson from the ballistic
limit where a formula has none of its own. "outside": where the shot is outside of the tests that a formula was fitted to.
Sources, and which coefficients were not confirmed: shared/empirical/limit_formulas.py and cavity_formulas.py.

The formulas: modified NDRC, ACE, Degen, Hughes, Chang, CEA-EDF, UKAEA (depth only); Forrestal and others 1994 and Li and
Chen 2003 as far as the rear face; Forrestal with a conical plug that parts at the rear face."""

NUMBERS = (("diameter", "length", "of the projectile's shaft"), ("mass", "mass", "of the projectile"),
           ("velocity", "velocity", "at impact"), ("thickness", "length", "of the slab"),
           ("strength", "stress", "compressive strength of concrete cylinders"),
           ("density", "density", "of the concrete; default without a scene: 2300kg/m3"))
# Column of the CSV file, attribute, factor to the column's unit, heading of the terminal's table.
COLUMNS = (("depth_mm", "depth", 1e3, "depth (mm)"), ("scabbing_limit_mm", "scabbing", 1e3, "scabs up to (mm)"),
           ("perforation_limit_mm", "perforation", 1e3, "perforates up to (mm)"),
           ("ballistic_limit_m_s", "limit", 1.0, "limit (m/s)"),
           ("residual_m_s", "residual", 1.0, "residual (m/s)"))


def parser():
    made = Parser(prog="formulas", description="Penetration depth, scabbing and perforation limit, "
                                   "ballistic limit and residual velocity of a shot at concrete, by published formulas.",
                                   epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("words", nargs="*", metavar="SCENE.prm [Section/Key=value ...]", help="scene or result folder; optional")
    for name, dimension, meaning in NUMBERS:
        made.add_argument(f"--{name}", metavar="NUMBER", help=f"{meaning} ({', '.join(scene_shot.UNITS[dimension])})")
    nose = made.add_mutually_exclusive_group()
    nose.add_argument("--crh", metavar="NUMBER", help="caliber radius head of an ogive, 0.5 or more")
    nose.add_argument("--cone", metavar="LENGTH", help="length of a conical nose")
    nose.add_argument("--nose", choices=("flat", "blunt", "hemisphere"))
    made.add_argument("--plug", metavar="MASS", default="0kg", help="mass of the plug for Recht and Ipson; default: %(default)s")
    made.add_argument("--csv", metavar="FILE", help="writes the table, replaces FILE only with --force")
    made.add_argument("--force", action="store_true")
    return made


def nose_given(options, diameter):
    """Returns the entries of Shot on the nose that the command line states, {} if it does not. @raises Refused"""
    if options.crh is not None:
        return shots.ogive(scene_shot.plain(options.crh, "--crh", 0.5))
    if options.cone is not None:
        return shots.cone(scene_shot.quantity(options.cone, "length", "--cone") / diameter)
    if options.nose is not None:
        return shots.hemisphere() if options.nose == "hemisphere" else shots.flat() | {"nose": options.nose}
    return {}


def shot_of(options):
    """Returns the shot of a command line. @raises Refused"""
    given = {name: scene_shot.quantity(getattr(options, name), dimension, f"--{name}") for name, dimension, _ in NUMBERS
             if getattr(options, name) is not None}
    has_nose = any(value is not None for value in (options.crh, options.cone, options.nose))
    found = {}
    if options.words:
        found = scene_shot.read(options.words[0], options.words[1:], (*given, *(["nose"] if has_nose else [])))
    found |= given
    missing = [f"--{name}" for name in ("diameter", "mass", "velocity", "strength") if name not in found]
    if not has_nose and "nose" not in found:
        missing.append("--crh, --cone or --nose")
    if missing:
        raise Refused(f"found no {', '.join(missing)}, allowed: " + (
            "each of them on the command line, as the scene has none" if options.words else
            "each of them on the command line, or a scene that has them"))
    return shots.Shot(**(found | nose_given(options, found["diameter"])))


def cell(value, factor):
    return "-" if value is None else f"{factor * value:.0f}"


def print_table(shot, rows):
    thick = "thick" if shot.thickness is None else f"{1e3 * shot.thickness:g} mm thick"
    print(f"projectile: {1e3 * shot.diameter:g} mm, {shot.mass:g} kg, {shot.nose} nose (N* {shot.nose_factor:.3g}), "
          f"{shot.velocity:g} m/s; concrete: {thick}, {shot.strength_mpa:g} MPa, {shot.density:g} kg/m3")
    for doubt in shot.doubts:
        print(f"note: {doubt}")
    table = [["formula", *(heading for *_, heading in COLUMNS), "outside"]]
    table += [[row.formula, *(cell(getattr(row, name), factor) for _, name, factor, _ in COLUMNS), "; ".join(row.outside) or "-"]
              for row in rows]
    widths = [max(len(line[i]) for line in table) for i in range(len(table[0]) - 1)]
    for line in table:
        print("  ".join([line[0].ljust(widths[0]), *(text.rjust(width) for text, width in zip(line[1:], widths[1:])), line[-1]]))


def csv_text(rows):
    """Returns the table with the units in the names of its columns; an empty cell: the formula does not speak of it."""
    stream = io.StringIO()
    out = csv.writer(stream, lineterminator="\n")
    out.writerow(["formula", *(column for column, *_ in COLUMNS), "outside"])
    for row in rows:
        values = [(getattr(row, name), factor) for _, name, factor, _ in COLUMNS]
        out.writerow([row.formula, *("" if value is None else f"{factor * value:.6g}" for value, factor in values),
                      "; ".join(row.outside)])
    return stream.getvalue()


def main(arguments):
    options = parser().parse_args(arguments)
    shot = shot_of(options)
    plug = scene_shot.quantity(options.plug, "mass", "--plug", None)
    if plug < 0:
        raise Refused(f"--plug: found '{options.plug}', allowed: a mass >= 0")
    if options.csv and pathlib.Path(options.csv).exists() and not options.force:
        raise Refused(f"--csv: found the file '{options.csv}', allowed: a new one, or --force")
    rows = predict(shot, plug)
    print_table(shot, rows)
    if options.csv:
        write(options.csv, csv_text(rows))
    return 0
