"""What can be counted of the house: its files, who imports whom, circles, kinds told apart; for the tests and for the page."""

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
        found = (path for folder in folders for path in (self.root / folder).rglob("*") if path.suffix in (".py", ".rs"))
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
    def circles(self):
        """Groups of modules that import one another in a circle, largest first, and the pairs that do so directly."""
        return [sorted(group) for group in strongly_connected(self.imports) if len(group) > 1]

    @cached_property
    def pairs(self):
        """Pairs of modules each of which imports the other."""
        return sorted(
            (a, b) for a, found in self.imports.items() for b in found if a < b and a in self.imports[b]
        )

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
        """Places that ask what kind of thing an object is: (file, line, text)."""
        found = []
        for path in self.python_files:
            text = path.read_text()
            for node in ast.walk(ast.parse(text)):
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and self._tells(node):
                    found.append((self.name(path), node.lineno, ast.unparse(node)))
        return found

    def _tells(self, node):
        function, arguments = node.func.id, node.args
        if function == "isinstance":
            named = {each.id for each in ast.walk(arguments[1]) if isinstance(each, ast.Name)}
            return bool(named & self.classes)
        literal = len(arguments) > 1 and isinstance(arguments[1], ast.Constant)
        return function == "hasattr" or (function == "getattr" and (literal or len(arguments) > 2))


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
