# SPDX-License-Identifier: MIT OR Apache-2.0
"""Figures 12 to 19 judged four times: both readings of the roll reversal, each with the paper's wake and the standard one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...plotting.histories import DEG, Panel, histories
from ...plotting.style import styled
from .cases import AUGMENTED
from .statements import roll
from .statements.verdict import FAILS, HOLDS, PARTLY, Statement

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

PRINTED, SECOND = "as printed", "augmented"
PAPER, STANDARD = "paper's wake", "standard wake"


@dataclass(frozen=True)
class Way:
    """One way to fly Figures 12 to 19: which reading, which wake, and where its flights are."""

    reading: str
    wake: str
    folder: str

    def runs(self, runs: Runs) -> dict[str, xr.Dataset]:
        """Its flights by model; dynamic inflow has no wake and is that of the reading."""
        reading = self.folder.removesuffix("-standard")
        found = {"dynamic": runs[f"{reading}/dynamic"]}
        return found | {model: runs[f"{self.folder}/{model}"] for model in ("relaxation", "time-marching")}

    @property
    def name(self) -> str:
        """In words."""
        return f"{self.reading}, {self.wake}"


WAYS = (
    Way(PRINTED, PAPER, "roll-reversal"),
    Way(PRINTED, STANDARD, "roll-reversal-standard"),
    Way(SECOND, PAPER, AUGMENTED),
    Way(SECOND, STANDARD, f"{AUGMENTED}-standard"),
)
HEAD = ("where", *(way.name for way in WAYS), "what it takes")
RANK = {HOLDS: 2, PARTLY: 1, FAILS: 0}


@dataclass(frozen=True)
class Row:
    """A statement judged in every way, in the order of `WAYS`."""

    statements: tuple[Statement, ...]

    @property
    def key(self) -> str:
        """Its place in the paper."""
        return self.statements[0].key

    @property
    def claim(self) -> str:
        """What the paper says."""
        return self.statements[0].claim

    @property
    def verdicts(self) -> tuple[str, ...]:
        """Of every way."""
        return tuple(each.verdict for each in self.statements)

    @property
    def needs(self) -> str:
        """What the best verdict takes, in words that follow from the verdicts."""
        ranks = [RANK[verdict] for verdict in self.verdicts]
        best = [way for way, rank in zip(WAYS, ranks, strict=True) if rank == max(ranks)]
        if len(best) == len(WAYS):
            return "the same in all"
        readings, wakes = {way.reading for way in best}, {way.wake for way in best}
        if len(best) == 2 and len(readings) == 1:
            return f"best {next(iter(readings))}"
        if len(best) == 2 and len(wakes) == 1:
            return f"best with the {next(iter(wakes))}"
        return f"best {'; '.join(way.name for way in best)}"

    @property
    def cells(self) -> tuple[str, ...]:
        """As a row of the table: place, verdicts, what it takes."""
        return (self.key, *self.verdicts, self.needs)


def judged(runs: Runs) -> list[Row]:
    """Every statement of Figures 12 to 19 in all ways; `runs` by case name."""
    columns = [roll.statements(way.runs(runs)) for way in WAYS]
    return [Row(tuple(statements)) for statements in zip(*columns, strict=True)]


def counted(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    """How many statements hold, hold partly and do not, a row of the table for each."""
    return [
        (verdict, *(str(sum(row.verdicts[k] == verdict for row in rows)) for k in range(len(WAYS))), "")
        for verdict in (HOLDS, PARTLY, FAILS)
    ]


def motion(runs: Runs) -> list[tuple[str, ...]]:
    """What each way flew: largest bank either way and that at the end [deg], of every model, in the order of `HEAD`."""
    cells = []
    for way in WAYS:
        of_models = []
        for model, run in way.runs(runs).items():
            bank = DEG * run["roll"].values
            of_models.append(f"{model} {bank.max():.0f} right, {-bank.min():.0f} left, {bank[-1]:+.0f} at the end")
        cells.append("; ".join(of_models))
    return [("bank [deg]", *cells, "")]


CAPTION = (
    "The roll reversal in its second reading: bank, roll rate and what is added behind the lateral stick; dynamic inflow and "
    "both wakes of the paper and of this program."
)


@styled
def figure(runs: Runs) -> Figure:
    """The second reading, all models."""
    paper, standard = (way.runs(runs) for way in WAYS[2:])
    shown = paper | {f"{model}, standard": run for model, run in standard.items() if model != "dynamic"}
    panels = [
        Panel("roll", "φ [deg], right +", DEG),
        Panel("p", "p [deg/s], right +", DEG),
        Panel("sas_lateral", "added lateral [in]"),
    ]
    return histories(shown, panels, "Roll reversal, augmented", columns=1, height=2.0)
