"""Arguments: quantities, conditions, options, manoeuvres, public functions, command lines; names in reports."""

import contextlib
import functools
import io
import json
import os
import string
from pathlib import Path

import mutations
import numpy as np
from bench import JUNK, Absurd, brief, finite, told

import wakeflight as wf
from wakeflight import cli, results
from wakeflight.text import slug
from wakeflight.units import quantity

SPEEDS = (
    "80 kt",
    "0 kt",
    "-5 kt",
    "500 kt",
    "501 kt",
    "1e308 kt",
    "nan kt",
    "80",
    "80 kg",
    "80kt",
    " 80  kt ",
    "8٠ kt",
    "80 mph",
)
ANGLES = (
    "-6 deg",
    "0 deg",
    "90 deg",
    "91 deg",
    "2 rev",
    "5 kt",
    "0.1 rad",
    "6",
    "\u22126 deg",
    "1e-320 deg",
    "180 deg",
)
HEIGHTS = ("5250 ft", "0 m", "-501 m", "11000 m", "11001 m", "1e5 km", "nan m", "5 deg", "-1 mm")
WEIGHTS = ("16000 lbf", "7000 kg", "0 lbf", "-1 lbf", "1e300 N", "10 kg", "100000 kg", "1 N", "70 kN", "5 m")
RATES = ("3 deg/s", "0 deg/s", "-90 deg/s", "91 deg/s", "1 rpm", "nan deg/s", "5 deg", "1e-300 deg/s")
CONDITION = {
    "speed": SPEEDS,
    "flight_path": ANGLES,
    "altitude": HEIGHTS,
    "weight": WEIGHTS,
    "sideslip": ANGLES,
    "turn_rate": RATES,
    "bank": ANGLES,
    "heading": ("free", "aligned", "x"),
    "load_factor": (1.0, 1.5, 0.0, 6, float("nan")),
    "turn": ("left", "right", "x"),
}


def units(bench, rng):
    """A number with a product of units, right as often as not, then perhaps changed."""
    names = (
        "m",
        "ft",
        "s",
        "kt",
        "deg",
        "rad",
        "kg",
        "lb",
        "N",
        "lbf",
        "W",
        "hp",
        "min",
        "slug",
        "mile",
        "µm",
        "yd",
        "km",
    )
    text = "".join(
        rng.choice(names) + rng.choice(["", "", "", "^2", "**2", "3", "^-1", "-2"]) + rng.choice([" ", "/", " * ", "·"])
        for _ in range(rng.choice([1, 1, 1, 2, 3, 6]))
    ).rstrip(" /*·")
    si = rng.choice(["m/s", "rad", "m", "kg", "rad/s", "s", "N m/rad", "1", "W"])
    text = rng.choice([text, text, si, si])
    if rng.random() < 0.5:
        tokens = (*mutations.UNITS, *"*/^() .-+0123456789eE", "**", "^2", "per", "1", "\n", "٣", "\x00", "kilo", "e308")
        for _ in range(rng.choice([1, 1, 2, 5, 3000])):
            at = rng.randrange(len(text) + 1)
            text = text[:at] + rng.choice(tokens) + text[at + rng.choice([0, 1]) :]
    text = rng.choice(["80 ", "-6 ", "1e308 ", "0.5", "+.5 ", "1e-320 ", "nan ", ""]) + text
    return f"quantity({text!r:.80}, {si})", lambda: finite(quantity(text, si, "speed"))


def junk_in(rng, pools, share=0.3):
    """Some arguments, each of its pool or anything at all."""
    names = rng.sample(list(pools), rng.randint(1, min(4, len(pools))))
    return {name: rng.choice(JUNK) if rng.random() < share else rng.choice(pools[name]) for name in names}


def condition(bench, rng):
    given = junk_in(rng, CONDITION)

    def read():
        made = wf.FlightCondition(**given)
        whole = made.completed(bench.uh60a)
        finite(*(value for value in whole.as_attributes().values() if isinstance(value, float)))
        bench.uh60a.core_data(whole)

    return f"FlightCondition({told(given)})", read


def wake(bench, rng):
    kind = rng.choice([wf.TimeMarchingWake, wf.RelaxationWake, wf.DynamicInflow, wf.AnnularInflow])
    from wakeflight.options import options_of

    right, wrong = {}, {"turnz": (1,)}
    for name, option in options_of(kind.name).items():
        low, high, _ = option.range or (0, 1, False)
        if option.kind == "number":
            right[name] = (
                ("10 deg", "30 deg", "90 deg")
                if option.is_angle
                else (0.5 * (low + high), high, low + 0.1 * (high - low))
            )
        else:
            right[name] = {"word": tuple(option.words), "switch": (True, False), "whole": (int(low) + 1, int(high))}[
                option.kind
            ]
        wrong[name] = (low, 2 * high, -1, "10 deg", "7 deg", "1e-9 deg", None)
    given = junk_in(rng, right, 0.03)
    if rng.random() < 0.5:
        given |= junk_in(rng, wrong, 0.3)

    def read():
        model = kind(**given)
        if model.is_free_wake:
            json.dumps(model.resolved("forward").core_options(bench.uh60a), allow_nan=False)

    return f"{kind.__name__}({told(given)})", read


def maneuver(bench, rng):
    """Right histories, of which a few places are changed to anything."""
    numbers = (0.0, 0.1, 0.5, 1.0, 3.0, -1.0, 1e308, 1e-320, *JUNK[:12])
    times = sorted(rng.uniform(0.0, 1.0) for _ in range(6))
    given = {
        stick: [(t, 0.0 if i == 0 else rng.uniform(-0.5, 0.5)) for i, t in enumerate(times[: rng.choice([2, 3, 6])])]
        for stick in rng.sample(["lateral", "pedal", "collective"], rng.choice([1, 2]))
    }
    more = {rng.choice(["seconds", "revolutions"]): rng.choice([1.5, 8, 100.0])}
    name = rng.choice((*mutations.NAMES, *["m"] * len(mutations.NAMES)))
    for _ in range(rng.choice([0, 0, 1, 2])):
        stick = rng.choice(list(given))
        way = rng.choice(["corner", "number", "stick", "more", "all", "name"])
        if way == "corner":
            given[stick][rng.randrange(len(given[stick]))] = rng.choice((*JUNK, (1.0,), (0.1, 0.2, 0.3)))
        elif way == "number":
            i = rng.randrange(len(given[stick]))
            given[stick] = [*given[stick][:i], (rng.choice(numbers), rng.choice(numbers)), *given[stick][i + 1 :]]
        elif way == "stick":
            given = {**given, rng.choice(["x", 3, None, "lateral"]): rng.choice((*JUNK, given[stick]))}
            break
        elif way == "more":
            more |= junk_in(
                rng, {each: numbers for each in ("revolutions", "seconds", "travel_in", "rotor_speed")}, 0.1
            )
        elif way == "all":
            junk = rng.choice(JUNK)
            return f"Maneuver({name!r:.30}, {brief(junk)})", functools.partial(wf.Maneuver, name, junk, **more)
        else:
            name = rng.choice((3, None, b"m"))
    given = rng.choice([given, list(given.items()), tuple(given.items())])

    def read():
        made = wf.Maneuver(name, given, **more).for_aircraft(bench.uh60a.stick_travel_in, 27.0)
        finite(made.corners() or [0.0], made.duration(27.0), made.offset(0.2), made.rate(0.2))
        if "/" in slug(made.name) or slug(made.name).startswith("."):
            raise Absurd(f"folder {slug(made.name)!r}")

    return f"Maneuver({name!r:.30}, {brief(given)}, {told(more)})", read


def call(bench, rng):
    """A public function with one argument of any kind; what it accepts it does, on the smallest case there is."""
    dynamic = {"inflow": "dynamic"}
    functions = {
        "load_aircraft": (wf.load_aircraft, {"name_or_path": "uh60a", "loading": None, "allow_outside": False}),
        "load_rotor": (wf.load_rotor, {"rotor": "uh60a", "allow_outside": False}),
        "load_maneuver": (wf.load_maneuver, {"name_or_path": "roll-reversal"}),
        "arrested_descent": (wf.arrested_descent, {"start": "1 s"}),
        "inflow_model": (wf.inflow_model, {"inflow": "dynamic"}),
        "bibtex": (wf.bibtex, {"keys": ["ribera2004"]}),
        "condition_for": (wf.condition_for, {"aircraft": bench.uh60a, "condition": None, "named": None}),
        "blade_modes": (
            wf.blade_modes,
            {"aircraft": bench.uh60a, "n_modes": 3, "n_elements": 4, "rotor_speed": 27.0, "reference_pitch": 0.1},
        ),
        "wing": (wf.wing, {"span": 8.0, "chord": 1.0, "alpha": "5 deg", "blade_model": "weissinger", "n": 10}),
        "trim": (
            wf.trim,
            {"aircraft": bench.rigid, "condition": None, **dynamic, "n_harmonics": 2, "control_tolerance": 1e-4},
        ),
        "fly": (
            wf.fly,
            {"start": bench.start, "maneuver": wf.roll_reversal(), **dynamic, "revolutions": 0.1, "integrator": "fixed"}
            | {"rtol": 1e-5, "stabilator": "held", "rotor_speed": "constant", "progress": None},
        ),
        "Simulation": (
            wf.Simulation,
            {
                "start": bench.start,
                **dynamic,
                "integrator": "fixed",
                "control": None,
                "rtol": 1e-5,
                "stabilator": "held",
            },
        ),
        "tunnel": (
            wf.tunnel,
            {
                "aircraft": bench.rigid,
                "collective": "8 deg",
                "speed": "0 kt",
                **dynamic,
                "climb": "0 m/s",
                "omega": None,
                "rpm": None,
            }
            | {
                "thrust": None,
                "flapping": None,
                "higher_harmonics": (),
                "n_harmonics": 2,
                "blades": None,
                "averaged": None,
            },
        ),
        "airfoil_loop": (
            wf.airfoil_loop,
            {
                "airfoil": "uh60a",
                "mean": "3 deg",
                "amplitude": "2 deg",
                "k": 0.1,
                "mach": 0.3,
                "motion": "pitch",
                "steps": 36,
            },
        ),
        "induced_velocity": (
            wf.induced_velocity,
            {"points": np.zeros((2, 3)), "filaments": [np.eye(3)], "circulation": [1.0, 1.0], "core_radius": [0.1, 0.1]}
            | {"core": "scully", "core_distance": "line", "method": "direct", "tolerance": 1e-3},
        ),
        "converge": (
            wf.converge,
            {
                "aircraft": bench.uh60a,
                "run": "modes",
                "vary": "elements",
                "values": "4, 6",
                "condition": None,
                "stand": None,
            },
        ),
        "results.load": (results.load, {"path": bench.folder / "base.nc", "kind": None}),
    }
    # those that do much where they accept come seldom
    name = rng.choice([*functions, *list(functions)[:9] * 3])
    function, given = functions[name]
    given = dict(given)
    if rng.random() < 0.1:
        return f"{name}()", lambda: function(**given)
    changed = rng.choice([*given, "".join(rng.choices(string.ascii_lowercase, k=4))])
    given[changed] = rng.choice((*JUNK, bench.start, bench.uh60a, wf.roll_reversal(), bench.flight))
    return f"{name}({told({changed: given[changed]})})", lambda: function(**given)


def command(bench, rng):
    pools = {
        "--speed": SPEEDS,
        "--flight-path": ANGLES,
        "--altitude": HEIGHTS,
        "--weight": WEIGHTS,
        "--bank": ANGLES,
        "--aircraft": ("bo105", "/etc/passwd", "/", "", "nope", "/dev/zero", "a" * 5000, "\x00"),
        "--loading": ("tm85890", "x", ""),
        "--condition": ("x", ""),
        "--revolutions": ("0.1", "0", "nan", "inf", "1e9", "x"),
        "--azimuth-step": ("10 deg", "7 deg", "0 deg", "nan deg", "1e-9 deg"),
        "--wake": ("standard", "x", "turns=", "turns=1e9", "=", "azimuth_step=7 deg", "trailers=\x1b[31m"),
        "--threads": ("1", "0", "-1", "x", "99999999999999999999"),
        "--integrator": ("fixed", "x"),
        "--out": ("/dev/null/x", "/proc/x", "", "a" * 300, "\x00"),
    }
    verb = rng.choice(["trim", "trim", "fly", "tunnel", "modes", "report", "validate", "zzz", "--help"])
    line = [verb]
    if verb == "fly":
        line += [
            rng.choice(["roll-reversal", "nope", "", "/", "/dev/zero", str(bench.maneuvers[0])]),
            "--revolutions",
            "0.1",
        ]
    if verb == "report":
        bench.folder.joinpath("bad.nc").write_bytes(rng.choice([b"", mutations.flipped(rng, bench.run)]))
        line.append(rng.choice([str(bench.folder / "bad.nc"), "/nope", "/", "/dev/zero"]))
    if verb in ("trim", "fly", "tunnel"):
        line += [
            "--inflow",
            rng.choice(["dynamic"] * 6 + ["magic"]),
            *(["--blades", "rigid"] if verb != "tunnel" else []),
        ]
    for option in rng.sample(list(pools), rng.randint(1, 3)):
        line += [option, rng.choice(pools[option])]
    line += ["--out", str(bench.folder / "out"), "--no-figures"][: 2 if "--out" not in line else 0]

    def run():
        errors, here, environment = io.StringIO(), Path.cwd(), dict(os.environ)
        os.chdir(bench.folder)
        try:
            with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
                cli.main(line)
        except SystemExit as ended:
            code = ended.code or 0
        finally:
            os.chdir(here)
            os.environ.clear()
            os.environ.update(environment)
        said = [each for each in errors.getvalue().splitlines() if each.startswith("wakeflight:")]
        if code in (2, 3) and len(said) == 1 and said[0].isprintable():
            raise wf.InputError(said[0].removeprefix("wakeflight: "))
        if code != 0:
            raise Absurd(f"exit code {code}: {errors.getvalue()[-300:]!r}")

    return f"wakeflight {' '.join(line)!r:.200}", run


def page(bench, rng):
    """A report of a flight with any name."""
    from wakeflight import report

    names = {
        key: rng.choice(mutations.NAMES) for key in ("aircraft", "maneuver", "inflow_model", "condition", "failure")
    }
    data = bench.flight.data.copy()
    data.attrs = {**data.attrs, **names, "warnings": "\n".join(rng.sample(mutations.NAMES, 3)), "finished": 1}

    def write():
        path = report.write({names["aircraft"]: data, "b": data}, bench.folder / "page")
        text = path.read_text(encoding="utf-8")
        for wrong in ("<script>alert", '" onload="x', "</script><b>"):
            if wrong in text:
                raise Absurd(f"the page holds {wrong}")

    return f"report of {names}", write
