# SPDX-License-Identifier: MIT OR Apache-2.0
"""What results refuse."""

from ..errors import InputError


class ResultsError(InputError):
    """Arrays that do not fit the schema, or a file that holds no result: names the variable or file, and what is expected."""
