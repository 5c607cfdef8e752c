# SPDX-License-Identifier: MIT OR Apache-2.0
"""Sweeps and ensembles: any verb over a grid or a sample of cases, by processes of this machine or a Dask cluster, as one
table."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._core import build_commit
from ..arguments import checked
from ..errors import InputError
from ..progress import Progress, Reported, Silent, heard, reporting
from ..units import whole
from .cases import Cases, Normal, Uniform, arange, cases_of, grid, sample
from .cluster import check_client, on_cluster
from .find import verb_of
from .folder import SweepFolder, digest
from .outcome import Kept, Outcome
from .processes import cores, local, packable
from .table import assembled
from .verb import Verb

if TYPE_CHECKING:
    import xarray as xr

TABLE = "table.nc"
"""The table in the folder of a sweep."""

MOST_WORKERS = 1024

__all__ = ["TABLE", "Cases", "Normal", "Uniform", "arange", "checked_cases", "grid", "sample", "sweep", "verb_of"]


@reporting
@checked
def sweep(
    verb: str | Callable[..., Any],
    cases: Any,
    *,
    out: str | Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    client: Any = None,
    keep: str | Sequence[str] | None = None,
    progress: Reported = None,
    **fixed: Any,
) -> xr.Dataset:
    """Run `verb` for every case and put what they gave into one Dataset, labelled by the coordinates of the cases.

    verb: `wf.trim`, `wf.fly`, `wf.linearize`, `wf.handling_qualities`, `wf.tunnel` or their names: whatever begins with a
    trim trims first; or a function of a case, which takes its arguments by name and returns a Dataset or numbers by name.
    cases: `wf.grid(...)`, `wf.sample(...)`, or a list of arguments by name. fixed: arguments that are the same in all cases.
    workers: processes, one for each core by default, each with one thread; spawned, so that a script that sweeps does so below
    `if __name__ == "__main__":`. client: a `dask.distributed.Client`, whose workers run the cases instead.
    keep: variables by name, or `all`; by default numbers and histories, without maps of the disk, blades and wakes.
    out: a folder to which every case goes as it is done, and the table (`table.nc`) at the end. resume: go on with what is there.

    Every case is checked before the first is run. A case that fails is a value: its variables are nan, and `failure` says why.
    The table depends on neither the number of workers nor the order in which they were done, to the bit.
    """
    progress = heard(progress)
    chosen = verb_of(verb)
    kept = chosen.kept(keep)
    if workers is not None:
        whole("workers", workers, 1, MOST_WORKERS)
    if client is not None:
        if workers is not None:
            raise InputError.of("workers", workers, "a Dask client has its own workers: give one of the two")
        check_client(client)
    if resume and out is None:
        raise InputError.of("resume", resume, "needs out, the folder that is gone on with")
    asked = checked_cases(chosen, cases_of(cases).with_fixed(fixed), progress)
    tasks = {k: (chosen.sent, dict(case), kept) for k, case in enumerate(asked.cases)}
    if client is None and (why := packable(list(tasks.values()))):
        raise InputError.of(
            "verb", chosen.name, f"cannot be given to another process, must be a function of a module: {why}"
        )
    attributes = {"verb": chosen.name, "kept": "all" if kept == Kept() else ", ".join(kept.names or kept.dims or ())}
    with SweepFolder(out) if out is not None else nullcontext() as folder:
        keys = _keys(chosen, asked, kept) if folder is not None else []
        done = _known(folder, keys, resume, progress)
        left = {k: task for k, task in tasks.items() if k not in done}
        progress.phase(f"sweep of {chosen.name}", len(left))
        engine = on_cluster(left, client) if client is not None else local(left, workers or cores())
        with closing(engine):
            for k, found in _counted(engine, asked, progress):
                done[k] = found
                if folder is not None and found.lasting:
                    folder.keep(keys[k], found)
        table = assembled(asked, [done[k] for k in range(len(asked))], attributes)
        if folder is not None:
            from ..results import save

            save(table, folder.folder / TABLE)
    return table


def checked_cases(verb: Verb, cases: Cases, progress: Progress | Silent) -> Cases:
    """The cases, if the verb would take every one; InputError names the first that it would not by its coordinates."""
    progress(f"{len(cases)} cases of {verb.name} are checked")
    for k, case in enumerate(cases.cases):
        try:
            verb.check(case)
        except InputError as reason:
            label = cases.label(k)
            raise InputError(f"case {label}: {reason}" if label else str(reason)) from None
    return cases


def _keys(verb: Verb, cases: Cases, kept: Kept) -> list[str]:
    """Digests of the cases by all they depend on."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        program = version("wakeflight")
    except PackageNotFoundError:
        program = "unknown"
    made = {"program": program, "commit": build_commit(), "verb": verb.name, "kept": repr(kept)}
    return [digest({**made, **verb.told(case)}) for case in cases.cases]


def _known(
    folder: SweepFolder | None, keys: list[str], resume: bool, progress: Progress | Silent
) -> dict[int, Outcome]:
    """Cases that have been done before."""
    if folder is None:
        return {}
    if not resume:
        there = folder.any()
        if there:
            allowed = f"holds {there} finished cases: resume=True (--resume) goes on with them, or another folder"
            raise InputError.of("out", str(folder.folder), allowed)
        return {}
    found = {k: each for k, key in enumerate(keys) if (each := folder.found(key)) is not None}
    progress(f"{len(found)} of {len(keys)} cases are there already")
    return found


def _counted(
    engine: Generator[tuple[int, Outcome], None, None], cases: Cases, progress: Progress | Silent
) -> Iterator[tuple[int, Outcome]]:
    """Outcomes as they come, told."""
    failed = 0
    for k, found in engine:
        if found.failure:
            failed += 1
            progress(f"failed: {cases.label(k)}: {found.failure}")
        progress.advance(1, f"{failed} failed" if failed else "")
        yield k, found
