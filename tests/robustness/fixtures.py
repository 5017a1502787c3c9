"""Files that the cases start from, made once by the programs themselves."""

import pathlib
import shutil
import subprocess

from harness import PROGRAMS, ROOT

TINY_BAR = ["bar/Rings=3", "bar/Layers=10", "Time/End time=1 us", "Run/Threads=1"]
TINY_SLAB = ["slab/Diameter=0.3 m", "slab/Rings=8", "slab/Layers=4", "Time/End time=10 us", "Run/Threads=1"]
BAR, SLAB = "{data}/scenes/taylor_aluminium.prm", "{data}/scenes/slab_127.prm"
CELL, MATERIAL, PATH = ("{data}/microcells/case_a.prm", "{data}/materials/aluminium_6061_t6.prm",
                        "{data}/experiments/uniaxial_tension.csv")
TINY_CELL = ["Cell/Sizes=16 mm", "Cell/Reference size=16 mm", "Mesh/Degree=1"]
# Its bulk stores more energy than its crack can take: the strain would have to fall.
BRITTLE_CELL = ["Cell/Sizes=1600 mm", "Cell/Reference size=1600 mm", "Mesh/Degree=1", "Mesh/Grading=1", "Mesh/Elements=40"]
TINY_ENSEMBLE = ["Ensemble/Samples=2", "Ensemble/Threads=1", "Mesh/Degree=1"]
ENSEMBLE = "{data}/microcells/ensemble.prm"


def make_fixtures(build, scratch):
    """Returns a folder with a finished bar (bar), microcell (cell), ensemble (ensemble), and slab with its table (slab, t.h5)."""
    folder = pathlib.Path(scratch) / "fixtures"
    folder.mkdir()

    def run(program, source, name, words):
        subprocess.run([build / PROGRAMS[program], source.replace("{data}", str(ROOT / "data")), "--output", folder / name, *words],
                       check=True, stdout=subprocess.DEVNULL)

    run("penetrate", BAR, "bar", TINY_BAR)
    run("microcell", CELL, "cell", TINY_CELL)
    run("microcell", ENSEMBLE, "ensemble", TINY_ENSEMBLE)
    shutil.copyfile(ROOT / "data" / "tables" / "wes5000.h5", folder / "t.h5")
    run("penetrate", SLAB, "slab", [*TINY_SLAB, f"slab/AFC/Damage table={folder / 't.h5'}"])
    return folder
