"""The look of all figures. Each source of numbers has the same colour and marker everywhere."""

import base64
import io
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({
    "font.size": 11, "axes.grid": True, "grid.alpha": 0.25, "axes.spines.top": False,
    "axes.spines.right": False, "lines.linewidth": 1.8, "legend.frameon": False, "savefig.dpi": 130,
    "figure.constrained_layout.use": True, "svg.hashsalt": "spall",
    "text.parse_math": False,  # names may hold any character
})

from matplotlib.figure import Figure  # noqa: E402  (the backend must be chosen first)
from matplotlib.ticker import LogFormatter, NullFormatter  # noqa: E402
from PIL import Image  # noqa: E402

from writing import write  # noqa: E402

# Colours that people with any of the common kinds of colour vision tell apart: Okabe and Ito, "Color universal design" (2008). Grey
# is for what stays in the background.
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY, YELLOW = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"
GREY, BLACK = "#5d6d7e", "#000000"
OURS, EXPERIMENT, NMAP, CONVERGED = BLUE, BLACK, VERMILLION, GREEN
CYCLE = [BLUE, VERMILLION, GREEN, PURPLE, ORANGE, GREY, SKY, BLACK]
LINES = ["-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)), ":"]  # beside the colours, so that lines are told apart in grey too

LARGE = 60_000  # bytes of a PNG from which on a figure is embedded as WebP, if that is smaller


def line_look(i):
    """Returns colour and style of the i-th line of a figure; 40 lines differ."""
    return {"color": CYCLE[i % len(CYCLE)], "linestyle": LINES[i % len(LINES)]}



def figure(width=7.5, height=4.2, rows=1, columns=1, **options):
    made = Figure(figsize=(width, height))
    return made, made.subplots(rows, columns, **options)


def error_bars(axes, values, color):
    """Draws the ranges that the numerical errors leave open. values: [(place, value, (low, high) or None)]."""
    for place, value, band in values:
        if band is None or not band[0] < band[1]:
            continue
        low, high = band
        axes.errorbar(place, value, yerr=[[value - low], [high - value]], fmt="none", color=color, capsize=4, linewidth=1.3,
                      clip_on=False)


def mark_cut_axes(drawn):
    """Marks every linear vertical axis that does not reach zero by two strokes through its foot. Pictures of places, whose two
    axes have one scale, and scales of colours need no zero."""
    for axes in drawn.axes:
        low, high = sorted(axes.get_ylim())
        if axes.get_yscale() != "linear" or low <= 0 <= high or axes.get_aspect() != "auto" or hasattr(axes, "_colorbar"):
            continue
        for level in (0.03, 0.05):
            axes.plot([-0.009, 0.009], [level - 0.012, level + 0.012], transform=axes.transAxes, color="black", linewidth=1.2,
                      clip_on=False, gid="cut axis")


def plain_logarithms(drawn):
    """Writes the ticks of logarithmic axes as plain numbers: powers need mathematical text, which figures do not have."""
    for axes in drawn.axes:
        for axis in (axes.xaxis, axes.yaxis):
            if isinstance(axis.get_major_formatter(), LogFormatter):
                axis.set_major_formatter("{x:g}")
            if isinstance(axis.get_minor_formatter(), LogFormatter):
                axis.set_minor_formatter(NullFormatter())


@dataclass
class Picture:
    """A figure written to disk, and what the report embeds of it."""

    name: str
    caption: str
    kind: str  # "png" or "webp"
    content: bytes
    size: tuple  # width and height in pixels

    @property
    def wide(self):
        """Returns whether the letters of the figure are too small on a telephone that shows all of its width."""
        width, height = self.size
        return width > 1.8 * height

    def data_uri(self):
        return f"data:image/{self.kind};base64," + base64.b64encode(self.content).decode("ascii")


def save(drawn, folder, name, caption):
    """Writes NAME.png and NAME.svg. @raises Unwritten"""
    mark_cut_axes(drawn)
    plain_logarithms(drawn)
    png, svg = io.BytesIO(), io.BytesIO()
    drawn.savefig(png, format="png")
    drawn.savefig(svg, format="svg", metadata={"Date": None})
    write(folder / f"{name}.png", png.getvalue())
    write(folder / f"{name}.svg", svg.getvalue())
    return Picture(name, caption, *small(png.getvalue()))


def small(png):
    """Returns a picture to be embedded: its kind, its content in fewer bytes, its size; the file beside the report has all colours.
    A picture of few colours is a PNG in a third of the bytes; one of many points, which is large as such, a WebP."""
    with Image.open(io.BytesIO(png)) as picture:
        plain = picture.convert("RGB")
    reduced = io.BytesIO()
    plain.quantize(128, dither=Image.Dither.NONE).save(reduced, format="png", optimize=True)
    content = min(reduced.getvalue(), png, key=len)
    if len(content) > LARGE:
        reduced = io.BytesIO()
        plain.save(reduced, format="webp", quality=80, method=4)
        if len(reduced.getvalue()) < len(content):
            return "webp", reduced.getvalue(), plain.size
    return "png", content, plain.size
