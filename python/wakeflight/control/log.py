# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a run keeps of the chain between the stick and the blades."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..sticks import INCH, STICKS
from .chain import Chain


class ControlLog:
    """Rows of a flight: the pilot's sticks, and what was added in series."""

    def __init__(self, chain: Chain | None, n: int):
        self.chain = chain
        self.pilot = np.empty((n, 4))
        self.series = np.empty((0 if chain is None else n, 4))

    def record(self, row: int, stick: np.ndarray) -> None:
        """Keep one instant; stick (4,) [m]: what reaches the blades."""
        if self.chain is None:
            self.pilot[row] = stick
        else:
            self.pilot[row], self.series[row] = self.chain.pilot, self.chain.series

    def arrays(self, n: int, reached: np.ndarray) -> dict[str, np.ndarray]:
        """Variables of `n` rows; reached (n, 4) [m]: sticks that stand for where the blades were put."""
        found = dict(zip(STICKS, self.pilot[:n].T / INCH, strict=True))
        if self.chain is not None:
            found |= {f"sas_{name}": each for name, each in zip(STICKS, self.series[:n].T, strict=True)}
            found |= {f"actuator_{name}": each for name, each in zip(STICKS, reached.T / INCH, strict=True)}
        return found

    def attributes(self) -> dict[str, Any]:
        """Seconds at limits."""
        return {} if self.chain is None else dict(self.chain.counted())
