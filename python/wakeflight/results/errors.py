# SPDX-License-Identifier: MIT OR Apache-2.0
"""What results refuse."""


class ResultsError(ValueError):
    """Arrays that do not fit the schema: names the variable, what it has and what is expected."""
