# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium with WebGL in software, and the queries of the page's tests."""

import base64
import contextlib
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "command"))
from common import Skip, check, clean_environment, run  # noqa: E402

CHROMIUM = "/usr/bin/chromium"
CHROMEDRIVER = "/usr/bin/chromedriver"
SOFTWARE_WEBGL = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
NO_WEBGL = ("--disable-gpu", "--disable-3d-apis")
PAGE = """const view = document.getElementById('tagfield-view').tagfield;
const {at, world} = view;"""
WEBGL = "return !!document.createElement('canvas').getContext('webgl2')"
READY = "!!document.getElementById('tagfield-view')?.tagfield?.world.tags.length"


def decode_png(data):
    """Rows of (r, g, b) of a PNG with 8 bits per channel and without interlacing (RFC 2083)."""
    at, packed, header = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", chunk)
        elif kind == b"IDAT":
            packed += chunk
        at += 12 + length
    width, height, depth, color = header[:4]
    assert depth == 8 and color in (2, 6) and header[6] == 0, header
    size = 3 if color == 2 else 4
    raw, rows, above = zlib.decompress(packed), [], bytearray(width * size)
    for y in range(height):
        start = y * (width * size + 1)
        line = unfiltered(raw[start], bytearray(raw[start + 1:start + 1 + width * size]), above,
                          size)
        rows.append([tuple(line[x:x + 3]) for x in range(0, len(line), size)])
        above = line
    return rows


def unfiltered(kind, line, above, size):
    for i, value in enumerate(line):
        left = line[i - size] if i >= size else 0
        corner = above[i - size] if i >= size else 0
        if kind == 1:
            value += left
        elif kind == 2:
            value += above[i]
        elif kind == 3:
            value += (left + above[i]) // 2
        elif kind == 4:
            guess = left + above[i] - corner
            value += min((left, above[i], corner), key=lambda one: abs(guess - one))
        line[i] = value & 255
    return line


# axe's violations with impact serious or critical, or about landmarks.
AXE = """
const done = arguments[arguments.length - 1];
axe.run(document, {resultTypes: ['violations']}).then(found => done(found.violations
  .filter(one => one.impact === 'serious' || one.impact === 'critical' || one.id.startsWith('landmark-') || one.id === 'region')
  .map(one => one.id + ': ' + one.help + ': ' + one.nodes.map(node => node.target.flat().join(' ')).slice(0, 3).join(', '))),
  error => done(['axe failed: ' + error]));
"""


def serious_barriers(driver, axe):
    """Serious accessibility violations, and those about landmarks, of the open page, found by axe-core with the source `axe`."""
    driver.execute_script(axe)
    return driver.execute_async_script(AXE)


class Browser:
    """One tab. Points are CSS pixels of the window."""

    def __init__(self, flags, profile):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
        options = webdriver.ChromeOptions()
        options.binary_location = CHROMIUM
        for flag in ("--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run",
                     "--disable-background-networking", "--disable-component-update",
                     "--disable-sync", "--hide-scrollbars", f"--user-data-dir={profile}", *flags):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(CHROMEDRIVER), options=options)
        self.driver.set_script_timeout(60)

    def command(self, name, **arguments):
        return self.driver.execute_cdp_cmd(name, arguments)

    def screen(self, width=1280, height=800, mobile=False, theme="light"):
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height,
                     deviceScaleFactor=1, mobile=mobile)
        self.command("Emulation.setTouchEmulationEnabled", enabled=mobile)
        self.command("Emulation.setEmulatedMedia",
                     features=[{"name": "prefers-color-scheme", "value": theme}])

    def open(self, address):
        """Opens the page and waits until it has its tags."""
        self.driver.get("about:blank")
        self.driver.get_log("browser")
        self.driver.get_log("performance")
        self.driver.get(address)
        self.wait(READY, "the page has its tags")

    def ask(self, expression, *arguments):
        """The value of a JavaScript expression with the variables view, at, world and arguments."""
        return self.driver.execute_script(f"{PAGE} return ({expression});", *arguments)

    def do(self, statements, *arguments):
        self.driver.execute_script(f"{PAGE} {statements}", *arguments)

    def wait(self, expression, what, seconds=90):
        end = time.monotonic() + seconds
        asked = f"return !!({expression});"
        if not expression.startswith("!!document"):
            asked = PAGE + asked
        while time.monotonic() < end:
            if self.driver.execute_script(asked):
                return True
            time.sleep(0.1)
        return check(False, f"after {seconds} s not: {what}")

    def text(self, part):
        """The visible text of one part of the page: "detail", "status", "time" …"""
        return self.ask(f"at.{part}.innerText")

    def pixels(self, x, y, width, height):
        image = self.command("Page.captureScreenshot", clip={
            "x": x, "y": y, "width": width, "height": height, "scale": 1})
        return decode_png(base64.b64decode(image["data"]))

    def project(self, place):
        """Pixel of a point [m] in frame W."""
        x, y = self.ask(f"view.stage.project(...{json.dumps(list(place))})")
        left, top = self.ask("(({left, top}) => [left, top])(at.canvas.getBoundingClientRect())")
        return [x + left, y + top]

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.command("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left",
                         clickCount=1)

    def press(self, *keys):
        from selenium.webdriver import ActionChains
        ActionChains(self.driver).send_keys(*keys).perform()

    def press_button(self, part, text):
        self.do("const one = [...at[arguments[0]].querySelectorAll('button')]"
                ".find((button) => button.textContent === arguments[1]);"
                "if (!one) throw new Error(`no button ${arguments[1]}`); one.click();", part, text)

    def still(self):
        """Waits until no more frames are drawn, nor any is pending: a busy machine draws one seconds later."""
        before = None
        for _ in range(100):
            now, pending = self.ask("[view.stage.frames, view.stage.asked]")
            if now == before and not pending:
                return
            before = now
            time.sleep(0.3)
        check(False, "the page goes on drawing")

    def complaints(self):
        """Warnings and errors of the console, except for rejected requests (Conflict)."""
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] in ("WARNING", "SEVERE") and "(Conflict)" not in entry["message"]]

    def requests(self):
        """All URLs that the page requested, including WebSockets."""
        addresses = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                if not message["params"]["documentURL"].startswith(("chrome:", "about:")):
                    addresses.append(message["params"]["request"]["url"])
            elif message["method"] == "Network.webSocketCreated":
                addresses.append(message["params"]["url"])
        return addresses


@contextlib.contextmanager
def browser(flags=SOFTWARE_WEBGL):
    try:
        import selenium  # noqa: F401 pylint: disable=unused-import
    except ImportError as missing:
        raise Skip("python3-selenium is not installed") from missing
    for program in (CHROMIUM, CHROMEDRIVER):
        if not shutil.which(program):
            raise Skip(f"{program} is not installed")
    with tempfile.TemporaryDirectory(prefix="tagfield-chromium-",
                                     ignore_cleanup_errors=True) as profile:
        one = Browser(flags, profile)
        try:
            one.screen()
            yield one
        finally:
            one.driver.quit()


def webgl_or_skip(one):
    one.driver.get("about:blank")
    if not one.driver.execute_script(WEBGL):
        raise Skip("Chromium draws no WebGL here")


class Bundle:
    """The page, built once in the build folder, with npm packages."""

    def __init__(self, context):
        for program in ("node", "npm"):
            if not shutil.which(program):
                raise Skip(f"{program} is not installed")
        self.modules = context.build / "adapters" / "http" / "node"
        self.source = context.source / "adapters" / "http" / "page"
        self.page = context.folder / "page.html"
        made = run([self.source / "make", "npm", "node", self.modules, self.page],
                   cwd=context.folder)
        if made.code != 0 or not self.page.stat().st_size:
            raise Skip(made.out.strip() or made.err.strip())

    def build(self, page):
        made = run(["node", self.source / "build.mjs", page, "--modules", self.modules])
        check(made.code == 0, f"build.mjs: {made.err}")


@contextlib.contextmanager
def mock(context, bundle, folder, *arguments, port=0):
    """Starts a mock server of the run in `folder`; yields its address."""
    command = ["node", bundle.source / "test" / "mock.mjs", bundle.page, folder,
               context.source / "worlds" / "small_warehouse.sdf", "--modules", bundle.modules,
               "--port", port, *arguments]
    process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, env=clean_environment())
    try:
        line = process.stdout.readline().decode()
        if not line.startswith("http: "):
            raise RuntimeError("the mock server did not start")
        yield line.split(": ", 1)[1].strip()
    finally:
        process.terminate()
        process.wait()
        process.stdout.close()
