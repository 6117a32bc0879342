#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Frame times of the page of 'tagfield serve', with an increasing number of tags.

    page_frames.py --tagfield PROGRAM --build BUILD_DIR [--tags 0 1000 10000]

A mock server (adapters/http/page/test/mock.mjs) replays a real run in a loop with --tags additional
tags, which have a thousand reads per second. Frames are requested without a pause for eight seconds.
Prints for each number of tags: the page's own time per frame (median and 95th percentile [ms] of all
JavaScript, including drawing commands but not their execution by the GPU), draw calls, and frames per
second with software rendering by SwiftShader, which is slower than a GPU.
"""

import argparse
import pathlib
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "tests" / "command"))
sys.path.insert(0, str(SOURCE / "tests" / "live"))
from browser import Bundle, browser, mock  # noqa: E402 pylint: disable=wrong-import-position
from common import Context  # noqa: E402 pylint: disable=wrong-import-position

MEASURE = """
const done = arguments[0], {stage} = document.getElementById('tagfield-view').tagfield;
const first = stage.frames, start = performance.now(), times = [];
let known = first;
(function again() {
  if (stage.frames > known) times.push(stage.costs.frame);
  known = stage.frames;
  stage.invalidate();
  if (performance.now() - start < 8000) return requestAnimationFrame(again);
  times.sort((a, b) => a - b);
  const at = (share) => times[Math.floor(share * (times.length - 1))];
  const seconds = (performance.now() - start) / 1000;
  done([at(0.5), at(0.95), (stage.frames - first) / seconds, stage.renderer.info.render.calls]);
})();
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tagfield", type=pathlib.Path, required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--tags", type=int, nargs="+", default=[0, 1000, 10000])
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="tagfield-") as folder, browser() as one:
        context = Context(arguments.tagfield.resolve(), SOURCE, arguments.build.resolve(),
                          pathlib.Path(folder))
        bundle = Bundle(context)
        run = context.simulate("warehouse_physics")
        print("  tags   median [ms]   p95 [ms]   draw calls   frames/s in software")
        for tags in arguments.tags:
            with mock(context, bundle, run, "--tags", tags) as address:
                one.open(address)
                one.wait("world.time > 2", "frames come")
                median, most, rate, calls = one.driver.execute_async_script(MEASURE)
                print(f"{tags + 10:6d} {median:13.1f} {most:10.1f} {calls:12d} {rate:22.1f}")


if __name__ == "__main__":
    main()
