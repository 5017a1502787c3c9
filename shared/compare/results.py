"""The contents of result folders, by kind. All values are SI unless a name says otherwise."""

import math
import pathlib
import shlex
from dataclasses import dataclass, field

import numpy as np

import inputs as inputs_by_role
from frames import Frame


# Programs by their names in the results.
PROGRAMS = {name: f"build/{room}/{name}" for name, room in (("microcell", "micro"), ("penetrate", "macro"), ("material_point", "macro"))}


@dataclass
class Provenance:
    program: str = "unknown"
    input_file: str = "unknown"
    created: str = "unknown"
    input: str = ""  # every key with its resolved value
    commands: list = field(default_factory=list)  # those of a material point, one for each of its curves


@dataclass
class Result:
    """The data that all kinds have. `missing` names expected results that do not exist."""

    folder: pathlib.Path
    summary: dict
    provenance: Provenance = field(default_factory=Provenance)
    missing: list = field(default_factory=list)
    name: str = ""  # name in headings and file names

    def __post_init__(self):
        self.name = self.name or self.folder.resolve().name

    @property
    def unfinished(self):
        """Why the run ended before it had what it was asked for; None if it did not."""
        return self.summary.get("reason", "unknown") if self.summary.get("complete") is False else None

    @property
    def empty(self):
        """Why there is nothing to draw or to compare; None if there is."""
        return None

    @property
    def command(self):
        """Returns the commands that compute the result again, one a line; empty if its files do not tell."""
        program = self.provenance.program.split(" ")[0]
        resolved = self.folder / "resolved.prm"
        if program not in PROGRAMS or not resolved.is_file():
            return "\n".join(self.provenance.commands)
        return shlex.join([PROGRAMS[program], str(resolved), "--output", f"{self.folder}_again"])


@dataclass
class CellState:
    """The deformed cell at one macroscopic strain: a mesh of quadrilaterals."""

    strain: float
    points: np.ndarray  # n x 2
    corners: np.ndarray  # m x 4
    data: dict  # displacement, stress_yy, ... at the points


@dataclass
class Microcell(Result):
    constants: dict = field(default_factory=dict)  # attributes of the damage table's root group
    curves: list = field(default_factory=list)  # dicts of columns and 'cell_size', ascending size
    reference: dict | None = None  # the curve of the case's own cell
    states: list = field(default_factory=list)  # the reference cell near its peak stress, half broken and at the end
    band: dict = field(default_factory=dict)  # {'weak': curve, 'strong': curve} of the reference cell of an ensemble


@dataclass
class Material(Result):
    curves: dict = field(default_factory=dict)  # name of the file (figures_material.FILES) -> columns


@dataclass
class Impact(Result):
    """A run of penetrate. Slab and Taylor are runs whose first answer is about a shot or about a bar."""

    history: dict | None = None
    frame: Frame | None = None  # the last frame
    # The role of the body that the first answer is about.
    MAIN = inputs_by_role.TARGET

    @property
    def roles(self):
        """Returns {name of a body: its role in the report}."""
        return {self.summary.get("projectile"): inputs_by_role.PROJECTILE, self.summary.get("main_body"): self.MAIN}

    @property
    def inputs(self):
        """Returns the inputs by role, such as {'Target/Height': ...} (see inputs.py)."""
        return inputs_by_role.by_role(self.provenance.input, self.roles)

    @property
    def unfinished(self):
        ended = self.summary.get("ended", "finished")
        complete = ["finished", "end time"] if self.inputs.get("Run/Until") == "end time" else ["finished"]
        return None if ended in complete else ended

    @property
    def empty(self):
        if self.history is None:
            return None
        if len(self.history["time"]) == 0:
            return "history.csv has no line: no step has been computed"
        return None if self.history["total_energy"][0] > 0 else "nothing moves at the start: there is no energy to follow"

    @property
    def density(self):
        """Returns the density of the main body's material, kg/m^3; None if the inputs do not hold it."""
        found = self.inputs
        return inputs_by_role.number(found.get(f"{found.get('Material/Law', 'AFC')}/Density"))

    def number(self, key):
        """Returns a number of the summary, None if it is absent or null."""
        value = self.summary.get(key)
        number = isinstance(value, (int, float)) and not isinstance(value, bool)
        return value if number and math.isfinite(value) else None

    def band(self, key):
        """Returns (low, high): the range that the numerical error leaves open for a number of the summary; None if it is not
        measured."""
        ends = self.number(f"{key}_low"), self.number(f"{key}_high")
        return None if None in ends else ends

    @property
    def band_remark(self):
        """Returns where the numerical error is not measured at the resolution of the run, or at all; empty if it is."""
        return self.summary.get("numerical_error_remark") or ""


@dataclass
class Slab(Impact):
    """A shot at a target; the target need not be a slab."""

    outlines: dict | None = None  # craters.csv: angle, front_radius, back_radius
    profiles: dict | None = None  # crater_profiles.csv: radius, front_depth, back_depth
    cone: dict | None = None  # debris_cone.csv: angle_from, angle_to, mass, momentum, kinetic_energy
    fragments: dict | None = None  # fragments.csv: place (text), copies, mass, velocity_z, ...; one entry per fragment

    @property
    def target(self):
        """Returns the name of the target in the scene."""
        return self.summary.get("target") or "slab"

    @property
    def projectile(self):
        """Returns the name of the projectile in the scene."""
        return self.summary.get("projectile") or "projectile"

    @property
    def has_bonded_layer(self):
        """Returns whether a body of the scene is bonded to another one."""
        return any(value for key, value in self.inputs.items() if key.endswith("/Bonded to"))

    @property
    def not_reported(self):
        """Returns why the run reports no craters and fragments, if it has ended before they had come about; else None."""
        remark = self.summary.get("not_settled_remark") or ""
        return remark if remark.startswith("not reported") else None

    @property
    def time_of_answer(self):
        """Returns the time of the exit velocity, s: that of the tail's exit, or the end of a run that has ended before it."""
        return self.number("simulated_time" if self.not_reported else "time_of_exit")

    @property
    def exit_velocity(self):
        """Returns the exit velocity, m/s: 0 if the projectile was stopped; None if it was still moving or not asked for."""
        value = self.number("exit_velocity")
        return value if self.summary.get("perforated") is not False or value == 0 else None

    @property
    def exit_band(self):
        return None if self.exit_velocity is None else self.band("exit_velocity")

    @property
    def depth_key(self):
        """Returns the key of the depth of penetration. Beside an exit velocity it has a prefix."""
        prefix = f"{self.projectile}_{self.target}_".replace(" ", "_")
        return f"{prefix}penetration_depth" if self.number("penetration_depth") is None else "penetration_depth"

    @property
    def penetration_depth(self):
        """Returns the depth of penetration, m; None if it was not asked for."""
        return self.number(self.depth_key)


class Taylor(Impact):
    MAIN = inputs_by_role.BAR

    @property
    def has_anvil(self):
        """Returns whether there is a deformable body besides the bar."""
        return any(value == "deformable" for key, value in self.inputs.items()
                   if key.endswith("/Model") and not key.startswith(f"{self.MAIN}/"))

    @property
    def initial_length(self):
        """Returns the initial length, m, from the input or else from the points; None without fields."""
        given = inputs_by_role.length(self.inputs.get(f"{self.MAIN}/Height"))
        return given or (None if self.frame is None else float(np.ptp(self.frame.initial[:, 2])))


@dataclass
class Scaling(Result):
    """Runs on many ranks (shared/study, Kind = scaling): their summaries and the assumptions of the model."""

    record: dict = field(default_factory=dict)


@dataclass
class Curve(Result):
    """An answer against a swept key (shared/study, Kind = curve)."""

    record: dict = field(default_factory=dict)  # curve.json


@dataclass
class Limit(Result):
    """The velocity or thickness that is just perforated or scabbed (shared/study, Kind = limit)."""

    record: dict = field(default_factory=dict)  # limit.json
    rows: list = field(default_factory=list)  # limit.csv: a dict for each run, exit velocities as numbers or None


@dataclass
class Uncertainty(Result):
    """Samples of uncertain inputs (shared/study, Kind = uncertainty)."""

    record: dict = field(default_factory=dict)  # uncertainty.json
    base: Result | None = None  # the input as it is
