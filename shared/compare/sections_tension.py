"""Section of the report on tests of concrete in tension: what shared/tension reads off, beside the measured values."""

import tension_command
from files import Unreadable
from tables import EXPERIMENT, OURS, Table, text
from writing import Refused

WORDS = {"spall": "spall bar", "pull": "bar pulled apart", "split": "cube that is split"}
NOTE = ("Strength: by the pull-back of the free end, or the largest force over the section. Fracture energy: work of the force on "
        "the opening, of one crack where a bar has several; '>': the crack still carries a force at the end. A dash: no open crack. The measured concrete is another "
        "one (data/experiments/spall_bar.csv).")


def evaluated(run):
    """Returns (kind of the test, what it says, None), (kind, None, why it cannot be evaluated), or None of a run that is no such
    test."""
    kind = None
    try:
        result = tension_command.Result(run.folder)
        kind = result.kind()
        if kind == "pull":
            return kind, tension_command.evaluate_pull(result), None
        if kind == "split":
            return kind, tension_command.evaluate_split(result), None
        return (kind, tension_command.evaluate_spall(result)[0], None) if kind == "spall" else None
    except (Refused, Unreadable) as why:
        return kind and (kind, None, str(why))


def rows_of(name, kind, found):
    """Returns the rows of one run."""
    if kind == "split":
        return [[name, WORDS[kind], "splitting strength (MPa)", "–", text(found.strength, 2, 1e-6)]]
    measured = tension_command.measured(kind)
    energy = f"{'> ' if found.left else ''}{found.fracture_energy:.0f}" if kind == "pull" or found.open else "–"
    rate = f"{text(found.rate, 1)} 1/s"
    return [[name, WORDS[kind], f"tensile strength (MPa) at {rate}", text(measured["tensile_strength_mpa"], 2),
             text(found.strength, 2, 1e-6)],
            [name, WORDS[kind], f"fracture energy (N/m) at {rate}", text(measured["fracture_energy_n_m"], 0), energy]]


def section(out, runs):
    """Reports on the runs that are tests in tension, if there are any."""
    found = [(run.name, *said) for run in runs for said in [evaluated(run)] if said]
    if not found:
        return
    out.report.heading("Validation: concrete in tension")
    for name, kind, _, why in found:
        if why:
            out.report.paragraph(f"{name}: a {WORDS[kind]} that cannot be evaluated: {why}")
    rows = [row for name, kind, said, why in found if not why for row in rows_of(name, kind, said)]
    if rows:
        out.report.table(Table("Measured and computed strength and fracture energy",
                               ["result", "test", "quantity", EXPERIMENT, OURS], rows, NOTE))
