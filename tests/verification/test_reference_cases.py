"""Every exact reference case that takes no more than a few seconds keeps its tolerance."""

from pathlib import Path

import pytest

from wakeflight.errors import InputError
from wakeflight.validate import Case, Check, cases, run, select

FOLDER = Path(__file__).resolve().parents[2] / "validation"
CASES = cases(FOLDER)


def test_there_are_cases():
    assert {"K01", "K04"} <= {case.id for case in CASES}


@pytest.mark.parametrize("case", [c for c in CASES if c.kind == "exact" and not c.slow], ids=lambda c: c.slug)
def test_verif_an_exact_case_keeps_its_tolerance(case):
    result = run(case)
    assert result.failure is None
    outside = [f"{c.quantity}: {c.ours:.9g}, exact {c.reference:.9g}" for c in result.gated if not c.within]
    assert not outside


@pytest.mark.slow
@pytest.mark.parametrize("case", [c for c in CASES if c.kind == "exact" and c.slow], ids=lambda c: c.slug)
def test_verif_a_slow_exact_case_keeps_its_tolerance(case):
    test_verif_an_exact_case_keeps_its_tolerance(case)


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.slug)
def test_every_case_says_what_it_is_in_words(case):
    assert len(case.words) > 150
    assert case.kind == "waits" or (case.folder / "case.py").is_file()


def test_a_number_outside_its_tolerance_is_outside():
    assert Check("x", 1.02, 1.0, 0.01, kind="relative").within is False
    assert Check("x", float("nan"), 1.0, 10.0).within is False
    assert Check("x", 1.02, 1.0, gate=False).within is None
    assert Check.largest("x", [1.0, 2.1], [1.0, 2.0], 0.2).ours == 2.1


def test_a_case_that_is_not_there_is_refused_with_those_that_are():
    with pytest.raises(InputError, match=r"CASE = 'K99': allowed: .*K01"):
        select(CASES, ["K99"])


def test_a_case_file_with_a_missing_key_is_refused(tmp_path):
    (tmp_path / "case.toml").write_text('id = "X"\n')
    with pytest.raises(InputError, match="title"):
        Case.read(tmp_path)
