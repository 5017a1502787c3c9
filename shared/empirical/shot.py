"""A shot at a concrete slab, as the published formulas see it. All values are SI."""

import math
from dataclasses import dataclass

# Nose coefficient N of the NDRC formula and k of that of Hughes. NDRC as in the review of Li, Reid, Wen and Telford (2005);
# Kennedy (1976) calls 0.84 a blunt and 1.0 a spherical nose. Hughes (1984): recalled.
NDRC_NOSE = {"flat": 0.72, "hemisphere": 0.84, "blunt": 1.0, "sharp": 1.14}
HUGHES_NOSE = {"flat": 1.0, "blunt": 1.12, "hemisphere": 1.26, "sharp": 1.39}
NOSES = tuple(NDRC_NOSE)


@dataclass(frozen=True)
class Shot:
    """A rigid projectile at normal impact on plain or lightly reinforced concrete."""

    diameter: float           # of the shaft, m
    mass: float               # of the projectile, kg
    velocity: float           # at impact, m/s
    strength: float           # cylinder compressive strength of the concrete, Pa
    thickness: float | None = None  # of the slab, m; None: so thick that its rear face is not felt
    density: float = 2300.0   # of the concrete, kg/m3
    nose: str = "sharp"       # one of NOSES
    nose_length: float | None = None  # over the diameter; of an ogive sqrt(CRH - 1/4)
    nose_factor: float = 1.0  # N* of the cavity formulas: 1 of a flat nose
    doubts: tuple = ()        # sentences on what the formulas do not see in this shot

    @property
    def strength_mpa(self):
        return 1e-6 * self.strength


def ogive(crh):
    """Returns the nose of an ogive by its caliber radius head: N* = 1 / (3 CRH) - 1 / (24 CRH^2) (Forrestal, Altman, Cargile and
    Hanchak 1994), length over diameter sqrt(CRH - 1/4). It is sharp if it is longer than the diameter (chosen)."""
    length = math.sqrt(crh - 0.25)
    kind = "hemisphere" if crh == 0.5 else "sharp" if length >= 1 else "blunt"
    return {"nose": kind, "nose_length": length, "nose_factor": 1 / (3 * crh) - 1 / (24 * crh**2)}


def cone(length):
    """Returns the nose of a cone by its length over the diameter: N* = sin^2 of the half angle = 1 / (1 + 4 length^2) (Chen and
    Li 2002)."""
    return {"nose": "sharp" if length >= 1 else "blunt", "nose_length": length, "nose_factor": 1 / (1 + 4 * length**2)}


def flat():
    return {"nose": "flat", "nose_length": 0.0, "nose_factor": 1.0}


def hemisphere():
    return ogive(0.5)
