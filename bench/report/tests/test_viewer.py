"""The viewer, driven in a browser where there is one; and the window that it offers."""

import json
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from report.load import load_summary
from report.page import render_page
from report.tests import synthetic
from report.viewer import window_of_difference

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")

# Runs after the page's own script, as a reader would use it: choices, keys and the pointer. What is seen is read off the canvas.
DRIVER = """
<script>
const found = {}, viewer = document.querySelector(".viewer");
const part = (name) => viewer.querySelector(`[data-part=${name}]`);
const choose = (name, value) => { part(name).value = value; part(name).dispatchEvent(new Event("input")); };
const press = (key) => part("stage").dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
const canvases = part("stage").querySelectorAll("canvas");
const pixel = (canvas, u, v) => [...canvas.getContext("2d").getImageData(Math.floor(u * canvas.width), Math.floor(v * canvas.height), 1, 1).data].slice(0, 3);
const drag = (type, u) => { const box = part("stage").getBoundingClientRect();
  part("stage").dispatchEvent(new PointerEvent(type, { clientX: box.left + u * box.width, clientY: box.top + 5, pointerId: 1, bubbles: true })); };
try {
  Element.prototype.setPointerCapture = () => {};  // there is no pointer to capture
  found.shown = !viewer.hidden;
  found.labels = [...part("left").options].map((o) => o.label);
  choose("left", 0); choose("right", 1);
  found.reference = pixel(canvases[0], 0.99, 0.99);
  choose("exposure", 1); found.brighter = pixel(canvases[0], 0.01, 0.01);
  choose("exposure", 0); found.darker = pixel(canvases[0], 0.01, 0.01);
  found.clip = canvases[1].style.clipPath;
  drag("pointerdown", 0.5); drag("pointermove", 0.25); drag("pointerup", 0.25);
  found.dragged = [canvases[1].style.clipPath, Number(part("divide").value)];
  choose("mode", "side"); found.side = getComputedStyle(part("stage")).gridTemplateColumns.split(" ").length;
  press("+"); press("+"); found.zoom = part("zoom").textContent;
  choose("right", 0); found.synchronised = JSON.stringify(pixel(canvases[0], 0.3, 0.7)) === JSON.stringify(pixel(canvases[1], 0.3, 0.7));
  press("ArrowRight"); found.still = JSON.stringify(pixel(canvases[0], 0.3, 0.7)) === JSON.stringify(pixel(canvases[1], 0.3, 0.7));
  press("0"); found.reset = part("zoom").textContent;
  press("w"); found.window = part("zoom").textContent;
  press("0"); choose("show", "error"); choose("left", 0); found.no_error = pixel(canvases[0], 0.5, 0.5);
  choose("show", "rmse"); choose("left", 1); choose("right", 4);
  found.maps = [pixel(canvases[0], 0.1, 0.9), pixel(canvases[1], 0.1, 0.9)];
  choose("show", "image"); press("f"); found.flipped = part("status").textContent; press("f"); found.back = part("status").textContent;
  document.querySelector("img[data-image^=Halton]").dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true })); choose("mode", "slider");
  found.chosen = part("status").textContent;
  found.focusable = [...viewer.querySelectorAll("select, button, input, .stage")].every((e) => e.tabIndex === 0);
  found.named = [...viewer.querySelectorAll("select, button, input")].every((e) => e.ariaLabel || e.textContent.trim() || e.labels.length);
} catch (error) { found.error = String(error); }
document.body.setAttribute("data-found", JSON.stringify(found));
</script></body>"""


class Viewer(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name) / "results"
        summary = synthetic.make_summary(scenes=("smooth", "cornell"))
        synthetic.add_images(self.directory, summary)
        synthetic.write(self.directory, summary)
        self.summary = load_summary(self.directory)

    def test_the_window_lies_where_the_mean_errors_lie_furthest_apart(self):
        window = window_of_difference(self.summary.scenes[0])
        self.assertEqual((window.x, window.y, window.width, window.height), (0, 16, 16, 16))
        self.assertEqual((window.worst, window.best), ("Random", "Sobol' (Owen)"))
        self.assertAlmostEqual(window.ratio, 64, delta=1e-3)
        self.assertIsNone(window_of_difference(self.summary.scenes[1]))

    def test_a_scene_without_data_has_no_viewer(self):
        self.assertEqual(render_page(self.summary).count('class="viewer"'), 1)

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_a_reader_can_use_it_by_pointer_and_by_keys(self):
        page = self.directory / "report.html"
        page.write_text(render_page(self.summary).replace("</body>", DRIVER), encoding="utf-8")
        result = subprocess.run([CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={self.directory}/profile", "--enable-logging=stderr", "--dump-dom",
                                 "--virtual-time-budget=2000", page.as_uri()], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=400)
        self.assertNotIn("Uncaught", result.stderr)
        found = json.loads(re.search(r'data-found="([^"]*)"', result.stdout).group(1).replace("&quot;", '"').replace("&amp;", "&"))
        self.assertNotIn("error", found, found)
        for what in ("shown", "synchronised", "still", "focusable", "named"):
            self.assertTrue(found[what], what)
        self.assertEqual(found["labels"], ["Reference", "Random, 16 spp", "Stratified, 16 spp", "Halton (Owen), 16 spp", "Sobol' (Owen), 16 spp"])
        self.assertEqual(len(set(found["reference"])), 1)  # grey
        self.assertGreater(found["brighter"][0], found["darker"][0] + 30)
        self.assertEqual(found["clip"].replace(" ", ""), "inset(0px0px0px50%)")
        self.assertLess(abs(found["dragged"][1] - 25), 2)
        self.assertNotEqual(found["dragged"][0], found["clip"])
        self.assertEqual((found["side"], found["zoom"], found["reset"], found["window"]), (2, "2.3\u00d7", "1.0\u00d7", "2.0\u00d7"))
        self.assertLess(sum(found["no_error"]), 10)  # the reference has no error: the dark end of the map
        self.assertGreater(sum(found["maps"][0]), sum(found["maps"][1]) + 200)
        self.assertEqual((found["flipped"], found["back"]), ("Sobol' (Owen), 16 spp", "Random, 16 spp"))
        self.assertIn("Halton", found["chosen"])


if __name__ == "__main__":
    unittest.main()
