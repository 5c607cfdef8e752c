# SPDX-License-Identifier: MIT OR Apache-2.0
"""A finished study: its findings as table, Dataset and files."""

from __future__ import annotations

import csv
import io
from pathlib import Path

from ...atomic import write_text
from ...results import save
from .findings import Findings
from .table import markdown, table


class Study(Findings):
    """One discretisation of one run at several settings, coarse to fine; `.data` is its Dataset, `.table()` its text."""

    def table(self) -> str:
        """The study as text."""
        return table(self)

    def markdown(self) -> str:
        """The study as a section of a page."""
        return markdown(self)

    def save(self, folder: str | Path) -> list[Path]:
        """Write converge.nc, converge.csv and converge.md into `folder`."""
        folder = Path(folder)
        paths = [save(self.data, folder / "converge.nc")]
        stream = io.StringIO()
        csv.writer(stream, lineterminator="\n").writerows(self.rows())
        table = write_text(folder / "converge.csv", stream.getvalue())
        return [*paths, table, write_text(folder / "converge.md", self.markdown() + "\n")]
