# SPDX-License-Identifier: MIT OR Apache-2.0
"""Files come in one way: plain, of bounded size, text of a known encoding, no name that leads elsewhere, nothing told of them."""

import ast
import codecs
import os
import shutil
from pathlib import Path

import pytest

import wakeflight as wf
from wakeflight import text

PACKAGE = Path(wf.__file__).parent
SECRET = "0.123456789"
ROTOR = """format = 1
name = "rotor"
[rotor]
n_blades = 2
radius = "1 m"
omega = "100 rad/s"
[rotor.blade]
root = "clamped"
flexible = false
root_station = "0 m"
root_cutout = "0.1 m"
geometry = { columns = { r_R = [0, 1], chord_m = [0.1, 0.1], twist_deg = [0, 0] } }
[rotor.airfoil]
name = "section"
cl = { table = "%s" }
cd = { table = "cd.csv" }
"""
LIFT = "alpha_deg,M0\n-180,0\n-90,0\n-10,-1\n10,1\n90,0\n180,0\n"
DRAG = "alpha_deg,M0\n-180,0.02\n-90,1.8\n-10,0.02\n10,0.02\n90,1.8\n180,0.02\n"


@pytest.fixture
def folder(tmp_path):
    inside = tmp_path / "inside"
    (inside / "tables").mkdir(parents=True)
    for where in (inside, inside / "tables"):
        (where / "cl.csv").write_text(LIFT)
        (where / "cd.csv").write_text(DRAG)
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "cl.csv").write_text(LIFT)
    (outside / "secret").write_text(f"{SECRET},x\n{SECRET},y,z\n")
    return inside


def rotor(folder, table):
    path = folder / "rotor.toml"
    path.write_text(ROTOR % table)
    return path


def refused(call, *arguments, **named):
    with pytest.raises(wf.InputError) as caught:
        call(*arguments, **named)
    line = str(caught.value)
    assert line.isprintable()
    assert len(line) < 700
    assert SECRET not in line
    return line


@pytest.mark.parametrize("table", ["cl.csv", "./cl.csv", "tables/cl.csv", "tables/../cl.csv"])
def test_tables_lie_beside_their_file_or_below(folder, table):
    assert wf.load_rotor(rotor(folder, table)).n_blades == 2


@pytest.mark.parametrize(
    "table", ["../outside/cl.csv", "../outside/secret", "/etc/passwd", "link.csv", "tables/../../outside/cl.csv"]
)
def test_tables_elsewhere_are_read_only_where_the_user_says_so(folder, table):
    (folder / "link.csv").symlink_to(folder.parent / "outside" / "cl.csv")
    path = rotor(folder, table)
    assert "outside its folder" in refused(wf.load_rotor, path)
    if table.endswith("cl.csv") or table == "link.csv":
        assert wf.load_rotor(path, allow_outside=True).n_blades == 2


def test_tables_of_shipped_aircraft_have_names(folder):
    path = rotor(folder, "bo105:naca23012_cl.csv")
    assert wf.load_rotor(path).n_blades == 2
    for name in ("bo105:../load.py", "bo105:", "uh60a:nope.csv"):
        refused(wf.load_rotor, rotor(folder, name))


@pytest.mark.parametrize("kind", ["pipe", "folder", "loop", "device", "system"])
def test_what_is_no_plain_file_is_refused_at_once(folder, kind):
    path = folder / "x.csv"
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
    elif kind == "loop":
        path.symlink_to(path)
    elif kind == "device":
        path.symlink_to("/dev/zero")
    else:
        path.symlink_to("/proc/self/mem")
    for outside in (False, True):
        refused(wf.load_rotor, rotor(folder, "x.csv"), outside)
    for read in (wf.load_aircraft, wf.load_rotor, wf.load_maneuver):
        refused(read, path)


def test_a_file_is_measured_before_it_is_read(folder):
    with (folder / "x.csv").open("wb") as file:
        file.truncate(1 << 40)
    assert "larger than" in refused(wf.load_rotor, rotor(folder, "x.csv"))
    with (folder / "x.toml").open("wb") as file:
        file.truncate(text.LARGEST_TOML + 1)
    assert "larger than" in refused(wf.load_maneuver, folder / "x.toml")


@pytest.mark.parametrize(
    ("mark", "encoding"),
    [
        (codecs.BOM_UTF8, "utf-8"),
        (codecs.BOM_UTF16_LE, "utf-16-le"),
        (codecs.BOM_UTF16_BE, "utf-16-be"),
        (codecs.BOM_UTF32_LE, "utf-32-le"),
        (codecs.BOM_UTF32_BE, "utf-32-be"),
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_a_byte_order_mark_changes_nothing(folder, mark, encoding, end):
    expected = wf.load_rotor(rotor(folder, "cl.csv")).data
    for name in ("rotor.toml", "cl.csv", "cd.csv"):
        content = (folder / name).read_text().replace("\n", end)
        (folder / name).write_bytes(mark + content.encode(encoding))
    assert wf.load_rotor(folder / "rotor.toml").data == expected


@pytest.mark.parametrize("encoding", ["latin-1", "utf-16-le", "cp500"])
def test_text_of_an_unknown_encoding_is_refused_with_its_place(folder, encoding):
    path = folder / "m.toml"
    path.write_bytes('name = "Hübschrauber"\n'.encode(encoding))
    assert "line 1" in refused(wf.load_maneuver, path)


@pytest.mark.parametrize(
    "content",
    [
        "x = " + "[" * 10**5,
        "a." * 20000 + "b = 1",
        "x = " + "{a=" * 300,
        "[" + "a." * 500 + "b]",
        "x = " + "9" * 10**5,
        "x = [" + "[" * 20 + "]" * 20 + "]",
        'name = "a\\u0000b"',
        'name = "a\\u001bb"',
        '"a\\u007fb" = 1',
    ],
)
def test_toml_without_end_or_with_control_characters_is_refused(tmp_path, content):
    path = tmp_path / "m.toml"
    path.write_text(content)
    refused(wf.load_maneuver, path)


@pytest.mark.parametrize(
    "name", ["../../escaped", "/absolute", "..", ".", "~/x", "a/b", "$(x)", "C:\\x", "é中", "-rf", "a" * 300]
)
def test_a_name_is_never_a_path(name):
    folder = text.slug(name)
    assert Path(folder).name == folder
    assert not folder.startswith((".", "-"))
    assert 0 < len(folder) <= 80


@pytest.mark.parametrize("name", ["", " ", "a\nb", "a\x00b", "\u202egnp", "a" * 201, "\ud800"])
def test_a_name_that_cannot_be_printed_is_none(name):
    assert "name" in refused(wf.Maneuver, name, {"pedal": [(0.0, 0.0), (1.0, 0.1)]}, seconds=2.0)


def test_names_with_markup_stay_text_in_figures_and_pages(tmp_path):
    from synthetic import run

    from wakeflight import report

    data = run(revolutions=2)
    hostile = r"</script><script>alert(1)</script> $\frac{1}{0}$ {{ 7*7 }} <b>"
    data.attrs |= {"aircraft": hostile, "maneuver": hostile, "warnings": hostile}
    for runs in (data, {hostile: data, "_b": data}):
        page = report.write(runs, tmp_path).read_text(encoding="utf-8")
        assert "<script>alert" not in page
        assert "{{ 7*7 }}" in page


OWN_PIPE = PACKAGE / "sweep" / "worker.py"
"""A process that unpickles what the process that started it sends through their own pipe, as `multiprocessing` does; no file."""


def test_nothing_is_unpickled_or_executed_in_reading():
    forbidden = {"marshal", "shelve", "dill", "yaml"}
    for path in PACKAGE.rglob("*.py"):
        tree = ast.parse(path.read_text())
        opened = {
            node.func.id for node in ast.walk(tree) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
        }
        assert path != OWN_PIPE or "open" not in opened
        for node in ast.walk(tree):
            if isinstance(node, ast.Import | ast.ImportFrom):
                names = {alias.name.split(".")[0] for alias in node.names} | {
                    (getattr(node, "module", "") or "").split(".")[0]
                }
                assert not names & forbidden, path
                assert "pickle" not in (getattr(node, "module", "") or ""), path
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "pickle":
                # packing is harmless
                assert node.attr == "dumps" or path == OWN_PIPE, path
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                assert node.func.id not in ("eval", "exec"), path


def test_a_shipped_file_moved_elsewhere_still_reads(tmp_path):
    shutil.copytree(PACKAGE / "aircraft" / "bo105", tmp_path / "mine")
    assert wf.load_aircraft(tmp_path / "mine" / "bo105.toml").name
