# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight modes`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from .groups import AircraftName, AllowOutside, Out
from .outcome import folder_made
from .request import writable


def modes(
    aircraft: AircraftName = "uh60a",
    n_modes: Annotated[int | None, typer.Option("--modes", help="number of modes; the aircraft's own")] = None,
    allow_outside: AllowOutside = False,
    out: Out = None,
) -> None:
    """Print blade frequencies and what each mode is made of, compare with references, draw shapes and fan plot."""
    from ..aircraft import load_aircraft

    loaded = load_aircraft(aircraft, allow_outside=allow_outside)
    if n_modes is not None and not 1 <= n_modes <= 12:
        raise InputError.of("--modes", n_modes, "must lie between 1 and 12")
    folder = writable(out or Path("runs/modes"))
    from ..modes import blade_modes, fan, fan_reference, reference_table
    from ..plotting import modes as drawing
    from ..plotting import style

    found = blade_modes(loaded, n_modes=n_modes)
    print(found.table())
    if n_modes is None:
        # as many as the references list
        compared = reference_table(loaded, blade_modes(loaded, n_modes=7))
        if compared is not None:
            print(compared)
    radius = float(loaded.rotor.radius)
    shapes = found.shapes
    figure = drawing.shapes(
        found.radius / radius, shapes["flap"], shapes["lead"], shapes["twist"], found.frequencies, radius, found.labels
    )
    style.save(figure, folder_made(folder) / "modes.png")
    style.save(drawing.fan_plot(*fan(loaded, n_modes or 7), fan_reference(loaded)), folder / "fan-plot.png")
    print(f"wrote {folder / 'modes.png'} and {folder / 'fan-plot.png'}")
