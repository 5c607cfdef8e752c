"""The type stub of the compiled core says what the core is."""

import subprocess
import sys


def test_the_stub_describes_the_compiled_core():
    command = [sys.executable, "-m", "mypy.stubtest", "wakeflight._core", "--ignore-missing-stub"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
