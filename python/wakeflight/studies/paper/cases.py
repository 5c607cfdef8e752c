# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flights the paper is judged by: what each is called and how it differs from the others.

Within a comparison nothing differs but what is compared: the inflow model, the convergence phase, or the
cap on the iterations of the relaxation wake.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING, Any

from ...inflow import DynamicInflow, RelaxationWake, TimeMarchingWake, trim_model
from ..case import Case

if TYPE_CHECKING:
    from ...aircraft import Aircraft
    from ...inflow import InflowModel
    from ...maneuvers import Maneuver

MANEUVERS = ("arrested-descent", "roll-reversal")
MODELS: dict[str, InflowModel] = {
    "dynamic": DynamicInflow(),
    "relaxation": RelaxationWake.preset("paper"),
    "time-marching": TimeMarchingWake.preset("paper"),
}
"""The paper's three, in the order of its legends; every option is the default."""

STANDARD: dict[str, InflowModel] = {
    "dynamic": DynamicInflow(),
    "relaxation": RelaxationWake.preset("standard"),
    "time-marching": TimeMarchingWake.preset("standard"),
}
"""The same with the standard wake of this program; dynamic inflow has no wake."""

AUGMENTED = "roll-reversal-augmented"
"""The second reading of the roll reversal: the same stick, the aircraft's stability augmented."""

CAPS = (5, 10, 20)
"""Most iterations of the relaxation wake in a revolution; the flights of the figures use the default."""
UNTIL_CONVERGED = 400
"""A cap so high that it is never what ends the iteration of a revolution that converges at all."""


@dataclass(frozen=True)
class Planned:
    """A flight to be flown: `name`, also that of its file; manoeuvre, inflow model, and how it differs from the paper's settings.

    cost: rough, for the order of work. condition: a named one of the aircraft file. given: values of a flight condition.
    modes: of a blade, where not the aircraft's own. revolutions: where not the manoeuvre's.
    """

    name: str
    maneuver: str | Maneuver
    inflow: InflowModel
    cost: float = 1.0
    condition: str | None = None
    given: tuple[tuple[str, str], ...] = ()
    modes: int | None = None
    revolutions: float | None = None

    def case(self) -> Case:
        """What is run, everything loaded."""
        from ...condition import condition_for
        from ...maneuver_files import SHIPPED, load_maneuver

        aircraft = _aircraft(self.modes)
        given: dict[str, Any] = dict(self.given)
        condition = condition_for(aircraft, named=self.condition, **given)
        maneuver: Any = load_maneuver(self.maneuver) if self.maneuver in SHIPPED else self.maneuver
        return Case(
            aircraft,
            self.inflow,
            condition,
            maneuver,
            trim_inflow=_trim_inflow(self.inflow),
            revolutions=self.revolutions,
        )


@cache
def _aircraft(modes: int | None) -> Aircraft:
    """The UH-60A, one object for all flights that have it, so that they can share a trim."""
    from ...aircraft import load_aircraft

    aircraft = load_aircraft("uh60a")
    return aircraft if modes is None else aircraft.discretised(n_modes=modes)


def _trim_inflow(model: InflowModel) -> InflowModel:
    """Model of the trim; the cap in flight is no part of it."""
    found = trim_model(model)
    if "max_loops_response" in found.as_attributes():
        return replace(found.relaxed, max_loops_response=RelaxationWake.preset("paper").max_loops_response)
    return found


def base_cases() -> list[Planned]:
    """Both manoeuvres with the three models at the paper's settings."""
    length = {"arrested-descent": 12, "roll-reversal": 36}
    return [
        Planned(f"{maneuver}/{name}", maneuver, model, length[maneuver] * (1 if name == "dynamic" else 2))
        for maneuver in MANEUVERS
        for name, model in MODELS.items()
    ]


def question_cases() -> list[Planned]:
    """The convergence phase left out, and the caps of the relaxation wake, in both manoeuvres."""
    cases = []
    for maneuver, length in zip(MANEUVERS, (12, 36), strict=True):
        cases.append(
            Planned(
                f"{maneuver}/no-convergence",
                maneuver,
                TimeMarchingWake.preset("paper", convergence_revolutions=0),
                2 * length,
            )
        )
        for cap in (*CAPS, UNTIL_CONVERGED):
            if cap != RelaxationWake.preset("paper").max_loops_response:
                cases.append(
                    Planned(
                        cap_name(maneuver, cap),
                        maneuver,
                        RelaxationWake.preset("paper", max_loops_response=cap),
                        2 * length + cap,
                    )
                )
    return cases


def reading_cases() -> list[Planned]:
    """The roll reversal in its second reading, and both readings with the standard wake."""
    wanted = {AUGMENTED: (AUGMENTED, MODELS)}
    for reading in ("roll-reversal", AUGMENTED):
        wanted[f"{reading}-standard"] = (
            reading,
            {name: model for name, model in STANDARD.items() if name != "dynamic"},
        )
    return [
        Planned(
            f"{folder}/{name}", maneuver, model, 36 * (1 if name == "dynamic" else 6 if "standard" in folder else 2)
        )
        for folder, (maneuver, models) in wanted.items()
        for name, model in models.items()
    ]


def cap_name(maneuver: str, cap: int) -> str:
    """Name of the relaxation flight with this cap; the default cap is the flight of the figures."""
    if cap == RelaxationWake.preset("paper").max_loops_response:
        return f"{maneuver}/relaxation"
    return f"{maneuver}/relaxation-{'converged' if cap == UNTIL_CONVERGED else f'cap-{cap}'}"
