# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight report`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from ..text import is_file
from .groups import Drawing, DrawnUnits, FigureFormat, Out
from .outcome import folder_made
from .request import check_drawing, writable


def report(
    run: Annotated[Path, typer.Argument(metavar="RUN.nc", help="result of a finished run")],
    figure_format: FigureFormat = "png",
    units: DrawnUnits = "si",
    out: Out = None,
) -> None:
    """Rebuild figures and report of a finished run, beside it or in --out."""
    if not is_file(run):
        raise InputError.of("RUN.nc", str(run), "no such file; allowed: the run.nc of a finished run")
    check_drawing(Drawing(figure_format=figure_format, units=units))
    from .. import report as reports
    from .. import results

    flight = results.load(run, "flight")
    folder = folder_made(writable(out or run.parent))
    reports.write(flight, folder, figure_format=figure_format, units=units)
    print(f"wrote {folder / 'report.html'}")
