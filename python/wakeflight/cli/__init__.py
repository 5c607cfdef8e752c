# SPDX-License-Identifier: MIT OR Apache-2.0
"""The command line: names in, everything checked before anything starts, one line for whatever is wrong.

One file per command; `groups` declares the options that several share. Exit codes: 0 finished; 1 a run flown again has other
bits; 2 bad input; 3 numerical failure, or a disk that does not take what is written (what was computed is kept); 130 and 143
interrupted by SIGINT and SIGTERM (what was flown is kept).
"""

from __future__ import annotations

import contextlib
import os
import sys
import traceback
from pathlib import Path
from typing import Annotated

import typer

from ..errors import NumericalFailure, WakeflightError, one_line, shortened
from ..interruption import answered
from . import (
    case,
    cockpit,
    compare,
    converge,
    export,
    fly,
    linearize,
    listing,
    modes,
    new_aircraft,
    paper,
    report,
    resume,
    sweep,
    trim,
    tunnel,
    validate,
)
from .groups import expanded

app = typer.Typer(
    add_completion=True,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Helicopters in unsteady manoeuvres with a time-accurate free vortex wake.",
)

for _command in (
    fly.fly,
    cockpit.cockpit,
    compare.compare,
    trim.trim,
    modes.modes,
    linearize.linearize,
    report.report,
    converge.converge,
    sweep.sweep,
    validate.validate,
    tunnel.tunnel,
    paper.paper,
    export.export,
    resume.resume,
    resume.recover,
    resume.rerun,
):
    # in the order in which help lists them
    app.command()(expanded(_command))
app.command("run")(case.case)
app.command("list")(listing.listing)
app.command("new-aircraft")(new_aircraft.new_aircraft)
app.command("schema")(new_aircraft.schema)


def _version(asked: bool) -> None:
    """Print the version and end."""
    if asked:
        from importlib.metadata import PackageNotFoundError
        from importlib.metadata import version as installed

        try:
            print(f"wakeflight {installed('wakeflight')}")
        except PackageNotFoundError:
            print("wakeflight, run from a source tree")
        raise typer.Exit


@app.callback()
def _everywhere(
    version: Annotated[
        bool, typer.Option("--version", help="Show the version and exit.", callback=_version, is_eager=True)
    ] = False,
) -> None:
    """Helicopters in unsteady manoeuvres with a time-accurate free vortex wake."""


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit; every expected error is one line on standard error."""
    try:
        for stream in (sys.stdout, sys.stderr):
            # a locale that lacks a character does not end a run
            with contextlib.suppress(AttributeError):
                stream.reconfigure(errors="replace")  # type: ignore[union-attr]
        with answered():
            code = app(args=arguments, prog_name="wakeflight", standalone_mode=False) or 0
    except NumericalFailure as failure:
        code = _complain(f"numerical failure: {failure}", failure.exit_code)
    except WakeflightError as reason:
        code = _complain(str(reason), reason.exit_code)
    except KeyboardInterrupt:
        code = _complain("interrupted", 130)
    except Exception as reason:  # usage errors of the parser, which carry their own message
        if not hasattr(reason, "format_message"):
            if os.environ.get("WAKEFLIGHT_TRACEBACK"):
                raise
            sys.exit(_complain(_unforeseen(reason), 1))
        message = reason.format_message()
        if type(reason).__name__.startswith("NoArgsIsHelp"):  # the message is the help text
            print(message, file=sys.stderr)
            code = 2
        else:
            code = _complain(message, 2)
    sys.exit(code if isinstance(code, int) else 0)


def _unforeseen(reason: Exception) -> str:
    """An error that no part of the program foresaw, in one line with its place."""
    place = traceback.extract_tb(reason.__traceback__)[-1]
    at = f"{Path(place.filename).name}, line {place.lineno}"
    told = f"{type(reason).__name__}: {shortened(one_line(reason), 200)}"
    return f"a fault of the program, not of the input ({told}; {at}); please report it, with WAKEFLIGHT_TRACEBACK=1 set for more"


def _complain(message: str, code: int) -> int:
    print(f"wakeflight: {one_line(message)}", file=sys.stderr)
    return code
