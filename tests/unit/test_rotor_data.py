# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rotor files and section decks as people have them: every key and column used, refused or told."""

import codecs
import math

import pytest

import wakeflight as wf

ROTOR = """format = 1
name = "rotor"
[rotor]
n_blades = 2
radius = "1.143 m"
omega = "1250 rpm"
[rotor.blade]
root = "clamped"
flexible = false
root_station = "0 m"
root_cutout = "0.1905 m"
geometry = { columns = { r_R = [0, 1], chord_m = [0.1905, 0.1905], twist_deg = [0, 0] } }
[rotor.airfoil]
name = "section"
"""
POLAR = 'polar = { lift_curve_slope = "5.7 1/rad", cd = [0.01, 0, 1.0] }\n'
DECK = 'c81 = { table = "deck.c81" }\n'

ANGLES = (-180, -90, -20, -10, 0, 10, 20, 90, 180)
LIFT = (0, 0, -0.9, -1, 0, 1, 0.9, 0, 0)
DRAG = (0.02, 1.8, 0.2, 0.02, 0.01, 0.02, 0.2, 1.8, 0.02)
NONE = (0,) * 9


def table(values, mach=(0, 0.5, 1)):
    lines = [" " * 7 + "".join(f"{m:7.2f}" for m in mach)]
    return lines + [f"{a:7.1f}" + f"{v:7.3f}" * len(mach) for a, v in zip(ANGLES, values, strict=True)]


def deck(cl=LIFT, cd=DRAG, cm=NONE, mach=(0, 0.5, 1)):
    """Lines of a C81 deck; cm None: it counts none."""
    counts = f"{len(mach):02d}09" * 2 + (f"{len(mach):02d}09" if cm is not None else "0000")
    lines = [f"{'A SECTION':30s}{counts}", *table(cl, mach), *table(cd, mach)]
    return lines + (table(cm, mach) if cm is not None else [])


def rotor(tmp_path, section=POLAR, old="", new=""):
    assert old in ROTOR + section
    path = tmp_path / "rotor.toml"
    path.write_text((ROTOR + section).replace(old, new, 1))
    return path


def of_deck(tmp_path, lines):
    (tmp_path / "deck.c81").write_text("\n".join(lines) + "\n")
    return wf.load_rotor(rotor(tmp_path, DECK))


def refused(path, *named):
    with pytest.raises(wf.InputError) as caught:
        wf.load_rotor(path)
    message = str(caught.value)
    for each in named:
        assert each in message, message
    assert "\n" not in message
    assert len(message) < 500


def test_a_plain_rotor_and_a_plain_deck_are_without_doubt(tmp_path):
    assert wf.load_rotor(rotor(tmp_path)).warnings == ()
    assert of_deck(tmp_path, deck()).warnings == ()


@pytest.mark.parametrize("column", ["sweep_deg", "anhedral_deg", "offset_m", "thickness"])
def test_a_column_of_another_code_is_refused_unless_it_says_nothing(tmp_path, column):
    end = "twist_deg = [0, 0]"
    refused(rotor(tmp_path, old=end, new=f"{end}, {column} = [0, 3]"), "geometry", column, "unknown column", "chord")
    assert wf.load_rotor(rotor(tmp_path, old=end, new=f"{end}, {column} = [0, 0]")).warnings == ()


def test_sections_that_do_not_say_where_they_are_are_refused_by_the_key_the_file_has(tmp_path):
    two = "[[rotor.airfoil]]\nname = 'root'\nextent = [0.2, 0.5]\n" + POLAR
    path = rotor(tmp_path, old='[rotor.airfoil]\nname = "section"\n', new=two + "[[rotor.airfoil]]\nname = 'tip'\n")
    refused(path, "rotor.airfoil", "2 sections", "needs stations", "extent")


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("geometry = { columns = {", "geometry = [1, 2] # {", "rotor.blade.geometry"),
        ("[rotor.blade]", "lag_damper = 3\n[rotor.blade]", "rotor.lag_damper"),
        ('omega = "1250 rpm"', 'omega = "4000 rpm"', "rotor.omega"),
        ("n_blades = 2", "n_blades = 0", "rotor.n_blades"),
        ('radius = "1.143 m"', 'radius = "1e308 m"', "rotor.radius"),
        ("chord_m = [0.1905, 0.1905]", "chord_m = [0.1905, 1e30]", "chord_m"),
        ("chord_m = [0.1905, 0.1905]", "chord_m = [1.9, 1.9]", "chord"),
        ("chord_m = [0.1905, 0.1905]", f"chord_m = [0.1905, 1{'0' * 400}]", "chord_m"),
        ("twist_deg = [0, 0]", "twist_deg = [0, 120]", "twist"),
        ("cd = [0.01, 0, 1.0]", "cd = [-0.01, 0, 1.0]", "cd"),
        ("cd = [0.01, 0, 1.0]", "cd = [0.01, -0.3, 1.0]", "cd"),
        ("geometry = { columns", 'geometry = { table = "x.csv", columns', "both a table and columns"),
    ],
)
def test_an_impossible_rotor_is_refused(tmp_path, old, new, named):
    refused(rotor(tmp_path, old=old, new=new), "rotor.toml", named)


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("[rotor.blade]", 'shaft_tilt_forward = "3 deg"\n[rotor.blade]', "rotor.shaft_tilt_forward"),
        ("[rotor.airfoil]", "structural_damping_ratio = 0.02\n[rotor.airfoil]", "rotor.blade.structural_damping_ratio"),
        ("cd = [0.01, 0, 1.0]", "cd = [0, 0, 0]", "no profile drag"),
        ('slope = "5.7 1/rad"', 'slope = "2 1/rad"', "lift slope 2"),
        ("chord_m = [0.1905, 0.1905]", "chord_m = [0.9, 0.9]", "solidity 0.50"),
        ("n_blades = 2", "n_blades = 1", "single blade"),
    ],
)
def test_a_doubtful_rotor_is_read_and_told(tmp_path, old, new, named):
    (warning,) = wf.load_rotor(rotor(tmp_path, old=old, new=new)).warnings
    assert named in warning


def test_a_deck_behind_a_preamble_is_the_same_deck(tmp_path):
    plain = of_deck(tmp_path, deck())
    other = of_deck(tmp_path, ["1 0 0", "0", "TAKEN FROM A WORKSHOP", "", *deck()])
    assert other.data["airfoil"] == plain.data["airfoil"]
    assert "header in line 5" in other.warnings[0]


def test_a_deck_without_moments_has_none(tmp_path):
    loaded = of_deck(tmp_path, deck(cm=None))
    assert {cell for row in loaded.data["airfoil"]["tables"][0]["cm"]["values"] for cell in row} == {0.0}
    assert "no cm" in loaded.warnings[0]


def test_a_deck_up_to_a_mach_number_no_blade_reaches_is_used(tmp_path):
    loaded = of_deck(tmp_path, deck(mach=(0, 0.3, 0.8)))
    assert loaded.warnings == ()
    assert loaded.data["airfoil"]["tables"][0]["cl"]["y"][-1] == 0.8
    (warning,) = of_deck(tmp_path, deck(mach=(0, 0.3))).warnings
    assert "end at Mach 0.3" in warning
    assert "0.44" in warning


def test_doubts_about_a_deck_are_told(tmp_path):
    gap = (0.5, 0, -0.9, -1, 0, 1, 0.9, 0, 0)
    told = " ".join(of_deck(tmp_path, deck(cl=gap, cm=gap)).warnings)
    assert "cl differs by 0.5 between -180 and 180" in told
    assert "cl and cm are the same table" in told
    assert "text after the tables" in of_deck(tmp_path, [*deck(), "ANOTHER DECK"]).warnings[0]


@pytest.mark.parametrize(
    ("lines", "named"),
    [
        (["A SECTION", *deck()[1:]], "six two-digit counts"),
        ([f"{'A SECTION':30s}000003090309", *deck()[1:]], "0 Mach numbers and 0 angles of cl"),
        ([f"{'A SECTION':30s}020903090309", *deck()[1:]], "3 numbers, 2 are due"),
        (deck()[:-3], "ends before"),
        (deck(cl=[-each for each in LIFT]), "lift slope must be positive"),
        (deck(cd=[-each for each in DRAG]), "drag must not be negative"),
        (deck(cl=[10 * each for each in LIFT]), "within +-4"),
        (deck(cm=(0, -0.5, 0, 0, 0, 0, 0, 0.5, 0)), "nose down"),
        (deck(mach=(0.7, 0.8, 0.9)), "must begin"),
    ],
)
def test_an_impossible_deck_is_refused(tmp_path, lines, named):
    (tmp_path / "deck.c81").write_text("\n".join(lines) + "\n")
    refused(rotor(tmp_path, DECK), "deck.c81", named)


@pytest.mark.parametrize("mark", [codecs.BOM_UTF8, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE])
def test_a_byte_order_mark_is_no_content(tmp_path, mark):
    encoding = {codecs.BOM_UTF8: "utf-8", codecs.BOM_UTF16_LE: "utf-16-le"}.get(mark, "utf-16-be")

    def marked(path, text):
        path.write_bytes(mark + text.encode(encoding))
        return path

    csv = "\n".join(["alpha_deg,M0.0,M1.0", *(f"{a},{v},{v}" for a, v in zip(ANGLES, LIFT, strict=True))])
    marked(tmp_path / "cl.csv", csv)
    marked(tmp_path / "cd.csv", csv.replace("-0.9", "0.2").replace("-1,-1", "1,1"))
    marked(tmp_path / "deck.c81", "\n".join(deck()))
    for section in (DECK, 'cl = { table = "cl.csv" }\ncd = { table = "cd.csv" }\n', POLAR):
        loaded = wf.load_rotor(marked(rotor(tmp_path), ROTOR + section))
        assert loaded.data["airfoil"]["tables"][0]["cl"]["x"][0] == -math.pi


def test_text_that_is_not_utf8_is_named_with_its_place(tmp_path):
    (tmp_path / "deck.c81").write_bytes("\n".join(deck()).replace("A SECTION", "É").encode("latin-1"))
    refused(rotor(tmp_path, DECK), "deck.c81", "UTF-8", "line 1")
    path = rotor(tmp_path)
    path.write_bytes(path.read_text().replace("section", "Flügel").encode("latin-1"))
    refused(path, "rotor.toml", "UTF-8", "line 14")


def test_a_deck_is_held_beyond_its_mach_numbers(tmp_path):
    # the tip moves at Mach 0.44: a deck that is the same at every Mach number gives the same thrust with one column or three
    thrusts = [
        wf.tunnel(of_deck(tmp_path, deck(mach=mach)), "8 deg", inflow="annular").thrust
        for mach in ((0, 0.5, 1), (0, 0.8), (0.2,))
    ]
    assert thrusts[1:] == pytest.approx(thrusts[:1] * 2, rel=1e-12)
    assert thrusts[0] > 100.0


def test_a_file_that_cannot_be_one_is_refused_in_a_short_line(tmp_path):
    refused(rotor(tmp_path, DECK.replace("deck", "a" * 5000)), "rotor.airfoil.c81", "5004 characters")
    refused(rotor(tmp_path, DECK.replace("deck.c81", "/dev/zero")), "/dev/zero", "outside its folder")
    with (tmp_path / "deck.c81").open("wb") as stream:
        stream.truncate(1 << 30)
    refused(rotor(tmp_path, DECK), "deck.c81", "larger than 32 MiB")
