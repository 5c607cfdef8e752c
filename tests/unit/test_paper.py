"""The paper's statements, figures and view, on runs whose numbers are known."""

import base64
import json
import re

import numpy as np
import paper_runs
import pytest
import synthetic
import xarray as xr

from wakeflight.report import viewer
from wakeflight.studies.paper import cases, cost, quantities, readings
from wakeflight.studies.paper.figures import FIGURES
from wakeflight.studies.paper.statements import VERDICTS, counts, judge
from wakeflight.studies.paper.statements.conclusions import lag
from wakeflight.studies.paper.statements.reasons import REASONS, reason
from wakeflight.studies.paper.statements.verdict import Statement, larger, within


@pytest.fixture(scope="module")
def runs():
    return paper_runs.runs()


def test_a_verdict_follows_from_the_conditions():
    met, missed = within("x", 1.0, 0.0, 2.0), within("x", 3.0, 0.0, 2.0)
    assert [Statement("", "", c).verdict for c in ((met, met), (met, missed), (missed, missed), ())] == list(VERDICTS)


def test_a_difference_below_the_resolution_orders_nothing():
    assert larger("x", ("a", 1.02), ("b", 1.0)).met
    assert not larger("x", ("a", 1.005), ("b", 1.0)).met
    assert "equal" in larger("x", ("a", 1.005), ("b", 1.0)).measured
    assert larger("x", ("a", -1.0), ("b", -1.02)).met


def test_nothing_differs_between_compared_runs_but_what_is_compared():
    base = {case.name: case.inflow for case in cases.base_cases()}
    shared = set(vars(cases.MODELS["relaxation"])) & set(vars(cases.MODELS["time-marching"]))
    # how often the flight dynamics get a new inflow is what the paper's two wakes differ by
    for name in shared - {"update_interval"}:
        assert getattr(cases.MODELS["relaxation"], name) == getattr(cases.MODELS["time-marching"], name)
    for case in cases.question_cases():
        reference = base[f"{case.maneuver}/{case.inflow.name}"]
        changed = {name for name, value in vars(case.inflow).items() if value != getattr(reference, name)}
        assert changed in ({"convergence_revolutions"}, {"max_loops_response"})


def test_every_figure_of_the_paper_is_drawn_under_its_number():
    numbers = {int(figure.name.split("-")[1][:2]) for figure in FIGURES}
    assert numbers == set(range(3, 20))


def disk(function):
    psi, station = np.arange(36) * np.pi / 18, synthetic.stations()
    return xr.DataArray(
        function(psi[:, None], station) * np.ones((36, 20)), {"psi": psi, "station": station}, ("psi", "station")
    )


def test_means_over_sectors_are_area_means():
    assert quantities.sector_mean(disk(lambda psi, r: 2.0), (90, 180), (0.6, 1.0)) == pytest.approx(2.0)
    aft = quantities.sector_mean(disk(lambda psi, r: np.cos(psi)), (-90, 90))
    assert aft == pytest.approx(2 / np.pi, rel=0.06)
    assert quantities.sector_mean(disk(lambda psi, r: r), radius=(0.0, 1.0)) == pytest.approx(2 / 3, rel=0.02)
    assert quantities.area_above(disk(lambda psi, r: np.sin(psi)), 1e-9) == pytest.approx(0.5, abs=0.03)


def test_a_straight_centre_line_has_no_bend():
    age = np.arange(145) * np.pi / 18
    helix = np.stack([0.185 * age + np.cos(age), np.sin(age), -0.03 * age], axis=1)
    assert abs(quantities.bend(helix)) < 1e-6
    curved = helix + np.stack([0 * age, 0 * age, 0.002 * age**2], axis=1)
    assert abs(quantities.bend(curved)) > 0.02


def test_a_delayed_history_shows_its_lag(runs):
    run = runs["arrested-descent/time-marching"]
    late = run.copy()
    late["inflow_mean"] = run["inflow_mean"].copy(
        data=np.concatenate([[run.inflow_mean[0]] * 18, run.inflow_mean[:-18]])
    )
    assert lag(late, run, "inflow_mean") == pytest.approx(0.5, abs=1 / 36)


def test_the_counter_of_a_relaxation_wake_goes_on_from_its_trim(runs):
    relaxed, marched = runs["arrested-descent/relaxation"], runs["arrested-descent/time-marching"]
    assert cost.work(relaxed).flight == relaxed.attrs["segment_evaluations"] - 40_000_000
    assert cost.work(marched).flight == marched.attrs["segment_evaluations"] - 60_000_000


def test_every_statement_is_judged(runs):
    table = judge(runs)
    assert sum(counts(table).values()) == len(table) > 40
    assert [row.key for row in table if not row.conditions] == ["conclusion 6"]


def test_figures_12_to_19_are_judged_in_both_readings_with_both_wakes(runs):
    rows = readings.judged(runs)
    assert [row.key for row in rows] == [row.key for row in judge(runs) if re.match(r"Fig. 1[2-9]", row.key)]
    assert [row.verdicts[0] for row in rows] == [row.verdict for row in judge(runs) if row.key in {r.key for r in rows}]
    # what it takes follows from the verdicts
    for verdicts, needs in (
        (("holds",) * 4, "the same in all"),
        (("does not hold", "holds partly", "holds", "holds"), "best augmented"),
        (("holds partly", "holds", "holds partly", "holds"), "best with the standard wake"),
        (("holds partly", "does not hold", "holds partly", "holds"), "best augmented, standard wake"),
    ):
        met = {"holds": (True, True), "holds partly": (True, False), "does not hold": (False, False)}
        statements = tuple(
            Statement("", "", tuple(within("x", 1.0, 0.0, 2.0 if each else 0.5) for each in met[verdict]))
            for verdict in verdicts
        )
        assert readings.Row(statements).needs == needs
    assert sum(int(row[1]) for row in readings.counted(rows)) == len(rows)


def test_the_second_reading_differs_from_the_first_by_its_augmentation_alone():
    first, second = (case.case().maneuver for case in (cases.base_cases()[3], cases.reading_cases()[0]))
    assert first.corners_of == second.corners_of and first.control is None and second.control is not None
    wakes = {case.name: case.inflow for case in cases.reading_cases()}
    for model in ("relaxation", "time-marching"):
        assert wakes[f"roll-reversal-standard/{model}"] == wakes[f"{cases.AUGMENTED}-standard/{model}"]
        assert wakes[f"{cases.AUGMENTED}/{model}"] == cases.MODELS[model]


HISTORIES = (
    "inflow_mean",
    "w",
    "p",
    "q",
    "roll",
    "pitch",
    "force_z",
    "moment_y",
    "beta_1c",
    "beta_1s",
    "lateral",
    "ct",
)


def other(runs, seed):
    """The same flights with everything bent, slowed, raised or lowered at random: data nobody has seen."""
    random, made = np.random.default_rng(seed), {}
    for name, run in runs.items():
        taken = run.copy(deep=True)
        taken.attrs |= {"ct_sigma": random.uniform(0.04, 0.1), "power": random.uniform(2e5, 9e5), "revolutions": 11.0}
        taken.attrs |= {"seconds_wake": random.uniform(1.0, 9.0), "unconverged_revolutions": int(random.integers(9))}
        taken.attrs |= {"segment_evaluations_convergence": int(random.uniform(1e6, 5e7))}
        t = taken.time.values
        for variable in HISTORIES:
            if variable not in taken:
                continue
            values = taken[variable].values
            a, b, rate = random.uniform(-2.0, 2.0, 3)
            moved = a * (values - values[0]) + b * np.ptp(values) * np.sin(9 * rate * t) * t
            taken[variable] = ("time", values[0] * random.uniform(0.5, 1.5) + moved)
        psi = taken["azimuth"].values[:, :, None]
        for variable in ("inflow", "cl", "cl_m2"):
            a, b, c, d = random.uniform(-1.5, 1.5, 4)
            waved = a + b * t[:, None, None] + c * np.cos(psi) + d * np.sin(psi)
            taken[variable] = taken[variable].copy(data=taken[variable].values * waved)
        if "wake" in taken:
            bent = taken["wake"].values.copy()
            n, ages = bent.shape[0], np.arange(bent.shape[2]) / bent.shape[2]
            lift = random.normal(0.0, 1.0, n)
            if seed == 0 and name.startswith("arrested-descent"):
                # relaxation ahead after each update, behind before it
                taken["snapshot_revolution"] = ("snapshot", [4.75, 5.0, 8.0, 10.0])
                lift = np.array([-9.0, 9.0, 9.0, 9.0]) * name.endswith("/relaxation")
            bent[..., 2] += lift[:, None, None] * ages**2
            edge = np.abs(bent[..., 1]) > 0.7 * synthetic.RADIUS
            bent[..., 0] += np.where(edge, *random.uniform(0.0, 2.0, 2)) * (ages if seed % 2 else 1.0)
            taken["wake"] = taken["wake"].copy(data=bent)
        made[name] = taken
    return made


@pytest.fixture(scope="module")
def others(runs):
    return [other(runs, seed) for seed in range(12)]


def words(text):
    return re.sub(r"[-+]?\d[\d.]*", "#", text)


NUMBERS_ALONE = {"text, condition", "text, durations", "text, rates", "cost, coupled", "cost, over all", "conclusion 4"}
"""Reasons that only state numbers: they compare nothing and name no cause."""


@pytest.mark.parametrize("key", REASONS)
def test_what_the_page_concludes_changes_with_the_data(runs, others, key):
    # prose that stood whatever was flown would be no conclusion
    texts = {reason(key, data) for data in (runs, *others)}
    assert len(texts) > 1
    assert len({words(text) for text in texts}) > 1 or key in NUMBERS_ALONE


def test_a_cause_is_not_named_where_the_data_do_not_bear_it(runs):
    # equal wakes: nothing overshoots, nothing is late, nothing bends more
    flat = {name: run.assign(inflow_mean=0.02 + 0.0 * run["inflow_mean"]) for name, run in runs.items()}
    for maneuver in cases.MANEUVERS:
        flat[f"{maneuver}/relaxation"] = flat[f"{maneuver}/time-marching"]
    assert "overshoots" not in reason("Fig. 5b", flat)
    assert "no mark of memory" not in reason("Fig. 19", flat)
    assert "ahead" not in reason("Fig. 11", flat)
    assert "the old wake misses more" not in reason("conclusion 5", flat)


def test_the_view_holds_the_wake_to_a_millimetre(runs):
    flights = {"arrested-descent": {m: runs[f"arrested-descent/{m}"] for m in cases.MODELS}}
    rotor = {"shaft_tilt": 0.05, "hinge_offset": 0.05, "root_cutout": 0.1, "chord": 0.06}
    made = json.loads(viewer.data(flights, rotor))["maneuvers"]["arrested-descent"]["models"]
    assert [model["name"] for model in made] == ["dynamic inflow", "relaxation", "time marching"]
    wake = np.frombuffer(base64.b64decode(made[2]["wake"]), "<i2") / viewer.FULL * made[2]["reach"]
    kept = flights["arrested-descent"]["time-marching"]["wake"].values.ravel() / synthetic.RADIUS
    assert np.max(np.abs(wake - kept)) * synthetic.RADIUS < 1e-3


def test_inflow_over_the_disk_is_found_from_the_blades():
    run = synthetic.run("dynamic")
    psi = run["azimuth"].values[:, :, None]
    field = 0.02 + run["station"].values * (0.01 * np.cos(psi) - 0.003 * np.sin(psi))
    run["inflow"] = run["inflow"].copy(data=field)
    assert viewer.disk_inflow(run, np.array([7]))[0] == pytest.approx([0.02, 0.01, -0.003])
