"""The report in a browser: headless Chromium shows it on a desk, on a telephone, and without scripts."""

import contextlib
import hashlib
import io
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import synthetic

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402

import compare  # noqa: E402
import frames  # noqa: E402
import solid  # noqa: E402

# Pictures that nobody looks at: most of the time goes into pixels and into the layout.
matplotlib.rcParams.update({"savefig.dpi": 60, "figure.constrained_layout.use": False})

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    webdriver = None
BROWSER, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
WIDTHS = {1280: 1000, 390: 844}  # width and height of a window on a desk and of a telephone
PAPER = 680  # pixels of an A4 page between margins of 15 mm


def browser(scripts=True, space=True):
    """space: whether it can draw in 3D, by software, as a machine without a graphics card does."""
    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run",
                 "--disable-background-networking"):
        options.add_argument(word)
    drawing = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-rasterization")
    for word in drawing if space else ("--disable-gpu", "--disable-3d-apis"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    if not scripts:
        options.add_experimental_option("prefs", {"profile.managed_default_content_settings.javascript": 2})
    return webdriver.Chrome(service=Service(DRIVER), options=options)


def requests(driver):
    """Returns the addresses that the browser has asked for since the last call."""
    messages = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    return {message["params"]["request"]["url"] for message in messages if message["method"] == "Network.requestWillBeSent"}


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if webdriver is None or not (BROWSER and DRIVER):
            words = "the report is not tried in a browser: install chromium, chromium-driver and python3-selenium"
            if os.environ.get("SPALL_CHECKS"):
                raise AssertionError(words)
            print(f"skipped: {words}", file=sys.stderr)
            raise unittest.SkipTest(words)
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        folder = pathlib.Path(temporary.name)
        # Two runs that differ in many inputs have a table of many columns.
        slab, other = (synthetic.slab(folder / name, velocity, inputs={f"slab/{key}": value for key in (
            "Layers", "Rings", "Growth", "Jitter", "Jitter seed", "Hole diameter", "Surface", "Boundary points", "Crack band")})
                       for name, velocity, value in (("slab_127", 210.0, "1.25"), ("slab_127_axis", 215.0, "2.5")))
        synthetic.change_summary(slab, struck_face=0.0, projectile_radius=0.0254, projectile_mass=2.34, warnings="few points")
        cls.slab, output = slab, folder / "report"
        with contextlib.redirect_stdout(io.StringIO()):
            code = compare.main([str(path) for path in (slab, other, synthetic.microcell(folder / "microcell"), "--output", output,
                                                        "--references", synthetic.references(folder / "measured"))])
        assert code == 0
        cls.page = (output / "report.html").as_uri()
        cls.driver = browser()
        cls.addClassCleanup(cls.driver.quit)

    def show(self, width):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": WIDTHS.get(width, 1000), "deviceScaleFactor": 1, "mobile": width < 600})
        self.driver.get(self.page)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def run_script(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def test_nothing_is_asked_for_but_the_page_and_the_console_is_silent(self):
        self.driver.get_log("browser"), requests(self.driver)
        self.show(1280)
        for button in self.all("button.interactive"):
            self.run_script("arguments[0].click()", button)
        self.all("canvas.solid")[0].send_keys(Keys.ARROW_LEFT)
        asked = {address for address in requests(self.driver) if not address.startswith("data:")}
        self.assertEqual(asked, {self.page})
        self.assertEqual(self.driver.get_log("browser"), [])

    def test_nothing_is_wider_than_the_page_but_what_scrolls_in_its_frame(self):
        for width in WIDTHS:
            self.show(width)
            for button in self.all("button.interactive"):
                self.run_script("arguments[0].click()", button)
            self.assertLessEqual(self.run_script("return document.documentElement.scrollWidth"), width)
            wide = self.run_script(
                "return [...document.querySelectorAll('body *')].filter(e => !e.parentElement.closest('.table, .frame, pre') &&"
                " e.getBoundingClientRect().right > innerWidth + 0.5).map(e => e.outerHTML.slice(0, 80))")
            self.assertEqual(wide, [], width)

    def test_the_time_slider_changes_the_picture(self):
        self.show(390)
        seen = set()
        for time in (0, 1):
            self.run_script("const slider = arguments[0]; slider.value = arguments[1]; slider.dispatchEvent(new Event('input'))",
                            self.all("input[type=range]")[0], time)
            picture = self.run_script("return document.querySelector('canvas.section').toDataURL()")
            seen.add((hashlib.sha256(picture.encode()).hexdigest(), self.all("output")[0].text))
        self.assertEqual(len({picture for picture, _ in seen}), 2)
        self.assertEqual({time for _, time in seen}, {"0 ms", "2 ms"})

    def turning(self):
        """Opens the first view in space; returns its canvas."""
        self.run_script("[...document.querySelectorAll('button')].find(b => b.textContent === 'Turn it in 3D').click()")
        return self.all("canvas.solid")[0]

    def pixels(self, canvas):
        """Returns the part of a view that is not white, and a sum of its picture."""
        return self.run_script(
            "const canvas = arguments[0], copy = document.createElement('canvas').getContext('2d', {willReadFrequently: true});"
            "Object.assign(copy.canvas, {width: canvas.width, height: canvas.height}); copy.drawImage(canvas, 0, 0);"
            "const found = copy.getImageData(0, 0, canvas.width, canvas.height).data;"
            "let drawn = 0, sum = 0;"
            "for (let i = 0; i < found.length; i += 4) { const grey = found[i] + found[i + 1] + found[i + 2];"
            " drawn += grey < 765; sum = (31 * sum + grey) % 1000003; }"
            "return [drawn / (found.length / 4), sum]", canvas)

    def test_the_body_in_space_is_drawn_and_turns(self):
        for width in WIDTHS:
            self.show(width)
            canvas = self.turning()
            part, first = self.pixels(canvas)
            self.assertTrue(0.2 < part < 0.9, part)
            self.assertFalse(canvas.find_element(By.XPATH, "ancestor::figure").find_element(By.TAG_NAME, "img").is_displayed())
            seen = {first}
            for key in (Keys.ARROW_LEFT, Keys.ARROW_UP, "+"):
                canvas.send_keys(key)
                seen.add(self.pixels(canvas)[1])
            ActionChains(self.driver).drag_and_drop_by_offset(canvas, 40, 25).perform()
            seen.add(self.pixels(canvas)[1])
            self.run_script("arguments[0].parentElement.querySelector('input[type=checkbox]').click()", canvas)
            seen.add(self.pixels(canvas)[1])
            self.assertEqual(len(seen), 6)
            self.run_script("arguments[0].parentElement.querySelector('input[type=checkbox]').click()", canvas)
            canvas.send_keys(Keys.HOME)
            self.assertEqual(self.pixels(canvas)[1], first)

    def test_the_page_draws_the_body_of_the_picture_that_it_replaces(self):
        """The part of the view that is not white is that of the same body on paper."""
        self.show(1280)
        part = self.pixels(self.turning())[0]
        picture, _ = solid.rendered(solid.scene_of(frames.read_frame(self.slab / "fields.h5")[0]))
        self.assertAlmostEqual(part, (picture < 1).any(axis=2).mean(), delta=0.05)

    def test_where_nothing_can_be_drawn_in_space_the_picture_stays(self):
        plain = browser(space=False)
        try:
            plain.get(self.page)
            plain.get_log("browser")
            plain.execute_script("[...document.querySelectorAll('button')].find(b => b.textContent === 'Turn it in 3D').click()")
            figure = plain.find_element(By.CSS_SELECTOR, "figure:has(script.solid)")
            self.assertTrue(figure.find_element(By.TAG_NAME, "img").is_displayed())
            self.assertIn("the picture stays", figure.text)
            self.assertEqual(plain.get_log("browser"), [])
        finally:
            plain.quit()

    def test_values_are_read_off_where_the_pointer_is(self):
        self.show(1280)
        words = self.run_script(
            "const canvas = document.querySelector('.explorer canvas'); canvas.scrollIntoView({block: 'center'});"
            "const box = canvas.getBoundingClientRect(), chart = Chart.getChart(canvas);"
            "canvas.dispatchEvent(new MouseEvent('mousemove', {clientX: box.left + chart.scales.x.getPixelForValue(0.8),"
            " clientY: box.top + box.height / 2, bubbles: true}));"
            "const first = chart.readout.textContent, end = Date.now() + 5000;"
            "return new Promise(done => { const look = () => chart.readout.textContent !== first || Date.now() > end ?"
            " done(chart.readout.textContent) : setTimeout(look, 20); look(); })")
        found = re.fullmatch(r"time \(ms\): ([\d.]+); velocity of the projectile \(m/s\): ([\d.]+)", words)
        self.assertTrue(found, words)
        time, velocity = float(found[1]), float(found[2])
        phase = time / 1.6  # synthetic.history
        self.assertAlmostEqual(time, 0.8, delta=0.01)
        self.assertAlmostEqual(velocity, 313 - 103 * phase**2 * (3 - 2 * phase), delta=0.2)

    def test_the_explorer_draws_what_is_chosen(self):
        self.show(1280)
        labels = self.run_script(
            "const [up, across] = document.querySelectorAll('.explorer select'), found = [];"
            "for (const a of across.options) for (const u of up.options) {"
            " across.value = a.value; up.value = u.value; up.dispatchEvent(new Event('change'));"
            " const scales = Chart.getChart(document.querySelector('.explorer canvas')).options.scales;"
            " found.push([scales.x.title.text, scales.y.title.text]); }"
            "return found")
        for across in ("time (ms)", "depth of the tip (mm)"):
            for up in ("velocity of the projectile (m/s)", "force on the projectile (kN)"):
                self.assertIn([across, up], labels)

    def test_without_scripts_and_in_print_every_figure_is_a_picture(self):
        self.show(PAPER)
        for button in self.all("button.interactive"):
            self.run_script("arguments[0].click()", button)
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        try:
            cut = self.run_script("return [...document.querySelectorAll('table, img, pre')].filter("
                                  "e => e.getBoundingClientRect().right > innerWidth + 0.5).map(e => e.outerHTML.slice(0, 80))")
            hidden = self.run_script("return [...document.querySelectorAll('figure img')].filter(e => !e.offsetHeight).length")
            left = self.run_script("return [...document.querySelectorAll('.interactive, .explorer')].filter(e => e.offsetHeight).length")
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.assertEqual((cut, hidden, left), ([], 0, 0))
        plain = browser(scripts=False)
        try:
            plain.get(self.page)
            shown = [picture.size["height"] > 50 for picture in plain.find_elements(By.CSS_SELECTOR, "figure img")]
            self.assertTrue(shown and all(shown))
            controls = plain.find_elements(By.CSS_SELECTOR, "canvas, button, select, input")
            self.assertEqual(controls, [])
            self.assertIn("misses the measured 200 m/s", plain.find_element(By.ID, "verdict").text)
            self.assertGreater(len(plain.find_elements(By.CSS_SELECTOR, "table")), 4)
        finally:
            plain.quit()


if __name__ == "__main__":
    unittest.main()
