"""Command line of shared/tension."""

import argparse
import math
import pathlib
import sys

import numpy as np

import frames
import tension
from files import Unreadable, attributes, read_numbers
from writing import Parser, Refused

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "empirical"))

import scene_shot  # noqa: E402

MEASURED = pathlib.Path(__file__).resolve().parents[2] / "data" / "experiments" / "spall_bar.csv"
EPILOG = """examples:

  build/macro/penetrate data/scenes/spall_bar.prm && shared/tension spall out/spall_bar
  build/macro/penetrate data/scenes/direct_tension.prm && shared/tension pull out/direct_tension
  build/macro/penetrate data/scenes/splitting_cube.prm && shared/tension split out/splitting_cube

spall: the main body is a bar along z whose upper end is free; a pulse enters it from below. Strength by the pull-back of the free
end, density c_0 (v_max - v_min) / 2, with density and c_0 of the computed bar: c_0 is the root of Young's modulus over density.
pull: the main body is a bar between two bodies that are bonded to it and fly apart. Strength is the largest force over the
smallest section. The force follows from the momentum of the bodies, as by a load cell.
split: the main body is a block between two strips that are bonded to it and press it along z. Strength is 2 F / (pi h b), h and b
the height and depth of the block (EN 12390-6), with the largest force F.

spall and pull: the fracture energy is the work of the force on the opening, over the section, until the force has fallen to 5 % of its
peak; if it does not fall so far, the command says so. A spall bar can break in several planes at once: the work is that of all cracks
in a gauge of 0.7 diameters around the widest one, over their number. Layers of points must be level (no Jitter). Beside them stand the measured values of data/experiments/spall_bar.csv."""


def parser():
    made = Parser(prog="tension", description="Strength and fracture energy of concrete, read off a computed "
                                   "test in tension as the experimenters do.", epilog=EPILOG,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("test", choices=("spall", "pull", "split"))
    made.add_argument("folder", metavar="RESULT", help="result folder of penetrate")
    return made


def layers_of(place, spacing):
    """Returns the layer of each point, counted from below: a layer begins where z has grown by a third of the spacing."""
    order = np.argsort(place)
    layer = np.empty(len(place), dtype=int)
    layer[order] = np.concatenate([[0], np.cumsum(np.diff(place[order]) > spacing / 3)])
    return layer


class Result:
    """Frames of a result folder with its inputs. @raises Refused, Unreadable"""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.path = self.folder / "fields.h5"
        self.keys = scene_shot.read_keys(self.folder / "resolved.prm")
        try:
            with frames.opened(self.path) as index:
                self.main = attributes(index).get("main_body")
                self.initial = frames.initial_of(index, self.path)
                self.bodies = [name for name, arrays in self.initial.items() if "volume" in arrays]
                self.frames = frames.frame_names(index)
        except (OSError, KeyError, ValueError) as error:
            raise Unreadable(f"{self.path}: {error}") from error

    def check(self):
        """@raises Refused: the frames do not show the test"""
        if len(self.frames) < 10 or self.main not in self.bodies:
            raise Refused(f"{self.path}: found {len(self.frames)} frames of the main body '{self.main}', allowed: 10 or more of a "
                          "deformable one")

    def body(self, name):
        return scene_shot.Body(self.keys, name, self.folder / "resolved.prm")

    def tied(self):
        """Returns the names of the bodies that are bonded to the main one."""
        return [name for name in self.bodies if self.body(name).text("Bonded to") == self.main]

    def kind(self):
        """Returns which test the bodies make up: pull or split (two tied bodies, of a bar or of a block), spall (a body stands before
        the main one, which has a free end), or None."""
        if len(self.tied()) == 2:
            return "split" if self.body(self.main).text("Shape") == "block" else "pull"
        before, behind = (any(self.body(name).text(key) == self.main for name in self.bodies) for key in ("Before", "Behind"))
        return "spall" if before and not behind and not self.tied() else None

    def law(self, name):
        return self.body(name).text("Material/Law", "AFC")

    def density(self, name):
        return self.body(name).number(f"{self.law(name)}/Density", "density")

    def size(self, name):
        """Returns (section, length) of a body along z, of one with a contour the smallest section. @raises Refused"""
        body, shape = self.body(name), self.body(name).text("Shape")
        if shape == "block":
            return body.number("Width", "length") * body.number("Depth", "length"), body.number("Height", "length")
        if shape == "profile":
            contour = read_numbers(self.folder / body.text("Profile"))
            z, r = contour["z"], contour["r"]
            return math.pi * float(r[(r > 0)].min())**2, float(np.ptp(z))
        if shape != "cylinder":
            raise Refused(f"{body.where('Shape')}: found '{shape}', allowed: cylinder, block or profile")
        return 0.25 * math.pi * body.number("Diameter", "length")**2, body.number("Height", "length")

    def bar(self, name):
        """Returns a body as layers. @raises Refused, Unreadable"""
        (area, length), density = self.size(name), self.density(name)
        try:
            start = self.initial[name]
            place, volume = start["initial_position"][:, 2].astype(float), start["volume"].ravel().astype(float)
            layer = layers_of(place, float(np.median(start["spacing"])))
            weight = np.bincount(layer, volume)
            time, displacement, velocity = (np.array(column) for column in zip(*self.rows(name, layer, volume / weight[layer])))
        except (OSError, KeyError, ValueError) as error:
            raise Unreadable(f"{self.path}: {error}") from error
        if len(weight) < 3:
            raise Refused(f"{self.path}: found {len(weight)} layers of points in '{name}', allowed: 3 or more (level ones: no "
                          "Jitter)")
        mass = density * area * length * weight / volume.sum()
        return tension.Bar(time, np.bincount(layer, volume * place) / weight, mass, displacement, velocity, area, density)

    def rows(self, name, layer, share):
        """Yields the time of each frame, and the displacement and velocity of each layer. @raises Unreadable, ValueError"""
        with frames.opened(self.path) as index:
            for frame in self.frames:
                with frames.open_frame(index, frame, self.path) as group:
                    yield float(group.attrs["time"]), *(np.bincount(layer, share * frames.values(group[name], field)[:, 2])
                                                        for field in ("displacement", "velocity"))

    def youngs_modulus(self, name):
        """Returns the modulus of a body of AFC or J2. @raises Refused"""
        body, law = self.body(name), self.law(name)
        if law == "J2":
            return body.number("J2/Young's modulus", "stress")
        if law != "AFC":
            raise Refused(f"{body.where('Material/Law')}: found '{law}', allowed: AFC or J2, whose Young's modulus is known")
        bulk = body.number("AFC/C6", "stress") / scene_shot.plain(body.text("AFC/C7"), body.where("AFC/C7"), 0)
        shear = body.number("AFC/Shear modulus", "stress")
        return 9 * bulk * shear / (3 * bulk + shear)


def evaluate_spall(result):
    """Returns (tension.Spall, c_0, density) of a result. @raises Refused, Unreadable"""
    result.check()
    bar = result.bar(result.main)
    if len(bar.place) < 10:
        raise Refused(f"{result.path}: found {len(bar.place)} layers of points, allowed: 10 or more")
    speed = math.sqrt(result.youngs_modulus(result.main) / bar.density)
    return tension.spall(bar, speed), speed, bar.density


def between_ends(result):
    """Returns (time, opening, momentum) of the two bodies that are bonded to the main one: how far they have parted, and the mean
    momentum along which they part. @raises Refused, Unreadable"""
    tied = result.tied()
    if len(tied) != 2:
        raise Refused(f"{result.folder}: found {len(tied)} bodies bonded to '{result.main}', allowed: two")
    low, high = sorted((result.bar(name) for name in tied), key=lambda bar: bar.place[0])
    momenta = [bar.velocity @ bar.mass for bar in (low, high)]
    return low.time, high.displacement[:, 0] - low.displacement[:, -1], 0.5 * (momenta[1] - momenta[0])


def evaluate_pull(result):
    """Returns tension.Pull of a result. @raises Refused, Unreadable"""
    result.check()
    time, opening, momentum = between_ends(result)
    return tension.pull(time, opening, -momentum, *result.size(result.main))


def evaluate_split(result):
    """Returns tension.Split of a result. @raises Refused, Unreadable"""
    result.check()
    time, opening, momentum = between_ends(result)
    body = result.body(result.main)
    return tension.split(time, -opening, momentum, body.number("Height", "length"), body.number("Depth", "length"))


def measured(test):
    """Returns the row of the measured values: the static test, or the fast one."""
    table = read_numbers(MEASURED)
    row = int(np.argmin(table["strain_rate_1_s"])) if test == "pull" else int(np.argmax(table["strain_rate_1_s"]))
    return {name: float(values[row]) for name, values in table.items()}


def cell(value, factor=1.0, digits=4):
    return "-" if value is None else f"{factor * value:.{digits}g}"


def print_rows(found, test):
    """Prints the two results beside the measured ones."""
    row = measured(test)
    print(f"{'':28}{'computed':>10}{'measured':>10}{'ratio':>8}")
    for words, value, factor, column in (("strain rate (1/s)", found.rate, 1.0, "strain_rate_1_s"),
                                         ("tensile strength (MPa)", found.strength, 1e-6, "tensile_strength_mpa"),
                                         ("fracture energy (N/m)", found.fracture_energy, 1.0, "fracture_energy_n_m")):
        known = value is not None and row[column] > 0 and column != "strain_rate_1_s"
        print(f"{words:28}{cell(value, factor):>10}{row[column]:>10g}{cell(factor * value / row[column], 1, 2) if known else '-':>8}")
    print(f"opening at the end: {1e6 * found.opening:.0f} um")
    if found.left:
        print(f"the crack still carries {100 * found.left:.0f} % of its peak force at the end: the fracture energy is larger")


def main(arguments):
    options = parser().parse_args(arguments)
    try:
        result = Result(options.folder)
        if options.test == "split":
            found, limit = evaluate_split(result), result.body(result.main).number("AFC/T_max", "stress")
            print(f"splitting strength {1e-6 * found.strength:.4g} MPa, {found.strength / limit:.2f} of T_max, when the strips have "
                  f"closed by {1e6 * found.closing:.0f} um; at the end they press with {100 * found.left:.0f} % of that force")
            return 0
        if options.test == "pull":
            print_rows(evaluate_pull(result), "pull")
            return 0
        found, speed, density = evaluate_spall(result)
        print(f"density {density:g} kg/m3, c_0 {speed:.0f} m/s (fronts {cell(found.wave_speed)} m/s), free end {found.top:.3g} m/s, "
              f"pulse {1e-6 * found.pulse_in:.1f} MPa at a tenth of the bar, {1e-6 * found.pulse_out:.1f} MPa a diameter before "
              "its end")
        print_rows(found, "spall")
        if found.strength is None:
            print("the free end does not rebound: no spall")
        if found.cracks > 1:
            print(f"{found.cracks} cracks within {tension.GAUGE:g} diameters have taken {found.cracks * found.fracture_energy:.0f} N/m together")
        print(f"widest crack {1e3 * found.distance:.0f} mm from the free end; it carried {1e-6 * found.carried:.2f} MPa")
        if not found.open:
            print("it is not open at the end: the work is no fracture energy")
    except Unreadable as error:
        raise Refused(str(error)) from error
    return 0
