# SPDX-License-Identifier: MIT OR Apache-2.0
"""Places for the nodes of a graph without circles, in layers, and routes for its arrows that pass between them."""

from __future__ import annotations

SWEEPS = 24

Place = tuple[float, float]


def placed(graph: dict[str, set[str]]) -> tuple[dict[str, Place], dict[tuple[str, str], list[Place]]]:
    """Place of every node (x to the right, y up, what is stood on below), and corners of every arrow from node to node.

    Layers by the longest way down; long arrows get a place in every layer they cross; places within a layer by the mean of the
    neighbours above and below, swept up and down.
    """
    levels = _levels(graph)
    neighbours: dict[object, set[object]] = {}
    chains: dict[tuple[str, str], list[object]] = {}
    layers: dict[int, list[object]] = {}
    for node, level in sorted(levels.items()):
        layers.setdefault(level, []).append(node)
    for start in sorted(graph):
        for end in sorted(graph[start]):
            between = [(start, end, level) for level in range(levels[start] - 1, levels[end], -1)]
            for each in between:
                layers[each[2]].append(each)
            chain = [start, *between, end]
            chains[start, end] = chain
            for a, b in zip(chain, chain[1:], strict=False):
                neighbours.setdefault(a, set()).add(b)
                neighbours.setdefault(b, set()).add(a)
    x = {node: float(k) for layer in layers.values() for k, node in enumerate(layer)}
    level_of = {node: level for level, layer in layers.items() for node in layer}
    for sweep in range(SWEEPS):
        order = sorted(layers) if sweep % 2 else sorted(layers, reverse=True)
        for level in order:
            side = 1 if sweep % 2 == 0 else -1
            wished = {}
            for node in layers[level]:
                near = [
                    x[other]
                    for other in neighbours.get(node, ())
                    if level_of[other] == level + side or sweep > SWEEPS // 2
                ]
                wished[node] = sum(near) / len(near) if near else x[node]
            _spread(layers[level], wished, x)
    shift = min(x.values())
    place = {node: (x[node] - shift, float(level_of[node])) for node in x}
    nodes = {node: place[node] for node in levels}
    return nodes, {arrow: [place[each] for each in chain] for arrow, chain in chains.items()}


def _levels(graph: dict[str, set[str]]) -> dict[str, int]:
    """Longest way down from every node; then each as high as those that stand on it leave room for."""
    found: dict[str, int] = {}

    def level(node: str) -> int:
        if node not in found:
            found[node] = 1 + max((level(each) for each in graph.get(node, ())), default=-1)
        return found[node]

    for node in graph:
        level(node)
    users: dict[str, list[str]] = {}
    for node, used in graph.items():
        for each in used:
            users.setdefault(each, []).append(node)
    for node in sorted(found, key=lambda each: -found[each]):
        if node in users:
            found[node] = min(found[user] for user in users[node]) - 1
    return found


def _spread(layer: list[object], wished: dict[object, float], x: dict[object, float]) -> None:
    """Places of a layer near those wished for, in their order, a node's width apart and a route's less."""

    def gap(a: object, b: object) -> float:
        routes = sum(isinstance(each, tuple) for each in (a, b))
        return (1.0, 0.62, 0.24)[routes]

    layer.sort(key=lambda node: (wished[node], str(node)))
    places = [wished[node] for node in layer]
    for _ in range(40):
        for k in range(1, len(layer)):
            short = gap(layer[k - 1], layer[k]) - (places[k] - places[k - 1])
            if short > 1e-9:
                places[k - 1] -= short / 2
                places[k] += short / 2
    for k in range(1, len(layer)):
        places[k] = max(places[k], places[k - 1] + gap(layer[k - 1], layer[k]))
    for node, place in zip(layer, places, strict=True):
        x[node] = place
