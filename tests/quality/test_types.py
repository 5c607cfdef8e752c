"""Does the public interface tell its types: a stranger's script is read by mypy as strictly as it can."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
STRANGER = Path(__file__).parent / "stranger.py"

# each line but the first is wrong, and in the way that is written behind it
WRONG = """\
import wakeflight as wf
start = wf.trim("uh60a")  # arg-type
speed: str = wf.trim(wf.load_aircraft("uh60a")).speed  # assignment
wf.arested_descent()  # attr-defined
wf.TimeMarchingWake(turn=6)  # call-arg
wf.RelaxationWake(form="both")  # arg-type
wf.Maneuver("pulse", {"lateral": 1.0}, seconds=2.0)  # dict-item
wf.fly(wf.trim(wf.load_aircraft("uh60a")), wf.arrested_descent()).datta  # attr-defined
"""


@pytest.fixture(scope="module")
def said(tmp_path_factory):
    """Findings of mypy, by file name: line and code of each."""
    wrong = tmp_path_factory.mktemp("types") / "wrong.py"
    wrong.write_text(WRONG)
    # as a user has it: no settings of this repository, the package where Python finds it
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file=", f"--cache-dir={ROOT / '.mypy_cache'}"]
    ran = subprocess.run([*command, STRANGER, wrong], cwd=wrong.parent, capture_output=True, text=True, check=False)
    assert ran.returncode in (0, 1), ran.stdout + ran.stderr
    found = re.findall(r"^(.+?):(\d+): error: .*\[([a-z-]+)\]$", ran.stdout, re.MULTILINE)
    return {
        name: [(int(n), code) for file, n, code in found if Path(file).name == name]
        for name in ("stranger.py", "wrong.py")
    }


def test_a_strangers_script_is_clean(said):
    assert said["stranger.py"] == []


def test_wrong_calls_are_found_before_they_run(said):
    expected = [(n, line.split("# ")[1]) for n, line in enumerate(WRONG.splitlines(), 1) if "# " in line]
    assert said["wrong.py"] == expected


def test_what_may_be_given_and_what_may_be_read_are_imported_under_one_name():
    # names that only exist for checkers, or only when running, would be found by neither test
    import wakeflight as wf

    source = Path(wf.__file__).read_text()
    block = source.split("if TYPE_CHECKING:")[1].split("_HOME")[0]
    told = set(re.findall(r"\b(\w+)(?=[,)\n])", block)) | {"__version__"}
    assert set(wf.__all__) <= told
