# SPDX-License-Identifier: MIT OR Apache-2.0
"""Convergence: the verb that repeats a run with one discretisation after another and says what each costs and errs by."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from ...aircraft import Aircraft, Rotor, load_rotor
from ...arguments import checked
from ...condition import FlightCondition, condition_for
from ...errors import InputError, NumericalFailure
from ...inflow import InflowModel, inflow_model
from ...maneuver_files import SHIPPED, load_maneuver
from ...maneuvers import Maneuver
from ...progress import Reported, heard, reporting
from ...tunnel import stand_inflow
from ..case import Case
from .parameters import CONTROL_TOLERANCE, PARAMETERS, Parameter, applied, check_run, parameter, settings
from .runs import FlightRun, ModesRun, Outcome, Run, TrimRun, TunnelRun, warm
from .study import Study

__all__ = ["PARAMETERS", "Study", "converge"]


@reporting
@checked
def converge(
    aircraft: Aircraft | Rotor,
    run: str | Maneuver = "trim",
    *,
    vary: str,
    values: str | Sequence[Any],
    condition: FlightCondition | None = None,
    inflow: str | InflowModel = "time-marching",
    revolutions: float | None = None,
    integrator: str = "ida",
    stand: Mapping[str, Any] | None = None,
    progress: Reported = None,
) -> Study:
    """Repeat a run at several settings of one discretisation: error estimate and cost of each.

    run: `trim`, `modes` (frequencies of the blade), `tunnel` (the rotor on a stand), a manoeuvre, its shipped name or file.
    vary: a name of `PARAMETERS`. values: list, or text with commas, angles with units. stand: arguments of `wf.tunnel`.
    The rest as for `trim` and `fly`; trims on a free wake are iterated more tightly than by default. A setting that fails is
    left out and named in `failures`; NumericalFailure where fewer than two are left.
    """
    progress = heard(progress)
    chosen = parameter(vary)
    given = settings(chosen, values)
    repeated, base = _run(chosen, run, aircraft, condition, inflow, revolutions, integrator, stand)
    check_run(chosen, run if isinstance(run, str) else "flight", base.flown_inflow)
    cases = [applied(chosen, setting, base) for setting in given]
    for case in cases:
        repeated.check(case)

    warm()
    done: list[tuple[int, Outcome]] = []
    failures = []
    for k, (setting, case) in enumerate(zip(given, cases, strict=True)):
        progress(f"{chosen.name} {setting.label} ({k + 1} of {len(given)})")
        try:
            done.append((k, repeated.outcome(case, progress)))
        except NumericalFailure as failure:
            failures.append(f"{chosen.name} {setting.label}: {failure}")
            progress(f"failed: {failures[-1]}")
    if len(done) < 2:
        raise NumericalFailure("fewer than two settings finished: " + "; ".join(failures))
    air = "" if run == "modes" else f", {base.inflow.name} inflow"
    title = f"{aircraft.name}, {repeated.title(base)}{air}: {chosen.name} varied ({chosen.meaning})"
    return Study(
        title,
        chosen,
        tuple(given[k] for k, _ in done),
        tuple(outcome for _, outcome in done),
        repeated.quantities,
        tuple(failures),
    )


def _run(
    chosen: Parameter,
    run: str | Maneuver,
    aircraft: Aircraft | Rotor,
    condition: FlightCondition | None,
    inflow: str | InflowModel,
    revolutions: float | None,
    integrator: str,
    stand: Mapping[str, Any] | None,
) -> tuple[Run, Case]:
    """The run by its name, and what it starts from."""
    if run in ("trim", "modes", "tunnel") and revolutions is not None:
        raise InputError.of("revolutions", revolutions, f"{run} has none: choose a manoeuvre")
    if run == "tunnel":
        case = Case(load_rotor(aircraft), stand_inflow(inflow), stand=dict(stand or {}))
        return TunnelRun(chosen), replace(case, control_tolerance=CONTROL_TOLERANCE)
    if stand:
        raise InputError.of("stand", ", ".join(stand), "belongs to the run tunnel")
    if not isinstance(aircraft, Aircraft):
        raise InputError.of("aircraft", aircraft.name, "a rotor alone does not fly; allowed with it: tunnel")
    base = Case(aircraft, inflow_model(inflow), control_tolerance=CONTROL_TOLERANCE)
    if run == "modes":
        return ModesRun(aircraft.discretisation.n_modes), base
    base = replace(base, condition=condition_for(aircraft, condition))
    if run == "trim":
        return TrimRun(chosen), base
    maneuver = _maneuver(run) if isinstance(run, str) else run
    return FlightRun(chosen), replace(base, maneuver=maneuver, revolutions=revolutions, integrator=integrator)


def _maneuver(run: str) -> Maneuver:
    try:
        return load_maneuver(run)
    except InputError as reason:
        if run.endswith(".toml"):
            raise
        allowed = f"allowed: trim, modes, tunnel, {', '.join(SHIPPED)}, or the path of a manoeuvre file (.toml)"
        raise InputError.of("run", run, allowed) from reason
