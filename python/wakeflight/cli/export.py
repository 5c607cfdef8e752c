# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight export`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from .groups import Out, offered
from .outcome import folder_made
from .request import writable

FORMATS = ("vtk", "mat", "csv", "netcdf3", "wopwop")


def export(
    run: Annotated[Path, typer.Argument(metavar="RUN.nc", help="run.nc, trim.nc or tunnel.nc")],
    to: Annotated[str, typer.Option("--to", help=", ".join(FORMATS), autocompletion=offered(*FORMATS))] = "vtk",
    out: Out = None,
) -> None:
    """Write a result for ParaView, MATLAB, spreadsheets or older NetCDF readers, into a folder beside it or --out."""
    if not run.is_file():
        raise InputError.of("RUN.nc", str(run), "no such file; allowed: run.nc, trim.nc or tunnel.nc of a finished run")
    print(f"wrote {export_to(run, to, out or run.parent / to)}")


def export_to(run: Path, to: str, folder: Path) -> Path:
    """Write the result in the file `run` as format `to` into `folder`; the file to open."""
    if to not in FORMATS:
        raise InputError.choice("--to", to, FORMATS)
    from .. import results
    from ..export import export as write

    writable(folder)
    return write(results.load(run), folder_made(folder), to)
