# SPDX-License-Identifier: MIT OR Apache-2.0
"""Linear filters and lags with limits, advanced exactly while their input goes along a straight line.

An input is known where it is sampled; between two samples it is taken as straight. That is exact for an input that is, and of
second order in the time between samples for any other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import InputError


def lagged(x: float, u0: float, u1: float, dt: float, tau: float) -> float:
    """State of tau dx/dt = u - x after `dt`, from `x`, while u goes from `u0` to `u1`."""
    slope = (u1 - u0) / dt
    return u1 - slope * tau + (x - u0 + slope * tau) * math.exp(-dt / tau)


@dataclass
class Smoothed:
    """A signal behind a lag, a washout, or both: y = T s / ((tau s + 1)(T s + 1)) u with both.

    tau, T: time constants of lag and washout [s], None: without. Both are the difference of two lags of the same input, times
    T/(T - tau), and so are exact too.
    """

    lag: float | None
    washout: float | None
    memory: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Input, lagged by `lag`, lagged by `washout`, at the last sample."""

    def __post_init__(self) -> None:
        """Refuse two constants that are one: their difference would be none."""
        if self.lag is not None and self.washout is not None and abs(self.washout - self.lag) < 1e-6 * self.washout:
            raise InputError.of("lag", f"{self.lag:g} s", "must differ from the washout")

    def settle(self, u: float) -> None:
        """At rest with the input `u`."""
        self.memory = (u, u, u)

    def advance(self, u: float, dt: float) -> float:
        """Output at a sample that shows `u`, `dt` after the last one; `dt` may be 0."""
        before, fast, slow = self.memory
        if dt > 0.0:
            fast = u if self.lag is None else lagged(fast, before, u, dt, self.lag)
            slow = u if self.washout is None else lagged(slow, before, u, dt, self.washout)
        elif self.lag is None:
            fast = u
        self.memory = (u, fast, slow)
        if self.washout is None:
            return fast
        return (fast - slow) * (1.0 if self.lag is None else self.washout / (self.washout - self.lag))


def limited_lag(x: float, u0: float, u1: float, dt: float, tau: float, rate: float) -> tuple[float, bool]:
    """State of dx/dt = (u - x)/tau within +-rate after `dt`, from `x`, while u goes from `u0` to `u1`; whether the rate held it.

    Exact: piece by piece of straight motion at the limit and of the lag inside it. tau may be 0: then x is u but for the rate.
    """
    if dt <= 0.0:
        return x, False
    slope = (u1 - u0) / dt
    if math.isinf(rate):
        return (lagged(x, u0, u1, dt, tau) if tau > 0.0 else u1), False
    band, error, left, limited = tau * rate, u0 - x, dt, False
    at_limit = abs(error) > band or (tau == 0.0 and abs(slope) > rate)
    sign = math.copysign(1.0, error if error else slope)
    while left > 0.0:
        if at_limit:
            limited = True
            closing = sign * (sign * rate - slope)
            until = (abs(error) - band) / closing if closing > 0.0 else math.inf
            step = min(left, until)
            x += sign * rate * step
            error += (slope - sign * rate) * step
            if step == until:
                error, at_limit = sign * band, False
                if tau == 0.0 and abs(slope) > rate:
                    at_limit, sign = True, math.copysign(1.0, slope)
        else:
            step, end = _inside(error, slope, left, tau, rate)
            u = u1 - slope * (left - step)
            error = end
            x = u - error
            at_limit = step < left
            sign = math.copysign(1.0, slope)
        left -= step
    return x, limited


def _inside(error: float, slope: float, left: float, tau: float, rate: float) -> tuple[float, float]:
    """How long the lag stays within its rate, at most `left`, and its error then; it leaves where the input is the faster."""
    if tau == 0.0:
        return left, 0.0
    settled = tau * slope
    if abs(slope) > rate:
        edge = math.copysign(tau * rate, slope)
        # from error to settled the edge lies between: met once
        step = -tau * math.log((edge - settled) / (error - settled)) if error != settled else left
        if step < left:
            return max(step, 0.0), edge
    return left, settled + (error - settled) * math.exp(-left / tau)
