# SPDX-License-Identifier: MIT OR Apache-2.0
"""A finished study: its findings as table, Dataset and files."""

from __future__ import annotations

import csv
from pathlib import Path

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
        path = folder / "converge.csv"
        with path.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerows(self.rows())
        page = folder / "converge.md"
        page.write_text(self.markdown() + "\n", encoding="utf-8")
        return [*paths, path, page]
