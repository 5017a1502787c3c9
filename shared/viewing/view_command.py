"""Command line of shared/view."""

import argparse
import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

from files import Unreadable
from view_plan import plan_of
from writing import Parser, Refused, Unwritten, write

SCENE = pathlib.Path(__file__).resolve().with_name("view_scene.py")
MISSING = ("found no program '{}', which this command needs: apt-get install paraview python3-paraview xvfb (about 1 GB; no other "
           "part of Spall needs them)")
EPILOG = """examples:

  shared/view out/slab_127                                      # opens ParaView
  shared/view out/slab_127 --picture slab.png                   # writes slab.png and slab.pvsm, needs no screen
  shared/view out/slab_127_axis --picture section.png --section
  shared/view out/slab_127 --film film --section               # writes film/frame_000.png, ..., with ffmpeg film/film.mp4 too

Points are spheres of the volume of their cells (in a model with rotational symmetry rings), coloured by the larger of tensile and
shear damage, otherwise by plastic strain. Planes of symmetry are mirrored, rings revolved; --section leaves the half in front of
the plane y = 0 away. Rigid bodies are surfaces at their place and angle. The last frame is shown; all are in the state. Of a
microcell, the state near half of its strength is shown, its displacement magnified by the factor in the picture.

ParaView shows a welcome window when it is started for the first time: close it, and the bodies appear.

A state (FILE.pvsm) opens with `paraview FILE.pvsm`; it names the fields by their place on this machine."""


def parser():
    made = Parser(prog="view", description=__doc__, epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.description = "Shows a run in ParaView: the whole body, coloured by damage, with its projectile."
    made.add_argument("folder", metavar="FOLDER", help="result folder of penetrate or of microcell")
    made.add_argument("--picture", metavar="FILE.png", help="writes a picture, and the state beside it, instead of opening ParaView")
    made.add_argument("--film", metavar="DIR", help="writes a picture of every frame of a run into DIR, and a video if ffmpeg is there")
    made.add_argument("--section", action="store_true", help="cuts the bodies open at the plane y = 0")
    made.add_argument("--force", action="store_true", help="replaces a picture or a state that is there")
    return made


def files_of(options):
    """Returns the paths of the picture (or None) and of the state. @raises Refused if one is there or cannot be one"""
    picture = options.picture and pathlib.Path(options.picture)
    if picture and picture.suffix != ".png":
        raise Refused(f"--picture: found '{picture}', allowed: a name that ends with .png")
    state = picture.with_suffix(".pvsm") if picture else pathlib.Path(options.folder) / "view.pvsm"
    for path in filter(None, (picture, state)):
        if path.exists() and not options.force:
            raise Refused(f"'{path}' is there, and is not replaced unasked: --force replaces it" +
                          ("" if picture else f"; 'paraview {path}' opens it"))
        if not path.parent.is_dir():
            raise Refused(f"'{path}': there is no folder '{path.parent}'")
    return picture, state


def film_folder(options, plan):
    """Returns the folder of a film, which it makes. @raises Refused if it holds something, or if there is no run to film"""
    if options.picture:
        raise Refused("--film: allowed without --picture only")
    if plan["kind"] != "run":
        raise Refused(f"--film: '{options.folder}' is a microcell, allowed: a result folder of penetrate")
    folder = pathlib.Path(options.film)
    if folder.exists() and not folder.is_dir():
        raise Refused(f"--film: found the file '{folder}', allowed: a folder")
    if folder.is_dir() and any(folder.iterdir()) and not options.force:
        raise Refused(f"--film: '{folder}' holds files, which are not replaced unasked: --force replaces them")
    needed("pvpython")
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def film(plan, folder):
    """Writes the pictures of all frames and, if ffmpeg is there, a video of twelve of them a second. @raises Refused, Unwritten"""
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        render(plan, scratch, "frame_000.png")
        frames = sorted(scratch.glob("frame_*.png"))
        for frame in frames:
            write(folder / frame.name, frame.read_bytes())
        print(f"{folder}: {len(frames)} frames")
        if ffmpeg := shutil.which("ffmpeg"):
            ran = subprocess.run([ffmpeg, "-loglevel", "error", "-y", "-framerate", "12", "-i", str(scratch / "frame_%03d.png"), "-pix_fmt",
                                  "yuv420p", str(scratch / "film.mp4")], capture_output=True, text=True, stdin=subprocess.DEVNULL)
            if ran.returncode:
                raise Unwritten(f"ffmpeg ended with exit code {ran.returncode}: {(ran.stderr.splitlines() or ['it said nothing'])[-1]}")
            write(folder / "film.mp4", (scratch / "film.mp4").read_bytes())
            print(folder / "film.mp4")
    return 0


def needed(program):
    """Returns the path of a program. @raises Refused"""
    found = shutil.which(program)
    if found is None:
        raise Refused(MISSING.format(program))
    return found


@contextlib.contextmanager
def hidden_screen():
    """Starts an X server without a screen, and gives its display; it ends with the block. @raises Unwritten"""
    reading, writing = os.pipe()
    server = subprocess.Popen([needed("Xvfb"), "-displayfd", str(writing), "-screen", "0", "1600x1200x24", "-nolisten", "tcp",
                               "-noreset"],  # else it starts anew when ParaView closes its first connection
                              pass_fds=[writing], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writing)
    try:
        with os.fdopen(reading) as said:
            number = said.readline().strip()  # it writes the number when it is ready, and ends without one if it cannot start
        if not number:
            raise Unwritten("Xvfb did not start: no picture can be drawn")
        yield f":{number}"
    finally:
        server.terminate()
        server.wait()


def render(plan, folder, wanted="picture.png"):
    """Lets ParaView write its files into a folder. wanted: one that must be there then. @raises Refused, Unwritten"""
    command = [needed("pvpython"), "--force-offscreen-rendering", str(SCENE), json.dumps(plan), str(folder)]
    with hidden_screen() as display:
        ran = subprocess.run(command, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL,
                             env=os.environ | {"DISPLAY": display})
    if ran.returncode or not (folder / wanted).is_file():
        said = ran.stderr.splitlines() or ["it said nothing"]
        own = [line for line in said if line.startswith(f"{SCENE.name}:")]
        raise Unwritten(f"pvpython ended with exit code {ran.returncode} and without a picture: {(own or said)[-1]}")


def main(arguments):
    """Shows the result folder that the arguments name; returns the exit code."""
    options = parser().parse_args(arguments)
    try:
        plan = plan_of(options.folder)
    except (Unreadable, OSError) as error:
        raise Refused(error) from error
    plan |= {"section": options.section, "film": bool(options.film)}
    if options.film:
        return film(plan, film_folder(options, plan))
    picture, state = files_of(options)
    screen = bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")) and not picture
    program = needed("paraview") if screen else None
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        render(plan, scratch)
        write(state, (scratch / "state.pvsm").read_bytes())
        if picture:
            write(picture, (scratch / "picture.png").read_bytes())
            print(picture)
    print(state)
    return subprocess.run([program, f"--state={state}"]).returncode and 3 if screen else 0
