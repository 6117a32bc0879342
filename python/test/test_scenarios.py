# SPDX-License-Identifier: Apache-2.0
"""Scenarios and worlds created in Python; links, explanations, coverage maps; stepped simulation."""

import copy
import math
import multiprocessing
import os
import pickle
import signal
import threading
import time
import warnings

import numpy as np
import pytest

import tagfield


def portal(**keys):
    content = {
        "duration_s": 2,
        "model": "link_budget",
        "antennas": [{"name": "gate", "pose": [0, 0, 1, 0, 0, 0]}],
        "tags": [{"id": "tag1", "position": [2, 0, 1], "rpy": [0, 0, math.pi]}],
    }
    return tagfield.Scenario("portal", **{**content, **keys})


def test_scenario_in_python_runs():
    run = portal().run()
    assert len(run.reads) > 10
    assert set(run.reads.names("tag")) == {"tag1"}
    assert "portal" in repr(run)


def test_scenario_takes_numpy():
    tags = [{"id": f"t{i}", "position": place} for i, place in enumerate(np.eye(3))]
    assert set(portal(tags=tags).tags) == {"t0", "t1", "t2"}
    np.testing.assert_array_equal(portal(tags=tags).tags["t1"], [0, 1, 0])


@pytest.mark.parametrize("keys, said", [
    ({"tag": []}, "unknown key 'tag'"),
    ({"tags": []}, "no tags"),
    ({"antennas": [{"name": "gate", "pose": [0, 0, 1], "rate_hz": -1}]}, r"antennas\[0\]\.rate_hz"),
    ({"duration_s": float("nan")}, "scenario: duration_s is nan, expected a finite number"),
    ({"tags": [{"id": "t", "position": [0, math.nan, 1]}]}, r"scenario: tags\[0\]\.position\[1\] is nan"),
    ({"zones": [{"name": {1}}]}, r"scenario: zones\[0\]\.name is \{1\}, expected"),
    ({"world": 3}, "scenario: world is 3, expected"),
    ({"duration_s": None}, "duration_s"),
])
def test_complaints_name_the_key(keys, said):
    with pytest.raises(tagfield.Error, match=said) as raised:
        portal(**keys)
    assert "\n" not in str(raised.value)


def test_what_is_odd_is_a_warning_at_the_caller_s_line():
    with pytest.warns(tagfield.TagfieldWarning, match="pose.sigma_m has no effect with source: true") as warned:
        odd = portal().with_({"pose.sigma_m": 0.1})
    assert [str(one.message) for one in warned] == odd.warnings
    assert warned[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        portal()


def test_free_space_falls_by_the_square():
    link = portal().link()
    near, far = link(2, 0, 1), link(4, 0, 1)
    assert near.distance_m == pytest.approx(2)
    assert near.tag_dbm - far.tag_dbm == pytest.approx(20 * math.log10(2), abs=1e-9)
    assert near.reply_dbm - far.reply_dbm == pytest.approx(40 * math.log10(2), abs=1e-9)
    assert near.readable and not link(200, 0, 1).readable


PAPER = {"model": "paper", "antennas": [{"name": "gate", "pose": [0, 0, 1], "range_m": 3}]}
SEPARATE = {"without": ["occlusion"],
            "antennas": [{"name": "gate", "pose": [0, 0, 1], "receive_pose": [0, 0.4, 0.1]}]}


@pytest.mark.parametrize("keys", [{}, {"without": ["occlusion"]}, SEPARATE, PAPER])
@pytest.mark.parametrize("count", [0, 1, 50, 64, 65, 1000])
def test_batch_is_the_same_as_one_by_one(keys, count):
    link = portal(**keys).link()
    places = np.random.default_rng(1).uniform([0.5, -2, 0.5], [4, 2, 1.5], (count, 3))
    rows = link.batch(places)
    assert rows.dtype.names == ("distance_m", "tag_dbm", "reply_dbm", "phase_rad", "readable")
    assert len(rows) == count
    for place, row in zip(places, rows):
        one = link(*place)
        np.testing.assert_equal([getattr(one, name) for name in rows.dtype.names], list(row))
        assert 0 <= one.phase_rad < 2 * math.pi


def test_batch_has_the_same_bytes_again():
    link = portal(without=["occlusion"]).link()
    places = np.random.default_rng(1).uniform([0.5, -2, 0.5], [4, 2, 1.5], (100, 3))
    rows = link.batch(places).tobytes()
    for _ in range(20):
        dirty = np.full(len(rows), 0xFF, np.uint8)
        del dirty  # NumPy is likely to use its memory again.
        assert link.batch(places).tobytes() == rows


def test_batch_takes_finite_positions_only():
    link = portal(without=["occlusion"]).link()
    with pytest.raises(tagfield.Error, match=r"\(N, 3\)"):
        link.batch(np.zeros(3))
    with pytest.raises(tagfield.Error, match="finite"):
        link(math.nan, 0, 0)
    for odd in (math.nan, -math.nan, math.inf, -math.inf):
        for at in (0, 100, 299):
            places = np.full(300, 1.7e308)
            places[at] = odd
            with pytest.raises(tagfield.Error, match="finite"):
                link.batch(places.reshape(100, 3))


def test_batch_obeys_the_laws_of_free_space():
    # Along one ray only the distance changes: there and back are two distances.
    frequency_hz = 866.3e6
    gate = {"name": "gate", "pose": [0, 0, 1], "frequency_hz": frequency_hz}
    link = portal(without=["occlusion", "phase_offsets"], antennas=[gate]).link()
    distance_m = np.linspace(0.5, 9, 300)
    ray = np.array([0.9, 0.3, math.sqrt(0.1)])
    rows = link.batch([0, 0, 1] + distance_m[:, None] * ray)
    np.testing.assert_allclose(rows["distance_m"], distance_m, rtol=1e-14)
    turns = 2 * (distance_m - distance_m[0]) * frequency_hz / 299_792_458
    assert np.abs(np.exp(1j * (rows["phase_rad"] - rows["phase_rad"][0])) - np.exp(2j * math.pi * turns)).max() < 1e-11
    lost_db = 20 * np.log10(distance_m / distance_m[0])
    np.testing.assert_allclose(rows["tag_dbm"][0] - rows["tag_dbm"], lost_db, atol=1e-10)
    np.testing.assert_allclose(rows["reply_dbm"][0] - rows["reply_dbm"], 2 * lost_db, atol=1e-10)


def test_world_in_python_is_in_the_way():
    world = tagfield.World().floor()
    world.box("screen", size_m=(0.02, 3, 3), position_m=(1, 0, 1.5), material="metal")
    behind = portal(world=world)
    assert not behind.link()(2, 0, 1).readable
    explanation = behind.explain(tag="tag1")
    assert not explanation.read
    assert "screen (metal)" in explanation.verdict
    assert explanation.verdict in str(explanation)
    assert len(behind.run().reads) == 0
    assert [name for name, _ in behind.outlines()] == ["screen"]
    with pytest.raises(tagfield.Error, match="already"):
        world.box("screen", (1, 1, 1), (0, 0, 0))
    with pytest.raises(tagfield.Error, match="over 0"):
        world.sphere("ball", 0, (0, 0, 0))


def test_worlds_name_files_outside_only_where_that_is_allowed(tmp_path):
    elsewhere, hall = tmp_path / "elsewhere", tmp_path / "hall"
    for folder in (elsewhere, hall):
        folder.mkdir()
    (elsewhere / "wall.stl").write_text(
        "solid w\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        "endsolid w\n")
    (hall / "world.sdf").write_text(
        '<sdf version="1.6"><world name="w"><model name="m"><static>1</static><link name="l">'
        f'<collision name="c"><geometry><mesh><uri>file://{elsewhere}/wall.stl</uri></mesh></geometry></collision>'
        "</link></model></world></sdf>")
    scenario = hall / "hall.yaml"
    scenario.write_text("world: {path: world.sdf}\nduration_s: 1\nantennas: [{name: a, pose: [0, 0, 1]}]\n"
                        "tags: [{id: t, position: [1, 0, 1]}]\n")
    with pytest.raises(tagfield.Error, match="allow_outside=True"):
        tagfield.load(scenario)
    assert len(tagfield.load(scenario, allow_outside=True).with_(seed=2).run().reads) > 0
    with pytest.warns(tagfield.TagfieldWarning, match=r"\(allow_outside=True reads it\): left out"):
        assert len(tagfield.load(scenario, skip_missing=True).run().reads) > 0


def test_a_scenario_keeps_its_world():
    world = tagfield.World().floor()
    kept = portal(world=world)
    world.box("metal_sheet", size_m=(0.02, 3, 3), position_m=(1, 0, 1.5), material="metal")
    for scenario in (kept, kept.with_(seed=2)):
        assert len(scenario.run(method="hyperbola").reads) == len(scenario.run().reads) > 0
    compared = tagfield.bench(kept, ["trilateration"])
    assert compared.tags()["reads"].tolist() == [len(kept.run(seed=1).reads)]
    assert len(portal(world=world).run().reads) == 0
    assert world.solids == ["floor", "metal_sheet"]


def test_a_solid_s_name_is_no_pattern():
    world = tagfield.World()
    with pytest.raises(tagfield.Error, match=r"name of a solid is 'b\*', expected text without '\*'"):
        world.box("b*", (1, 1, 1), (5, 5, 0), material="metal")
    assert world.solids == [] and world.materials == {}


def test_paths_stay_what_they_were(tmp_path, monkeypatch):
    (tmp_path / "row.yaml").write_text("duration_s: 1\nantennas: [{name: a, pose: [0, 0, 1]}]\n"
                                       "tags: [{id: t, position: [1, 0, 1]}]\n", encoding="utf-8")
    (tmp_path / "world.sdf").write_text(
        '<sdf version="1.6"><world name="w"><model name="wall"><static>1</static><link name="l">'
        '<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>'
        "</link></model></world></sdf>", encoding="utf-8")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path)
    loaded, made = tagfield.load("row.yaml"), portal(world="world.sdf")
    monkeypatch.chdir("elsewhere")
    assert "position: [1, 0, 1]" in loaded.text
    for scenario in (loaded, made):
        assert len(scenario.with_(seed=2).run(method="trilateration").reads) > 0
        assert "trilateration" in str(tagfield.bench(scenario, ["trilateration"]))


def test_mesh_is_a_wall():
    world = tagfield.World()
    world.mesh("metal_sheet", [[1, -2, 0], [1, 2, 0], [1, 2, 3], [1, -2, 3]], [[0, 1, 2], [0, 2, 3]],
               material="metal")
    assert not portal(world=world).link()(2, 0, 1).readable
    with pytest.raises(tagfield.Error, match="vertex 9"):
        tagfield.World().mesh("m", np.zeros((3, 3)), [[0, 1, 9]])
    with pytest.raises(tagfield.Error, match="triangles has 1.7, expected whole numbers"):
        tagfield.World().mesh("m", np.eye(3), [[0, 1, 1.7]])


def test_coverage_takes_a_tag_s_settings():
    scenario = portal()
    share = {}
    for dbm in (-20, "-5", np.float64(0)):
        coverage = scenario.coverage(antennas="gate", heights_m=1, step_m=1, region_m=(-9, -9, 9, 9),
                                     tag={"sensitivity_dbm": dbm})
        share[dbm] = coverage.layers[0].share_read
    assert share[-20] > share["-5"] > share[0.0]
    with pytest.raises(tagfield.Error, match="coverage: tag: sensitivity_dbm is nan, expected a finite number"):
        scenario.coverage(step_m=1, tag={"sensitivity_dbm": math.nan})
    with pytest.raises(tagfield.Error, match="tag sensitivity=1: not a setting of a tag"):
        scenario.coverage(step_m=1, tag={"sensitivity": 1})


@pytest.mark.parametrize("ask, said", [
    (lambda of: of.link(tag_rpy_rad=(0, 0, math.nan)), "link: tag_rpy_rad is (0, 0, nan), expected 3 finite numbers"),
    (lambda of: of.link(tag_rpy_rad=(0, 0)), "link: tag_rpy_rad is (0, 0), expected 3 finite numbers"),
    (lambda of: of.link(time_s=-1), "link: time_s is -1, expected a finite number, 0 or more"),
    (lambda of: of.link(antenna="nope"), "link: antenna: there is no antenna 'nope' (known: gate)"),
    (lambda of: of.explain(time_s=math.nan), "explain: time_s is nan, expected a finite number, 0 or more"),
    (lambda of: of.explain(tag="nope"), "explain: tag: there is no tag 'nope' (known: tag1)"),
    (lambda of: of.coverage(heights_m=[math.nan]), "coverage: heights_m is nan, expected a finite number"),
    (lambda of: of.coverage(step_m=-1), "coverage: step_m is -1, expected a finite number, over 0"),
    (lambda of: of.coverage(time_s=-1), "coverage: time_s is -1, expected a finite number, 0 or more"),
    (lambda of: of.coverage(region_m=(0, 0, 1)), "coverage: region_m is (0, 0, 1), expected 4 finite numbers"),
    (lambda of: of.coverage(antennas="nope"), "coverage: antennas: there is no antenna 'nope' (known: gate)"),
    (lambda of: of.run(seed=-1), "run: seed is -1, expected 0 or more"),
    (lambda of: of.run(seed=1.5), "run: seed is 1.5, expected a whole number, 0 or more"),
    (lambda of: of.run(seed=2**64), "run: seed is 18446744073709551616, expected at most 18446744073709551615"),
    (lambda of: of.run(threads=0), "threads is 0, expected 1 to 1024"),
    (lambda of: of.run(threads=2.0), "threads is 2.0, expected a whole number, 1 to 1024"),
    (lambda of: of.run(method=len), "run: method is <built-in function len>, expected a name or a function "
     'decorated with @tagfield.method("name")'),
    (lambda of: of.run(method="nope"), "run: localization.method is 'nope', which is not known"),
    (lambda of: of.run_many(-3), "run_many: seeds is -3, expected 1 or more"),
    (lambda of: of.run_many(0), "run_many: seeds is 0, expected 1 or more"),
    (lambda of: of.run_many([]), "run_many: seeds is empty, expected at least one seed"),
    (lambda of: of.run_many(2, progress=3), "run_many: progress is 3, expected a function of the completed share, 0 to 1"),
    (lambda of: of.run_many(2, locate="no"), "run_many: locate is 'no', expected True or False"),
    (lambda of: of.run(progress=3), "run: progress is 3, expected a function of the completed share, 0 to 1"),
    (lambda of: of.run(locate=None), "run: locate is None, expected True or False"),
    (lambda of: of.run(outlets=print), "run: outlets is <built-in function print>, expected a list of outlets: outlets=[…]"),
    (lambda of: of.run(outlets="x"), "run: outlets is 'x', expected a list of outlets"),
    (lambda of: of.simulation(outlets=print), "simulation: outlets is <built-in function print>, expected a list"),
    (lambda of: of.simulation(robot=3), "simulation: robot is 3, expected a name"),
    (lambda of: of.simulation(robot="r", policy=3), "simulation: policy is 3, expected a function of the time [s]"),
    (lambda of: of.explain(antenna=3), "explain: antenna is 3, expected a name"),
    (lambda of: of.explain(tag=3), "explain: tag is 3, expected an ID"),
    (lambda of: of.link(antenna=3), "link: antenna is 3, expected a name"),
    (lambda of: of.link(tag=None), "link: tag is None, expected an ID"),
    (lambda of: of.coverage(progress=3), "coverage: progress is 3, expected a function of the completed share, 0 to 1"),
    (lambda of: of.coverage(tag=3), "coverage: tag is 3, expected a mapping from setting to value"),
    (lambda of: of.coverage(tag_profile=3), "coverage: tag_profile is 3, expected a path"),
    (lambda of: of.track(lane=3), "track: lane is 3, expected a list of numbers"),
    (lambda of: of.track(lane=(0, 0, math.nan)), "track: lane is [0.0, 0.0, nan], expected finite numbers"),
    (lambda of: of.track(line=(0, math.inf, 0)), "track: line is [0.0, inf, 0.0], expected finite numbers"),
    (lambda of: of.track(speed_m_s=(0, math.nan)), "track: speed_m_s is (0, nan), expected two finite numbers"),
    (lambda of: of.outlines("low"), "outlines: low_m is 'low', expected a finite number"),
    (lambda of: tagfield.share(3), "share: name is 3, expected a path"),
    (lambda of: of.track(method=3), "track: method is 3, expected text"),
    (lambda of: of.track(speed_m_s=1), "track: speed_m_s is 1, expected two numbers"),
    (lambda of: of.track(bidirectional="x", lane=(0, 0, 0)), "track: bidirectional is 'x', expected True or False"),
    (lambda of: tagfield.bench(of, ["fixed"], progress=3), "bench: progress is 3, expected a function of the completed"),
    (lambda of: tagfield.bench(of, ["fixed"], name=3), "bench: name is 3, expected text"),
    (lambda of: tagfield.bench(3, ["fixed"]), "bench: what is 3, expected a path"),
    (lambda of: tagfield.bench("x.yaml", ["fixed"], skip_missing="x"), "bench: skip_missing is 'x', expected True or"),
    (lambda of: tagfield.plan("x.yaml", progress=3), "plan: progress is 3, expected a function of the completed share"),
    (lambda of: tagfield.plan(3), "plan: path is 3, expected a path"),
    (lambda of: tagfield.plan("x.yaml", links=3), "plan: links is 3, expected a path"),
    (lambda of: tagfield.load(3.5), "load: path is 3.5, expected a path"),
    (lambda of: tagfield.load("x.yaml", allow_outside="no"), "load: allow_outside is 'no', expected True or False"),
    (lambda of: of.with_(3), "with_: 3 is no change, expected 'key.path=value' or a mapping"),
    (lambda of: of.with_({"pose.sigma_m": math.inf}), "with_: pose.sigma_m is inf, expected a finite number"),
    (lambda of: tagfield.load(""), "load: path is empty, expected a scenario file"),
    (lambda of: tagfield.World().box("b", (1, 1), (0, 0, 0)), "world: 'b': size_m is (1, 1), expected 3 finite numbers"),
])
def test_arguments_are_checked(ask, said):
    with pytest.raises(tagfield.Error) as raised:
        ask(portal())
    assert str(raised.value).startswith(said)
    assert "\n" not in str(raised.value)


def same_run(one, other):
    return one.reads.tobytes() == other.reads.tobytes() and one.reads.categories == other.reads.categories


def test_scenarios_are_pickled(tmp_path):
    world = tagfield.World().floor()
    world.box("screen", size_m=(0.5, 3, 0.5), position_m=(1, 0, 2.5), material="wood")
    world.mesh("sheet", [[1, -2, 0], [1, 2, 0], [1, 2, 3]], [[0, 1, 2]], position_m=(0, 5, 0), material="metal")
    made = portal(world=world, model="multipath").with_(seed=3)
    path = tmp_path / "row.yaml"
    path.write_text("duration_s: 1\nseed: 4\nantennas: [{name: a, pose: [0, 0, 1]}]\n"
                    "tags: [{id: t, position: [1, 0, 1]}]\n", encoding="utf-8")
    loaded = tagfield.load(path).with_({"antennas.a.range_m": 3})
    for scenario in (made, loaded):
        again = pickle.loads(pickle.dumps(scenario))
        assert again.text == scenario.text and again.warnings == scenario.warnings
        assert same_run(again.run(), scenario.run())
        assert again.with_(seed=9).run().seed == 9
        assert copy.copy(scenario) is scenario and copy.deepcopy(scenario) is scenario
    copied = copy.deepcopy(world)
    copied.sphere("ball", 1.0, (9, 9, 1), material="wood")
    copy.copy(world).sphere("ball", 1.0, (9, 9, 1), material="wood")
    assert world.solids == ["floor", "screen", "sheet"] and world.materials.get("ball") is None
    assert pickle.loads(pickle.dumps(world)).solids == world.solids
    path.unlink()
    with pytest.raises(tagfield.Error, match="row.yaml: "):
        pickle.loads(pickle.dumps(loaded)).run()


def test_what_was_told_is_not_told_again():
    with pytest.warns(tagfield.TagfieldWarning, match="has no effect"):
        odd = portal().with_({"pose.sigma_m": 0.1})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = pickle.loads(pickle.dumps(odd))
        assert again.run().seed == 1 and again.warnings == odd.warnings


def test_other_processes_run_a_scenario():
    scenario = portal()
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        runs = pool.map(scenario.run, [1, 2])
    for run in runs:
        here = scenario.run(seed=run.seed)
        assert same_run(run, here)
        assert run.estimates.tobytes() == here.estimates.tobytes() and str(run) == str(here)
        assert run.truth.positions_m().keys() == here.truth.positions_m().keys()
        assert run.localize("trilateration").estimates.names("tag").tolist() == ["tag1"]
    assert [run.seed for run in runs] == [1, 2]


def test_numpy_s_integers_are_integers():
    assert [run.seed for run in portal().run_many(np.int64(2), threads=np.int64(1))] == [1, 2]
    assert portal().run(seed=np.uint8(3)).seed == 3


def test_coverage_of_a_paper_antenna_is_a_disc():
    scenario = portal(model="paper", antennas=[
        {"name": "gate", "pose": [0, 0, 1], "range_m": 2, "range_sigma": 0}])
    coverage = scenario.coverage(heights_m=[1], step_m=0.1, region_m=(-3, -3, 3, 3), time_s=0)
    x, y = np.meshgrid(coverage.x_m, coverage.y_m)
    layer = coverage.layers[0]
    assert layer.cells.shape == (60, 60)
    np.testing.assert_array_equal(layer.cells["probability"] > 0.5, np.hypot(x, y) <= 2)
    assert layer.share_read == pytest.approx(math.pi * 4 / 36, abs=0.01)
    assert coverage.tags.names("verdict").tolist() == ["intended"]
    with pytest.raises(tagfield.Error, match="coverage: "):
        scenario.coverage(region_m=(1, 1, 0, 0))


def test_coverage_names_the_verdict_of_each_tag():
    tags = [{"id": f"tag{x}", "position": [x, 0, 1], "rpy": [0, 0, math.pi]} for x in range(1, 41)]
    found = portal(tags=tags).coverage(heights_m=[1], step_m=1, region_m=(-3, -3, 3, 3)).tags
    verdicts = found.names("verdict")
    assert set(verdicts) == {"intended", "seldom", "never"}
    assert (found["probability"][verdicts == "seldom"] < 0.5).all()
    assert (found["probability"][verdicts == "intended"] >= 0.5).all()


def test_a_plan_s_layout_runs(tmp_path):
    path = tmp_path / "shelf.yaml"
    path.write_text("""
name: shelf
model: link_budget
duration_s: 2
plan:
  tags:
    - {name: shelf, box: [0, 0, 1, 3, 0, 1.5], spacing_m: [0.5, 1, 0.5]}
  mounts:
    - {name: roof, line: [[0, 2, 2.5], [3, 2, 2.5]], spacing_m: 1.5, rpy_deg: [[0, 30, -90]], cost: 100,
       profiles: [speedway_r420, panel_6dbi], powers_dbm: [19]}
  limits: {antennas: 3, readers: 1}
""")
    shares = []
    made = tagfield.plan(path, {"plan.limits.antennas": 2}, samples=8, check=3, links=tmp_path / "links",
                         progress=shares.append)
    assert made.layouts()["antennas"].tolist() == [1, 2]
    assert len(made.chosen["antennas"]) == 2 and made.data["check"]["seeds"] == [1, 2, 3]
    assert len(made.positions()) == 14 and (tmp_path / "links").is_dir()
    assert all(0 <= share <= 1 for share in shares) and shares[-1] == 1 and "14 tags at 14 positions" in str(made)
    made.save_page(tmp_path / "plan.html")
    assert "plan-data" in (tmp_path / "plan.html").read_text(encoding="utf-8")
    run = made.scenario.run(seed=3)
    read = set(run.reads.names("tag"))
    assert made.chosen["read"]["low"] <= len(read) <= made.chosen["read"]["high"]
    assert not run.located.any()
    (tmp_path / "elsewhere").mkdir()
    made.save_layout(tmp_path / "elsewhere" / "layout.yaml")
    loaded = tagfield.load(tmp_path / "elsewhere" / "layout.yaml", allow_outside=True)
    assert loaded.antennas == made.scenario.antennas
    for change, words in (({"plan.limits.antennas": 0}, "plan.limits.antennas"),
                          ({"plan.aim": {"dwell_reads": 0.5}}, "must be at least 1"),
                          ("plan", "expected key.path=value")):
        with pytest.raises(tagfield.Error, match=words):
            tagfield.plan(path, change)
    with pytest.raises(tagfield.Error, match="expected 8 to 10000"):
        tagfield.plan(path, samples=2)


def warehouse():
    return tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml")).with_(duration_s=6)


def test_steps_are_the_run():
    sim = warehouse().simulation(seed=5)
    steps = [sim.step() for _ in range(100)]
    steps.append(sim.run_until(3))
    while not sim.finished:
        steps.append(sim.step(50))
    run = warehouse().run(seed=5, locate=False)
    stepped = np.concatenate(steps)
    assert len(stepped) > 100
    for column in run.reads.columns:
        np.testing.assert_array_equal(stepped[column], run.reads[column])
    assert sim.now_s == pytest.approx(6)


def test_robot_is_driven():
    exact = {f"alpha{i}": 0 for i in range(1, 5)}
    sim = warehouse().with_({"pose.source": "odometry", "navigation": {"mode": "odometry", "odometry": exact}}
                            ).simulation(robot="p3at")
    start = sim.robot_pose()
    sim.drive(0.3, 0.0)
    sim.run_until(2)
    before = sim.robot_pose()
    sim.run_until(3)
    gone = sim.robot_pose() - before
    heading = start[2]
    np.testing.assert_allclose(gone[:2], 0.3 * np.array([math.cos(heading), math.sin(heading)]), atol=1e-9)
    np.testing.assert_allclose(sim.robot_pose(believed=True), sim.robot_pose(), atol=1e-9)
    assert sim.odometry[0] == pytest.approx(np.hypot(*(sim.robot_pose() - start)[:2]), abs=0.01)
    assert sim.scan.ranges_m.dtype == np.float32 and len(sim.scan.ranges_m) > 100
    with pytest.raises(tagfield.Error, match="finite"):
        sim.drive(math.inf, 0)


def test_drift_of_a_driven_robot_is_in_the_expected_errors():
    noise = {"alpha1": 0.01, "alpha2": 0.005, "alpha3": 0.01, "alpha4": 0.001}
    heights = {tag: 1.5 for tag in ("tag1", "tag2")}

    def driven(scenario):
        sim = scenario.simulation(seed=3, robot="p3at", policy=lambda time_s: (0.3, 0.12 * math.sin(0.2 * time_s)))
        reads, poses = [], []
        while not sim.finished:
            reads.append(sim.step(100))
            poses.append(sim.poses)
        return tagfield.stack(reads), tagfield.stack(poses)

    stated = warehouse().with_({"duration_s": 20, "navigation": {"mode": "truth", "odometry": noise}})
    reads, poses = driven(stated)
    assert poses.driven_robot == poses[5:].driven_robot == "p3at" and reads.driven_robot == ""
    by_wheels = tagfield.localize(reads, poses, "joint", scenario=stated)
    # The same, stated by name, as for poses out of a file.
    plain = tagfield.Table(np.array(poses), poses.categories)
    by_name = tagfield.localize(reads, plain, "joint", scenario=stated, driven_robot="p3at")
    np.testing.assert_array_equal(by_wheels.estimates["expected_error_m"], by_name.estimates["expected_error_m"])
    # Worse wheels leave more; pose.wheel_noise is not that of a driven robot.
    worse = stated.with_({"navigation": {"mode": "truth", "odometry": {key: 3 * noise[key] for key in noise}}})
    by_worse = tagfield.localize(reads, poses, "joint", scenario=worse)
    errors = [np.nanmedian(of.estimates["expected_error_m"]) for of in (by_wheels, by_worse)]
    assert errors[1] > 1.1 * errors[0]
    other = warehouse().with_({"duration_s": 20, "pose": {"source": "odometry", "wheel_noise": 0.5},
                               "navigation": {"mode": "odometry", "odometry": noise}})
    other = tagfield.localize(reads, poses, "joint", scenario=other)
    np.testing.assert_array_equal(other.estimates["expected_error_m"], by_wheels.estimates["expected_error_m"])
    with pytest.warns(tagfield.TagfieldWarning, match="wheel odometry of a driven robot"):
        tagfield.localize(reads, poses, "joint", tag_heights_m=heights)
    with pytest.raises(tagfield.Error, match="driven_robot"):
        tagfield.localize(reads, poses, scenario=stated, driven_robot="nobody")


def test_other_robots_keep_their_pose_source():
    scenario = warehouse().with_({"robots": [{"name": "p3at", "start": [-1.4, -1.5, -1.5708]},
                                             {"name": "other", "start": [0, 0, 0], "waypoints": [[1, 0], [1, 1]]}],
                                  "duration_s": 20})
    sim = scenario.simulation(seed=2, robot="p3at", policy=lambda time_s: (0.3, 0.1))
    sim.run_until(6)
    np.testing.assert_array_equal(sim.robot_pose("other", believed=True), sim.robot_pose("other"))
    assert np.abs(sim.robot_pose(believed=True) - sim.robot_pose()).max() > 1e-4
    with pytest.warns(tagfield.TagfieldWarning, match="pose.source: noisy has no effect on 'p3at'"):
        scenario.with_({"pose.source": "noisy"}).simulation(robot="p3at")


def test_policy_drives():
    asked = []

    def policy(time_s):
        asked.append(time_s)
        return 0.0, 0.5

    sim = warehouse().simulation(robot="p3at", policy=policy)
    start = sim.robot_pose()
    sim.run_until(1)
    turned = sim.robot_pose() - start
    assert np.hypot(*turned[:2]) < 1e-9
    assert 0.2 < turned[2] <= 0.5 + 1e-9
    assert asked == sorted(asked) and len(asked) == 100
    with pytest.raises(tagfield.Error, match="drive: this robot is driven by its policy"):
        sim.drive(0.3, 0)
    with pytest.raises(tagfield.Error, match="needs robot"):
        warehouse().simulation(policy=policy)
    with pytest.raises(tagfield.Error, match="robot"):
        warehouse().simulation(robot="nobody")


def test_a_policy_returns_two_velocities():
    for action in (3, (1, 2, 3), None, ("a", 0)):
        sim = warehouse().simulation(robot="p3at", policy=lambda time_s: action)
        with pytest.raises(tagfield.Error, match="policy: returned .* at 0 s, expected two numbers"):
            sim.step()


def test_steps_are_interrupted():
    sim = portal(duration_s=1e5).simulation()
    # A shell starts background processes with SIGINT ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    try:
        timer.start()
        begin = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            sim.step(10**12)
        assert time.monotonic() - begin < 2.0
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)
    assert 0 < sim.now_s < 1e5
    assert len(sim.step()) > 10


@pytest.mark.parametrize("ask, said", [
    (lambda sim: sim.step(-1), "step: count is -1, expected 0 or more"),
    (lambda sim: sim.step(1.5), "step: count is 1.5, expected a whole number"),
    (lambda sim: sim.run_until(math.nan), "run_until: time_s is nan"),
    (lambda sim: sim.add_tag("", (0, 0, 1)), "add_tag: tag is '', expected an ID that is not empty"),
    (lambda sim: sim.add_tag("q", (0, 1)), r"add_tag: position_m is \(0, 1\), expected 3 finite numbers"),
    (lambda sim: sim.add_tag("q", (0, 1, 1e6)), "add_tag: position_m is .*, expected 3 finite numbers, up to"),
    (lambda sim: sim.move_tag("tag1", (0, math.nan, 1)), "move_tag: position_m is .*nan"),
    (lambda sim: sim.move_tag(3, (0, 0, 1)), "move_tag: tag is 3, expected an ID"),
    (lambda sim: sim.remove_tag(3), "remove_tag: tag is 3, expected an ID"),
    (lambda sim: sim.drive("fast", 0), "drive: forward_m_s is 'fast', expected a finite number"),
    (lambda sim: sim.robot_pose(3), "robot_pose: name is 3, expected a name"),
])
def test_steps_are_checked(ask, said):
    with pytest.raises(tagfield.Error, match=said):
        ask(portal().simulation())


def test_tags_come_and_go():
    sim = portal().simulation()
    sim.step(10)
    sim.add_tag("new", (1.5, 0, 1), (0, 0, math.pi))
    assert "new" in sim.step(50).names("tag")
    sim.move_tag("new", (90, 0, 1))
    assert "new" not in sim.step(50)[1:].names("tag")
    sim.remove_tag("new")
    assert not sim.has_tag("new") and sim.has_tag("tag1")
    with pytest.raises(tagfield.Error):
        sim.remove_tag("new")
    with pytest.raises(tagfield.Error):
        sim.add_tag("tag1", (0, 0, 0))


def test_conveyor_is_tracked_in_order():
    tracks = tagfield.load(tagfield.share("scenarios/conveyor.yaml")).track(seed=1)
    assert tracks.order() == [f"parcel_{i:02}" for i in range(1, 13)]
    assert set(tracks.tracks.names("verdict")) == {"tracked"}
    speeds = tracks.points["velocity_m_s"][:, 0]
    assert np.median(speeds) == pytest.approx(1, abs=0.02)
