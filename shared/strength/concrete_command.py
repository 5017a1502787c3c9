"""Command line of shared/concrete."""

import argparse
import os
import pathlib
import subprocess
import sys

import reference  # first: it makes the modules of shared/empirical and shared/compare known
import concrete_files
import rules
import scene_shot
from writing import Parser, Refused, own, write

EPILOG = """example:

  shared/concrete --strength "35 MPa" --aggregate "9.5 mm" --density "2320 kg/m3" --output out/concrete_35

writes into the folder
  concrete.prm   the material: constants of the AFC law, each with its rule
  microcell.prm  the microcell that belongs to it: input of build/micro/microcell
  block.prm      a scene to begin with: depth of a projectile in a block of this concrete

The strength is the mean one of cylinders. From a characteristic strength f_ck take f_ck + 8 MPa (CEB, fib), from cubes about
0.8 of theirs. The constants are those of the reference concrete (WES5000, 38.2 MPa, 9.5 mm, data/materials/wes5000.prm), scaled
by published rules; none was adjusted to penetration. data/README.md, "A concrete from its strength", has the rules, their
sources and a comparison with other published concretes.

Exit codes: 0 done; 2 bad input, nothing was written; 3 something could not be written; with --run also those of microcell."""

# Option, dimension, unit that is told, range that the rules are good for, range beyond which they mean nothing; SI.
INPUTS = (("strength", "stress", ("MPa", 1e6), (20e6, 60e6), (rules.MARGIN, 150e6), "mean compressive strength of cylinders"),
          ("aggregate", "length", ("mm", 1e-3), (5e-3, 40e-3), (0.0, 150e-3), "diameter of the largest aggregate"),
          ("density", "density", ("kg/m3", 1.0), (2000.0, 2600.0), (500.0, 6000.0), "density of the concrete"))
FILES = ("concrete.prm", "microcell.prm", "block.prm")
TABLE = "microcell/damage_table.h5"


def parser():
    made = Parser(prog="concrete", description="Material file (AFC law) and microcell of a concrete of which "
                                   "strength, largest aggregate and density are known.",
                                   epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, dimension, _, _, _, meaning in INPUTS:
        made.add_argument(f"--{name}", metavar="NUMBER", required=True,
                          help=f"{meaning} ({', '.join(scene_shot.UNITS[dimension])})")
    made.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the files")
    made.add_argument("--run", action="store_true", help="runs microcell too: the damage table is then in DIR/microcell")
    made.add_argument("--build", default=str(reference.ROOT / "build"), metavar="DIR", help="where microcell was built")
    made.add_argument("--force", action="store_true", help="replaces files of an earlier run")
    return made


def concrete_of(options):
    """Returns the concrete of a command line. @raises Refused"""
    values = {}
    for name, dimension, (unit, factor), _, (low, high), _ in INPUTS:
        text = getattr(options, name)
        values[name] = scene_shot.quantity(text, dimension, f"--{name}")
        if not low < values[name] <= high:
            raise Refused(f"--{name}: found '{text}', allowed: > {low / factor:g} and <= {high / factor:g} {unit}, where the rules "
                          "have a meaning")
    return rules.Concrete(**values)


def range_text():
    return ", ".join(f"{name} {low / factor:g} to {high / factor:g} {unit}"
                     for name, _, (unit, factor), (low, high), _, _ in INPUTS)


def warnings_of(concrete):
    """Returns one line for each value that is outside of the range that the rules are good for."""
    found = []
    for name, _, (unit, factor), (low, high), _, _ in INPUTS:
        value = getattr(concrete, name)
        if not low * (1 - 1e-9) <= value <= high * (1 + 1e-9):  # a limit itself is inside, whatever its unit was
            found.append(f"--{name}: {value / factor:g} {unit} is outside of {low / factor:g} to {high / factor:g} {unit}: "
                         "the rules are extrapolated")
    return found


def print_concrete(concrete, afc, cell):
    """Prints the values that a reader compares first, with their equations."""
    value = {key: text for key, text, _ in afc} | {key: text for _, entries in cell for key, text, _ in entries}
    scale = rules.factors(concrete)
    print(f"r = f / {rules.STRENGTH / 1e6:g} MPa = {scale.strength:.4g}; good for {range_text()}")
    rows = (("strength surface", f"C1 {value['C1']}, C2 {value['C2']}, C5 {value['C5']}", "r"),
            ("crushing begins", f"C6 {value['C6']}", "sqrt(r)"),
            ("shear modulus", value["Shear modulus"], "sqrt(r)"),
            ("tension", f"T_max {value['T_max']}", "f_ctm = 1.4 MPa ((f - 8 MPa) / 10 MPa)^(2/3)"),
            ("peak of the cell", f"{rules.tensile_strength(concrete.strength) / 1e6:.4g} MPa", "f_ctm"),
            ("fracture energy of the cell", f"{rules.fracture_energy(concrete.strength, concrete.aggregate):.4g} N/m",
             "73 N/m (f / 1 MPa)^0.18, aggregate (1 + d / 11.27 mm)^0.22"))
    for name, text, equation in rows:
        print(f"  {name.ljust(29)}{text.ljust(50)}{equation}")
    print(f"  (aggregate: {rules.aggregate_factor(concrete.aggregate):.3g} times the fracture energy at "
          f"{1e3 * rules.AGGREGATE:g} mm; fib 2010 has 1, CEB 1990 {rules.ceb_aggregate_factor(concrete.aggregate):.3g})")


def print_next(folder, has_table):
    print(f"written: {', '.join(str(folder / name) for name in FILES)}\nnext:")
    if not has_table:
        print(f"  build/micro/microcell {folder}/microcell.prm --output {folder}/microcell")
    print(f"  build/macro/penetrate {folder}/block.prm --output {folder}/block\n"
          f"in a scene of your own: include concrete.prm in the section of the body, then set AFC/Damage table = .../{TABLE}")


def run_microcell(program, folder, force):
    """Returns the exit code of microcell. A run that a signal ended gives 3."""
    command = [program, folder / "microcell.prm", "--output", folder / "microcell", *(["--force"] if force else [])]
    sys.stdout.flush()
    code = subprocess.run([str(word) for word in command], check=False).returncode
    return code if code >= 0 else 3


def main(arguments):
    options = parser().parse_args(arguments)
    concrete, folder = concrete_of(options), pathlib.Path(options.output)
    program = pathlib.Path(options.build) / "micro" / "microcell"
    if options.run and not os.access(program, os.X_OK):
        raise Refused(f"--run: found no program '{program}', allowed: build it first (shared/run build), or --build DIR")
    afc = rules.afc(concrete)
    cell = rules.microcell(concrete, afc)
    warnings = warnings_of(concrete)
    with own(folder, (*FILES, "microcell/*"), options.force):
        for name, text in zip(FILES, concrete_files.texts(concrete, afc, cell, folder, [range_text(), *warnings])):
            write(folder / name, text)
        code = run_microcell(program, folder, options.force) if options.run else 0
        has_table = (folder / TABLE).exists()
    print_concrete(concrete, afc, cell)
    for warning in warnings:
        print(f"warning: {warning}", file=sys.stderr)
    if has_table and not options.run:
        print(f"warning: {folder / TABLE} is older than these files: run microcell again with --force", file=sys.stderr)
    if code:
        print(f"concrete: microcell has ended with exit code {code}", file=sys.stderr)
    else:
        print_next(folder, has_table and options.run)
    return code
