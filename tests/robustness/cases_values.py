"""Values: units, ranges, overflow, and what no body or material has."""

from fixtures import BAR, CELL, MATERIAL, PATH, SLAB, TINY_BAR, TINY_CELL, TINY_SLAB
from harness import Case

# A key of every dimension, with a unit that it takes.
QUANTITIES = (("penetrate", "bar/Diameter", "mm"), ("penetrate", "bar/Height", "m"), ("penetrate", "bar/Velocity", "m/s"),
              ("penetrate", "Time/End time", "us"), ("penetrate", "bar/J2/Density", "kg/m3"),
              ("penetrate", "bar/J2/Young's modulus", "GPa"), ("penetrate", "Output/Frame interval", "us"),
              ("microcell", "Material/Fracture energy", "N/m"), ("microcell", "Material/Young's modulus", "GPa"),
              ("microcell", "Cell/Sizes", "mm"), ("material_point", "J2/Yield stress", "MPa"))
BAD_NUMBERS = ("", "nan", "inf", "-inf", "1e999", "0x10", "1e", "--1", "1..2", "one", "1 2", "1,5", "½", "1_000")
NUMBERS = (("penetrate", "Time/Step factor"), ("penetrate", "Contact/Friction"), ("penetrate", "bar/J2/Poisson's ratio"),
           ("microcell", "Material/Poisson's ratio"))
INTEGERS = (("penetrate", "bar/Rings"), ("penetrate", "Integration/Refresh interval"), ("microcell", "Mesh/Elements"),
            ("material_point", "Path/Substeps"))
START = {"penetrate": [BAR], "microcell": [CELL], "material_point": [MATERIAL, PATH]}


def cases(_):
    for program, key, unit in QUANTITIES:
        for value in (f"1 {unit}x", "1", f"nan {unit}", f"inf {unit}", f"1e999 {unit}", unit, f"-1e300 {unit}", f"1e308 {unit}",
                      f"1 {unit} {unit}"):
            yield of(program, f"{key}={value}", [key.split("/")[-1]])
    for program, key in NUMBERS:
        for value in BAD_NUMBERS:
            yield of(program, f"{key}={value}", [key.split("/")[-1]])
        yield of(program, f"{key}=1 mm", [key.split("/")[-1]])
    for program, key in INTEGERS:
        for value in ("1.5", "99999999999999999999", "-1", "0x2", "", "1e2", "2 mm"):
            yield of(program, f"{key}={value}", [key.split("/")[-1]])
    yield from bodies()
    yield from materials()
    yield from cells()


def of(program, change, says):
    return Case("values", change, program, [*START[program], change], says=says)


def bodies():
    for changes, says in (
            (["bar/Diameter=1e-300 m"], ["Diameter"]),
            (["bar/Diameter=1e-30 m"], ["Diameter"]),
            (["bar/Height=1e-30 m"], ["Height"]),
            (["bar/Hole diameter=7.62 mm"], ["Hole"]),
            (["bar/Hole diameter=8 mm"], ["Hole"]),
            (["bar/Rings=100000", "bar/Layers=100000"], ["points"]),
            (["bar/Rings=100000", "bar/Layers=1"], ["points"]),
            (["bar/Fine spacing=1 nm"], ["Fine spacing"]),
            (["bar/Fine spacing=1e-12 m", "bar/Fine radius=3 mm"], []),
            (["Output/History interval=1e-300 s"], ["History interval"]),
            (["Output/Frame interval=1e-12 s"], ["Frame interval"]),
            (["bar/Velocity=0 m/s"], []),
            (["bar/Velocity=373 m/s"], ["Velocity"]),
            (["bar/Model=none"], []),
            (["bar/Shape=none"], []),
            (["bar/Shape=banana"], ["Shape"]),
            (["wall/Model=deformable"], ["wall"]),
            (["wall/Before=moon"], ["moon"]),
            (["wall/Before=wall"], ["wall"]),
            (["Answers/Length=moon"], ["moon"]),
            (["Answers/Length=bar, bar"], ["bar"]),
            (["Answers/Length=bar,"], []),
            (["Scene/Symmetry planes=x, x"], ["Symmetry"]),
            (["Scene/Symmetry planes=x,"], ["Symmetry"]),
            (["Scene/Symmetry planes=z"], ["Symmetry"]),
            (["Scene/Symmetry planes=none, x"], ["Symmetry"]),
            (["bar/Diameter=1e6 m", "bar/Height=1e-9 m"], []),
            (["wall/Shape=cylinder", "wall/Diameter=1e6 m", "wall/Height=1 nm"], []),
            (["bar/Rings=0", "bar/Layers=0", "bar/Fine spacing=1 um", "bar/Fine radius=3.8 mm", "bar/Coarse spacing=1 um"], ["memory"]),
            (["bar/Shape=block", "bar/Width=1 m", "bar/Depth=1 m", "bar/Spacing=10 um", "Scene/Symmetry planes=x, y"], ["memory"]),
            (["bar/Shape=sphere", "bar/Layers=100000", "bar/Boundary points=centred"], ["memory"]),
            (["bar/Layout=hexagons"], ["Layout"])):
        yield Case("values", "bar: " + ", ".join(changes), "penetrate", [BAR, *TINY_BAR[2:], *changes], says=says)
    for changes, says in (
            (["projectile/Diameter=2 m", "projectile/Length=20 m"], ["wide"]), (["projectile/Velocity=-313 m/s"], ["Velocity"]),
            (["projectile/Velocity=0 m/s"], ["Velocity"]), (["projectile/Axial moment=1e9 kg m2"], ["moment"]),
            (["projectile/Axial moment=1 kg m2", "projectile/Transverse moment=1 kg m2"], ["Axial moment"]),
            (["projectile/Centre of mass=10 m"], ["Centre of mass"]), (["projectile/Length=1 mm"], ["Length"]),
            (["projectile/Mass=1e-300 kg"], ["Mass"]), (["slab/Height=1e-30 m"], ["Height"]),
            (["projectile/Offset x=0.5 m"], ["Offset"]),
            (["projectile/Obliquity=80 deg"], ["Symmetry"]),
            (["Answers/Exit=projectile through projectile"], []), (["Answers/Exit=slab through projectile"], []),
            (["Answers/Exit=projectile"], ["Exit"]), (["Answers/Exit=projectile through"], ["Exit"]),
            (["slab/AFC/Damage table=none.h5"], ["none.h5"]), (["slab/AFC/Damage table={here}"], []),
            (["slab/AFC/Damage table=/dev/zero"], ["/dev/zero"]), (["slab/AFC/Damage table=/dev/null"], ["/dev/null"])):
        yield Case("values", "slab: " + ", ".join(changes), "penetrate", [SLAB, *TINY_SLAB, *changes], says=says)


def materials():
    for law, changes, says in (
            ("aluminium_6061_t6", ["J2/Poisson's ratio=0.5"], ["Poisson"]),
            ("aluminium_6061_t6", ["J2/Yield stress=0 Pa"], ["Yield"]),
            ("aluminium_6061_t6", ["J2/Young's modulus=1e-300 Pa"], ["Young"]),
            ("aluminium_6061_t6", ["Material/Law=gold"], ["gold"]),
            ("aluminium_6061_t6", ["Material/Law=AFC"], []),
            ("aluminium_6061_t6", ["J2/Density=1e-300 kg/m3"], ["Density"]),
            ("wes5000", ["AFC/T_max=0 Pa"], ["T_max"]),
            ("wes5000", ["AFC/C1=-1 MPa"], ["C1"]),
            ("wes5000", ["AFC/K1=-1 MPa"], ["AFC/K1", "slope"]),
            ("wes5000", ["AFC/K2=-90 GPa"], ["AFC/K1", "slope"]),
            ("wes5000", ["AFC/K3=-1000 GPa"], ["AFC/K1", "slope"]),
            ("wes5000", ["AFC/Hydrostat=printed", "AFC/K2=-90 GPa"], ["AFC/K1", "slope"]),
            ("concrete_48_hjc", ["HJC/Plock=1 MPa"], ["Plock"]),
            ("concrete_48_hjc", ["HJC/K2=-1000 GPa"], ["K2"]),
            ("concrete_48_hjc", ["HJC/Density=0 kg/m3"], ["Density"]),
            ("concrete_35_rht", ["RHT/Density=0 kg/m3"], ["Density"])):
        yield Case("values", f"{law}: " + ", ".join(changes), "material_point",
                   [f"{{data}}/materials/{law}.prm", PATH, "Path/Spacing=1 mm", *changes], says=says)


def cells():
    for changes, says in (
            (["Cell/Sizes=16 mm, 8 mm"], ["Sizes"]), (["Cell/Sizes=16 mm,"], ["Sizes"]), (["Cell/Sizes=,16 mm"], ["Sizes"]),
            (["Cell/Reference size=1 m"], ["Reference size"]), (["Cell/Initial crack=1"], ["Initial crack"]),
            (["Cell/Initial crack=-0.1"], ["Initial crack"]), (["Cell/Dimension=4"], ["Dimension"]),
            (["Material/Tensile strength=0 Pa"], ["strength"]), (["Material/Poisson's ratio=0.5"], ["Poisson"]),
            (["Cell/Sizes=1e-300 m", "Cell/Reference size=1e-300 m"], ["Sizes"]), (["Mesh/Elements=100000"], ["Elements"]),
            (["Mesh/Elements=0"], ["Elements"]), (["Mesh/Degree=99"], ["Degree"]), (["Mesh/Grading=1e300"], ["Grading"]),
            (["Ensemble/Samples=-1"], ["Samples"]), (["Ensemble/Samples=1000000000"], ["Samples"]),
            (["Ensemble/Samples=3", "Ensemble/Band=0.9"], ["Band"]), (["Stepping/Row growth=1e-12"], ["growth"])):
        yield Case("values", "cell: " + ", ".join(changes), "microcell", [CELL, *TINY_CELL[2:], *changes], says=says)
