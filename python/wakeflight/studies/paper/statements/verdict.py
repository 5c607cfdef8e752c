# SPDX-License-Identifier: MIT OR Apache-2.0
"""A sentence of the paper and what the runs say to it: conditions are computed, the verdict follows from them."""

from __future__ import annotations

from dataclasses import dataclass

RESOLUTION = 0.01
"""A difference below this share of the larger of two magnitudes counts as none: it orders nothing."""

HOLDS, PARTLY, FAILS, NO_CLAIM = "holds", "holds partly", "does not hold", "no claim to judge"
VERDICTS = (HOLDS, PARTLY, FAILS, NO_CLAIM)


@dataclass(frozen=True)
class Condition:
    """One test a sentence is put to: the criterion, what was measured, and whether it is met."""

    criterion: str
    measured: str
    met: bool


@dataclass(frozen=True)
class Statement:
    """A row of the table: figure or section, the paper's claim, its conditions, and why it does not hold.

    It holds if every condition is met, partly if some are, not at all if none is. `why` is what the data show where it does
    not fully hold; `figure` names the file the reader should look at.
    """

    key: str
    claim: str
    conditions: tuple[Condition, ...]
    why: str = ""
    figure: str = ""

    @property
    def verdict(self) -> str:
        """What follows from the conditions."""
        met = [condition.met for condition in self.conditions]
        if not met:
            return NO_CLAIM
        if all(met):
            return HOLDS
        return PARTLY if any(met) else FAILS


def larger(what: str, first: tuple[str, float], second: tuple[str, float], unit: str = "") -> Condition:
    """Condition: the first of two named quantities is the larger, by more than the resolution."""
    (a, x), (b, y) = first, second
    criterion = f"{what}: {a} > {b}"
    met = x - y > RESOLUTION * max(abs(x), abs(y))
    tied = "" if met or y - x > RESOLUTION * max(abs(x), abs(y)) else " (equal within 1 %)"
    return Condition(criterion, f"{x:.4g} against {y:.4g}{_unit(unit)}{tied}", met)


def at_least(what: str, first: tuple[str, float], second: tuple[str, float], unit: str = "") -> Condition:
    """Condition: the first is the larger, or equal within the resolution."""
    (a, x), (b, y) = first, second
    met = x - y > -RESOLUTION * max(abs(x), abs(y))
    return Condition(f"{what}: {a} ≥ {b}", f"{x:.4g} against {y:.4g}{_unit(unit)}", met)


def ordered(what: str, quantities: list[tuple[str, float]], unit: str = "") -> tuple[Condition, ...]:
    """Conditions: each of the named quantities is larger than the next."""
    return tuple(larger(what, a, b, unit) for a, b in zip(quantities[:-1], quantities[1:], strict=True))


def within(what: str, value: float, low: float, high: float, unit: str = "") -> Condition:
    """Condition: a number lies between two bounds."""
    if low == float("-inf"):
        criterion = f"{what} < {high:.4g}{_unit(unit)}"
    elif high == float("inf"):
        criterion = f"{what} > {low:.4g}{_unit(unit)}"
    else:
        criterion = f"{what} between {low:.4g} and {high:.4g}{_unit(unit)}"
    return Condition(criterion, f"{value:.4g}{_unit(unit)}", bool(low < value < high))


def below(what: str, value: float, bound: float, unit: str = "") -> Condition:
    """Condition: a number lies below a bound."""
    return within(what, value, float("-inf"), bound, unit)


def above(what: str, value: float, bound: float, unit: str = "") -> Condition:
    """Condition: a number lies above a bound."""
    return within(what, value, bound, float("inf"), unit)


def _unit(unit: str) -> str:
    return f" {unit}" if unit else ""


def counts(statements: list[Statement]) -> dict[str, int]:
    """How many statements got each verdict."""
    return {verdict: sum(s.verdict == verdict for s in statements) for verdict in VERDICTS}
