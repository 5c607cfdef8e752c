# SPDX-License-Identifier: MIT OR Apache-2.0
"""Arguments of public functions: what does not fit the annotation ends in one line with argument, value, what is allowed."""

import inspect
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.arguments import checked, kind_of


@pytest.mark.parametrize(
    ("annotation", "right", "wrong"),
    [
        (str, ["", "a"], [b"a", 3, None]),
        (int, [3, np.int64(3), 0], [True, 3.0, "3", float("nan")]),
        (float, [3, 3.5, np.float32(1.5)], [True, "3", float("nan"), float("inf"), 1j, 10**400, np.array(3.0)]),
        (bool, [True], [1, "yes", None]),
        (float | None, [None, 1.0], ["none", float("nan")]),
        (Literal["a", 1], ["a", 1], ["b", True, 1.0]),
        (Sequence[str], [["a"], ("a",), []], ["a", [1], {"a": 1}, None, iter("a")]),
        (Sequence[Any], [np.zeros(3), range(3)], ["abc", {1: 2}, 3, b"abc"]),
        (Mapping[str, float] | None, [{}, None], [[], "x"]),
        (Annotated[tuple[str, ...], Mapping[str, Any] | str], [{}, "a"], [("a",)]),
        (wf.Trim | wf.Maneuver, [wf.roll_reversal()], ["roll-reversal", wf.Maneuver]),
        (Any, [None, object()], []),
    ],
)
def test_an_annotation_says_what_fits(annotation, right, wrong):
    kind = kind_of(annotation)
    assert all(map(kind.fits, right))
    assert not any(map(kind.fits, wrong))


def test_the_line_names_argument_value_and_what_is_allowed():
    with pytest.raises(wf.InputError, match=r"^maneuver = 'arrested-descent': must be a Maneuver \(wf.load_maneuver"):
        wf.fly(object.__new__(wf.Trim), "arrested-descent")
    with pytest.raises(wf.InputError, match=r"^condition = 3: must be a FlightCondition"):
        wf.trim(wf.load_aircraft("uh60a"), condition=3)
    with pytest.raises(wf.InputError, match=r"^name_or_path = None: must be a text or a Path"):
        wf.load_aircraft(None)


def test_an_argument_there_is_not_is_told_with_the_one_that_was_meant():
    for error in (wf.InputError, TypeError):
        with pytest.raises(error, match="is speed meant"):
            wf.FlightCondition(spede="80 kt")
    with pytest.raises(wf.InputError, match="missing a required argument"):
        wf.fly()


def test_values_that_do_not_show_themselves_are_told_by_their_type():
    class Shy:
        def __str__(self):
            raise RuntimeError

    for value, shown in ((Shy(), "<Shy>"), (10**5000, "<int>"), ("a" * 10**6, "aaa..."), ("\x1b[31m\u202e", r"\\x1b")):
        with pytest.raises(wf.InputError, match=shown) as caught:
            wf.blade_modes(value)
        assert str(caught.value).isprintable()
        assert len(str(caught.value)) < 300
        with pytest.raises(wf.InputError, match=rf"^form = '?{shown}"):
            wf.TimeMarchingWake(form=value)


def test_arrays_where_a_word_or_numbers_are_due_are_refused_by_name():
    rotor = wf.load_aircraft("uh60a")
    for name in ("flapping", "hub_roll"):
        with pytest.raises(wf.InputError, match=f"^{name} = "):
            wf.tunnel(rotor, thrust="70 kN", collective=None, **{name: np.zeros((3, 3))})
    with pytest.raises(wf.InputError, match=r"^core_radius = \[\[1\], \[2, 3\]\]: allowed is an array of real numbers"):
        wf.induced_velocity(np.zeros((1, 3)), [np.eye(3)], [1.0, 1.0], [[1], [2, 3]])


def test_an_azimuth_step_too_small_to_be_walked_is_refused():
    for least, right in (("0.1 deg", True), ("0.099 deg", False), ("1e-9 deg", False)):
        for asked in (wf.DynamicInflow, wf.TimeMarchingWake):
            if right:
                assert asked(azimuth_step=least).azimuth_step == pytest.approx(np.deg2rad(0.1))
            else:
                with pytest.raises(wf.InputError, match=r"azimuth_step.*between 0.1 deg and 45 deg"):
                    asked(azimuth_step=least)


def test_a_checked_function_keeps_its_signature_and_its_pickle():
    import pickle

    assert pickle.loads(pickle.dumps(wf.trim)) is wf.trim
    assert "condition" in inspect.signature(wf.trim).parameters

    @checked
    def method(self, *names: str, **shares: float) -> int:
        return len(names) + len(shares)

    assert method(None, "a", "b", c=1.0) == 3
    with pytest.raises(wf.InputError, match="shares"):
        method(None, c="1")


def public():
    """Public functions, and classes that users make themselves."""
    for name in wf.__all__:
        thing = getattr(wf, name)
        if inspect.isfunction(thing):
            yield name, thing
        elif name in MADE_BY_USERS:
            yield name, thing.__init__


MADE_BY_USERS = {
    name
    for name in wf.__all__
    if name.endswith(("Wake", "Inflow")) or name in ("FlightCondition", "Maneuver", "Simulation")
}


def test_every_public_function_is_checked():
    unchecked = [name for name, function in public() if "__checked__" not in vars(function)]
    assert not unchecked, f"@checked (wakeflight.arguments) is missing on {unchecked}"


def test_of_a_public_function_every_annotation_can_be_read():
    for name, function in public():
        kinds = function.__checked__()
        named = [each for each in inspect.signature(function).parameters if each != "self"]
        assert set(kinds) == set(named), f"{name}: no annotation on {set(named) - set(kinds)}"
