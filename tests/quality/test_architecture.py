# SPDX-License-Identifier: MIT OR Apache-2.0
"""Does the page for newcomers say what is: files it names exist, every room has its row and stands in the drawing."""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "tools"))
import layout
import rooms
from house import House

ROOT = rooms.ROOT
PAGE = (ROOT / "docs" / "architecture.md").read_text()
HOUSE = House()
PLACES = (HOUSE.rust, HOUSE.python, ROOT)


def test_every_file_the_page_names_exists():
    named = re.findall(r"`([\w/.-]+\.(?:rs|py|bib))`", PAGE)
    assert len(named) > 20
    missing = [name for name in named if not any((place / name).is_file() for place in PLACES)]
    assert not missing, "run docs/tools/rooms.py, or correct the page"


def test_every_room_has_its_row_and_stands_in_the_drawing():
    drawing = (ROOT / "docs" / "images" / "rooms.svg").read_text()
    found = [*rooms.python_rooms(HOUSE), *rooms.rust_rooms(HOUSE)]
    missing = [room for room in found if f"| `{room}` |" not in PAGE or f">{room}<" not in drawing]
    assert not missing, "run docs/tools/rooms.py"


def test_the_drawing_keeps_boxes_apart_and_arrows_pointing_down():
    graph = {"a": {"b", "c", "d"}, "b": {"d"}, "c": {"d"}, "d": set(), "e": {"d"}}
    places, routes = layout.placed(rooms.reduced(graph))
    assert ("a", "d") not in routes
    for (start, end), corners in routes.items():
        assert places[start][1] > places[end][1]
        assert [y for _, y in corners] == sorted((y for _, y in corners), reverse=True)
    for one, (x, y) in places.items():
        assert all(one == other or abs(x - a) > 0.99 or y != b for other, (a, b) in places.items())
