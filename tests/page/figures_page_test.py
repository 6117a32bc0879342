#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Pages in headless Chromium: no serious accessibility violations by axe (npm); interactive figures; print.

    figures_page_test.py --tagfield PROGRAM --source SOURCE_DIR --build BUILD_DIR
"""

import base64
import pathlib
import re
import sys
import time
import urllib.parse

HERE = pathlib.Path(__file__).parent
sys.path[:0] = [str(HERE.parent / "command"), str(HERE.parent / "live")]

from browser import NO_WEBGL, browser, serious_barriers  # noqa: E402
from common import case, check, check_equal, check_in, check_near, main, read_csv  # noqa: E402
from npm import npm_packages  # noqa: E402

SUITE = """scenario: {scenario}
seeds: 2
methods: [hyperbola, ml, sar]
conditions:
  - {{name: true pose}}
  - {{name: noise 0.5 rad, set: {{antennas.mobile.phase_noise_rad: 0.5}}}}
"""
LONG_SUITE = """scenario: {scenario}
seeds: 1
methods: [hyperbola, least_squares, ml, sar, trilateration]
conditions:
""" + "".join(f"  - {{{{name: noise {tenths / 10} rad, set: {{{{antennas.mobile.phase_noise_rad: {tenths / 10}}}}}}}}}\n"
              for tenths in range(1, 15))
SWEEP = """scenario: {scenario}
seeds: 2
methods: [hyperbola, ml]
sweep:
  grid: {{antennas.mobile.phase_noise_rad: [0.1, 0.3, 0.5]}}
"""


def pages_of(context):
    """Writes and returns one page of each kind."""
    hall = context.shipped("paper_warehouse")
    context.run_well("run", hall, "--out", "run")
    context.run_well("run", hall, "--out", "noisy", "--set", "pose.source=noisy")
    context.run_well("compare", "run", "noisy", "--out", "compare")
    context.run_well("bench", context.write("suite.yaml", SUITE.format(scenario=hall)), "--out", "bench")
    context.run_well("sweep", context.write("sweep.yaml", SWEEP.format(scenario=hall)), "--out", "sweep")
    context.run_well("track", context.shipped("conveyor"), "--out", "track")
    context.run_well("coverage", context.shipped("portal"), "--out", "coverage")
    context.run_well("plan", context.shipped("plan/room"), "--samples", "8", "--out", "plan")
    return [context.folder / page for page in (
        "run/report.html", "compare/compare.html", "bench/bench.html", "sweep/sweep.html", "track/tracks.html",
        "coverage/coverage.html", "plan/plan.html")]


def more_pages(context):
    """Pages that are longer than those of pages_of(): robot that maps, portal, warnings, a bench of many conditions."""
    context.run_well("run", context.shipped("paper_warehouse_slam"), "--out", "slam")
    context.run_well("run", context.shipped("portal"), "--out", "portal")
    context.run_well("coverage", context.shipped("two_antennas"), "--set", "model=multipath", "--out", "warned")
    context.run_well("bench", context.write("long.yaml", LONG_SUITE.format(scenario=context.shipped("paper_warehouse"))),
                     "--out", "long")
    return [context.folder / page for page in (
        "slam/report.html", "portal/report.html", "warned/coverage.html", "long/bench.html")]


def open_page(one, page, width=1400, theme="light"):
    one.screen(width, 900, width < 500, theme)
    one.driver.get("about:blank")
    one.driver.get(page.as_uri())
    end = time.monotonic() + 60
    while one.driver.execute_script("return document.readyState") != "complete":
        check(time.monotonic() < end, f"{page} was not loaded within a minute")
        time.sleep(0.1)


def pointed_at(one, figure, share_x, share_y):
    """Text of the tooltip with the pointer in a figure, at shares of its width and height."""
    left, top, width, height = one.driver.execute_script(
        "const svg = document.querySelector(`#${arguments[0]} svg`); svg.scrollIntoView({block: 'center'});"
        "const box = svg.getBoundingClientRect(); return [box.left, box.top, box.width, box.height];", figure)
    for step in (1, 0):
        one.command("Input.dispatchMouseEvent", type="mouseMoved", x=left + share_x * width - step,
                    y=top + share_y * height)
    return one.driver.execute_script(
        "const tip = document.querySelector('.tip'); return tip.hidden ? '' : tip.textContent")


def printed_pages(pages):
    """Number of sheets of A4 that each page is printed to."""
    counts = []
    with browser(NO_WEBGL) as one:
        for page in pages:
            open_page(one, page, theme="dark")
            printed = base64.b64decode(
                one.command("Page.printToPDF", preferCSSPageSize=True, printBackground=True)["data"])
            counts.append(len(re.findall(rb"/Type\s*/Page\b(?!s)", printed)))
    return counts


@case
def no_barrier_is_serious(context):
    axe = (npm_packages(context.build, HERE, "page") / "node_modules/axe-core/axe.min.js").read_text(encoding="utf-8")
    pages = pages_of(context)
    with browser(NO_WEBGL) as one:
        for page in pages:
            for width, theme in ((1400, "light"), (390, "dark")):
                open_page(one, page, width, theme)
                one.driver.execute_script("for (const one of document.querySelectorAll('details')) one.open = true;")
                check_equal(serious_barriers(one.driver, axe), [], f"{page.name}, {width} px, {theme}: barriers")
                check(one.driver.execute_script(
                    "return document.scrollingElement.scrollWidth <= window.innerWidth"),
                    f"{page.name} scrolls sideways at {width} px")


@case
def figures_say_values_and_hide_series(context):
    context.run_well("track", context.shipped("conveyor"), "--out", "track")
    rows = read_csv(context.folder / "track/tracks.csv")
    with browser(NO_WEBGL) as one:
        open_page(one, context.folder / "track/tracks.html")
        said = pointed_at(one, "speeds", 0.5, 0.55)
        for _ in range(30):  # Searches for the lines; all tags move at about 1 m/s.
            if said:
                break
            said = pointed_at(one, "speeds", 0.5, 0.2 + 0.02 * _)
        check_in("level speed [m/s]", said, "what the figure says")
        name, stamp, speed = said.split("\n")
        check_near(float(speed.split(": ")[1]), 1.0, 0.05, "speed under the pointer")
        stamps = [float(row["stamp_s"]) for row in rows if row["tag"] == name]
        check(stamps and min(stamps) <= float(stamp.split(": ")[1]) <= max(stamps), f"it says {said!r}")

        shown = "return [...document.querySelectorAll('#speeds polyline')].filter(e => e.style.display !== 'none').length"
        check_equal(one.driver.execute_script(shown), 12, "lines")
        key = one.driver.find_element("css selector", "#speeds g.key")
        key.send_keys("\n")
        check_equal(one.driver.execute_script(shown), 11, "lines with one hidden by the keyboard")
        check_equal(key.get_attribute("aria-pressed"), "false", "what the entry tells")
        one.driver.execute_script("arguments[0].dispatchEvent(new MouseEvent('click'))", key)
        check_equal(one.driver.execute_script(shown), 12, "lines with all shown again")
        check_equal(one.complaints(), [], "the console")


@case
def cells_say_what_they_hold(context):
    context.run_well("coverage", context.shipped("portal"), "--out", "cover")
    rows = read_csv(context.folder / "cover/coverage_0.90m.csv")
    with browser(NO_WEBGL) as one:
        open_page(one, context.folder / "cover/coverage.html")
        heard = 0
        for share_x in (0.3, 0.5, 0.7):
            for share_y in (0.3, 0.45, 0.6):
                lines = pointed_at(one, "margin_0\\.90m", share_x, share_y).split("\n")
                if len(lines) != 3 or not lines[0].startswith("margin [dB]: "):
                    continue  # On an antenna, or outside the map.
                heard += 1
                x, y = (float(line.split(": ")[1].replace("−", "-")) for line in lines[1:])
                cell = min(rows, key=lambda row: abs(float(row["x_m"]) - x) + abs(float(row["y_m"]) - y))
                check(abs(float(cell["x_m"]) - x) < 0.06 and abs(float(cell["y_m"]) - y) < 0.06, f"no cell at {x}, {y}")
                edges = [float(edge) for edge in re.findall(r"-?[0-9]+", lines[0].split(": ")[1].replace("−", "-"))]
                # The pointer may be on the edge between two cells, whose margins differ by little.
                margin = float(cell["margin_db"])
                low = -1e9 if "below" in lines[0] else edges[0]
                high = 1e9 if "more" in lines[0] else edges[-1]
                check(low - 1.5 <= margin <= high + 1.5, f"at {x}, {y} the margin is {margin}, and the page says {lines[0]}")
        check(heard >= 6, f"of nine places the page says something at {heard}")
        check_equal(one.complaints(), [], "the console")


@case
def tags_rows_and_marks_are_linked_and_figures_zoomed(context):
    context.run_well("run", context.shipped("paper_warehouse"), "--out", "run")
    with browser(NO_WEBGL) as one:
        open_page(one, context.folder / "run/report.html")
        ask = one.driver.execute_script
        # A row's name highlights the tag's marks in all figures, a second activation clears them.
        cell = one.driver.find_elements("css selector", "[aria-label=Tags] tbody th.linked")
        check_equal(len(cell), 10, "rows that lead to figures")
        cell[4].send_keys("\n")
        chosen = "return [...document.querySelectorAll('#%s svg .chosen')].length"
        check_equal(ask(chosen % "fig09_map"), 2, "true place and estimate of the tag on the map")
        check_equal(ask(chosen % "fig10_errors"), 1, "its bar")
        check_equal(ask("return document.querySelector('tr.chosen th').textContent"), cell[4].text, "its row")
        cell[4].send_keys("\n")
        check_equal(ask("return document.querySelectorAll('.chosen').length"), 0, "chosen after a second time")
        # A mark highlights its row.
        ask("const e = document.querySelectorAll('#fig10_errors svg rect.bar')[3], b = e.getBoundingClientRect();"
            "e.ownerSVGElement.dispatchEvent(new MouseEvent('click', {clientX: b.left + 5, clientY: b.top + 5}))")
        check_equal(ask("return document.querySelector('tr.chosen th').textContent"), "tag4", "row of the fourth bar")
        # With zoom, a mark keeps its size, and two marks are further apart.
        look = ("const e = [...document.querySelectorAll('#fig09_map svg path.truth')].filter(e => !e.closest('.key'))"
                ".map(e => e.getBoundingClientRect()); return [e[0].width, Math.hypot(e[0].x - e[1].x, e[0].y - e[1].y)]")
        size, apart = ask(look)
        buttons = one.driver.find_elements("css selector", "#fig09_map .zoom button")
        check_equal([button.is_enabled() for button in buttons], [True, False, False], "buttons at first")
        ask("arguments[0].click()", buttons[0])
        new_size, new_apart = ask(look)
        check_near(new_size, size, 0.1 * size, "size of a mark")
        check_near(new_apart, 2.0 * apart, 0.01 * apart, "distance of two marks")
        ask("arguments[0].click()", buttons[2])
        check_near(ask(look)[1], apart, 0.01 * apart, "distance with all shown again")
        check_equal(one.complaints(), [], "the console")


@case
def data_is_saved_without_the_network(context):
    context.run_well("track", context.shipped("conveyor"), "--out", "track")
    order = {(row["passed"], row["tag"]): row for row in read_csv(context.folder / "track/order.csv")}
    saved = context.folder / "saved"
    saved.mkdir()
    with browser(NO_WEBGL) as one:
        open_page(one, context.folder / "track/tracks.html")
        one.command("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(saved))
        one.driver.execute_script("document.querySelector('#passings a.data').click()")
        end = time.monotonic() + 20
        while not (saved / "passings.csv").exists() and time.monotonic() < end:
            time.sleep(0.1)
        one.complaints()
    rows = read_csv(saved / "passings.csv")
    check_equal(len(rows), len(order), "rows")
    for row in rows:
        check_equal(row["time_s"], order[row["passed"], row["tag"]]["stamp_s"], f"{row['tag']} at {row['passed']}")


@case
def a_run_prints_to_two_pages(context):
    check_equal(printed_pages([context.simulate("paper_warehouse") / "report.html"]), [2], "printed pages")


def check_that_figures_lead(page):
    text = page.read_text(encoding="utf-8").split("<main>", 1)[1]
    head = text[:text.index("<figure")]
    # The cells of a bench's first table are its figure of all methods and conditions.
    check(head.count("<table") <= head.count('class="table heat'), f"{page}: a table leads")
    check(head.count("<li>") <= 2 or "<details" in head, f"{page}: many warnings stand before the first figure")
    folded = re.search(r'<details class="note"><summary><strong>([0-9]+) warnings', head)
    if page.parent.name == "warned":
        check(folded is not None and int(folded.group(1)) > 2, "the number of warnings is not at the top")


@case
def pages_lead_with_figures_and_print_to_two_pages(context):
    pages = pages_of(context) + more_pages(context)
    for page in pages:
        check_that_figures_lead(page)
    counts = printed_pages(pages)
    check_equal({str(page.relative_to(context.folder)): count for page, count in zip(pages, counts) if count > 2}, {},
                "pages with more than two printed ones")


@case
def long_tables_are_printed_in_part_and_say_so(context):
    run = context.simulate("paper_warehouse")
    page = (run / "report.html").read_text(encoding="utf-8")
    row = re.search(r"<tr><th scope=\"row\" title=\"tag1\">.*?</tr>\n", page).group(0)
    (run / "report.html").write_text(page.replace(row, 60 * row), encoding="utf-8")
    with browser(NO_WEBGL) as one:
        open_page(one, run / "report.html")
        count = "return [...document.querySelectorAll('[aria-label=Tags] tbody tr')].filter(e => e.offsetHeight).length"
        said = "return [...document.querySelectorAll('.left-out')].filter(e => e.offsetHeight).map(e => e.textContent)"
        check_equal((one.driver.execute_script(count), one.driver.execute_script(said)), (69, []), "rows on a screen")
        one.command("Emulation.setEmulatedMedia", media="print")
        check_equal(one.driver.execute_script(count), 40, "printed rows")
        check_equal(one.driver.execute_script(said), ["The first 40 of 69 rows; the page on a screen has all."],
                    "what stands below the table")


@case
def figures_of_a_plan_follow_its_controls(context):
    context.run_well("plan", context.shipped("plan/room"), "--samples", "8", "--out", "plan")
    positions = read_csv(context.folder / "plan/plan_positions.csv")
    with browser(NO_WEBGL) as one:
        open_page(one, context.folder / "plan/plan.html")
        ask = one.driver.execute_script
        place = "const e = document.querySelector('#plan_level_1 circle.place'); "
        share = ask(place + "const s = e.ownerSVGElement.viewBox.baseVal;"
                            "return [e.cx.baseVal.value / s.width, e.cy.baseVal.value / s.height, +e.dataset.place]")
        for count in (0, 2):  # Tips, and the layouts whose antennas are drawn, follow the slider.
            ask("const e = document.getElementById('plan-count'); e.value = arguments[0];"
                "e.dispatchEvent(new Event('input'))", count)
            said = pointed_at(one, "plan_level_1", *share[:2])
            wanted = round(100 * float(positions[share[2]][f"p_{count + 1}"]))
            check_in(f": {wanted} %", said, f"tip of a position with {count + 1} antennas")
            check_equal(ask("return [...document.querySelectorAll('#plan_level_1 g.layout')]"
                            ".filter(e => e.style.display !== 'none').map(e => +e.dataset.layout)"), [count], "layouts")
        shown = "return [...document.querySelectorAll('#plan_level_1 [class=reader0]')].filter(e => e.style.display !== 'none').length"
        before = ask(shown)
        ask("document.querySelector('#plan_level_1 g.key[data-key=reader0]').dispatchEvent(new MouseEvent('click'))")
        check(before > 0, "no antenna is drawn")
        check_equal(ask(shown), 0, "antennas of a hidden reader")
        ask("document.querySelector('#plan_level_1 .zoom button').click()")
        check(ask("return document.querySelector('#plan_level_1 svg').classList.contains('zoomed')"), "it is not zoomed")
        check_equal(one.complaints(), [], "the console")


@case
def each_figure_has_its_data(context):
    for page in pages_of(context):
        text = page.read_text(encoding="utf-8")
        for figure in re.findall(r'<figure id="([^"]+)">.*?</figure>', text, re.DOTALL):
            link = re.search(rf'download="{figure}\.csv" href="data:text/csv;charset=utf-8,([^"]*)"', text)
            if check(link is not None, f"{page.name}: {figure} has no data"):
                lines = urllib.parse.unquote(link.group(1)).splitlines()
                check(len(lines) > 1 and len({line.count(",") for line in lines}) == 1,
                      f"{page.name}: data of {figure}: {lines[:3]}")


if __name__ == "__main__":
    main()
