# SPDX-License-Identifier: MIT OR Apache-2.0
"""Studies: many runs and what follows from them. Beside the verbs, on which they stand; all run their cases in one way."""

from __future__ import annotations

from .case import Case, Done, Trims, attempt, run, several

__all__ = ["Case", "Done", "Trims", "attempt", "run", "several"]
