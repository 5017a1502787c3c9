"""The command and its report, on synthetic results (see synthetic.py)."""

import contextlib
import html.parser
import io
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import unittest
import unittest.mock
import urllib.parse

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402

import compare  # noqa: E402
import writing  # noqa: E402

# Pictures that nobody looks at: most of the time goes into pixels and into the layout.
matplotlib.rcParams.update({"savefig.dpi": 30, "figure.constrained_layout.use": False})


class SourceCollector(html.parser.HTMLParser):
    """Everything the page would load, and whether its tags close."""

    def __init__(self):
        super().__init__()
        self.sources, self.open, self.links, self.names, self.places = [], [], [], [], []

    def handle_starttag(self, tag, attributes):
        self.sources += [value for name, value in attributes if name in ("src", "srcset", "data")]
        self.links += [value for name, value in attributes if name == "href"]
        self.names += [value for name, value in attributes if name == "alt"]
        self.places += [value for name, value in attributes if name == "id"]
        if tag not in ("meta", "img", "br", "link"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


class Command(synthetic.InFolder):
    def run_command(self, *arguments):
        out, error = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
            code = compare.run_script("compare.py", lambda: compare.main([str(a) for a in arguments]))
        return code, error.getvalue()

    def check_links(self, pages):
        """Every link leads into the page, to a file that is there, or to a place of another page. pages: {file: what it holds}."""
        for page, held in pages.items():
            for link in held.links:
                file, _, place = urllib.parse.unquote(link).partition("#")
                target = page.parent / file if file else page
                if not link.startswith("data:"):
                    self.assertTrue(target.is_file(), link)
                    self.assertTrue(not place or place in map(urllib.parse.unquote, pages[target].places), link)

    def test_the_report_is_complete_and_opens_alone(self):
        output = self.folder / "report"
        code, error = self.run_command(*synthetic.everything(self.folder), "--output", output, "--references",
                                       synthetic.references(self.folder / "measured"))
        self.assertEqual((code, error), (0, ""))
        page = (output / "report.html").read_text(encoding="utf-8")
        verdicts = (output / "verdict.txt").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(verdicts), 2)  # of the slab and of the bar
        self.assertTrue(any("the measured" in verdict for verdict in verdicts), verdicts)
        collector = SourceCollector()
        collector.feed(page)
        self.assertEqual(collector.open, [])
        pictures = sorted(output.glob("*.png"))
        self.assertEqual(len(collector.sources), len(pictures))
        self.assertTrue(all(re.match("data:image/(png|webp);base64,", s) for s in collector.sources))
        self.assertTrue(all(collector.names) and len(collector.names) == len(pictures))  # a text for every picture
        self.check_links({output / "report.html": collector})
        self.assertIn('name="viewport"', page)
        self.assertEqual(len(re.findall("<table[ >]", page)), page.count("data:text/csv;"))
        head, words = html.unescape(re.sub("<[^>]*>", "", page[:page.index("<nav")])), html.unescape(re.sub("<[^>]*>", "", page))
        for verdict in verdicts:
            self.assertIn(verdict, head)
            self.assertEqual(words.count(verdict.split(": ", 1)[1]), 1)  # said once
        text = re.sub(r"data:image/\w+;base64,[A-Za-z0-9+/=]*|<script.*?</script>", "", page, flags=re.DOTALL)
        self.assertIn("default-src 'none'; img-src data:", text)  # the browser asks for nothing else, whatever the scripts say
        for outside in ("http:", "https:", "//", "url(", "@import", "<script src"):
            self.assertFalse(outside in text, outside)
        for picture in pictures:
            self.assertTrue(picture.with_suffix(".svg").is_file(), picture)
            self.assertIn(picture.name, text)
            self.assertIn(f"{picture.stem}.svg", text)
        figures = re.findall("<figure.*?</figure>", text, re.DOTALL)
        for figure in figures:  # with its data and the command that made them
            self.assertRegex(figure, r'; data: <a href="[^"]+">')
            place = re.search(r'; command: <a href="#([^"]+)">', figure)[1]
            origin = text[text.index(f'id="{place}"'):]
            self.assertIn('<pre class="command">build/', origin[:origin.index("</div>")])
        for words in ("misses the measured 200 m/s by 10.0 m/s", "set Key = value &lt; 3", "Thickness = 127 mm"):
            self.assertIn(words, text)
        self.assertNotIn("Missing:", text)

    def test_a_missing_part_is_said_in_its_section(self):
        slab = synthetic.slab(self.folder / "slab")
        (slab / "history.csv").unlink()
        output = self.folder / "report"
        code, _ = self.run_command(slab, "--output", output, "--references", self.folder)
        self.assertEqual(code, 0)
        page = (output / "report.html").read_text(encoding="utf-8")
        self.assertIn("Missing: history.csv", page)
        self.assertIn("Missing: an experiment with this thickness", page)
        self.assertFalse((output / "slab_velocity.png").exists())

    def test_a_run_that_ended_early_says_so(self):
        for folder, entries in ((synthetic.microcell(self.folder / "cell"), {"complete": False, "reason": "lost"}),
                                (synthetic.slab(self.folder / "slab"), {"ended": "failed: lost"})):
            summary = json.loads((folder / "summary.json").read_text()) | entries
            (folder / "summary.json").write_text(json.dumps(summary))
            self.assertEqual(self.run_command(folder, "--output", self.folder / "report", "--force")[0], 0)
            page = (self.folder / "report" / "report.html").read_text(encoding="utf-8")
            self.assertRegex(page, "the end of the run: (failed: )?lost")

    def test_a_run_that_is_meant_to_reach_its_end_time_is_complete(self):
        for until, said in (("end time", False), ("answered", True), ("settled", True)):
            folder = synthetic.slab(self.folder / until, inputs={"Run/Until": until})
            summary = json.loads((folder / "summary.json").read_text()) | {"ended": "end time"}
            (folder / "summary.json").write_text(json.dumps(summary))
            self.assertEqual(self.run_command(folder, "--output", self.folder / "report", "--force")[0], 0)
            page = (self.folder / "report" / "report.html").read_text(encoding="utf-8")
            self.assertEqual("the end of the run: end time" in page, said)

    def test_a_run_that_has_ended_before_its_craters_says_so_and_shows_none(self):
        folder = synthetic.slab(self.folder / "slab")
        for name in ("craters.csv", "crater_profiles.csv", "fragments.csv"):
            (folder / name).unlink()
        summary = json.loads((folder / "summary.json").read_text())
        silent = {key: None for key in summary if "crater" in key or key.split("_")[0] in ("debris", "ejecta", "loose", "remainder")}
        synthetic.change_summary(folder, **silent, time_of_exit=None, simulated_time=0.9e-3, ended="finished",
                                 not_settled="craters, fragments", not_settled_remark="not reported: too early")
        self.assertEqual(self.run_command(folder, "--output", self.folder / "report", "--references",
                                          synthetic.references(self.folder / "measured"))[0], 0)
        page = (self.folder / "report" / "report.html").read_text(encoding="utf-8")
        self.assertIn("Craters and fragments are not reported: too early", page)
        self.assertIn("misses the measured 200 m/s by 10.0 m/s", page)
        self.assertNotIn("the end of the run:", page)
        for absent in ("Outlines of the craters", "Debris and ejecta of the whole slab", "A place belongs to a crater"):
            self.assertNotIn(absent, page)
        self.assertTrue((self.folder / "report" / "slab_velocity.png").exists())

    def test_an_unreadable_folder_is_one_line_and_exit_code_2_before_anything_is_written(self):
        output = self.folder / "report"
        code, error = self.run_command(synthetic.slab(self.folder / "slab"), self.folder / "absent",
                                       "--output", output)
        self.assertEqual(code, 2)
        self.assertEqual(error.count("\n"), 1)
        self.assertIn("absent", error)
        self.assertFalse(output.exists())

    def test_several_slabs_are_drawn_together(self):
        u = {"slab/AFC/Shear damage": "no", "slab/AFC/T_max": "2.5 MPa", "Contact/Friction": "0", "Scene/Symmetry planes": "x, y"}
        slabs = [synthetic.slab(self.folder / "thin", inputs=u), synthetic.slab(self.folder / "thick", 110.0, thickness=0.216),
                 synthetic.slab(self.folder / "fine", 230.0, spacing=0.03, inputs=u),
                 *(synthetic.slab(self.folder / name, 215.0, inputs={"slab/Rings": name}) for name in ("4", "5"))]
        output = self.folder / "report"
        self.assertEqual(self.run_command(*slabs, "--output", output, "--references",
                                          synthetic.references(self.folder / "measured"))[0], 0)
        page = self.check_pages(output, [slab.name for slab in slabs])
        for name in ("slabs_velocity", "slabs_absorbed", "convergence_U_0", "thick_craters", "thick_debris", "thick_energy"):
            self.assertTrue((output / f"{name}.png").is_file(), name)
        self.assertEqual(page.count("not meant for comparison with an experiment"), 2)
        self.assertIn("misses the measured 200 m/s by 15.0 m/s", page)
        for words in ("All slabs with one set of inputs", "Runs of the 127 mm slab", "Soundness of every slab"):
            self.assertIn(words, page)

    def check_pages(self, output, names):
        """Many results have a page each, with their pictures and their verdict; returns the first page, which has what compares them."""
        pages = {}
        for path in output.glob("*.html"):
            pages[path] = SourceCollector()
            pages[path].feed(path.read_text(encoding="utf-8"))
        self.assertEqual({path.name for path in pages}, {"report.html", *(f"result_{name}.html" for name in names)})
        self.check_links(pages)
        self.assertEqual(sum(len(held.sources) for held in pages.values()), len(list(output.glob("*.png"))))
        verdicts = dict(line.split(": ", 1) for line in (output / "verdict.txt").read_text(encoding="utf-8").splitlines())
        for name in names:
            text = html.unescape((output / f"result_{name}.html").read_text(encoding="utf-8"))
            self.assertEqual([other for other in names if verdicts[other] in text and verdicts[other] != verdicts[name]], [], name)
            self.assertIn(verdicts[name], text)
            self.assertIn(f"result_{name}.html", pages[output / "report.html"].links)
        return (output / "report.html").read_text(encoding="utf-8")

    def test_folders_of_one_name_keep_their_own_figures(self):
        output = self.folder / "report"
        slabs = [synthetic.slab(self.folder / name / "slab") for name in ("a", "b")]
        self.assertEqual(self.run_command(*slabs, "--output", output)[0], 0)
        self.assertEqual(len(list(output.glob("slab*_velocity.png"))), 2)

    def test_runs_without_an_exit_velocity_still_give_a_report(self):
        depth, neither = (synthetic.slab(self.folder / name) for name in ("depth", "neither"))
        for folder, answers in ((depth, {"penetration_depth": 0.09}), (neither, {"plate_max_deflection": 0.01})):
            summary = json.loads((folder / "summary.json").read_text())
            del summary["exit_velocity"]
            (folder / "summary.json").write_text(json.dumps(summary | answers))
        self.assertEqual(self.run_command(depth, neither, "--output", self.folder / "report"), (0, ""))
        page = (self.folder / "report" / "report.html").read_text(encoding="utf-8")
        for words in ("Slab: depth", "has penetrated 90.0 mm into it", "Impact: neither", "What the body &#39;plate&#39; has received"):
            self.assertIn(words, page)

    def test_a_summary_of_nulls_still_gives_a_report(self):
        slab = synthetic.slab(self.folder / "slab")
        (slab / "summary.json").write_text(json.dumps({"program": "penetrate", "exit_velocity": None}))
        self.assertEqual(self.run_command(slab, "--output", self.folder / "report")[0], 0)

    def test_an_odd_run_is_shown_as_odd_and_the_rest_is_reported(self):
        good, damaged, still, killed, empty, strange = (synthetic.slab(self.folder / name) for name in (
            "good", "damaged", "still", "killed", "empty", "strange"))
        with open(damaged / "history.csv", "a", encoding="utf-8") as stream:
            stream.write("1,2\n")
        synthetic.history(still, 0.0, 0.0, 2.34, 2e-3, True)
        synthetic.change_summary(still, impact_velocity=0.0)
        (killed / "summary.json").unlink()
        header = (empty / "history.csv").read_text().split("\n", 1)[0]
        (empty / "history.csv").write_text(header + "\n")
        synthetic.change_summary(strange, thickness="thick", front_crater_diameter=[1])
        output = self.folder / "report"
        code, error = self.run_command(damaged, still, killed, good, empty, strange, "--output", output, "--references",
                                       synthetic.references(self.folder / "measured"))
        self.assertEqual(code, 0, error)
        page = (output / "report.html").read_text(encoding="utf-8")
        odd = re.search("<caption>Runs that are odd or have not ended .*?</table>", page, re.S)[0]
        for name, reason in (("damaged", "has 2 columns"), ("still", "nothing moves"), ("killed", "has not ended, or was killed"),
                             ("empty", "no line")):
            self.assertRegex(odd, f'<td class="">[^<]*{name}</td><td class="words">[^<]*{reason}')
        self.assertNotIn(">good</td>", odd)
        self.assertLess(page.index("odd or have not ended"), page.index("<nav"))
        self.assertIn("misses the measured 200 m/s by 10.0 m/s", page)
        self.assertIn("Impact: killed", page)

    def test_a_frame_that_is_damaged_leaves_the_pictures_of_the_last_one(self):
        slab = synthetic.slab(self.folder / "slab")
        frame = slab / "fields" / "000.h5"
        frame.write_bytes(frame.read_bytes()[:1000])
        self.assertEqual(self.run_command(slab, "--output", self.folder / "report")[0], 0)
        page = (self.folder / "report" / "report.html").read_text(encoding="utf-8")
        self.assertIn("Missing: the damage over time", page)
        for name in ("faces", "section", "debris", "energy"):
            self.assertTrue((self.folder / "report" / f"slab_{name}.png").is_file(), name)

    def test_names_that_are_no_text_or_look_like_markup_are_words(self):
        for name in (b"\xff\xfe", b"<script>alert(1)<", b"a'b\"c</script>", b"{{ 7*7 }}"):
            folder = self.folder / os.fsdecode(name).replace("/", "_")
            synthetic.slab(folder)
            self.assertEqual(self.run_command(folder, "--output", self.folder / "report", "--force")[0], 0, name)
            page = (self.folder / "report" / "report.html").read_text(encoding="utf-8", errors="replace")
            self.assertEqual(page.count("<script>"), 2, name)  # those of the page
            self.assertEqual(page.count("<script"), page.count("</script>"), name)
            self.assertNotIn(">49<", page)

    def test_a_part_that_cannot_be_drawn_leaves_the_others(self):
        slabs = [synthetic.slab(self.folder / name) for name in ("first", "second")]
        with unittest.mock.patch.dict(compare.ANSWERS):
            drawn = compare.ANSWERS[compare.Slab]

            def fails_on_the_first(out, result):
                if result.name == "first":
                    raise ZeroDivisionError("float division by zero")
                drawn(out, result)

            compare.ANSWERS[compare.Slab] = fails_on_the_first
            self.assertEqual(self.run_command(*slabs, "--output", self.folder / "report")[0], 0)
        page = (self.folder / "report" / "report.html").read_text(encoding="utf-8")
        self.assertIn("ZeroDivisionError: float division by zero", page)
        self.assertIn("Slab: second", page)

    def test_folders_without_any_result_are_refused(self):
        slab = synthetic.slab(self.folder / "slab")
        (slab / "summary.json").write_text("{")
        code, error = self.run_command(slab, "--output", self.folder / "report")
        self.assertEqual((code, error.count("\n")), (2, 1))
        self.assertFalse((self.folder / "report").exists())

    def test_a_report_is_not_replaced_unasked(self):
        slab, output = synthetic.slab(self.folder / "slab"), self.folder / "report"
        self.assertEqual(self.run_command(slab, "--output", output)[0], 0)
        (output / "report.html").write_text("old")
        code, error = self.run_command(slab, "--output", output)
        self.assertEqual((code, error.count("\n")), (2, 1))
        self.assertIn("--force", error)
        self.assertEqual((output / "report.html").read_text(), "old")
        self.assertEqual(self.run_command(slab, "--output", output, "--force")[0], 0)
        self.assertNotEqual((output / "report.html").read_text(), "old")
        other = self.folder / "other"
        other.mkdir()
        (other / "result_slab.html").write_text("old")  # a page of one result
        self.assertEqual(self.run_command(slab, "--output", other)[0], 2)
        self.assertEqual([path.name for path in other.iterdir()], ["result_slab.html"])


class Writing(synthetic.InFolder):
    def test_a_folder_has_one_owner_at_a_time(self):
        with writing.own(self.folder / "out", [], False):
            with self.assertRaisesRegex(writing.Refused, "belongs to another run"):
                with writing.own(self.folder / "out", [], True):
                    pass
        with writing.own(self.folder / "out", [], False):
            self.assertEqual(list((self.folder / "out").iterdir()), [])

    def test_a_file_that_cannot_be_written_leaves_the_old_one(self):
        path = self.folder / "a.txt"
        writing.write(path, "old")
        limit = resource.getrlimit(resource.RLIMIT_FSIZE)
        handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (1, limit[1]))  # as if the disk were full
        try:
            with self.assertRaisesRegex(writing.Unwritten, "a.txt.*too large"):
                writing.write(path, "new")
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limit)
            signal.signal(signal.SIGXFSZ, handler)
        self.assertEqual(path.read_text(), "old")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["a.txt"])
        with self.assertRaises(writing.Unwritten):
            writing.write(self.folder / "none" / "a.txt", "new")

    def test_a_link_is_replaced_and_not_followed(self):
        (self.folder / "victim").write_text("old")
        for name in ("a.txt", "a.txt.part"):
            (self.folder / name).symlink_to("victim")
        writing.write(self.folder / "a.txt", "new")
        self.assertEqual([(self.folder / name).read_text() for name in ("victim", "a.txt")], ["old", "new"])

    def test_messages_are_one_line_that_a_terminal_only_shows(self):
        self.assertEqual(writing.visible("a\nb\x1b[31m\u202e"), "a\\nb\\x1b[31m\\u202e")
        self.assertLess(len(writing.visible("x" * 100000)), 1.1 * writing.LONGEST_MESSAGE)

    def test_lost_words_are_code_3_and_results_are_kept(self):
        slab, output = synthetic.slab(self.folder / "slab"), self.folder / "report"
        command = [pathlib.Path(compare.__file__), slab, "--output", output]
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
            help_words = subprocess.run([command[0], "--help"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        for run in (done, help_words):
            self.assertEqual(run.returncode, 3)
            self.assertIn("standard output could not be written", run.stderr)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertTrue((output / "report.html").is_file())

    def test_words_go_into_no_file_when_standard_output_is_closed(self):
        slab, output = synthetic.slab(self.folder / "slab"), self.folder / "report"
        done = subprocess.run(["sh", "-c", f"'{compare.__file__}' '{slab}' --output '{output}' >&- <&-"], check=False)
        self.assertEqual(done.returncode, 0)
        self.assertTrue((output / "report.html").read_bytes().endswith(b"</html>\n"))


if __name__ == "__main__":
    unittest.main()
