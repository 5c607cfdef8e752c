"""Changes of texts, bytes and values that users and their programs make by accident, and those made on purpose."""

import re

NUMBERS = (
    *(
        "nan",
        "inf",
        "-inf",
        "1e308",
        "-1e308",
        "1e-308",
        "5e-324",
        "-0.0",
        "0",
        "-1",
        "1e999",
        "true",
        '""',
        '"x"',
        "[]",
    ),
    *("{}", "[[1]]", "[1, 2, 3, 4, 5, 6, 7, 8, 9]", "9223372036854775807", "9" * 40, "1979-05-27", "0x7f", "-5", "1e6"),
    *("1e-6", "0.5", "2", "3", "7", "100", '"é中🚁"', '"../../etc/passwd"', '"nan kt"', "[nan, nan, nan]", "9" * 5000),
)
UNITS = (
    *("kt", "m", "ft", "deg", "rad", "N", "lbf", "kg", "lb", "slug ft2", "m/s", "1", "", "furlong", "degC", "%", "rpm"),
    *(
        "1/rad",
        "N m/rad",
        "m2",
        "kg/m3",
        "kt, kt, deg",
        "in/in",
        "°",
        "m^-3",
        "km^99999/s",
        "m**9**9**9",
        "k" * 79 + ";",
    ),
)
CELLS = (
    *("nan", "inf", "-inf", "1e308", "-1e308", "", "x", "-0", "0", "-1", "1e-308", "1e6", "0x10", "1_000", "٣", "1,5"),
    *('"1"', "1e999", "-5", "100", "1.0D+00", "9" * 400, "=1+1", "1;2"),
)
NAMES = (
    *(
        "../../escaped",
        "/absolute",
        "a/b",
        "..",
        ".hidden",
        "",
        " ",
        "con",
        "a" * 300,
        "$x_$",
        "$\\frac{1}{0}$",
        "_legend",
    ),
    *("<script>alert(1)</script>", "</script><b>", "{{ 7*7 }}", "{% raw %}", "&amp;", '" onload="x', "a\nb", "a\tb"),
    *("\\u0000", "\\u001b[31mred", "\\u202egnp.exe", "é中🚁", "%s%n", "$(touch x)", "`id`", "line\\nbreak", "\\ud800"),
)
TABLES = (
    *(
        "",
        "../../etc/passwd",
        "/etc/passwd",
        "/dev/zero",
        "/dev/null",
        ".",
        "..",
        "nope.csv",
        "a" * 5000,
        "\\u0000",
        "pipe",
    ),
    *("loop", "out.csv", "folder", "/proc/self/mem", "/proc/self/environ", "uh60a:../load.py", "uh60a:", "bo105:x.csv"),
)
MARKS = ("utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-32-be", "latin-1", "cp1252", "cp500", "utf-7")


def flipped(rng, content):
    """Some bytes changed."""
    changed = bytearray(content)
    for _ in range(rng.choice([1, 4, 50]) if changed else 0):
        changed[rng.randrange(len(changed))] = rng.randrange(256)
    return bytes(changed)


def cut(rng, content):
    """The end missing."""
    return content[: rng.randrange(len(content) + 1)]


def encoded(rng, text):
    """Saved by another program: byte order marks, other encodings, other ends of lines."""
    ends = rng.choice(["\n", "\r\n", "\r"])
    name = rng.choice(MARKS)
    return text.replace("\n", ends).encode(name, "replace"), f"{name}, {ends!r}"


def toml(rng, text):
    """A TOML text with one to three changes, and what they are."""
    if rng.random() < 0.02:
        deep = rng.choice(
            ["x = " + "[" * 100000, "a." * 3000 + "b = 1", "x = {a = " * 400, "x = '" + "a" * 10**6 + "'"]
        )
        return deep.encode(), f"deep: {deep[:20]}"
    lines, told = text.split("\n"), []
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        keyed = [i for i, line in enumerate(lines) if re.match(r"\s*[\w.-]+\s*=", line)]
        heads = [i for i, line in enumerate(lines) if line.startswith("[")]
        if not keyed or not heads:
            break
        kind = rng.choice(
            ["drop", "dup", "value", "value", "value", "scale", "scale", "unit", "key", "head", "group", "name"]
        )
        kind = rng.choice([kind, kind, "table", "list", "copy", "confidence"])
        i, head = rng.choice(keyed), rng.choice(heads)
        old = lines[i]
        if kind == "drop":
            lines[i] = ""
        elif kind == "dup":
            lines.insert(i, old)
        elif kind == "value":
            new = rng.choice(NUMBERS)
            form = r"value\s*=\s*(\[\[.*?\]\]|\[[^\]]*\]|\"[^\"]*\"|[^,}\s]+)" if "value =" in old else r"=\s*(.*)$"
            lines[i] = re.sub(form, lambda m, new=new: m.group().split("=")[0] + "= " + new, old, count=1)
        elif kind == "scale":
            found = list(re.finditer(r"(?<![\w.])-?\d+\.?\d*(?:e-?\d+)?(?![\w.])", old.split("source")[0]))
            if found:
                m, by = rng.choice(found), rng.choice([-1, 0, 1e-12, 1e-3, 0.1, 10, 1e3, 1e12, 0.5, 2, 1.3])
                lines[i] = old[: m.start()] + repr(float(m.group()) * by) + old[m.end() :]
        elif kind == "unit":
            lines[i] = re.sub(r'unit\s*=\s*"[^"]*"', lambda m: f'unit = "{rng.choice(UNITS)}"', old)
        elif kind == "key":
            lines[i] = re.sub(
                r"[\w-]+", lambda m: rng.choice([m.group() + "x", m.group().upper(), "é", m.group()[1:]]), old, count=1
            )
        elif kind == "head":
            h = lines[head]
            lines[head] = rng.choice([h + "x", f"[{h}]", h.replace("[", "[x."), f"{h}\n{h}"])
        elif kind == "group":
            after = min([j for j in heads if j > head] + [len(lines)])
            lines[head:after] = []
        elif kind == "name":
            named = [j for j in keyed if lines[j].startswith("name")]
            lines[rng.choice(named or keyed)] = f'name = "{rng.choice(NAMES)}"'.replace("\n", "\\n")
        elif kind == "table":
            tables = [j for j in keyed if "table =" in lines[j]] or [i]
            j = rng.choice(tables)
            lines[j] = re.sub(r'table\s*=\s*"[^"]*"', lambda m: f'table = "{rng.choice(TABLES)}"', lines[j])
        elif kind == "list":
            m = re.search(r"\[[^\[\]]*\]", old)
            if m:
                parts = [part.strip() for part in m.group()[1:-1].split(",")]
                parts = rng.choice(
                    [
                        parts[:-1],
                        [*parts, rng.choice(NUMBERS)],
                        parts[::-1],
                        parts * 2,
                        parts * 3000,
                        ["[" + ", ".join(parts) + "]"],
                    ]
                )
                lines[i] = f"{old[: m.start()]}[{', '.join(parts)}]{old[m.end() :]}"
        elif kind == "copy":
            lines[i] = old.split("=")[0] + "=" + "=".join(lines[rng.choice(keyed)].split("=")[1:])
        elif kind == "confidence":
            lines[i] = re.sub(
                r'(source|confidence)\s*=\s*"[^"]*"', lambda m: f"{m.group(1)} = {rng.choice(NUMBERS)}", old, count=1
            )
        told.append(f"{kind}: {old.strip()[:50]}")
    return "\n".join(lines).encode(), "; ".join(told)


def csv(rng, text):
    """A CSV text with one or two changes, and what they are."""
    lines, told = text.rstrip("\n").split("\n"), []
    first = next(i for i, line in enumerate(lines) if line and not line.startswith("#"))
    for _ in range(rng.choice([1, 1, 2])):
        body = [i for i in range(first + 1, len(lines)) if lines[i].strip()]
        if not body:
            break
        kind = rng.choice(
            [
                "cell",
                "cell",
                "cell",
                "scale",
                "scale",
                "drop",
                "dup",
                "swap",
                "header",
                "column",
                "short",
                "rev",
                "one",
                "many",
                ";",
            ]
        )
        columns, i = lines[first].split(","), rng.choice(body)
        cells, k = lines[i].split(","), rng.randrange(len(columns))
        if kind == "cell":
            cells[min(k, len(cells) - 1)] = rng.choice(CELLS)
            lines[i] = ",".join(cells)
        elif kind == "scale":
            by = rng.choice([0, -1, 1e-9, 1e9, 1e300, 0.1, 10, 100, 1.5])
            for j in body:
                row = lines[j].split(",")
                if k < len(row) and re.fullmatch(r"[-+.\deE]+", row[k].strip() or "x"):
                    row[k] = repr(float(row[k]) * by)
                    lines[j] = ",".join(row)
        elif kind == "drop":
            del lines[i]
        elif kind == "dup":
            lines.insert(i, lines[i])
        elif kind == "swap":
            j = rng.choice(body)
            lines[i], lines[j] = lines[j], lines[i]
        elif kind == "header":
            columns[k] = rng.choice([columns[k] + "_ft", columns[k].split("_")[0], columns[0], "", "x", *NAMES[9:12]])
            lines[first] = ",".join(columns)
        elif kind == "column":
            for j in [first, *body]:
                row = lines[j].split(",")
                del row[min(k, len(row) - 1)]
                lines[j] = ",".join(row)
        elif kind == "short":
            lines[i] = ",".join(cells[:-1])
        elif kind == "rev":
            lines[first + 1 :] = lines[first + 1 :][::-1]
        elif kind == "one":
            del lines[first + rng.choice([0, 1, 2]) :]
            told.append(kind)
            break
        elif kind == "many":
            lines += lines[first + 1 :] * 200
        elif kind == ";":
            lines = [line.replace(".", ",").replace(",", ";") for line in lines]
        told.append(f"{kind} {columns[k][:20]}")
    return ("\n".join(lines) + "\n").encode(), "; ".join(told)


def any_file(rng, text, change):
    """A changed text: by `change`, by its bytes, by its end, by its encoding."""
    way = rng.choice(["change"] * 7 + ["bytes", "cut", "encoding"])
    if way == "bytes":
        return flipped(rng, text.encode()), way
    if way == "cut":
        return cut(rng, text.encode()), way
    return encoded(rng, text) if way == "encoding" else change(rng, text)
