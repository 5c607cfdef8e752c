"""What is flown in the cockpit: every run kept and replayed to the same bits, sticks, the ground, the command that starts it."""

import json
import struct
import threading
import time

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import cli
from wakeflight.cockpit import Session, Setup, height_of
from wakeflight.cockpit.messages import Message
from wakeflight.cockpit.pace import Pace
from wakeflight.cockpit.picture import SCALARS
from wakeflight.cockpit.steady import steady
from wakeflight.progress import Silent


class Pilot:
    """Steps one exchange at every picture; `plan(run, k)` says what else is done at the k-th of a run."""

    def __init__(self, setup, plan):
        self.session = Session(setup, Silent(), self.see, Pace(sleep=lambda _: None))
        self.plan, self.seen, self.counts = plan, [], {}
        self.session.run()

    def see(self, shown):
        k = self.counts[shown.run] = self.counts.get(shown.run, 0) + 1
        self.seen.append(shown)
        if json.loads(shown.status)["status"]["preparing"]:
            # what is prepared beside gets the processor
            time.sleep(0.05)
        for message in self.plan(shown.run, k):
            self.session.say(message)


def _scalars(shown):
    return dict(zip(SCALARS, struct.unpack_from(f"<{len(SCALARS)}f", shown.frame, 4), strict=True))


@pytest.fixture(scope="module")
def setup(uh60a):
    rigid = uh60a.with_rigid_blades()
    wake = wf.TimeMarchingWake(turns=2, azimuth_step="15 deg", update_interval="90 deg")
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="5250 ft", weight="16000 lbf")

    def made(folder, *names, **more):
        models = {"dynamic": wf.DynamicInflow(azimuth_step="15 deg"), "time-marching": wake}
        return Setup(rigid, condition, {name: models[name] for name in names}, folder, **more)

    return made


def test_a_session_keeps_every_flight_and_each_replays_to_the_same_bits(setup, tmp_path):
    step, end = Message(do="step"), Message(do="end")

    def plan(run, k):
        sticks = Message(run, (0.5 + 0.01 * min(k, 10), 0.42, 0.3, 0.55))
        if run == 2 and k == 15:
            return [Message(do="restart")]
        if run == 3 and k == 10:
            return [end]
        ask = [Message(inflow="time-marching")] if run == 1 and k == 3 else []
        return [sticks, *ask, step]

    pilot = Pilot(setup(tmp_path, "dynamic", "time-marching", control=steady()), plan)
    assert [each.parent.name for each in pilot.session.runs] == ["01-dynamic", "02-time-marching", "03-time-marching"]
    runs = [wf.open_run(each) for each in pilot.session.runs]
    assert all(run.attrs["finished"] for run in runs)
    first, second, third = runs
    assert first.sizes["time"] % 24 == 1
    # the second goes on where the first ended, the third begins at its trim
    for name in ("u", "p", "roll", "north"):
        assert float(second[name][0]) == float(first[name][-1])
    assert float(third.north[0]) == 0.0 and float(second.north[0]) > 1.0
    assert float(first.lateral.max() - first.lateral[0]) > 0.3
    for path in pilot.session.runs[:2]:
        again = wf.rerun(path)
        assert again.same, (path, again.differing)
    # pictures say what the runs say
    shown = _scalars(pilot.seen[10])
    row = int(np.argmin(np.abs(first.time.values - shown["time"])))
    for name in ("roll", "q", "north"):
        assert shown[name] == pytest.approx(float(first[name][row]), rel=1e-6)
    assert shown["lateral"] == pytest.approx(float(first.lateral[row]) / 10.0, abs=1e-4)
    assert 0.8 < shown["load_factor"] < 1.2 and 60e3 < shown["thrust"] < 80e3 and 3e5 < shown["power"] < 2e6
    openings = {each.run: json.loads(each.opening)["opening"] for each in pilot.seen}
    assert [openings[k]["ages"] for k in (1, 2, 3)] == [0, 49, 49]
    assert [openings[k]["continued"] for k in (1, 2, 3)] == [False, True, False]
    blades = openings[2]["blades"]
    numbers = len(SCALARS) + 3 * blades + 3 + 4 * blades * 49
    assert {len(each.frame) for each in pilot.seen if each.run == 2} == {4 + 4 * numbers}


def test_sticks_of_a_run_that_has_ended_are_not_taken_and_hands_move_as_fast_as_they_can(setup, tmp_path):
    def plan(run, k):
        if k == 12:
            return [Message(do="end")]
        return [Message(run, (1.0, 0.42, 0.3, 0.5)), Message(run + 1, (0.0, 0.0, 0.0, 0.0)), Message(do="step")]

    pilot = Pilot(setup(tmp_path, "dynamic"), plan)
    run = wf.open_run(pilot.session.runs[0])
    rate = np.diff(run.lateral.values) / np.diff(run.time.values)
    assert rate.max() == pytest.approx(10.0, rel=2e-3) and rate.min() >= -1e-9
    assert not run.attrs["warnings"] or "moves at" not in run.attrs["warnings"]


def test_the_drawn_ground_ends_a_run(setup, tmp_path):
    states = []

    def plan(run, k):
        states.append(json.loads(pilot_state())["status"]["state"])
        return [Message(run, (0.5, 0.42, 0.0, 0.55)), Message(do="end" if states[-1] == "ended" else "step")]

    def pilot_state():
        return sessions[0].shown.status

    sessions = []
    session = Session(setup(tmp_path, "dynamic", height=1.0), Silent(), lambda shown: None, Pace(sleep=lambda _: None))
    sessions.append(session)
    count = iter(range(1, 10_000))
    session.publish = lambda shown: [session.say(each) for each in plan(shown.run, next(count))]
    session.run()
    run = wf.open_run(session.runs[0])
    assert run.attrs["finished"] and states[-1] == "ended"
    assert 0.9 < float(run.down[-1]) < 1.5


def test_a_ground_that_cannot_be_is_refused():
    for wrong in (0.5, 3e4, float("nan")):
        with pytest.raises(wf.InputError, match="ground"):
            height_of(wrong)


def test_orders_that_pile_up_are_not_taken(setup, tmp_path):
    session = Session(setup(tmp_path, "dynamic"), Silent())
    assert all(session.say(Message(do="step")) for _ in range(64))
    assert not session.say(Message(do="step"))
    assert threading.active_count() < 50


@pytest.mark.parametrize(
    "arguments, named",
    [
        (["--inflow", "relaxation"], "--inflow"),
        (["--port", "70000"], "--port"),
        (["--ground", "1 in"], "ground"),
        (["--control", "nowhere.toml"], "nowhere.toml"),
        (["--wake", "turns=-1"], "turns"),
    ],
)
def test_what_cannot_be_flown_is_one_line_and_exit_code_2(capsys, arguments, named):
    with pytest.raises(SystemExit) as end:
        cli.main(["cockpit", "--no-browser", *arguments])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert named in said and said.count("\n") == 1


def test_the_command_flies_the_preset_paper_steadied_unless_something_else_is_asked(monkeypatch, tmp_path):
    asked = []
    monkeypatch.setattr("wakeflight.cockpit.cockpit", lambda setup, *more: asked.append((setup, *more)))
    for arguments in ([], ["--wake", "turns=3", "--inflow", "dynamic", "--control", "none"], ["--wake", "standard"]):
        with pytest.raises(SystemExit) as end:
            cli.main(
                ["cockpit", "--no-browser", "--port", "0", "--ground", "100 m", "--out", str(tmp_path), *arguments]
            )
        assert end.value.code == 0
    (first, port, browse, _), (second, *_), (third, *_) = asked
    assert (port, browse, first.height, first.folder) == (0, False, 100.0, tmp_path)
    assert list(first.models) == ["time-marching", "dynamic"] and list(second.models) == ["dynamic", "time-marching"]
    assert first.models["time-marching"] == wf.TimeMarchingWake.preset("paper")
    assert second.models["time-marching"] == wf.TimeMarchingWake.preset("paper", turns=3)
    assert third.models["time-marching"] == wf.TimeMarchingWake()
    assert first.control == steady() and second.control.nothing
