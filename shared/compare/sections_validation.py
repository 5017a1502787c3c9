"""Section of the report that sets all measured values beside the computed ones and the published formulas."""

import figures_validation
import slab_runs
import validation


def section(out, slabs):
    """Reports on runs with a test of their shot on record. Runs of verification materials are not compared with experiments."""
    runs = [run for run in slabs if slab_runs.verification_row(run, out.references.verification) is None]
    checks = validation.collect(runs, out.references)
    if not checks:
        return
    out.report.heading("Validation", *runs)
    spacings = {run.name: run.number("spacing") for run in runs}
    shown = validation.one_per_test(checks, spacings)
    sentence = validation.verdict(shown)
    if sentence:
        out.report.paragraph(sentence, "verdict")
    drawn = figures_validation.draw(shown)
    if drawn is not None:
        out.draw(drawn, "validation", data=("summary.json",),
                 caption="Measured and computed values of all tests on record, by law of the concrete, beside published formulas "
                 "(shared/formulas). Hollow markers: the shot is outside of the tests that the formula was fitted to. Of several "
                 "runs of a shot the finest is shown for each law.")
    out.report.table(validation.table(checks))
