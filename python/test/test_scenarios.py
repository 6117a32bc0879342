# SPDX-License-Identifier: Apache-2.0
"""Scenarios and worlds created in Python; links, explanations, coverage maps; stepped simulation."""

import math
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
    ({"duration_s": float("nan")}, "scenario: "),
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
    assert near.heard and not link(200, 0, 1).heard


def test_batch_is_the_same_as_one_by_one():
    for scenario in (portal(), portal(model="paper", antennas=[{"name": "gate", "pose": [0, 0, 1], "range_m": 3}])):
        link = scenario.link()
        places = np.random.default_rng(1).uniform([0.5, -2, 0.5], [4, 2, 1.5], (50, 3))
        rows = link.batch(places)
        for place, row in zip(places, rows):
            one = link(*place)
            assert (one.distance_m, one.reply_dbm, one.phase_rad, one.heard) == (
                row["distance_m"], row["reply_dbm"], row["phase_rad"], row["heard"])
    with pytest.raises(tagfield.Error, match=r"\(N, 3\)"):
        link.batch(np.zeros(3))
    with pytest.raises(tagfield.Error, match="finite"):
        link(math.nan, 0, 0)


def test_world_in_python_is_in_the_way():
    world = tagfield.World().floor()
    world.box("screen", size_m=(0.02, 3, 3), position_m=(1, 0, 1.5), material="metal")
    behind = portal(world=world)
    assert not behind.link()(2, 0, 1).heard
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
    with pytest.raises(tagfield.Error, match="--allow-outside"):
        tagfield.load(scenario)
    assert len(tagfield.load(scenario, allow_outside=True).with_(seed=2).run().reads) > 0
    assert len(tagfield.load(scenario, skip_missing=True).run().reads) > 0


def test_mesh_is_a_wall():
    world = tagfield.World()
    world.mesh("metal_sheet", [[1, -2, 0], [1, 2, 0], [1, 2, 3], [1, -2, 3]], [[0, 1, 2], [0, 2, 3]],
               material="metal")
    assert not portal(world=world).link()(2, 0, 1).heard
    with pytest.raises(tagfield.Error, match="vertex 9"):
        tagfield.World().mesh("m", np.zeros((3, 3)), [[0, 1, 9]])


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
    assert all(0 <= share <= 1 for share in shares) and "14 tags at 14 positions" in str(made)
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
    with pytest.raises(tagfield.Error, match="needs robot"):
        warehouse().simulation(policy=policy)
    with pytest.raises(tagfield.Error, match="robot"):
        warehouse().simulation(robot="nobody")


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
