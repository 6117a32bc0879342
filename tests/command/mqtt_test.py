#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Reads and events over MQTT, with a real mosquitto broker: no loss while the broker restarts.

    mqtt_test.py --tagfield PROGRAM --source SOURCE_DIR --build BUILD_DIR
"""

import collections
import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import time

from common import Skip, case, check, check_equal, check_in, main

SPEC = """events:
  presence: {reads: 3, within_s: 1, gone_after_s: 1}
  cycles: [{name: second, duration_s: 1, reports: [{set: additions}]}]
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def answers(port):
    with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), 1):
        return True
    return False


def until(condition, what, seconds=20):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.02)
    return check(False, f"after {seconds} s still not: {what}")


class Broker:
    """mosquitto on a loopback port, with sessions that persist over restarts."""

    def __init__(self, context, settings="allow_anonymous true\n"):
        self.program = shutil.which("mosquitto", path="/usr/sbin:/usr/bin:/usr/local/sbin")
        if self.program is None or shutil.which("mosquitto_sub") is None:
            raise Skip("mosquitto or mosquitto_sub is missing (scripts/setup --tests installs them)")
        self.port = free_port()
        self.configuration = context.write("mosquitto.conf", (
            f"listener {self.port} 127.0.0.1\n{settings}persistence true\n"
            f"persistence_location {context.folder}/\nmax_queued_messages 0\nuser root\n"))
        self.process = None
        self.start()

    def start(self):
        self.process = subprocess.Popen([self.program, "-c", self.configuration],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until(lambda: answers(self.port), "the broker answers")

    def stop(self):
        self.process.terminate()
        self.process.wait(timeout=20)

    def url(self, rest=""):
        return f"mqtt://127.0.0.1:{self.port}{rest}"


@contextlib.contextmanager
def broker_of(context, settings="allow_anonymous true\n"):
    broker = Broker(context, settings)
    try:
        yield broker
    finally:
        broker.process.kill()
        broker.process.wait()


@contextlib.contextmanager
def subscriber(context, broker, *words):
    """Subscribes to all topics; messages are appended to a file as lines "TOPIC PAYLOAD"."""
    file = context.folder / "heard.txt"
    with open(file, "wb") as out:
        process = subprocess.Popen(
            ["mosquitto_sub", "-h", "127.0.0.1", "-p", str(broker.port), "-q", "1", "-c", "-i",
             "listener", "-t", "tagfield/#", "-v", *words], stdout=out, stderr=subprocess.DEVNULL)
    # The subscription is active as soon as a message arrives.
    publish = ["mosquitto_pub", "-h", "127.0.0.1", "-p", str(broker.port), *words, "-t",
               "tagfield/ready", "-m", "yes"]
    def is_ready():
        subprocess.run(publish, check=True)
        return "ready" in file.read_text()
    try:
        until(is_ready, "the subscriber hears")
        yield lambda: [line.split(" ", 1) for line in file.read_text().splitlines()
                       if " " in line and not line.startswith("tagfield/ready")]
    finally:
        process.kill()
        process.wait()


def check_same(heard, lines, what):
    """Like check_equal(), without printing thousands of lines."""
    same = [a == b for a, b in zip(heard, lines)]
    first = same.index(False) if False in same else len(same)
    check(heard == lines, f"{what}: {len(heard)}, expected {len(lines)}; the first {first} agree")


def stream(context, *words):
    return subprocess.Popen([context.tagfield, "stream", *words], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def check_whole(heard, lines, most_twice):
    """Checks that each line was received once, or some of them twice, as QoS 1 allows."""
    counts = collections.Counter(heard)
    missing = [line for line in lines if line not in counts]
    check_equal(len(missing), 0, "reads that never came")
    check_equal(len(counts), len(lines), "different messages")
    twice = sum(count - 1 for count in counts.values())
    check(twice <= most_twice, f"{twice} came again, of {len(lines)}")


@case
def reads_and_events_come_under_their_topics(context):
    spec = context.write("spec.yaml", SPEC)
    with broker_of(context) as broker, subscriber(context, broker) as heard:
        program = stream(context, context.shipped("conveyor"), "--speed", "0", "--mqtt",
                         broker.url(), "--spec", spec)
        out, err = program.communicate(timeout=60)
        check_equal((program.returncode, err), (0, ""), "how it ended")
        lines = out.splitlines()
        until(lambda: len([t for t, _ in heard() if "/reads/" in t]) >= len(lines), "all is heard")
        reads = [payload for topic, payload in heard() if topic == "tagfield/reads/gate"]
        # In the order of the run, and identical to the standard output.
        check_same(reads, lines, "reads")
        events = [json.loads(payload) for topic, payload in heard() if topic == "tagfield/events"]
        kinds = collections.Counter(event["eventType"] for event in events)
        check_equal(kinds["observed"], 12, "tags that were observed")
        check(kinds["cycle"] >= 1, "there was no report")


@case
def nothing_is_lost_while_the_broker_restarts(context):
    with broker_of(context) as broker, subscriber(context, broker) as heard:
        program = stream(context, context.shipped("conveyor"), "--speed", "2", "--mqtt",
                         broker.url())
        until(lambda: len(heard()) > 200, "reads come")
        broker.stop()
        time.sleep(1.5)
        broker.start()
        out, err = program.communicate(timeout=60)
        check_equal(program.returncode, 0, "exit code")
        check_in("the connection is broken; trying again", err, "warnings")
        check_in(": connected\n", err, "warnings")
        check("lost" not in err, f"it says {err!r}")
        lines = out.splitlines()
        until(lambda: len({payload for _, payload in heard()}) >= len(lines), "all is heard")
        # 200 messages can be in flight when the connection breaks.
        check_whole([payload for _, payload in heard()], lines, 200)


@case
def a_broker_that_comes_late_gets_all(context):
    with broker_of(context) as broker, subscriber(context, broker) as heard:
        broker.stop()
        program = stream(context, context.shipped("conveyor"), "--speed", "0", "--mqtt",
                         broker.url())
        check_in("the broker can't be reached; trying again", program.stderr.readline(), "a warning")
        broker.start()
        out, err = program.communicate(timeout=60)
        check_in(": connected\n", err, "warnings")
        check("lost" not in err, f"it says {err!r}")
        lines = out.splitlines()
        until(lambda: len(heard()) >= len(lines), "all is heard")
        check_same([payload for _, payload in heard()], lines, "reads")


@case
def what_there_is_no_room_for_is_counted(context):
    scenario = context.shipped("conveyor")
    begin = time.monotonic()
    lines = context.run_well("stream", scenario, "--speed", 0).out.splitlines()
    alone = time.monotonic() - begin
    begin = time.monotonic()
    program = stream(context, scenario, "--speed", "0", "--mqtt", f"mqtt://127.0.0.1:{free_port()}",
                     "--mqtt-buffer", "100")
    for line in lines:
        check_equal(program.stdout.readline().rstrip(), line, "a read")
    took = time.monotonic() - begin
    # It waits for the broker only at its end.
    check(took < 5.0, f"{took:.1f} s beside a broker that is away, {alone:.1f} s alone")
    err = program.stderr.read()
    check_equal(program.wait(timeout=20), 2, "exit code")
    check_in("the queue of 100 messages is full: the oldest are lost from now on", err, "warnings")
    check_in(f"{len(lines)} of {len(lines)} messages were lost, the last 100 of them at the end",
             err, "warnings")


@case
def the_newest_are_kept(context):
    scenario = context.shipped("conveyor")
    lines = context.run_well("stream", scenario, "--speed", 0).out.splitlines()
    with broker_of(context) as broker, subscriber(context, broker) as heard:
        broker.stop()
        program = stream(context, scenario, "--speed", "0", "--mqtt", broker.url(), "--mqtt-buffer",
                         "100")
        for _ in lines:
            program.stdout.readline()
        broker.start()
        check_in(f"{len(lines) - 100} of {len(lines)} messages were lost\n", program.stderr.read(),
                 "warnings")
        check_equal(program.wait(timeout=20), 2, "exit code")
        until(lambda: len(heard()) >= 100, "the last are heard")
        check_same([payload for _, payload in heard()], lines[-100:], "what came")


@case
def users_have_passwords(context):
    passwords = context.write("passwords", "")
    subprocess.run(["mosquitto_passwd", "-b", passwords, "me", "p@ss:word"], check=True)
    settings = f"allow_anonymous false\npassword_file {passwords}\n"
    with broker_of(context, settings) as broker:
        with subscriber(context, broker, "-u", "me", "-P", "p@ss:word") as heard:
            place = f"127.0.0.1:{broker.port}/tagfield/hall/7"
            context.run_well("stream", context.shipped("conveyor"), "--speed", 0, "--mqtt",
                             f"mqtt://me:p%40ss%3Aword@{place}")
            until(heard, "reads come")
            check_equal(heard()[0][0], "tagfield/hall/7/reads/gate", "topic")
        refused = context.run("stream", context.shipped("conveyor"), "--speed", 0, "--mqtt",
                              f"mqtt://me:wrong@{place}")
        check_in("the broker refuses", refused.err, "warnings")
        check("wrong" not in refused.err, "the password is shown")


@case
def tls_asks_for_a_certificate_that_is_trusted(context):
    if shutil.which("openssl") is None:
        raise Skip("openssl is missing")
    own = [context.folder / "key.pem", context.folder / "own.pem"]
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                    "ec_paramgen_curve:P-256", "-nodes", "-days", "2", "-subj", "/CN=here",
                    "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", own[0], "-out", own[1]],
                   check=True, capture_output=True)
    settings = f"allow_anonymous true\nkeyfile {own[0]}\ncertfile {own[1]}\n"
    with broker_of(context, settings) as broker:
        with subscriber(context, broker, "--cafile", own[1]) as heard:
            words = [context.tagfield, "stream", context.shipped("conveyor"), "--speed", "0",
                     "--mqtt", f"mqtts://127.0.0.1:{broker.port}"]
            trusting = subprocess.run(words, env={**os.environ, "SSL_CERT_FILE": str(own[1])},
                                      capture_output=True, text=True, check=True)
            check_equal(trusting.stderr, "", "warnings")
            lines = trusting.stdout.splitlines()
            until(lambda: len(heard()) >= len(lines), "all is heard")
            wary = subprocess.run(words, capture_output=True, text=True, check=False)
            check_equal(wary.returncode, 2, "exit code without that certificate")
            check_in("the last", wary.stderr, "warnings without that certificate")
            check_equal(len(heard()), len(lines), "messages")


@case
def it_ends_soon_though_the_broker_is_away(context):
    program = stream(context, context.shipped("conveyor"), "--mqtt",
                     f"mqtt://127.0.0.1:{free_port()}")
    program.stdout.readline()
    begin = time.monotonic()
    program.send_signal(signal.SIGTERM)
    program.communicate(timeout=20)
    check_equal(program.returncode, 130, "exit code")
    check(time.monotonic() - begin < 3.0, f"it took {time.monotonic() - begin:.1f} s to end")


@case
def bad_input_is_said_in_a_line(context):
    scenario = context.shipped("conveyor")
    for words, part in (
            (("--mqtt", "http://broker"), "must be mqtt://[user:password@]host[:port][/prefix]"),
            (("--mqtt", "mqtt://no.such.host.invalid"), "the host 'no.such.host.invalid'"),
            (("--mqtt-buffer", "5"), "--mqtt")):
        result = context.run("stream", scenario, *words)
        check_equal((result.code, result.out), (2, ""), f"{words}")
        check_in(part, result.err, f"complaint of {words}")
        check_equal(result.err.count("\n"), 1, f"lines of complaint of {words}")


@case
def readers_have_topics_of_their_own(context):
    scenario, port = context.shipped("two_antennas"), free_port()
    names = ("--set", "antennas.mobile.reader=dock/1", "--set", "antennas.fixed.reader=dock_1")
    for verb in ("stream", "serve"):
        result = context.run(verb, scenario, "--mqtt", f"mqtt://127.0.0.1:{port}", *names)
        check_equal((result.code, result.out, result.err.count("\n")), (2, "", 1), f"{verb}: {result.err!r}")
        check_in("readers 'dock/1' and 'dock_1' would have the same topic, …/reads/dock_1", result.err, verb)
    context.run_well("stream", scenario, "--speed", "0", *names)  # Without MQTT there is nothing to refuse.


if __name__ == "__main__":
    main()
