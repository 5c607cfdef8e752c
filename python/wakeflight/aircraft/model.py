# SPDX-License-Identifier: MIT OR Apache-2.0
"""An aircraft, immutable: what its file says, in SI, and what the physics core is given."""

from __future__ import annotations

import copy
import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic import BaseModel, ValidationError

from ..errors import InputError
from ..units import STANDARD_GRAVITY, quantity, shown
from ..views import html_table
from .checks import check_aircraft
from .core_data import assembled, fixed_parts
from .mass import blade_mass
from .number import Number, Numbers, Provenance
from .schema import AircraftFile, Discretisation, Loading, Rotor, TailRotor
from .span import Deck
from .tables import TableFile
from .varied import joined, plain, varied

if TYPE_CHECKING:
    from ..condition import FlightCondition


class SourceRow(NamedTuple):
    """One number of an aircraft: key in the file, published value and unit, sources, confidence, note."""

    key: str
    value: Any
    unit: str
    sources: tuple[str, ...]
    confidence: str
    note: str


class Limits(NamedTuple):
    """Stated limits of an aircraft, None where none is stated: power [W], torque of the main rotor's shaft [N m], lowest and
    highest rotor speed [rad/s]."""

    power: float | None = None
    torque: float | None = None
    rotor_speed: tuple[float, float] | None = None


HINGE_MODES = {"hinged": 2, "flapping": 1, "clamped": 0}
"""Modes of a rigid blade: turns about its hinges."""


FEWEST_DEFAULT_STEPS = 36
"""Fewest steps in a revolution where a file names no azimuth step (10 deg)."""


class Settings(NamedTuple):
    """Discretisation: blade modes, finite elements, quadrature points of each, azimuth step, pitch of the mode problem [rad]."""

    n_modes: int
    n_elements: int
    n_gauss: int
    azimuth_step: float
    reference_pitch: float


class Aircraft:
    """An aircraft with one loading; make it with `load_aircraft`."""

    __slots__ = ("_discretisation", "_loading", "_loading_name", "_parts", "_path", "_spec", "_warnings")

    _spec: AircraftFile
    _path: Path
    _loading: Loading
    _loading_name: str | None
    _parts: dict[str, Any]
    _discretisation: Settings
    _warnings: tuple[str, ...]

    def __init__(self, spec: AircraftFile, path: Path, loading: str | None = None) -> None:
        """Read every table, check all numbers for physics; choose the loading.

        spec: the validated file; path: where it lies; loading: name in `[loadings]`, None for `[loading]`.
        """
        if loading is not None and loading not in spec.loadings:
            allowed = f"allowed: {', '.join(spec.loadings) or 'none, the file has no named loading'}"
            raise InputError.of("loading", loading, allowed, file=path)
        chosen = spec.loading
        if loading is not None:
            given = {key: value for key, value in spec.loadings[loading] if value is not None}
            chosen = spec.loading.model_copy(update=given)
        parts = fixed_parts(spec, path)
        for name, value in (
            ("_spec", spec),
            ("_path", path),
            ("_loading_name", loading),
            ("_loading", chosen),
            ("_parts", parts),
            ("_warnings", tuple(f"{path.name}: {text}" for text in check_aircraft(spec, parts, path))),
            ("_discretisation", _settings(spec, path)),
        ):
            object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse: an aircraft does not change."""
        raise AttributeError(f"an Aircraft is immutable: {name} cannot be set")

    def __reduce__(self) -> tuple[type[Aircraft], tuple[AircraftFile, Path, str | None]]:
        """How a copy is made: from the file's content, checked again."""
        return Aircraft, (self._spec, self._path, self._loading_name)

    def __repr__(self) -> str:
        """Name and loading."""
        loading = f", loading={self._loading_name!r}" if self._loading_name else ""
        varied = f", varied: {', '.join(self.changes)}" if self.changes else ""
        return f"Aircraft({self.name!r}{loading}{', mirrored' if self._spec.mirrored else ''}{varied})"

    def _repr_html_(self) -> str:
        """A small table."""
        rotor = self.rotor
        rows = [
            ("loading", self._loading_name or "that of the file"),
            (
                "rotor",
                f"{int(rotor.n_blades)} blades, radius {float(rotor.radius):.3f} m, {float(rotor.omega):.2f} rad/s",
            ),
            ("solidity", f"{self.solidity:.4f}"),
            ("blades", "flexible" if self.flexible else "rigid"),
            *(("warning", text) for text in self.warnings),
        ]
        return html_table(self.name, rows)

    @property
    def name(self) -> str:
        """Name given in the file."""
        return self._spec.name

    def mirrored(self) -> Aircraft:
        """Its mirror image: the rotor turns the other way; lateral stick and pedal go to the right, from the left stop."""
        return Aircraft(
            self._spec.model_copy(update={"mirrored": not self._spec.mirrored}), self._path, self._loading_name
        )

    @property
    def path(self) -> Path:
        """The aircraft file."""
        return self._path

    @property
    def spec(self) -> AircraftFile:
        """Everything the file holds; numbers are SI floats with `.provenance`."""
        return self._spec

    @property
    def rotor(self) -> Rotor:
        """Main rotor: `radius`, `omega`, `n_blades`, `blade.root_station`, `blade.root_cutout`, ... in SI."""
        return self._spec.rotor

    @property
    def rotors(self) -> dict[str, Rotor | TailRotor]:
        """Rotors by their names in the file (`main`, `tail` where it gives none), the one with blades first."""
        listed = (self._spec.rotor, self._spec.tail_rotor)
        return {rotor.name: rotor for rotor in listed if rotor is not None}

    @property
    def loading(self) -> Loading:
        """Centre of gravity and inertia in force."""
        return self._loading

    @property
    def loading_name(self) -> str | None:
        """Name of the loading, None for the file's own."""
        return self._loading_name

    @property
    def conditions(self) -> tuple[str, ...]:
        """Names of the alternative conditions of the file."""
        return tuple(self._spec.conditions)

    @property
    def discretisation(self) -> Settings:
        """Modes, elements, azimuth step and reference pitch."""
        return self._discretisation

    @property
    def flexible(self) -> bool:
        """Whether the blades bend and twist."""
        return self._spec.rotor.blade.flexible

    def with_rigid_blades(self) -> Aircraft:
        """This aircraft with blades that move about their flap and lag hinges alone.

        Raises InputError where the blades are clamped: rigid they would not flap.
        """
        rotor = self._spec.rotor
        if rotor.blade.root == "clamped":
            raise InputError.of("blades", "rigid", f"the blades of {self.name} are clamped: they flap by bending")
        blade = rotor.blade.model_copy(update={"flexible": False})
        spec = self._spec.model_copy(update={"rotor": rotor.model_copy(update={"blade": blade})})
        return Aircraft(spec, self._path, self._loading_name)

    def discretised(self, **given: Any) -> Aircraft:
        """This aircraft with another `[discretisation]`: keys of the file, checked as there."""
        if "n_modes" in given and not self.flexible:
            raise InputError.of(
                "n_modes", given["n_modes"], "rigid blades have the modes of their hinges: lag and flap"
            )
        chosen = checked_discretisation(dict(self._spec.discretisation), given)
        return Aircraft(self._spec.model_copy(update={"discretisation": chosen}), self._path, self._loading_name)

    def with_(self, changes: Any) -> Aircraft:
        """This aircraft with other numbers: values by the dotted names of its file, checked as there.

        `{"rotor.radius": "27 ft", "loading.cg_station": "355 in", "rotor.n_blades": 5}`; several numbers as a list; `"x 1.05"` is
        the number, or the column of a table (`rotor.blade.structure.mass_kg_m`), times 1.05; None leaves a group out. A rotor
        goes by its name (`rotor.tail.radius`), without one it is the one with blades. What was changed stands in `.changes`
        and in every run. Raises InputError as `load_aircraft` does.
        """
        steps = joined(self._spec.changes, plain(changes))
        return Aircraft(varied(self._spec, self._path, steps), self._path, self._loading_name)

    @property
    def changes(self) -> dict[str, Any]:
        """What `with_` gave in place of the file's numbers, by dotted names; of a name given twice the last."""
        return {name: value for step in self._spec.changes for name, value in step.items()}

    @property
    def chord(self) -> float:
        """Chord at three quarters of the radius [m]."""
        table, at = self._parts["blade"]["chord"], 0.75 * float(self.rotor.radius)
        stations, chords = table["x"], table["y"]
        for i in range(len(stations) - 1):
            if stations[i] <= at <= stations[i + 1]:
                share = (at - stations[i]) / (stations[i + 1] - stations[i])
                return float(chords[i] + share * (chords[i + 1] - chords[i]))
        return float(chords[-1])

    @property
    def solidity(self) -> float:
        """Blade area of `chord` over disk area, n_blades chord / (pi R)."""
        return int(self.rotor.n_blades) * self.chord / (math.pi * float(self.rotor.radius))

    @property
    def blade_mass(self) -> float:
        """Mass of one blade beyond its root [kg], integral of the structure table."""
        return blade_mass(self._parts["blade"]["structure"])

    @property
    def stick_travel_in(self) -> tuple[float, float, float, float]:
        """Travel of lateral, longitudinal, collective, pedal [in]."""
        lateral, longitudinal, collective, pedal = (each / 0.0254 for each in self._spec.rigging.stick_travel)
        return lateral, longitudinal, collective, pedal

    @property
    def stick_rate_limit_in(self) -> tuple[float, float, float, float]:
        """Travel over the full travel time [in/s], beyond which a manoeuvre is warned of."""
        time = float(self._spec.rigging.full_travel_time)
        lateral, longitudinal, collective, pedal = (each / time for each in self.stick_travel_in)
        return lateral, longitudinal, collective, pedal

    @property
    def geometry(self) -> dict[str, Any]:
        """Place and shape of the rotor, for drawings and exports: a run keeps it.

        hub: place in body axes from the centre of gravity [m]; shaft_tilt: forward, to the right [rad]; rotation: 1 counter-
        clockwise seen from above, -1 clockwise; hinge_offset, root_cutout, chord (at 0.75 R) [m]; stick_travel: of lateral,
        longitudinal, collective, pedal [in].
        """
        rotor = self.core_data()["rotor"]
        return {
            "hub": list(rotor["position"]),
            "shaft_tilt": [rotor["shaft_tilt_forward"], rotor["shaft_tilt_lateral"]],
            "rotation": {"ccw": 1, "cw": -1}[rotor["rotation"]],
            "hinge_offset": float(self.rotor.blade.root_station),
            "root_cutout": float(self.rotor.blade.root_cutout),
            "chord": self.chord,
            "stick_travel": list(self.stick_travel_in),
        }

    @property
    def pitch_bias_actuator(self) -> dict[str, float] | None:
        """Law of the pitch-bias actuator, SI and shares of the longitudinal travel, by the names of the file; None without."""
        law = self._spec.rigging.pitch_bias_actuator
        return None if law is None else {name: float(value) for name, value in law}

    @property
    def limits(self) -> Limits:
        """What the file states of the aircraft's limits."""
        stated = self._spec.limits
        if stated is None:
            return Limits()
        speeds = stated.rotor_speed
        return Limits(
            None if stated.power is None else float(stated.power),
            None if stated.torque is None else float(stated.torque),
            None if speeds is None else (float(speeds[0]), float(speeds[1])),
        )

    @property
    def drive_inertia(self) -> tuple[float, float]:
        """Moment of inertia of all that turns with the rotor but its blades, at its speed, and that of the hub in it [kg m2]."""
        parts = ("engines", "tail_rotor", "hub", "gearbox", "accessories")
        stated = dict(self._spec.drive)
        missing = [f"inertia_{part}" for part in parts if stated[f"inertia_{part}"] is None]
        if missing:
            raise self._needed(missing)
        return sum(float(stated[f"inertia_{part}"]) for part in parts), float(stated["inertia_hub"])

    @property
    def governor(self) -> tuple[tuple[float, float, float], float]:
        """Power taken off by excess of speed [W s/rad], its integral [W/rad], its rate [W s2/rad], and the engines' lag [s]."""
        names = (
            "governor_proportional",
            "governor_integral",
            "governor_derivative",
            "power_per_fuel_flow",
            "engine_lag",
        )
        stated = dict(self._spec.drive)
        missing = [name for name in names if stated[name] is None]
        if missing:
            raise self._needed(missing)
        proportional, integral, derivative, power, lag = (float(stated[name]) for name in names)
        return (proportional * power, integral * power, derivative * power), lag

    def _needed(self, missing: list[str]) -> InputError:
        """What the file does not say of its drive train, where the speed of the rotor is to be a state."""
        allowed = f"needs drive.{', drive.'.join(missing)} in the aircraft file"
        return InputError.of("rotor_speed", "a state", allowed, file=self._path)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful in the file or not used of it, a line each."""
        return self._warnings

    @property
    def references(self) -> tuple[str, ...]:
        """Keys of references.bib behind the numbers of this aircraft, sorted."""
        return tuple(sorted({key for source in self._spec.sources.values() for key in source.references}))

    def default(self, name: str, condition: str | None = None) -> float:
        """Default of a condition's `speed` [m/s], `flight_path` [rad], `altitude` [m] or `gross_mass` [kg].

        condition: an alternative condition; the rest is that of the loading, then of `[condition]`.
        """
        if condition is not None and condition not in self._spec.conditions:
            allowed = f"allowed: {', '.join(self.conditions) or 'none, the file has no named condition'}"
            raise InputError.of("condition", condition, allowed, file=self._path)
        key = "weight" if name == "gross_mass" else name
        named = self._spec.conditions[condition] if condition is not None else None
        groups = [named, self._loading if key == "weight" else None, self._spec.condition]
        value = next(getattr(group, key) for group in groups if group is not None and getattr(group, key) is not None)
        return float(value) / STANDARD_GRAVITY if name == "gross_mass" else float(value)

    @property
    def condition(self) -> FlightCondition:
        """The flight condition of the file, with the weight of the loading where that has one."""
        from ..condition import condition_for

        return condition_for(self)

    def core_data(self, condition: FlightCondition | None = None) -> dict[str, Any]:
        """The aircraft as the physics core reads it: plain lists, SI, radians, body axes.

        Positions are from the nominal gross centre of gravity. condition: gives the gross mass; None is the
        aircraft's own.
        """
        gross_mass = condition.gross_mass if condition is not None else None
        if gross_mass is None:
            gross_mass = self.default("gross_mass")
        blades = int(self.rotor.n_blades) * self.blade_mass
        if gross_mass <= blades:
            allowed = f"must be above the mass of the {int(self.rotor.n_blades)} blades, {shown(blades, 'lb')}"
            raise InputError.of("weight", shown(gross_mass, "lb"), allowed)
        # a copy: whoever receives it may change it, the aircraft may not change
        return copy.deepcopy(assembled(self._spec, self._parts, self._loading, gross_mass))

    def sources(self) -> list[SourceRow]:
        """Every number and table of the file with its published value, sources and confidence."""
        return list(_rows(self._spec, ""))


def checked_discretisation(present: dict[str, Any], given: dict[str, Any]) -> Discretisation:
    """The `[discretisation]` with what is given put in place of what is present, checked as in a file."""
    try:
        return Discretisation(**{**present, **given})
    except ValidationError as reason:
        error = reason.errors()[0]
        key = str(error["loc"][0])
        raise InputError.of(key, given.get(key), error["msg"][0].lower() + error["msg"][1:]) from None


def _rows(group: BaseModel, prefix: str) -> Iterator[SourceRow]:
    for key, value in group:
        yield from _row(f"{prefix}{key}", value)


def _row(key: str, value: Any) -> Iterator[SourceRow]:
    if isinstance(value, BaseModel):
        yield from _rows(value, key + ".")
    elif isinstance(value, dict):
        for name, entry in value.items():
            yield from _row(f"{key}.{name}", entry)
    elif isinstance(value, list) and value and isinstance(value[0], BaseModel):
        # sections along the span: by their names where there are several
        for entry in value:
            yield from _row(f"{key}[{entry.name}]" if len(value) > 1 else key, entry)
    elif isinstance(value, Number | Numbers | TableFile | Deck):
        yield from _row(key, value.provenance)
    elif isinstance(value, Provenance):
        yield SourceRow(key, value.value, value.unit, value.sources, value.confidence, value.note)


def azimuth_step(given: str | None, n_blades: int, path: Path) -> float:
    """Step that a file gives [rad]; by default the largest that divides 30 deg and the angle between blades, at most 10 deg."""
    from ..inflow import check_azimuth_step

    if given is None:
        least = math.lcm(12, n_blades)
        return 2.0 * math.pi / (least * math.ceil(FEWEST_DEFAULT_STEPS / least))
    step = quantity(given, "rad", f"{path}: discretisation.azimuth_step")
    check_azimuth_step(step, n_blades, f"{path}: discretisation.azimuth_step")
    return step


def _settings(spec: AircraftFile, path: Path) -> Settings:
    given = spec.discretisation
    step = azimuth_step(given.azimuth_step, int(spec.rotor.n_blades), path)
    if given.reference_pitch is not None:
        pitch = quantity(given.reference_pitch, "rad", f"{path}: discretisation.reference_pitch")
    else:
        # mid collective stick, no cyclic: row theta_0, column collective
        rigging = spec.rigging
        pitch = rigging.offset[2] + rigging.matrix[2][2] * 0.5 * rigging.stick_travel[2]
    n_modes = given.n_modes if spec.rotor.blade.flexible else HINGE_MODES[spec.rotor.blade.root]
    return Settings(n_modes, given.n_elements, given.n_gauss, step, pitch)
