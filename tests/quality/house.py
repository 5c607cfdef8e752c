"""What can be counted of the house: who imports whom, circles, kinds told apart, sizes; for the tests and for the page."""

import ast
import re
from functools import cached_property
from pathlib import Path

HERE = Path(__file__).resolve().parents[2]


class House:
    """A checkout, read and not imported."""

    def __init__(self, root=HERE):
        self.root = Path(root)
        self.rust = self.root / "crates" / "wakeflight" / "src"
        self.bindings = self.root / "crates" / "wakeflight-py" / "src"
        self.python = self.root / "python" / "wakeflight"

    def name(self, path):
        return str(path.relative_to(self.root))

    @cached_property
    def python_files(self):
        return sorted(self.python.rglob("*.py"))

    @cached_property
    def rust_files(self):
        return sorted(self.rust.rglob("*.rs"))

    @cached_property
    def sources(self):
        folders = ("crates", "python", "tests", "benchmarks", "examples", "validation", "docs")
        found = (
            path for folder in folders for path in (self.root / folder).rglob("*") if path.suffix in (".py", ".rs")
        )
        return sorted(path for path in found if "__pycache__" not in path.parts)

    # --- imports --------------------------------------------------------------------------------------------

    def module(self, path):
        """Dotted name of a Python file within the package; the package itself is the empty name."""
        return ".".join(path.relative_to(self.python).with_suffix("").parts).removesuffix("__init__").rstrip(".")

    @cached_property
    def modules(self):
        return {self.module(path): path for path in self.python_files}

    @cached_property
    def imports(self):
        """Modules that each module imports: anywhere in the file, annotations included."""
        return {name: self._imported(name, path) for name, path in self.modules.items()}

    def _imported(self, name, path):
        package = name.split(".") if path.stem == "__init__" else name.split(".")[:-1]
        package = [part for part in package if part]
        found = set()
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and node.level:
                base = package[: len(package) - node.level + 1] + (node.module.split(".") if node.module else [])
            elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "wakeflight":
                base = node.module.split(".")[1:]
            else:
                continue
            for alias in node.names:
                longer = ".".join([*base, alias.name])
                if longer != "_core":
                    found.add(longer if longer in self.modules else ".".join(base))
        return {each for each in found if each in self.modules} - {name}

    @cached_property
    def python_circles(self):
        """Groups of Python modules that import one another in a circle."""
        return [sorted(group) for group in strongly_connected(self.imports) if len(group) > 1]

    @cached_property
    def rust_circles(self):
        """Groups of Rust modules that use one another in a circle, tests within the files left out."""
        return [sorted(group) for group in strongly_connected(self.rust_uses) if len(group) > 1]

    @cached_property
    def rust_uses(self):
        """Modules that each Rust module names."""
        modules = {}
        for path in self.rust_files:
            parts = list(path.relative_to(self.rust).with_suffix("").parts)
            modules["::".join(parts[:-1] if parts[-1] in ("mod", "lib") else parts)] = path
        return {name: used_in_rust(name, path.read_text(), set(modules)) - {name} for name, path in modules.items()}

    # --- kinds ----------------------------------------------------------------------------------------------

    @cached_property
    def classes(self):
        """Names of the package's own classes, errors left out."""
        defined = {
            node.name
            for path in self.python_files
            for node in ast.walk(ast.parse(path.read_text()))
            if isinstance(node, ast.ClassDef)
        }
        return {name for name in defined if not name.endswith(("Error", "Failure"))}

    @cached_property
    def kinds_told_apart(self):
        """Places that ask what kind of thing an object is: (file, line, text).

        Left out: the readers of files and quantities, where what was typed may be of any kind.
        """
        found = []
        for path in self.python_files:
            if "aircraft" in path.relative_to(self.python).parts or path.stem == "units":
                continue
            tree = ast.parse(path.read_text())
            foreign = {
                alias.asname or alias.name
                for node in ast.walk(tree)
                if isinstance(node, ast.ImportFrom) and not node.level
                for alias in node.names
            }
            for node in ast.walk(tree):
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and self._tells(node, foreign):
                    found.append((self.name(path), node.lineno, ast.unparse(node)))
        return found

    def _tells(self, node, foreign):
        function, arguments = node.func.id, node.args
        if function == "isinstance":
            named = {each.id for each in ast.walk(arguments[1]) if isinstance(each, ast.Name)}
            return bool(named & self.classes - foreign)
        literal = len(arguments) > 1 and isinstance(arguments[1], ast.Constant)
        return function == "hasattr" or (function == "getattr" and (literal or len(arguments) > 2))

    # --- sizes ----------------------------------------------------------------------------------------------

    @cached_property
    def long_files(self):
        """Source files of over 500 lines, by name."""
        return {self.name(path): n for path in self.sources if (n := lines_of(path)) > 500}

    @cached_property
    def lines_of_bindings(self):
        """Lines of the bindings and of the stub that tells their types."""
        return sum(map(lines_of, [*self.bindings.rglob("*.rs"), self.python / "_core.pyi"]))

    @cached_property
    def lines_of_verbs(self):
        """Lines of stand, trim, exchange and flight in Python: what they do, not what they report."""
        left_out = ("results", "monitors", "dataset", "table", "solved")
        return sum(lines_of(path) for path in self.verbs if path.stem not in left_out)

    @cached_property
    def lines_of_verbs_whole(self):
        """The same with what they report: files that change their name do not change this count."""
        return sum(map(lines_of, self.verbs))

    @cached_property
    def verbs(self):
        """Files of stand, trim, exchange and flight in Python."""
        patterns = (
            "tunnel/*.py",
            "trim/*.py",
            "exchange.py",
            "flight.py",
            "simulation.py",
            "stepping.py",
        )
        return {path for pattern in patterns for path in self.python.glob(pattern)}

    @cached_property
    def many_arguments(self):
        """Functions of the core and its bindings that are allowed many arguments: (file, number)."""
        found = [
            (path, path.read_text().count("allow(clippy::too_many_arguments"))
            for path in self.sources
            if path.suffix == ".rs"
        ]
        return [(self.name(path), n) for path, n in found if n]

    @cached_property
    def arithmetic_in_bindings(self):
        """Lines of the bindings that calculate with floating-point numbers: (file, text)."""
        calculates = re.compile(r"\b(TAU|PI)\b|\bas f64\b|\.(sin|cos|sqrt|powi|powf|hypot|atan2|abs|exp|ln)\(")
        found = []
        for path in sorted(self.bindings.rglob("*.rs")):
            code = path.read_text().split("#[cfg(test)]")[0].splitlines()
            found += [
                (path.name, line.strip())
                for line in code
                if calculates.search(line.split("//")[0]) and "use " not in line
            ]
        return found


def lines_of(path):
    return path.read_text().count("\n")


def used_in_rust(name, text, modules):
    """Modules that the Rust module `name` uses or names in full."""
    code = re.sub(r"//.*", "", text.split("#[cfg(test)]")[0])
    paths = [path for tree in re.findall(r"\buse\s+([^;]+);", code) for path in expanded(tree)]
    paths += re.findall(r"\b(?:crate|super)(?:::\w+)+", re.sub(r"\buse\s+[^;]+;", "", code))
    found, here = set(), name.split("::") if name else []
    for path in paths:
        parts = path.split("::")
        if parts[0] == "crate":
            base = []
        elif parts[0] in ("self", "super"):
            base = list(here)
        else:
            continue
        while parts and parts[0] in ("crate", "self", "super"):
            base = base[:-1] if parts.pop(0) == "super" else base
        full = base + parts
        while full and "::".join(full) not in modules:
            full.pop()
        if full:
            found.add("::".join(full))
    return found


def expanded(tree, prefix=""):
    """Paths of a `use` tree: `a::{b, c::d}` is `a::b` and `a::c::d`."""
    depth, parts, current = 0, [], ""
    for letter in tree.strip():
        depth += (letter == "{") - (letter == "}")
        if letter == "," and depth == 0:
            parts.append(current)
            current = ""
        else:
            current += letter
    for part in filter(None, (each.strip() for each in [*parts, current])):
        group = re.match(r"^(.*?)(?:::)?\{(.*)\}$", part, re.DOTALL)
        if group:
            inner = "::".join(filter(None, (prefix, group.group(1).strip())))
            yield from expanded(group.group(2), inner)
        else:
            yield "::".join(filter(None, (prefix, part.split(" as ")[0].strip())))


def strongly_connected(graph):
    """Strongly connected groups of a graph {node: nodes it points to} (Tarjan)."""
    index, low, stack, groups = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for each in sorted(graph.get(node, ())):
            if each not in index:
                visit(each)
                low[node] = min(low[node], low[each])
            elif each in stack:
                low[node] = min(low[node], index[each])
        if low[node] == index[node]:
            group = []
            while not group or group[-1] != node:
                group.append(stack.pop())
            groups.append(group)

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return sorted(groups, key=len, reverse=True)
