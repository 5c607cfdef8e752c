# SPDX-License-Identifier: MIT OR Apache-2.0
"""The command line: names in, everything checked before anything starts, one line for whatever is wrong.

Exit codes: 0 finished, 2 bad input, 3 numerical failure (what was computed is kept).
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .errors import InputError, NumericalFailure, WakeflightError, one_line
from .regime import described

if TYPE_CHECKING:
    from .aircraft import Aircraft
    from .condition import FlightCondition
    from .inflow import InflowModel
    from .maneuvers import Maneuver
    from .progress import Progress
    from .tunnel.model import StandInflow

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Helicopters in unsteady manoeuvres with a time-accurate free vortex wake.",
)

ManeuverName = Annotated[
    str, typer.Argument(metavar="MANEUVER", help="arrested-descent, roll-reversal, or a TOML file")
]
AircraftName = Annotated[str, typer.Option("--aircraft", metavar="NAME|FILE", help="uh60a, bo105, or an aircraft file")]
LoadingName = Annotated[str | None, typer.Option("--loading", help="named mass and c.g. of the aircraft file")]
ConditionName = Annotated[str | None, typer.Option("--condition", help="named condition of the aircraft file")]
InflowName = Annotated[str, typer.Option("--inflow", help="time-marching, relaxation, dynamic")]
Speed = Annotated[str | None, typer.Option("--speed", help='true airspeed, "80 kt"')]
FlightPath = Annotated[str | None, typer.Option("--flight-path", help='climb +, "-6 deg"')]
Altitude = Annotated[str | None, typer.Option("--altitude", help='standard atmosphere, "5250 ft"')]
Weight = Annotated[str | None, typer.Option("--weight", help='"16000 lbf"; lb and kg are masses')]
Sideslip = Annotated[str | None, typer.Option("--sideslip", help='wind from the right +, "5 deg"')]
TurnRate = Annotated[str | None, typer.Option("--turn-rate", help='to the right +, "3 deg/s"')]
Bank = Annotated[str | None, typer.Option("--bank", help='to the right +, "10 deg"')]
LoadFactor = Annotated[float | None, typer.Option("--load-factor", help="of a turn whose rate is found, 1.5")]
Turn = Annotated[str | None, typer.Option("--turn", help="direction of that turn: right, left")]
Power = Annotated[
    str | None, typer.Option("--power", help='of the engines, path or speed found; "0 hp" is autorotation')
]
Collective = Annotated[
    str | None, typer.Option("--collective", help='blade pitch given, path or speed found, "14 deg"')
]
Free = Annotated[
    str | None, typer.Option("--free", help="what is found for --power or --collective: flight_path, speed")
]
Revolutions = Annotated[float | None, typer.Option("--revolutions", help="revolutions to fly; the manoeuvre's own")]
AzimuthStep = Annotated[str | None, typer.Option("--azimuth-step", help='divides 360 deg / blades, "10 deg"')]
WakeTurns = Annotated[float | None, typer.Option("--wake-turns", help=f"turns of free wake; {described('turns')}")]
WakeScheme = Annotated[str | None, typer.Option("--wake-scheme", help="bdf2, pc2b, pcc")]
Integrator = Annotated[str, typer.Option("--integrator", help="ida, fixed")]
Blades = Annotated[str | None, typer.Option("--blades", help="rigid, flexible; the aircraft's own")]
Threads = Annotated[int | None, typer.Option("--threads", help="threads of the physics core")]
Out = Annotated[Path | None, typer.Option("--out", help="folder for results")]


@dataclass(frozen=True)
class _Request:
    """What was asked for, checked."""

    aircraft: Aircraft
    condition: FlightCondition
    inflow: InflowModel
    out: Path
    maneuver: Maneuver | None = None


@app.command()
def fly(
    maneuver: ManeuverName,
    inflow: InflowName = "time-marching",
    aircraft: AircraftName = "uh60a",
    loading: LoadingName = None,
    condition: ConditionName = None,
    speed: Speed = None,
    flight_path: FlightPath = None,
    altitude: Altitude = None,
    weight: Weight = None,
    sideslip: Sideslip = None,
    turn_rate: TurnRate = None,
    bank: Bank = None,
    revolutions: Revolutions = None,
    azimuth_step: AzimuthStep = None,
    wake_turns: WakeTurns = None,
    wake_scheme: WakeScheme = None,
    integrator: Integrator = "ida",
    blades: Blades = None,
    threads: Threads = None,
    out: Out = None,
) -> None:
    """Trim, fly a manoeuvre, write run.nc, figures and report.html."""
    given = _given(speed, flight_path, altitude, weight, sideslip, turn_rate, bank)
    wake = {"azimuth_step": azimuth_step, "turns": wake_turns, "scheme": wake_scheme}
    _check_flight(revolutions, integrator)
    request = _request(aircraft, loading, condition, given, inflow, wake, threads, maneuver, out, blades=blades)
    from .progress import Progress

    with Progress() as progress:
        _fly_once(request, revolutions, integrator, request.out, progress)


@app.command()
def compare(
    maneuver: ManeuverName,
    aircraft: AircraftName = "uh60a",
    loading: LoadingName = None,
    condition: ConditionName = None,
    speed: Speed = None,
    flight_path: FlightPath = None,
    altitude: Altitude = None,
    weight: Weight = None,
    revolutions: Revolutions = None,
    azimuth_step: AzimuthStep = None,
    wake_turns: WakeTurns = None,
    wake_scheme: WakeScheme = None,
    integrator: Integrator = "ida",
    threads: Threads = None,
    out: Out = None,
) -> None:
    """Fly the same manoeuvre with all three inflow models and state the cost of each."""
    from .inflow import MODELS
    from .progress import Progress

    given = _given(speed, flight_path, altitude, weight, None, None, None)
    wake = {"azimuth_step": azimuth_step, "turns": wake_turns, "scheme": wake_scheme}
    _check_flight(revolutions, integrator)
    requests = [
        _request(aircraft, loading, condition, given, name, wake, threads, maneuver, out, lenient=True)
        for name in MODELS
    ]
    runs: dict[str, Any] = {}
    failures, lines = [], [f"{'inflow':<15}{'trim s':>9}{'flight s':>10}{'total s':>9}"]
    with Progress() as progress:
        for request in requests:
            name = request.inflow.name
            try:
                flight = _fly_once(request, revolutions, integrator, request.out / name, progress)
            except NumericalFailure as failure:
                failures.append(f"{name}: {failure}")
                continue
            runs[name] = flight.data
            attributes = flight.data.attrs
            in_flight = attributes.get("seconds_wake", 0.0) + attributes.get("seconds_dynamics", 0.0)
            lines.append(
                f"{name:<15}{attributes.get('seconds_trim', 0.0):>9.1f}{in_flight:>10.1f}"
                f"{attributes.get('seconds_total', 0.0):>9.1f}"
            )
    print("\n".join(lines))
    if len(runs) > 1:
        from . import report as reports

        print(f"wrote {reports.write(runs, _folder(requests[0].out))}, the models side by side")
    if failures:
        raise NumericalFailure("; ".join(failures))


@app.command()
def trim(
    inflow: InflowName = "time-marching",
    aircraft: AircraftName = "uh60a",
    loading: LoadingName = None,
    condition: ConditionName = None,
    speed: Speed = None,
    flight_path: FlightPath = None,
    altitude: Altitude = None,
    weight: Weight = None,
    sideslip: Sideslip = None,
    turn_rate: TurnRate = None,
    bank: Bank = None,
    load_factor: LoadFactor = None,
    turn: Turn = None,
    power: Power = None,
    collective: Collective = None,
    free: Free = None,
    azimuth_step: AzimuthStep = None,
    wake_turns: WakeTurns = None,
    wake_scheme: WakeScheme = None,
    blades: Blades = None,
    threads: Threads = None,
    out: Out = None,
) -> None:
    """Trim the aircraft, print a table, write trim.nc."""
    given = _given(speed, flight_path, altitude, weight, sideslip, turn_rate, bank)
    given |= {name: value for name, value in (("load_factor", load_factor), ("turn", turn)) if value is not None}
    asked = {"power": power, "collective": collective, "free": free}
    wake = {"azimuth_step": azimuth_step, "turns": wake_turns, "scheme": wake_scheme}
    folder = out or Path("runs/trim")
    request = _request(aircraft, loading, condition, given, inflow, wake, threads, None, folder, blades=blades)
    from .progress import Progress
    from .trim import trim as solve

    solve = _keeping(solve, lambda found: _save_trim(found, request.out))
    with Progress() as progress:
        start = solve(request.aircraft, request.condition, inflow=request.inflow, progress=progress, **asked)
    print(start.table())
    _save_trim(start, request.out)


@app.command()
def modes(
    aircraft: AircraftName = "uh60a",
    n_modes: Annotated[int | None, typer.Option("--modes", help="number of modes; the aircraft's own")] = None,
    out: Out = None,
) -> None:
    """Print blade frequencies and what each mode is made of, compare with references, draw shapes and fan plot."""
    from .aircraft import load_aircraft

    loaded = load_aircraft(aircraft)
    if n_modes is not None and not 1 <= n_modes <= 12:
        raise InputError.of("--modes", n_modes, "must lie between 1 and 12")
    folder = _writable(out or Path("runs/modes"))
    from .modes import blade_modes, fan, fan_reference, reference_table
    from .plotting import modes as drawing
    from .plotting import style

    found = blade_modes(loaded, n_modes=n_modes)
    print(found.table())
    if n_modes is None:
        # as many as the references list
        compared = reference_table(loaded, blade_modes(loaded, n_modes=7))
        if compared is not None:
            print(compared)
    radius = float(loaded.rotor.radius)
    shapes = found.shapes
    figure = drawing.shapes(
        found.radius / radius, shapes["flap"], shapes["lead"], shapes["twist"], found.frequencies, radius, found.labels
    )
    style.save(figure, _folder(folder) / "modes.png")
    style.save(drawing.fan_plot(*fan(loaded, n_modes or 7), fan_reference(loaded)), folder / "fan-plot.png")
    print(f"wrote {folder / 'modes.png'} and {folder / 'fan-plot.png'}")


@app.command()
def report(
    run: Annotated[Path, typer.Argument(metavar="RUN.nc", help="result of a finished run")],
    out: Out = None,
) -> None:
    """Rebuild figures and report of a finished run, beside it or in --out."""
    if not run.is_file():
        raise InputError.of("RUN.nc", str(run), "no such file; allowed: the run.nc of a finished run")
    folder = _folder(_writable(out or run.parent))
    from . import report as reports
    from . import results

    reports.write(results.load(run), folder)
    print(f"wrote {folder / 'report.html'}")


@app.command()
def converge(
    run: Annotated[str, typer.Argument(metavar="RUN", help="trim, modes, tunnel, or a manoeuvre as for fly")],
    vary: Annotated[
        str, typer.Option("--vary", metavar="NAME", help="azimuth-step, wake-turns, modes, tolerance, ...")
    ],
    values: Annotated[str, typer.Option("--values", metavar="LIST", help='"15 deg, 10 deg, 5 deg", "5, 8, 10"')],
    inflow: InflowName = "time-marching",
    aircraft: AircraftName = "uh60a",
    loading: LoadingName = None,
    condition: ConditionName = None,
    speed: Speed = None,
    flight_path: FlightPath = None,
    altitude: Altitude = None,
    weight: Weight = None,
    sideslip: Sideslip = None,
    turn_rate: TurnRate = None,
    bank: Bank = None,
    rotor: Annotated[str | None, typer.Option("--rotor", metavar="FILE", help="tunnel: a rotor file")] = None,
    collective: Annotated[str | None, typer.Option("--collective", help="tunnel: as for tunnel")] = None,
    shaft_angle: Annotated[str | None, typer.Option("--shaft-angle", help="tunnel: as for tunnel")] = None,
    climb: Annotated[str | None, typer.Option("--climb", help="tunnel: as for tunnel")] = None,
    thrust: Annotated[str | None, typer.Option("--thrust", help="tunnel: as for tunnel")] = None,
    revolutions: Revolutions = None,
    azimuth_step: AzimuthStep = None,
    wake_turns: WakeTurns = None,
    wake_scheme: WakeScheme = None,
    integrator: Integrator = "ida",
    threads: Threads = None,
    out: Out = None,
) -> None:
    """Repeat a run at several settings of one discretisation; print error estimate and cost of each."""
    given = _given(speed, flight_path, altitude, weight, sideslip, turn_rate, bank)
    wake = {"azimuth_step": azimuth_step, "turns": wake_turns, "scheme": wake_scheme}
    stand = {"collective": collective, "shaft_angle": shaft_angle, "climb": climb, "thrust": thrust}
    stand = {name: value for name, value in stand.items() if value is not None}
    _check_flight(revolutions, integrator)
    folder = out or Path("runs/converge")
    from .converge import converge as study_of
    from .plotting import convergence, style
    from .progress import Progress

    base: dict[str, Any]
    if run == "tunnel":
        from .aircraft import load_rotor
        from .tunnel import stand_inflow

        _set_threads(threads)
        known = {name: given.pop(name) for name in ("speed", "altitude") if name in given}
        if given:
            raise InputError.of(next(iter(given)), next(iter(given.values())), "not an option of a rotor on a stand")
        stand |= known
        flown: Any = load_rotor(rotor or aircraft)
        base = {"inflow": _configured(stand_inflow(inflow), wake, False), "stand": stand}
        _writable(folder)
    else:
        if stand or rotor:
            raise InputError.of("run", run, f"{', '.join(stand) or 'rotor'} belongs to the run tunnel")
        request = _request(aircraft, loading, condition, given, inflow, wake, threads, None, folder)
        flown, base = request.aircraft, {"condition": request.condition, "inflow": request.inflow}
    with Progress() as progress:
        study = study_of(
            flown,
            run,
            vary=vary,
            values=values,
            revolutions=revolutions,
            integrator=integrator,
            progress=progress,
            **base,
        )
    print(study.table())
    study.save(_folder(folder))
    style.save(convergence.figure(study.data), folder / "converge.png")
    print(f"wrote converge.nc, .csv, .md and .png in {folder}")
    if study.failures:
        raise NumericalFailure("; ".join(study.failures))


@app.command()
def validate(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[CASE]...", help="H01, a folder's name, a group, exact, measured")
    ] = None,
    cases: Annotated[Path | None, typer.Option("--cases", help="folder of cases; validation/ of the checkout")] = None,
    fast: Annotated[bool, typer.Option("--fast", help="leave out cases marked slow")] = False,
    threads: Threads = None,
    out: Out = None,
) -> None:
    """Run reference cases, write a page with figure and score for each; exit code 3 where the program is wrong."""
    from . import validate as checking
    from .validate import page

    _set_threads(threads)
    chosen = checking.select(checking.cases(checking.cases_folder(cases)), names or [])
    if fast:
        chosen = [case for case in chosen if not case.slow]
    folder = _folder(_writable(out or Path("runs/validation")))
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


@app.command()
def tunnel(
    aircraft: AircraftName = "uh60a",
    rotor: Annotated[
        str | None, typer.Option("--rotor", metavar="FILE", help="a rotor file, in place of --aircraft")
    ] = None,
    collective: Annotated[
        str | None, typer.Option("--collective", help='"8 deg"; else a load, else the weight')
    ] = None,
    speed: Annotated[str, typer.Option("--speed", help='wind from the front, "80 kt"')] = "0 kt",
    shaft_angle: Annotated[
        str, typer.Option("--shaft-angle", help="tilt of the shaft, aft + (disk met from below)")
    ] = "0 deg",
    climb: Annotated[str, typer.Option("--climb", help='up the shaft, descent -, "-5 m/s"')] = "0 m/s",
    inflow: Annotated[
        str, typer.Option("--inflow", help="time-marching, relaxation, dynamic, annular (hover, axial climb)")
    ] = "time-marching",
    collective_at: Annotated[
        str, typer.Option("--collective-at", help='where the collective is meant: root, "0.75 R"')
    ] = "root",
    lateral_cyclic: Annotated[str | None, typer.Option("--lateral-cyclic", help="theta_1c")] = None,
    longitudinal_cyclic: Annotated[str | None, typer.Option("--longitudinal-cyclic", help="theta_1s")] = None,
    higher_harmonics: Annotated[
        list[str] | None, typer.Option("--higher-harmonic", help='"3, 0.8 deg, 300 deg": order, amplitude, phase')
    ] = None,
    thrust: Annotated[str | None, typer.Option("--thrust", help='find the collective for it, "3300 N"')] = None,
    ct: Annotated[float | None, typer.Option("--ct", help="the same as a coefficient")] = None,
    torque: Annotated[
        str | None, typer.Option("--torque", help="find the collective for it; zero: autorotation")
    ] = None,
    flapping: Annotated[
        str | None, typer.Option("--flapping", help='find both cyclics: zero, "1.5 deg, -0.6 deg"')
    ] = None,
    hub_roll: Annotated[
        str | None, typer.Option("--hub-roll", help="find both cyclics for it, right side down +")
    ] = None,
    hub_pitch: Annotated[str | None, typer.Option("--hub-pitch", help="find both cyclics for it, nose up +")] = None,
    omega: Annotated[str | None, typer.Option("--omega", help='rotor speed, "1250 rpm"')] = None,
    altitude: Annotated[str, typer.Option("--altitude", help="standard atmosphere")] = "0 m",
    density: Annotated[str | None, typer.Option("--density", help='"1.19 kg/m3"')] = None,
    speed_of_sound: Annotated[str | None, typer.Option("--speed-of-sound", help='"342 m/s"')] = None,
    blades: Annotated[str | None, typer.Option("--blades", help="rigid, flexible; the file's own")] = None,
    blade_model: Annotated[
        str, typer.Option("--blade-model", help="lifting-line, second-order, weissinger")
    ] = "lifting-line",
    revolutions: Annotated[int | None, typer.Option("--revolutions", help="revolutions of the marching wake")] = None,
    averaged: Annotated[int | None, typer.Option("--averaged", help="of them, the last ones averaged")] = None,
    then: Annotated[
        list[str] | None, typer.Option("--then", help='then move the collective: "0.035 s, 12 deg", time and angle')
    ] = None,
    duration: Annotated[str | None, typer.Option("--duration", help='how long to follow that, "2 s"')] = None,
    azimuth_step: AzimuthStep = None,
    wake_turns: WakeTurns = None,
    wake_scheme: WakeScheme = None,
    threads: Threads = None,
    out: Out = None,
) -> None:
    """Put an isolated rotor on a stand, print a table, write tunnel.nc and figures."""
    _set_threads(threads)
    folder = _writable(out or Path("runs/tunnel"))
    from .plotting import tunnel as drawing
    from .progress import Progress
    from .results import save
    from .tunnel import stand_inflow
    from .tunnel import tunnel as solve

    solve = _keeping(solve, lambda stand: stand.save(_folder(folder) / "tunnel.nc"))
    wake = {"azimuth_step": azimuth_step, "turns": wake_turns, "scheme": wake_scheme}
    model = _configured(stand_inflow(inflow), wake, False)
    pair = [each.strip() for each in flapping.split(",")] if flapping and "," in flapping else flapping
    if bool(then) != (duration is not None):
        raise InputError.of("--then, --duration", then or duration, "one needs the other")
    moved = [tuple(part.strip() for part in each.split(",")) for each in then or []]
    with Progress() as progress:
        result = solve(
            rotor or aircraft,
            collective,
            speed,
            shaft_angle,
            model,
            climb=climb,
            omega=omega,
            collective_at=collective_at,
            lateral_cyclic=lateral_cyclic,
            longitudinal_cyclic=longitudinal_cyclic,
            higher_harmonics=[_harmonic(each) for each in higher_harmonics or []],
            thrust=thrust,
            ct=ct,
            torque=torque,
            flapping=pair,
            hub_roll=hub_roll,
            hub_pitch=hub_pitch,
            altitude=altitude,
            density=density,
            speed_of_sound=speed_of_sound,
            blades=blades,
            blade_model=blade_model,
            revolutions=revolutions,
            averaged=averaged,
            progress=progress,
        )
        print(result.table())
        result.save(_folder(folder) / "tunnel.nc")
        written = [folder / "tunnel.nc", *drawing.write(result.data, folder)]
        if duration is not None:
            followed = _keeping(result.transient, lambda data: save(data, folder / "transient.nc"))
            data = followed(moved, duration, progress)
            written += [save(data, folder / "transient.nc"), drawing.write_transient(data, folder)]
    print(f"wrote {folder / 'tunnel.nc'}, {', '.join(each.name for each in written[1:])}")


def _harmonic(text: str) -> dict[str, Any]:
    """Order, amplitude and phase of a higher-harmonic pitch from "3, 0.8 deg, 300 deg"."""
    parts = [each.strip() for each in text.split(",")]
    if len(parts) != 3 or not parts[0].isdigit():
        raise InputError.of(
            "--higher-harmonic", text, 'must be order, amplitude, phase, for example "3, 0.8 deg, 300 deg"'
        )
    return {"order": int(parts[0]), "amplitude": parts[1], "phase": parts[2]}


@app.command()
def paper(
    redraw: Annotated[bool, typer.Option("--redraw", help="draw anew from the flights a former call left")] = False,
    studies: Annotated[bool, typer.Option("--studies", help="also fly the studies beyond the paper")] = False,
    jobs: Annotated[int | None, typer.Option("--jobs", help="flights at a time; as many as cores")] = None,
    out: Out = None,
) -> None:
    """Fly everything Ribera and Celi reported in 2004, judge every statement, write figures and report.html."""
    if jobs is not None and not 1 <= jobs <= 64:
        raise InputError.of("--jobs", jobs, "must lie between 1 and 64")
    folder = _writable(out or Path("runs/paper"))
    from .paper import reproduce
    from .progress import Progress

    with Progress() as progress:
        path = reproduce(_folder(folder), redraw, jobs, progress, studies)
    print(f"wrote {path}")


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit; every expected error is one line on standard error."""
    try:
        code = app(args=arguments, prog_name="wakeflight", standalone_mode=False) or 0
    except NumericalFailure as failure:
        code = _complain(f"numerical failure: {failure}", failure.exit_code)
    except WakeflightError as reason:
        code = _complain(str(reason), reason.exit_code)
    except KeyboardInterrupt:
        code = _complain("interrupted", 130)
    except Exception as reason:  # usage errors of the parser, which carry their own message
        if not hasattr(reason, "format_message"):
            raise
        message = reason.format_message()
        if type(reason).__name__.startswith("NoArgsIsHelp"):  # the message is the help text
            print(message, file=sys.stderr)
            code = 2
        else:
            code = _complain(message, 2)
    sys.exit(code if isinstance(code, int) else 0)


def _complain(message: str, code: int) -> int:
    print(f"wakeflight: {one_line(message)}", file=sys.stderr)
    return code


def _given(
    speed: str | None,
    flight_path: str | None,
    altitude: str | None,
    weight: str | None,
    sideslip: str | None,
    turn_rate: str | None,
    bank: str | None,
) -> dict[str, Any]:
    """Arguments of a FlightCondition, those that were given."""
    names = {"speed": speed, "flight_path": flight_path, "altitude": altitude, "weight": weight}
    names |= {"sideslip": sideslip, "turn_rate": turn_rate, "bank": bank}
    return {name: value for name, value in names.items() if value is not None}


def _check_flight(revolutions: float | None, integrator: str) -> None:
    if revolutions is not None and not 0.0 < revolutions <= 10000.0:
        raise InputError.of("--revolutions", revolutions, "must lie above 0 and at most 10000")
    if integrator not in ("ida", "fixed"):
        raise InputError.of("--integrator", integrator, "allowed: ida, fixed")


def _request(
    aircraft: str,
    loading: str | None,
    condition: str | None,
    given: dict[str, Any],
    inflow: str,
    wake: dict[str, Any],
    threads: int | None,
    maneuver: str | None,
    out: Path | None,
    lenient: bool = False,
    blades: str | None = None,
) -> _Request:
    """Everything that was typed, read and checked; nothing is started.

    lenient: leave out wake options the model does not have instead of refusing them.
    """
    from .aircraft import load_aircraft
    from .condition import condition_for
    from .inflow import inflow_model
    from .maneuvers import load_maneuver
    from .model import flight_regime

    _set_threads(threads)
    flown = load_maneuver(maneuver) if maneuver is not None else None
    model = _configured(inflow_model(inflow), wake, lenient)
    if blades not in (None, "rigid", "flexible"):
        raise InputError.of("--blades", blades, "allowed: rigid, flexible")
    loaded = load_aircraft(aircraft, loading)
    if blades == "rigid":
        loaded = loaded.with_rigid_blades()
    elif blades == "flexible" and not loaded.flexible:
        raise InputError.of("--blades", blades, f"the blades of {loaded.name} are rigid in its file")
    complete = condition_for(loaded, named=condition, **given)
    loaded.core_data(complete)
    model.step(loaded)
    if hasattr(model, "core_options"):
        model.resolved(flight_regime(loaded, complete)).core_options(loaded)
    if flown is not None:
        flown = flown.for_aircraft(loaded.stick_travel_in, float(loaded.rotor.omega))
        flown.check_span(loaded.stick_travel_in)
    folder = _writable(out if out is not None else Path("runs") / (flown.name if flown is not None else "run"))
    return _Request(loaded, complete, model, folder, flown)


def _configured(model: StandInflow, wake: dict[str, Any], lenient: bool) -> Any:
    """`model` with the wake options that were typed."""
    known = {field.name for field in fields(model)}
    options = {name: value for name, value in wake.items() if value is not None}
    names = {"azimuth_step": "--azimuth-step", "turns": "--wake-turns", "scheme": "--wake-scheme"}
    for name in [name for name in options if name not in known]:
        if not lenient:
            raise InputError.of(names[name], options[name], f"not an option of --inflow {model.name}")
        del options[name]
    return replace(model, **options)


def _set_threads(threads: int | None) -> None:
    """Pass --threads, or check WAKEFLIGHT_THREADS, which the physics core reads when it is loaded."""
    if threads is not None:
        if not 1 <= threads <= 1024:
            raise InputError.of("--threads", threads, "must lie between 1 and 1024")
        os.environ["WAKEFLIGHT_THREADS"] = str(threads)
    text = os.environ.get("WAKEFLIGHT_THREADS", "1")
    if not (text.isascii() and text.isdigit() and 1 <= int(text) <= 1024):
        raise InputError.of("WAKEFLIGHT_THREADS", text, "must be a whole number between 1 and 1024")


def _writable(folder: Path) -> Path:
    """Refuse a folder for results that cannot be made."""
    existing = next(each for each in (folder, *folder.absolute().parents) if each.exists())
    if not existing.is_dir() or not os.access(existing, os.W_OK):
        raise InputError.of("--out", str(folder), f"must be a folder that can be written to; {existing} is not")
    return folder


def _folder(folder: Path) -> Path:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as reason:
        raise InputError.of("--out", str(folder), f"cannot be made: {reason.strerror}") from reason
    return folder


def _fly_once(request: _Request, revolutions: float | None, integrator: str, out: Path, progress: Progress) -> Any:
    """Trim and fly one request, save whatever was computed, raise where the flight did not finish."""
    from .flight import fly as solve
    from .inflow import trim_model
    from .trim import trim as trim_solve

    start = trim_solve(request.aircraft, request.condition, inflow=trim_model(request.inflow), progress=progress)
    try:
        flight = solve(
            start,
            request.maneuver,
            inflow=request.inflow,
            revolutions=revolutions,
            integrator=integrator,
            progress=progress,
        )
    except NumericalFailure as failure:
        if failure.partial is not None:
            _save(failure.partial, out, progress)
        raise
    _save(flight, out, progress)
    if not flight.finished:
        raise NumericalFailure(flight.failure or "the flight did not finish", partial=flight)
    progress(_pace(flight.data))
    return flight


def _pace(data: Any) -> str:
    """Time flown against the time it took, in words."""
    wake, dynamics = (float(data.attrs[f"seconds_{part}"]) for part in ("wake", "dynamics"))
    flown, taken = float(data.time[-1]), wake + dynamics
    return (
        f"flew {flown:.2f} s in {taken:.3g} s, {flown / taken:.3g} times as fast as time: wake {wake:.3g} s, flight dynamics "
        f"{dynamics:.3g} s by {data.attrs['integration_method']}, {data.attrs['blades']} blades"
    )


def _keeping(verb: Callable[..., Any], save: Callable[[Any], Any]) -> Callable[..., Any]:
    """`verb`, with what it had computed saved where it ends in a numerical failure."""

    def kept(*arguments: Any, **named: Any) -> Any:
        try:
            return verb(*arguments, **named)
        except NumericalFailure as failure:
            if failure.partial is not None:
                save(failure.partial)
            raise

    return kept


def _save_trim(start: Any, out: Path) -> None:
    """Write trim.nc."""
    path = _folder(out) / "trim.nc"
    start.to_dataset().to_netcdf(path, engine="h5netcdf")
    print(f"wrote {path}")


def _save(flight: Any, out: Path, progress: Progress) -> None:
    """Write run.nc, then figures and report: the numbers are safe before anything is drawn."""
    folder = _folder(out)
    flight.save(folder / "run.nc")
    from . import report as reports

    reports.write(flight.data, folder)
    progress(f"wrote {folder / 'run.nc'}, figures and {folder / 'report.html'}")
