"""Time, memory and the machine, for the benchmarks."""

import platform
import resource
import statistics
import time
from collections.abc import Callable
from pathlib import Path


def seconds(task: Callable[[], object], repetitions: int) -> tuple[float, float]:
    """Median and best wall-clock time of `task` [s]."""
    times = []
    for _ in range(repetitions):
        begun = time.perf_counter()
        task()
        times.append(time.perf_counter() - begun)
    return statistics.median(times), min(times)


def machine() -> str:
    """Model of the processor and its widest vectors."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        return platform.machine()
    model = next((line.split(":", 1)[1].strip() for line in text.splitlines() if line.startswith("model name")), "")
    widest = next((name for flag, name in (("avx512f", "AVX-512"), ("avx2", "AVX2")) if flag in text), "no AVX2")
    return f"{model}, {text.count('processor')} processors, {widest}"


def peak_memory() -> float:
    """Largest resident memory of this process so far [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def table(head: list[str], rows: list[list[str]]) -> str:
    """Rows as a Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"
