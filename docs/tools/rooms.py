# SPDX-License-Identifier: MIT OR Apache-2.0
"""Draws the rooms of the house and who stands on whom, and fills the tables of docs/architecture.md, all from the code.

python docs/tools/rooms.py: writes docs/images/rooms.svg and the parts of docs/architecture.md between marks.
"""

from __future__ import annotations

import ast
import fnmatch
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "quality"))
from house import House, strongly_connected  # noqa: E402
from layout import placed  # noqa: E402

ROOMS = {
    "cli": ("cli", "__main__"),
    "studies": ("studies",),
    "validate": ("validate",),
    "report": ("report",),
    "plotting": ("plotting",),
    "export": ("export", "acoustics", "blade_loads"),
    "linear": ("linear", "handling"),
    "live": ("cockpit", "gym"),
    "flight": (
        "flight*",
        "recorder",
        "resuming",
        "run_attributes",
        "runlog",
        "simulation",
        "stepping",
        "snapshot",
        "integrators",
        "stick_samples",
        "transfer",
    ),
    "tunnel": ("tunnel",),
    "trim": ("trim",),
    "exchange": ("exchange", "wind"),
    "model": ("model", "modes", "vortex", "wing", "airfoil_loop"),
    "monitors": ("monitors", "limits"),
    "aircraft": ("aircraft", "thinning", "file_schemas"),
    "inputs": (
        "condition",
        "inflow",
        "maneuver*",
        "options",
        "presets",
        "regime",
        "rotor_speed",
        "engine",
        "units",
        "stick*",
        "perturbation",
    ),
    "results": ("results",),
    "basics": (
        "errors",
        "attitude",
        "arguments",
        "atomic",
        "folder_lock",
        "interruption",
        "text",
        "references",
        "progress",
        "views",
    ),
}
"""Rooms of Python and the modules in them; a module that is in none is a room of its own."""

MEANING = {
    "live": "flights while they are flown: a cockpit in a browser, an environment for learning controllers",
    "flight": "a simulation stepped, kept and continued; a manoeuvre flown with it; integrators, what is recorded",
    "linear": "linear models about a trim: derivatives, periodic and constant systems, modes, reduction; handling qualities",
    "trim": "the state in which the aircraft stays: unknowns, equations, free wake in the loop",
    "exchange": "what blades and wake give each other at every azimuth step",
    "model": "what is compiled of aircraft, condition and inflow; blade modes; vortices, wings and sections by themselves",
    "monitors": "what is watched of a result, and its limits",
    "inputs": "condition, inflow models and their options, manoeuvres, units: what a user states",
    "basics": "errors, arguments checked by their annotations, files read safely, bibliography, progress, tables for notebooks",
    "_core": "the border: shapes and numbers checked, nothing calculated",
}
"""Rooms whose text is not that of a package."""

BEFORE = {
    "places that tell one wake option (with its command-line flag)": "14 (26)",
    "lines of bindings and stub": 2462,
    "lines of stand, trim, exchange and flight in Python": 3590,
    "the same with what they report": 4168,
    "places that tell kinds apart": 62,
    "import circles, annotations included": 12,
    "functions allowed many arguments": 27,
    "source files over 500 lines": 6,
    "wrong shapes that panic": 3,
}
"""As counted by this script at commit 84bfc97; the first and the last by hand."""

BY_HAND = {
    "places that tell one wake option (with its command-line flag)": "2 (2)",
    "wrong shapes that panic": 0,
}
"""Now: the first counted by hand, the second held by `tests/unit/test_border.py`."""


def room_of(module: str) -> str:
    """Room of a Python module."""
    head = module.split(".")[0]
    return next((room for room, patterns in ROOMS.items() if any(fnmatch.fnmatch(head, p) for p in patterns)), head)


def python_rooms(house: House) -> dict[str, set[str]]:
    """Rooms of Python and the rooms they import; the compiled core is one more."""
    rooms: dict[str, set[str]] = {}
    for module, imported in house.imports.items():
        if module:
            rooms.setdefault(room_of(module), set()).update(room_of(each) for each in imported if each)
            if re.search(
                r"^\s*from \.+ ?import [^\n]*_core|^\s*from \.+_core", house.modules[module].read_text(), re.M
            ):
                rooms[room_of(module)].add("_core")
    return {room: used - {room} for room, used in rooms.items()}


def rust_rooms(house: House) -> dict[str, set[str]]:
    """Rooms of Rust and the rooms they use."""
    rooms: dict[str, set[str]] = {}
    for module, used in house.rust_uses.items():
        if module:
            head = module.split("::")[0]
            rooms.setdefault(head, set()).update(each.split("::")[0] for each in used)
    return {room: used - {room} for room, used in rooms.items()}


def binding_rooms(house: House, rust: dict[str, set[str]]) -> set[str]:
    """Rooms of Rust that the bindings name."""
    text = "\n".join(path.read_text() for path in house.bindings.rglob("*.rs"))
    return {room for room in rust if re.search(rf"\bwakeflight::{room}\b|\b{room}::", text)}


def reduced(graph: dict[str, set[str]]) -> dict[str, set[str]]:
    """The arrows that do not follow from others: a stands on c through b."""

    def below(node: str, seen: set[str]) -> set[str]:
        for each in graph.get(node, ()):
            if each not in seen:
                seen.add(each)
                below(each, seen)
        return seen

    return {
        node: {each for each in used if not any(each in below(other, set()) for other in used - {each})}
        for node, used in graph.items()
    }


def meaning_of(house: House, room: str, rust: bool) -> str:
    """What a room is, from the head of its code."""
    if not rust and room in MEANING:
        return MEANING[room]
    if rust:
        path = house.rust / room / "mod.rs"
        path = path if path.is_file() else house.rust / f"{room}.rs"
        lines = [line[3:].strip() for line in path.read_text().splitlines() if line.startswith("//!")]
        text = " ".join(lines[: lines.index("")] if "" in lines else lines)
    else:
        path = house.python / room / "__init__.py"
        path = path if path.is_file() else house.python / f"{room}.py"
        text = (ast.get_docstring(ast.parse(path.read_text())) or "").split("\n\n")[0].replace("\n", " ")
    return re.split(r"(?<=[a-z\])])\. ", text)[0].rstrip(".")


def draw(house: House, path: Path) -> None:
    """The drawing: Python above, the border, Rust below; an arrow says that a room stands on another."""
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
    from matplotlib.path import Path as Line

    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "rooms", "font.family": "sans-serif"})
    python, rust = python_rooms(house), rust_rooms(house)
    graph = {room: set(used) for room, used in python.items()}
    graph |= {"_core": {f"{room} " for room in binding_rooms(house, rust)}}
    # a blank tells a room of Rust from one of Python of the same name
    graph |= {f"{room} ": {f"{each} " for each in used} for room, used in rust.items()}
    circles = {room: k for k, group in enumerate(strongly_connected(graph)) for room in group}
    back = {(a, b) for a, used in graph.items() for b in used if circles[a] == circles[b]}
    acyclic = {a: {b for b in used if (a, b) not in back} for a, used in graph.items()}
    places, routes = placed(reduced(acyclic))
    width = max(x for x, _ in places.values()) + 1.0
    height = max(y for _, y in places.values()) + 1.0
    figure, axes = plt.subplots(figsize=(1.15 * width + 0.6, 0.78 * height + 0.4))
    colours = {"python": ("#e8f0fa", "#2b5d94"), "border": ("#f3e9d2", "#8a6d1f"), "rust": ("#f8e4dc", "#a2431b")}
    for _, corners in sorted(routes.items()):
        axes.add_patch(
            FancyArrowPatch(
                path=_curve(corners, Line),
                arrowstyle="-|>",
                mutation_scale=8,
                color="#777777",
                linewidth=0.8,
                zorder=1,
            )
        )
    for start, end in sorted(back):
        if start < end or (end, start) not in back:
            axes.annotate(
                "",
                xy=places[end],
                xytext=places[start],
                arrowprops={
                    "arrowstyle": "<|-|>",
                    "color": "#c00000",
                    "linewidth": 1.0,
                    "connectionstyle": "arc3,rad=0.15",
                },
                zorder=2,
            )
    for room, (x, y) in sorted(places.items()):
        kind = "border" if room == "_core" else ("rust" if room.endswith(" ") else "python")
        face, edge = colours[kind]
        box = FancyBboxPatch(
            (x - 0.44, y - 0.2),
            0.88,
            0.4,
            boxstyle="round,pad=0,rounding_size=0.08",
            facecolor=face,
            edgecolor=edge,
            zorder=3,
        )
        axes.add_patch(box)
        axes.text(x, y, "bindings" if room == "_core" else room.strip(), ha="center", va="center", fontsize=9, zorder=4)
    names = {"Python": "python", "border": "border", "Rust": "rust"}
    for k, (name, kind) in enumerate(names.items()):
        axes.text(0.0 + 0.9 * k, height - 0.55, name, color=colours[kind][1], fontsize=10, fontweight="bold", ha="left")
    axes.set(xlim=(-0.6, width - 0.4), ylim=(-0.5, height - 0.2))
    axes.axis("off")
    axes.set_aspect("auto")
    figure.subplots_adjust(0.0, 0.0, 1.0, 1.0)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None, dpi=110)
    plt.close(figure)


def _curve(corners, line):
    """Smooth line through the corners of a route, from the lower edge of a box to the upper edge of another."""
    points = [(corners[0][0], corners[0][1] - 0.2), *corners[1:-1], (corners[-1][0], corners[-1][1] + 0.22)]
    vertices, codes = [points[0]], [line.MOVETO]
    for (x0, y0), (x1, y1) in zip(points, points[1:], strict=False):
        half = 0.5 * (y0 - y1)
        vertices += [(x0, y0 - half), (x1, y1 + half), (x1, y1)]
        codes += [line.CURVE4] * 3
    return line(vertices, codes)


def rooms_table(house: House) -> str:
    """Rooms with what they are, those that others stand on last."""
    python, rust = python_rooms(house), rust_rooms(house)
    rows = ["| room of Python | what it is |", "|---|---|"]
    rows += [f"| `{room}` | {meaning_of(house, room, False)} |" for room in ordered(python) if room != "_core"]
    rows += [f"| bindings | {MEANING['_core']} |", "", "| room of Rust | what it is |", "|---|---|"]
    rows += [f"| `{room}` | {meaning_of(house, room, True)} |" for room in ordered(rust)]
    return "\n".join(rows)


CITATION = re.compile(r"\[([a-z]{2,}[a-z_]*(?:19|20)\d\d[a-z]?)(?:,[^\]\n]*)?\]")


def equations_table(house: House) -> str:
    """Files that cite a source, with what they hold, by room from the ground up."""
    rows = ["| file | what it holds | source |", "|---|---|---|"]
    found = []
    for path in [*house.rust_files, *house.python_files]:
        text = path.read_text()
        cited = sorted(set(re.findall(CITATION, text.split("#[cfg(test)]")[0])))
        if not cited:
            continue
        if path.suffix == ".rs":
            lines = [line[3:].strip() for line in text.splitlines() if line.startswith("//!")]
            head = " ".join(lines[: lines.index("")] if "" in lines else lines)
            place = ordered(rust_rooms(house))[::-1]
            order = (0, place.index(path.relative_to(house.rust).parts[0].removesuffix(".rs")))
        else:
            head = (ast.get_docstring(ast.parse(text)) or "").split("\n\n")[0].replace("\n", " ")
            order = (1, 0)
        head = re.sub(CITATION, "", head).strip()
        what = re.split(r"(?<=[a-z\])])[.:] ", head)[0].rstrip(" .,")
        name = house.name(path).removeprefix("crates/wakeflight/src/").removeprefix("python/wakeflight/")
        found.append((order, name, f"| `{name}` | {what} | {', '.join(cited)} |"))
    return "\n".join([*rows, *(row for _, _, row in sorted(found))])


def ordered(graph: dict[str, set[str]]) -> list[str]:
    """Rooms from the top of the house to its ground."""
    groups = strongly_connected(graph)
    placed_at = {room: k for k, group in enumerate(groups) for room in group}
    depth: dict[str, int] = {}

    def level(room: str) -> int:
        if room not in depth:
            depth[room] = 0
            depth[room] = 1 + max(
                (level(each) for each in graph.get(room, ()) if placed_at[each] != placed_at[room]), default=0
            )
        return depth[room]

    return sorted(graph, key=lambda room: (-level(room), room))


def numbers_table(house: House) -> str:
    """House numbers before and now."""
    now = {
        **BY_HAND,
        "lines of bindings and stub": house.lines_of_bindings,
        "lines of stand, trim, exchange and flight in Python": house.lines_of_verbs,
        "the same with what they report": house.lines_of_verbs_whole,
        "places that tell kinds apart": len(house.kinds_told_apart),
        "import circles, annotations included": len(house.python_circles) + len(house.rust_circles),
        "functions allowed many arguments": sum(n for name, n in house.many_arguments if "/src/" in name),
        "source files over 500 lines": len(house.long_files),
    }
    rows = ["| | before | now |", "|---|---|---|"]
    rows += [f"| {name} | {before} | {now[name]} |" for name, before in BEFORE.items()]
    return "\n".join(rows)


def filled(page: str, name: str, content: str) -> str:
    """The page with what stands between its marks `name` renewed."""
    start, end = f"<!-- {name}: made by docs/tools/rooms.py -->", f"<!-- end of {name} -->"
    head, rest = page.split(start)
    return f"{head}{start}\n{content}\n{end}{rest.split(end)[1]}"


def main() -> None:
    """Write drawing and page."""
    house = House(ROOT)
    draw(house, ROOT / "docs" / "images" / "rooms.svg")
    path = ROOT / "docs" / "architecture.md"
    page = path.read_text(encoding="utf-8")
    page = filled(page, "rooms", rooms_table(house))
    page = filled(page, "equations", equations_table(house))
    page = filled(page, "numbers", numbers_table(house))
    path.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
