"""Numbers of an aircraft's file replaced from Python: checked as the file is, kept in runs, flown again."""

import json
import pickle

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import cli
from wakeflight.aircraft.bundle import Bundle

AIRCRAFT = wf.load_aircraft("uh60a")
CHANGES = {
    "rotor.omega": "26.5 rad/s",
    "rotor.position": ["341 in", "0 in", "315 in"],
    "rotor.blade.structure.mass": "x 1.05",
    "tail_rotor.radius": "x 1.02",
    "loading.cg_station": "355 in",
    "discretisation.n_modes": 6,
    "limits": {"power": "2500 hp"},
}
VARIED = AIRCRAFT.with_(CHANGES)


def test_numbers_of_every_form_take_their_place():
    assert float(VARIED.rotor.omega) == 26.5
    assert VARIED.rotor.hub == pytest.approx([341 * 0.0254, 0.0, 315 * 0.0254])
    assert VARIED.blade_mass == pytest.approx(1.05 * AIRCRAFT.blade_mass, rel=1e-12)
    assert VARIED.rotors["tail"].radius == pytest.approx(1.02 * AIRCRAFT.rotors["tail"].radius)
    assert float(VARIED.loading.cg_station) == pytest.approx(355 * 0.0254)
    assert VARIED.discretisation.n_modes == 6
    assert VARIED.limits.power == pytest.approx(2500 * 745.6998715822702)
    # the aircraft it was made of stays as it was
    assert float(AIRCRAFT.rotor.omega) == 27.0 and not AIRCRAFT.changes


def test_what_was_changed_is_told():
    assert VARIED.changes == CHANGES and "rotor.omega" in repr(VARIED)
    assert VARIED.rotor.omega.provenance.sources == ("varied",)


def test_a_factor_is_of_the_number_before():
    twice = AIRCRAFT.with_({"rotor.omega": "x 1.1"}).with_({"rotor.omega": "x 1.1"})
    assert float(twice.rotor.omega) == pytest.approx(27.0 * 1.21)


def test_what_was_chosen_beside_the_file_stays():
    chosen = AIRCRAFT.with_rigid_blades().mirrored().discretised(n_elements=3).with_({"rotor.omega": "26 rad/s"})
    assert not chosen.flexible and chosen.spec.mirrored and chosen.discretisation.n_elements == 3
    assert AIRCRAFT.with_({"stabilator": None}).spec.stabilator is None


def test_copies_and_bundles_hold_the_same_aircraft():
    again = Bundle.from_dict(json.loads(json.dumps(Bundle.of(VARIED).as_dict()))).aircraft()
    for other in (again, pickle.loads(pickle.dumps(VARIED))):
        assert other.core_data() == VARIED.core_data() and other.changes == VARIED.changes


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"rotor.omga": "27 rad/s"}, "rotor.omga = 'unknown key': is omega meant"),
        ({"rotor.radius": "27 kg"}, "rotor.radius = '27.0 kg'"),
        ({"rotor.radius": 27}, "rotor.radius = '27': unit '1' is not a unit of m"),
        ({"rotor.radius": "900 ft"}, "must be at most 328.084 ft"),
        ({"rotor.radius": "27.5 ft"}, "must cover"),
        ({"rotor.radius.x": "1 m"}, "radius is none"),
        ({"rotor.blade.structure.mas": "x 2"}, "columns of the table: r_in_m"),
        ({"rotor.n_blades": 3.5}, "must be a whole number"),
        ({"rotor.blade.precone": "x two"}, "rotor.blade.precone"),
        ({"wings": None}, "did you mean"),
        ({"rotor.radius": object()}, "must be text with a unit"),
        ([1], "values by dotted names"),
    ],
)
def test_what_the_file_could_not_say_is_refused_by_name(changes, said):
    with pytest.raises(wf.InputError, match=said.replace("(", r"\(")):
        AIRCRAFT.with_(changes)


def test_a_run_of_a_varied_aircraft_says_so_and_flies_again(tmp_path):
    condition = wf.FlightCondition(speed="60 kt", flight_path="0 deg")
    start = wf.trim(VARIED, condition, inflow="dynamic")
    assert json.loads(start.to_dataset().attrs["configuration"])["varied"] == CHANGES
    hands = wf.Maneuver("step", {"lateral": [(0.0, 0.0), (0.1, 0.3)]}, seconds=0.2)
    flight = wf.fly(start, hands, integrator="fixed")
    path = flight.save(tmp_path / "run.nc")
    again = wf.rerun(path)
    assert "x 1.05" in flight.data.attrs["input"]
    np.testing.assert_array_equal(again.flight.data.p, flight.data.p)


def test_the_command_line_and_case_files_vary_too(tmp_path, capsys):
    for arguments in (
        ["trim", "--inflow", "dynamic", "--set", "rotor.omega=x 0.98", "--set", "discretisation.n_modes=3"],
        ["run", str(tmp_path / "case.toml")],
    ):
        folder = tmp_path / arguments[0]
        (tmp_path / "case.toml").write_text(
            'command = "trim"\n[inflow]\nmodel = "dynamic"\n[changes]\nrotor.omega = "x 0.98"\n'
            f'"discretisation.n_modes" = 3\n[outputs]\nfolder = "{folder}"\n'
        )
        more = ["--out", str(folder)] if arguments[0] == "trim" else []
        with pytest.raises(SystemExit) as ended:
            cli.main([*arguments, *more])
        assert ended.value.code == 0
        from wakeflight.results import load

        assert load(folder / "trim.nc").attrs["omega"] == pytest.approx(0.98 * 27.0)
    capsys.readouterr()
    with pytest.raises(SystemExit) as ended:
        cli.main(["trim", "--set", "rotor.omega"])
    assert ended.value.code == 2 and "NAME=VALUE" in capsys.readouterr().err
