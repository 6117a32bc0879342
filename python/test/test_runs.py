# SPDX-License-Identifier: Apache-2.0
"""Runs in memory: their content, and that it equals the files written by the command."""

import csv
import os
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import tagfield

LIGHT_M_S = 299_792_458.0


@pytest.fixture(scope="module")
def scenario():
    return tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml"))


@pytest.fixture(scope="module")
def run(scenario):
    return scenario.run(seed=3)


def test_run_gives_what_the_command_writes(run, tmp_path):
    program = os.environ["TAGFIELD"]
    subprocess.run([program, "run", tagfield.share("scenarios/paper_warehouse.yaml"), "--seed", "3", "--no-page",
                    "--out", tmp_path], check=True, capture_output=True)
    with open(tmp_path / "reads.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(run.reads)
    assert [row["tag"] for row in rows] == run.reads.names("tag").tolist()
    assert [round(float(row["stamp_s"]) * 1e9) for row in rows] == run.reads["stamp_ns"].tolist()
    np.testing.assert_allclose([float(row["phase_rad"]) for row in rows], run.reads["phase_rad"], atol=5.1e-7)
    with open(tmp_path / "estimates.csv", encoding="utf-8", newline="") as file:
        estimates = {row["tag"]: row for row in csv.DictReader(file)}
    for tag, row in zip(run.estimates.names("tag"), run.estimates):
        place = [float(estimates[tag][key]) for key in ("x_m", "y_m", "z_m")]
        np.testing.assert_allclose(row["position_m"], place, atol=5.1e-7)


def test_truth_is_by_itself_consistent(run):
    antennas, tags = run.truth.antennas, run.truth.positions_m()
    where = {int(row["stamp_ns"]): row["position_m"] for row in antennas}
    for read, distance in list(zip(run.reads, run.truth.distances))[::97]:
        place = tags[run.reads.categories["tag"][read["tag"]]]
        apart = np.linalg.norm(where[int(read["stamp_ns"])] - place)
        assert distance["distance_m"] == pytest.approx(apart, abs=1e-9)
    errors = np.linalg.norm(run.estimates["position_m"] - run.estimates["truth_m"], axis=1)
    np.testing.assert_allclose(run.estimates["error_m"], errors, rtol=1e-12)
    off = (run.estimates["position_m"] - run.estimates["truth_m"])[:, :2]
    np.testing.assert_allclose(run.estimates["horizontal_error_m"], np.hypot(*off.T), rtol=1e-12)


def test_phases_without_noise_are_those_of_the_distance(scenario):
    quiet = scenario.with_({"antennas.mobile.phase_noise_rad": 0}).run(locate=False)
    frequency = quiet.reads["frequency_hz"]
    expected = 4 * np.pi * quiet.truth.distances["distance_m"] * frequency / LIGHT_M_S
    off = np.angle(np.exp(1j * (quiet.reads["phase_rad"] - expected)))
    assert np.abs(off).max() < 1e-8
    assert len(quiet.estimates) == 0


def test_tables_are_views_of_what_was_simulated(run):
    assert not run.reads.flags.owndata
    assert run.reads["phase_rad"].base is not None
    assert np.shares_memory(run.reads["phase_rad"], run.reads)
    assert run.reads.strides == (run.reads.dtype.itemsize,)


def test_tables_know_their_names(run):
    of_tag = run.reads.where(tag="tag3", antenna="mobile")
    assert isinstance(of_tag, tagfield.Table)
    assert set(of_tag.names("tag")) == {"tag3"}
    assert len(of_tag) == (run.reads.names("tag") == "tag3").sum()
    assert len(run.reads.where(tag=["tag3", "tag4"])) > len(of_tag)
    with pytest.warns(tagfield.TagfieldWarning, match=r"where: tag: the table has no 'tga3' \(did you mean 'tag"):
        assert len(run.reads.where(tag="tga3")) == 0
    nameless = run.reads.copy()
    nameless["tag"][:5] = -1
    with pytest.warns(tagfield.TagfieldWarning, match="no 'nobody'"):
        assert len(nameless.where(tag=["nobody"])) == 0
    with pytest.raises(tagfield.Error, match="where: tag is 3, expected a name or a list of names"):
        run.reads.where(tag=3)
    with pytest.raises(KeyError, match="is not a column of names"):
        run.reads.names("phase_rad")


def test_tables_become_frames(run):
    frame = run.reads.to_pandas()
    assert list(frame.columns[:4]) == ["time_s", "stamp_ns", "reader", "antenna"]
    counts = frame.groupby("tag", observed=True).size()
    assert counts["tag5"] == len(run.reads.where(tag="tag5"))
    estimates = run.estimates.to_pandas()
    assert {"x_m", "y_m", "z_m", "truth_x_m", "error_m", "covariance_m2_0_0"} <= set(estimates.columns)
    assert {"qx", "qy", "qz", "qw"} <= set(run.poses.to_pandas().columns)


def test_seeds_in_parallel_are_the_same_bytes(scenario):
    short = scenario.with_({"duration_s": 8})
    one = short.run_many([1, 2, 3], threads=1)
    two = short.run_many(3, threads=2)
    for a, b in zip(one, two):
        assert a.seed == b.seed
        assert a.reads.tobytes() == b.reads.tobytes()
        assert a.estimates.tobytes() == b.estimates.tobytes()
    assert one[0].reads.tobytes() != one[1].reads.tobytes()


def test_progress_reaches_one(scenario):
    short = scenario.with_({"duration_s": 4})
    for work in (lambda progress: short.run(progress=progress), lambda progress: short.run_many(3, progress=progress),
                 lambda progress: short.run(locate=False, progress=progress),
                 lambda progress: short.coverage(step_m=2, heights_m=1, time_s=0, progress=progress),
                 lambda progress: tagfield.bench(short, ["hyperbola"], seeds=2, progress=progress)):
        shares = []
        work(shares.append)
        assert shares[-1] == 1 and all(0 <= share <= 1 for share in shares)


@pytest.mark.filterwarnings("ignore:.*repeat tag and stamp:tagfield.TagfieldWarning")
def test_runs_are_stacked_with_their_names(scenario):
    one = scenario.with_({"duration_s": 6}).run(seed=1, locate=False)
    other = scenario.with_({"duration_s": 6}).run(seed=2, locate=False)
    # The same names by other numbers, and one that the first table does not have.
    renamed = tagfield.reads_table(other.reads.where(tag=["tag1", "tag2"]).to_pandas().assign(
        tag=lambda frame: frame["tag"].astype(str).replace("tag1", "new"), reader="r2"))
    for stacked in (tagfield.stack([one.reads, renamed]), np.concatenate([one.reads, renamed]),
                    np.append(one.reads, renamed)):
        assert isinstance(stacked, tagfield.Table) and stacked.dtype == one.reads.dtype
        for column in ("reader", "antenna", "tag"):
            assert stacked.names(column).tolist() == [*one.reads.names(column), *renamed.names(column)]
        np.testing.assert_array_equal(stacked["phase_rad"], [*one.reads["phase_rad"], *renamed["phase_rad"]])
        found = tagfield.localize(stacked, other.poses, "trilateration", tag_height_m=1)
        assert set(found.estimates.names("tag")) == {*one.reads.names("tag"), "new"}
        assert len(stacked.where(tag="new")) == (renamed.names("tag") == "new").sum() > 0
    nameless = one.reads.copy()
    nameless["tag"][:2] = -1
    assert tagfield.stack([renamed, nameless]).names("tag")[len(renamed):len(renamed) + 2].tolist() == ["", ""]
    poses = tagfield.stack(run.poses for run in (one, other))
    assert len(poses) == len(one.poses) + len(other.poses)
    phases = np.concatenate([one.reads["phase_rad"], other.reads["phase_rad"]])
    assert type(phases) is np.ndarray and len(phases) == len(one.reads) + len(other.reads)
    for wrong, said in (([], "stack: there are no tables"), ([one.reads, one.poses], "stack: a table has the columns"),
                        ([one.reads, 3], "stack: 3 is no table, expected a list of tables"),
                        (3, "stack: 3 is no table")):
        with pytest.raises(tagfield.Error, match=said):
            tagfield.stack(wrong)


def test_changes_are_those_of_the_command(scenario):
    changed = scenario.with_("pose.source=noisy", {"antennas.mobile.range_m": 3.5}, pose={"sigma_m": 0.02})
    believed = changed.run(seed=1, locate=False)
    assert believed.truth.distances["distance_m"].max() < 4.5
    off = believed.poses["position_m"] - believed.truth.antennas["position_m"]
    assert 0.005 < off[:, 0].std() < 0.05
    assert scenario.run(seed=1, locate=False).truth.distances["distance_m"].max() > 5


@pytest.mark.parametrize("change, said", [
    ({"pose.sigma_m": -1}, "must be"),
    ({"pose.sigmo_m": 1}, "did you mean 'sigma_m'"),
    ({"antennas.nobody.range_m": 1}, "has no element 'nobody'"),
])
def test_complaints_are_the_commands(scenario, change, said):
    with pytest.raises(tagfield.Error) as raised:
        scenario.with_(change)
    key, value = next(iter(change.items()))
    path = tagfield.share("scenarios/paper_warehouse.yaml")
    completed = subprocess.run([os.environ["TAGFIELD"], "run", path, "--set", f"{key}={value}"],
                               capture_output=True, text=True, check=False)
    assert completed.returncode == 2
    said_there = completed.stderr.strip().removeprefix("tagfield: ")
    assert said_there.replace("--set:", "with_:").replace("--set ", "with_: ") == str(raised.value)
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


def test_missing_file_is_one_line():
    with pytest.raises(tagfield.Error, match=r"^nowhere\.yaml: "):
        tagfield.load("nowhere.yaml")


def test_outlets_hear_what_is_recorded(scenario):
    class Counter(tagfield.Outlet):
        def __init__(self):
            self.reads, self.far, self.robots = [], 0.0, 0

        def on_read(self, read):
            self.reads.append((read.stamp_ns, read.tag, read.phase_rad))

        def on_distance(self, stamp_s, antenna, tag, distance_m):
            self.far = max(self.far, distance_m)

        def on_robot_pose(self, pose):
            assert pose.position_m.shape == (3,)
            self.robots += 1

    heard, phases = Counter(), []
    short = scenario.with_(duration_s=3)
    run = short.run(outlets=[heard, lambda read: phases.append(read.phase_rad)], locate=False)
    assert [row[0] for row in heard.reads] == run.reads["stamp_ns"].tolist()
    assert [row[1] for row in heard.reads] == run.reads.names("tag").tolist()
    assert phases == run.reads["phase_rad"].tolist()
    assert heard.far == run.truth.distances["distance_m"].max()
    assert heard.robots == len(run.truth.robots)


def test_each_distance_comes_right_before_its_read(scenario):
    class InOrder(tagfield.Outlet):
        def __init__(self):
            self.calls = []

        def on_read(self, read):
            self.calls.append(("read", read.tag, read.stamp_s))

        def on_distance(self, stamp_s, antenna, tag, distance_m):
            self.calls.append(("distance", tag, stamp_s))

    heard = InOrder()
    run = scenario.with_(duration_s=1).run(outlets=[heard], locate=False)
    assert len(heard.calls) == 2 * len(run.reads) > 0
    for distance, read in zip(heard.calls[::2], heard.calls[1::2]):
        assert (distance[0], read[0]) == ("distance", "read")
        assert distance[1:] == read[1:]


def test_what_an_outlet_raises_is_raised(scenario):
    def spoilsport(read):
        raise LookupError(read.tag)

    with pytest.raises(LookupError, match="tag"):
        scenario.run(outlets=[spoilsport])
    with pytest.raises(tagfield.Error, match="outlet must be"):
        scenario.run(outlets=[3])


def test_other_threads_go_on_and_interrupts_end_it(scenario):
    ticks = []

    def tick():
        for _ in range(50):
            ticks.append(time.monotonic())
            time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGINT)

    ticker = threading.Thread(target=tick)
    # A shell starts background processes with SIGINT ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        ticker.start()
        with pytest.raises(KeyboardInterrupt):
            scenario.run_many(100_000)
        ticker.join()
    finally:
        signal.signal(signal.SIGINT, before)
    assert len(ticks) == 50
