# SPDX-License-Identifier: MIT OR Apache-2.0
"""An aircraft with its files by value: text of the file and of every table it names, and what was chosen of it."""

from __future__ import annotations

import hashlib
import re
import tempfile
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from ..errors import InputError
from .load import load_aircraft
from .model import Aircraft
from .schema import Discretisation

PLAIN_NAME = re.compile(r"\w[\w.-]*\.(?!toml$)\w+", re.ASCII)
"""Names of files that can stand in any folder."""


@dataclass(frozen=True)
class Bundle:
    """Files of an aircraft by the names the first one, `main`, calls them; loading and what differs from the file."""

    main: str
    files: dict[str, str]
    loading: str | None
    mirrored: bool
    flexible: bool
    discretisation: dict[str, Any]
    changes: list[dict[str, Any]] = field(default_factory=list)

    @classmethod
    def of(cls, aircraft: Aircraft) -> Bundle:
        """Of an aircraft, its files as they were when it was loaded."""
        spec = aircraft.spec
        main = next(iter(spec.contents), aircraft.path.name)
        chosen = dict(spec.discretisation)
        flexible = spec.rotor.blade.flexible
        return cls(main, spec.contents, aircraft.loading_name, spec.mirrored, flexible, chosen, spec.changes)

    def as_dict(self) -> dict[str, Any]:
        """As JSON takes it, with the sha256 of every file."""
        hashes = {name: hashlib.sha256(text.encode()).hexdigest() for name, text in self.files.items()}
        return asdict(self) | {"sha256": hashes}

    @classmethod
    def from_dict(cls, given: dict[str, Any]) -> Bundle:
        """From `as_dict`; InputError where a text is not the one of its hash."""
        own = dict(given)
        for name, known in own.pop("sha256").items():
            if hashlib.sha256(own["files"][name].encode()).hexdigest() != known:
                raise InputError.of("input", name, "must be the text that belongs to its sha256: the file was changed")
        return cls(**own)

    def aircraft(self) -> Aircraft:
        """The aircraft again, from the texts alone."""
        with tempfile.TemporaryDirectory(prefix="wakeflight-") as made:
            root, main = Path(made), self.files[self.main]
            for number, (name, text) in enumerate(self.files.items()):
                own = name
                if name == self.main:
                    continue
                if not PLAIN_NAME.fullmatch(name):
                    # a place on the machine it was read on, which a name in a file never chooses here
                    own = f"table-{number}"
                    main = main.replace(f'"{name}"', f'"{own}"').replace(f"'{name}'", f'"{own}"')
                (root / own).write_text(text, encoding="utf-8", newline="")
            (root / "aircraft.toml").write_text(main, encoding="utf-8", newline="")
            loaded = load_aircraft(root / "aircraft.toml", self.loading)
            for step in self.changes:
                loaded = loaded.with_(step)
            loaded.spec.contents.clear()
            loaded.spec.contents.update(self.files)
            spec = loaded.spec
            blade = spec.rotor.blade.model_copy(update={"flexible": self.flexible})
            chosen = {
                "mirrored": self.mirrored,
                "rotor": spec.rotor.model_copy(update={"blade": blade}),
                "discretisation": Discretisation(**self.discretisation),
            }
            return Aircraft(spec.model_copy(update=chosen), Path(self.main), self.loading)
