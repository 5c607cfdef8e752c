"""The cockpit in a headless browser: the picture moves, a stick changes the attitude, pictures come fast enough, no faults.

Needs Chromium, which the browser's own protocol of developers drives; without it there is nothing to look with.
"""

import base64
import json
import os
import re
import shutil
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest
from websockets.sync.client import connect

import wakeflight as wf

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None
)
ENOUGH, QUIET = 28.0, 0.15
"""Pictures a second that are asked for; processors that others may take on a machine that is quiet."""
pytestmark = [pytest.mark.slow, pytest.mark.skipif(CHROMIUM is None, reason="no Chromium to look with")]


class Page:
    """A page in a browser without a window."""

    def __init__(self, folder, url):
        options = ("--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0")
        self.process = subprocess.Popen(
            [CHROMIUM, *options, f"--user-data-dir={folder}", "--window-size=1280,800", url],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        told = _waited(lambda: (Path(folder) / "DevToolsActivePort").read_text().split()[0])
        pages = _waited(lambda: json.load(urllib.request.urlopen(f"http://127.0.0.1:{told}/json")))
        address = next(each["webSocketDebuggerUrl"] for each in pages if each["type"] == "page")
        self.count, self.faults = 0, []
        self.context = connect(address, max_size=None)
        self.socket = self.context.__enter__()
        for name in ("Runtime", "Log", "Page"):
            self.do(f"{name}.enable")

    def do(self, method, **given):
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": given}))
        while True:
            told = json.loads(self.socket.recv(timeout=60))
            if told.get("id") == self.count:
                return told["result"]
            if told.get("method") in ("Runtime.exceptionThrown", "Log.entryAdded"):
                self.faults.append(told["params"])

    def value(self, text):
        return self.do("Runtime.evaluate", expression=text, returnByValue=True)["result"].get("value")

    def key(self, code, down):
        self.do("Input.dispatchKeyEvent", type="rawKeyDown" if down else "keyUp", code=code, key=code)

    def picture(self):
        return base64.b64decode(self.do("Page.captureScreenshot", format="png")["data"])

    def close(self):
        self.context.__exit__(None, None, None)
        self.process.terminate()
        self.process.wait(20)


def _waited(found, seconds=60.0):
    """What `found` gives, once it gives something."""
    end = time.monotonic() + seconds
    while True:
        try:
            value = found()
            if value:
                return value
        except (OSError, IndexError):
            pass
        assert time.monotonic() < end, "it does not come"
        time.sleep(0.2)


def spent(process):
    """Processor time so far [s]: of the whole machine, and of this process, `process` and all their children."""
    tick = os.sysconf("SC_CLK_TCK")
    fields = [int(each) for each in Path("/proc/stat").read_text().split("\n")[0].split()[1:9]]
    # but for idle and waiting for a disk; what the host takes from a guest counts
    machine = (sum(fields) - fields[3] - fields[4]) / tick
    parent, used = {}, {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            own = path.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        parent[int(path.parent.name)], used[int(path.parent.name)] = int(own[1]), sum(map(int, own[11:15])) / tick
    ours, more = {os.getpid(), process}, True
    while more:
        more = {child for child, of in parent.items() if of in ours} - ours
        ours |= more
    return machine, sum(used.get(each, 0.0) for each in ours)


def pictures(page, flown, windows=6, seconds=5.0):
    """Most pictures a second in a few spans, and what others took of the processors meanwhile, in whole processors."""
    found = []
    for _ in range(windows):
        drawn, wall, (machine, own) = page.value("cockpit.drawn"), time.monotonic(), spent(flown.pid)
        time.sleep(seconds)
        rate, after = page.value("cockpit.drawn") - drawn, spent(flown.pid)
        wall = time.monotonic() - wall
        found.append((rate / wall, (after[0] - machine - after[1] + own) / wall))
        if found[-1][0] > ENOUGH:
            break
    return max(found)


def test_the_helicopter_is_flown_in_a_browser_with_the_wake_of_the_paper(tmp_path):
    command = [sys.executable, "-m", "wakeflight", "cockpit", "--no-browser", "--port", "0", "--flight-path", "0 deg"]
    flown = subprocess.Popen(
        [*command, "--out", str(tmp_path / "runs")],
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        env=os.environ | {"WAKEFLIGHT_THREADS": "1"},
    )
    url = next(found[1] for line in flown.stderr if (found := re.match(r"cockpit: (http\S+)", line)))
    page = Page(tmp_path / "browser", url)
    try:
        _waited(lambda: page.value("cockpit.scalars !== null"))
        assert page.value("cockpit.status.state") == "paused"
        first = page.picture()
        page.key("Space", True)
        page.key("Space", False)
        _waited(lambda: page.value("cockpit.scalars.time > 0.5"), 120.0)
        assert page.picture() != first
        rate, others = pictures(page, flown)
        pace = page.value("cockpit.scalars.pace")
        print(f"{rate:.1f} pictures a second at {pace:.2f} of real time, others took {others:.2f} processors")
        # pictures are offered whatever the time does: only others who take the processors excuse fewer
        assert rate > ENOUGH or others > QUIET, (rate, pace, others)
        roll = page.value("cockpit.scalars.roll")
        page.key("ArrowRight", True)
        _waited(lambda: page.value("cockpit.scalars.roll") > roll + 0.1, 120.0)
        page.key("ArrowRight", False)
        for width in (1280, 390):
            page.do(
                "Emulation.setDeviceMetricsOverride", width=width, height=844, deviceScaleFactor=1, mobile=width < 500
            )
            assert page.value("document.documentElement.scrollWidth") <= width
        page.value("document.querySelector('[data-do=end]').click()")
        assert flown.wait(120) == 0
        # what has been lost when the session ends is no fault of the page
        assert not [each for each in page.faults if "ERR_CONNECTION" not in json.dumps(each)], page.faults
    finally:
        page.close()
        flown.terminate()
    (run,) = (tmp_path / "runs").glob("*/run.nc")
    again = wf.rerun(run)
    assert again.same, again.differing
    if rate <= ENOUGH:
        pytest.skip(
            f"all but the rate was shown: {rate:.1f} pictures a second while others took {others:.2f} processors"
        )
