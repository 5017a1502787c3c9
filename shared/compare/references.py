"""Measured values and those of the paper. The names of the columns state their units."""

import pathlib
from dataclasses import dataclass

from files import read_table

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "data" / "experiments"


def read_rows(path):
    """Returns the rows of a .csv as dicts, with numbers where the text is a number, or [] if there is no such file."""
    if not path.is_file():
        return []
    columns = read_table(path)

    def value(text):
        try:
            return float(text)
        except ValueError:
            return text or None

    return [dict(zip(columns, map(value, row))) for row in zip(*columns.values())]


@dataclass
class References:
    """Measured values and those of the paper, one dict per row of the files in data/experiments."""

    perforation: list
    taylor: list
    peers: list
    verification: list  # converged solutions of slabs

    @classmethod
    def read(cls, folder=EXPERIMENTS):
        folder = pathlib.Path(folder)
        return cls(*(read_rows(folder / f"{name}.csv") for name in ("perforation", "taylor", "peer_codes", "slab_verification")))

    def slab(self, result):
        """Returns the row of the experiment with this thickness and impact velocity, or None if there is no such test."""
        thickness, velocity = result.number("thickness"), result.number("impact_velocity")
        if not result.is_plain:
            return None
        for row in self.perforation:
            if None not in (thickness, velocity) and abs(row["thickness_mm"] - 1e3 * thickness) < 0.5 \
                    and abs(row["impact_m_s"] - velocity) < 0.5:
                return row
        return None

    def bar(self, result):
        """Returns the row of the Taylor bar with this impact velocity, or None."""
        velocity = result.number("impact_velocity")
        for row in self.taylor:
            if velocity is not None and abs(row["impact_velocity_m_s"] - velocity) < 0.5:
                return row
        return None
