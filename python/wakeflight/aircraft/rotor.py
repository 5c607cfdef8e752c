# SPDX-License-Identifier: MIT OR Apache-2.0
"""A rotor alone, immutable: from a rotor file, or taken from an aircraft; what a stand is given."""

from __future__ import annotations

import copy
import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from ..arguments import checked
from ..errors import InputError
from ..text import read_text
from ..units import STANDARD_GRAVITY, quantity
from .blade_data import blade_data
from .core_data import lag_damper_data as damper
from .load import find, load_aircraft, parsed
from .model import HINGE_MODES, Aircraft, Settings, azimuth_step, checked_discretisation
from .reading import validated
from .rotor_checks import check_rotor, unused_on_a_stand
from .rotor_file import UNSTATED, RotorFile, written_out
from .shipped import SHIPPED
from .span import check_span, span_data, tip_section
from .varied import plain, rewritten
from .versions import groups_of


@dataclass(frozen=True)
class Rotor:
    """A rotor, SI and radians; make it with `load_rotor`. `warnings`: what is doubtful in its file or not used of it."""

    name: str
    path: Path
    data: dict[str, Any]
    discretisation: Settings
    references: tuple[str, ...] = ()
    fixed_reference_pitch: bool = False
    warnings: tuple[str, ...] = ()
    weight: float | None = None
    """Weight [N] that the aircraft, or the `[condition]` of the rotor file, names; None where there is none."""
    changes: Mapping[str, Any] = field(default_factory=dict)
    """What `with_` gave in place of the file's numbers, by dotted names."""
    again: Callable[[dict[str, Any]], Rotor] | None = field(default=None, repr=False, compare=False)
    """Reads it anew with numbers replaced; None of one that was changed since it was loaded."""

    def with_(self, changes: Any) -> Rotor:
        """This rotor with numbers of its file replaced, by dotted names, checked as the file is: see `Aircraft.with_`.

        Directly after loading: what other methods changed would be lost, and is refused.
        """
        if self.again is None:
            raise InputError.of("changes", self.name, "must be given first: load_rotor(...).with_(...), then the rest")
        return self.again(plain(changes))

    def _changed(self, **values: Any) -> Rotor:
        return replace(self, again=None, **values)

    def _along(self, name: str, station: float) -> float:
        """Value of a column of the blade at `station` [m], held beyond its ends."""
        table = self.data["blade"][name]
        return float(np.interp(station, table["x"], table["y"]))

    @property
    def n_blades(self) -> int:
        """Number of blades."""
        return int(self.data["n_blades"])

    @property
    def radius(self) -> float:
        """Radius [m]."""
        return float(self.data["blade"]["radius"])

    @property
    def omega(self) -> float:
        """Rotor speed [rad/s]."""
        return float(self.data["omega"])

    @property
    def flexible(self) -> bool:
        """Whether the blades bend and twist."""
        return not self.data["blade"]["rigid"]

    @property
    def rotor(self) -> SimpleNamespace:
        """The numbers an inflow model asks of an aircraft's rotor."""
        blade = self.data["blade"]
        root = SimpleNamespace(root_cutout=blade["root_cutout"], root_station=blade["root_station"])
        return SimpleNamespace(n_blades=self.n_blades, radius=self.radius, omega=self.omega, blade=root)

    @property
    def chord(self) -> float:
        """Chord at three quarters of the radius [m]."""
        return self._along("chord", 0.75 * self.radius)

    @property
    def solidity(self) -> float:
        """Blade area of `chord` over disk area, n_blades chord / (pi R)."""
        return self.n_blades * self.chord / (math.pi * self.radius)

    def twist(self, station: float) -> float:
        """Built-in twist [rad] at `station` [m]."""
        return self._along("twist", station)

    def with_speed(self, omega: float) -> Rotor:
        """The same rotor turning at `omega` [rad/s]."""
        return self._changed(data={**self.data, "omega": float(omega)})

    def with_rigid_blades(self) -> Rotor:
        """The same rotor with blades that move about their hinges alone, or not at all where they are clamped."""
        blade = {**self.data["blade"], "rigid": True}
        settings = self.discretisation._replace(n_modes=HINGE_MODES[blade["root"]])
        return self._changed(data={**self.data, "blade": blade}, discretisation=settings)

    def with_reference_pitch(self, pitch: float) -> Rotor:
        """The same rotor with the modes of its blades at root pitch `pitch` [rad]."""
        return self._changed(discretisation=self.discretisation._replace(reference_pitch=float(pitch)))

    def discretised(self, **given: Any) -> Rotor:
        """The same rotor with other modes, finite elements or quadrature points (`n_modes`, `n_elements`, `n_gauss`)."""
        checked_discretisation({}, given)
        return self._changed(discretisation=self.discretisation._replace(**given))


@checked
def load_rotor(rotor: str | Path | Rotor | Aircraft = "uh60a", allow_outside: bool = False) -> Rotor:
    """Rotor from a rotor file, or that of an aircraft (its name, its file, or the loaded aircraft).

    allow_outside: whether tables may lie elsewhere than beside the file or below it.
    Raises InputError, one line naming file, key, value and what is allowed.
    """
    if isinstance(rotor, Rotor):
        return rotor
    if isinstance(rotor, Aircraft):
        return _of_aircraft(rotor)
    path = find(rotor)
    if str(rotor) in SHIPPED or "rigging" in parsed(path):
        return _of_aircraft(load_aircraft(rotor, allow_outside=allow_outside))
    return _of_file(path, allow_outside)


def _of_aircraft(aircraft: Aircraft) -> Rotor:
    # the stand's shaft is the z axis of the hub, its centre the origin
    data = copy.deepcopy(aircraft.core_data()["rotor"])
    data |= {"position": [0.0, 0.0, 0.0], "shaft_tilt_forward": 0.0, "shaft_tilt_lateral": 0.0}
    data["blade"].setdefault("rigid", False)
    settings = aircraft.discretisation
    weight = aircraft.default("gross_mass") * STANDARD_GRAVITY
    references, warnings, changes = aircraft.references, aircraft.warnings, aircraft.changes
    again = partial(_of_varied, aircraft)
    return Rotor(aircraft.name, aircraft.path, data, settings, references, True, warnings, weight, changes, again)


def _of_varied(aircraft: Aircraft, changes: dict[str, Any]) -> Rotor:
    return _of_aircraft(aircraft.with_(changes))


def _of_file(path: Path, allow_outside: bool) -> Rotor:
    return _read(path, {path.name: read_text(path)}, allow_outside, (), {})


def _read(
    path: Path, texts: dict[str, str], allow_outside: bool, steps: tuple[dict[str, Any], ...], more: dict[str, Any]
) -> Rotor:
    """The rotor of a file of which `texts` are known, its own first, with numbers replaced by `steps` and then by `more`."""
    steps, known_texts = ((*steps, more) if more else steps), dict(texts)
    read = parsed(path) if not steps else tomllib.loads(texts[path.name])
    if steps:
        read = rewritten({**read, "rotor": written_out(read["rotor"])}, texts, steps)
    written = groups_of(path, read)
    data = dict(written.data)
    if isinstance(data.get("rotor"), dict):
        data["rotor"] = written_out(data["rotor"])
    if isinstance(data.get("sources", {}), dict):
        data["sources"] = {**data.get("sources", {}), "unstated": UNSTATED.model_dump()}
    spec: RotorFile = validated(path, written._replace(data=data), RotorFile, texts, allow_outside, known=known_texts)
    group = spec.rotor
    core = {
        "n_blades": int(group.n_blades),
        "omega": float(group.omega),
        "rotation": group.rotation,
        "position": [0.0, 0.0, 0.0],
        "shaft_tilt_forward": 0.0,
        "shaft_tilt_lateral": 0.0,
        "tip_loss_factor": 1.0 if group.tip_loss_factor is None else float(group.tip_loss_factor),
        "blade": blade_data(group, path),
        "airfoil": span_data(group.airfoil, float(group.radius), float(group.blade.root_cutout), path),
        "lag_damper": damper(group),
    }
    keys = {key for source in spec.sources.values() for key in source.references}
    fixed = spec.discretisation.reference_pitch is not None
    warnings = tuple(f"{path.name}: {text}" for text in _checked(spec, core, path))
    weight = None if spec.condition is None or spec.condition.weight is None else float(spec.condition.weight)
    again = partial(_read, path, texts, allow_outside, steps)
    changes = {name: value for step in steps for name, value in step.items()}
    settings, references = _settings(spec, path), tuple(sorted(keys))
    return Rotor(spec.name, path, core, settings, references, fixed, warnings, weight, changes, again)


def _checked(spec: RotorFile, core: dict[str, Any], path: Path) -> list[str]:
    """Warnings about a rotor file; InputError where the rotor is impossible."""
    group = spec.rotor

    def refuse(key: str, value: object, allowed: str) -> InputError:
        return InputError.of(f"rotor.{key}", value, allowed, file=path)

    return [
        *check_span(group.airfoil, core["airfoil"], path),
        *check_rotor(group, core["blade"], core["lag_damper"], tip_section(core["airfoil"]), refuse),
        *unused_on_a_stand(group, spec.condition),
    ]


def _settings(spec: RotorFile, path: Path) -> Settings:
    given, n_blades = spec.discretisation, int(spec.rotor.n_blades)
    step = azimuth_step(given.azimuth_step, n_blades, path)
    pitch = 0.0
    if given.reference_pitch is not None:
        pitch = quantity(given.reference_pitch, "rad", f"{path}: discretisation.reference_pitch")
    blade = spec.rotor.blade
    n_modes = given.n_modes if blade.flexible else HINGE_MODES[blade.root]
    return Settings(n_modes, given.n_elements, given.n_gauss, step, pitch)
