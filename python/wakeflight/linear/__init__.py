# SPDX-License-Identifier: MIT OR Apache-2.0
"""Linear models: A, B, C, D about a periodic trim, exact derivatives, from the periodic system to a few states."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..arguments import checked
from ..errors import InputError
from ..results import flat_attributes
from ..rotor_speed import CONSTANT, OVER_GROUND
from ..trim import Trim
from ..units import number
from .build import BLADES, derivatives, periodic, with_states, with_wake, without_rates
from .constant import averaged, decomposed, default_harmonics
from .identified import identified_wake
from .instants import STICKS, check_inputs, units_of
from .linearized import METHODS, Linearized
from .marched import HARMONICS
from .names import INFLOW
from .over_ground import check_speed
from .quasi_static import wake_gains
from .statespace import LinearModel
from .three_states import inflow_constants
from .wake import check_wake
from .wake_states import WakeStates, states_of_wake

__all__ = ["LinearModel", "Linearized", "inflow_constants", "linearize"]

FINER = 4
"""Azimuths of derivatives under a wake, over those of its inflow: sections cross kinks of their tables in between."""
IN_TURN = max(order for _, order, _ in HARMONICS) + 1
"""Harmonic of multiblade coordinates up to which blades move in turn as a marched wake feels them."""


@checked
def linearize(
    start: Trim,
    inputs: Sequence[str] = STICKS,
    wake: str | None = None,
    blades: str = "multiblade",
    order: int | str | Sequence[str] | None = None,
    *,
    method: str = "harmonic-decomposition",
    harmonics: Sequence[int] | None = None,
    azimuths: int | None = None,
    stick_rates: bool = True,
    tolerance: float = 1e-3,
    rotor_speed: str = CONSTANT,
) -> LinearModel:
    """Linear model about a trim: x_dot = A x + B u, y = C x + D u, u and y about trim.

    inputs: sticks [in] and, in straight flight, `stabilator` [rad], `wind_north`, `wind_east`, `wind_down` [m/s]; the track is
    north. stick_rates: whether the rates of the sticks are felt, as blades do: outputs then answer a step of a stick at once by a
    little (D), and B is that of what remains; without them B holds the control derivatives as they are usually meant.
    wake: of a trim with dynamic inflow `dynamic`, its states are states (default), or `frozen`, they stay as trimmed; of one on a
    free wake `frozen`, the inflow at every station stays as trimmed; `quasi-static`, it follows hub motion, blade pitch and tilt
    of the disk at once, as the relaxation wake does (some 25 wakes); `states`, it follows as the wake does that is marched in a
    flight and repeats itself, whose memory becomes states (half a minute); or `identified`, the same from sweeps of the marched
    wake, in hover too where it does not repeat itself (about a minute). tolerance: Hankel singular value over the largest, from
    which such a state is kept.
    blades: `multiblade` coordinates, or `individual` ones.
    rotor_speed: `constant`, about the airframe, which then turns the whole rotor as it yaws, or `constant-over-ground`, with
    dynamic or frozen inflow.
    order: None or `full`; otherwise as for `LinearModel.reduce`.
    method: `harmonic-decomposition`, or `averaging` over azimuth. harmonics: of the state, kept beside its mean; by default those
    that occur with equal blades up to their number, with the `states` of a wake up to 6. azimuths: of the revolution at which
    derivatives are taken, 36 by default.

    The derivatives are those of the trim's own aircraft: how many modes and elements they need is told in docs/linear-models.md.
    """
    asked = (inputs,) if isinstance(inputs, str) else tuple(inputs)
    try:
        turning = start.turn_rate != 0.0
    except AttributeError:
        raise InputError.of("start", type(start).__name__, "must be what wf.trim returned") from None
    check_inputs(asked, turning)
    if blades not in BLADES:
        raise InputError.of("blades", blades, f"allowed: {', '.join(BLADES)}")
    check_method(method)
    if stick_rates is not True and stick_rates is not False:
        raise InputError.of("stick_rates", stick_rates, "allowed: True, False")
    if isinstance(order, str) and order != "full":
        raise InputError.of("order", order, "must be a number of states, names of states to keep, or full")
    start.inflow.check_first_order("linearize")
    wake = check_wake(wake, start.inflow)
    check_speed(rotor_speed, wake)
    tolerance = number("tolerance", tolerance, 1e-6, 0.5)
    n = _azimuths(azimuths, start)
    fine = n if start.inflow.is_dynamic else FINER * n
    raw = derivatives(start, asked, fine, rotor_speed == OVER_GROUND)
    if not stick_rates:
        raw = without_rates(raw)
    said: dict[str, Any] = {}
    marched: WakeStates | None = None
    if wake in ("states", "identified"):
        marched = (
            states_of_wake(start, raw.where, tolerance)
            if wake == "states"
            else identified_wake(start, raw.where, tolerance)
        )
        raw = with_states(start, raw, marched, asked, stick_rates)
        said = marched.described
    if wake == "quasi-static":
        gains = wake_gains(start)
        raw = with_wake(start, raw, gains, asked)
        said["wake_curvature"] = gains.curvature
    system = periodic(
        start, raw, asked, blades, INFLOW if start.inflow.is_dynamic and wake == "frozen" else (), marched
    ).coarser(n)
    most = min(IN_TURN, n // 4) if wake == "states" else 0
    kept = _harmonics(harmonics, (raw.where.n_blades, most), blades, n) if method == METHODS[0] else ()
    constant = decomposed(system, kept) if kept else averaged(system)
    attributes = {
        "aircraft": start.aircraft.name,
        "condition": start.condition.as_attributes(),
        "inflow_model": start.inflow.name,
        "wake": wake,
        "blades": blades,
        "method": method if kept else METHODS[1],
        "harmonics": list(kept),
        "azimuths": n,
        "stick_rates": stick_rates,
        "rotor_speed": rotor_speed,
        "n_modes": start.aircraft.discretisation.n_modes,
        "n_elements": start.aircraft.discretisation.n_elements,
        **said,
    }
    si = tuple(each for _, _, each in units_of(asked))
    found = Linearized.from_periodic(constant, system, kept, si, flat_attributes(attributes))
    return found if order is None or isinstance(order, str) else found.reduce(order)


def check_method(method: str) -> None:
    """Refuse a way from the periodic system to a constant one that there is not."""
    if method not in METHODS:
        raise InputError.of("method", method, f"allowed: {', '.join(METHODS)}")


def _azimuths(asked: Any, start: Trim) -> int:
    """Azimuths of the revolution; those of the wake's map where there is one."""
    if not start.inflow.is_dynamic:
        n = start.inflow_map.shape[0]
        if asked not in (None, n):
            raise InputError.of("azimuths", asked, f"must be those of the wake's inflow, {n}")
        return int(n)
    if asked is None:
        n_blades = start.model.n_blades
        return n_blades * -(-36 // n_blades)
    if isinstance(asked, bool) or not isinstance(asked, int) or asked > 720:
        raise InputError.of("azimuths", asked, "must be a whole number, at most 720")
    return asked


def _harmonics(asked: Sequence[int] | None, occur: tuple[int, int], blades: str, n: int) -> tuple[int, ...]:
    """Harmonics of the state to be kept.

    occur: number of blades, and the harmonic up to which more is kept than these make by themselves.
    """
    n_blades, most = occur
    if asked is None:
        every = tuple(range(1, max(n_blades, most) + 1))
        return default_harmonics(n_blades, most) if blades == "multiblade" else every
    kept = tuple(asked)
    for each in kept:
        if isinstance(each, bool) or not isinstance(each, int) or not 0 < each <= n // 4 or kept.count(each) > 1:
            raise InputError.of(
                "harmonics",
                list(kept),
                f"must be different whole numbers from 1 to {n // 4}, a quarter of the azimuths",
            )
    own = default_harmonics(n_blades)[0]
    if blades == "multiblade" and any(each % own for each in kept):
        # others are excited by nothing and would be left out without a word
        allowed = f"must be multiples of {own}: {n_blades} equal blades in multiblade coordinates have no others"
        raise InputError.of("harmonics", list(kept), allowed)
    return tuple(sorted(kept))
