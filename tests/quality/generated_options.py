# SPDX-License-Identifier: MIT OR Apache-2.0
"""What is made from the options that the core declares: the reference page and the stub of `wakeflight.inflow`.

python tests/quality/generated_options.py        # writes both anew
"""

import ast
from pathlib import Path

from wakeflight.inflow import AnnularInflow, DynamicInflow, RelaxationWake, TimeMarchingWake
from wakeflight.options import DECLARED, options_of
from wakeflight.presets import PRESETS
from wakeflight.regime import REGIMES

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "reference" / "wake-options.md"
SOURCE = ROOT / "python" / "wakeflight" / "inflow.py"
STUB = SOURCE.with_suffix(".pyi")
MODELS = (TimeMarchingWake, RelaxationWake, DynamicInflow, AnnularInflow)


def page():
    """The reference page: a table of options for each group of models that share them."""
    lines = [
        "# Options of the inflow models",
        "",
        "Made from the declarations in `crates/wakeflight/src/wake/options/declared.rs` (and `inflow/options.rs`) by",
        "`python tests/quality/generated_options.py`: do not edit. In Python an option is a keyword argument of the model,",
        '`wf.TimeMarchingWake(turns=6, near_wake_angle="45 deg")`; on the command line `--wake turns=6 --wake',
        '"near_wake_angle=45 deg"`. R: rotor radius, c: reference chord, Ω: rotor speed. Angles are text with a unit.',
        "",
        "A default in four depends on the regime of the rotor: "
        + ", ".join(f"*{words}*" for words in REGIMES.values())
        + ".",
        "An option left at `None` is left open, or to the regime; one that was given is never replaced.",
        "",
        "## Presets",
        "",
        '`wf.TimeMarchingWake.preset("paper")`, `--wake paper`: options that belong together; single ones given beside it',
        "replace its own. A model takes those options of a preset that it has.",
        "",
        "| preset | options |",
        "|---|---|",
    ]
    for name, given in PRESETS.items():
        lines.append(f"| `{name}` | {', '.join(f'`{k}={v!r}`' for k, v in given.items()) or 'the defaults below'} |")
    groups: dict[tuple[str, ...], list] = {}
    for option in DECLARED:
        groups.setdefault(option.models, []).append(option)
    names = {model.name: model.__name__ for model in MODELS}
    for models, options in groups.items():
        lines += ["", f"## {', '.join(f'`{names[model]}`' for model in models)}", ""]
        lines += ["| option | unit | allowed | default | meaning | source |", "|---|---|---|---|---|---|"]
        for option in options:
            unit = {"rad": "angle", "": "–"}.get(option.unit, option.unit)
            if option.by_regime:
                default = ", ".join(f"{value}" for value in option.by_regime.values())
                lattice = ", ".join(dict.fromkeys(f"{value}" for value in option.lattice.values()))
                default += f"; with full-span trailers {lattice}" if lattice else ""
            else:
                default = option.default_in_words
            allowed = "<br>".join(f"`{word}`: {meaning}" for word, meaning in option.words.items()) or option.allowed
            sources = ", ".join(option.sources) or "–"
            lines.append(f"| `{option.name}` | {unit} | {allowed} | {default} | {option.meaning} | {sources} |")
    return "\n".join(lines) + "\n"


def annotation(option):
    """Type of the argument as a checker sees it."""
    kind = {"number": "float", "whole": "int", "switch": "bool"}.get(option.kind)
    kind = kind or f"Literal[{', '.join(repr(word) for word in option.words)}]"
    return ("Any" if option.is_angle else kind) + (" | None" if option.default is None and not option.is_angle else "")


def stub():
    """The stub of `inflow.py`: its own definitions, with the options as fields and keyword arguments."""
    tree = ast.parse(SOURCE.read_text())
    lines = ["# made by tests/quality/generated_options.py: do not edit", "from dataclasses import dataclass"]
    lines = [lines[0], "from collections.abc import Mapping", lines[1]]
    lines += ["from typing import Any, ClassVar, Literal, Protocol, Self"]
    kinds = {model.__name__: model for model in MODELS}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            lines += ["", _signature(node, "")]
        elif isinstance(node, ast.ClassDef):
            base = f"({ast.unparse(node.bases[0])})" if node.bases else ""
            model = kinds.get(node.name)
            lines += ["", *(["@dataclass(frozen=True, kw_only=True)"] if model else []), f"class {node.name}{base}:"]
            lines += [f"    {line}" for line in _members(node)]
            if model:
                lines += [f"    {o.name}: {annotation(o)} = ..." for o in options_of(model.name).values()]
        elif isinstance(node, ast.Assign) and node.targets[0].id == "InflowModel":
            lines += ["", ast.unparse(node)]
        elif isinstance(node, ast.AnnAssign):
            lines += ["", f"{ast.unparse(node.target)}: {ast.unparse(node.annotation)}"]
    return "\n".join(lines) + "\n"


def _members(node):
    for member in node.body:
        if isinstance(member, ast.AnnAssign) and "ClassVar" in ast.unparse(member.annotation):
            yield f"{member.target.id}: {ast.unparse(member.annotation)}"
        elif isinstance(member, ast.AnnAssign) and node.name in ("Inflow", "FreeWake"):
            yield ast.unparse(member)
        elif isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
            yield from _signature(member, "").split("\n")


def _signature(node, indent):
    # what is checked is no part of a type
    listed = (ast.unparse(each) for each in node.decorator_list)
    decorators = "".join(f"{indent}@{each}\n" for each in listed if each != "checked")
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    arguments = ast.unparse(node.args)
    return f"{decorators}{indent}def {node.name}({arguments}){returns}: ..."


FILES = {PAGE: page, STUB: stub}
"""What is made, and how."""


if __name__ == "__main__":
    for path, text in FILES.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text())
        print(f"wrote {path.relative_to(ROOT)}")
