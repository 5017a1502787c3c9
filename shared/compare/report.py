"""Puts figures, tables and provenance into one HTML file that needs no other file and no network."""

import html
import urllib.parse

STYLE = """
body { font: 16px/1.5 sans-serif; color: #222; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; } h2 { margin-top: 2.5rem; border-bottom: 1px solid #ccc; }
figure { margin: 1.2rem 0; } figure img { max-width: 100%; height: auto; } figcaption, .note { color: #555; font-size: .9rem; }
.table { overflow-x: auto; } table { border-collapse: collapse; margin: 1.2rem 0 .3rem; font-size: .9rem; }
caption { text-align: left; font-weight: bold; padding: .3rem 0; }
th, td { border: 1px solid #ccc; padding: .25rem .6rem; text-align: right; }
th:first-child, td:first-child { text-align: left; } thead { background: #f3f3f3; }
.ours { color: #1f5fa8; } .experiment { color: #111; font-weight: bold; }
.nmap { color: #b34700; } .converged { color: #2a7f3f; }
.missing { background: #fff3cd; border-left: 4px solid #d9a400; padding: .5rem .8rem; overflow-wrap: anywhere; }
.verdict { background: #eef4fb; border-left: 4px solid #1f5fa8; padding: .5rem .8rem; }
nav { columns: 2 18rem; font-size: .9rem; } nav a { display: block; }
pre { background: #f6f6f6; padding: .8rem; overflow-x: auto; font-size: .8rem; } code { overflow-wrap: anywhere; }
@media print {
  body { max-width: none; margin: 0; font-size: 10pt; } nav, .download { display: none; }
  figure, tr, .verdict, .missing { break-inside: avoid; } h2, caption { break-after: avoid; }
  .table { overflow: visible; } table { font-size: 8pt; } th, td { padding: .1rem .25rem; } pre { white-space: pre-wrap; }
}
"""


class Report:
    """Collects the parts of the report in reading order."""

    def __init__(self):
        self.parts = []
        self.headings = []

    def heading(self, text):
        self.headings.append(text)
        self.parts.append(f"<h2 id='section-{len(self.headings)}'>{html.escape(text)}</h2>")

    def paragraph(self, text, kind=""):
        self.parts.append(f"<p class='{kind}'>{html.escape(text)}</p>")

    def missing(self, what):
        self.paragraph(f"Missing: {what}", "missing")

    def picture(self, picture):
        self.parts.append(f"<figure><img alt='{html.escape(picture.caption, quote=True)}' "
                          f"src='{picture.data_uri()}'><figcaption>{html.escape(picture.caption)} "
                          f"(in full: {link(picture.name, 'png')}, {link(picture.name, 'svg')})</figcaption></figure>")

    def table(self, table):
        self.parts.append(table.html())

    def provenance(self, result):
        source = result.provenance
        self.parts.append(
            f"<p><b>{html.escape(result.name)}</b>: {html.escape(source.program)}, input "
            f"<code>{html.escape(source.input_file)}</code>, {html.escape(source.created)}</p>")
        if source.input:
            self.parts.append(f"<details><summary>full resolved input of {html.escape(result.name)}</summary>"
                              f"<pre>{html.escape(source.input)}</pre></details>")
        else:
            self.missing(f"the resolved input of {result.name} (its files do not hold it)")

    def html(self, title, top=()):
        """Returns the page. top: what stands before the contents, as HTML."""
        contents = "\n".join(f"<a href='#section-{i}'>{html.escape(text)}</a>" for i, text in enumerate(self.headings, 1))
        body = "\n".join([*top, f"<nav aria-label='Contents'>{contents}</nav>", *self.parts])
        return ("<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>"
                "<meta name='viewport' content='width=device-width, initial-scale=1'>"
                f"<title>{html.escape(title)}</title>\n<style>{STYLE}</style></head>\n<body><h1>{html.escape(title)}</h1>\n{body}\n"
                "</body></html>\n")


def link(name, kind):
    """Returns a link to a figure's file, which lies beside the report."""
    return f"<a href='{urllib.parse.quote(name)}.{kind}'>{html.escape(name)}.{kind}</a>"
