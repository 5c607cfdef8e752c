"""Is the house in order: imports point one way, public names are documented, sources are known."""

import ast
import re
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from house import House, expanded, strongly_connected

ROOT = Path(__file__).resolve().parents[2]
RUST = ROOT / "crates" / "wakeflight" / "src"
PYTHON = ROOT / "python" / "wakeflight"

# each room may use itself and the rooms before it
RUST_ORDER = (
    "numerics",
    "atmosphere",
    "airfoil",
    "vortex",
    "wake",
    "inflow",
    "blade",
    "rotor",
    "wind",
    "airframe",
    "trim",
    "control",
    "system",
    "integrate",
)

# each module may import itself and the rows before its own; a new module needs its place here
PYTHON_ORDER = (
    {"_core"},
    {"errors"},
    {"atomic", "interruption", "folder_lock"},
    {"arguments", "text"},
    {"results", "regime", "views"},
    {"units", "references", "vortex", "progress", "limits", "sticks", "runlog", "attitude"},
    {"options", "control", "stick_histories", "stick_records", "perturbation"},
    {"presets"},
    {"condition", "inflow", "maneuvers", "wing", "monitors", "snapshot", "rotor_speed"},
    {"aircraft", "thinning", "engine", "stick_samples", "maneuver_files"},
    {"model", "modes", "airfoil_loop", "file_schemas", "acoustics", "stick_inputs"},
    {"wind"},
    {"integrators", "exchange"},
    {"trim", "stepping"},
    {"flight_start", "run_attributes"},
    {"simulation"},
    {"recorder", "transfer"},
    {"flight_monitors"},
    {"flight_input"},
    {"flight_folder", "blade_loads"},
    {"flight", "tunnel"},
    {"flight_by_hand"},
    {"resuming"},
    {"cockpit", "gym"},
    {"linear"},
    {"handling"},
    {"sweep"},
    {"plotting", "export"},
    {"report"},
    {"studies"},
    {"validate"},
    {"cli"},
    {"__main__"},
)

SOURCES = [
    path
    for folder in ("crates", "python", "tests", "benchmarks", "examples", "validation", "docs", ".ci")
    for path in sorted((ROOT / folder).rglob("*"))
    if path.is_file() and "__pycache__" not in path.parts
]
HOUSE_FILES = [
    path for path in ROOT.iterdir() if path.is_file() and path.suffix in {".md", ".toml", ".cff", ".txt", ""}
]
PYTHON_FILES = sorted(PYTHON.rglob("*.py"))
RUST_FILES = sorted(RUST.rglob("*.rs"))


def name_of(path):
    return str(path.relative_to(ROOT))


def rust_room(path):
    return path.relative_to(RUST).parts[0].removesuffix(".rs")


def test_there_is_something_to_check():
    # a test that finds no file would pass whatever the house looks like
    assert len(RUST_FILES) > 10
    assert len(PYTHON_FILES) > 10


def rust_uses(text):
    """Rooms that Rust source names, tests within the file left out."""
    code = re.sub(r"//.*", "", text.split("#[cfg(test)]")[0])
    for block in re.findall(r"crate::\{(.*?)\};", code, re.DOTALL):
        depth_one = re.sub(r"\{[^{}]*\}", "", block)
        yield from re.findall(r"(?:^|,)\s*(\w+)", depth_one)
    yield from re.findall(r"crate::(\w+)", code)
    yield from re.findall(r"super::super::(\w+)", code)


def test_rust_imports_are_found_in_every_form():
    text = "use crate::vortex::core;\nuse crate::{wake::{a, b}, blade};\n// crate::x\n#[cfg(test)] crate::x"
    assert sorted(rust_uses(text)) == ["blade", "vortex", "wake"]


@pytest.mark.parametrize("path", [p for p in RUST_FILES if p.name != "lib.rs"], ids=name_of)
def test_rust_imports_point_down(path):
    room = rust_room(path)
    assert room in RUST_ORDER, f"{room} has no place in the order of rooms"
    allowed = set(RUST_ORDER[: RUST_ORDER.index(room) + 1])
    above = {used for used in rust_uses(path.read_text()) if used in RUST_ORDER} - allowed
    assert not above, f"{name_of(path)} uses {sorted(above)}, which stand above {room}"


def python_row(module):
    rows = [k for k, row in enumerate(PYTHON_ORDER) if module in row]
    assert rows, f"{module} has no place in the order of modules"
    return rows[0]


def python_imports(path):
    """Top-level modules of the package that a file imports, inside functions too."""
    package = path.relative_to(PYTHON).parts[:-1]
    tree = ast.parse(path.read_text())
    # names used in annotations alone are not imported when the program runs
    annotations = [
        node for node in ast.walk(tree) if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
    ]
    skipped = {id(inner) for node in annotations for inner in ast.walk(node)}
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        if isinstance(node, ast.ImportFrom):
            if node.level:
                base = package[: len(package) - (node.level - 1)]
                full = [*base, *(node.module.split(".") if node.module else [])]
                yield from [full[0]] if full else [alias.name for alias in node.names]
            elif node.module and node.module.split(".")[0] == "wakeflight":
                parts = node.module.split(".")[1:]
                yield from parts[:1] or [alias.name for alias in node.names]
        elif isinstance(node, ast.Import):
            for alias in node.names:
                parts = alias.name.split(".")
                if parts[0] == "wakeflight" and len(parts) > 1:
                    yield parts[1]


@pytest.mark.parametrize("path", [p for p in PYTHON_FILES if p.parent != PYTHON or p.stem != "__init__"], ids=name_of)
def test_python_imports_point_down(path):
    module = path.relative_to(PYTHON).parts[0].removesuffix(".py")
    row = python_row(module)
    above = {used for used in python_imports(path) if used != module and python_row(used) >= row}
    assert not above, f"{name_of(path)} imports {sorted(above)}, which do not stand below {module}"


@pytest.mark.parametrize("path", PYTHON_FILES, ids=name_of)
def test_every_public_python_name_is_documented(path):
    tree = ast.parse(path.read_text())
    assert ast.get_docstring(tree), f"{name_of(path)} does not say what it is"
    definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
    classes = [node for node in tree.body if isinstance(node, ast.ClassDef) and not node.name.startswith("_")]
    bare = [
        f"{getattr(holder, 'name', '')}.{node.name}".strip(".")
        for holder in (tree, *classes)
        for node in holder.body
        if isinstance(node, definition) and not node.name.startswith("_") and not ast.get_docstring(node)
    ]
    assert not bare, f"{name_of(path)}: no docstring on {bare}"


def test_rust_documentation_is_demanded_by_the_compiler():
    assert "missing_docs" in (ROOT / "Cargo.toml").read_text()
    assert "-D missing_docs" in (ROOT / "Makefile").read_text()


CITATION = re.compile(r"\[([a-z]{2,}[a-z_]*(?:19|20)\d\d[a-z]?)(?:,[^\]\n]*)?\]")


def test_citations_are_recognised():
    text = "as in [bagai1995, Eq. 12] and [ribera2004]; not [1/rev], [m], `a[2004]`"
    assert CITATION.findall(text) == ["bagai1995", "ribera2004"]


def test_every_citation_key_is_in_the_bibliography():
    cited = {}
    for path in [*RUST_FILES, *PYTHON_FILES]:
        for key in CITATION.findall(path.read_text()):
            cited.setdefault(key, name_of(path))
    bibliography = PYTHON / "references.bib"
    assert bibliography.is_file(), f"cited without a bibliography: {cited}"
    known = set(re.findall(r"@\w+\s*\{\s*([^,\s]+)", bibliography.read_text()))
    unknown = {key: where for key, where in cited.items() if key not in known}
    assert not unknown, f"not in references.bib: {unknown}"


HOUSE = House()

# what is not yet as it should be, file by file: entries go, none come
LONG: set[str] = set()
CIRCLES: tuple[set[str], ...] = ()
KINDS = {
    "python/wakeflight/cli/__init__.py": 1,
    "python/wakeflight/studies/converge/__init__.py": 1,
    "python/wakeflight/validate/case.py": 1,
}
ARITHMETIC = {"blade.rs": 1}


def test_no_source_file_is_over_500_lines():
    assert not set(HOUSE.long_files) - LONG


def test_no_modules_import_one_another_in_a_circle():
    # annotations included: what a module must know to be read is what it depends on
    circles = [set(group) for group in (*HOUSE.python_circles, *HOUSE.rust_circles)]
    assert not [sorted(group) for group in circles if not any(group <= known for known in CIRCLES)]


def test_circles_are_found():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}
    assert sorted(map(sorted, strongly_connected(graph))) == [["a", "b", "c"], ["d"]]
    assert sorted(expanded("a::{b, c::{d, e as f}}")) == ["a::b", "a::c::d", "a::c::e"]


def test_nothing_tells_kinds_apart_but_the_place_that_builds_them():
    found = {}
    for file, line, text in HOUSE.kinds_told_apart:
        found.setdefault(file, []).append((line, text))
    assert not {file: places for file, places in found.items() if len(places) > KINDS.get(file, 0)}


def test_bindings_hold_no_arithmetic():
    found = {}
    for file, line in HOUSE.arithmetic_in_bindings:
        found.setdefault(file, []).append(line)
    assert not {file: lines for file, lines in found.items() if len(lines) > ARITHMETIC.get(file, 0)}


def test_python_files_name_their_licence_first():
    line = "# SPDX-License-Identifier: MIT OR Apache-2.0\n"
    bare = [name_of(path) for path in PYTHON_FILES if not path.read_text().startswith(line)]
    assert not bare


def test_no_file_names_a_path_of_one_machine():
    machine = re.compile(r"(?<![\w.$}/-])/(?:home|Users|root|work|workspace|mnt|tmp)/[\w.-]+")
    text = {".py", ".pyi", ".rs", ".toml", ".md", ".csv", ".cff", ".txt", ".html", ".bib", ""}
    found = {}
    for path in [*SOURCES, *HOUSE_FILES]:
        if path.suffix in text and path.name != ".git":
            hits = machine.findall(path.read_text(errors="ignore"))
            if hits:
                found[name_of(path)] = hits[:3]
    assert not found


def test_the_machine_path_rule_bites():
    # built from parts, so that this file does not name one itself
    machine = "/" + "home/somebody/data.csv"
    assert re.search(r"(?<![\w.$}/-])/(?:home|Users)/[\w.-]+", f'open("{machine}")')


def test_the_page_at_the_door_is_short():
    assert (ROOT / "README.md").read_text().count("\n") < 80
