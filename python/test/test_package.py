# SPDX-License-Identifier: Apache-2.0
"""Stubs, docstrings and plots of the package."""

import ast
import inspect
import pathlib
import pickle

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pytest

import tagfield
from tagfield import _core


@pytest.fixture(scope="module")
def run():
    scenario = tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml"))
    return scenario.run(seed=1)


@pytest.fixture(autouse=True)
def no_figures_left():
    yield
    plt.close("all")


def stubs():
    tree = ast.parse((pathlib.Path(tagfield.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            names = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
            names |= {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}
            yield node.name, {name for name in names if not name.startswith("__")}
        elif isinstance(node, ast.FunctionDef):
            yield node.name, None


def test_stubs_are_what_is_there():
    declared = dict(stubs())
    there = {name for name in dir(_core) if not name.startswith("__")}
    assert set(declared) == there
    for name, members in declared.items():
        if members is not None and name != "Error":
            assert members == {one for one in vars(getattr(_core, name)) if not one.startswith("_")}, name


def test_errors_are_called_what_users_call_them():
    assert f"{tagfield.Error.__module__}.{tagfield.Error.__qualname__}" == "tagfield.Error"
    assert isinstance(pickle.loads(pickle.dumps(tagfield.Error("no"))), tagfield.Error)


def public_things():
    for name in tagfield.__all__:
        thing = getattr(tagfield, name)
        yield name, thing
        if inspect.isclass(thing) and thing.__module__.startswith("tagfield._") and name != "Table":
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    yield f"{name}.{member}", value
    for name in tagfield.plot.__all__:
        yield f"plot.{name}", getattr(tagfield.plot, name)


def test_everything_says_what_it_is():
    assert [name for name, thing in public_things() if not inspect.getdoc(thing)] == []


def texts(ax):
    return [text.get_text() for text in ax.texts] + [ax.get_title(), ax.get_xlabel(), ax.get_ylabel()]


def test_hall_shows_way_tags_and_estimates(run):
    ax = tagfield.plot.hall(run)
    labels = {line.get_label(): line for line in ax.lines}
    assert len(labels["true position"].get_xdata()) == 10
    np.testing.assert_allclose(labels["estimate"].get_xdata(), run.estimates["position_m"][run.located, 0])
    np.testing.assert_allclose(labels["antenna's path"].get_ydata(), run.poses["position_m"][:, 1])
    assert len(ax.patches) > 10
    assert "10 of 10 tags located" in ax.get_title()


def test_curves_show_the_reads(run):
    ax = tagfield.plot.phase(run, "tag3")
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), run.reads.where(tag="tag3")["phase_rad"])
    ax = tagfield.plot.rssi(run, "tag3", antenna="mobile")
    assert "RSSI [dBm]" in texts(ax)
    with pytest.raises(tagfield.Error, match="no reads of tag 'nobody'"):
        tagfield.plot.phase(run, "nobody")


def test_errors_reach_one(run):
    ax = tagfield.plot.errors({"hyperbola": [run], "ml": run.localize("ml")})
    for line in ax.lines:
        assert line.get_ydata()[-1] == 1
    assert len(ax.lines) == 2


def test_sar_image_peaks_at_the_tag(run):
    x, y, z = run.truth.positions_m()["tag3"]
    xs, ys = np.arange(x - 0.3, x + 0.3, 0.02), np.arange(y - 0.3, y + 0.3, 0.02)
    from tagfield import sar

    image = sar.image(run.reads, run.poses, "tag3", xs, ys, z)
    row, column = np.unravel_index(image.argmax(), image.shape)
    assert np.hypot(xs[column] - x, ys[row] - y) < 0.03
    assert image.max() == pytest.approx(np.exp(-0.1**2 / 2), abs=0.02)  # 0.1 rad of noise
    ax = tagfield.plot.sar_image(run, "tag3", radius_m=0.3)
    assert "maximum" in ax.get_title()


def test_maps_and_tracks_are_drawn(run):
    two = tagfield.load(tagfield.share("scenarios/two_antennas.yaml"))
    coverage = two.coverage(antennas=["fixed"], heights_m=[1.5], step_m=0.5, time_s=0)
    for quantity in ("probability", "reply_dbm"):
        assert "of the area read" in tagfield.plot.coverage(coverage, quantity).get_title()
    with pytest.raises(tagfield.Error, match="none of probability"):
        tagfield.plot.coverage(coverage, "power")
    conveyor = tagfield.load(tagfield.share("scenarios/conveyor.yaml"))
    ax = tagfield.plot.tracks(conveyor.track(seed=1), scenario=conveyor)
    assert len(ax.lines) == 12


def test_bench_is_drawn(run):
    compared = tagfield.bench(run.scenario, ["hyperbola", "trilateration"], {"a": {}, "b": {"pose.source": "noisy"}})
    ax = tagfield.plot.bench(compared)
    assert len(ax.texts) == 4
    assert ax.get_title() == "mean error [mm]"
