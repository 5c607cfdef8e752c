# SPDX-License-Identifier: MIT OR Apache-2.0
"""Running cases: what each found, what it cost, and what stopped it."""

from __future__ import annotations

import base64
import csv
import io
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from ..atomic import write_text
from ..studies import attempt
from .case import Case, Check, Outcome


@dataclass(frozen=True)
class Result:
    """A case that was run: its outcome, or why there is none."""

    case: Case
    outcome: Outcome | None
    seconds: float
    failure: str | None = None
    png: str = ""

    @property
    def gated(self) -> list[Check]:
        """Checks with a verdict."""
        return [check for check in self.outcome.checks if check.gate] if self.outcome else []

    @property
    def n_within(self) -> int:
        """Checks that keep their tolerance."""
        return sum(check.within is True for check in self.gated)

    @property
    def verdict(self) -> str:
        """`waits`, `failed`, `within`, `partly within` or `outside`."""
        if self.case.kind == "waits":
            return "waits"
        if self.failure is not None or self.outcome is None:
            return "failed"
        if not self.gated:
            return "shown"
        if self.n_within == len(self.gated):
            return "within"
        return "partly within" if self.n_within else "outside"

    @property
    def broken(self) -> bool:
        """Whether the program is wrong: an exact case outside its tolerance, or any case that could not run."""
        return self.verdict == "failed" or (self.case.kind == "exact" and self.verdict in ("partly within", "outside"))


def run(case: Case, folder: Path | None = None) -> Result:
    """Run one case; its figure and numbers go to `folder`/<slug>. A failure of the case is a result, not an error."""
    if case.kind == "waits":
        return Result(case, None, 0.0)
    done = attempt(case.run, Exception)
    if done.failure:
        return Result(case, None, done.seconds, done.failure)
    png = _keep(case, done.answer, folder) if folder is not None else ""
    return Result(case, done.answer, done.seconds, png=png)


def run_all(
    chosen: Iterable[Case], folder: Path | None = None, each: Callable[[Result], None] | None = None
) -> list[Result]:
    """Run cases one after the other."""
    results = []
    for case in chosen:
        result = run(case, folder)
        if each is not None:
            each(result)
        results.append(result)
    return results


def _keep(case: Case, outcome: Outcome, folder: Path) -> str:
    """Write numbers and figure; returns the figure as base64 text for the page."""
    own = folder / case.slug
    table = io.StringIO()
    writer = csv.writer(table)
    writer.writerow(["quantity", "unit", "ours", "reference", "difference", "tolerance", "kind", "within", "note"])
    for c in outcome.checks:
        within = "" if c.within is None else ("yes" if c.within else "no")
        numbers = map(repr, (c.ours, c.reference, c.difference))
        writer.writerow([c.quantity, c.unit, *numbers, c.tolerance, c.kind, within, c.note])
    write_text(own / "checks.csv", table.getvalue())
    if outcome.figure is None:
        return ""
    from ..plotting.style import save

    path = save(outcome.figure, own / "figure.png")
    return base64.b64encode(path.read_bytes()).decode("ascii")
