# SPDX-License-Identifier: MIT OR Apache-2.0
"""Documentation does what it says: every code block and command of its pages runs, in a folder of its own.

Blocks of a page run in order in one namespace. `<!-- file: NAME -->` before a block writes it to a file, `<!-- not run: why -->`
leaves it out. Blocks without a language, of `text`, `matlab` and `rust` are output, other programs or fragments of the core.
"""

import re
import shlex
import tomllib
from pathlib import Path

import pytest

from wakeflight import cli

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(
    r"(?:^<!-- (?P<mark>file|not run): (?P<text>[^>]*?) -->\n)?^ *```(?P<language>\w*)[^\n]*\n(?P<code>.*?)^ *```$",
    re.M | re.S,
)
SHOWN = {"", "text", "matlab", "rust"}
SLOW = {"README.md", "docs/guides/stand.md", "docs/guides/stepping.md", "docs/numerics/full-span-wake.md"}
"""Pages whose blocks fly free wakes."""
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def _blocks(path):
    return list(BLOCK.finditer(path.read_text()))


def _parameters():
    for path in PAGES:
        if any(block["language"] not in SHOWN and block["mark"] != "not run" for block in _blocks(path)):
            name = str(path.relative_to(ROOT))
            yield pytest.param(path, id=name, marks=[pytest.mark.slow] if name in SLOW else [])


def test_blocks_are_found_with_their_marks():
    text = "<!-- file: a.toml -->\n```toml\nx = 1\n```\n\n```python\nprint(1)\n```\n```\nout\n```\n"
    found = [(each["mark"], each["text"], each["language"], each["code"]) for each in BLOCK.finditer(text)]
    assert found == [
        ("file", "a.toml", "toml", "x = 1\n"),
        (None, None, "python", "print(1)\n"),
        (None, None, "", "out\n"),
    ]


@pytest.mark.parametrize("path", list(_parameters()))
def test_every_block_of_a_page_runs(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    names = {"__name__": "__page__"}
    for block in _blocks(path):
        language, code = block["language"], block["code"]
        if block["mark"] == "not run" or language in SHOWN:
            continue
        if block["mark"] == "file":
            Path(block["text"]).write_text(code)
        elif language == "python":
            exec(compile(code, f"{path.name}: {code.splitlines()[0]}", "exec"), names)
        elif language == "sh":
            _run_lines(code)
        else:
            assert language == "toml", f"{path.name}: a block of {language} that nothing runs"
            tomllib.loads(code)


def _run_lines(code):
    """Commands of the program, as they are typed."""
    for line in code.splitlines():
        words = shlex.split(line, comments=True)
        if not words:
            continue
        assert words[0] == "wakeflight", f"{line}: only commands of the program are run"
        with pytest.raises(SystemExit) as end:
            cli.main(words[1:])
        assert end.value.code == 0, line


@pytest.mark.parametrize("path", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_of_a_page_lead_somewhere(path):
    text = re.sub(r"```.*?```", "", path.read_text(), flags=re.S)
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"https?:|mailto:", target):
            continue
        file, _, anchor = target.partition("#")
        place = path if not file else path.parent / file
        if not place.exists() and path.is_relative_to(ROOT / "docs"):
            # pages that the site makes from the code
            assert re.match(
                r"(\.\./)?(reference/(command-line|python|results|bibliography)|examples/\w+|validation/index)\.md$",
                file,
            ), target
            continue
        assert place.exists(), target
        if anchor and place.suffix == ".md":
            heads = re.findall(r"^#+ +(.*)$", place.read_text(), re.M)
            assert anchor in {re.sub(r"[^\w\- ]", "", head).strip().lower().replace(" ", "-") for head in heads}, target


@pytest.mark.parametrize("path", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_commands_in_the_text_of_a_page_exist(path):
    """`wakeflight COMMAND --option` in running text: the command and its options are the program's."""
    import typer

    group = typer.main.get_command(cli.app)
    for typed in re.findall(r"`(?:\.venv/bin/)?wakeflight ([a-z][^`]*)`", path.read_text()):
        words = typed.split()
        command = group.commands.get(words[0])
        assert command is not None, typed
        known = {name for parameter in command.params for name in (*parameter.opts, *parameter.secondary_opts)}
        assert {word for word in words if word.startswith("--")} <= known | {"--help"}, typed
