#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The live page in a real headless Chromium with WebGL in software.

    page_live_test.py --tagfield PROGRAM --source SOURCE_DIR --build BUILD_DIR
                      [--screenshots DIR] [CASE…]

The page is bundled with npm packages and served by a mock server that replays a real run in a loop
(adapters/http/page/test/mock.mjs); the cases named real_… use 'tagfield serve' instead. Skipped if node,
npm packages, Chromium or its WebGL are not available.
"""

import base64
import bisect
import collections
import contextlib
import functools
import json
import math
import pathlib
import sys
import tempfile
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "command"))
from browser import (NO_WEBGL, Bundle, browser, mock, serious_barriers, webgl_or_skip)  # noqa: E402
from common import (Skip, case, check, check_between, check_equal, check_in, check_near,
                     # noqa: E402
                    main, position, read_csv)
from npm import npm_packages  # noqa: E402
from served import served  # noqa: E402

SCENARIO = "warehouse_physics"
PAGE_TESTS = pathlib.Path(__file__).parent.parent / "page"  # Its packages include axe.
LEAST_CONTRAST = 4.5  # WCAG 2.1, success criterion 1.4.3, for text.
LARGEST_PAGE = 900_000
_shared = {}

# Queries to the page, in JavaScript.
CONTROLS = """[...at.root.querySelectorAll('button, input, select')]
  .filter((one) => one.offsetParent)"""
NAMELESS = """[...at.root.querySelectorAll('button, input, select, canvas')].filter((one) =>
  !(one.getAttribute('aria-label') || one.textContent.trim() || one.placeholder ||
    (one.id && at.root.querySelector(`label[for='${one.id}']`)))).map((one) => one.outerHTML)"""
OUT_OF_SIGHT = f"""{CONTROLS}.filter((one) => {{
  const box = one.getBoundingClientRect();
  return box.left < -1 || box.right > 391;
}}).map((one) => one.outerHTML)"""
SMALL_BUTTONS = f"""{CONTROLS}.filter((one) => one.matches('button') && one.offsetHeight < 24)
  .map((one) => one.textContent)"""
BUDGET_ROWS = """[...at.detail.querySelector('table').querySelectorAll('tr')].map((row) =>
  [row.querySelector('th').textContent, row.querySelector('.number').textContent])"""
TEXT_COLORS = """[...new Set(
  [...at.root.querySelectorAll('h1, h2, h3, p, dt, dd, th, td, label, span, .clock')]
  .filter((one) => one.offsetParent && one.textContent && !one.closest('button, .pick'))
  .map((one) => getComputedStyle(one).color))]"""


class Shared:
    """The run, the bundle and the browser, shared by all cases, as each takes seconds to create."""

    def __init__(self, context, stack):
        folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="tagfield-")))
        context.folder = folder
        self.bundle = Bundle(context)
        self.chromium = stack.enter_context(browser())
        webgl_or_skip(self.chromium)
        self.run = context.simulate(SCENARIO, name="warehouse")


def with_page(*arguments):
    """Decorator of a case with arguments (context, browser, address, shared) and its own mock server."""
    def mark(function):
        @functools.wraps(function)
        def run_it(context):
            shared = shared_of(context)
            words = [word.replace("TAGFIELD", str(context.tagfield)).replace(
                "SCENARIO", str(context.shipped(SCENARIO))) for word in arguments]
            shared.chromium.screen()
            with mock(context, shared.bundle, shared.run, *words) as address:
                shared.chromium.open(address)
                function(context, shared.chromium, address, shared)
                complaints = shared.chromium.complaints()
                check(not complaints, f"console: {complaints[:3]}")
                keep_screenshot(shared.chromium, function.__name__)
        run_it.__name__ = function.__name__
        return case(run_it)
    return mark


def shared_of(context):
    if "skip" in _shared:
        raise Skip(_shared["skip"])
    if "all" not in _shared:
        own = type(context)(**vars(context))
        try:
            _shared["all"] = Shared(own, _shared["stack"])
        except Skip as skip:
            _shared["skip"] = str(skip)
            raise
    return _shared["all"]


def keep_screenshot(one, name):
    if _shared.get("screenshots"):
        data = base64.b64decode(one.command("Page.captureScreenshot")["data"])
        (_shared["screenshots"] / f"{name}.png").write_bytes(data)


def get(address, path):
    with urllib.request.urlopen(f"{address}/api/{path}") as answer:
        return json.load(answer)


def pose_at(rows, t):
    """Position [m] at a time, interpolated linearly between the rows of a CSV of poses."""
    stamps = [float(row["stamp_s"]) for row in rows]
    i = min(max(bisect.bisect_right(stamps, t), 1), len(stamps) - 1)
    share = (t - stamps[i - 1]) / (stamps[i] - stamps[i - 1])
    return [(1 - share) * a + share * b for a, b in zip(position(rows[i - 1]), position(rows[i]))]


def mean_color(rows):
    colors = [color for row in rows for color in row]
    return [sum(color[k] for color in colors) / len(colors) for k in range(3)]


def select(one, kind, name):
    one.do("view.select(arguments[0], world[arguments[0] + 'Index'].get(arguments[1]))", kind, name)
    one.wait(f"at.detail.querySelector('h2')?.textContent.endsWith({json.dumps(name)})",
             f"the panel of {name} is open")


@with_page()
def scene_is_drawn(context, one, address, shared):
    one.wait("view.stage.frames > 5", "frames were drawn")
    one.press_button("views", "Top")
    one.do("view.time.toggle()")
    one.still()
    solids = {solid["name"]: solid for solid in get(address, "scene")["solids"]}
    # Seen from above, the uppermost shelf of a rack is visible here; boxes are elsewhere.
    shelf = solids["racks::rack_west_1::shelf_4"]
    x, y, z = shelf["pose"][:3]
    px, py = one.project([x, y + 0.3, z + shelf["box"][2] / 2])
    color = mean_color(one.pixels(px - 1, py - 1, 3, 3))
    # Metal is a bluish grey (125, 139, 153): light changes only its brightness.
    for k, part in enumerate((125, 139, 153)):
        check_near(color[k] / sum(color), part / (125 + 139 + 153), 0.02,
                   f"share {k} of a rack's colour {color}")
    pallet = next(solid for name, solid in solids.items() if name.startswith("obstacles::column"))
    px, py = one.project([*pallet["pose"][:2], 2 * pallet["pose"][2]])
    wood = mean_color(one.pixels(px - 1, py - 1, 3, 3))
    check(wood[0] > wood[1] + 10 > wood[2] + 20, f"the wooden column is drawn as {wood}")
    background = one.pixels(1270, 60, 1, 1)[0][0]
    rows = one.pixels(280, 60, 980, 600)
    other = sum(color != background for row in rows[::8] for color in row[::8])
    check_between(other / sum(len(row[::8]) for row in rows[::8]), 0.3, 0.95,
                  "the share of the canvas with something on it")


@with_page()
def nothing_is_asked_of_others(context, one, address, shared):
    one.wait("world.time > 1", "time goes on")
    select(one, "tag", "tag1")
    asked = one.requests()
    check(any(url.startswith("ws://") for url in asked),
          "no WebSocket: the test looked in the wrong place")
    for url in asked:
        check(url.startswith((address, address.replace("http", "ws"), "data:", "blob:")),
              f"asks for {url[:120]}")
    check_between(shared.bundle.page.stat().st_size, 100_000, LARGEST_PAGE,
                  "the page's size [bytes]")
    again = context.folder / "again.html"
    shared.bundle.build(again)
    check(again.read_bytes() == shared.bundle.page.read_bytes(), "built twice, the page differs")


def frames_within(one, seconds):
    before = one.ask("view.stage.frames")
    one.driver.execute_async_script(f"setTimeout(arguments[0], {1000 * seconds})")
    return one.ask("view.stage.frames") - before


@with_page()
def frames_are_drawn_only_when_something_changed(context, one, address, shared):
    one.wait("view.stage.frames > 5", "frames were drawn")
    one.do("view.time.toggle()")
    one.wait("world.paused", "it stands still")
    one.still()
    check_equal(frames_within(one, 1.5), 0, "frames drawn in 1.5 s of a paused world")
    before = one.ask("view.stage.frames")
    one.press_button("time", "Step")
    one.wait(f"view.stage.frames > {before}", "a step draws")


@with_page("--explain", "TAGFIELD", "SCENARIO")
def tag_is_picked_by_a_click(context, one, address, shared):
    one.wait("view.stage.frames > 5", "frames were drawn")
    one.press_button("views", "Top")
    one.do("view.time.toggle()")
    one.wait("world.paused", "it stands still")
    one.still()
    for tag in get(address, "tags")["tags"][2:5]:
        one.click(*one.project(tag["position"]))
        one.wait(f"at.detail.innerText.startsWith('Tag {tag['id']}')",
                 f"the panel of {tag['id']} is open")
        place = ", ".join(f"{value:.2f}".replace("-", "−") for value in tag["position"])
        check_in(f"({place}) m", one.text("detail"), "the panel")
    one.wait("at.detail.querySelectorAll('table').length === 3", "the link budget is there")
    one.click(*one.project([0, 9, 0]))
    one.wait("at.detail.hidden", "a click beside closes the panel")


@with_page("--explain", "TAGFIELD", "SCENARIO")
def budget_adds_up(context, one, address, shared):
    one.do("view.time.toggle()")
    one.wait("world.paused", "it stands still")
    select(one, "tag", "tag4")
    one.wait("at.detail.querySelector('table')", "the link budget is there")
    name, t = one.ask("[at.detail.querySelector('select').value, world.time]")
    link = json.loads(context.run_well("explain", context.shipped(SCENARIO), "--json", "--antenna",
                                       name,
                                       "--tag", "tag4", "--time", t).out)
    rows = one.ask(BUDGET_ROWS)
    values = [float(text.replace("−", "-").split()[0]) for _, text in rows]
    lines = len(link["to_tag"])
    check_equal([what for what, _ in rows[:lines]], [line["what"] for line in link["to_tag"]],
                "the lines")
    check_near(values[lines], sum(values[:lines]), 0.05 * (lines + 1),
               "the sum of the lines, each to 0.1 dB")
    check_near(values[lines], link["tag_dbm"], 0.051, "the power at the chip")
    check_near(values[-1], link["tag_dbm"] - link["tag_sensitivity_dbm"], 0.051, "the margin")
    check_in(link["verdict"], one.text("detail"), "the panel")
    drawn = one.ask("view.drawing.link.group.children.length")
    free = [path for path in link["paths"] if not path["blocked"] or path["bounces"] == 0]
    check_equal(drawn, min(len(free), 12), "paths drawn")


@with_page("--explain", "TAGFIELD", "SCENARIO")
def coverage_is_drawn(context, one, address, shared):
    one.do("view.time.toggle(); view.look('top')")
    one.wait("world.paused", "it stands still")
    select(one, "antenna", "left")
    one.still()
    px, py = one.project([6.0, -9.5, 0.0])
    before = mean_color(one.pixels(px - 2, py - 2, 5, 5))
    one.press_button("detail", "Draw coverage")
    one.wait("at.detail.innerText.includes('m² of')", "the coverage is there", 60)
    one.still()
    after = mean_color(one.pixels(px - 2, py - 2, 5, 5))
    check(max(abs(a - b) for a, b in zip(before, after)) > 15, f"the floor stays {before}: {after}")
    # The hall including its walls is 16.4 m by 20.4 m, rounded up to cells.
    area = float(one.text("detail").split("m² of ")[1].split()[0])
    check_between(area, 16.4 * 20.4, 17 * 21, "the area looked at [m²]")


@with_page("--recorded")
def slider_moves_the_recorded_run(context, one, address, shared):
    robot = read_csv(shared.run / "truth" / "robot_poses.csv")
    stamps = sorted(float(row["stamp_s"]) for row in read_csv(shared.run / "reads.csv"))
    for t in (30.0, 12.5, 60.0):
        one.do("view.time.slider.value = arguments[0];"
               "view.time.slider.dispatchEvent(new Event('input', {bubbles: true}))", str(t))
        one.wait(f"Math.abs(world.time - {t}) < 0.02", f"the slider goes to {t} s")
        seen, now, reads = one.ask("[world.robots.get('p3at'), world.time, world.log.end]")
        check(math.dist(seen[:3], pose_at(robot, now)) < 0.02, f"at {now} s the robot is at {seen}")
        check_equal(reads, bisect.bisect_right(stamps, now), f"reads up to {now} s")
        one.wait(f"at.time.innerText.includes('{now:.2f} s of')", "the clock says so")
    one.do("view.time.slider.focus()")
    one.press("\ue012")  # Arrow left, on the slider: one of its steps.
    one.wait("world.time < 60.0", "the slider moves by keyboard")
    one.do("at.canvas.blur(); view.time.slider.blur()")
    before = one.ask("world.time")
    one.press("\ue014")  # Arrow right.
    one.wait(f"Math.abs(world.time - {before + 1}) < 0.01", "an arrow goes on by a second")
    one.press(" ")
    one.wait(f"world.time > {before + 1.3}", "the space bar plays")


@with_page("--recorded")
def colors_are_those_of_the_reads(context, one, address, shared):
    one.do("view.recording.seek(40)")
    one.wait("world.time === 40", "40 s")
    strongest = {}
    for row in read_csv(shared.run / "reads.csv"):
        if 38 < float(row["stamp_s"]) <= 40:
            strongest[row["tag"]] = max(float(row["rssi_dbm"]), strongest.get(row["tag"], -999))
    check(len(strongest) > 5, "hardly a tag is read then: another time must be taken")
    one.wait("world.changed.size === 0", "all is drawn")
    for tag, rssi in strongest.items():
        check_near(one.ask(f"world.strength[world.tagIndex.get('{tag}')]"), rssi, 1e-3,
                   f"RSSI of {tag}")


@with_page("--recorded")
def ellipses_hold_95_percent(context, one, address, shared):
    one.wait("!!view.drawing.estimates.lines.geometry.attributes.position", "ellipses are drawn")
    points = one.ask("[...view.drawing.estimates.lines.geometry.attributes.position.array]")
    points = [points[i:i + 3] for i in range(0, len(points), 3)]
    located = [row for row in read_csv(shared.run / "estimates.csv") if row["verdict"] == "located"]
    each = len(points) // len(located)
    for k, row in enumerate(located):
        x, y, _ = position(row)
        xx, xy, yy = (float(row[f"cov_{key}"]) for key in ("xx", "xy", "yy"))
        # Without the six end points of the cross, and the two of the line to the true position.
        rim = points[k * each + 6:(k + 1) * each - 2]
        for px, py, _ in rim:
            u, v = px - x, py - y
            squared = (yy * u * u - 2 * xy * u * v + xx * v * v) / (xx * yy - xy * xy)
            check_near(squared, 5.991, 0.05, f"{row['tag']}'s rim: squared Mahalanobis distance")
        check(len(rim) == 80, f"{row['tag']}: {len(rim)} points of the rim")


@with_page()
def beam_ends_at_half_power(context, one, address, shared):
    one.wait("view.drawing.antennas.items[0]?.beam?.children[0]", "an antenna's beam was drawn")
    points = one.ask(
        "[...view.drawing.antennas.items[0].beam.children[0].geometry.attributes.position.array]")
    points = [points[i:i + 3] for i in range(3, len(points), 3)]  # The first is the antenna.
    angles = [math.atan2(math.hypot(y, z), x) for x, y, z in points]
    # The mock's panel antenna has a gain of cos² of the angle from boresight, in steps of 5°.
    check_near(max(angles), math.pi / 4, 0.01, "the widest angle of the beam drawn [rad]")
    farthest = max(math.dist((0, 0, 0), point) for point in points)
    check_near(farthest, 3.0, 1e-3, "the beam's length at its peak [m]")


@case
def server_goes_and_comes_back(context):
    shared = shared_of(context)
    one = shared.chromium
    one.screen()
    with mock(context, shared.bundle, shared.run) as address:
        one.open(address)
        one.wait("at.status.textContent === '' && world.tags.length === 10", "it is connected")
        select(one, "tag", "tag7")
    one.wait("at.status.textContent.includes('away')", "the page says that the server is away")
    with mock(context, shared.bundle, shared.run, "--tags", "5",
              port=int(address.rsplit(":", 1)[1])):
        one.wait("at.status.textContent === '' && world.tags.length === 15", "all was fetched anew")
        one.wait("world.time > 0.2", "frames come again")
        check_equal(one.ask("world.selectedName()"), {"kind": "tag", "name": "tag7"},
                    "what is selected")


@case
def without_webgl_lists_and_panels_work(context):
    shared = shared_of(context)
    with mock(context, shared.bundle, shared.run) as address, browser(NO_WEBGL) as one:
        one.open(address)
        check(one.ask("view.stage === null"), "there is WebGL: the test tests nothing")
        check_in("no WebGL", one.text("noWebgl"), "the page")
        check(one.ask("at.canvas.hidden && !at.noWebgl.hidden"), "the empty canvas is shown")
        one.wait("world.time > 1", "frames come")
        one.wait("at.lists.innerText.includes('dBm')", "the list shows RSSI")
        one.do("at.lists.querySelector('.list button').click()")
        one.wait("at.detail.innerText.includes('Tag tag1')", "the panel opens")


@with_page()
def keyboard_does_it_all(context, one, address, shared):
    one.press("/")
    check(one.ask("at.root.activeElement === view.lists.search"), "'/' does not go to the search")
    one.press("tag10")
    one.wait("at.lists.innerText.includes('1 tag\\n')", "the search finds one")
    one.press("\ue004", "\ue004")  # Tab, over the order, to the list's only button.
    check_equal(one.ask("at.root.activeElement.innerText.split('\\n')[0]"), "tag10",
                "what has the focus")
    outline = one.ask("getComputedStyle(at.root.activeElement).outlineStyle")
    check_equal(outline, "solid", "the outline of what has the focus")
    one.press("\ue007")  # Enter.
    one.wait("at.detail.innerText.startsWith('Tag tag10')", "Enter opens the panel")
    one.press("\ue00c")  # Escape.
    one.wait("at.detail.hidden", "Escape closes it")
    one.do("at.canvas.focus()")
    before = one.ask("view.stage.camera.position.toArray()")
    one.press("\ue012")
    after = one.ask("view.stage.camera.position.toArray()")
    check_near(after[2], before[2], 1e-6, "the camera's height")
    check(math.dist(before, after) > 0.5, "an arrow does not turn the view")
    one.press(" ")
    one.wait("world.paused", "the space bar pauses")
    check(get(address, "status")["paused"], "the server goes on")
    paused = get(address, "status")["time"]
    one.press(".")
    one.wait(f"world.time > {paused}", "the full stop steps")
    check_near(get(address, "status")["time"], paused + 0.1, 1e-6, "the time after a step")


@with_page()
def all_that_can_be_pressed_has_a_name(context, one, address, shared):
    select(one, "antenna", "left")
    nameless = one.ask(NAMELESS)
    check_equal(nameless, [], "controls without a name")
    check_equal(one.ask("at.status.getAttribute('aria-live')"), "polite",
                "the status line's aria-live")


def share_drawn(one):
    """Share of the visible canvas that differs from its most frequent colour."""
    one.wait("view.stage.frames > 5", "frames were drawn")
    left, top, width, bottom = one.ask("""(() => {
      const box = at.canvas.getBoundingClientRect();
      return [box.left, box.top, box.width, at.root.querySelector('.panels').getBoundingClientRect().top];
    })()""")
    rows = one.pixels(left, top, width, bottom - top)
    colors = [color for row in rows[::4] for color in row[::4]]
    return 1 - max(collections.Counter(colors).values()) / len(colors)


@with_page()
def phone_has_room(context, one, address, shared):
    one.screen(390, 844, mobile=True)
    for what in ("view.deselect()", "view.select('tag', 0)",
                 "view.deselect(); view.lists.show('changes')"):
        one.do(what)
        one.driver.execute_async_script("setTimeout(arguments[0], 700)")
        width, inner = one.ask("[document.scrollingElement.scrollWidth, window.innerWidth]")
        check(width <= inner == 390, f"{what}: {width} px wide in a window of {inner} px")
        outside = one.ask(OUT_OF_SIGHT)
        check_equal(outside, [], f"{what}: controls out of sight")
        check_between(one.ask("at.canvas.clientHeight"), 250, 700,
                      f"{what}: the height of what is drawn [px]")
        check_between(share_drawn(one), 0.1, 1, f"{what}: share of the canvas with something on it")
        small = one.ask(SMALL_BUTTONS)
        check_equal(small, [], f"{what}: buttons of less than 24 px")


def luminance(color):
    """Relative luminance of (r, g, b), each 0 to 255 (WCAG 2.1)."""
    linear = [part / 255 / 12.92 if part <= 10.3 else ((part / 255 + 0.055) / 1.055) ** 2.4
              for part in color]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def css_color(text):
    return [float(part) for part in text[text.index("(") + 1:-1].replace(",", " ").split()[:3]]


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@with_page("--explain", "TAGFIELD", "SCENARIO")
def light_and_dark_are_legible(context, one, address, shared):
    select(one, "tag", "tag2")
    one.wait("at.detail.querySelector('table')", "the link budget is there")
    for theme in ("light", "dark"):
        one.screen(theme=theme)
        one.wait(f"at.view.dataset.theme === '{theme}'", f"the page is {theme}")
        panel = css_color(one.ask("getComputedStyle(at.lists).backgroundColor"))
        check((luminance(panel) < 0.1) == (theme == "dark"), f"{theme}: panels of {panel}")
        px, py = 1270 - 380, 60
        check((luminance(one.pixels(px, py, 1, 1)[0][0]) < 0.1) == (theme == "dark"),
              f"{theme}: the drawing's background")
        colors = one.ask(TEXT_COLORS)
        check(len(colors) >= 2, f"only {colors}: the test looked in the wrong place")
        for color in colors:
            check(contrast(css_color(color), panel) >= LEAST_CONTRAST,
                  f"{theme}: text of {color} on {panel} is too faint")
    one.press_button("view", "Light")
    check_equal(one.ask("at.view.dataset.theme"), "light", "the theme after the switch")
    one.do("localStorage.clear()")


@with_page()
def no_barrier_is_serious(context, one, address, shared):
    packages = npm_packages(context.build, PAGE_TESTS, "page")
    axe = (packages / "node_modules/axe-core/axe.min.js").read_text(encoding="utf-8")
    for theme in ("light", "dark"):
        one.screen(theme=theme)
        for what in ("view.deselect()", "view.select('tag', 0)", "view.select('antenna', 0)",
                     "view.deselect(); view.lists.show('changes')"):
            one.do(what)
            one.driver.execute_async_script("setTimeout(arguments[0], 700)")
            check_equal(serious_barriers(one.driver, axe), [], f"{theme}, {what}: barriers")


@with_page("--change-while-loading")
def changes_while_the_page_loads_are_not_missed(context, one, address, shared):
    one.wait("world.position.slice(0, 3).join() === '1,2,3'", "the tag is where it was moved to", 20)


@with_page("--late-frames")
def world_that_is_set_back_is_fetched_anew(context, one, address, shared):
    one.wait("world.time > 0.5", "time goes on")
    one.requests()
    end = one.ask("world.time") + 3
    one.do("view.time.command('POST', 'step', {seconds: 3})")
    one.wait(f"world.time > {end}", "the step's answer is there")
    one.driver.execute_async_script("setTimeout(arguments[0], 1000)")  # and the frames that it overtook
    again = [url for url in one.requests() if url.endswith("/api/scene")]
    check_equal(again, [], "requests after an answer that overtook frames")
    urllib.request.urlopen(f"{address}/api/set-back", data=b"{}").close()
    one.wait("world.position.slice(0, 3).join() === '1,2,3'", "the world was fetched anew", 20)
    one.wait("world.time < 3", "it goes by the time of the frames", 20)


@with_page()
def changes_reach_the_world(context, one, address, shared):
    one.do("view.lists.show('changes')")
    evil = "<img src=x onerror=window.hacked=1>"
    one.do("at.root.getElementById('new-tag').value = arguments[0]", evil)
    one.press_button("lists", "Add tag")
    one.wait("world.tags.length === 11", "the tag is there")
    one.do("view.lists.show('tags')")
    one.wait("at.lists.innerText.includes('<img')", "its name is text")
    check(one.ask("!window.hacked && !at.root.querySelector('img')"),
          "a tag's name was taken for HTML")
    one.do("view.lists.show('changes'); at.root.getElementById('new-tag').value = arguments[0]",
           "tag1")
    one.press_button("lists", "Add tag")
    one.wait("view.changes.error.textContent", "a refusal is said")
    check_equal(one.text("lists").strip().split("\n")[-1], 'tags: there is a "tag1" already',
                "the refusal")
    one.press_button("lists", "Put it there")
    one.wait("world.scene.obstacles.length === 1", "the pallet is there")
    select(one, "antenna", "right")
    one.press_button("detail", "Disconnect")
    one.wait("world.antennas[1].faulty", "the antenna is disconnected")
    select(one, "tag", "tag5")
    one.press_button("detail", "Remove")
    one.wait("!world.tags[4].present", "the tag is gone")


@with_page()
def place_is_taken_from_a_click(context, one, address, shared):
    one.press_button("views", "Top")
    one.do("view.time.toggle(); view.lists.show('changes')")
    one.still()
    one.press_button("lists", "Click a position")
    one.click(*one.project([2.0, -7.0, 0.0]))
    x, y, z = (float(one.ask(f"at.root.getElementById('new-tag-{axis}').value")) for axis in "xyz")
    check(math.dist((x, y, z), (2, -7, 0)) < 0.06,
          f"the place clicked is ({x}, {y}, {z}), expected (2, −7, 0)")


@with_page("--tags", "10000")
def ten_thousand_tags_are_usable(context, one, address, shared):
    check_equal(one.ask("world.tags.length"), 10010, "tags")
    one.wait("view.stage.frames > 5", "frames were drawn")
    check_in("10010 tags", one.text("lists"), "the list")
    check(one.ask("view.stage.renderer.info.render.calls") < 80, "a tag has a draw call of its own")
    one.do("view.lists.search.value = 'case_9999'; view.lists.rebuild()")
    one.do("at.lists.querySelector('.list button').click()")
    one.wait("at.detail.innerText.startsWith('Tag case_9999')", "the panel opens")


@case
def report_holds_the_same_view(context):
    shared = shared_of(context)
    one = shared.chromium
    one.screen()
    page = shared.run / "report.html"
    check_between(page.stat().st_size, 5e5, 3e6, "size of the report [bytes]")
    one.open(page.as_uri())
    one.wait("view.stage.frames > 0", "a frame was drawn")
    one.do("view.recording.seek(40)")
    one.wait("world.time === 40", "40 s")
    own = ("data:", "blob:", page.as_uri())
    check_equal([url for url in one.requests() if not url.startswith(own)], [], "requests")
    check_equal(one.ask("at.view.offsetHeight"), 600, "the view's height")
    check(one.driver.execute_script("return getComputedStyle(document.querySelector('h2')).fontSize") !=
          one.ask("getComputedStyle(at.detail.querySelector('h2') ?? at.name).fontSize"),
          "the view's style reaches the report")
    check(not one.complaints(), "the console has complaints")
    keep_screenshot(one, "report")


@case
def a_recorded_map_lies_on_the_floor(context):
    shared = shared_of(context)
    one = shared.chromium
    one.screen()
    folder = context.simulate("z_axis", name="mapped")
    # Three columns, two rows, the upper one first: 254 is free, 0 occupied, 205 unknown.
    (folder / "map.pgm").write_bytes(b"P5 3 2 255\n" + bytes([254, 254, 0, 0, 205, 254]))
    (folder / "map.yaml").write_text("image: map.pgm\nresolution: 0.5\norigin: [-1, -2, 0]\nnegate: 0\n"
                                     "occupied_thresh: 0.65\nfree_thresh: 0.196\n", encoding="utf-8")
    context.run_well("report", folder)
    one.open((folder / "report.html").as_uri())
    one.wait("view.stage.frames > 0", "a frame was drawn")
    check_equal(one.ask("world.scene.map"),
                {"resolution": 0.5, "origin": [-1, -2], "width": 3, "height": 2,
                 "runs": [1, 1, 1, 2, 3, 0, 1, 1]}, "the map")
    place, opacities = one.ask("""(() => {
      const map = view.drawing.ground.group.children.find((one) => one.material.map);
      const cells = [...map.material.map.image.data].filter((value, i) => i % 4 === 3);
      return [map.position.toArray(), cells.map((value) => value > 0 ? (value > 100 ? 1 : 2) : 0)];
    })()""")
    check_near(place[0], -0.25, 1e-9, "x of the map's middle")
    check_near(place[1], -1.5, 1e-9, "y of the map's middle")
    check_equal(opacities, [1, 2, 0, 0, 0, 1], "cells: free 0, occupied 1, unknown 2")


@case
def bodies_walk_and_come_and_go(context):
    shared = shared_of(context)
    one = shared.chromium
    one.screen()
    text = context.shipped("portal").read_text(encoding="utf-8")
    text = text.replace("../", f"{context.source}/") + (
        "\nobstacles:\n"
        "  - {name: worker, radius_m: 0.25, trajectory: [[0, -1, -2], [4, -1, 2], [8, 1, 2]]}\n"
        "  - {name: pallet, size: [1, 0.8], position: [1, 1], material: cardboard, disappears_s: 6}\n")
    with served(context, context.write("people.yaml", text), "--paused", "--speed",
                "20") as server:
        one.open(server.addresses["http"])
        one.wait("view.stage.frames > 0 && world.scene.obstacles.length === 2", "the bodies are there")
        for time_s, place, stands in ((0, [-1, -2], True), (3, [-1, 1], True), (7, [0.5, 2], False)):
            if time_s > 0:
                server.post("/api/step", {"seconds": time_s - server.get("/api/status")["time"]})
            one.wait(f"Math.abs(world.time - {time_s}) < 1e-6 && world.paused", f"{time_s} s")
            bodies = "view.drawing.solids.passing.map(({mesh}) => [mesh.visible, mesh.position.x, mesh.position.y])"
            one.wait(f"{bodies}.length === 2 && "
                     f"Math.hypot({bodies}[0][1] - {place[0]}, {bodies}[0][2] - {place[1]}) < 1e-4",
                     f"the worker is at {place} at {time_s} s")
            worker, pallet = one.ask(bodies)
            check(worker[0], "the worker is not drawn")
            check_equal(pallet[0], stands, f"the pallet at {time_s} s")


@case
def real_plan_is_drawn_in_place_of_the_tags(context):
    shared = shared_of(context)
    out = context.folder / "plan"
    context.run_well("plan", context.shipped("plan/store"), "--samples", "8", "--out", out)
    one = shared.chromium
    one.screen()
    with served(context, out / "layout.yaml", "--allow-outside") as server:
        plan = server.get("/api/plan")
        one.open(server.addresses["http"])
        one.wait("world.tags.length === 600 && at.lists.querySelector('[data-tab=plan]')", "there is a plan")
        server.post("/api/pause")
        one.wait("world.paused", "it stands still")
        one.do("view.lists.show('plan'); view.look('top')")
        last = len(plan["layouts"]) - 1
        worst = min(range(len(plan["positions"])), key=lambda i: plan["percent"][0][i])
        seen = []
        for layout in (0, last):
            one.do("const count = at.lists.querySelector('#plan-layout'); count.value = String(arguments[0]); "
                   "count.dispatchEvent(new Event('input'))", layout)
            check_in(f"{layout + 1} antenna", one.text("lists"), "what is said of the layout")
            one.still()
            px, py = one.project(plan["positions"][worst])
            seen.append(mean_color(one.pixels(px - 1, py - 1, 3, 3)))
        # A position that is hardly read with one antenna (grey), and read with all of them (yellow).
        check(max(seen[0]) - min(seen[0]) < 60, f"with one antenna it is {seen[0]}")
        check(seen[1][0] - seen[1][2] > 90, f"with {last + 1} antennas it is {seen[1]}")
        check(not one.ask("view.drawing.tags.meshes[0].visible"), "tags are drawn over it")
        one.do("at.lists.querySelector('#plan-tags').click()")
        check(one.ask("view.drawing.tags.meshes[0].visible"), "tags were asked for, too")
        one.do("view.lists.show('tags')")
        check(not one.ask("view.drawing.plan.cubes.visible"), "the plan stays when its tab is left")
        keep_screenshot(one, "plan")
        complaints = one.complaints()
        check(not complaints, f"console: {complaints[:3]}")


@case
def silent_readers_are_explained(context):
    one = shared_of(context).chromium
    one.screen()
    with served(context, context.shipped("portal"), "--llrp", "0") as server:
        one.open(server.addresses["http"])
        one.wait("view.time?.silent.textContent.includes('wait for a client')",
                 "the page says why nothing is read")


@case
def real_server_is_shown(context):
    shared = shared_of(context)
    if context.run("serve", "--help").code != 0:
        raise Skip("this tagfield has no 'serve'")
    one = shared.chromium
    one.screen()
    with served(context, context.shipped(SCENARIO)) as server:
        address = server.addresses["http"]
        with urllib.request.urlopen(address) as answer:
            if b"tagfield-view" not in answer.read():
                raise Skip("this tagfield was built without its page")
        one.open(address)
        one.wait("view.stage.frames > 10 && world.time > 1", "frames come")
        check_equal(one.ask("view.time.silent.textContent"), "", "what is said of silent readers")
        one.wait("world.strength.some((one) => one < 0)", "tags are read")
        select(one, "tag", "tag4")
        one.wait("at.detail.querySelectorAll('table').length === 3", "the link budget is there")
        one.press_button("time", "Pause")
        one.wait("world.paused", "the page says that it stands still")
        check(server.get("/api/status")["paused"], "the server goes on")
        before = server.get("/api/status")["time"]
        one.wait("!view.time.step.disabled", "a step can be asked for")
        one.press_button("time", "Step")
        one.wait(f"world.time > {before}", "a step goes on")
        one.wait("world.paused", "it stands still again")
        one.do("view.lists.show('changes')")
        one.press_button("lists", "Add tag")
        one.wait("world.tags.length === 11", "a tag was added")
        one.press_button("lists", "Put it there")
        one.wait("world.scene.obstacles.length === 1", "a pallet stands there")
        select(one, "antenna", "left")
        one.press_button("detail", "Draw coverage")
        one.wait("at.detail.innerText.includes('m² of')", "the coverage is there", 60)
        keep_screenshot(one, "real")
        complaints = one.complaints()
        check(not complaints, f"console: {complaints[:3]}")
    one.wait("at.status.textContent.includes('away')", "the page says that the server is away")


if __name__ == "__main__":
    if "--screenshots" in sys.argv:
        at = sys.argv.index("--screenshots")
        _shared["screenshots"] = pathlib.Path(sys.argv[at + 1])
        _shared["screenshots"].mkdir(parents=True, exist_ok=True)
        del sys.argv[at:at + 2]
    with contextlib.ExitStack() as everything:
        _shared["stack"] = everything
        main()
