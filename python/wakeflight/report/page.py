# SPDX-License-Identifier: MIT OR Apache-2.0
"""One self-contained HTML page of a run or of several: summary, figures, configuration; nothing fetched."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ..atomic import write_text
from ..errors import WakeflightError, one_line
from ..plotting import COMPARISONS, FIGURES, Plot
from ..plotting.shown import check_units
from ..plotting.style import looks, save
from ..progress import Progress, Reported, Silent, heard
from ..results import by_name
from ..results import drawn as drawn_there
from . import viewer
from .pages import Drawn, environment
from .summary import Row, configuration, counters, physics, summary, trim_table, warnings, watched

if TYPE_CHECKING:
    import xarray as xr


DASHES = {"-": "none", "--": "8 3", "-.": "8 3 2 3", ":": "2 3"}
"""Lines of figures as a page draws them."""


def write(
    runs: xr.Dataset | Mapping[str, xr.Dataset],
    out_dir: str | Path,
    trim: xr.Dataset | None = None,
    progress: Reported = None,
    figure_format: str = "png",
    units: str = "si",
) -> Path:
    """Write the figures (PNG) and `report.html` of one run, or of several by name, into `out_dir`.

    With several runs, histories are drawn over each other and maps side by side. `trim` adds the table of the
    trim's sticks, attitude and residuals. figure_format: `svg` and `pdf` are written beside the PNG files. units: `si`,
    or `us` for knots, feet, pounds and horsepower. Returns the path of the page.
    """
    out_dir, units = Path(out_dir), check_units(units)
    named = by_name(runs)
    first = next(iter(named.values()))
    several = runs is not first
    templates = environment("wakeflight.report")
    plots = COMPARISONS if several else FIGURES
    formats = dict.fromkeys(("png", figure_format))
    drawn_there(out_dir, [*(f"{plot.name}.{each}" for plot in plots for each in formats), "report.html"])
    figures, missed = _figures(plots, named if several else first, out_dir, heard(progress), (figure_format, units))
    viewable = viewer.viewable(named)
    page = templates.get_template("report.html").render(
        title=_title(first, several),
        names=list(named),
        several=several,
        looks={name: (color, DASHES[line]) for name, (color, line) in looks(named).items()} if several else {},
        failures={name: run.attrs["failure"] for name, run in named.items() if not run.attrs.get("finished", 1)},
        warnings=[*_common(warnings, named), *missed],
        flown=_join(partial(physics, units=units), named),
        tables=_tables(named, trim, units),
        panels=len(named) if viewable else 0,
        wake_data=viewer.data({str(first.attrs.get("maneuver", "flight")): named}, viewer.rotor(first)).replace(
            "</", "<\\/"
        )
        if viewable
        else "{}",
        wake_script=viewer.script() if viewable else "",
        figures=figures,
        configurations={name: configuration(run) for name, run in named.items()},
        version=first.attrs.get("program_version", ""),
    )
    return write_text(out_dir / "report.html", page)


def _title(run: xr.Dataset, several: bool) -> str:
    flight = str(run.attrs.get("maneuver", "flight")).replace("-", " ")
    model = "inflow models compared" if several else f"{run.attrs.get('inflow_model', '')} inflow"
    return f"{run.attrs.get('aircraft', '')}: {flight}, {model}"


def _tables(
    named: Mapping[str, xr.Dataset], trim: xr.Dataset | None, units: str
) -> dict[str, list[tuple[str, list[str]]]]:
    """Tables of the page: title -> rows of a label and one cell per run."""
    tables = {
        "Summary": _join(partial(summary, units=units), named),
        "Monitors": _join(partial(watched, units=units), named),
        "Work done": _join(counters, named),
    }
    if trim is not None:
        tables["Trim"] = [(row.label, [row.value]) for row in trim_table(trim)]
    return tables


def _join(rows_of: Callable[..., list[Row]], named: Mapping[str, xr.Dataset]) -> list[tuple[str, list[str]]]:
    """Rows of all runs side by side, in the order they first appear; a dash where a run has none."""
    columns: list[list[Row]] = [rows_of(run) for run in named.values()]
    labels = list(dict.fromkeys(row.label for column in columns for row in column))
    cells = [{row.label: row.value for row in column} for column in columns]
    return [(label, [cell.get(label, "–") for cell in cells]) for label in labels]


def _common(texts_of: Callable[..., list[str]], named: Mapping[str, xr.Dataset]) -> list[str]:
    """Texts of all runs, each once, with the runs it belongs to where that is not all of them."""
    found: dict[str, list[str]] = {}
    for name, run in named.items():
        for text in texts_of(run):
            found.setdefault(text, []).append(name)
    return [text if len(of) == len(named) else f"{text} ({', '.join(of)})" for text, of in found.items()]


def _figures(
    plots: tuple[Plot, ...], data: object, out_dir: Path, progress: Progress | Silent, form: tuple[str, str]
) -> tuple[list[Drawn], list[str]]:
    """Draw what can be drawn from the data, write each as PNG and keep it for the page; and what is to be said of others.

    form: format of files beside the PNG, and units.

    Numbers are safe before anything is drawn: whatever stops a figure stops that figure alone, but for a disk that is full.
    """
    drawn, missed, (figure_format, units) = [], [], form
    progress.phase("figures", len(plots))
    for plot in plots:
        try:
            if not plot.drawable(data):
                continue
            figure = plot.draw(data, units)
            path = save(figure, out_dir / f"{plot.name}.png")
            if figure_format != "png":
                save(figure, out_dir / f"{plot.name}.{figure_format}")
        except WakeflightError:
            raise
        except Exception as reason:
            missed.append(f"figure {plot.name} could not be drawn: {type(reason).__name__}: {one_line(str(reason))}")
            continue
        finally:
            progress.advance(1, plot.name)
        drawn.append(Drawn(plot.name, plot.caption, base64.b64encode(path.read_bytes()).decode("ascii")))
    return drawn, missed
