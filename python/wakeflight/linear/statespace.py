# SPDX-License-Identifier: MIT OR Apache-2.0
"""A linear model with names and units: x_dot = A x + B u, y = C x + D u, and what is read from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError
from ..views import html_table
from .control import control_model
from .modes import Modes, modes
from .names import MOTION
from .periodic import Named
from .reduction import ON_AXIS, RIGID, balanced, good_to, is_attitude_held, kept_states, quasi_static, without
from .response import Matrices, frequency_response, time_response

if TYPE_CHECKING:
    import xarray as xr

NO_UNIT = "1"
MATRICES = (
    "rate of a state by a state, in state_units a second by state_units_",
    "rate of a state by an input, in state_units a second by input_units",
    "output by a state, in output_units by state_units",
    "output by an input at once, in output_units by input_units",
)
"""What A, B, C, D are, their `long_name`."""


@dataclass(frozen=True, repr=False)
class LinearModel:
    """A constant linear model, continuous in time [s].

    matrices: A (s, s), B (s, m), C (k, s), D (k, m). states, inputs, outputs: name and unit each; names alone have the unit 1.
    input_si: SI units in one unit of every input: sticks are in inches, B / 0.0254 is per metre. harmonic: 0 of states of the
    mean, n and -n of the cosine and sine of the n-th harmonic. omega: rotor speed [rad/s], None without a rotor. good_to: the
    frequency [rad/s] up to which a reduced model is within 2 dB and 10 deg of the one it comes from.
    """

    matrices: Matrices
    states: Named
    inputs: Named
    outputs: Named
    input_si: tuple[float, ...] = ()
    harmonic: tuple[int, ...] = ()
    omega: float | None = None
    good_to: float | None = None
    attributes: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        a: Any,
        b: Any = None,
        c: Any = None,
        d: Any = None,
        *,
        states: Sequence[Any],
        inputs: Sequence[Any] = (),
        outputs: Sequence[Any] | None = None,
    ) -> LinearModel:
        """From matrices of elsewhere: names, or pairs of name and unit. Without C the states are the outputs."""
        s, m = len(states), len(inputs)
        named, seen = _named(states), _named(states if outputs is None else outputs)
        k = len(seen)
        shapes = {"A": (a, (s, s)), "B": (b, (s, m)), "C": (c, (k, s)), "D": (d, (k, m))}
        defaults = {"B": np.zeros((s, m)), "C": np.eye(s), "D": np.zeros((k, m))}
        found: dict[str, np.ndarray] = {}
        for name, (given, shape) in shapes.items():
            value = defaults[name] if given is None else np.array(given, dtype=float)
            if value.shape != shape:
                raise InputError.of(
                    name, f"array of shape {value.shape}", f"must have the shape {shape} that its names say"
                )
            if not np.isfinite(value).all():
                raise InputError.of(name, "not finite", "must be finite")
            found[name] = value
        matrices = (found["A"], found["B"], found["C"], found["D"])
        return cls(matrices, named, _named(inputs), seen, input_si=(1.0,) * m)

    def __post_init__(self) -> None:
        """Everything is of the mean where nothing is said."""
        if not self.harmonic:
            object.__setattr__(self, "harmonic", (0,) * len(self.states))

    # --- matrices ------------------------------------------------------------------------------------------

    @property
    def A(self) -> xr.DataArray:
        """State matrix (state, state_)."""
        return self._labelled(0, "state", "state_")

    @property
    def B(self) -> xr.DataArray:
        """Input matrix (state, input) per unit of input; divided by its coordinate `si` per SI unit."""
        return self._labelled(1, "state", "input")

    @property
    def C(self) -> xr.DataArray:
        """Output matrix (output, state)."""
        return self._labelled(2, "output", "state")

    @property
    def D(self) -> xr.DataArray:
        """Direct matrix (output, input)."""
        return self._labelled(3, "output", "input")

    def _labelled(self, i: int, rows: str, columns: str) -> xr.DataArray:
        import xarray as xr

        coordinates: dict[str, Any] = {}
        for dimension in (rows, columns):
            named = {"state": self.states, "state_": self.states, "input": self.inputs, "output": self.outputs}[
                dimension
            ]
            coordinates[dimension] = [name for name, _ in named]
            coordinates[f"{dimension.rstrip('_')}_units" + "_" * dimension.count("_")] = (
                dimension,
                [unit for _, unit in named],
            )
            if dimension == "input":
                coordinates["si"] = ("input", list(self.input_si))
        return xr.DataArray(
            self.matrices[i],
            dims=(rows, columns),
            coords=coordinates,
            name="ABCD"[i],
            attrs={"time_unit": "s", "long_name": MATRICES[i]},
        )

    def to_dataset(self) -> xr.Dataset:
        """A, B, C, D and the modes as one Dataset, to be kept."""
        import xarray as xr

        found = xr.Dataset({each.name: each for each in (self.A, self.B, self.C, self.D)})
        own = self.modes().drop_vars("state").rename(state="mean_state", name="mode_name")
        root = own["eigenvalue"]
        own = own.drop_vars("eigenvalue").assign(
            eigenvalue_real=root.real.assign_attrs(root.attrs), eigenvalue_imag=root.imag.assign_attrs(root.attrs)
        )
        attributes = {**self.attributes, "omega": self.omega or 0.0}
        if self.good_to is not None and np.isfinite(self.good_to):
            attributes["good_to"] = self.good_to
        return found.merge(own).assign_attrs(attributes)

    # --- modes ---------------------------------------------------------------------------------------------

    @cached_property
    def _modes(self) -> Modes:
        return modes(self.matrices[0], tuple(name for name, _ in self.states), np.array(self.harmonic), self.omega)

    @property
    def eigenvalues(self) -> np.ndarray:
        """Eigenvalues of A [1/s], copies at multiples of the rotor speed included."""
        return np.linalg.eigvals(self.matrices[0])

    def modes(self) -> xr.Dataset:
        """Modes with eigenvalue, frequency, damping, time to half or double, participation and name; of conjugates the upper."""
        return self._modes.to_dataset()

    def modes_table(self) -> str:
        """Modes to print, the slowest to decay first."""
        found = self._modes
        lines = ["eigenvalue [1/s]            frequency [rad/s]  damping  mode"]
        for root, name in zip(found.eigenvalues, found.names, strict=True):
            imaginary = f" ± {root.imag:.4f}i" if root.imag > 1e-9 else ""
            damping = -root.real / abs(root) if abs(root) else 0.0
            lines.append(f"{f'{root.real:+.4f}{imaginary}':<26}  {abs(root):17.3f}  {damping:7.3f}  {name}")
        return "\n".join(lines)

    def derivatives_table(self) -> str:
        """Stability and control derivatives to print: rows of the body's accelerations, the rest at once [SI, 1/in]."""
        names = [name for name, _ in self.states]
        if all(name in names for name in RIGID) and len(names) > len(RIGID):
            return self.reduce(len(RIGID)).derivatives_table()
        rows = [i for i, name in enumerate(names) if name in MOTION]
        columns = [*names, *(name for name, _ in self.inputs)]
        values = np.hstack([self.matrices[0], self.matrices[1]])
        width = max(9, *(len(name) + 1 for name in columns))
        lines = ["     " + "".join(f"{name:>{width}}" for name in columns)]
        lines += [f"{names[i]:<5}" + "".join(f"{value:>{width}.4f}" for value in values[i]) for i in rows]
        return "\n".join(lines)

    # --- responses -----------------------------------------------------------------------------------------

    def places(self, what: str, names: str | Sequence[str] | None) -> list[int]:
        """Indices of inputs or outputs by name; all without names."""
        known = [name for name, _ in (self.inputs if what == "input" else self.outputs)]
        asked = known if names is None else [names] if isinstance(names, str) else list(names)
        for name in asked:
            if name not in known:
                raise InputError.of(what, str(name), f"allowed: {', '.join(known)}")
        return [known.index(name) for name in asked]

    def frequency_response(
        self, w: Any, input: str | Sequence[str] | None = None, output: str | Sequence[str] | None = None
    ) -> xr.Dataset:
        """Response to harmonic inputs at frequencies `w` [rad/s]: complex, magnitude, phase (unwrapped, rad), coherence 1."""
        import xarray as xr

        w = np.atleast_1d(np.asarray(w, dtype=float))
        if w.ndim != 1 or not w.size or not (np.isfinite(w).all() and (w > 0.0).all() and (np.diff(w) > 0.0).all()):
            raise InputError.of("w", w, "must be frequencies above 0, ascending [rad/s]")
        rows, columns = self.places("output", output), self.places("input", input)
        a, b, c, d = self.matrices
        found = frequency_response((a, b[:, columns], c[rows], d[np.ix_(rows, columns)]), w)
        dims = ("frequency", "output", "input")
        return xr.Dataset(
            {
                "response": (dims, found),
                "magnitude": (dims, np.abs(found), {"long_name": "magnitude, units of output per unit of input"}),
                "phase": (dims, np.unwrap(np.angle(found), axis=0), {"units": "rad", "long_name": "phase"}),
                "coherence": (dims, np.ones(found.shape), {"units": "1", "long_name": "coherence of a linear model"}),
            },
            coords={
                "frequency": ("frequency", w, {"units": "rad/s", "long_name": "frequency"}),
                "output": [self.outputs[i][0] for i in rows],
                "input": [self.inputs[i][0] for i in columns],
            },
        )

    def response(self, time: Any, inputs: Mapping[str, Any]) -> xr.Dataset:
        """Outputs from trim for histories of inputs about trim by name, linear between equally spaced times (n,) [s]."""
        import xarray as xr

        if not isinstance(inputs, Mapping):
            raise InputError.of("inputs", type(inputs).__name__, 'must be histories by name, {"lateral": array}')

        time = np.asarray(time, dtype=float)
        if time.ndim != 1 or time.size < 2 or not np.allclose(np.diff(time), time[1] - time[0], rtol=1e-6, atol=0.0):
            raise InputError.of("time", f"array of shape {time.shape}", "must be two or more equally spaced times [s]")
        u = np.zeros((time.size, len(self.inputs)))
        for name, values in inputs.items():
            (i,) = self.places("input", name)
            given = np.asarray(values, dtype=float)
            if given.shape != time.shape or not np.isfinite(given).all():
                raise InputError.of(
                    name, f"array of shape {given.shape}", f"must be {time.size} finite numbers, one a time"
                )
            u[:, i] = given
        y = self._outputs(time, u)
        found = {
            name: ("time", y[:, i], {"units": unit, "long_name": f"{name} from trim"})
            for i, (name, unit) in enumerate(self.outputs)
        }
        return xr.Dataset(found, coords={"time": ("time", time, {"units": "s", "long_name": "time"})})

    def _outputs(self, time: np.ndarray, u: np.ndarray) -> np.ndarray:
        return time_response(self.matrices, time, u)[0]

    # --- other models --------------------------------------------------------------------------------------

    def reduce(self, order: int | str | Sequence[str]) -> LinearModel:
        """A smaller model: the rest follows at once.

        order: 8 keeps u, w, q, pitch, v, p, roll, r; 9 the mean inflow too; 10 instead of it the tilt of the disk; 6 the
        velocities alone, the attitude held; names of states keep those; any other number is a balanced reduction, whose states
        have no names. `good_to` says up to which frequency it is like this one.
        """
        names = tuple(name for name, _ in self.states)
        if isinstance(order, str):
            raise InputError.of("order", order, "must be a number of states, or names of states to keep")
        if isinstance(order, bool | np.bool_) or (np.ndim(order) == 0 and not isinstance(order, int | np.integer)):
            raise InputError.of("order", order, "must be a whole number")
        if np.ndim(order) == 0:
            order = int(order)  # type: ignore[arg-type]
            if not 0 < order <= len(names):
                raise InputError.of("order", order, f"must lie between 1 and {len(names)}")
            kept = kept_states(order, names)
            if kept is None:
                on_axis = [i for i, (name, _) in enumerate(self.outputs) if name in {y for _, y in ON_AXIS}]
                judged = np.array(on_axis or range(len(self.outputs)))
                return self._with(
                    balanced(self.matrices, order, judged), tuple((f"balanced_{i}", NO_UNIT) for i in range(order))
                )
            if is_attitude_held(order):
                held = np.array([names.index(name) for name in ("pitch", "roll")])
                rest = [name for name in names if name not in ("pitch", "roll")]
                system = without(self.matrices, held)
                return self._kept(
                    system, [rest.index(name) for name in kept], [self.states[names.index(name)] for name in kept]
                )
        else:
            kept = tuple(order)  # type: ignore[arg-type]
            for name in kept:
                if name not in names:
                    raise InputError.of("order", str(name), f"is no state; states: {', '.join(names[:60])}")
        return self._kept(
            self.matrices, [names.index(name) for name in kept], [self.states[names.index(n)] for n in kept]
        )

    def _kept(self, system: Matrices, indices: list[int], states: Sequence[tuple[str, str]]) -> LinearModel:
        order = np.array(indices)
        found = quasi_static(system, np.sort(order))
        place = np.argsort(np.argsort(order))
        a, b, c, d = found
        return self._with((a[np.ix_(place, place)], b[place], c[:, place], d), tuple(states))

    def _with(self, matrices: Matrices, states: Named) -> LinearModel:
        """A reduced model, judged by its responses beside those of this one."""
        inputs, outputs = ([name for name, _ in named] for named in (self.inputs, self.outputs))
        pairs = [(outputs.index(y), inputs.index(u)) for u, y in ON_AXIS if u in inputs and y in outputs]
        limit = good_to(self.matrices, matrices, pairs) if pairs else None
        own = {each: self.__dict__[each] for each in ("inputs", "outputs", "input_si", "omega", "attributes")}
        return LinearModel(matrices, states, harmonic=(0,) * len(states), good_to=limit, **own)

    def to_control(self) -> Any:
        """The same as a `StateSpace` of python-control, names kept; needs the package `control`."""
        return control_model(
            self.matrices, *([name for name, _ in named] for named in (self.states, self.inputs, self.outputs))
        )

    def renamed(self, **attributes: Any) -> LinearModel:
        """The same model with more said of it."""
        return replace(self, attributes={**self.attributes, **attributes})

    def __repr__(self) -> str:
        """One line."""
        own = f"{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs"
        return f"<{type(self).__name__}: {own}{self._good()}>"

    def _good(self) -> str:
        if self.good_to is None:
            return ""
        if self.good_to == 0.0:
            return ", unlike the full model at all frequencies"
        return ", good up to " + (f"{self.good_to:.2g} rad/s" if np.isfinite(self.good_to) else "60 rad/s and more")

    def _repr_html_(self) -> str:
        """Modes as a small table."""
        rows = [
            (name, f"{root.real:+.4f} ± {root.imag:.4f}i")
            for root, name in zip(self._modes.eigenvalues, self._modes.names, strict=True)
        ]
        return html_table(repr(self)[1:-1], rows[:12])


def _named(given: Sequence[Any]) -> Named:
    """Pairs of name and unit."""
    return tuple((each, NO_UNIT) if isinstance(each, str) else (str(each[0]), str(each[1])) for each in given)
