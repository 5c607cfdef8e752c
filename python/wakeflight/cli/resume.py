# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight resume`, `recover` and `rerun`: a flight that was cut, that died, that is to be flown again."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..errors import WakeflightError
from . import outcome
from .groups import Checkpoint, Drawing, Folder, Threads
from .request import check_drawing, seconds_between, set_threads


class Differs(WakeflightError):
    """A run flown again has other bits."""


def resume(
    folder: Folder,
    until: Annotated[
        str | None, typer.Option("--until", help='another end of the flight, "3 s" from its start')
    ] = None,
    checkpoint: Checkpoint = "1 s",
    threads: Threads = None,
    *,
    drawing: Drawing,
) -> None:
    """Go on with a flight that was cut, to the bits of the uncut one; write run.nc, figures and report.html."""
    set_threads(threads)
    drawing = check_drawing(drawing)
    every = seconds_between(checkpoint)
    from ..progress import Progress
    from ..resuming import opened, resumed

    with Progress() as progress, opened(folder, every) as kept:
        outcome.shown(lambda: resumed(kept, until, progress), kept, progress, drawing)


def recover(folder: Folder) -> None:
    """Make run.nc of a flight that died, as far as it was flown; resume can still go on with it."""
    from ..progress import Progress
    from ..resuming import recover as recovered

    with Progress() as progress:
        print(f"wrote {recovered(folder, progress)}")


def rerun(
    run: Annotated[Path, typer.Argument(metavar="RUN.nc", help="a run, which carries its whole input")],
    out: Annotated[
        Path | None, typer.Option("--out", help="folder for the run flown again; none is written by default")
    ] = None,
    threads: Threads = None,
) -> None:
    """Fly a run's own input again and say whether the bits agree: exit code 0 where they do, 1 where not."""
    set_threads(threads)
    from ..progress import Progress
    from ..resuming import rerun as again

    with Progress() as progress:
        found = again(run, progress)
        if out is not None:
            print(f"wrote {found.flight.save(outcome.folder_made(out) / 'run.nc')}")
    for text in found.told:
        print(text)
    if found.same:
        print(f"{run}: flown again, every bit of every variable agrees")
        return
    listed = ", ".join(
        f"{name} by {share:.1e}" for name, share in sorted(found.differing.items(), key=lambda p: -p[1])[:6]
    )
    raise Differs(f"{run}: flown again, {len(found.differing)} variables differ, over their largest value: {listed}")
