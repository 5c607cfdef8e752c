# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a run keeps of the chain between the stick and the blades."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..sticks import INCH, STICKS
from .chain import Chain


class ControlLog:
    """Rows of a flight: the pilot's sticks, and what was added in series."""

    def __init__(self, chain: Chain | None):
        self.chain = chain
        self.rows: Any = {}

    @property
    def fields(self) -> dict[str, tuple[int, ...]]:
        """What is kept of an instant: nothing where the stick goes straight to the blades."""
        return {} if self.chain is None else {"pilot": (4,), "series": (4,)}

    def bind(self, rows: Any) -> None:
        """Arrays of the rows by name."""
        self.rows = rows

    def record(self, row: int) -> None:
        """Keep one instant."""
        if self.chain is not None:
            self.rows["pilot"][row], self.rows["series"][row] = self.chain.pilot, self.chain.series

    def pilot(self, n: int, reached: np.ndarray) -> np.ndarray:
        """Sticks (n, 4) [m] where the pilot had them, of `n` rows in which `reached` reached the blades."""
        return reached if self.chain is None else self.rows["pilot"][:n]

    def arrays(self, n: int, reached: np.ndarray) -> dict[str, np.ndarray]:
        """Variables of `n` rows; reached (n, 4) [m]: sticks that stand for where the blades were put."""
        found = dict(zip(STICKS, self.pilot(n, reached).T / INCH, strict=True))
        if self.chain is not None:
            found |= {f"sas_{name}": each for name, each in zip(STICKS, self.rows["series"][:n].T, strict=True)}
            found |= {f"actuator_{name}": each for name, each in zip(STICKS, reached.T / INCH, strict=True)}
        return found

    def attributes(self) -> dict[str, Any]:
        """Seconds at limits."""
        return {} if self.chain is None else dict(self.chain.counted())
