# SPDX-License-Identifier: MIT OR Apache-2.0
"""Reports: the figures of a run, or of several side by side, and one self-contained page with them."""

from __future__ import annotations

from .page import write

__all__ = ["write"]
