"""Rules that scale the constants of the reference concrete to another strength, aggregate and density. All values are SI.

r: cylinder strength f over that of the reference. The numbers of the reference are read from data/materials/wes5000.prm and
data/microcells/wes5000.prm; a test compares those below with the sources that they repeat.

Strength surface: Malvar, Crawford, Wesevich and Simons (1997), Int. J. Impact Eng. 19, as K&C's concrete (MAT_072R3 of LS-DYNA) has
it: Y(P; f) = r Y_ref(P / r). Their hydrostat: pressures at the same volumetric strain, and moduli, times sqrt(r). Both
recalled, not checked. Each other rule says its source where it stands.
"""

import math
from dataclasses import dataclass

import reference

# Of the reference that its files do not hold as keys: nominal cylinder strength (Table 1 of the paper) and largest aggregate
# (data/microcells/README.md).
STRENGTH, AGGREGATE = 38.2e6, 9.5e-3
# Defaults of penetrate that belong to this strength: 8.45 f, and the length that makes the energy to crush (data/README.md).
LODE_FADING, CRUSH_LENGTH = 323e6, 0.1
# The codes have the mean strength 8 MPa above the characteristic one.
MARGIN = 8e6


@dataclass(frozen=True)
class Concrete:
    """What is known about a wall."""

    strength: float   # mean compressive strength of cylinders, Pa
    aggregate: float  # diameter of the largest aggregate, m
    density: float    # kg/m3


def tensile_strength(strength):
    """Returns f_ctm of CEB-FIP Model Code 1990: 1.4 MPa ((f - 8 MPa) / 10 MPa)^(2/3)."""
    return 1.4e6 * ((strength - MARGIN) / 10e6) ** (2 / 3)


def aggregate_factor(aggregate):
    """Returns the fracture energy over that of the reference's aggregate: (1 + d / 11.27 mm)^0.22 of Bazant and Becq-Giraudon
    (2002), recalled. fib Model Code 2010 has 1: it dropped the growth of the Model Code 1990 (ceb_aggregate_factor)."""
    return ((1 + aggregate / 11.27e-3) / (1 + AGGREGATE / 11.27e-3)) ** 0.22


def ceb_aggregate_factor(aggregate):
    """Returns the same by CEB-FIP Model Code 1990: G_F0 = 0.0469 d^2 - 0.5 d + 26 (N/m, mm), recalled: 25, 30 and 58 N/m at 8, 16
    and 32 mm. Only told beside the other: it falls up to 5.3 mm, and 58 is also quoted as 38."""
    base = [0.0469 * (1e3 * d) ** 2 - 0.5 * (1e3 * d) + 26 for d in (aggregate, AGGREGATE)]
    return base[0] / base[1]


def fracture_energy(strength, aggregate):
    """Returns G_F, N/m: 73 N/m (f / 1 MPa)^0.18 of fib Model Code 2010 for the reference's aggregate."""
    return 73 * (strength / 1e6) ** 0.18 * aggregate_factor(aggregate)


def crush_energy(strength, aggregate):
    """Returns the energy to crush, N/m: (f / f_ctm)^2 G_F (Oller; Alfarah, Lopez-Almansa and Oller 2017)."""
    return (strength / tensile_strength(strength)) ** 2 * fracture_energy(strength, aggregate)


@dataclass(frozen=True)
class Factors:
    """Constants over those of the reference."""

    strength: float         # r: stresses of the strength surface
    inverse: float          # 1 / r: what is per pressure
    root: float             # sqrt(r): pressures and moduli of the hydrostat
    tension: float          # f_ctm
    fracture_energy: float  # G_F
    crush_length: float     # crush energy over r: strains to failure stay
    none: float = 1.0


def factors(concrete):
    r = concrete.strength / STRENGTH
    crush = crush_energy(concrete.strength, concrete.aggregate) / crush_energy(STRENGTH, AGGREGATE)
    return Factors(strength=r, inverse=1 / r, root=math.sqrt(r), crush_length=crush / r,
                   tension=tensile_strength(concrete.strength) / tensile_strength(STRENGTH),
                   fracture_energy=(fracture_energy(concrete.strength, concrete.aggregate) / fracture_energy(STRENGTH, AGGREGATE)))


# Key of AFC, factor, reason; in the order in which they are written. None: a heading.
SURFACE, MODULI = "r (Malvar and others 1997)", "sqrt(r) (Malvar and others 1997)"
AFC = (
    ("Shear modulus", "root", f"{MODULI}; Poisson's ratio is kept"),
    (None, None, "Failure surface, Eqs. 22 and 23, at pressure P: C1 - C2 exp(-A_N P) + C4 P = r Y_ref(P / r)"),
    ("C1", "strength", SURFACE), ("C2", "strength", SURFACE),
    ("C3", "none", "kept: a share of the strength per logarithm of the rate"),
    ("C4", "none", "kept: stress per pressure"),
    ("C5", "strength", f"{SURFACE}; largest principal stress difference"),
    ("A_N", "inverse", "1 / r: per pressure (Malvar and others 1997)"),
    ("T_max", "tension", "as f_ctm (CEB-FIP Model Code 1990); mean tension"),
    (None, None, "Hydrostat, Eqs. 20 and 21: volumetric strains are kept, pressures and moduli grow with sqrt(r)"),
    ("C6", "root", f"{MODULI}; pressure where crushing begins"),
    ("C7", "none", "kept: volumetric strain"),
    ("C8", "root", MODULI),
    ("C9", "none", "kept: volumetric strain, of the pores"),
    ("K1", "root", MODULI), ("K2", "root", MODULI), ("K3", "root", MODULI),
    (None, None, "Shear damage, Eq. 24: strain to failure D1 P"),
    ("D1", "inverse", "1 / r: the same strain at the same P / f (Holmquist, Johnson and Cook 1993)"),
    ("Readings", None, "how the equations are read: data/README.md"),
)


def afc(concrete):
    """Returns [(key, value with its unit, reason)] of the section AFC; headings have no key. @raises Refused: the reference is not
    there or has keys without a rule"""
    scale, given = factors(concrete), reference.section("materials", "AFC")
    reference.all_known(given, [key for key, *_ in AFC if key] + ["Density"])
    lines = [("Density", f"{concrete.density:.6g} kg/m3", "given: changes inertia, not pores or strength")]
    for key, factor, reason in AFC:
        lines.append((key, None if key is None else given[key] if factor is None else
                      reference.times(given[key], getattr(scale, factor)), reason))
    return lines + [
        (None, None, "Defaults of the program that belong to another strength"),
        ("Compressive strength", f"{concrete.strength / 1e6:.6g} MPa", "f as given, for the rate law of tension"),
        ("Lode fading pressure", reference.times(f"{LODE_FADING / 1e6:g} MPa", scale.strength), "8.45 f (Malvar and others 1997)"),
        ("Shear damage reference length", reference.times(f"{CRUSH_LENGTH:g} m", scale.crush_length),
         "energy to crush (f / f_ctm)^2 G_F (Oller), over r")]


def elastic(lines):
    """Returns (E in Pa, Poisson's ratio) of the constants that are written: K = C6 / C7, and G."""
    value = {key: text for key, text, _ in lines}
    K = reference.number(value["C6"]) * 1e6 / reference.number(value["C7"])
    G = reference.number(value["Shear modulus"]) * 1e6
    return 9 * K * G / (3 * K + G), (3 * K - 2 * G) / (2 * (3 * K + G))


def microcell(concrete, afc_lines):
    """Returns [(section, [(key, value, reason)])] of the microcell that belongs to constants of AFC. @raises Refused"""
    scale, E_nu = factors(concrete), elastic(afc_lines)
    material, cell = reference.section("microcells", "Material"), reference.section("microcells", "Cell")
    reference.all_known(material, ("Young's modulus", "Poisson's ratio", "Tensile strength", "Fracture energy", "Softening"))
    reference.all_known(cell, ("Sizes", "Reference size", "Initial crack"))
    return [("Material", [
        ("Young's modulus", f"{E_nu[0] / 1e6:.7g} MPa", "9 K G / (3 K + G), K = C6 / C7 of the material file"),
        ("Poisson's ratio", f"{E_nu[1]:.7g}", "(3 K - 2 G) / (2 (3 K + G))"),
        ("Tensile strength", reference.times(material["Tensile strength"], scale.tension),
         f"of the ligament; peak of the cell: f_ctm = {tensile_strength(concrete.strength) / 1e6:.4g} MPa (CEB 1990)"),
        ("Fracture energy", reference.times(material["Fracture energy"], scale.fracture_energy),
         f"of the ligament; cell: G_F = {fracture_energy(concrete.strength, concrete.aggregate):.4g} N/m (fib 2010)"),
        ("Softening", material["Softening"], "as the reference")]),
        ("Cell", [("Sizes", cell["Sizes"], "around the spacings of the points"),
                  ("Reference size", cell["Reference size"], "as the reference"),
                  ("Initial crack", cell["Initial crack"], "as the reference: ligament over cell stays 1.337")])]
