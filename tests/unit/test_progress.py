# SPDX-License-Identifier: MIT OR Apache-2.0
"""Progress: what verbs take, and what is shown off a terminal."""

import io

from wakeflight.progress import Progress, Silent, heard, reporting


@reporting
def _verb(steps, progress=None):
    progress = heard(progress)
    progress.phase("work", steps)
    for _ in range(steps):
        progress.advance()
    return progress


def test_true_shows_phases_on_the_standard_error(capsys):
    _verb(3, progress=True)
    assert "work: 3 of 3" in capsys.readouterr().err


def test_nothing_is_shown_where_nothing_is_asked(capsys):
    assert isinstance(_verb(3), Silent)
    assert isinstance(_verb(3, progress=False), Silent)
    assert capsys.readouterr().err == ""


def test_a_display_that_is_given_is_used():
    stream = io.StringIO()
    given = Progress(stream)
    assert _verb(2, progress=given) is given
    assert "work: 2 of 2" in stream.getvalue()


def test_verbs_of_the_package_take_true():
    import wakeflight as wf

    for verb in (wf.trim, wf.fly, wf.tunnel, wf.converge):
        assert hasattr(verb, "__wrapped__")
