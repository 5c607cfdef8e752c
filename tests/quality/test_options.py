# SPDX-License-Identifier: MIT OR Apache-2.0
"""Every option is declared once, and everything said of it elsewhere is made from that."""

import re

import pytest
from generated_options import FILES, ROOT

from wakeflight.options import DECLARED
from wakeflight.references import known_keys

DECLARING = (
    ROOT / "crates" / "wakeflight" / "src" / "wake" / "options" / "declared.rs",
    ROOT / "crates" / "wakeflight" / "src" / "inflow" / "options.rs",
)
DECLARATION = re.compile(r"^        (\w+): [\w<>]+ = (?:always|by_regime|left_open)\(", re.MULTILINE)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_what_is_made_from_the_declarations_is_current(path):
    assert path.read_text() == FILES[path](), "run python tests/quality/generated_options.py"


def test_every_option_is_declared_in_one_file_and_nowhere_described_again():
    declared = {path: DECLARATION.findall(path.read_text()) for path in DECLARING}
    names = [name for found in declared.values() for name in set(found)]
    assert sorted(names) == sorted({option.name for option in DECLARED})
    assert len(names) == len(set(names)), "declared in two files"
    # a default, a range or a list of words of an option anywhere else in the package's Python would be a second telling
    telling = re.compile(rf"^\s*[\"']?({'|'.join(names)})[\"']?: ?(?:\(|\w+(?: \| None)? = )", re.MULTILINE)
    told = {
        f"{path.name}: {name}"
        for path in (ROOT / "python" / "wakeflight").rglob("*.py")
        for name in telling.findall(path.read_text())
    }
    # flags older than --wake, the step that aircraft and rotor files give, and the segment law of `induced_velocity`
    others = {"groups.py", "wake.py", "schema.py", "rotor_file.py"}
    law = {"vortex.py: core_distance", "vortex.py: curvature_correction"}
    # on a stand and on a wing blades are modelled in one way more
    blades = {f"{file}: blade_model" for file in ("__init__.py", "model.py", "tunnel.py", "wing.py")}
    assert told <= {*(f"{file}: azimuth_step" for file in others), *law, *blades}


def test_every_source_of_an_option_is_in_the_bibliography():
    cited = {key for option in DECLARED for key in option.sources}
    assert cited <= known_keys()
