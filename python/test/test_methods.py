# SPDX-License-Identifier: Apache-2.0
"""Localization of reads from any source by any method; methods in Python and their comparison."""

import os
import signal
import time

import numpy as np
import pandas
import pytest

import tagfield


@pytest.fixture(scope="module")
def scenario():
    return tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml"))


@pytest.fixture(scope="module")
def run(scenario):
    return scenario.run(seed=1)


@tagfield.method("strongest", "where the RSSI was highest")
def strongest(problem, tag, samples):
    return samples["position_m"][samples["rssi_dbm"].argmax(), :2]


def test_other_methods_locate_the_same_reads(run):
    other = run.localize("ml")
    assert other.method == "ml"
    assert len(other.estimates) == 10
    assert other.errors_m.mean() < 0.02
    assert run.localize().estimates["position_m"].tobytes() == run.estimates["position_m"].tobytes()


def test_reference_tags_are_not_located(scenario):
    run = scenario.with_({"localization.reference_tags": ["tag3"]}).run(seed=2)
    by_tag = dict(zip(run.estimates.names("tag"), run.estimates["reference"]))
    assert [tag for tag, reference in by_tag.items() if reference] == ["tag3"]
    assert "9 of 9 tags located" in repr(run)
    assert run.located.sum() == len(run.errors_m) == 9


def test_reads_by_themselves_are_located(run):
    truth = run.truth.positions_m()
    heights = {tag: place[2] for tag, place in truth.items()}
    found = tagfield.localize(run.reads, run.poses, "hyperbola", tag_heights_m=heights, truth=truth, pose_sigma_m=0)
    np.testing.assert_allclose(found.estimates["position_m"][found.located],
                               run.estimates["position_m"][run.located], atol=1e-9)
    frames = tagfield.localize(run.reads.to_pandas(), run.poses.to_pandas().rename(columns={"name": "antenna"}),
                               "hyperbola", tag_heights_m=heights, pose_sigma_m=0)
    np.testing.assert_allclose(np.sort(frames.estimates["position_m"], axis=0),
                               np.sort(found.estimates["position_m"], axis=0), atol=1e-7)
    assert np.isnan(frames.estimates["error_m"]).all()
    assert str(found).startswith("tag")


def test_ctrl_c_ends_localization_between_tags(run):
    asked = []

    @tagfield.method("slow", "is interrupted at the second of ten tags")
    def slow(problem, tag, samples):
        asked.append(tag)
        if len(asked) == 2:
            os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.3)
        return samples["position_m"][0, :2]

    # A shell starts background processes with SIGINT ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        for locate in (lambda: tagfield.localize(run.reads, run.poses, slow, threads=1),
                       lambda: run.localize(slow, threads=1)):
            asked.clear()
            with pytest.raises(KeyboardInterrupt):
                locate()
            assert 2 <= len(asked) < 8
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("known, said", [
    ({"tag_height_m": "high"}, "localize: tag_height_m is 'high', expected a number"),
    ({"tag_height_m": np.nan}, "localize: tag_height_m is nan, expected a finite number"),
    ({"tag_heights_m": 1}, "localize: tag_heights_m is 1, expected a mapping from name to number"),
    ({"tag_heights_m": {"tag1": np.nan}}, "localize: tag_heights_m: 'tag1' is nan, expected a finite number"),
    ({"pose_sigma_m": -1}, "localize: pose_sigma_m is -1, expected a finite number, 0 or more"),
    ({"vertical_side": 3}, "localize: vertical_side is 3, expected text"),
    ({"side": 3}, "localize: side is 3, expected text"),
    ({"box_m": "x"}, "localize: box_m is 'x', expected a list of numbers"),
    ({"offsets_rad": {"mobile": np.inf}}, "localize: offsets_rad: 'mobile' is inf, expected a finite number"),
    ({"pi_ambiguity": "x"}, "localize: pi_ambiguity is 'x', expected True or False"),
    ({"settings": 3}, "localize: settings is 3, expected a mapping from setting to value"),
    ({"threads": 0}, "threads is 0, expected 1 to 1024"),
])
def test_keywords_are_checked(run, known, said):
    with pytest.raises(tagfield.Error) as raised:
        tagfield.localize(run.reads, run.poses, **known)
    assert str(raised.value).startswith(said)
    assert "\n" not in str(raised.value)


def test_what_is_known_is_checked(run):
    with pytest.raises(tagfield.Error, match="above"):
        tagfield.localize(run.reads, run.poses, vertical_side="beside")
    with pytest.raises(TypeError, match="'height' is now 'vertical_side'"):
        tagfield.localize(run.reads, run.poses, height="above")
    with pytest.raises(TypeError, match="tag_hight"):
        tagfield.localize(run.reads, run.poses, tag_hight=1)
    with pytest.raises(tagfield.Error, match="tag_height_m"):
        tagfield.localize(run.reads, run.poses, tag_height_m="high")
    with pytest.raises(tagfield.Error, match="did you mean 'hyperbola'"):
        tagfield.localize(run.reads, run.poses, "hyperbole")
    with pytest.raises(tagfield.Error, match="stride_m"):
        tagfield.localize(run.reads, run.poses, "sar", settings={"stride_m": 1})
    spoilt = run.reads.copy()
    spoilt["phase_rad"][7] = np.nan
    with pytest.raises(tagfield.Error, match="row 7: phase_rad is not finite"):
        tagfield.localize(spoilt, run.poses)
    spoilt = run.reads.copy()
    spoilt["tag"][7] = 99
    with pytest.raises(tagfield.Error, match="row 7: tag is 99"):
        tagfield.localize(spoilt, run.poses)


def columns(**changed):
    return {"time_s": [0.0, 1.0], "antenna": ["a", "a"], "tag": ["t", "u"], "phase_rad": [1.0, 2.0], **changed}


@pytest.mark.parametrize("dates", [
    lambda ns: ns.astype("datetime64[us]"), lambda ns: ns.astype("datetime64[ms]"), lambda ns: ns,
    lambda ns: ns - np.datetime64(0, "ns"),
    lambda ns: pandas.Series(ns).dt.tz_localize("UTC").dt.tz_convert("Asia/Tokyo"),
])
@pytest.mark.parametrize("column", ["time_s", "stamp_ns"])
def test_dates_are_stamps_of_their_unit(dates, column):
    stamps = np.array(["2024-05-06T07:08:09.123", "2024-05-06T07:08:10"], dtype="datetime64[ns]")
    table = tagfield.reads_table({column: dates(stamps), **{k: v for k, v in columns().items() if k != "time_s"}})
    assert table["stamp_ns"].tolist() == stamps.astype(np.int64).tolist()


@pytest.mark.parametrize("changed, said", [
    ({"tag": ["t", None]}, "reads: tag: row 1 is None, expected a name"),
    ({"tag": ["t", np.nan]}, "reads: tag: row 1 is nan, expected a name"),
    ({"antenna": pandas.Series([pandas.NA, "a"])}, "reads: antenna: row 0 is <NA>, expected a name"),
    ({"time_s": [0.0, np.nan]}, "reads: time_s must be finite"),
    ({"stamp_ns": [0.0, np.nan]}, "reads: stamp_ns must be finite"),
    ({"time_s": np.array(["2024-05-06", "NaT"], dtype="datetime64[us]")}, "reads: time_s: row 1 has no time"),
    ({"phase_rad": [1.0, 2.0, 3.0]}, "reads: phase_rad has 3 rows, but there are 2 stamps"),
    ({"rssi_dbm": [-60.0]}, "reads: rssi_dbm has 1 rows, but there are 2 stamps"),
    ({"tag": ["t"]}, "reads: tag has 1 rows, but there are 2 stamps"),
    ({"phase_rad": ["one", "two"]}, "reads: phase_rad is .*, expected numbers"),
])
def test_columns_are_checked(changed, said):
    with pytest.raises(tagfield.Error, match=said):
        tagfield.reads_table(columns(**changed))


def test_one_value_stands_for_all_rows():
    table = tagfield.reads_table(columns(antenna="a", frequency_hz=866e6))
    assert table.names("antenna").tolist() == ["a", "a"]
    assert table["frequency_hz"].tolist() == [866e6, 866e6]


def test_what_is_known_of_tags_is_checked(run):
    place = (1.0, 2.0, 0.8)
    with pytest.warns(tagfield.TagfieldWarning, match=r"reference_tags: there are no reads of tag 'tga3' \(did you"):
        found = tagfield.localize(run.reads, run.poses, "trilateration", reference_tags={"tga3": place}, tag_height_m=1)
    assert "tga3" in found.warnings[0]
    with pytest.warns(tagfield.TagfieldWarning, match=r"tag_heights_m: there are no reads of tag 'tga3' \(did you"):
        tagfield.localize(run.reads, run.poses, "trilateration", tag_heights_m={"tga3": 0.8})
    for ask, said in (
            (lambda: tagfield.localize(run.reads, run.poses, reference_tags={"tag3": (1, 2)}),
             r"localize: reference_tags: 'tag3' is \(1, 2\), expected 3 finite numbers"),
            (lambda: tagfield.localize(run.reads, run.poses, truth={"tag3": (1, 2)}), r"truth: 'tag3' is \(1, 2\)"),
            (lambda: tagfield.localize(run.reads, run.poses, truth=run.truth.tags.to_pandas()), "truth is .*, expected"),
            (lambda: tagfield.localize(run.reads, run.poses, len), "localize: method is <built-in function len>"),
            (lambda: tagfield.localize(run.reads, run.poses, scenario="x"), "localize: scenario is 'x', expected"),
            (lambda: tagfield.calibrate(run.reads, run.poses, {"tag3": (1, 2)}), r"calibrate: tags: 'tag3' is \(1, 2\)"),
            (lambda: tagfield.poses_table({"time_s": [0.0], "x_m": [0], "y_m": [0], "z_m": [0]}),
             "poses: there is no column 'antenna' or 'name'"),
            (lambda: tagfield.read("nofile.csv"), "read: reads as CSV need poses=FILE, .*, or a format that")):
        with pytest.raises(tagfield.Error, match=said):
            ask()


def test_own_method_is_one_like_others(scenario, run):
    assert strongest.name == "strongest"
    found = run.localize(strongest)
    assert found.method == "strongest"
    again = scenario.run(seed=1, method=strongest)
    np.testing.assert_array_equal(found.estimates["position_m"], again.estimates["position_m"])
    for tag, row in zip(found.estimates.names("tag"), found.estimates):
        if np.isfinite(row["position_m"]).all():
            reads = run.reads.where(tag=tag)
            best = reads["stamp_ns"][reads["rssi_dbm"].argmax()]
            antenna = run.poses["position_m"][run.poses["stamp_ns"] == best][0]
            np.testing.assert_allclose(row["position_m"][:2], antenna[:2])


def test_methods_say_what_they_like(run):
    truth = run.truth.positions_m()

    @tagfield.method("knower", per_tag=False)
    def knower(problem):
        assert problem.tags == sorted(truth)
        assert problem.height_m("tag2") == truth["tag2"][2]
        return {"tag1": tagfield.Estimate(truth["tag1"], covariance_m2=np.eye(2) * 1e-4),
                "tag2": [truth["tag2"], truth["tag2"] + [0, 1, 0]],
                "tag3": "nobody asked", "tag4": tuple(truth["tag4"][:2]),
                "tag5": tagfield.Estimate(truth["tag5"], expected_error_m=3.0)}

    found = run.localize(knower)
    by_tag = {tag: (verdict, reason) for tag, verdict, reason in zip(
        found.estimates.names("tag"), found.estimates.names("verdict"), found.estimates.names("reason"))}
    assert by_tag["tag1"][0] == "located"
    assert by_tag["tag3"] == ("not_located", "cannot localize: nobody asked")
    assert by_tag["tag4"][0] == "located"
    assert by_tag["tag5"][0] == "not_located"
    assert by_tag["tag6"] == ("not_located", "cannot localize: knower found no position")
    one = found.estimates.where(tag="tag1")[0]
    assert one["error_m"] < 1e-12
    assert one["expected_error_m"] == pytest.approx(np.sqrt(2e-4))


@pytest.mark.parametrize("answer, said", [
    ((1.0, np.nan), "is not a position"), ((1.0,), "is not a position"), ({}, "{} is not a position"),
    (np.zeros((2, 3)), "is not a position"), (np.zeros((1, 2)), "is not a position"), (3.0, "3.0 is not a position"),
    ((1.0, 2.0, 3.0, 4.0), "is not a position: expected two or three finite numbers"), ([], "is not a position"),
    ((np.inf, 0.0, 1.0), "is not a position"), ([(1.0, 2.0), (1.0, np.nan)], "is not a position"),
    (tagfield.Estimate((1, 2), covariance_m2="wide"), r"covariance_m2 must be \(2, 2\)"),
    (tagfield.Estimate((1, 2), expected_error_m="small"), "expected_error_m is 'small', expected a finite number"),
    (tagfield.Estimate((1, 2), covariance_m2=[1, 2]), "covariance_m2"),
    (tagfield.Estimate((1, 2), covariance_m2=[[1, 0], [0, -1]]), "covariance_m2 is .*, expected a symmetric"),
    (tagfield.Estimate((1, 2), covariance_m2=[[1, 0.5], [0, 1]]), "covariance_m2 is .*, expected a symmetric"),
    (tagfield.Estimate((1, 2), rms_m=-1), "rms_m is -1, expected a finite number, 0 or more"),
    (tagfield.Estimate((1, 2), expected_error_m=np.nan), "expected_error_m is nan"),
])
def test_methods_are_checked(run, answer, said):
    with pytest.raises(tagfield.Error, match=said):
        run.localize(tagfield.method("odd")(lambda problem, tag, samples: answer))


def test_errors_are_in_space_and_horizontal(run):
    off = np.array([0.03, 0.04, 0.12])
    found = run.localize(tagfield.method("above")(lambda problem, tag, samples: run.truth.positions_m()[tag] + off))
    np.testing.assert_allclose(found.errors_m, 0.13, rtol=1e-9)
    np.testing.assert_allclose(found.horizontal_errors_m, 0.05, rtol=1e-9)
    assert "horizontal_error_m" in found.estimates.to_pandas().columns
    lost = run.localize(tagfield.method("lost")(lambda problem, tag, samples: None))
    assert np.isnan(lost.estimates["horizontal_error_m"]).all() and len(lost.horizontal_errors_m) == 0


@pytest.mark.parametrize("far", [(1e300, 0.0, 1.0), (5000.0, 0.0), (0.0, 0.0, -1e9)])
def test_positions_out_of_reach_are_not_located(run, far):
    with pytest.warns(tagfield.TagfieldWarning, match="method 'far': positions over 1000 m from where a tag was read"):
        found = run.localize(tagfield.method("far")(lambda problem, tag, samples: far))
    assert not found.located.any()
    assert set(found.estimates.names("reason")) == {"cannot localize: its position is over 1000 m from where it was read"}
    assert "of 10 tags: tag1, …" in found.warnings[-1]
    near = run.truth.positions_m()["tag1"]
    with pytest.warns(tagfield.TagfieldWarning, match="positions over 1000 m .* of 1 tag: tag1"):
        found = run.localize(tagfield.method("both")(
            lambda problem, tag, samples: [far, near] if tag == "tag1" else None))
    assert found.estimates.where(tag="tag1").names("verdict").tolist() == ["located"]


def test_reads_anywhere_are_located(run):
    reads, poses = run.reads.to_pandas(), run.poses.to_pandas().rename(columns={"name": "antenna"})
    poses["x_m"] += 4.5e5  # as in UTM
    poses["y_m"] += 5.4e6
    found = tagfield.localize(reads, poses, strongest, tag_height_m=1)
    assert found.located.any()


def test_what_a_method_raises_is_raised_as_it_is(scenario):
    @tagfield.method("broken")
    def broken(problem, tag, samples):
        return 1 / 0

    with pytest.raises(ZeroDivisionError):
        tagfield.bench(scenario, [broken], seeds=2)
    kept = []
    tagfield.bench(scenario, [tagfield.method("keeper", per_tag=False)(lambda p: kept.append(p) or {})])
    with pytest.raises(tagfield.Error, match="this problem is over"):
        kept[0].samples("tag1")


def test_bench_compares_own_methods(scenario):
    truth = {tag: place for tag, place in scenario.tags.items()}
    right = tagfield.method("right")(lambda problem, tag, samples: truth[tag])
    compared = tagfield.bench(scenario, ["hyperbola", strongest, right, ("coarse", "hyperbola", {"stride_m": 1})],
                              {"true pose": {}, "5 cm": {"pose": {"source": "noisy", "sigma_m": 0.05}}}, seeds=1)
    rows = compared.to_pandas().set_index(["condition", "name"])
    assert len(rows) == 8
    assert rows.loc[("true pose", "right"), "mean_m"] < 1e-12
    assert rows.loc[("true pose", "hyperbola"), "mean_m"] < rows.loc[("5 cm", "hyperbola"), "mean_m"]
    assert (rows["tags"] == 10).all()
    assert {"seed", "tag", "error_m"} <= set(compared.tags().columns)
    assert "strongest" in str(compared)


def shifted(scenario, by_m, name="mine"):
    return tagfield.method(name)(lambda problem, tag, samples: scenario.tags[tag] + [by_m, 0, 0])


def test_bench_tells_methods_of_the_same_name_apart(scenario):
    near, far = shifted(scenario, 0.0), shifted(scenario, 0.1)
    rows = tagfield.bench(scenario, [("0 mm", near, {}), ("100 mm", far, {}), ("same", near, {})]).to_pandas()
    assert rows["name"].tolist() == ["0 mm", "100 mm", "same"]
    assert rows["method"].tolist() == ["mine", "mine 2", "mine"]
    np.testing.assert_allclose(rows["mean_m"], [0, 0.1, 0], atol=1e-12)
    for methods in ([near, far], ["sar", "sar"]):
        with pytest.raises(tagfield.Error, match="bench: two methods are called '(mine|sar)': give them labels"):
            tagfield.bench(scenario, methods)


def test_names_of_methods_of_one_s_own_are_free_but_for_those_in_use(scenario):
    for name in ("sar", "auto", "none"):
        with pytest.raises(tagfield.Error, match=f"method: name is '{name}', which Tagfield uses itself"):
            tagfield.method(name)
    names = ["a, b: #[", "null", "Wände"]
    rows = tagfield.bench(scenario, [shifted(scenario, 0.1 * i, name) for i, name in enumerate(names)]).to_pandas()
    assert rows["name"].tolist() == names
    np.testing.assert_allclose(rows["mean_m"], [0, 0.1, 0.2], atol=1e-12)


def test_a_stated_error_of_0_is_a_claim(scenario):
    def stating(name, **stated):
        return tagfield.method(name)(
            lambda problem, tag, samples: tagfield.Estimate(scenario.tags[tag] + [0.1, 0, 0], **stated))

    zeros = np.zeros((2, 2))
    rows = tagfield.bench(scenario, [stating("silent"), stating("exact", expected_error_m=0.0),
                                     stating("zeros", covariance_m2=zeros),
                                     stating("both", expected_error_m=0, covariance_m2=np.eye(2) * 1e-3)])
    rows = rows.to_pandas().set_index("name")
    assert rows["false_claims"].to_dict() == {"silent": 0, "exact": 10, "zeros": 10, "both": 0}
    assert rows.loc["both", "error_over_expected"] == pytest.approx(np.sqrt(0.01 / 2e-3))


def test_a_suite_takes_methods_with_labels(scenario, tmp_path):
    suite = tmp_path / "suite.yaml"
    path = tagfield.share("scenarios/paper_warehouse.yaml")
    suite.write_text(f"name: s\nmethods: [hyperbola]\nconditions: [{{name: c, scenario: {path}}}]\n", encoding="utf-8")
    rows = tagfield.bench(suite, [("near", shifted(scenario, 0.0), {}), ("far", shifted(scenario, 0.1), {})]).to_pandas()
    assert rows["name"].tolist() == ["hyperbola", "near", "far"]
    np.testing.assert_allclose(rows["mean_m"][1:], [0, 0.1], atol=1e-12)


@pytest.mark.parametrize("methods, keywords, said", [
    (["sar"], {"seeds": 0}, "bench: seeds is 0, expected 1 or more"),
    (["sar"], {"seeds": -1}, "bench: seeds is -1, expected 1 or more"),
    (["sar"], {"first_seed": -1}, "bench: first_seed is -1, expected 0 or more"),
    (["sar"], {"phase_noise_rad": -1}, "bench: phase_noise_rad is -1, expected a finite number, 0 or more"),
    (["sar"], {"phase_noise_rad": np.nan}, "bench: phase_noise_rad is nan, expected a finite number"),
    (["sar"], {"conditions": {"a": "pose.source=noisy"}}, "bench: condition 'a' is 'pose.source=noisy', expected"),
    (["sar"], {"conditions": ["a"]}, r"bench: conditions is \['a'\], expected a mapping"),
    (["sar"], {"conditions": {"a": {"pose.sigma_m": np.nan}}}, "bench: pose.sigma_m is nan"),
    (None, {}, "bench: methods is None, expected a list"),
    ([("label", "sar")], {}, r"bench: \('label', 'sar'\) is no method"),
    ([len], {}, "bench: <built-in function len> is no method"),
    ([("label", strongest, {"stride_m": 1})], {}, "bench: 'label' takes no settings"),
])
def test_bench_is_checked(scenario, methods, keywords, said):
    with pytest.raises(tagfield.Error, match=said):
        tagfield.bench(scenario, methods, **keywords)


def test_bench_takes_one_method(scenario):
    assert tagfield.bench(scenario, "trilateration").to_pandas()["name"].tolist() == ["trilateration"]
    assert tagfield.bench(scenario, strongest).to_pandas()["name"].tolist() == ["strongest"]
    with pytest.raises(tagfield.Error, match="nofile: no such file"):
        tagfield.bench("nofile", ["sar"])


def test_bench_takes_scenarios_made_here():
    scenario = tagfield.Scenario(
        "row", model="paper", antennas=[{"name": "a", "on": "cart", "pose": [0, 0, 1]}],
        robots=[{"name": "cart", "start": [0, 0, 0], "waypoints": [[3, 0], [3, 1]]}],
        tags=[{"id": "tag1", "position": [1.5, 2, 1]}])
    compared = tagfield.bench(scenario, ["hyperbola"], {"here": {}, "there": scenario.with_(pose={"source": "noisy"})})
    assert compared.to_pandas()["condition"].tolist() == ["here", "there"]
    with pytest.raises(tagfield.Error, match="condition 'here'.*rang"):
        tagfield.bench(scenario, ["hyperbola"], {"here": {"antennas.a.rang_m": 1}})


def test_a_suites_files_may_lie_outside_only_where_it_is_said(tmp_path):
    (tmp_path / "worlds").mkdir()
    (tmp_path / "here").mkdir()
    (tmp_path / "worlds/wall.stl").write_text(
        "solid w\nfacet normal 0 0 1\nouter loop\nvertex 9 9 0\nvertex 9 8 0\nvertex 9 8 1\nendloop\nendfacet\n"
        "endsolid w\n", encoding="utf-8")
    (tmp_path / "here/world.sdf").write_text(
        '<sdf version="1.6"><world name="w"><model name="m"><static>1</static><link name="l">'
        f'<collision name="c"><geometry><mesh><uri>file://{tmp_path}/worlds/wall.stl</uri></mesh></geometry>'
        "</collision></link></model></world></sdf>", encoding="utf-8")
    (tmp_path / "here/row.yaml").write_text("""
name: row
model: paper
world: {path: world.sdf}
robots: [{name: cart, start: [0, 0, 0], waypoints: [[3, 0], [3, 1]]}]
antennas: [{name: a, on: cart, pose: [0, 0, 1]}]
tags: [{id: t, position: [1.5, 2, 1]}]
""", encoding="utf-8")
    suite = tmp_path / "here/suite.yaml"
    suite.write_text("name: s\nmethods: [hyperbola]\nseeds: 2\nconditions: [{name: row, scenario: row.yaml}]\n",
                     encoding="utf-8")
    with pytest.raises(tagfield.Error, match="allow_outside=True"):
        tagfield.bench(suite)
    compared = tagfield.bench(suite, allow_outside=True, first_seed=7)
    assert compared.tags()["seed"].tolist() == [7, 8]
    for more in ({"name": "other"}, {"phase_noise_rad": 0.1}):
        with pytest.raises(tagfield.Error, match="a suite says"):
            tagfield.bench(suite, allow_outside=True, **more)
    loaded = tagfield.load(tmp_path / "here/row.yaml", allow_outside=True)
    with pytest.raises(tagfield.Error, match="give them to tagfield.load"):
        tagfield.bench(loaded, ["hyperbola"], allow_outside=True)


def test_runs_are_read_back(run, tmp_path):
    (tmp_path / "reads.csv").write_text("stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n"
                                        "0.5,r,a,t,866e6,1.25,-50\n", encoding="utf-8")
    (tmp_path / "poses.csv").write_text("stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n0,a,1,2,3,0,0,0,1\n",
                                        encoding="utf-8")
    reads, poses = tagfield.read(tmp_path / "reads.csv", tmp_path / "poses.csv")
    assert reads["stamp_ns"].tolist() == [500_000_000]
    assert reads["phase_rad"].tolist() == [1.25] and np.isnan(reads["doppler_hz"][0])
    assert poses["position_m"].tolist() == [[1, 2, 3]]
    (tmp_path / "reads.csv").write_text("stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n"
                                        "0.5,r,a,t,866.3,90,-50\n", encoding="utf-8")
    with pytest.warns(tagfield.TagfieldWarning) as told:
        tagfield.read(tmp_path / "reads.csv", tmp_path / "poses.csv")
    said = [str(one.message).rsplit("/", 1)[1] for one in told]
    assert len(said) == 2 and said[0].startswith("reads.csv:2: frequency_hz is 866.3, expected a carrier in Hz")
    assert said[1].startswith("reads.csv:2: phase_rad is 90: whole cycles are dropped")
    (tmp_path / "reads.csv").write_text("stamp_s,antenna\n1,a\n", encoding="utf-8")
    with pytest.raises(tagfield.Error, match="reads.csv"):
        tagfield.read(tmp_path / "reads.csv", tmp_path / "poses.csv")
    with pytest.raises(tagfield.Error, match="no file 'profiles/datasets/adarff.yaml'"):
        tagfield.read(tmp_path / "reads.csv", format="adarff")


def test_calibration_finds_the_offset(scenario):
    off = scenario.with_({"antennas.mobile.phase_offset_rad": 1.3}).run(seed=1, locate=False)
    calibration = tagfield.calibrate(off.reads, off.poses, off.truth.positions_m())
    antenna = calibration.antennas["mobile"]
    (value, sigma), = antenna["offsets_rad"].values()
    assert antenna["phase_sign"] == 1
    assert abs(value - 1.3) < 4 * sigma + 0.02
    assert antenna["noise_rad"] == pytest.approx(0.1, abs=0.01)
    assert "phase_sign" in calibration.yaml or "sign" in calibration.yaml
