# SPDX-License-Identifier: MIT OR Apache-2.0
"""Linear models for python-control, which is not among the package's own dependencies."""

from __future__ import annotations

from typing import Any

from ..errors import InputError
from .response import Matrices


def control_model(system: Matrices, states: list[str], inputs: list[str], outputs: list[str]) -> Any:
    """A `control.StateSpace` with these names."""
    try:
        import control
    except ImportError as reason:
        raise InputError("to_control needs the package control (python-control): pip install control") from reason
    return control.ss(*system, states=states, inputs=inputs, outputs=outputs)
