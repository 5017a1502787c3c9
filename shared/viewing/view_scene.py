"""Builds the scene of a plan (view_plan.py) in ParaView, and writes its state and a picture. Run by pvpython:

pvpython view_scene.py PLAN FOLDER, with the plan as JSON; writes FOLDER/picture.png and FOLDER/state.pvsm, or with plan["film"]
FOLDER/frame_000.png, frame_001.png, ... of all frames of a run."""

import json
import math
import os
import pathlib
import sys

import numpy as np
from paraview import servermanager
from paraview import simple as pv
from paraview.vtk.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from writing import run_script  # noqa: E402

SIZE = [1600, 1100]
# Radius over edge of a sphere as large as a cube, (3 / 4 pi)^(1/3), and of a ring's round section as large as a square, pi^(-1/2).
SPHERE, ROUND = 0.6204, 0.5642
STEEL, SOLID, DARK = [0.42, 0.47, 0.53], [0.72, 0.70, 0.66], [0.15, 0.15, 0.15]
SEEN = 0.5  # damage that a section must show
# Angle of the view, degrees; share of the picture's height that is filled, and of its width beside the scale on the right.
ANGLE, FILLED, BESIDE = 20, 0.86, 0.8
TURNS = 96  # steps of a whole revolution


def named(name, source):
    pv.RenameSource(name, source)
    return source


def calculated(source, name, function):
    return pv.Calculator(Input=source, ResultArrayName=name, Function=function)


def mirrored(source, plan):
    """Mirrors at the planes of symmetry; the images of a section lie behind its plane y = 0 only."""
    for plane in plan["symmetry"]:
        if plane == "x" or (plane == "y" and not plan["section"]):
            source = pv.Reflect(Input=source, Plane=plane.upper(), Center=0.0, CopyInput=1)
    return source


def cut(source, plan):
    """Leaves the part in front of the plane y = 0 away, if no plane of symmetry does."""
    if not plan["section"] or set(plan["symmetry"]) & {"y", "axis"}:
        return source
    clip = pv.Clip(Input=source, ClipType="Plane", Invert=0)
    clip.ClipType.Origin, clip.ClipType.Normal = [0, 0, 0], [0, 1, 0]
    return clip


def show_points(body, source, plan, view):
    """Shows a deformable body; returns its representation."""
    colour = [name for name in plan["colour"]["fields"] if name in body["fields"]]
    if colour:
        largest = colour[0] if len(colour) == 1 else f"max({colour[0]},{colour[1]})"
        source = calculated(source, "colour", largest)
    if "axis" in plan["symmetry"]:
        source = calculated(pv.ExtractSurface(Input=source), "radius", f"{ROUND}*spacing")
        turn = 180 if plan["section"] else 360
        source = pv.RotationalExtrusion(Input=source, Resolution=TURNS * turn // 360, Angle=turn, Capping=0)
        source = pv.Tube(Input=source, Scalars=["POINTS", "radius"], VaryRadius="By Absolute Scalar", Radius=1.0, NumberofSides=12)
        shown = pv.Show(named(body["name"], source), view, "GeometryRepresentation")
        shown.Representation = "Surface"
    else:
        source = cut(mirrored(calculated(source, "radius", f"{SPHERE}*spacing"), plan), plan)
        shown = pv.Show(named(body["name"], source), view, "UnstructuredGridRepresentation")
        shown.Representation = "Point Gaussian"
        shown.ShaderPreset = "Sphere"
        shown.ScaleByArray, shown.SetScaleArray, shown.UseScaleFunction, shown.GaussianRadius = 1, ["POINTS", "radius"], 0, 1.0
    paint(shown, bool(colour), plan, view)
    return source


def paint(shown, coloured, plan, view):
    if not coloured:
        shown.ColorArrayName = ["POINTS", ""]
        shown.AmbientColor = shown.DiffuseColor = SOLID
        return
    pv.ColorBy(shown, ("POINTS", "colour"))
    table = pv.GetColorTransferFunction("colour")
    table.RGBPoints, table.ColorSpace = plan["colour"]["scale"], "RGB"
    if plan["colour"]["range"]:
        table.RescaleTransferFunction(*plan["colour"]["range"])
    else:
        shown.RescaleTransferFunctionToDataRange(False, True)
    bar = pv.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = plan["colour"]["title"], ""
    style_bar(bar)
    shown.SetScalarBarVisibility(view, True)


def style_bar(bar):
    bar.TitleColor = bar.LabelColor = DARK
    bar.TitleFontSize, bar.LabelFontSize, bar.HorizontalTitle = 24, 22, 1
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.3g", "%.3g"
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", [0.88, 0.30], 0.4


def show_surface(body, source, view):
    """Shows a rigid body: smooth, with sharp edges where its contour has some."""
    smooth = pv.GenerateSurfaceNormals(Input=pv.ExtractSurface(Input=source), FeatureAngle=40)
    shown = pv.Show(named(body["name"], smooth), view, "GeometryRepresentation")
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = STEEL
    shown.Specular = 0.35
    return smooth


def show_lines(body, source, plan, view):
    source = cut(mirrored(source, plan), plan)
    shown = pv.Show(named(body["name"], source), view, "UnstructuredGridRepresentation")
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = DARK
    shown.LineWidth = 3
    return source


def places_of(source):
    """Returns the points of a source, n x 3, what they are coloured by, or None, and the largest radius of a point."""
    data = servermanager.Fetch(source)
    colour, radius = (data.GetPointData().GetArray(name) for name in ("colour", "radius"))
    return (vtk_to_numpy(data.GetPoints().GetData()), None if colour is None else vtk_to_numpy(colour),
            0.0 if radius is None else radius.GetRange()[1])


def look(view, places, direction, up, radius=0.0):
    """Looks along a direction, from where the places, and spheres around them, just fill the picture beside its scale."""
    middle, ahead = 0.5 * (places.min(axis=0) + places.max(axis=0)), np.array(direction) / np.linalg.norm(direction)
    right = np.cross(ahead, up) / np.linalg.norm(np.cross(ahead, up))
    above = np.cross(right, ahead)
    offsets = places - middle
    high = math.tan(math.radians(ANGLE / 2)) * FILLED
    wide = high * SIZE[0] / SIZE[1] * BESIDE
    up_down, left_right = np.abs(offsets @ above) + radius, np.abs(offsets @ right) + radius
    distance = np.max(np.maximum(up_down / high, left_right / wide) - offsets @ ahead)
    view.CameraFocalPoint, view.CameraViewUp, view.CameraViewAngle = list(middle), list(above), ANGLE
    view.CameraPosition = list(middle - distance * ahead)


def shown_places(found, plan):
    """Returns the places that the picture must show: all points of deformable bodies, or of a section those that are damaged with
    the rigid bodies that touch them; all there is, if that is nothing."""
    places = [(kind, *places_of(source)[:2]) for kind, source in found]
    points = [(where, colour) for kind, where, colour in places if kind == "points"]
    if not points:
        return np.concatenate([where for _, where, _ in places])
    damaged = [where[colour > SEEN] for where, colour in points if colour is not None]
    if not plan["section"] or plan["colour"]["range"] is None or sum(map(len, damaged)) == 0:
        return np.concatenate([where for where, _ in points])
    damaged = np.concatenate(damaged)
    low, high = damaged.min(axis=0), damaged.max(axis=0)
    near = [where for kind, where, _ in places if kind == "surface" and (where.max(axis=0) > low).all()
            and (where.min(axis=0) < high).all() and (np.ptp(where, axis=0) < 3 * np.ptp(damaged, axis=0).max()).all()]
    return np.concatenate([damaged, *near])


def show_run(plan, view):
    reader = named("fields", pv.Xdmf3ReaderT(FileName=[plan["file"]]))
    times = np.atleast_1d(reader.TimestepValues)  # one number if there is one frame
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = times[-1]
    found = []
    for i, body in enumerate(plan["bodies"], 1):
        block = pv.ExtractBlock(Input=reader, Assembly="Hierarchy", Selectors=[f"/Root/*[{i}]"])
        block = pv.MergeBlocks(Input=block)
        block.UpdatePipeline(times[-1])
        show = {"points": show_points, "lines": show_lines}.get(body["kind"])
        found.append((body["kind"], show(body, block, plan, view) if show else show_surface(body, block, view)))
    time = pv.AnnotateTimeFilter(Input=reader, Scale=1e3, Format=plan["name"].replace("{", "{{").replace("}", "}}") + ", {time:.2f} ms")
    caption(pv.Show(time, view))
    # Shots fly along z: to the right, seen from the side and a little from behind.
    places = [shown_places(found, plan)]
    if plan["film"]:  # all that is seen at the start has its place in the pictures too
        for _, source in found:
            source.UpdatePipeline(times[0])
        places.append(shown_places(found, plan))
    look(view, np.concatenate(places), [-0.30, 1.0, -0.30] if plan["section"] else [-0.35, 0.75, -0.95], [-1, 0, 0],
         max(places_of(source)[2] for _, source in found))


def show_cell(plan, view):
    reader = named("fields", pv.PVDReader(FileName=plan["file"]))
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = plan["time"]
    warped = named("opened cell", pv.WarpByVector(Input=reader, Vectors=["POINTS", "displacement"], ScaleFactor=plan["factor"]))
    warped.UpdatePipeline(plan["time"])
    pv.Hide(reader, view)
    shown = pv.Show(warped, view, "UnstructuredGridRepresentation")
    stress = calculated(warped, "colour", "stress_yy/1e6")
    pv.Hide(warped, view)
    shown = pv.Show(stress, view, "UnstructuredGridRepresentation")
    pv.ColorBy(shown, ("POINTS", "colour"))
    table = pv.GetColorTransferFunction("colour")
    table.ApplyPreset("Viridis (matplotlib)", True)
    shown.RescaleTransferFunctionToDataRange(False, True)
    bar = pv.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = "stress yy\n(MPa)", ""  # short: windows can be small
    style_bar(bar)
    shown.SetScalarBarVisibility(view, True)
    outline = pv.Show(pv.Outline(Input=reader), view)
    outline.AmbientColor = outline.DiffuseColor = DARK
    text = pv.Text(Text=f"{plan['name']}, strain {plan['strain']:.2g}, displacement × {plan['factor']:g}")
    caption(pv.Show(text, view))
    look(view, places_of(stress)[0], [0, 0, -1], [0, 1, 0])


def caption(shown):
    shown.Color, shown.FontSize, shown.WindowLocation = DARK, 26, "Upper Left Corner"


def main(plan, folder):
    pv._DisableFirstRenderCameraReset()
    view = pv.GetActiveViewOrCreate("RenderView")
    view.ViewSize, view.Background, view.UseColorPaletteForBackground = SIZE, [1, 1, 1], 0
    view.OrientationAxesVisibility = 0
    (show_run if plan["kind"] == "run" else show_cell)(plan, view)
    pv.Render(view)
    if plan["film"]:
        scene = pv.GetAnimationScene()
        for i, time in enumerate(np.atleast_1d(scene.TimeKeeper.TimestepValues)):
            scene.AnimationTime = time
            pv.SaveScreenshot(str(folder / f"frame_{i:03d}.png"), view, ImageResolution=SIZE)
        os._exit(0)
    pv.SaveState(str(folder / "state.pvsm"))
    pv.SaveScreenshot(str(folder / "picture.png"), view, ImageResolution=SIZE)
    os._exit(0)  # all is written, and ParaView 5.11 sometimes crashes when it takes its window down


if __name__ == "__main__":
    sys.exit(run_script("view_scene.py", lambda: main(json.loads(sys.argv[1]), pathlib.Path(sys.argv[2]))))
