"""Depth of penetration, scabbing and perforation limit by formulas that were fitted to tests. All values are SI.

x: depth of penetration, h: thickness that is just scabbed, e: thickness that is just perforated, all over the diameter d; M:
mass; V: impact velocity; f: cylinder strength. "Checked": the coefficients were compared with another published text than the
one they were first taken from. "Recalled": they were not, so look them up before a design rests on them.

NDRC depth and ACE: checked against a thesis on missile impact that prints both in SI units (its Eqs. 2.7 to 2.11). NDRC scabbing
and Degen: checked against DOE-STD-3014, appendix C (Eqs. C.6-5, C.6-6, C.6-13 and C.6-14). All others: recalled, after the
review of Li, Reid, Wen and Telford, Int. J. Impact Eng. 32 (2005), 224-284. The branches of Hughes and UKAEA meet at their
limits, as those of a formula without a misprint do, and the two published forms of CEA-EDF agree; tests compute both.
"""

import math

from shot import HUGHES_NOSE, NDRC_NOSE

NDRC, ACE, DEGEN, HUGHES, CHANG, CEA, UKAEA = "modified NDRC", "ACE", "Degen", "Hughes", "Chang", "CEA-EDF", "UKAEA"


def impact_factor(shot, nose):
    """Returns G = 3.8e-5 N M / (d sqrt(f)) (V / d)^1.8 of the NDRC formula (Kennedy 1976)."""
    return 3.8e-5 * nose * shot.mass / (shot.diameter * math.sqrt(shot.strength)) * (shot.velocity / shot.diameter) ** 1.8


def ndrc_depth(shot):
    """Returns x of the modified NDRC formula (1946, Kennedy 1976): 2 sqrt(G) up to G = 1, then G + 1."""
    factor = impact_factor(shot, NDRC_NOSE[shot.nose])
    return 2 * math.sqrt(factor) if factor <= 1 else factor + 1


def ndrc_scabbing(x):
    """Returns h of the modified NDRC formula."""
    return 7.91 * x - 5.06 * x**2 if x <= 0.65 else 2.12 + 1.36 * x


def ndrc_perforation(x):
    """Returns e of the modified NDRC formula; the lower branch is recalled, the upper one is that of ACE."""
    return 3.19 * x - 0.718 * x**2 if x <= 1.35 else 1.32 + 1.24 * x


def ace_depth(shot):
    """Returns x of the formula of the Army Corps of Engineers (1946)."""
    return (3.5e-4 / math.sqrt(shot.strength) * shot.mass / shot.diameter**3 * shot.diameter**0.215 * shot.velocity**1.5 + 0.5)


def ace_scabbing(x):
    return 2.12 + 1.36 * x


def ace_perforation(x):
    return 1.32 + 1.24 * x


def degen_perforation(x):
    """Returns e of Degen (1980), a revision for the depth of the modified NDRC formula."""
    return 2.2 * x - 0.3 * x**2 if x <= 1.52 else 0.69 + 1.29 * x


def hughes_tension(shot):
    """Returns the tensile strength that Hughes means, Pa: the modulus of rupture 0.63 sqrt(f), both in MPa."""
    return 0.63e6 * math.sqrt(shot.strength_mpa)


def hughes_number(shot):
    """Returns the impact number I = M V^2 / (tensile strength d^3)."""
    return shot.mass * shot.velocity**2 / (hughes_tension(shot) * shot.diameter**3)


def hughes_depth(shot):
    """Returns x of Hughes (1984): 0.19 k I / S, S = 1 + 12.3 ln(1 + 0.03 I)."""
    number = hughes_number(shot)
    return 0.19 * HUGHES_NOSE[shot.nose] * number / (1 + 12.3 * math.log1p(0.03 * number))


def hughes_scabbing(x):
    return 5.0 * x if x < 0.7 else 1.74 * x + 2.3


def hughes_perforation(x):
    return 3.6 * x if x < 0.7 else 1.58 * x + 1.4


def energy_number(shot):
    """Returns M V^2 / (d^3 f)."""
    return shot.mass * shot.velocity**2 / (shot.diameter**3 * shot.strength)


def chang_scabbing(shot):
    """Returns h of Chang (1981), flat noses; 61 m/s is its reference velocity (200 ft/s)."""
    return 1.84 * (61 / shot.velocity) ** 0.13 * energy_number(shot) ** 0.4


def chang_perforation(shot):
    """Returns e of Chang (1981), flat noses."""
    return (61 / shot.velocity) ** 0.25 * math.sqrt(energy_number(shot))


def cea_perforation(shot):
    """Returns e of CEA-EDF (Berriaud and others 1978), flat noses."""
    return (0.82 * shot.mass**0.5 * shot.velocity**0.75 / (shot.density**0.125 * shot.strength**0.375 * shot.diameter**1.5))


def ukaea_depth(shot):
    """Returns x of the UKAEA guidelines (Barr 1990), a revision of the NDRC formula for low velocities. Its scabbing and
    perforation limits are left out: their coefficients could not be confirmed."""
    factor = impact_factor(shot, NDRC_NOSE[shot.nose])
    if factor <= 0.0726:
        return 0.275 - math.sqrt(0.0756 - factor)
    return math.sqrt(4 * factor - 0.242) if factor <= 1.0605 else factor + 0.9395


def unlimited(shot):
    return None


# Name: (depth, scabbing limit, perforation limit), each over the diameter as a function of the shot.
FORMULAS = {
    NDRC: (ndrc_depth, lambda shot: ndrc_scabbing(ndrc_depth(shot)), lambda shot: ndrc_perforation(ndrc_depth(shot))),
    ACE: (ace_depth, lambda shot: ace_scabbing(ace_depth(shot)), lambda shot: ace_perforation(ace_depth(shot))),
    DEGEN: (ndrc_depth, unlimited, lambda shot: degen_perforation(ndrc_depth(shot))),
    HUGHES: (hughes_depth, lambda shot: hughes_scabbing(hughes_depth(shot)), lambda shot: hughes_perforation(hughes_depth(shot))),
    CHANG: (unlimited, chang_scabbing, chang_perforation),
    CEA: (unlimited, unlimited, cea_perforation),
    UKAEA: (ukaea_depth, unlimited, unlimited)}


def ranges(shot):
    """Returns {formula: [(quantity, value, least, largest, unit)]}: the tests that each formula was fitted to. Those of NDRC, ACE
    and Degen: DOE-STD-3014; all others recalled, after the review named above."""
    ratio = None if shot.thickness is None else shot.thickness / shot.diameter
    strength, millimetres = ("strength", shot.strength_mpa), 1e3 * shot.diameter
    speed, over = ("velocity", shot.velocity), ("thickness over diameter", ratio)
    return {
        NDRC: [("depth over diameter", ndrc_depth(shot), 0, 13.5, ""), (*over, 0, 18, "")],
        ACE: [("depth over diameter", ace_depth(shot), 1.35, 13.5, ""), (*over, 3, 18, ""),
              ("diameter", millimetres, 11.2, 155, "mm")],
        DEGEN: [("depth over diameter", ndrc_depth(shot), 0, 13.42, ""), (*over, 0, 18, ""), (*speed, 25, 312, "m/s"),
                (*strength, 28.4, 43.1, "MPa"), ("diameter", millimetres, 100, 310, "mm")],
        HUGHES: [("impact number", hughes_number(shot), 0, 3500, "")],
        CHANG: [(*speed, 16, 311.8, "m/s"), ("mass", shot.mass, 0.11, 342.9, "kg"), ("diameter", millimetres, 50.8, 304.8, "mm"),
                (*strength, 23.2, 45.5, "MPa")],
        CEA: [(*speed, 20, 200, "m/s"), (*strength, 30, 45, "MPa"), (*over, 0.35, 4.17, "")],
        UKAEA: [(*speed, 25, 300, "m/s"), (*strength, 22, 44, "MPa"),
                ("mass over diameter cubed", shot.mass / shot.diameter**3, 5e3, 2e5, "kg/m3")]}
