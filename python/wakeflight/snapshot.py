# SPDX-License-Identifier: MIT OR Apache-2.0
"""A flight at one moment, by value: everything that what comes depends on, exact to the last bit."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .arguments import checked
from .atomic import write_bytes
from .errors import InputError

MAGIC = b"WKFL-SNAPSHOT\n"
VERSION = 4


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
        return int(self.scalars["step"])

    @property
    def size(self) -> int:
        """Bytes of its parts."""
        return sum(map(len, self.parts.values()))

    def to_bytes(self) -> bytes:
        """One block: magic, length and text of the header (JSON), the parts, sha256 of all before."""
        return packed({"configuration": self.configuration, "scalars": self.scalars}, self.parts)

    @classmethod
    @checked
    def from_bytes(cls, block: bytes) -> Snapshot:
        """From `to_bytes`; a block that was cut or changed is refused."""
        header, parts = unpacked(block)
        return cls(header["configuration"], header["scalars"], parts)

    def save(self, path: str | Path) -> Path:
        """Write `to_bytes` as a file, which is there whole or not at all."""
        return write_bytes(path, self.to_bytes())

    @classmethod
    def load(cls, path: str | Path) -> Snapshot:
        """From a file that `save` wrote; InputError where it is damaged or there is none."""
        try:
            return cls.from_bytes(Path(path).read_bytes())
        except OSError as reason:
            raise InputError.of("snapshot", str(path), f"cannot be read: {reason.strerror}") from reason

    def check(self, configuration: dict[str, str]) -> None:
        """Refuse to go on in another `configuration`."""
        for name, value in configuration.items():
            if self.configuration.get(name) != value:
                allowed = f"must be that of the simulation, {value}: it belongs to another flight"
                raise InputError.of(f"snapshot {name}", self.configuration.get(name), allowed)


def packed(header: Mapping[str, Any], parts: Mapping[str, bytes]) -> bytes:
    """One block: magic, length and text of the header (JSON), the parts, sha256 of all before; nothing in it is executed."""
    whole = {"version": VERSION, **header, "parts": {name: len(part) for name, part in parts.items()}}
    text = json.dumps(whole, allow_nan=False).encode()
    block = b"".join([MAGIC, len(text).to_bytes(8, "little"), text, *parts.values()])
    return block + hashlib.sha256(block).digest()


def unpacked(block: bytes) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Header and parts of what `packed` wrote; a block that was cut or changed is refused."""
    at, given = len(MAGIC) + 8, f"{len(block)} bytes"
    if block[: len(MAGIC)] != MAGIC:
        raise InputError.of("snapshot", given, "must be a block written by Snapshot.to_bytes")
    if hashlib.sha256(block[:-32]).digest() != block[-32:]:
        raise InputError.of("snapshot", given, "must be whole and unchanged: its checksum is not met")
    end = at + int.from_bytes(block[len(MAGIC) : at], "little")
    try:
        header = json.loads(block[at:end])
        version, lengths = header.pop("version"), header.pop("parts")
        known = version == VERSION and sum(lengths.values()) + end + 32 == len(block)
    except (ValueError, KeyError, AttributeError, TypeError) as reason:
        raise InputError.of("snapshot", given, f"has a header that cannot be read: {reason}") from reason
    if version != VERSION:
        raise InputError.of("snapshot version", version, f"allowed: {VERSION}")
    if not known:
        raise InputError.of("snapshot", given, "must be as long as its header says")
    parts = {}
    for name, length in lengths.items():
        parts[name], end = block[end : end + length], end + length
    return header, parts
