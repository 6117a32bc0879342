#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Opens report.html of run folders in headless Chromium and checks it.

    page_test.py [--screenshots DIR] RUN_FOLDER…

Checks at desktop and phone width, with light and dark theme: no console messages, no requests except the
page itself, every figure is drawn, no horizontal scrolling, legible text, a dark background in the dark
theme. Checks that each file in figures/ is self-contained XML. Needs Debian's packages chromium,
chromium-driver and python3-selenium; the exit code is 77 (skipped) if one is missing, 1 with one line per
failure, else 0.
"""

import argparse
import itertools
import json
import pathlib
import shutil
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree

SKIPPED = 77
CHROMIUM = "/usr/bin/chromium"
CHROMEDRIVER = "/usr/bin/chromedriver"
SCREENS = {"desktop": (1280, 900, False), "phone": (390, 844, True)}
THEMES = ("light", "dark")
LEAST_FONT_PX = 9.0
LEAST_CONTRAST = 4.5  # WCAG 2.1, success criterion 1.4.3, for text.

LOOK = """
const visible = [...document.querySelectorAll('figure')].map(figure => {
  const svg = figure.querySelector('svg');
  if (!svg) return {id: figure.id, width: 0, height: 0, marks: 0, fonts: [], caption: ''};
  const box = svg.getBoundingClientRect();
  const scale = box.width / svg.viewBox.baseVal.width;
  const texts = [...svg.querySelectorAll('text')];
  return {
    id: figure.id, width: box.width, height: box.height,
    marks: svg.querySelectorAll(
      'circle,polyline,path:not(.wall),rect:not(.frame),line:not(.grid):not(.axis)').length,
    fonts: texts.map(text => parseFloat(getComputedStyle(text).fontSize) * scale),
    cut: texts.filter(text => {
      const place = text.getBoundingClientRect();
      return place.left < box.left - 1 || place.right > box.right + 1 ||
             place.top < box.top - 1 || place.bottom > box.bottom + 1;
    }).map(text => text.textContent),
    colors: [...new Set(texts.filter(text => !text.classList.contains('rim'))
      .filter(text => !text.closest('.on-map'))
      .map(text => getComputedStyle(text).fill))],
    mapColors: [...svg.querySelectorAll('.on-map text:not(.rim)')]
      .map(text => getComputedStyle(text).fill),
    mapBackground: [...svg.querySelectorAll('.map-unknown')]
      .map(cells => getComputedStyle(cells).fill)[0] ?? '',
    caption: figure.querySelector('figcaption')?.textContent ?? '',
  };
});
const body = getComputedStyle(document.body);
return {figures: visible, background: body.backgroundColor, ink: body.color,
        scroll: document.scrollingElement.scrollWidth, inner: window.innerWidth,
        scripts: [...document.scripts].map(script => script.type),
        drawn: document.getElementById('tagfield-view')?.shadowRoot?.querySelector('canvas') != null};
"""

# Whether an injected script would run.
ANOTHER_SCRIPT = """
const script = document.createElement('script');
script.textContent = 'window.hasRun = true';
document.body.append(script);
script.remove();
return window.hasRun === true;
"""


def skip(what):
    print(f"skipped: {what}")
    sys.exit(SKIPPED)


def start_browser(profile):
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
    except ImportError:
        skip("python3-selenium is not installed")
    for program in (CHROMIUM, CHROMEDRIVER):
        if not shutil.which(program):
            skip(f"{program} is not installed")
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in ("--headless=new", "--no-sandbox", "--disable-quic",
                 "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                 "--no-first-run", "--disable-background-networking", "--disable-component-update",
                 "--disable-sync", "--hide-scrollbars", f"--user-data-dir={profile}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(CHROMEDRIVER), options=options)


def luminance(color):
    """Relative luminance of "rgb(r, g, b)" (WCAG 2.1)."""
    parts = [float(part) for part in color[color.index("(") + 1:-1].split(",")[:3]]
    linear = [part / 255 / 12.92 if part <= 10.3 else ((part / 255 + 0.055) / 1.055) ** 2.4
              for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def requests_of(driver, page):
    """URLs that the page requested since the last call, without requests of the browser's other tabs."""
    addresses = []
    for entry in driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if (message["method"] == "Network.requestWillBeSent" and
                message["params"]["documentURL"] == page.as_uri()):
            addresses.append(message["params"]["request"]["url"])
    return addresses


def wait_until_whole(driver, page):
    """Waits for the page, as on a busy machine the driver may return while it is still being parsed."""
    for _ in range(600):
        if driver.execute_script("return document.readyState === 'complete' && location.href") == \
                page.as_uri():
            return
        time.sleep(0.1)
    raise TimeoutError(f"{page} was not loaded within a minute")


def open_page(driver, page, screen, theme):
    width, height, mobile = SCREENS[screen]
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": height, "deviceScaleFactor": 2 if mobile else 1,
        "mobile": mobile})
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
        "features": [{"name": "prefers-color-scheme", "value": theme}]})
    driver.get("about:blank")
    driver.get_log("performance")
    driver.get(page.as_uri())
    wait_until_whole(driver, page)
    return driver.execute_script(LOOK)


def figure_faults(figure, background):
    name = f"figure {figure['id']}"
    if figure["width"] <= 200 or figure["height"] <= 100:
        yield f"{name} is {figure['width']:.0f}×{figure['height']:.0f} px, expected over 200×100"
        return
    if figure["marks"] == 0:
        yield f"{name} is empty"
    if min(figure["fonts"], default=LEAST_FONT_PX) < LEAST_FONT_PX:
        yield f"{name} has text of {min(figure['fonts']):.1f} px, expected {LEAST_FONT_PX} or more"
    for text in figure["cut"]:
        yield f"{name} cuts off '{text}'"
    for color in figure["colors"]:
        if contrast(color, background) < LEAST_CONTRAST:
            yield f"{name} has text of {color} on {background}, too faint"
    for color in figure["mapColors"]:
        if contrast(color, figure["mapBackground"]) < LEAST_CONTRAST:
            yield f"{name} has text of {color} on {figure['mapBackground']}, too faint"
    if len(figure["caption"]) < 20:
        yield f"{name} has no caption"


def view_faults(driver, page, theme, seen):
    for entry in driver.get_log("browser"):
        if entry["level"] in ("WARNING", "SEVERE"):
            yield f"console: {entry['message']}"
    addresses = requests_of(driver, page)
    if page.as_uri() not in addresses:
        yield "was never requested: the test looked in the wrong place"
    for address in addresses:
        if address != page.as_uri():
            yield f"requests {address[:200]}"
    # The replay of the run has data and a script; the other scripts are for tables, figures and links.
    if seen["scripts"] not in (["", "", ""], ["application/json", "", "", "", ""]):
        yield f"holds scripts of the types {seen['scripts']}"
    if "application/json" in seen["scripts"] and not seen["drawn"]:
        yield "does not show the run"
    if driver.execute_script(ANOTHER_SCRIPT):
        yield "lets another script run than its own"
    driver.get_log("browser")  # discards the message about it
    if seen["scroll"] > seen["inner"]:
        yield f"scrolls sideways: {seen['scroll']} px wide in a window of {seen['inner']} px"
    if (luminance(seen["background"]) < 0.1) != (theme == "dark"):
        yield f"has the background {seen['background']}"
    if contrast(seen["ink"], seen["background"]) < LEAST_CONTRAST:
        yield f"has text of {seen['ink']} on {seen['background']}, too faint"
    for figure in seen["figures"]:
        yield from figure_faults(figure, seen["background"])


def take_screenshot(driver, path):
    import base64
    size = driver.execute_cdp_cmd("Page.getLayoutMetrics", {})["cssContentSize"]
    image = driver.execute_cdp_cmd("Page.captureScreenshot", {
        "captureBeyondViewport": True,
        "clip": {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}})
    path.write_bytes(base64.b64decode(image["data"]))


def svg_faults(path):
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        yield f"{path.name} is not well-formed: {error}"
        return
    if root.tag != "{http://www.w3.org/2000/svg}svg":
        yield f"{path.name} is no SVG"
    for element in root.iter():
        for name, value in element.attrib.items():
            if name.endswith("href") or ("url(" in value and "url(#" not in value):
                yield f"{path.name} points outside: {value[:80]}"
    text = path.read_text(encoding="utf-8")
    for alien in ("var(--", "@import", "@font-face", "<script"):
        if alien in text:
            yield f"{path.name} holds {alien}"


def check_folder(driver, folder, screenshots):
    page = (folder / "report.html").resolve()
    if not page.exists():
        yield "has no report.html"
        return
    figures = set()
    for screen, theme in itertools.product(SCREENS, THEMES):
        seen = open_page(driver, page, screen, theme)
        figures = {figure["id"] for figure in seen["figures"]}
        for fault in view_faults(driver, page, theme, seen):
            yield f"({screen}, {theme}) {fault}"
        if screenshots:
            take_screenshot(driver, screenshots / f"{folder.name}-{screen}-{theme}.png")
    files = sorted((folder / "figures").glob("*.svg"))
    if {path.stem for path in files} != figures:
        yield f"figures/ holds {[path.stem for path in files]}, the page {sorted(figures)}"
    for path in files:
        yield from svg_faults(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=pathlib.Path, metavar="RUN_FOLDER")
    parser.add_argument("--screenshots", type=pathlib.Path, metavar="DIR")
    arguments = parser.parse_args()
    if arguments.screenshots:
        arguments.screenshots.mkdir(parents=True, exist_ok=True)
    failures = 0
    with tempfile.TemporaryDirectory(prefix="page_test-") as profile:
        driver = start_browser(profile)
        try:
            for folder in arguments.folders:
                for fault in check_folder(driver, folder, arguments.screenshots):
                    print(f"{folder}: {fault}")
                    failures += 1
        finally:
            driver.quit()
    print(f"{len(arguments.folders)} pages, {failures} failures")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
