"""All formulas for one shot: what each of them says, and where the shot is outside of its range. All values are SI."""

import math
from dataclasses import dataclass, replace

import limit_formulas
from cavity_formulas import forrestal, li_chen

FORRESTAL, LI_CHEN, PLUG = "Forrestal 1994", "Li and Chen 2003", "Forrestal with rear cone"
FASTEST = 1e4  # m/s, where the search for a ballistic limit ends


@dataclass(frozen=True)
class Prediction:
    """What one formula says. None: the formula does not speak of it, or the shot has no thickness."""

    formula: str
    depth: float | None = None        # into a thick target, m
    scabbing: float | None = None     # thickness that is just scabbed, m
    perforation: float | None = None  # thickness that is just perforated, m
    limit: float | None = None        # velocity that just perforates the slab, m/s
    residual: float | None = None     # velocity behind the slab, m/s; 0: it is not perforated
    outside: tuple = ()               # what is outside of the tests that the formula was fitted to


def recht_ipson(mass, velocity, limit, plug=0.0):
    """Returns the residual velocity of Recht and Ipson (1963), m/s: M / (M + m) sqrt(V^2 - V_BL^2), m the mass of the plug."""
    return 0.0 if velocity <= limit else mass / (mass + plug) * math.sqrt(velocity**2 - limit**2)


def root(function, low, high):
    """Returns where a growing function reaches 0 between low and high: low or high if it does not in between."""
    if function(low) >= 0 or function(high) <= 0:
        return low if function(low) >= 0 else high
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (low, middle) if function(middle) >= 0 else (middle, high)
    return (low + high) / 2


def out_of_range(rows):
    """Returns the words on quantities outside of their range; rows as limit_formulas.ranges() has them."""
    return tuple(f"{name} {value:.3g} not in {low:g} to {high:g}{unit and ' '}{unit}" for name, value, low, high, unit in rows
                 if value is not None and not low <= value <= high)


def fitted(name, shot, plug):
    """Returns the prediction of a formula of limit_formulas. plug: mass, kg."""
    depth, scabbing, perforation = limit_formulas.FORMULAS[name]

    def scaled(formula, at=shot):
        ratio = formula(at)
        return None if ratio is None else ratio * at.diameter

    limit = residual = None
    if shot.thickness is not None and scaled(perforation) is not None:
        limit = root(lambda velocity: scaled(perforation, replace(shot, velocity=velocity)) - shot.thickness, 1e-3, FASTEST)
        residual = recht_ipson(shot.mass, shot.velocity, limit, plug)
    outside = out_of_range(limit_formulas.ranges(shot)[name])
    if name in (limit_formulas.CHANG, limit_formulas.CEA) and shot.nose != "flat":
        outside += ("for flat noses",)
    return Prediction(name, scaled(depth), scaled(scabbing), scaled(perforation), limit, residual, outside)


def cavity_range(shot, cavity):
    """Returns where a shot is outside of the tests of the cavity formulas (recalled): ogives of steel into plain concrete."""
    found = out_of_range([("strength", shot.strength_mpa, 13.5, 97, "MPa"), ("velocity", shot.velocity, 0, 1000, "m/s")])
    if shot.nose != "sharp":
        found += ("for sharp noses",)
    return found + (("the projectile stops within the crater",) if cavity.depth() < cavity.crater_depth else ())


def to_rear_face(name, make, shot):
    """Returns the prediction of a cavity formula without an effect of the rear face: the slab is perforated when the depth
    reaches its thickness."""
    cavity = make(shot)
    depth, limit, residual = cavity.depth(), None, None
    outside = cavity_range(shot, cavity)
    if shot.thickness is not None:
        limit = root(lambda velocity: make(replace(shot, velocity=velocity)).depth() - shot.thickness, 1e-3, FASTEST)
        residual = cavity.at_rear_face()
        outside += ("the rear face is not seen",)
    return Prediction(name, depth, None, depth, limit, residual, outside)


def with_plug(shot):
    """Returns the prediction of the cavity formula of Forrestal whose last part is a conical plug (after Chen, Fan and Li
    2004). Its depth in a thick target is that of Forrestal."""
    cavity = forrestal(shot)

    def behind(thickness, velocity):
        return forrestal(replace(shot, thickness=thickness, velocity=velocity)).behind_plug()

    depth = cavity.depth()
    # behind() is 0 on one side of each limit: its sign is what is sought.
    perforation = root(lambda thickness: 1.0 if behind(thickness, shot.velocity) == 0 else -1.0, depth, depth + 40 * shot.diameter)
    limit = residual = None
    if shot.thickness is not None:
        residual = cavity.behind_plug()
        limit = root(lambda velocity: 1.0 if behind(shot.thickness, velocity) > 0 else -1.0, 1e-3, FASTEST)
    return Prediction(PLUG, None, None, perforation, limit, residual, cavity_range(shot, cavity))


def predict(shot, plug=0.0):
    """Returns what every formula says about a shot. plug: mass for Recht and Ipson, kg."""
    return [*(fitted(name, shot, plug) for name in limit_formulas.FORMULAS), to_rear_face(FORRESTAL, forrestal, shot),
            to_rear_face(LI_CHEN, li_chen, shot), with_plug(shot)]
