"""Scatter of the answers over layouts of the points: runs of one slab and spacing that differ in the layout alone."""

import statistics

import inputs
import slab_runs
from tables import Table, text

# Inputs that say where points are and change neither the model nor its resolution.
LAYOUT = {f"{inputs.TARGET}/{key}" for key in ("Layout", "Jitter", "Jitter seed", "Boundary points")}
FEWEST = 3  # layouts that give a scatter


def groups(slabs):
    """Returns lists of at least three runs of one slab, each list with all inputs but the layout of the points the same."""
    known = [slab for slab in slabs if slab.exit_velocity is not None]
    return [group for group in slab_runs.alike_but_for(LAYOUT, known) if len(group) >= FEWEST]


def scatter(values):
    """Returns mean and standard deviation of a sample."""
    return statistics.fmean(values), statistics.stdev(values)


def table(found, references):
    rows = []
    for group in found:
        exits = [slab.exit_velocity for slab in group]
        energies = [slab.number("absorbed_energy") for slab in group]
        depths = [slab.number("penetration_depth") for slab in group]
        mean, deviation = scatter(exits)
        energy = None if None in energies else scatter(energies)
        depth = None if None in depths else scatter(depths)
        measured = references.slab(group[0]) or {}
        rows.append([text(group[0].number("thickness"), 0, 1e3), text(group[0].number("spacing"), 1, 1e3),
                     slab_runs.method(group[0]), text(len(group), 0), text(mean), text(deviation), text(min(exits)),
                     text(max(exits)), text(100 * energy[1] / energy[0] if energy else None),
                     f"{1e3 * depth[0]:.0f} +- {1e3 * depth[1]:.0f}" if depth else text(None),
                     text(measured.get("experiment_exit_m_s"), 0)])
    return Table("Layouts of the points: exit velocity (m/s)",
                 ["slab (mm)", "spacing (mm)", "method", "layouts", "mean", "standard deviation", "least", "largest",
                  "absorbed energy, standard deviation (%)", "depth where all stop (mm)", "experiment"], rows,
                 "Runs with the same inputs but for the places of the points: rows of cells, rows shifted by half a cell, "
                 "jittered points. Their scatter is numerical: it holds neither the spacing's error nor the material's.")
