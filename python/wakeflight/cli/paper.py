# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight paper`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from .groups import Out
from .outcome import folder_made
from .request import writable


def paper(
    redraw: Annotated[bool, typer.Option("--redraw", help="draw anew from the flights a former call left")] = False,
    studies: Annotated[bool, typer.Option("--studies", help="also fly the studies beyond the paper")] = False,
    jobs: Annotated[int | None, typer.Option("--jobs", help="flights at a time; as many as cores")] = None,
    out: Out = None,
) -> None:
    """Fly everything Ribera and Celi reported in 2004, judge every statement, write figures and report.html."""
    if jobs is not None and not 1 <= jobs <= 64:
        raise InputError.of("--jobs", jobs, "must lie between 1 and 64")
    folder = writable(out or Path("runs/paper"))
    from ..progress import Progress
    from ..studies.paper import reproduce

    with Progress() as progress:
        path = reproduce(folder_made(folder), redraw, jobs, progress, studies)
    print(f"wrote {path}")
