# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight validate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..errors import NumericalFailure
from .groups import Run
from .outcome import folder_made
from .request import set_threads, writable


def validate(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[CASE]...", help="H01, a folder's name, a group, exact, measured")
    ] = None,
    cases: Annotated[Path | None, typer.Option("--cases", help="folder of cases; validation/ of the checkout")] = None,
    fast: Annotated[bool, typer.Option("--fast", help="leave out cases marked slow")] = False,
    *,
    run: Run,
) -> None:
    """Run reference cases, write a page with figure and score for each; exit code 3 where the program is wrong."""
    from .. import validate as checking
    from ..validate import page

    set_threads(run.threads)
    chosen = checking.select(checking.cases(checking.cases_folder(cases)), names or [])
    if fast:
        chosen = [case for case in chosen if not case.slow]
    folder = folder_made(writable(run.out or Path("runs/validation")))
    print(f"{'case':<8}{'verdict':<16}{'within':>8}{'s':>8}  title")

    def line(result: checking.Result) -> None:
        score = f"{result.n_within}/{len(result.gated)}" if result.gated else ""
        text = result.case.title if result.failure is None else f"{result.case.title}: {result.failure}"
        print(f"{result.case.id:<8}{result.verdict:<16}{score:>8}{result.seconds:>8.1f}  {text}", flush=True)

    results = checking.run_all(chosen, folder, line)
    print(f"wrote {page.write(results, folder / 'index.html')}")
    broken = [result.case.id for result in results if result.broken]
    if broken:
        raise NumericalFailure(f"outside the tolerance of an exact case, or not run: {', '.join(broken)}")
