"""The paper's page in a real browser without a display: it loads without errors, the slider moves a wake that is seen."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "unit"))
import paper_runs

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
ROTOR = {"shaft_tilt": 0.05, "hinge_offset": 0.047, "root_cutout": 0.13, "chord": 0.065}

# hands of a reader: every picture is read back and compared
HANDS = """
<script>
const found = { errors: [] };
window.addEventListener("error", (event) => found.errors.push(event.message));
window.addEventListener("load", () => {
  const part = (name) => document.querySelector("#wake-view [data-part=" + name + "]");
  const pixels = () => wakeView.panels.map((canvas) => {
    const all = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    return { drawn: all.filter((p) => p !== 0).length, sum: all.reduce((s, p) => (s * 31 + p) >>> 0, 7) };
  });
  const change = (name, value, event) => { part(name).value = value; part(name).dispatchEvent(new Event(event)); };
  found.first = pixels();
  change("slider", 2, "input");
  found.moved = pixels();
  found.clock = part("clock").textContent;
  change("colour", "age", "change");
  found.aged = pixels();
  change("axes", "hub", "change");
  found.hub = pixels();
  change("maneuver", "roll-reversal", "change");
  found.other = pixels();
  document.querySelector("[data-view=top]").click();
  found.top = pixels();
  const out = document.createElement("pre");
  out.id = "found";
  out.textContent = JSON.stringify(found);
  document.body.append(out);
});
</script>
"""


@pytest.mark.slow
@pytest.mark.skipif(BROWSER is None, reason="no browser installed: chromium, chromium-browser or google-chrome")
def test_the_slider_moves_the_wake_in_a_browser(tmp_path):
    from wakeflight.studies.paper.page import write

    path = write(paper_runs.runs(), tmp_path, ROTOR)
    text = path.read_text()
    assert not re.search(r"(<link[^>]* href|src)=\"?(https?:)?//", text)
    path.write_text(text.replace("<body>", "<body>" + HANDS, 1))
    command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1280,900"]
    command += ["--virtual-time-budget=10000", "--enable-logging=stderr", "--dump-dom", path.as_uri()]
    shown = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    # the browser advises on reading pictures back, which only this test does
    said = [line for line in shown.stderr.splitlines() if "CONSOLE" in line and "getImageData" not in line]
    assert said == []
    found = json.loads(re.search(r'<pre id="found">(.*?)</pre>', shown.stdout).group(1).replace("&gt;", ">"))
    assert found["errors"] == []
    assert found["clock"].startswith("1.86 s")
    for picture in ("first", "moved", "aged", "hub", "other", "top"):
        # blades, path and lettering alone take some two thousand pixels
        assert all(panel["drawn"] > 1000 for panel in found[picture]), picture
    for before, after in (("first", "moved"), ("moved", "aged"), ("aged", "hub"), ("hub", "other"), ("other", "top")):
        assert found[before][1]["sum"] != found[after][1]["sum"], f"{before} and {after} look alike"
