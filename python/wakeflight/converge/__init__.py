# SPDX-License-Identifier: MIT OR Apache-2.0
"""Convergence: the verb that repeats a run with one discretisation after another and says what each costs and errs by."""

from __future__ import annotations

from typing import Any

from ..aircraft import Aircraft
from ..condition import FlightCondition, condition_for
from ..errors import InputError, NumericalFailure
from ..inflow import InflowModel, inflow_model
from ..maneuvers import SHIPPED, Maneuver, load_maneuver
from ..progress import Progress, Silent
from .parameters import PARAMETERS, Case, Parameter, applied, check_run, parameter, settings
from .runs import FlightRun, ModesRun, Outcome, Run, TrimRun, warm
from .study import Study

__all__ = ["PARAMETERS", "Study", "converge"]


def converge(
    aircraft: Aircraft,
    run: str | Maneuver = "trim",
    *,
    vary: str,
    values: Any,
    condition: FlightCondition | None = None,
    inflow: str | InflowModel = "time-marching",
    revolutions: float | None = None,
    integrator: str = "ida",
    progress: Progress | Silent | None = None,
) -> Study:
    """Repeat a run at several settings of one discretisation: error estimate and cost of each.

    run: `trim`, `modes` (frequencies of the blade), a manoeuvre, its shipped name or file. vary: a name of `PARAMETERS`.
    values: list, or text with commas, angles with units. The rest as for `trim` and `fly`; trims on a free wake are iterated
    more tightly than by default.
    A setting that fails is left out and named in `failures`; NumericalFailure where fewer than two are left, with the
    Study so far as `partial`, if any.
    """
    progress = progress or Silent()
    chosen = parameter(vary)
    given = settings(chosen, values)
    base = Case(aircraft, inflow_model(inflow))
    complete = condition_for(aircraft, condition)
    repeated = _run(chosen, run, base, complete, revolutions, integrator)
    check_run(chosen, run if isinstance(run, str) else "flight", base.inflow)
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
    title = f"{aircraft.name}, {repeated.title}{air}: {chosen.name} varied ({chosen.meaning})"
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
    base: Case,
    condition: FlightCondition,
    revolutions: float | None,
    integrator: str,
) -> Run:
    """The run by its name."""
    if isinstance(run, Maneuver):
        return FlightRun(chosen, condition, run, revolutions, integrator)
    if run in ("trim", "modes"):
        if revolutions is not None:
            raise InputError.of("revolutions", revolutions, f"{run} has none: choose a manoeuvre")
        return TrimRun(chosen, condition) if run == "trim" else ModesRun(base.aircraft.discretisation.n_modes)
    try:
        maneuver = load_maneuver(run)
    except InputError as reason:
        if run.endswith(".toml"):
            raise
        allowed = f"allowed: trim, modes, {', '.join(SHIPPED)}, or the path of a manoeuvre file (.toml)"
        raise InputError.of("run", run, allowed) from reason
    return FlightRun(chosen, condition, maneuver, revolutions, integrator)
