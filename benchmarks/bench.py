"""Every benchmark by one command; the tables go into docs/numerics/performance.md.

    python benchmarks/bench.py [--quick] [--print] [PART ...]

Parts: kernel, threads, scaling, wake-step, pec, isolated-rotor, caradonna-tung, dynamics, maneuvers, desk, import;
by default all. --quick: smaller wakes and two revolutions.
--print: show the tables and leave the page alone. A part that is not asked for keeps its table.
"""

import argparse
import re
from pathlib import Path

import flight
import hands
import measure
import vortex
import wake

PAGE = Path(__file__).resolve().parents[1] / "docs" / "numerics" / "performance.md"
FIGURE = PAGE.parents[1] / "images" / "tree-scaling.png"
PARTS = (
    *("kernel", "threads", "scaling", "wake-step", "pec", "isolated-rotor", "caradonna-tung"),
    *("dynamics", "maneuvers", "desk", "import"),
)


def fastest(kernel: str) -> float:
    """Nanoseconds per evaluation of the wakes' core as they sum it by default, from the kernel's table."""
    row = next(line for line in kernel.splitlines() if line.startswith("| Vatistas2 | line"))
    return min(float(cell.split()[0]) for cell in row.split("|")[4:-3] if cell.strip())


def replaced(text: str, part: str, table: str) -> str:
    """The page with the table of one part exchanged."""
    begin, end = f"<!-- {part} -->", f"<!-- /{part} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(text):
        raise SystemExit(f"{PAGE.name} has no place for {part}: {begin} ... {end}")
    return pattern.sub(lambda _: f"{begin}\n\n{table}\n{end}", text)


def main() -> None:
    """Measures the parts asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="PART")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--print", action="store_true", dest="only_print")
    options = parser.parse_args()
    for part in options.parts:
        if part not in PARTS:
            parser.error(f"PART = {part}: allowed are {', '.join(PARTS)}")
    parts = options.parts or PARTS
    kernel = vortex.kernel() if {"kernel", "maneuvers"} & set(parts) else ""
    tasks = {
        "kernel": lambda: kernel,
        "threads": vortex.threads,
        "scaling": lambda: vortex.scaling(options.quick, None if options.only_print or options.quick else FIGURE),
        "wake-step": lambda: wake.steps(options.quick),
        "pec": lambda: wake.pec(options.quick),
        "isolated-rotor": wake.isolated_rotor,
        "caradonna-tung": wake.caradonna_tung,
        "dynamics": lambda: flight.dynamics(options.quick),
        "maneuvers": lambda: flight.maneuvers(options.quick, fastest(kernel)),
        "desk": lambda: hands.desk(options.quick),
        "import": flight.import_time,
    }
    text = PAGE.read_text()
    for part in parts:
        table = f"Measured on: {measure.machine()}{', quick mode' if options.quick else ''}.\n\n" + tasks[part]()
        print(f"{part}\n\n{table}", flush=True)
        text = replaced(text, part, table)
        if not options.only_print:
            PAGE.write_text(text)


if __name__ == "__main__":
    main()
