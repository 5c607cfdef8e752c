# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight sweep`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from ..errors import InputError, Interrupted, NumericalFailure
from .groups import Drawing, Out
from .request import check_drawing, writable


def sweep(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.toml", help="verb, axes or a sample, what is the same in all cases")
    ],
    *,
    workers: Annotated[
        int | None, typer.Option("--workers", help="processes", show_default="the file's, or one for each core")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="go on with the cases that are there already")] = False,
    drawing: Drawing,
    out: Out = None,
) -> None:
    """Run a verb for every case of a grid or a sample, write one table (table.nc) and a figure; cases are kept as they are
    done."""
    drawing = check_drawing(drawing)
    from ..plotting import style, sweeps
    from ..progress import Progress
    from ..sweep import TABLE
    from ..sweep import sweep as run
    from ..sweep.file import read_sweep

    asked = read_sweep(file)
    for key in asked.figure:
        if key not in ("x", "y"):
            raise InputError.choice("figure", key, ("x", "y"), file=file)
    folder = writable(out or asked.folder or Path("runs") / file.stem)
    try:
        with Progress() as progress:
            table = run(
                asked.verb,
                asked.cases,
                out=folder,
                resume=resume,
                workers=workers if workers is not None else asked.workers,
                keep=asked.keep,
                progress=progress,
                **asked.fixed,
            )
    except InputError as reason:
        raise reason.within(file) from None
    except Interrupted as signal:
        said = f"{signal}: finished cases are kept in {folder}; `wakeflight sweep {file} --resume` goes on"
        raise Interrupted(said, signal.exit_code - 128) from signal
    written = [folder / TABLE]
    if drawing.figures and (asked.figure or len(asked.cases) > 1) and sweeps.quantities(table, asked.figure.get("y")):
        written.append(style.save(_figure(table, asked.figure), folder / f"sweep.{drawing.figure_format}"))
    print(summary(table))
    print(f"wrote {', '.join(map(str, written))}")
    if table.attrs["failed"]:
        raise NumericalFailure(
            f"{table.attrs['failed']} of {table.attrs['cases']} cases have no answer: see `failure` in the table"
        )


def _figure(table: Any, asked: dict[str, Any]) -> Any:
    from ..plotting import sweeps

    return sweeps.figure(table, asked.get("y"), asked.get("x"))


def summary(table: Any) -> str:
    """What was run, and what came of it."""
    axes = ", ".join(f"{name} ({n})" for name, n in table["failure"].sizes.items())
    return (
        f"{table.attrs['verb']}: {table.attrs['cases']} cases along {axes or 'no axis'}, {table.attrs['failed']} failed"
    )
