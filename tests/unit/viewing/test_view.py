"""shared/view: what it shows of which result, what it refuses, and, where ParaView is installed, its pictures."""

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests" / "unit" / "compare"))
sys.path.insert(0, str(ROOT / "shared" / "viewing"))

import synthetic  # noqa: E402
import solid  # noqa: E402
import view_plan  # noqa: E402
from files import Unreadable  # noqa: E402

import h5py  # noqa: E402  (after the folder of its own is known)
import sealed  # noqa: E402

PARAVIEW = all(map(shutil.which, ("pvpython", "Xvfb")))
SIZE = (1600, 1100)  # of a picture
HALF = 0.6  # a damage that a section must show


def array(values, name=None):
    values = np.atleast_1d(values)
    shape = " ".join(map(str, values.shape))
    item = f'<DataItem Dimensions="{shape}" NumberType="{"Int" if values.dtype.kind == "i" else "Float"}" Format="XML">' + \
        " ".join(map(str, values.ravel())) + "</DataItem>"
    kind = "Vector" if values.ndim == 2 else "Scalar"
    return f'<Attribute Name="{name}" AttributeType="{kind}" Center="Node">{item}</Attribute>' if name else item


def body(name, topology, corners, points, **fields):
    return (f'<Grid Name="{name}"><Topology TopologyType="{topology}" NumberOfElements="{len(corners)}" '
            f'NodesPerElement="{corners.shape[1]}">{array(corners)}</Topology><Geometry GeometryType="XYZ">{array(points)}</Geometry>'
            + "".join(array(values, key) for key, values in fields.items()) + "</Grid>")


def run(folder, symmetry, damaged, points):
    """A run of one frame as penetrate writes it, numbers inside: points of a slab, and a small pyramid as the projectile."""
    folder.mkdir()
    with h5py.File(folder / "fields.h5", "w") as file:
        file.attrs["symmetry_planes"] = symmetry
    sealed.seal(folder / "fields.h5")
    spacing = np.full(len(points), 0.02)
    vertices = np.arange(len(points))[:, None]
    pyramid = np.array([[0, 0, 0.1], [0.02, 0, 0.05], [-0.02, 0.02, 0.05], [-0.02, -0.02, 0.05]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    frame = body("slab", "Polyvertex", vertices, points, spacing=spacing, tensile_damage=1.0 * damaged,
                 shear_damage=0.0 * spacing) + body("dart", "Triangle", faces, pyramid)
    (folder / "fields.xdmf").write_text(
        '<?xml version="1.0"?>\n<Xdmf Version="3.0"><Domain><Grid Name="bodies" GridType="Collection" CollectionType="Temporal">'
        f'<Grid Name="frame 0" GridType="Collection" CollectionType="Spatial"><Time Value="0.001"/>{frame}</Grid></Grid></Domain>'
        "</Xdmf>\n", encoding="utf-8")
    return folder


def quarter(edge=0.02, count=10):
    """Points of a layer over the quarter x > 0, y > 0."""
    line = edge * (0.5 + np.arange(count))
    x, y = (a.ravel() for a in np.meshgrid(line, line, indexing="ij"))
    return np.column_stack([x, y, np.zeros(len(x))])


def view(*words, path=None):
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return subprocess.run(["/usr/bin/python3", ROOT / "shared" / "view", *words], capture_output=True, text=True,
                          env=environment | ({} if path is None else {"PATH": path}))


class Plans(synthetic.InFolder):
    def test_a_run_names_its_bodies_its_symmetry_and_its_damage(self):
        plan = view_plan.plan_of(run(self.folder / "shot", "x y", np.zeros(100), quarter()))
        self.assertEqual([(b["name"], b["kind"]) for b in plan["bodies"]], [("slab", "points"), ("dart", "surface")])
        self.assertEqual((plan["symmetry"], plan["colour"]["fields"], plan["colour"]["range"], plan["name"]),
                         (["x", "y"], ["tensile_damage", "shear_damage"], [0, 1], "shot"))

    def test_damage_has_the_colours_of_the_report(self):
        """The colour of sound concrete up to the smallest damage that pictures of the report show, then theirs; values rise."""
        nodes = np.reshape(view_plan.colour_of([{"kind": "points", "fields": ["tensile_damage"]}])["scale"], (-1, 4))
        self.assertTrue((np.diff(nodes[:, 0]) > 0).all())
        for damage in (0.0, 0.1, 0.2, 0.6, 0.9, 1.0):
            shown = [np.interp(damage, nodes[:, 0], nodes[:, i]) for i in (1, 2, 3)]
            np.testing.assert_allclose(shown, solid.colors_of(np.array([damage]))[0], atol=0.02)

    def test_points_without_damage_have_the_next_field(self):
        for fields, title in ((["plastic_strain", "spacing"], "plastic strain"), (["equivalent_stress"], "equivalent stress (Pa)"),
                              (["spacing"], "")):
            self.assertEqual(view_plan.colour_of([{"kind": "points", "fields": fields}])["title"], title)

    def test_the_largest_displacement_of_a_cell_is_about_a_seventh_of_it(self):
        """To one digit of the factor, so from 2/3 to 4/3 of the share; the crack of the state nearest to half of the strength."""
        folder = synthetic.microcell(self.folder / "cell")
        plan = view_plan.plan_of(folder)
        moved = {49: 1e-7, 448: 5e-6}[plan["time"]] * plan["factor"] / 0.016  # of synthetic.microcell()
        self.assertTrue(2 / 3 <= moved / view_plan.SHARE <= 4 / 3, moved)

    def test_what_cannot_be_shown_is_said_in_one_line(self):
        (self.folder / "empty").mkdir()
        damaged = run(self.folder / "damaged", "x", np.zeros(100), quarter())
        (damaged / "fields.xdmf").write_text("<Xdmf><Domain/></Xdmf>", encoding="utf-8")
        for folder, words in (("none", "no such folder"), ("empty", "neither fields.xdmf nor fields.pvd"), ("damaged", "no frame")):
            with self.assertRaisesRegex(Unreadable, words):
                view_plan.plan_of(self.folder / folder)


class Command(synthetic.InFolder):
    def test_without_paraview_it_says_what_to_install_and_writes_nothing(self):
        folder = run(self.folder / "shot", "x y", np.zeros(100), quarter())
        ran = view(folder, "--picture", self.folder / "a.png", path=str(self.folder))
        self.assertEqual(ran.returncode, 2)
        self.assertIn("found no program 'pvpython'", ran.stderr)
        self.assertIn("apt-get install paraview python3-paraview xvfb", ran.stderr)
        self.assertEqual(ran.stderr.count("\n"), 1)
        self.assertIn("found no program 'pvpython'", view(folder, "--film", self.folder / "film", path=str(self.folder)).stderr)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["shot"])
        self.assertEqual(sorted(path.name for path in folder.iterdir()), ["fields.h5", "fields.xdmf"])

    def test_bad_arguments_are_refused_before_anything_is_written(self):
        folder = run(self.folder / "shot", "x y", np.zeros(100), quarter())
        (self.folder / "there.png").write_text("old", encoding="utf-8")
        (folder / "view.pvsm").write_text("old", encoding="utf-8")
        for words, says in (
                ([], "FOLDER"), (["none"], "no such folder"), ([folder, "--picture", "a.jpg"], "ends with .png"),
                ([folder, "--picture", self.folder / "there.png"], "--force"), ([folder], "view.pvsm"),
                ([folder, "--picture", self.folder / "no" / "a.png"], "there is no folder"), ([folder, "--nonsense"], "--nonsense"),
                ([folder, "--film", self.folder / "there.png"], "a folder"), ([folder, "--film", folder], "--force"),
                ([folder, "--film", "film", "--picture", "a.png"], "without --picture")):
            ran = view(*words)
            self.assertEqual((ran.returncode, ran.stderr.count("\n")), (2, 1), ran.stderr)
            self.assertIn(says, ran.stderr)
        self.assertEqual((self.folder / "there.png").read_text(), "old")


@unittest.skipUnless(PARAVIEW, "ParaView is not installed")
class Pictures(synthetic.InFolder):
    def picture(self, folder, *more):
        made = self.folder / f"{folder.name}.png"
        ran = view(folder, "--picture", made, "--force", *more)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertIn("ParaView", made.with_suffix(".pvsm").read_text(encoding="utf-8")[:200])
        from PIL import Image
        with Image.open(made) as picture:
            self.assertEqual(picture.size, SIZE)
            return np.asarray(picture.convert("RGB")).astype(int)[:, :1350]  # without the scale

    def shown(self, pixels, damaged):
        """Returns which pixels are of concrete of the damage HALF, which is reddish, or of the bluish steel."""
        red, green, blue = (pixels[:, :, i] for i in range(3))
        return (red > 1.8 * green) & (red > 40) if damaged else (blue > green + 3) & (blue > red + 8)

    def test_a_damaged_corner_of_a_quarter_is_in_all_four_and_a_section_has_two(self):
        points = quarter()
        corner = (points[:, :2] > 0.15).all(axis=1)
        folder = run(self.folder / "shot", "x y", HALF * corner, points)
        whole = self.picture(folder)
        damage = self.shown(whole, True)
        self.assertTrue(self.shown(whole, False).sum() > 100, "the projectile is seen")
        rows, columns = np.nonzero(damage)
        high, left = rows < np.median(rows), columns < np.median(columns)
        self.assertTrue(min((high & left).sum(), (high & ~left).sum(), (~high & left).sum(), (~high & ~left).sum()) > 200)
        rows = np.nonzero(self.shown(self.picture(folder, "--section"), True).any(axis=1))[0]
        self.assertEqual(np.count_nonzero(np.diff(rows) > 100), 1, "two corners, one above the other")

    def test_a_film_has_a_picture_of_every_frame(self):
        folder = run(self.folder / "shot", "x y", np.zeros(100), quarter())
        ran = view(folder, "--film", self.folder / "film")
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertEqual(sorted(path.name for path in (self.folder / "film").glob("*.png")), ["frame_000.png"])

    def test_a_half_plane_is_revolved(self):
        """The only damaged ring is seen on both sides of the axis, and in a wide band between."""
        x = 0.02 * (0.5 + np.arange(10))
        points = np.column_stack([x, 0 * x, 0 * x])
        damage = self.shown(self.picture(run(self.folder / "ring", "axis", HALF * (x > 0.18), points)), True)
        columns = np.nonzero(damage.any(axis=0))[0]
        self.assertEqual(len(columns), np.ptp(columns) + 1)

    def test_the_crack_of_a_cell_is_seen(self):
        """Rows of the background lie between rows of the two halves."""
        pixels = self.picture(synthetic.microcell(self.folder / "cell"))
        inside = (pixels < 230).any(axis=2)[:, 700:1100].mean(axis=1) > 0.9
        edges = np.count_nonzero(np.diff(inside.astype(int)))
        self.assertEqual(edges, 4)


if __name__ == "__main__":
    unittest.main()
