# SPDX-License-Identifier: MIT OR Apache-2.0
"""A number, or why there is none."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class Measured:
    """Numbers by name; `nan` where a quantity does not exist, with the reason by the same name."""

    values: dict[str, float] = field(default_factory=dict)
    reasons: dict[str, str] = field(default_factory=dict)

    def found(self, name: str, value: float) -> None:
        """A quantity that exists."""
        self.values[name] = float(value)

    def none(self, reason: str, *names: str) -> None:
        """Quantities that do not."""
        for name in names:
            self.values[name] = float("nan")
            self.reasons[name] = reason
