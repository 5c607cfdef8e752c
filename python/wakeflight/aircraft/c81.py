# SPDX-License-Identifier: MIT OR Apache-2.0
"""C81 decks in the forms in which they are passed on, read as what they say or refused with the line that does not say it.

The form: a line with a name in 30 columns and six counts of two digits (Mach numbers and angles of cl, cd, cm); then for each of
the three a line of Mach numbers and one line an angle [deg], in fields of seven columns, nine values a line. In use are also text
before the first line, counts parted by blanks, numbers parted by blanks in columns of another width, decks without moments.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

from ..errors import one_line, shortened
from ..text import lines_of, plain_number, read_text
from .airfoils import Grid, ascending, to_pi

WIDTH, MOST = 7, 9
"""Columns of a field, and values in a line beside the angle."""

NAMES = ("cl", "cd", "cm")

# the last twelve digits of a line, or six counts of their own
_COUNTS = (
    re.compile(r"(?:^|\D)" + r"(\d\d)" * 6 + r"\s*$", re.ASCII),
    re.compile(r"(?:^|\s)" + r"\s+".join([r"(\d{1,2})"] * 6) + r"\s*$", re.ASCII),
)


def read_c81(path: Path) -> tuple[dict[str, Grid], list[str]]:
    """Lift, drag and moment tables of a C81 deck {cl, cd, cm}, and what is to be warned of.

    Lines before the counts are passed over and told; a deck that counts no moments has none; numbers that the columns of the form
    would cut are read by the blanks between them, and told. ValueError says what cannot be read, and in which line.
    """
    try:
        lines = [line.expandtabs() for line in lines_of(read_text(path))]
    except ValueError as reason:
        raise ValueError(f"names the file {path}, which {reason}") from reason
    deck = _Deck(path, lines)
    grids: dict[str, Grid] = {}
    for name, n_mach, n_alpha in zip(NAMES, deck.counts[0::2], deck.counts[1::2], strict=True):
        if (n_mach == 0) != (n_alpha == 0) or (n_mach == 0 and name != "cm"):
            raise deck.wrong(deck.header, f"counts {n_mach} Mach numbers and {n_alpha} angles of {name}")
        if n_mach == 0:
            deck.notes.append(f"{path}: the deck has no cm; taken as 0, sections carry no pitching moment")
            grids[name] = {**grids["cl"], "values": [[0.0] * len(row) for row in grids["cl"]["values"]]}
            continue
        mach = deck.row(n_mach, 0, f"the {n_mach} Mach numbers of {name}")
        rows = [deck.row(n_mach, 1, f"angle {i + 1} of {n_alpha} and its {n_mach} {name}") for i in range(n_alpha)]
        grids[name] = {
            "x": [to_pi(math.radians(row[0])) for row in rows],
            "y": mach,
            "values": [row[1:] for row in rows],
        }
        try:
            ascending(name, grids[name])
        except ValueError as reason:
            raise ValueError(f"names the file {path}, of which {reason}") from reason
    deck.end()
    return grids, deck.notes


class _Deck:
    """A deck that is read line by line: where it is, how its numbers are parted, and what there is to be told."""

    def __init__(self, path: Path, lines: list[str]) -> None:
        """Find the line with the counts."""
        self.path, self.lines = path, lines
        self.notes: list[str] = []
        self.header, self.counts = self._header()
        self.at = self.header + 1
        self.by_blanks = False
        if any(line.strip() for line in lines[: self.header]):
            told = f"{self.header} lines stand before the C81 header in line {self.header + 1}; passed over"
            self.notes.append(f"{path}: {told}")

    def _header(self) -> tuple[int, list[int]]:
        """Index of the first line of the deck, and its six counts: in their columns, or where a line ends with six."""
        for at, line in enumerate(self.lines):
            fields = [line[30 + 2 * i : 32 + 2 * i].strip() for i in range(6)]
            if all(field.isascii() and field.isdecimal() for field in fields):
                return at, [int(field) for field in fields]
        for at, line in enumerate(self.lines):
            for form in _COUNTS:
                found = form.search(line[-400:])
                if found:
                    self.notes.append(f"{self.path}: the counts of the C81 header are not in columns 31 to 42")
                    return at, [int(each) for each in found.groups()]
        raise ValueError(f"names the file {self.path}, in which no line has six two-digit counts from column 31 on")

    def wrong(self, at: int, what: str) -> ValueError:
        """Error about a line of the deck."""
        return ValueError(f"names the file {self.path}, whose line {at + 1} {what}")

    def row(self, n: int, lead: int, due: str) -> list[float]:
        """The next `n` numbers over as many lines as they need, `lead` angles before them. due: for messages."""
        while self.at < len(self.lines) and not self.lines[self.at].strip():
            self.at += 1
        values: list[float] = []
        while len(values) < n + lead:
            if self.at >= len(self.lines):
                raise ValueError(f"names the file {self.path}, which ends before its tables do: {due} are due")
            values += self._line(n + lead - len(values), 0 if values else lead, due)
            self.at += 1
        return values

    def _line(self, needed: int, lead: int, due: str) -> list[float]:
        """Numbers of the line at hand: as many as its row still needs, or as a line holds."""
        line = self.lines[self.at].rstrip()
        expected = min(needed, MOST + lead)
        columns, blanks = _in_columns(line), _all([plain_number(each) for each in line.split()])
        fits = columns is not None and len(columns) == expected
        parted = blanks is not None and (len(blanks) == expected or MOST <= len(blanks) <= needed)
        if columns is not None and fits and not (parted and blanks != columns):
            return columns
        if blanks is not None and parted:
            if not self.by_blanks:
                told = (
                    f"numbers from line {self.at + 1} on are not in columns of {WIDTH}; read by the blanks between them"
                )
                self.notes.append(f"{self.path}: {told}")
            self.by_blanks = True
            return blanks
        if columns is None and blanks is None:
            raise self.wrong(self.at, f"'{shortened(one_line(line), 40)}' is not numbers; {due} are due")
        found = len(blanks if columns is None else columns)  # type: ignore[arg-type]
        counted = f"the counts of line {self.header + 1} and the table do not agree"
        raise self.wrong(self.at, f"holds {found} numbers, {expected} are due ({due}): {counted}")

    def end(self) -> None:
        """Tell what follows the tables; refuse a row that the counts leave out."""
        after = next((i for i in range(self.at, len(self.lines)) if self.lines[i].strip()), None)
        if after is None:
            return
        rest = _in_columns(self.lines[after].rstrip())
        if rest is not None and len(rest) > 1 and after == self.at:
            counted = f"the counts of line {self.header + 1} and the table do not agree"
            raise self.wrong(after, f"holds {len(rest)} numbers after the last angle of the deck: {counted}")
        self.notes.append(f"{self.path}: text after the tables, from line {after + 1} on; not used")


def _in_columns(line: str) -> list[float] | None:
    """Numbers in fields of seven columns, the first of which may be blank; None where a field is no number."""
    fields = [line[WIDTH * i : WIDTH * i + WIDTH] for i in range(MOST + 1)]
    while fields and not fields[-1].strip():
        fields.pop()
    if fields and not fields[0].strip():
        fields = fields[1:]
    return _all([plain_number(field) for field in fields])


def _all(numbers: list[float | None]) -> list[float] | None:
    """`numbers`, None where one is missing or there are none."""
    found = [each for each in numbers if each is not None]
    return found if found and len(found) == len(numbers) else None
