# SPDX-License-Identifier: MIT OR Apache-2.0
"""The bibliography of the package: `references.bib`, for equations and data alike."""

from __future__ import annotations

import re
from collections.abc import Sequence, Set
from functools import cache
from importlib import resources

from .arguments import checked
from .errors import InputError

_ENTRY = re.compile(r"^@\w+\{([^,\s]+),.*?^\}", re.MULTILINE | re.DOTALL)


@cache
def _entries() -> dict[str, str]:
    text = (resources.files(__package__) / "references.bib").read_text(encoding="utf-8")
    return {match.group(1): match.group(0) for match in _ENTRY.finditer(text)}


def known_keys() -> frozenset[str]:
    """Every key of the bibliography."""
    return frozenset(_entries())


@checked
def bibtex(keys: Sequence[str] | Set[str]) -> str:
    """BibTeX of `keys`, each once, sorted by key."""
    wanted = tuple(keys)
    for key in wanted:
        if not isinstance(key, str) or key not in _entries():
            raise InputError.of("reference", key, "not a key of references.bib")
    return "\n\n".join(_entries()[key] for key in sorted(set(wanted)))
