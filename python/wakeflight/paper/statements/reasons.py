# SPDX-License-Identifier: MIT OR Apache-2.0
"""Why a statement does not fully hold: what was looked up in the data, one sentence a row."""

REASONS: dict[tuple[str, str], str] = {}
