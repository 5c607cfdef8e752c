# SPDX-License-Identifier: MIT OR Apache-2.0
"""The report of the paper: figures beside it as files and inside it, statements, cost, the wakes in three dimensions."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...atomic import write_text
from ...export import vtk
from ...plotting.style import save
from ...report import viewer
from ...report.pages import Drawn, environment
from ...report.summary import configuration, counters, summary, warnings
from . import cost, extras, readings
from .cases import AUGMENTED, MANEUVERS, MODELS
from .figures import FIGURES
from .statements import VERDICTS, counts, judge

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from .studies import Finding

    Runs = Mapping[str, xr.Dataset]


def write(
    runs: Runs,
    out_dir: Path,
    rotor: Mapping[str, float],
    findings: Sequence[Finding] = (),
    missed: Sequence[str] = (),
) -> Path:
    """Write figures, wakes for ParaView and `report.html` into `out_dir`; returns the path of the page.

    runs: flights by case name. rotor: shaft_tilt [rad], hinge_offset, root_cutout and chord over R. findings, missed: of
    the studies, and of those that could not be finished.
    """
    shown = (*MANEUVERS, AUGMENTED)
    flights = {maneuver: {model: runs[f"{maneuver}/{model}"] for model in MODELS} for maneuver in shown}
    table, both = judge(runs), readings.judged(runs)
    figures = [_draw(f.name, f.caption, partial(f.draw, flights[f.maneuver]), out_dir) for f in FIGURES]
    figures.insert(0, _draw("figure-02", extras.SEQUENCE_CAPTION, lambda: extras.sequence(runs), out_dir))
    beyond = {
        "convergence": _draw("convergence", extras.CONVERGENCE_CAPTION, lambda: extras.convergence(runs), out_dir),
        "inflow-mean": _draw("inflow-mean", extras.INFLOW_CAPTION, lambda: extras.inflow(runs), out_dir),
        "caps": _draw("relaxation-caps", extras.CAPS_CAPTION, lambda: extras.caps(runs), out_dir),
        "readings": _draw("readings", readings.CAPTION, lambda: readings.figure(runs), out_dir),
    }
    export(flights, out_dir / "paraview")
    templates = environment("wakeflight.studies.paper", "wakeflight.report")
    first = runs["arrested-descent/relaxation"]
    page = templates.get_template("paper.html").render(
        version=first.attrs.get("program_version", ""),
        statements=table,
        verdicts=VERDICTS,
        counts=counts(table),
        readings=both,
        readings_head=readings.HEAD,
        readings_counts=[*readings.counted(both), *readings.motion(runs)],
        figures=figures,
        beyond=beyond,
        summaries={m: _side_by_side(summary, flights[m]) for m in shown},
        work={m: _side_by_side(counters, flights[m]) for m in shown},
        warnings=sorted({text for run in runs.values() for text in warnings(run)}),
        models=list(MODELS),
        cost_head=cost.HEAD,
        cost_rows=cost.table(runs),
        cap_head=cost.CAP_HEAD,
        cap_rows=cost.cap_table(runs),
        studies=[(f, _draw(f"study-{f.name}", f.done, partial(_figure_of, f), out_dir)) for f in findings],
        missed=list(missed),
        configurations={name: configuration(run) for name, run in runs.items()},
        panels=len(MODELS),
        wake_data=viewer.data(flights, rotor).replace("</", "<\\/"),
        wake_script=viewer.script(),
    )
    return write_text(out_dir / "report.html", page)


def export(flights: Mapping[str, Runs], folder: Path) -> None:
    """Wakes of the flights of the figures for ParaView, a folder with its .pvd per flight."""
    for maneuver, models in flights.items():
        for model, run in models.items():
            if "wake" in run:
                vtk.write(run, folder / maneuver / model)


def _draw(name: str, caption: str, draw: Callable[[], Figure], out_dir: Path) -> Drawn:
    path = save(draw(), out_dir / f"{name}.png")
    return Drawn(name, caption, base64.b64encode(path.read_bytes()).decode("ascii"))


def _figure_of(finding: Any) -> Figure:
    """The figure of a study."""
    figure: Figure = finding.figure
    return figure


def _side_by_side(rows_of: Callable[[xr.Dataset], Any], runs: Runs) -> list[tuple[str, list[str]]]:
    """Rows of all runs side by side; a dash where a run has none."""
    columns = [{row.label: row.value for row in rows_of(run)} for run in runs.values()]
    labels = list(dict.fromkeys(label for column in columns for label in column))
    return [(label, [column.get(label, "–") for column in columns]) for label in labels]
