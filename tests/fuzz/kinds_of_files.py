"""Files: manoeuvres, aircraft, tables, rotors, decks, results, snapshots; changed, cut, saved by other programs."""

import json
import math
import shutil

import mutations
from bench import CORPUS, HOME, Absurd, finite, whole

import wakeflight as wf
from wakeflight import results


def maneuver_file(bench, rng):
    text = rng.choice(bench.maneuvers).read_text()
    content, how = mutations.any_file(rng, text, mutations.toml)
    path = bench.at("m") / "m.toml"

    def read():
        path.write_bytes(content)
        flown = wf.load_maneuver(path).for_aircraft(bench.uh60a.stick_travel_in, 27.0)
        flown.check_span(bench.uh60a.stick_travel_in)
        finite(flown.corners() or [0.0], flown.duration(27.0), flown.offset(0.3), flown.rate(0.3))
        if not flown.name.isprintable():
            raise Absurd(f"name {flown.name!r}")

    return f"manoeuvre: {how}", read


def aircraft_file(bench, rng):
    name = rng.choice(["uh60a", "bo105"])
    folder = bench.at("a")
    shutil.copytree(HOME / "aircraft" / name, folder, dirs_exist_ok=True)
    path = folder / f"{name}.toml"
    content, how = mutations.any_file(rng, path.read_text(), mutations.toml)
    return f"{name}.toml: {how}", lambda: (path.write_bytes(content), loaded(wf.load_aircraft(path)))


def table_file(bench, rng):
    name = rng.choice(["uh60a", "bo105"])
    folder = bench.at("a")
    shutil.copytree(HOME / "aircraft" / name, folder, dirs_exist_ok=True)
    table = rng.choice(sorted(folder.glob("*_*.csv")))
    content, how = mutations.any_file(rng, table.read_text(), mutations.csv)
    return f"{table.name}: {how}", lambda: (
        table.write_bytes(content),
        loaded(wf.load_aircraft(folder / f"{name}.toml")),
    )


def loaded(aircraft):
    finite(aircraft.chord, aircraft.solidity, aircraft.blade_mass)
    json.dumps(aircraft.core_data(), allow_nan=False)
    if not aircraft.name.isprintable():
        raise Absurd(f"name {aircraft.name!r}")


def rotor_file(bench, rng):
    folder = bench.at("r")
    for deck in bench.decks:
        shutil.copy(deck, folder)
    content, how = mutations.any_file(rng, rng.choice(bench.rotors).read_text(), mutations.toml)
    path = folder / "rotor.toml"

    def read():
        path.write_bytes(content)
        rotor = wf.load_rotor(path)
        json.dumps(rotor.data, allow_nan=False)
        finite(rotor.chord, rotor.solidity, rotor.omega)

    return f"rotor: {how}", read


def deck(bench, rng):
    source = rng.choice(bench.decks)
    lines = source.read_text().split("\n")
    way = rng.choice(["field", "field", "counts", "swap", "drop", "dup", "wide", "blanks", "preamble", "tail", "file"])
    i = rng.randrange(1, len(lines) - 1)
    if way == "field":
        k = rng.randrange(8)
        cell = rng.choice((*mutations.CELLS, "180.001", "-999", "1e38"))[:7]
        lines[i] = f"{lines[i][: 7 * k]}{cell:>7}{lines[i][7 * k + 7 :]}"
    elif way == "counts":
        at = next(j for j, line in enumerate(lines) if len(line) >= 42)
        lines[at] = lines[at][:30] + "".join(
            rng.choice(["00", "01", "99", "-1", "03", "09", "xx", "  ", "5 "]) for _ in range(6)
        )
    elif way == "swap":
        j = rng.randrange(1, len(lines) - 1)
        lines[i], lines[j] = lines[j], lines[i]
    elif way == "drop":
        del lines[i]
    elif way == "dup":
        lines.insert(i, lines[i])
    elif way == "wide":
        lines[i] = lines[i] * rng.choice([2, 1000])
    elif way == "blanks":
        sep = rng.choice([" ", "\t", "   ", ", "])
        lines[1:] = [sep.join(line.split()) for line in lines[1:]]
    elif way == "preamble":
        lines[:0] = [rng.choice(mutations.NAMES).encode("utf-8", "replace").decode(), "1 0 0", " " * 30 + "12"][
            : rng.randrange(4)
        ]
    elif way == "tail":
        lines += [rng.choice(["text", "1 2 3", "0.0 0.1", "\x0c"])] * rng.choice([1, 3])
    text = "\n".join(lines)
    content = (
        mutations.any_file(rng, text, lambda rng, text: (text.encode(), way))[0] if way == "file" else text.encode()
    )
    folder = bench.at("d")
    text = (CORPUS / "rotor-deck.toml").read_text().replace("deck-plain.c81", "deck.c81")
    more = rng.choice(["", "", 'extend = "flat-plate"\n', 'extend = "mirror"\n', 'extend = "x"\n'])
    text = text.replace("[discretisation]", more + "[discretisation]")

    def read():
        (folder / "deck.c81").write_bytes(content)
        (folder / "rotor.toml").write_text(text)
        tables = wf.load_rotor(folder / "rotor.toml").data["airfoil"]["tables"][0]
        for name in ("cl", "cd", "cm"):
            finite(tables[name]["values"], tables[name]["x"])
            if not math.isclose(tables[name]["x"][-1], math.pi):
                raise Absurd(f"{name} ends at {tables[name]['x'][-1]}")

    return f"{source.name}: {way}", read


def result_file(bench, rng):
    content = bench.run
    way = rng.choice(["cut", "bytes", "head", "zeros", "foreign", "grown"])
    if way == "cut":
        content = mutations.cut(rng, content)
    elif way == "bytes":
        content = mutations.flipped(rng, content)
    elif way == "head":
        content = mutations.flipped(rng, content[:4096]) + content[4096:]
    elif way == "zeros":
        at = rng.randrange(len(content))
        content = content[:at] + bytes(min(4096, len(content) - at)) + content[at + 4096 :]
    elif way == "foreign":
        content = rng.choice([b"", b"CDF\x01", b"x" * 1000, b"\x89HDF\r\n\x1a\n", b"PK\x03\x04", b"\x80\x04]"])
    else:
        content += bytes(rng.randrange(256) for _ in range(100))
    path = bench.folder / "run.nc"

    def read():
        path.write_bytes(content)
        data = results.load(path, rng.choice(["flight", None]))
        whole(data)
        if not data.equals(bench.flight.data):
            raise Absurd("read, and not what was written")

    return f"run.nc: {way}", read


def snapshot(bench, rng):
    content = rng.choice([mutations.flipped, mutations.cut])(rng, bench.snapshot)

    def read():
        if wf.Snapshot.from_bytes(content).to_bytes() != bench.snapshot:
            raise Absurd("read, and not what was written")

    return f"snapshot of {len(content)} bytes", read
