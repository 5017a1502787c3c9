"""Collects figures, tables and provenance, and puts them into HTML files, each of which needs no other file and no network."""

import datetime
import functools
import os
import pathlib
import re
import urllib.parse

import jinja2

from files import read_text

PAGE = pathlib.Path(__file__).resolve().parent / "page"
SCRIPTS = ("solid.js", "turning.js", "page.js")
# Interactive charts. Chart.js is in Debian (libjs-chart.js) and has 0.2 MB; plotly.js has 3.5 MB, more than the whole page may
# have.
LIBRARY = pathlib.Path("/usr/share/javascript/chart.js/chart.min.js")
# A page of more results than this has a few megabytes of pictures and frames, which telephones are slow to show. Each result then
# has a page of its own.
RESULTS_OF_ONE_PAGE = 4
HOME = "report.html"


def read_library():
    """Returns the chart library without the line that names its source map, which a browser would ask for. @raises Unreadable"""
    return re.sub(r"^//# sourceMappingURL=.*$", "", read_text(LIBRARY), flags=re.MULTILINE)


class Report:
    """Collects the parts of the report in reading order. folder: where the page will lie, for links to the data."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.sections = []  # dicts: title, place (name to link to), results, parts

    def heading(self, text, *results):
        """Begins a section on some results: its figures link to their data and commands."""
        place = f"section-{len(self.sections) + 1}"
        self.sections.append({"title": text, "place": place, "results": results, "parts": []})

    def add(self, kind, **content):
        self.sections[-1]["parts"].append({"kind": kind} | content)

    def paragraph(self, text, kind="plain"):
        self.add("paragraph", text=text, look=kind)

    def missing(self, what):
        self.paragraph(f"Missing: {what}", "missing")

    def picture(self, picture, data=(), charts=(), film=None, solid=None):
        """Adds a figure. data: names of files in the folders of the section's results; charts: see charts.py; film:
        see film.py; solid: see solid.py."""
        results = self.sections[-1]["results"]
        self.add("picture", picture=picture, charts=list(charts), film=film, solid=solid, commands=[result.name for result in results],
                 data=[link for result in results for link in self.links(result, data, len(results) > 1)])

    def links(self, result, names, several):
        """Returns the texts and addresses of those files of a result that are there."""
        found = [(name, result.folder / name) for name in names if (result.folder / name).is_file()]
        return [{"text": f"{result.name}/{name}" if several else name, "address": address(os.path.relpath(path, self.folder))}
                for name, path in found]

    def explorer(self, explorer):
        """Adds a chart of which the reader chooses the axes (charts.explorer); a browser without scripts does not show it."""
        self.add("explorer", explorer=explorer)

    def table(self, table):
        self.add("table", table=table)

    def provenance(self, result):
        self.add("provenance", result=result)
        if not result.provenance.input:
            self.missing(f"the resolved input of {result.name} (its files do not hold it)")

    def owned(self):
        """Returns the sections that are on one result only, by the name of the result."""
        found = {}
        for section in self.sections:
            if len(section["results"]) == 1:
                found.setdefault(section["results"][0].name, []).append(section)
        return found

    def html(self, title, library, **top):
        """Returns the pages: {name of the file: text}, the one that begins with all answers last. library: the chart library; top: what it
        begins with, see page/page.html."""
        owned, page = self.owned(), functools.partial(template(), library=library)
        if len(owned) <= RESULTS_OF_ONE_PAGE:
            places = {name: "#" + sections[0]["place"] for name, sections in owned.items()}
            return {HOME: page(title=title, sections=self.sections, places=places, home="", others=[], top=top)}
        files = {name: f"result_{name}.html" for name in owned}
        places = {name: address(file) for name, file in files.items()}
        others = [{"title": sections[0]["title"], "address": places[name]} for name, sections in owned.items()]
        shared = [section for section in self.sections if len(section["results"]) != 1]
        pages = {}
        for name, sections in owned.items():
            own = {key: [one for one in top[key] if one["name"] == name] for key in ("verdicts", "cautions")}
            pages[files[name]] = page(title=sections[0]["title"], sections=sections, places=places, home=HOME, others=[], top=own)
        return pages | {HOME: page(title=title, sections=shared, places=places, home="", others=others, top=top)}


def template():
    """Returns a function that fills page/page.html, with its style and scripts."""
    pages = jinja2.Environment(loader=jinja2.FileSystemLoader(PAGE), autoescape=True, undefined=jinja2.StrictUndefined,
                               trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True)
    pages.filters |= {"address": address, "quoted": lambda text: urllib.parse.quote(text.encode("utf-8", "backslashreplace"))}
    return functools.partial(pages.get_template("page.html").render, date=f"{datetime.date.today():%d %B %Y}",
                             style=read_text(PAGE / "page.css"), script="".join(read_text(PAGE / name) for name in SCRIPTS))


def address(path):
    """Returns the address of a file, also of one whose name has blanks and the like."""
    return urllib.parse.quote(os.fsencode(path))
