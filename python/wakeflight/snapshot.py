# SPDX-License-Identifier: MIT OR Apache-2.0
"""A flight at one moment, by value: everything that what comes depends on, exact to the last bit."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, field
from typing import Any

from .arguments import checked
from .errors import InputError

MAGIC = b"WKFL-SNAPSHOT\n"
VERSION = 1


@dataclass(frozen=True)
class Snapshot:
    """State of a `Simulation` between two steps; made by `Simulation.snapshot`, taken by `Simulation.restore`.

    It shares nothing with the simulation that made it, can be pickled, and written by `to_bytes`. configuration: what it belongs
    to, by name. scalars: clock, sticks, servo. parts: states, memory of the integrator, exchange with the wake, as the core packs
    them.
    """

    configuration: dict[str, str]
    scalars: dict[str, Any]
    parts: dict[str, bytes] = field(repr=False)

    @property
    def step(self) -> int:
        """Coupling steps flown."""
        return self.scalars["step"]

    @property
    def size(self) -> int:
        """Bytes of its parts."""
        return sum(map(len, self.parts.values()))

    def to_bytes(self) -> bytes:
        """One block: magic, length and text of the header (JSON), the parts, sha256 of all before."""
        header = {
            "version": VERSION,
            "configuration": self.configuration,
            "scalars": self.scalars,
            "parts": {name: len(part) for name, part in self.parts.items()},
        }
        text = json.dumps(header, allow_nan=False).encode()
        block = b"".join([MAGIC, len(text).to_bytes(8, "little"), text, *self.parts.values()])
        return block + hashlib.sha256(block).digest()

    @classmethod
    @checked
    def from_bytes(cls, block: bytes) -> Snapshot:
        """From `to_bytes`; a block that was cut or changed is refused."""
        at = len(MAGIC) + 8
        if block[: len(MAGIC)] != MAGIC:
            raise InputError.of("snapshot", f"{len(block)} bytes", "must be a block written by Snapshot.to_bytes")
        if hashlib.sha256(block[:-32]).digest() != block[-32:]:
            raise InputError.of(
                "snapshot", f"{len(block)} bytes", "must be whole and unchanged: its checksum is not met"
            )
        end = at + int.from_bytes(block[len(MAGIC) : at], "little")
        header = json.loads(block[at:end])
        if header["version"] != VERSION:
            raise InputError.of("snapshot version", header["version"], f"allowed: {VERSION}")
        parts = {}
        for name, length in header["parts"].items():
            parts[name], end = block[end : end + length], end + length
        return cls(header["configuration"], header["scalars"], parts)

    def check(self, configuration: dict[str, str]) -> None:
        """Refuse to go on in another `configuration`."""
        for name, value in configuration.items():
            if self.configuration.get(name) != value:
                allowed = f"must be that of the simulation, {value}: it belongs to another flight"
                raise InputError.of(f"snapshot {name}", self.configuration.get(name), allowed)
