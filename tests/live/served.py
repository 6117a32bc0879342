# SPDX-License-Identifier: Apache-2.0
"""A scenario served by 'tagfield serve', for tests of clients."""

import contextlib
import http.client
import json
import os
import signal
import subprocess
import sys
import pathlib
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "command"))
from common import check, clean_environment  # noqa: E402 pylint: disable=wrong-import-position


class Served:
    """The process and its addresses, one per line: ("http", "http://127.0.0.1:PORT") and others."""

    def __init__(self, process, lines):
        self.process = process
        self.lines = lines
        self.addresses = dict(lines)

    @property
    def port(self):
        return int(self.addresses["http"].rsplit(":", 1)[1])

    def connection(self, timeout=20):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)

    def ask(self, method, target, body=None, headers=None):
        """Sends a request; returns (status, JSON)."""
        connection = self.connection()
        sent = dict(headers or {})
        data = None
        if body is not None:
            data = body if isinstance(body, (str, bytes)) else json.dumps(body)
            sent.setdefault("Content-Type", "application/json")
        connection.request(method, target, body=data, headers=sent)
        response = connection.getresponse()
        text = response.read()
        connection.close()
        return response.status, json.loads(text)

    def get(self, target):
        status, answer = self.ask("GET", target)
        check(status == 200, f"GET {target}: {status} {answer}")
        return answer

    def post(self, target, body=None):
        status, answer = self.ask("POST", target, body)
        check(status == 200, f"POST {target}: {status} {answer}")
        return answer

    def wait_for(self, holds, what, seconds=20):
        """Polls the status until the condition holds."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            status = self.get("/api/status")
            if holds(status):
                return status
            time.sleep(0.05)
        check(False, f"after {seconds} s not: {what}")
        return {}

    def memory_mb(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) / 1024
        return 0


def lines_until(process, word, seconds=60):
    """Lines of standard output, up to one that begins with `word`."""
    lines = []
    os.set_blocking(process.stdout.fileno(), True)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        line = process.stdout.readline().decode()
        if not line:
            break
        lines.append(line.strip())
        if line.startswith(word):
            break
    return lines


@contextlib.contextmanager
def served(context, scenario, *arguments, last="http", verb="serve"):
    """Starts a server on a free port, and ends it. `last` is the last address that it prints. With `verb`
    "view", it serves a recorded run."""
    command = [context.tagfield, verb, scenario, "--http", "0", *arguments]
    process = subprocess.Popen([str(word) for word in command], cwd=context.folder,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, env=clean_environment())
    lines = [tuple(line.split(": ", 1)) for line in lines_until(process, last) if ": " in line]
    if last not in dict(lines):
        process.kill()
        raise RuntimeError(f"it did not start: {process.communicate()[1].decode()}")
    try:
        yield Served(process, lines)
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGTERM)
            try:
                check(process.wait(timeout=20) == 0, f"exit code {process.returncode} when it was to end")
            except subprocess.TimeoutExpired:
                process.kill()
                check(False, "it did not end")
        process.stdout.close()
        process.stderr.close()
