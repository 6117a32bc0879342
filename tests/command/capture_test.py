#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Capture of events by an EPCIS 2.0 repository over HTTP: no loss during outages, and errors are reported.

    capture_test.py --tagfield PROGRAM --source SOURCE_DIR --build BUILD_DIR

The repository is a Python HTTP server; captured documents are validated against GS1's JSON schema.
"""

import base64
import contextlib
import http.server
import json
import shutil
import signal
import ssl
import subprocess
import threading
import time
import urllib.request

from common import Skip, case, check, check_equal, check_in, main, run
from epcis_schema import is_valid

SPEC = """events:
  logical_readers:
    - {name: belt, antennas: [gate_1, gate_2], biz_step: receiving, gone_biz_step: departing}
  presence: {reads: 3, within_s: 1, gone_after_s: 1}
"""


class Repository:
    """Answers requests with `answers` in turn, then always with the last: (status, header fields)."""

    def __init__(self, answers=((202, {}),), port=0, certificate=None, patience=None):
        repository = self
        self.answers = list(answers)
        self.documents = []  # Documents that it acknowledged.
        self.requests = []   # Header fields of each request.
        self.times = []
        self.hangs = patience or threading.Event()
        if patience is None:
            self.hangs.set()

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_POST(self):
                document = self.rfile.read(int(self.headers["Content-Length"]))
                repository.hangs.wait(60)
                repository.requests.append(dict(self.headers, path=self.path, size=len(document)))
                repository.times.append(time.monotonic())
                kept = repository.answers
                status, fields = kept.pop(0) if len(kept) > 1 else kept[0]
                text = b"" if status < 300 else b'{"title": "no\nway",\x1b "status": 0}'
                if callable(fields):
                    status, fields = fields(document)
                if status < 300:
                    repository.documents.append(document)
                self.send_response(status)
                for name, value in fields.items():
                    self.send_header(name, value)
                self.send_header("Content-Length", str(len(text)))
                self.end_headers()
                self.wfile.write(text)

            def log_message(self, *arguments):
                pass

            def handle(self):
                with contextlib.suppress(ConnectionError):  # The client has disconnected.
                    super().handle()

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", port), Handler)
        self.server.daemon_threads = True
        self.port = self.server.server_address[1]
        if certificate:
            tls = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            tls.load_cert_chain(*certificate)
            self.server.socket = tls.wrap_socket(self.server.socket, server_side=True)
        self.thread = threading.Thread(target=self.server.serve_forever, args=(0.05,), daemon=True)
        self.thread.start()

    def url(self, user=""):
        return f"http://{user}127.0.0.1:{self.port}/epcis/capture"

    def events(self):
        return [event for document in self.documents
                for event in json.loads(document)["epcisBody"]["eventList"]]

    def stop(self):
        self.hangs.set()
        self.server.shutdown()
        self.server.server_close()


@contextlib.contextmanager
def repository_of(*arguments, **options):
    repository = Repository(*arguments, **options)
    try:
        yield repository
    finally:
        repository.stop()


def expected(context, reads, *more):
    """The events as written by --epcis."""
    spec = context.write("spec.yaml", SPEC)
    context.run_well("events", reads, "--spec", spec, "--epcis", "expected.json", *more)
    document = json.loads((context.folder / "expected.json").read_text(encoding="utf-8"))
    return document["epcisBody"]["eventList"], spec


@case
def a_repository_gets_the_events_that_a_file_has(context):
    folder = context.simulate("conveyor", "--record-only")
    events, spec = expected(context, folder)
    with repository_of() as repository:
        result = context.run_well("events", folder, "--spec", spec, "--capture", repository.url())
    check(len(events) > 15, f"{len(events)} events")
    check_equal(repository.events(), events, "events")
    check_in(f"EPCIS: {len(events)} events captured", result.out, "the output")
    for number, document in enumerate(repository.documents):
        path = context.folder / f"captured_{number}.json"
        path.write_bytes(document)
        valid, why = is_valid(context, path)
        check(valid, f"not valid: {why[:500]}")
    fields = repository.requests[0]
    check_equal([fields[name] for name in ("path", "Content-Type", "GS1-EPCIS-Version", "GS1-CBV-Version")],
                ["/epcis/capture", "application/ld+json", "2.0.0", "2.0.0"], "header")


@case
def a_stream_posts_what_its_run_gives(context):
    folder = context.simulate("conveyor", "--record-only")
    events, spec = expected(context, folder)
    with repository_of() as repository:
        context.run_well("stream", context.shipped("conveyor"), "--speed", "0", "--spec", spec, "--capture",
                         repository.url())
    # The file ends with the last read, the stream with the scenario, after more tags have departed.
    check(len(events) > 15 and repository.events()[:len(events)] == events, "the events are others")
    check_equal(sum(event["bizStep"] == "receiving" for event in repository.events()),
                sum(event["bizStep"] == "departing" for event in repository.events()), "tags that are gone")


@case
def a_spec_may_come_through_a_pipe(context):
    # A pipe has its text only once.
    spec = context.write("spec.yaml", SPEC)
    with repository_of() as repository:
        result = run(["bash", "-c", '"$0" stream "$1" --speed 0 --capture "$2" --spec <(cat "$3")', context.tagfield,
                      context.shipped("conveyor"), repository.url(), spec], cwd=context.folder)
    check_equal(result.code, 0, f"exit code, {result.err!r}")
    check(any(event["bizStep"] == "receiving" for event in repository.events()), "no events as the spec names them")


@case
def a_repository_that_comes_late_or_is_busy_gets_all(context):
    folder = context.simulate("conveyor", "--record-only")
    events, spec = expected(context, folder)
    with repository_of() as repository:
        port = repository.port
    late = []
    timer = threading.Timer(1.5, lambda: late.append(
        Repository([(503, {}), (429, {"Retry-After": "2"}), (202, {})], port)))
    timer.start()
    result = context.run_well("events", folder, "--spec", spec, "--capture",
                              f"http://127.0.0.1:{port}/epcis/capture")
    timer.join()
    late[0].stop()
    check_equal(late[0].events(), events, "events")
    check_in("trying again", result.err, "warnings")
    check_in("it accepts events again", result.err, "warnings")
    check(late[0].times[2] - late[0].times[1] >= 2, f"Retry-After was not heeded: {late[0].times}")


@case
def a_refusal_is_an_error_in_one_line(context):
    folder = context.simulate("conveyor", "--record-only")
    events, spec = expected(context, folder)
    for status, fields in ((400, {}), (401, {}), (302, {"Location": "http://127.0.0.1:1/"})):
        with repository_of([(status, fields)]) as repository:
            result = context.run("events", folder, "--spec", spec, "--capture",
                                 repository.url("me:p%40ss@"))
        check_equal(result.code, 2, f"exit code after {status}")
        check_in(f"HTTP {status}: {{\"title\": \"no\\nway\",\\x1b", result.err, "what it said")
        check_in(f"captured 0 of {len(events)} events", result.err, "the error")
        check(all(line.startswith("tagfield: ") for line in result.err.splitlines()), result.err)
        check("p%40ss" not in result.err and "p@ss" not in result.err, f"password shown: {result.err}")
        sent = base64.b64decode(repository.requests[0]["Authorization"].split()[1])
        check_equal(sent, b"me:p@ss", "user and password")


@case
def documents_become_smaller_where_they_are_too_large(context):
    folder = context.simulate("conveyor", "--record-only")
    events, spec = expected(context, folder)
    with repository_of([(413, lambda document: (202 if len(document) < 2000 else 413, {}))]) as repository:
        context.run_well("events", folder, "--spec", spec, "--capture", repository.url(),
                         "--capture-header", "X-Api-Key: open sesame", "--capture-header", "X-Two:2")
    check_equal(repository.events(), events, "events")
    check(max(len(document) for document in repository.documents) < 2000, "documents are too large")
    check_equal((repository.requests[0]["X-Api-Key"], repository.requests[0]["X-Two"]),
                ("open sesame", "2"), "further header")


@case
def an_unknown_certificate_is_not_trusted(context):
    if shutil.which("openssl") is None:
        raise Skip("openssl is missing (it makes a certificate)")
    key, certificate = context.folder / "key.pem", context.folder / "certificate.pem"
    run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", key, "-out", certificate,
         "-days", "2", "-subj", "/CN=localhost"])
    folder = context.simulate("conveyor", "--record-only")
    with repository_of(certificate=(certificate, key)) as repository:
        process = subprocess.Popen(
            [context.tagfield, "stream", context.shipped("conveyor"), "--speed", "0", "--capture",
             f"https://localhost:{repository.port}/capture"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        line = process.stderr.readline().decode()
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=10)
        check_in("certificate", line, "the warning")
        check_equal(repository.documents, [], "documents")
    check(folder.exists(), "the run")


@case
def a_silent_repository_holds_nobody_up(context):
    with repository_of(patience=threading.Event()) as repository:
        process = subprocess.Popen(
            [context.tagfield, "serve", context.shipped("conveyor"), "--http", "0", "--speed", "20",
             "--capture", repository.url()],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        address = process.stdout.readline().decode().split()[1]
        until = time.monotonic() + 20
        while time.monotonic() < until:
            with urllib.request.urlopen(f"{address}/api/status") as answer:
                if json.load(answer)["time"] > 3:
                    break
            time.sleep(0.05)
        begun = time.monotonic()
        process.send_signal(signal.SIGTERM)
        _, warnings = process.communicate(timeout=20)
        took = time.monotonic() - begun
        check_equal(process.returncode, 2, "exit code where events were not captured")
        check(took < 1, f"it took {took:.2f} s to end")
        check_in("events were lost, the last", warnings.decode(), "warnings")


@case
def bad_words_are_refused(context):
    reads = context.write("reads.csv", "stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n")
    for words, said in (
            (("--capture", "ftp://host/x"), "must be http://"),
            (("--capture", "host:80"), "must be http://"),
            (("--capture", "http://"), "must be http://"),
            (("--capture", "http://u:secret@[::1/x"), "'http://[::1/x' must be"),
            (("--capture", "http://h/", "--capture-header", "no colon"), "must be 'Name: value'"),
            (("--capture", "http://h/", "--capture-header", "a: b\r\nc: d"), "must be 'Name: value'"),
            (("--capture-header", "a: b"), "--capture")):
        result = context.run("events", reads, *words)
        check_equal(result.code, 2, f"exit code of {words}")
        check_equal(len(result.err.splitlines()), 1, f"lines of {words}: {result.err!r}")
        check_in(said, result.err, str(words))
    result = context.run("stream", context.shipped("conveyor"), "--spec", context.write("s.yaml", SPEC))
    check_equal(result.code, 2, "exit code of --spec alone")
    check_in("--mqtt or --capture", result.err, "--spec alone")


if __name__ == "__main__":
    main()
