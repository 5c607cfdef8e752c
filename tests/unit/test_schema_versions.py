# SPDX-License-Identifier: MIT OR Apache-2.0
"""Version 2 of the aircraft format: a list of rotors; version 1 is read to the same model."""

import re
import shutil
from importlib import resources
from pathlib import Path

import pytest

import wakeflight as wf
from wakeflight.aircraft.versions import groups_of

SHIPPED = Path(str(resources.files("wakeflight.aircraft")))
VERSION_1 = Path(__file__).parent / "data" / "version-1"

TO_THE_RIGHT = (
    ("[-1.590228, 0.0, 0.250330, 0.0]", "[1.590228, 0.0, 0.250330, 0.0]"),
    ("[7.973828, -9.728045,", "[-7.928452, -9.728045,"),
)
"""The rigging of the UH-60A with a lateral stick that rolls a clockwise rotor to its side."""
TAIL = '[[rotor]]\nname = "tail"\nmodel = "closed-form"\n'


def of_version_1(tmp_path, name):
    shutil.copytree(SHIPPED / name, tmp_path / name)
    shutil.copy(VERSION_1 / f"{name}.toml", tmp_path / name)
    return tmp_path / name / f"{name}.toml"


def uh60a(tmp_path, *changes):
    shutil.copytree(SHIPPED / "uh60a", tmp_path / "uh60a")
    path = tmp_path / "uh60a" / "uh60a.toml"
    text = path.read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    path.write_text(text)
    return path


def refused(path, *named):
    with pytest.raises(wf.InputError) as caught:
        wf.load_aircraft(path)
    message = str(caught.value)
    for each in (path.name, *named):
        assert each in message, message
    assert "\n" not in message


@pytest.mark.parametrize("name", ["uh60a", "bo105"])
def test_a_file_of_version_1_is_the_same_model(tmp_path, name):
    first, second = wf.load_aircraft(of_version_1(tmp_path, name)), wf.load_aircraft(name)
    assert first.core_data() == second.core_data()
    assert first.discretisation == second.discretisation
    assert first.warnings == second.warnings
    # groups that came after version 1: the pitch-bias actuator, engines and the inertia of the drive
    since = re.compile(r"rigging\.pitch_bias_actuator|drive\.(engine|governor|inertia|power_per)")
    assert first.sources() == [row for row in second.sources() if not since.match(row.key)]
    assert first.limits == second.limits


def test_rotors_have_the_names_of_the_file(tmp_path):
    renamed = wf.load_aircraft(uh60a(tmp_path, ('name = "tail"', 'name = "anti-torque"')))
    assert list(renamed.rotors) == ["main", "anti-torque"]
    assert renamed.rotors["anti-torque"].radius == pytest.approx(5.5 * 0.3048)
    assert list(wf.load_aircraft(of_version_1(tmp_path / "old", "uh60a")).rotors) == ["main", "tail"]


def test_a_rotor_may_be_given_by_its_alias(tmp_path):
    path = uh60a(tmp_path)
    text = path.read_text()
    main, tail = '[[rotor]]\nname = "main"\n', TAIL
    assert main in text and tail in text
    before, after = text.split(tail)
    before = before.replace(main, "[main_rotor]\n").replace("[rotor.", "[main_rotor.")
    path.write_text(before + "[tail_rotor]\n" + after.replace("[rotor.shaft]", "[tail_rotor.shaft]"))
    assert wf.load_aircraft(path).core_data() == wf.load_aircraft("uh60a").core_data()


def test_a_rigid_rotor_is_a_model_of_the_list(tmp_path):
    rigid = wf.load_aircraft(uh60a(tmp_path, ('model = "elastic"', 'model = "rigid"')))
    assert not rigid.flexible
    assert rigid.core_data() == wf.load_aircraft("uh60a").with_rigid_blades().core_data()


def test_the_sense_of_rotation_is_read_and_goes_to_the_core(tmp_path):
    turned = ('rotation = "ccw"', 'rotation = "cw"')
    with pytest.raises(wf.InputError, match="lateral right must raise theta_1c of a clockwise rotor"):
        wf.load_aircraft(uh60a(tmp_path / "left", turned))
    clockwise = wf.load_aircraft(uh60a(tmp_path, turned, *TO_THE_RIGHT))
    assert clockwise.core_data()["rotor"]["rotation"] == "cw"
    assert wf.load_aircraft("uh60a").core_data()["rotor"]["rotation"] == "ccw"


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("schema = 2", "schema = 2\nformat = 1", ("format", "one of the two")),
        ("schema = 2\n", "", ("schema", "missing", "2")),
        ("schema = 2", "schema = 3", ("schema = 3", "must be 2")),
        ("schema = 2", "format = 2", ("format = 2", "must be 1")),
        ("schema = 2", "format = 1", ("rotor", "needs schema = 2")),
        ('rotation = "ccw"', 'rotation = "left"', ("rotor.rotation", "left", "ccw")),
        ('model = "elastic"', 'model = "stiff"', ("rotor[main].model", "stiff", "elastic, rigid, closed-form")),
        ('model = "elastic"\n', "", ("rotor[main].model", "missing")),
        ('model = "elastic"', 'model = "closed-form"', ("main (closed-form), tail (closed-form)", "one rotor with")),
        ('model = "closed-form"', 'model = "elastic"', ("main (elastic), tail (elastic)", "one rotor with blades")),
        ('name = "tail"', 'name = "main"', ("rotor[main].name", "names must differ")),
        ('name = "tail"\n', "", ("rotor[1].name", "missing")),
        ("position = { value = [341.25", "hub = { value = [341.25", ("rotor[main].hub", "in version 2 it is position")),
        ("forward = { value = 3.0", "fore = { value = 3.0", ("rotor[main].shaft", "fore", "forward, lateral")),
        ("straight_tip = true", "straight_tip = true\nflexible = true", ("blade.flexible", "in version 2 it is model")),
        ("\nn_blades = {", "\nn_blade = {", ("rotor.n_blade ", "unknown key", "is n_blades meant?")),
        ("\nposition = { value = [341.25", "\npositon = { value = [341.25", ("rotor.positon", "is position meant?")),
        ("[loading]\n", "[loding]\n", ("loding", "is loading meant?", "schema")),
    ],
)
def test_what_is_wrong_with_a_list_of_rotors_is_said_by_the_keys_of_the_file(tmp_path, old, new, named):
    refused(uh60a(tmp_path, (old, new)), *named)


def test_a_second_tail_rotor_is_refused(tmp_path):
    path = uh60a(tmp_path)
    path.write_text(path.read_text() + "\n" + TAIL.replace("tail", "second"))
    refused(path, "tail (closed-form), second (closed-form)", "at most one closed-form tail rotor")


@pytest.mark.parametrize("content", [{}, {"rotor": 3}, {"rotor": [3]}, {"main_rotor": 3}, {"rotor": {"model": []}}])
def test_no_content_is_an_error_of_the_program(content):
    with pytest.raises(wf.InputError):
        groups_of(Path("x.toml"), {"schema": 2, **content})


def test_limits_are_read_checked_and_told(tmp_path):
    stated = (
        'torque = { value = 50, unit = "kN m", source = "paper", confidence = "C" }\n'
        'rotor_speed = { value = [25.0, 28.0], unit = "rad/s", source = "paper", confidence = "C" }\n'
    )
    path = uh60a(tmp_path, ("[limits]", "[limits]"))
    text = path.read_text()
    start = text.index("power = ", text.index("[limits]"))
    path.write_text(text[:start] + stated + text[start:])
    limits = wf.load_aircraft(path).limits
    assert limits.torque == pytest.approx(50e3)
    assert limits.rotor_speed == (25.0, 28.0)
    start = wf.trim(wf.load_aircraft(path), inflow="dynamic")
    told = {monitor.label: monitor.text for monitor in start.monitors}
    assert "limit 50.00 kN m" in told["torque at most"]
    assert "limits 25 to 28" in told["rotor speed"]
    path.write_text(path.read_text().replace("value = 50,", "value = 5,").replace("[25.0, 28.0]", "[20.0, 26.0]"))
    low = wf.load_aircraft(path)
    assert any("limits.rotor_speed" in text for text in low.warnings)
    warnings = " ".join(wf.trim(low, inflow="dynamic").warnings)
    assert "beyond the aircraft's 5.00 kN m" in warnings
    assert "rotor speed 27 rad/s" in warnings
    path.write_text(path.read_text().replace("[20.0, 26.0]", "[26.0, 20.0]"))
    refused(path, "limits", "rotor_speed must ascend")
