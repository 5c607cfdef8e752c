# SPDX-License-Identifier: MIT OR Apache-2.0
"""One self-contained page of all cases: the score of each on top, then figure, numbers and plain words."""

from __future__ import annotations

import html
import re
from collections.abc import Sequence
from pathlib import Path

from ..atomic import write_text
from ..report.pages import environment
from .case import Check
from .run import Result


def write(results: Sequence[Result], path: Path) -> Path:
    """Write the page of `results`."""
    from markupsafe import Markup

    templates = environment("wakeflight.validate")
    templates.filters |= {"number": number, "difference": difference, "tolerance": tolerance}
    templates.filters["words"] = lambda text: Markup(words(text))
    groups: dict[str, list[Result]] = {}
    for result in results:
        groups.setdefault(result.case.group, []).append(result)
    counts = {word: sum(r.verdict == word for r in results) for word in _VERDICTS}
    text = templates.get_template("validation.html").render(
        groups=groups, counts=counts, n=len(results), seconds=sum(r.seconds for r in results)
    )
    return write_text(path, text)


_VERDICTS = ("within", "partly within", "outside", "shown", "failed", "waits")


def number(value: float) -> str:
    """Six significant digits."""
    return f"{value:.6g}"


def difference(check: Check) -> str:
    """Difference as the tolerance is stated: per cent where relative, but powers of ten where tiny."""
    value = check.difference
    if check.kind == "relative":
        return f"{100 * value:+.2f} %" if abs(value) >= 1e-4 else f"{value:+.1e} rel."
    return f"{value:+.3g}"


def tolerance(check: Check) -> str:
    """Tolerance as it is stated."""
    if not check.gate:
        return "none stated"
    if check.kind == "relative":
        return f"{100 * check.tolerance:g} %" if check.tolerance >= 1e-4 else f"{check.tolerance:.0e} rel."
    return f"{check.tolerance:g}"


def words(text: str) -> str:
    """The little Markdown that a README uses: headings, paragraphs, lists, emphasis, code."""
    blocks: list[str] = []
    rows: list[str] = []

    def inline(line: str) -> str:
        line = html.escape(line, quote=False)
        line = re.sub(r"`([^`]+)`", r"<code>\1</code>", line)
        return re.sub(r"\*\*([^*]+)\*\*", r"<strong>\1</strong>", line)

    def flush() -> None:
        if rows and rows[0].startswith("- "):
            items = re.split(r"(?:^|\n)- ", "\n".join(rows))[1:]
            blocks.append("<ul>" + "".join(f"<li>{inline(' '.join(item.split()))}</li>" for item in items) + "</ul>")
        elif rows and rows[0].startswith("|"):
            cells = [[c.strip() for c in row.strip().strip("|").split("|")] for row in rows]
            cells = [row for row in cells if not all(re.fullmatch(r":?-+:?", c) for c in row)]
            body = "".join("<tr>" + "".join(f"<td>{inline(c)}</td>" for c in row) + "</tr>" for row in cells)
            blocks.append(f"<table>{body}</table>")
        elif rows:
            blocks.append(f"<p>{inline(' '.join(rows))}</p>")
        rows.clear()

    for line in text.splitlines():
        if line.startswith("#"):
            flush()
            level = len(line) - len(line.lstrip("#"))
            if level > 1:  # the title stands above already
                blocks.append(f"<h4>{inline(line.lstrip('# '))}</h4>")
        elif not line.strip():
            flush()
        else:
            if line.startswith("- ") and rows and not rows[0].startswith("- "):
                flush()
            rows.append(line.strip() if not line.startswith("- ") else line)
    flush()
    return "\n".join(blocks)
