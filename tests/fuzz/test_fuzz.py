"""The short form of the fuzz command, with cases that are always the same, and inputs that were once faults."""

import collections
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
import bench as benches
import fuzz

import wakeflight as wf

CORPUS = benches.CORPUS
DECKS = {
    "deck-plain.c81": (),
    "deck-no-cm.c81": ("no cm",),
    "deck-preamble.c81": ("5 lines stand before",),
    "deck-mach-to-0.8.c81": (),
    "deck-implausible.c81": ("same table", "differs by"),
    "deck-by-blanks.c81": ("read by the blanks", "not in columns 31 to 42"),
}
"""Decks in the forms in which they are passed on, and what is told of each."""


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    return benches.Bench(tmp_path_factory.mktemp("fuzz"))


def test_no_input_is_a_fault(bench):
    counts = collections.Counter()
    for number in range(400):
        kind, what, action = fuzz.case(bench, 1, number)
        how, line = fuzz.outcome(action)
        assert how not in fuzz.FAULTS, f"--again 1 {number}: {kind}, {what}: {line}"
        counts[how] += 1
    # a command that refused everything, or accepted everything, would look at nothing
    assert min(counts["accepted"], counts["refused"]) > 40


@pytest.mark.slow
def test_no_input_is_a_fault_in_an_hour_of_them():
    counts, faults = fuzz.fuzz(cases=200_000, seconds=3600, seed=2, workers=2)
    assert not faults
    assert sum(sum(each.values()) for each in counts.values()) > 10_000


def test_a_fault_is_seen():
    def wrong():
        raise KeyError("x")

    def hostile():
        raise wf.NumericalFailure("")

    assert fuzz.outcome(wrong)[0] == "other exception"
    assert fuzz.outcome(hostile)[0] == "bad line"
    assert fuzz.outcome(lambda: benches.finite(float("nan")))[0] == "absurd"
    assert fuzz.outcome(lambda: wf.load_rotor(None))[0] == "refused"


def rotor_of(tmp_path, deck, more=""):
    (tmp_path / "deck-plain.c81").write_text((CORPUS / deck).read_text())
    path = tmp_path / "rotor.toml"
    text = (CORPUS / "rotor-deck.toml").read_text()
    path.write_text(text.replace('c81 = { table = "deck-plain.c81" }', 'c81 = { table = "deck-plain.c81" }\n' + more))
    return wf.load_rotor(path)


@pytest.mark.parametrize("deck", DECKS)
def test_a_deck_in_the_form_of_another_program_is_read_and_told(tmp_path, deck):
    rotor = rotor_of(tmp_path, deck)
    for text in DECKS[deck]:
        assert any(text in each for each in rotor.warnings), rotor.warnings


def test_the_same_section_is_read_by_columns_and_by_blanks(tmp_path):
    by_columns, by_blanks = (rotor_of(tmp_path, f"deck-{name}.c81").data["airfoil"] for name in ("plain", "by-blanks"))
    assert by_columns == by_blanks


@pytest.mark.parametrize(("deck", "way"), [("deck-to-20-deg.c81", "flat-plate"), ("deck-half.c81", "mirror")])
def test_a_deck_that_does_not_go_round_is_continued_in_a_named_way_or_refused(tmp_path, deck, way):
    with pytest.raises(wf.InputError, match=r'must cover -180 to 180 deg; extend = "flat-plate" or "mirror"'):
        rotor_of(tmp_path, deck)
    rotor = rotor_of(tmp_path, deck, f'extend = "{way}"')
    assert any(f"by {way}, as the file says" in each for each in rotor.warnings)


def test_a_symmetric_section_is_what_its_half_says(tmp_path):
    whole = rotor_of(tmp_path, "deck-plain.c81").data["airfoil"]["tables"][0]
    half = rotor_of(tmp_path, "deck-half.c81", 'extend = "mirror"').data["airfoil"]["tables"][0]
    for name in ("cl", "cd", "cm"):
        assert half[name]["x"] == whole[name]["x"]
        for got, expected in zip(half[name]["values"], whole[name]["values"], strict=True):
            assert got == pytest.approx(expected, abs=1e-12)
