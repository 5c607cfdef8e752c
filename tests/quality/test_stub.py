"""The type stubs of the compiled core and of the inflow models say what they are; one run of mypy reads both."""

import subprocess
import sys
from pathlib import Path

STUBS = ("wakeflight._core", "wakeflight.inflow")


def test_the_stubs_describe_the_compiled_core_and_the_models():
    command = [sys.executable, "-m", "mypy.stubtest", *STUBS, "--ignore-missing-stub"]
    result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=Path(__file__).parent)
    assert result.returncode == 0, result.stdout + result.stderr
    # a module more is a stub not read: every one that is written down is in the list
    package = Path(__file__).resolve().parents[2] / "python" / "wakeflight"
    assert {f"wakeflight.{path.stem}" for path in package.rglob("*.pyi")} == {*STUBS}
