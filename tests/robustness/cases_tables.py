"""Damage tables that are cut, changed, hostile, or physically impossible; strain paths and contours."""

import os
import shutil

import h5py
import numpy as np

from fixtures import MATERIAL, PATH
from harness import ROOT, Case
from sealed import seal

TABLE = ROOT / "data" / "tables" / "wes5000.h5"
WORDS = ["{data}/materials/wes5000.prm", PATH, "Path/Spacing=10 mm", "AFC/Damage table=t.h5"]


def cases(_):
    whole = TABLE.read_bytes()
    for count in (0, 1, 8, 100, 2048, len(whole) // 2, len(whole) - 33, len(whole) - 32, len(whole) - 1):
        yield damaged(f"cut to {count} bytes", whole[:count])
    for k in range(40):
        place = (len(whole) * (2 * k + 1)) // 80
        yield damaged(f"byte {place} of {len(whole)} is another one", flipped(whole, place))
    yield damaged("a byte more", whole + b"\0")
    yield damaged("bytes of zero", bytes(len(whole)))
    yield damaged("a text", b"no table\n" * 100)
    yield damaged("a size beyond the file", whole[:-24] + b"\xff" * 8 + whole[-16:])
    yield damaged("more parts than there are", whole[:-32] + b"\xff" * 8 + whole[-24:])
    yield Case("damage tables", "a pipe", "material_point", WORDS, says=["t.h5", "pipe"], before=lambda work: os.mkfifo(work / "t.h5"))
    yield Case("damage tables", "a folder", "material_point", WORDS, says=["t.h5", "folder"],
               before=lambda work: (work / "t.h5").mkdir())
    for name, change, says in CHANGES:
        yield Case("damage tables", name, "material_point", WORDS, says=["t.h5", *says],
                   before=lambda work, change=change: changed(work / "t.h5", change))
    yield Case("damage tables", "a whole one", "material_point", WORDS, code=0,
               before=lambda work: shutil.copyfile(TABLE, work / "t.h5"))
    yield from paths()
    yield from contours()


def damaged(name, content):
    return Case("damage tables", name, "material_point", WORDS, says=["t.h5"], files={"t.h5": content})


def flipped(content, place):
    return content[:place] + bytes([content[place] ^ 0x40]) + content[place + 1:]


def changed(path, change):
    """Changes a table by HDF5 itself and seals it again: what only the reader can refuse."""
    shutil.copyfile(TABLE, path)
    with h5py.File(path, "r+") as file:
        change(file)
    seal(path)


def attribute(name, value, group="/"):
    def change(file):
        del file[group].attrs[name]
        file[group].attrs[name] = value
    return change


def column(name, value, rows=None):
    """Replaces a column, or gives some rows of it a value."""
    def change(file):
        array = np.array(file[f"curves/0/{name}"])
        replace(file, name, value(array) if callable(value) else np.where(rows(len(array)), value, array) if rows else value)
    return change


def replace(file, name, array, **options):
    del file[f"curves/0/{name}"]
    made = file["curves/0"].create_dataset(name, data=array, **options)
    made.attrs["unit"] = np.bytes_({"strain": "1", "stress": "Pa", "opening": "m"}.get(name, "1" if "damage" in name else "J/m3"))


def at(place):
    return lambda count: np.arange(count) == (place if place >= 0 else count + place)


def external_link(file):
    del file["curves/0/stress"]
    file["curves/0/stress"] = h5py.ExternalLink("/etc/passwd", "/x")


def soft_link(file):
    del file["curves/0/stress"]
    file["curves/0/stress"] = h5py.SoftLink("/curves/0/strain")


def external_storage(file):
    count = len(file["curves/0/stress"])
    del file["curves/0/stress"]
    file["curves/0"].create_dataset("stress", shape=(count,), dtype="f8", external=[("/etc/passwd", 0, 8 * count)])


def virtual(file):
    count = len(file["curves/0/stress"])
    del file["curves/0/stress"]
    layout = h5py.VirtualLayout(shape=(count,), dtype="f8")
    layout[:] = h5py.VirtualSource("other.h5", "stress", shape=(count,))
    file["curves/0"].create_virtual_dataset("stress", layout)


def huge(file):
    del file["curves/0/stress"]
    file["curves/0"].create_dataset("stress", shape=(1 << 40,), dtype="f8", chunks=(1024,))


def no_curves(file):
    del file["curves"]
    file.create_group("curves")


CHANGES = (
    ("Young's modulus of 0", attribute("youngs_modulus", 0.0), ["Young"]),
    ("Young's modulus infinite", attribute("youngs_modulus", float("inf")), ["Young"]),
    ("Young's modulus NaN", attribute("youngs_modulus", float("nan")), ["Young"]),
    ("Young's modulus 1e300", attribute("youngs_modulus", 1e300), ["Young"]),
    ("Young's modulus a list", attribute("youngs_modulus", [3e10] * 1000), ["youngs_modulus"]),
    ("Young's modulus an empty list", attribute("youngs_modulus", h5py.Empty("f8")), ["youngs_modulus"]),
    ("Young's modulus a text", attribute("youngs_modulus", "3e10"), ["youngs_modulus"]),
    ("Young's modulus missing", lambda file: file.attrs.__delitem__("youngs_modulus"), ["youngs_modulus"]),
    ("Poisson's ratio 0.7", attribute("poisson_ratio", 0.7), ["Poisson"]),
    ("strength infinite", attribute("tensile_strength", float("inf")), ["strength"]),
    ("fracture energy NaN", attribute("fracture_energy", float("nan")), ["fracture energy"]),
    ("another format", attribute("format_version", 99), ["99"]),
    ("format a list", attribute("format_version", [2, 2, 2]), ["format_version"]),
    ("units a list of texts", attribute("units", np.array([b"SI"] * 100)), ["units"]),
    ("units of variable length", attribute("units", "SI"), ["units"]),
    ("other units", attribute("units", np.bytes_("imperial")), ["imperial"]),
    ("cell size 0", attribute("cell_size", 0.0, "curves/0"), ["size"]),
    ("cell size infinite", attribute("cell_size", float("inf"), "curves/4"), ["size"]),
    ("relative strength NaN", attribute("relative_strength", float("nan"), "curves/0"), ["relative strength"]),
    ("no curves", no_curves, ["curve"]),
    ("curves are an array", lambda file: (file.__delitem__("curves"), file.create_dataset("curves", data=[1.0])), ["curves"]),
    ("a curve is missing", lambda file: file.__delitem__("curves/0"), []),
    ("a column is missing", lambda file: file.__delitem__("curves/0/stress"), ["stress"]),
    ("a column is a group", lambda file: (file.__delitem__("curves/0/stress"), file.create_group("curves/0/stress")), ["stress"]),
    ("a column of texts", lambda file: replace(file, "stress", np.array([b"x"] * 9)), ["stress"]),
    ("a column of two dimensions", column("stress", lambda array: np.array([array, array])), ["stress"]),
    ("a column of none", column("stress", 1.0), ["stress"]),
    ("a column without rows", column("stress", np.zeros(0)), ["stress"]),
    ("a column of one row", column("strain", np.zeros(1)), ["row"]),
    ("a column a row shorter", column("stress", lambda array: array[:-1]), ["stress"]),
    ("a column of 2^40 rows", huge, ["stress"]),
    ("a packed column", lambda file: replace(file, "stress", np.array(file["curves/0/stress"]), compression="gzip"), ["stress"]),
    ("a link to another file", external_link, ["stress"]),
    ("a link within the file", soft_link, ["stress"]),
    ("values in another file", external_storage, ["stress"]),
    ("a virtual column", virtual, ["stress"]),
    ("a strain of 1e300", column("strain", 1e300, at(-1)), ["strain"]),
    ("a strain that falls", column("strain", 0.0, at(5)), ["strain"]),
    ("a strain NaN", column("strain", float("nan"), at(5)), ["strain"]),
    ("a first strain above 0", column("strain", 1e-9, at(0)), ["strain"]),
    ("no stress at all", column("stress", lambda array: 0 * array), ["stress"]),
    ("a stress that presses", column("stress", lambda array: -array), ["stress"]),
    ("a stress infinite", column("stress", float("inf"), at(3)), ["stress"]),
    ("a stress of 1e300", column("stress", 1e300, at(3)), ["stress"]),
    ("a damage above 1", column("damage", 1.5, at(-1)), ["damage"]),
    ("a damage that falls", column("damage", lambda array: array[::-1].copy()), ["damage"]),
    ("a negative energy", column("psi", -1e3, at(4)), ["psi"]),
    ("a negative opening", column("opening", -1e-3, at(4)), ["opening"]),
    ("a dissipation that falls", column("dissipation", -1.0, at(-1)), ["dissipation"]),
    ("another unit", lambda file: attribute("unit", np.bytes_("psi"), "curves/0/stress")(file), ["psi"]))

HEAD = "time,exx,eyy,ezz,exy,eyz,exz\n"


def paths():
    for name, text, says in (
            ("empty", "", []),
            ("only a header", HEAD, []),
            ("one row", HEAD + "0,0,0,0,0,0,0\n", []),
            ("no header", "0,0,0,0,0,0,0\n1,1,0,0,0,0,0\n", ["time"]),
            ("a column missing", "time,exx\n0,0\n", ["eyy"]),
            ("a column twice", HEAD.replace("eyy", "exx") + "0,0,0,0,0,0,0\n", ["exx"]),
            ("a column more", HEAD.strip() + ",x\n0,0,0,0,0,0,0,0\n", ["x"]),
            ("a cell missing", HEAD + "0,0,0,0,0,0,0\n1,0,0\n", [":3"]),
            ("a cell more", HEAD + "0,0,0,0,0,0,0,0\n", [":2"]),
            ("a decimal comma", HEAD + "0;0;0;0;0;0;0\n", [":2"]),
            ("a word", HEAD + "0,0,0,0,0,0,0\n1,x,0,0,0,0,0\n", [":3", "exx"]),
            ("NaN", HEAD + "0,0,0,0,0,0,0\n1,nan,0,0,0,0,0\n", [":3", "exx"]),
            ("infinite", HEAD + "0,0,0,0,0,0,0\n1,inf,0,0,0,0,0\n", [":3", "exx"]),
            ("1e999", HEAD + "0,0,0,0,0,0,0\n1,1e999,0,0,0,0,0\n", [":3"]),
            ("a strain of 1e300", HEAD + "0,0,0,0,0,0,0\n1,1e300,0,0,0,0,0\n", [":3", "exx"]),
            ("a strain of -2", HEAD + "0,0,0,0,0,0,0\n1,-2,0,0,0,0,0\n", [":3", "exx"]),
            ("a time of 1e300", HEAD + "0,0,0,0,0,0,0\n1e300,0.1,0,0,0,0,0\n", [":3", "time"]),
            ("time that stands", HEAD + "0,0,0,0,0,0,0\n0,0.1,0,0,0,0,0\n", [":3", "time"]),
            ("time that falls", HEAD + "1,0,0,0,0,0,0\n0,0.1,0,0,0,0,0\n", [":3", "time"]),
            ("a quote that is not closed", HEAD + '0,"0,0,0,0,0,0\n', [":2"]),
            ("NUL bytes", HEAD + "\0\0\0\n", [":2", "NUL"]),
            ("escape sequences", "\x1b[31m" + HEAD, []),
            ("a line of 1 MB", HEAD + "1" * 1_000_000 + "\n", [":2"]),
            ("UTF-16", HEAD.encode("utf-16"), []),
            ("random bytes", bytes((i * 7919) % 251 + 1 for i in range(3000)), [])):
        yield Case("tables in CSV", f"a path: {name}", "material_point", [MATERIAL, "p.csv"], says=["p.csv", *says],
                   files={"p.csv": text})
    for name, place in (
            ("a folder", "{here}"),
            ("a device", "/dev/zero"),
            ("nothing", "none.csv"),
            ("no CSV at all", "/etc/passwd")):
        yield Case("tables in CSV", f"a path: {name}", "material_point", [MATERIAL, place], says=[place.replace("{here}", "")], hides=["root:"])


def contours():
    scene = "include {scene}\nset projectile/Shape = profile\nset projectile/Profile = c.csv\n"
    scene = scene.replace("{scene}", str(ROOT / "data" / "scenes" / "slab_127.prm"))
    for name, text in (
            ("empty", ""),
            ("only a header", "z,r\n"),
            ("one point", "z,r\n0,0\n"),
            ("NaN", "z,r\n0,0\n1,nan\n"),
            ("a negative radius", "z,r\n0,0\n-0.1,-0.1\n-0.2,0\n"),
            ("a body that crosses itself", "z,r\n0,0\n-0.1,0.1\n0,0.1\n"),
            ("huge", "z,r\n0,0\n-1e300,1e300\n"),
            ("tiny", "z,r\n0,0\n-1e-300,1e-300\n"),
            ("words", "z,r\na,b\n")):
        yield Case("tables in CSV", f"a contour: {name}", "penetrate", ["s.prm", "slab/Rings=8", "slab/Layers=4"],
                   says=["c.csv" if name != "no" else ""], files={"s.prm": scene, "c.csv": text})
