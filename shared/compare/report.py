"""Puts figures, tables and provenance into one HTML file that needs no other file and no network."""

import html

STYLE = """
body { font: 16px/1.5 sans-serif; color: #222; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; } h2 { margin-top: 2.5rem; border-bottom: 1px solid #ccc; }
figure { margin: 1.2rem 0; } figure img { max-width: 100%; } figcaption, .note { color: #555; font-size: .9rem; }
table { border-collapse: collapse; margin: 1.2rem 0 .3rem; font-size: .9rem; }
caption { text-align: left; font-weight: bold; padding: .3rem 0; }
th, td { border: 1px solid #ccc; padding: .25rem .6rem; text-align: right; }
th:first-child, td:first-child { text-align: left; } thead { background: #f3f3f3; }
.ours { color: #1f5fa8; } .experiment { color: #111; font-weight: bold; }
.nmap { color: #d95f02; } .converged { color: #2a7f3f; }
.missing { background: #fff3cd; border-left: 4px solid #d9a400; padding: .5rem .8rem; }
.verdict { background: #eef4fb; border-left: 4px solid #1f5fa8; padding: .5rem .8rem; }
pre { background: #f6f6f6; padding: .8rem; overflow-x: auto; font-size: .8rem; }
"""


class Report:
    """Collects the parts of the report in reading order."""

    def __init__(self):
        self.parts = []

    def heading(self, text):
        self.parts.append(f"<h2>{html.escape(text)}</h2>")

    def paragraph(self, text, kind=""):
        self.parts.append(f"<p class='{kind}'>{html.escape(text)}</p>")

    def missing(self, what):
        self.paragraph(f"Missing: {what}", "missing")

    def picture(self, picture):
        self.parts.append(f"<figure><img alt='{html.escape(picture.caption, quote=True)}' "
                          f"src='{picture.data_uri()}'><figcaption>{html.escape(picture.caption)} "
                          f"({html.escape(picture.name)}.png, .svg)</figcaption></figure>")

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

    def html(self, title):
        body = "\n".join(self.parts)
        return (f"<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>{html.escape(title)}"
                f"</title>\n<style>{STYLE}</style></head>\n<body><h1>{html.escape(title)}</h1>\n{body}\n"
                "</body></html>\n")
