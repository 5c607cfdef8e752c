# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pages of the site that are made from the code, and the order of all pages: hooks that mkdocs calls."""

from __future__ import annotations

import logging
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "target" / "docs-examples"
LOG = logging.getLogger("mkdocs.hooks.wakeflight")

SECTIONS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("Start", "", ("index.md", "concepts.md", "linear-models.md")),
    (
        "How to",
        "guides/",
        (
            "case-files.md",
            "own-maneuver.md",
            "aircraft-files.md",
            "stand.md",
            "sweeps.md",
            "loads.md",
            "stepping.md",
            "wind.md",
            "ground.md",
        ),
    ),
    ("Examples", "examples/", ()),
    ("Physics", "physics/", ("conventions.md",)),
    (
        "Numerics",
        "numerics/",
        ("wake-defaults.md", "convergence.md", "performance.md", "trim.md", "flight-dynamics.md", "circulation.md"),
    ),
    ("Reference", "reference/", ("command-line.md", "python.md", "results.md", "wake-options.md")),
    ("Validation", "validation/", ("index.md",)),
    (
        "The project",
        "",
        (
            "results.md",
            "paper.md",
            "reliability.md",
            "reliability-inputs.md",
            "architecture.md",
            "dependencies.md",
            "contributing.md",
            "changelog.md",
        ),
    ),
)
"""Parts of the site: title, folder, the pages that come first in this order; other pages of the folder follow by name."""

API: dict[str, tuple[str, ...]] = {
    "Aircraft, rotors, conditions": (
        "load_aircraft",
        "Aircraft",
        "load_rotor",
        "Rotor",
        "FlightCondition",
        "condition_for",
    ),
    "Trim": ("trim", "Trim"),
    "Manoeuvres and flight": ("Maneuver", "load_maneuver", "arrested_descent", "roll_reversal", "fly", "Flight"),
    "Inflow models": ("TimeMarchingWake", "RelaxationWake", "DynamicInflow", "AnnularInflow", "inflow_model"),
    "A flight in steps": ("Simulation", "Snapshot"),
    "A rotor on a stand": ("tunnel", "Tunnel"),
    "Blades, sections, vortices, wings": ("blade_modes", "airfoil_loop", "induced_velocity", "wing", "Wing"),
    "Studies": ("converge",),
    "Results": ("export", "noise", "export_wopwop", "bibtex"),
    "Errors": ("WakeflightError", "InputError", "NumericalFailure"),
}
"""The public interface by topic; names that are in none come last."""


def on_files(files: Files, config: Any) -> Files:
    """Add the pages that are made from the code."""
    for name, text in _pages():
        if files.get_file_from_path(name) is None:
            files.append(File.generated(config, name, content=text))
    for path in sorted(KEPT.glob("*.png")):
        files.append(File.generated(config, f"examples/{path.name}", content=path.read_bytes()))
    return files


def on_config(config: Any) -> Any:
    """The navigation: every page there is, sections in order."""
    made = [name for name, _ in _pages()]
    there = {
        str(path.relative_to(ROOT / "docs")) for path in (ROOT / "docs").rglob("*.md") if "tools" not in path.parts
    }
    pages = there | set(made)
    nav = []
    for title, folder, first in SECTIONS:
        own = [folder + name for name in first if folder + name in pages]
        more = sorted(page for page in pages if folder and page.startswith(folder) and page not in own)
        # titles of examples are sentences, too long for a list
        short = [{page.split("/")[-1][:-3].replace("_", " "): page} for page in more] if title == "Examples" else more
        nav.append({title: own + short})
    config["nav"] = nav
    return config


def on_page_markdown(markdown: str, page: Any, config: Any, files: Files) -> str:
    """Links that leave the folder of the docs: to pages of the site that stand for them."""
    markdown = re.sub(r"<!-- (?:file|not run)[^>]*-->\n", "", markdown)
    markdown = markdown.replace("](../CONTRIBUTING.md", "](contributing.md")
    return markdown.replace("](docs/", "](").replace("](CONTRIBUTING.md", "](contributing.md")


_MADE: list[tuple[str, str]] = []


def _pages() -> list[tuple[str, str]]:
    """Every page made from the code: its path and its Markdown."""
    if not _MADE:
        _MADE.append(("contributing.md", (ROOT / "CONTRIBUTING.md").read_text()))
        _MADE.append(("changelog.md", (ROOT / "CHANGELOG.md").read_text()))
        _MADE.append(("reference/command-line.md", command_line()))
        _MADE.append(("reference/python.md", python_reference()))
        _MADE.append(("reference/results.md", results_reference()))
        _MADE.append(("reference/bibliography.md", bibliography()))
        _MADE.extend(equations())
        _MADE.extend(examples())
        _MADE.extend(validation())
    return _MADE


def command_line() -> str:
    """Every command with its arguments, options and defaults, as `--help` tells them."""
    import typer

    from wakeflight.cli import app

    group: Any = typer.main.get_command(app)
    context = group.context_class(group, info_name="wakeflight")
    lines = ["# Command line", "", "Made from the program: `wakeflight COMMAND --help` says the same.", ""]
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        lines += [f"## wakeflight {name}", "", command.help or "", "", "| | | default |", "|---|---|---|"]
        for parameter in command.params:
            if parameter.name == "help":
                continue
            option = parameter.param_type_name == "option"
            label = " / ".join([*parameter.opts, *parameter.secondary_opts]) if option else str(parameter.metavar)
            shown = parameter.show_default if isinstance(parameter.show_default, str) else parameter.default
            if shown is None:
                shown = "required" if parameter.required else ""
            text = (parameter.help or "").replace("|", "\\|")
            lines.append(f"| `{label}` | {text} | {str(shown).replace('|', ' ')} |".replace("<", "&lt;"))
        lines.append("")
    return "\n".join(lines)


def python_reference() -> str:
    """The public interface by topic, from the docstrings."""
    import wakeflight as wf

    lines = [
        "# Python",
        "",
        "`import wakeflight as wf`: every name below is `wf.NAME`. Quantities are text with units.",
        "",
    ]
    told = {name for names in API.values() for name in names} | {"__version__"}
    for title, names in {**API, "More": tuple(name for name in wf.__all__ if name not in told)}.items():
        places = [f"{getattr(wf, name).__module__}.{name}" for name in names]
        lines += [f"## {title}" if names else "", "", *(f"::: {place}\n" for place in places)]
    return "\n".join(lines)


def results_reference() -> str:
    """Variables and attributes of every result, from the schema."""
    from wakeflight.results import schema

    lines = ["# What results hold", "", "Every variable has `units` and `long_name`. Those marked ° may be absent.", ""]
    tables = {
        "A flight": schema.RUN,
        "A trim": schema.TRIM,
        "A stand": schema.TUNNEL,
        "A transient on the stand": schema.TRANSIENT,
    }
    for title, table in tables.items():
        lines += [f"## {title}", "", "| variable | dimensions | unit | meaning |", "|---|---|---|---|"]
        for each in table:
            name = f"`{each.name}`{'°' if each.optional else ''}"
            lines.append(f"| {name} | {', '.join(each.dims)} | {each.units} | {each.long_name.replace('|', ' ')} |")
        lines.append("")
    lines += ["## Attributes", "", "| attribute | meaning |", "|---|---|"]
    lines += [f"| `{each.name}` | {each.long_name} |" for each in schema.ATTRIBUTES]
    return "\n".join(lines)


def bibliography() -> str:
    """The one bibliography, entry by entry."""
    text = (ROOT / "python" / "wakeflight" / "references.bib").read_text()
    lines = ["# Bibliography", "", "Keys in square brackets on other pages are these.", ""]
    for key, body in re.findall(r"@\w+\s*\{\s*([^,\s]+),(.*?)\n\}", text, re.DOTALL):
        found = dict(re.findall(r"(\w+)\s*=\s*\{(.*)\}", body))
        plain = {name: value.replace("{", "").replace("}", "").replace("--", "–") for name, value in found.items()}
        where = plain.get("journal") or plain.get("booktitle") or plain.get("institution") or plain.get("publisher", "")
        parts = [
            plain.get("author", "").replace(" and ", "; "),
            f"*{plain.get('title', '')}*",
            where,
            plain.get("number", ""),
        ]
        lines.append(f"- **{key}**: {', '.join(part for part in [*parts, plain.get('year', '')] if part)}")
    return "\n".join(lines)


def equations() -> Iterator[tuple[str, str]]:
    """The equations as the source states them, a page for each room of the core: what is documented with its source."""
    core = ROOT / "crates" / "wakeflight" / "src"
    cited = re.compile(r"\[[a-z]{2,}[a-z_]*(?:19|20)\d\d[a-z]?[,\]]")
    for room in ("vortex", "wake", "inflow", "airfoil", "blade", "rotor", "airframe", "trim", "system", "integrate"):
        lines = [f"# Equations: {room}", "", "As the source states them beside the code that solves them.", ""]
        for path in sorted((core / room).rglob("*.rs")):
            text = path.read_text().split("#[cfg(test)]")[0]
            head = "\n".join(line[3:].removeprefix(" ") for line in text.splitlines() if line.startswith("//!"))
            told = []
            for block, item in re.findall(
                r"((?:^ *///[^\n]*\n)+)(?: *#\[[^\n]*\n)* *pub (?:const )?(?:fn|struct|enum) (\w+)", text, re.M
            ):
                body = "\n".join(line.strip()[3:].removeprefix(" ") for line in block.strip().splitlines())
                if cited.search(body):
                    told.append(f"**{item}**\n\n{_quoted(body)}\n")
            if told:
                lines += [f"## {path.relative_to(core).with_suffix('')}", "", _escaped(head), "", *told]
        if len(lines) > 4:
            yield f"physics/equations-{room}.md", "\n".join(lines)


def _quoted(text: str) -> str:
    return "\n".join(f"> {line}".rstrip() + "  " for line in _escaped(text).splitlines())


def _escaped(text: str) -> str:
    """Comments of the source as Markdown: no HTML, no emphasis by stray signs, no links of the compiler's."""
    text = re.sub(r"\[(`[^`]+`)\](?:\([^)]*\))?", r"\1", text).replace("][", "]\\[")
    return (
        text.replace("<", "&lt;").replace("*", "\\*").replace("_", "\\_")
        if "`" not in text
        else text.replace("<", "&lt;")
    )


def examples() -> Iterator[tuple[str, str]]:
    """Every example with what it printed and drew; kept until the script changes."""
    KEPT.mkdir(parents=True, exist_ok=True)
    for path in sorted((ROOT / "examples").glob("*.py")):
        printed, figure = KEPT / f"{path.stem}.txt", KEPT / f"{path.stem}.png"
        if not (printed.is_file() and figure.is_file() and printed.stat().st_mtime > path.stat().st_mtime):
            LOG.info("running example %s", path.name)
            code = f"from pathlib import Path; import {path.stem} as e; e.main(Path({str(KEPT)!r}))"
            around = {
                **os.environ,
                "MPLBACKEND": "Agg",
                "PYTHONPATH": os.pathsep.join([str(path.parent), os.environ.get("PYTHONPATH", "")]),
            }
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=around)
            if done.returncode:
                raise RuntimeError(f"example {path.name} failed: {done.stderr[-2000:]}")
            printed.write_text(done.stdout)
        source = path.read_text().removeprefix("# SPDX-License-Identifier: MIT OR Apache-2.0\n")
        _, doc, code = source.split('"""', 2)
        title, _, told = doc.partition("\n\n")
        parts = [f"# {title.strip()}", told, f"![What it draws]({path.stem}.png)", f"`examples/{path.name}`:"]
        parts += [f"```python\n{code.strip()}\n```", "It prints:", f"```text\n{printed.read_text().rstrip()}\n```"]
        yield f"examples/{path.stem}.md", "\n\n".join(parts)


def validation() -> Iterator[tuple[str, str]]:
    """The reference cases: a table of all, and what each says of itself."""
    rows = ["# Reference cases", "", "`wakeflight validate CASE` runs one and writes a page with its figure and score.", "",
            "| case | title | kind |", "|---|---|---|"]  # fmt: skip
    for path in sorted((ROOT / "validation").glob("*/case.toml")):
        case = tomllib.loads(path.read_text())
        readme = path.with_name("README.md")
        text = readme.read_text() if readme.is_file() else f"# {case.get('title', path.parent.name)}\n"
        # files beside a case are not part of the site
        text = re.sub(r"\[([^\]]*)\]\((?!https?:)[^)]*\)", r"\1", text)
        rows.append(
            f"| [{case.get('id', '')}]({path.parent.name}.md) | {case.get('title', '')} | {case.get('kind', '')} |"
        )
        yield f"validation/{path.parent.name}.md", text
    yield "validation/index.md", "\n".join(rows)
