# SPDX-License-Identifier: MIT OR Apache-2.0
"""matplotlib, whatever the user's machine says to it: a backend of a notebook that is not here, settings it cannot read.

Figures are drawn without a window system and with settings of their own; what stands in `MPLBACKEND` and in a `matplotlibrc`
matters only to the import of matplotlib, which falls over some of it.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import sys
from pathlib import Path

PLAIN = ("MPLBACKEND", "MATPLOTLIBRC")


def imported() -> None:
    """Import matplotlib as the user has it set up; where that fails, as it comes."""
    try:
        importlib.import_module("matplotlib")
    except (ValueError, OSError, ImportError):
        for name in [each for each in sys.modules if each.partition(".")[0] == "matplotlib"]:
            del sys.modules[name]
        spec = importlib.util.find_spec("matplotlib")
        if spec is None or spec.origin is None:
            raise
        kept = {name: os.environ.pop(name) for name in PLAIN if name in os.environ}
        os.environ["MATPLOTLIBRC"] = str(Path(spec.origin).parent / "mpl-data" / "matplotlibrc")
        try:
            importlib.import_module("matplotlib")
        finally:
            del os.environ["MATPLOTLIBRC"]
            os.environ.update(kept)


imported()
