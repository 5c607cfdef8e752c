# SPDX-License-Identifier: MIT OR Apache-2.0
"""Cockpit: the helicopter flown by hand in a browser on this machine, every flight kept as a run."""

from __future__ import annotations

from .flown import cockpit
from .session import Session, Setup, height_of

__all__ = ["Session", "Setup", "cockpit", "height_of"]
