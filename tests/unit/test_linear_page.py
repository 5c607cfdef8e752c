"""The tutorial of docs/linear-models.md runs as it stands there."""

import re
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs" / "linear-models.md"


def test_the_ten_lines_run_and_print_what_they_say(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    lines = [line for line in code.splitlines() if line.strip()]
    assert len(lines) <= 10
    exec(compile(code, str(PAGE), "exec"), {})
    said = capsys.readouterr().out
    for expected in ("phugoid", "dutch roll", "regressing lag 1", "magnitude", "roll.bandwidth", "none: the phase"):
        assert expected in said
