# SPDX-License-Identifier: MIT OR Apache-2.0
"""Reference cases: what the program says beside what is known, with a figure and a score for each."""

from .case import Case, Check, Outcome
from .find import cases, cases_folder, select
from .run import Result, run, run_all

__all__ = ["Case", "Check", "Outcome", "Result", "cases", "cases_folder", "run", "run_all", "select"]
