"""Random inputs of every kind, read as a user's are: each must be refused in one line, or accepted and physical.

python tests/fuzz/fuzz.py --cases 1000 [--seconds 60] [--seed 1] [--workers 1] [--only KIND,KIND]
python tests/fuzz/fuzz.py --again SEED NUMBER        one case, with its traceback

refused: one line that can be printed. numerical: a failure that says where. accepted: finite. Everything else is a fault:
an exception of another kind, a panic or the end of the process, no answer within a minute, a line of 700 characters, a number
that is none.
"""

import argparse
import collections
import json
import multiprocessing
import os
import random
import re
import resource
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

LIMIT, MEMORY, LONGEST = 20.0, 6 << 30, 700
FAULTS = ("other exception", "absurd", "bad line", "ended", "no answer")


def case(bench, seed, number, only=()):
    """Kind, description and action of a case."""
    from kinds import KINDS

    rng = random.Random(f"{seed}/{number}")
    names = [name for name in KINDS if not only or name in only]
    kind = rng.choices(names, [KINDS[name][1] for name in names])[0]
    what, action = KINDS[kind][0](bench, rng)
    return kind, what, action


def outcome(action):
    """What came of a case, and the line it was said in."""
    from bench import Absurd

    import wakeflight as wf

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            action()
    except Absurd as reason:
        return "absurd", str(reason)
    except wf.WakeflightError as reason:
        line = str(reason)
        right = line.isprintable() and len(line) < LONGEST and line
        kind = "numerical" if reason.exit_code == 3 else "refused"
        return (kind if right else "bad line"), line
    except BaseException as reason:
        if type(reason) is KeyboardInterrupt:
            raise
        frames = traceback.extract_tb(reason.__traceback__)
        place = next((each for each in reversed(frames) if "wakeflight" in each.filename), frames[-1])
        told = " ".join(str(reason).split())[:200]
        return "other exception", f"{type(reason).__name__}: {told} @ {Path(place.filename).name}:{place.lineno}"
    return "accepted", ""


def work(pipe, seed, first, step, only):
    """Cases first, first + step ... one after the other, each told when it begins and when it ends."""
    from bench import Bench

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        bench = Bench(folder)
        pipe.send(("ready", 0))
        number = first
        while True:
            kind, what, action = case(bench, seed, number, only)
            pipe.send(("begins", number, kind, what))
            pipe.send(("ended", number, *outcome(action)))
            number += step


class Worker:
    """A process that does cases, begun anew where it ends or gives no answer."""

    def __init__(self, seed, first, step, only):
        self.seed, self.step, self.only = seed, step, only
        self.begin(first)

    def begin(self, first):
        self.pipe, theirs = multiprocessing.Pipe()
        arguments = (theirs, self.seed, first, self.step, self.only)
        self.process = multiprocessing.get_context("spawn").Process(target=work, args=arguments, daemon=True)
        self.process.start()
        theirs.close()
        self.now, self.since, self.next = None, time.monotonic(), first

    def told(self):
        """What it tells: a finished case (number, kind, what, outcome, line), or None."""
        try:
            if not self.pipe.poll(0.05):
                late = time.monotonic() - self.since > 3 * LIMIT
                return self._lost("no answer") if self.now and late else None
            word, *rest = self.pipe.recv()
        except (EOFError, ConnectionResetError):
            return self._lost("ended")
        self.since = time.monotonic()
        if word == "begins":
            self.now, self.next = rest, rest[0] + self.step
            return None
        if word == "ready":
            return None
        number, kind, what = self.now
        self.now = None
        return (number, kind, what, *rest[1:])

    def _lost(self, how):
        self.process.kill()
        self.process.join()
        if self.now is None:
            raise SystemExit(f"a worker ended before its first case ({self.process.exitcode})")
        number, kind, what = self.now
        self.begin(self.next)
        return number, kind, what, how, f"exit code {self.process.exitcode}"

    def end(self):
        self.process.kill()
        self.process.join()


def fuzz(cases, seconds, seed, workers=1, only=(), log=None):
    """Counts by kind and outcome, and the faults found."""
    counts, faults, done = collections.defaultdict(collections.Counter), [], 0
    end = time.monotonic() + seconds
    crew = [Worker(seed, k, workers, only) for k in range(workers)]
    try:
        while done < cases and time.monotonic() < end:
            for worker in crew:
                found = worker.told()
                if found is None:
                    continue
                number, kind, what, how, line = found
                counts[kind][how] += 1
                done += 1
                if how in FAULTS:
                    faults.append((how, kind, f"{seed} {number}", what, line))
                if log is not None:
                    log.write(json.dumps(found) + "\n")
    finally:
        for worker in crew:
            worker.end()
    return counts, faults


def table(counts):
    """Counts as lines of a Markdown table."""
    columns = ("refused", "accepted", "numerical", *FAULTS)
    lines = [f"| kind | inputs | {' | '.join(columns)} |", "|---" * (len(columns) + 2) + "|"]
    total = collections.Counter()
    for kind, each in sorted(counts.items()):
        lines.append(f"| {kind} | {sum(each.values())} | {' | '.join(str(each[name]) for name in columns)} |")
        total += each
    lines.append(f"| all | {sum(total.values())} | {' | '.join(str(total[name]) for name in columns)} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", type=int, default=100_000)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--only", type=lambda text: tuple(text.split(",")), default=())
    parser.add_argument("--log", type=argparse.FileType("a"))
    parser.add_argument("--again", nargs=2, type=int, metavar=("SEED", "NUMBER"))
    given = parser.parse_args()
    if given.again:
        from bench import Bench

        with tempfile.TemporaryDirectory() as folder:
            kind, what, action = case(Bench(folder), *given.again, given.only)
            print(f"{kind}: {what}")
            print(action())
        return 0
    began = time.monotonic()
    counts, faults = fuzz(given.cases, given.seconds, given.seed, given.workers, given.only, given.log)
    print(table(counts))
    alike = collections.defaultdict(list)
    for how, kind, at, what, line in faults:
        alike[how, kind, re.sub(r"[-+]?\d[\d.e+-]*|'[^']*'", "#", line)[:120]].append((at, what, line))
    for (how, kind, _), each in sorted(alike.items(), key=lambda pair: -len(pair[1])):
        at, what, line = each[0]
        print(f"{how} x{len(each)}, {kind}: {line[:300]}\n    --again {at}: {what[:200]}")
    total = sum(sum(each.values()) for each in counts.values())
    print(f"{total} inputs, {len(faults)} faults, {time.monotonic() - began:.0f} s")
    return len(faults) > 0


if __name__ == "__main__":
    os.environ.setdefault("WAKEFLIGHT_THREADS", "1")
    os.environ.setdefault("MPLBACKEND", "Agg")
    sys.exit(main())
