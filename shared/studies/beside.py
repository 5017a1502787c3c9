"""What is known of a swept shot from elsewhere: measured points of data/experiments, and the formulas of engineers."""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "compare"), str(HERE.parent / "empirical")]

import scene_shot  # noqa: E402
from kind_file import with_unit  # noqa: E402
from predictions import predict  # noqa: E402
from references import SHOT, References, is_test_of  # noqa: E402
from results import Slab  # noqa: E402
from shot import Shot  # noqa: E402
from writing import Refused  # noqa: E402

# Last part of a swept key -> column of the files of experiments, its factor to SI, and the dimension of its unit.
COLUMNS = {"Velocity": ("impact_m_s", 1.0, "velocity"), "Height": ("thickness_mm", 1e-3, "length"),
           "Mass": ("projectile_mass_kg", 1.0, "mass"), "Compressive strength": ("strength_mpa", 1e6, "stress"),
           "Obliquity": ("obliquity_deg", scene_shot.UNITS["angle"]["deg"], "angle"),
           "Angle of attack": ("angle_of_attack_deg", scene_shot.UNITS["angle"]["deg"], "angle")}
# Answer -> [(file of experiments, column, factor to SI)].
MEASURED = {"exit_velocity": [("perforation", "experiment_exit_m_s", 1.0), ("steel_plates", "experiment_exit_m_s", 1.0)],
            "penetration_depth": [("penetration_depth", "experiment_depth_mm", 1e-3),
                                  ("sphere_craters", "experiment_front_depth_mm", 1e-3)],
            "front_crater_diameter": [("sphere_craters", "experiment_front_diameter_mm", 1e-3)],
            "back_crater_diameter": [("sphere_craters", "experiment_rear_diameter_mm", 1e-3)]}
# Answer -> attribute of a Prediction.
FORMULAS = {"exit_velocity": "residual", "penetration_depth": "depth"}
# Keys of a summary that say which shot it was.
IDENTITY = [key for _, key, _, _ in SHOT]


def factor_of(key, unit):
    """Returns what a number with a unit is in SI, for a swept key that COLUMNS has; None for others."""
    column = COLUMNS.get(last(key))
    return None if column is None else scene_shot.UNITS[column[2]].get(unit)


def last(key):
    return key.rpartition("/")[2]


def keys_of(study):
    """Returns the keys of the study's input; {} if it cannot be read, which its program will say."""
    try:
        return scene_shot.read_keys(study.input)
    except Refused:
        return {}


def measured(study, key, unit, answer, summary, references=None):
    """Returns [(x in `unit`, value, scatter or None)], SI, of the tests that differ from a run in the swept key at most.
    summary: of one run, with the keys IDENTITY. No test is known of targets with a bonded layer."""
    factor, column = factor_of(key, unit), COLUMNS.get(last(key), ("",))[0]
    if factor is None or any(name.endswith("/Bonded to") for name in keys_of(study)):
        return []
    run, known = Slab(pathlib.Path(), summary), references or References.read()
    files = {"perforation": known.perforation, "penetration_depth": known.depths, "sphere_craters": known.craters, "steel_plates": known.plates}
    found = []
    for file, name, scale in MEASURED.get(answer, []):
        for row in files[file]:
            value, x = row.get(name), row.get(column)
            if isinstance(value, float) and isinstance(x, float) and is_test_of(row, run, but=(column,)):
                stated = row.get(re.sub("_(m_s|mm)$", r"_uncertainty_\1", name))
                found.append((x * COLUMNS[last(key)][1] / factor, scale * value,
                              scale * stated if isinstance(stated, float) else None))
    return found


def shot_at(study, changes):
    """Returns the shot of the study's input with Fixed and changes, for the formulas; None if they do not know it."""
    words = [f"{key}={value}" for key, value in (study.fixed | changes).items() if last(key) in scene_shot.USED]
    try:
        return Shot(**scene_shot.read(study.input, words))
    except (Refused, TypeError):
        return None


def predictions(study, changes):
    """Returns what every formula says about the input with changes; [] if the input is not a shot that they know."""
    shot = shot_at(study, changes)
    return [] if shot is None else predict(shot)


def formula_lines(study, answer, keys, places, unit):
    """Returns {formula: [(x, value in SI, whether the shot is within the tests of the formula)]} over a swept key. keys: the swept
    one, and others that must not be; a formula cannot be drawn where several keys change together."""
    name = FORMULAS.get(answer)
    if name is None or len(keys) != 1 or last(keys[0]) not in scene_shot.USED:
        return {}
    found = {}
    for x in places:
        for one in predictions(study, {keys[0]: with_unit(x, unit)}):
            if (value := getattr(one, name)) is not None:
                found.setdefault(one.formula, []).append((x, value, not one.outside))
    return found
