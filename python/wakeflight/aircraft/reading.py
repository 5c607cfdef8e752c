# SPDX-License-Identifier: MIT OR Apache-2.0
"""Groups of an aircraft or rotor file checked by their schema; every complaint is one line."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from ..errors import InputError
from ..references import known_keys
from .versions import Written


def validated(
    path: Path,
    written: Written,
    schema: type[BaseModel],
    contents: dict[str, str],
    allow_outside: bool = False,
    known: Mapping[str, str] | None = None,
) -> Any:
    """What is `written` in the file `path` as `schema`, its citations known; InputError names the first thing wrong.

    contents: texts by the names of their files, that of `path` first; tables that are read are added. allow_outside: whether
    tables may lie in other folders. known: texts of tables that were read before, by their names: they are not read again.
    """
    data = written.data
    sources = data.get("sources")
    context = {
        "file": path,
        "directory": path.parent,
        "allow_outside": allow_outside,
        "sources": set(sources) if isinstance(sources, dict) else set(),
        "contents": contents,
        "known": known or {},
    }
    try:
        spec: Any = schema.model_validate(data, context=context)
    except ValidationError as reason:
        raise _one_error(path, reason, written, schema) from None
    for key, source in spec.sources.items():
        for reference in source.references:
            if reference not in known_keys():
                allowed = "not in references.bib; leave references out and describe the source in text"
                raise InputError.of(f"sources.{key}.references", reference, allowed, file=path)
    return spec


def _one_error(path: Path, reason: ValidationError, written: Written, schema: type[BaseModel]) -> InputError:
    """The first error of a validation in one line; a missing or unknown key goes before its consequences."""
    data, raw = written.data, written.raw
    order = {"extra_forbidden": 0, "missing": 1}
    error = min(reason.errors(), key=lambda each: order.get(each["type"], 2))
    location = [str(part) for part in error["loc"]]
    # a union reports the tag of its member, which is not a key of the file
    location = [
        part for i, part in enumerate(location) if not (location[:i] == ["interference"] and i == 1 and _tag(data))
    ]
    group = _at(raw, location[:-1])
    if location and not isinstance(group, dict) and not (isinstance(group, list) and location[-1].isdigit()):
        # a number or a list where the file should have a group: the keys below are not the file's
        keys = ", ".join(written.allowed(location[:-1], _allowed(schema, location[:-1], data)))
        where = ".".join(written.key(location[:-1]))
        return InputError.of(where, group, f"must be a group with keys of: {keys}", file=path)
    location = _of_file(raw, location)
    key = ".".join(written.key(location)) or "file"
    if error["type"] == "extra_forbidden":
        allowed = written.allowed(location[:-1], _allowed(schema, location[:-1], data))
        near = get_close_matches(location[-1], allowed, n=1)
        meant = f"is {near[0]} meant? " if near else ""
        return InputError.of(key, "unknown key", f"{meant}allowed here: {', '.join(allowed)}", file=path)
    if error["type"] == "missing":
        return InputError.of(key, "missing", "must be given", file=path)
    message = error["msg"].removeprefix("Value error, ")
    value = error["input"]
    if isinstance(value, dict) and isinstance(value.get("table"), str):
        value = value["table"]
    elif isinstance(value, dict) and "value" in value:
        value = f"{value['value']} {value.get('unit', '')}".strip()
    elif isinstance(value, BaseModel) or (isinstance(value, dict) and not location):
        return InputError(f"{path}: {key}: {message}")
    return InputError.of(key, value, message, file=path)


def _of_file(raw: Any, location: list[str]) -> list[str]:
    """`location` by the keys that a file has: a group where a list is allowed stands in it without number."""
    return [
        part for i, part in enumerate(location) if not (part.isdecimal() and isinstance(_at(raw, location[:i]), dict))
    ]


def _at(raw: Any, location: list[str]) -> Any:
    """What a file holds at `location`; an empty group where it holds nothing."""
    for part in location:
        if isinstance(raw, list) and part.isdecimal() and int(part) < len(raw):
            raw = raw[int(part)]
        elif isinstance(raw, dict):
            raw = raw if part.isdecimal() else raw.get(part, {})
        else:
            return {}
    return raw


def _tag(data: dict[str, Any]) -> bool:
    group = data.get("interference")
    return isinstance(group, dict) and group.get("kind") in ("tables", "factors")


def _allowed(schema: type[BaseModel], location: list[str], data: dict[str, Any]) -> list[str]:
    """Keys of the group at `location`."""
    model: Any = schema
    for depth, part in enumerate(location):
        if isinstance(model, type) and issubclass(model, BaseModel) and part in model.model_fields:
            candidates = _models(model.model_fields[part].annotation)
            if part == "interference" and depth == 0:
                kind = data["interference"].get("kind")
                candidates = [each for each in candidates if kind in get_args(each.model_fields["kind"].annotation)]
            if not candidates:
                return []
            model = candidates[0]
    return sorted(model.model_fields)


def _models(annotation: Any) -> list[type[BaseModel]]:
    """Models named anywhere in a type annotation."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in _models(part)]
