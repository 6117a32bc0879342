#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""'tagfield serve --llrp' with LLRP clients: that of examples/07_llrp_client, llrpjs, and tshark, which
dissects all messages.

    llrp_test.py --tagfield PROGRAM --source SOURCE_DIR --build BUILD_DIR
"""

import json
import pathlib
import random
import shutil
import signal
import socket
import struct
import sys
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "command"))
sys.path.insert(0, str(HERE.parent.parent / "examples/07_llrp_client"))
from common import (Skip, case, check, check_between, check_equal, check_in,  # noqa: E402
                    check_near, main, run)
from llrp_client import Reader, parameter, parameters, ro_spec, tags_in  # noqa: E402
from npm import npm_packages  # noqa: E402
from served import served  # noqa: E402

PORTAL = "portal"
EPOCH_US = 1577836800 * 10**6  # 2020-01-01
ALL_EVENTS = b"".join(parameter(245, struct.pack("!HB", kind, 0x80)) for kind in range(9))


class Client(Reader):
    """A client that stores unsolicited messages, and all bytes in both directions."""

    def __init__(self, server, number=0):
        self.sent, self.received, self.unasked = [], [], []
        ports = [int(value.rsplit(" ", 1)[1]) for key, value in server.lines if key == "llrp"]
        super().__init__("127.0.0.1", ports[number])

    def send(self, kind, body=b""):
        super().send(kind, body)
        self.sent.append(struct.pack("!HII", 1 << 10 | kind, 10 + len(body), self.last_id) + body)

    def receive(self):
        kind, body = super().receive()
        self.received.append(struct.pack("!HII", 1 << 10 | kind, 10 + len(body), 0) + body)
        if kind in (61, 63):
            self.unasked.append((kind, body))
        return kind, body

    def wait_for(self, kind, seconds=20):
        """The next message of a type, or the next event of a type (given as a negative number)."""
        self.socket.settimeout(seconds)
        while True:
            got, body = self.receive()
            if kind < 0 and got == 63:
                events = events_in(body)
                if -kind in events:
                    return events[-kind]
            if got == kind:
                return body
            if got == 62:
                self.send(72)

    def status(self, kind, body=b""):
        """Status code of the response, successful or not."""
        self.send(kind, body)
        while True:
            got, content = self.receive()
            if got in (100, kind + 10):
                return struct.unpack_from("!H", content, 4)[0]

    def run_for(self, spec, seconds=60):
        """Adds and enables an ROSpec, and returns its reports after it has ended."""
        self.ask(20, spec)
        identifier = spec[4:8]
        self.ask(24, identifier)
        begin = len(self.unasked)
        while True:
            event = self.wait_for(-249, seconds)
            if event[0] == 1 and event[1:5] == identifier:
                break
        self.ask(21, identifier)
        return [tag for kind, body in self.unasked[begin:] if kind == 61 for tag in tags_in(body)]


def events_in(body):
    """{type: content} of the events in a READER_EVENT_NOTIFICATION."""
    (_, data), = parameters(body)
    return dict(parameters(data))


def spec_of(identifier=1, antennas=(0,), start=b"\0", duration_ms=0, ai_stop=b"\0" + bytes(4),
            setting=b"", trigger=1, every=1, selected=0x17C0, extra=b"", priority=0):
    """An ROSpec as clients encode it."""
    boundary = parameter(178, parameter(179, start) + parameter(
        182, struct.pack("!BI", 1 if duration_ms else 0, duration_ms)))
    ai = parameter(183, struct.pack(f"!H{len(antennas)}H", len(antennas), *antennas) +
                   parameter(184, ai_stop) +
                   parameter(186, struct.pack("!HB", 9, 1) + setting))
    report = parameter(237, struct.pack("!BH", trigger, every) +
                       parameter(238, struct.pack("!H", selected)) + extra)
    return parameter(177, struct.pack("!IBB", identifier, priority, 0) + boundary + ai + report)


def transmit(power, antenna=0, channel=0):
    return parameter(222, struct.pack("!H", antenna) +
                     parameter(224, struct.pack("!HHH", 1, channel, power)))


IMMEDIATE = b"\1"


def started(context, *arguments, scenario=PORTAL):
    path = context.shipped(scenario) if isinstance(scenario, str) else scenario
    return served(context, path, "--llrp", "0", *arguments)


def connected(server, number=0):
    client = Client(server, number)
    client.ask(3, b"\x80" + parameter(244, ALL_EVENTS))
    return client


@case
def reports_are_the_worlds_reads(context):
    with started(context, "--speed", "5") as server:
        lines = []
        stream = server.connection()
        stream.request("GET", "/api/reads")
        response = stream.getresponse()

        def follow():
            try:
                while line := response.readline():
                    lines.append(json.loads(line))
            except OSError:
                pass
        following = threading.Thread(target=follow)
        following.start()
        tags = connected(server).run_for(ro_spec(1, 4000))
        time.sleep(0.5)
        server.process.send_signal(signal.SIGTERM)
        check_equal(server.process.wait(timeout=20), 0, "exit code")
        following.join()
        stream.close()
        check_between(len(tags), 400, 4000, "number of reports")
        check_equal(len(tags), len(lines), "reports and reads")
        for tag, line in zip(tags, lines):
            check_equal(tag["epc"], line["epc"].encode().hex().upper().ljust(24, "0"), "EPC")
            check_equal(tag["antenna"], line["antennaPort"], "antenna")
            check_equal(tag["rssi_cdbm"], line["peakRssiCdbm"], "RSSI")
            check_equal(tag["phase"], round((-line["phaseAngle"]) % 360 / 360 * 4096) % 4096, "phase")
            check_near(tag["doppler"] / 16, line["dopplerHz"], 1e-4, "Doppler")
            check_equal(tag["seen"], 1, "times seen")
            stamp = tag["first_us"] - EPOCH_US
            check_in(f"{stamp / 1e6:09.6f}", line["timestamp"], "time")


@case
def only_what_is_selected_is_reported(context):
    names = ["ro_spec", "spec_index", "inventory_spec", "antenna", "channel", "rssi_dbm", "first_us",
             "last_us", "seen"]
    with started(context, "--speed", "max") as server:
        client = connected(server)
        for bit, name in enumerate(names):
            tags = client.run_for(spec_of(start=IMMEDIATE, duration_ms=300,
                                          selected=0x8000 >> bit))
            check(tags and all(set(tag) == {"epc", name} for tag in tags), f"{name}: {tags[:2]}")
        tags = client.run_for(spec_of(start=IMMEDIATE, duration_ms=300, selected=0))
        check(tags and all(set(tag) == {"epc"} for tag in tags), f"nothing: {tags[:2]}")


@case
def power_and_antennas_are_as_asked(context):
    with started(context, "--speed", "max") as server:
        client = connected(server)
        power = {}
        regulation = dict(parameters(client.ask(1, b"\3")))[143]
        for entry, value in parameters(dict(parameters(regulation[4:]))[144]):
            if entry == 145:
                index, dbm = struct.unpack("!Hh", value)
                power[dbm / 100] = index
        check_equal(sorted(power)[-1], 30, "greatest power [dBm]")
        mean = {}
        for dbm in (30.0, 24.0):
            tags = client.run_for(spec_of(antennas=(2,), start=IMMEDIATE, duration_ms=2000,
                                          setting=transmit(power[dbm]), selected=0x1400,
                                          extra=fine_rssi()))
            check_equal({tag["antenna"] for tag in tags}, {2}, "antennas")
            near = [tag["rssi_cdbm"] for tag in tags if tag["epc"].startswith("7461675F3034")]
            mean[dbm] = sum(near) / len(near) / 100
        check_near(mean[30.0] - mean[24.0], 6.0, 0.6, "RSSI lost by 6 dB less power")


@case
def antennas_keep_their_ports_when_one_is_taken_away(context):
    with started(context, "--speed", "max") as server:
        client = connected(server)
        names = {entry["name"]: entry["port"] for entry in server.get("/api/antennas")["antennas"]}
        check_equal(names, {f"port_{i}": i for i in (1, 2, 3, 4)}, "ports")
        status, _ = server.ask("DELETE", "/api/antennas/port_2")
        check_equal(status, 200, "status")
        names = {entry["name"]: entry["port"] for entry in server.get("/api/antennas")["antennas"]}
        check_equal(names, {f"port_{i}": i for i in (1, 3, 4)}, "ports")
        check_equal(client.wait_for(-255), struct.pack("!BH", 0, 2), "the event of antenna 2")
        tags = client.run_for(spec_of(start=IMMEDIATE, duration_ms=4000))
        check_equal({tag["antenna"] for tag in tags}, {1, 3, 4}, "antennas that report")
        tags = client.run_for(spec_of(antennas=(2, 3), start=IMMEDIATE, duration_ms=2000))
        check_equal({tag["antenna"] for tag in tags}, {3}, "antennas that report, of 2 and 3")
        properties = dict(parameters(client.ask(2, struct.pack("!HBHH", 2, 2, 0, 0))))[221]
        check_equal(properties[0] >> 7, 0, "whether port 2 is connected")


def fine_rssi():
    content = struct.pack("!II", 25882, 50) + parameter(1023, struct.pack("!IIH", 25882, 53, 1))
    return parameter(1023, content)


@case
def a_session_silences_tags_that_were_read(context):
    """With session S2 and target A, a powered tag is read once and then stays silent; with S0 and dual
    target it is read repeatedly."""
    counts = {}
    with started(context, "--speed", "max") as server:
        client = connected(server)
        for session in (2, 0):
            target = parameter(1023, struct.pack("!IIH", 25882, 23, 1 if session else 2))
            command = parameter(330, b"\0" + parameter(336, struct.pack("!BHI", session << 6, 16, 0)) +
                                target)
            setting = parameter(222, struct.pack("!H", 0) + command)
            counts[session] = len(client.run_for(spec_of(antennas=(1,), start=IMMEDIATE,
                                                         duration_ms=3000, setting=setting)))
    check_between(counts[2], 10, 16, "reads in S2")
    check(counts[0] > 20 * counts[2], f"reads in S0 and S2: {counts}")


@case
def triggers_start_and_stop(context):
    with started(context, "--speed", "20") as server:
        client = connected(server)
        # Started and stopped by a client.
        client.ask(20, spec_of(1))
        client.ask(24, struct.pack("!I", 1))
        check_equal(client.status(23, struct.pack("!I", 1)), 101, "status of stopping what is inactive")
        client.ask(22, struct.pack("!I", 1))
        check_equal(client.wait_for(-249)[0], 0, "event of the start")
        client.wait_for(61)
        client.ask(23, struct.pack("!I", 1))
        check_equal(client.wait_for(-249)[0], 1, "event of the end")
        client.ask(21, struct.pack("!I", 0))
        # Started periodically.
        client.ask(20, spec_of(2, start=b"\2" + parameter(180, struct.pack("!II", 500, 2000)),
                               duration_ms=500))
        client.ask(24, struct.pack("!I", 2))
        starts = []
        while len(starts) < 3:
            body = client.wait_for(63)
            events = events_in(body)
            if events.get(249, b"\1")[0] == 0:
                starts.append(struct.unpack("!Q", events[128])[0])
        for a, b in zip(starts, starts[1:]):
            check_near((b - a) / 1e6, 2.0, 0.011, "time between periodic starts [s]")
        client.ask(21, struct.pack("!I", 0))
        # Until three tags are seen.
        tags = client.run_for(spec_of(3, start=IMMEDIATE, trigger=2, every=0, ai_stop=b"\3" + bytes(4) +
                                      parameter(185, struct.pack("!BBHHHI", 0, 0, 3, 0, 0, 60000))))
        check_equal(len({tag["epc"] for tag in tags}), 3, "tags until three are seen")
        check_equal(len(tags), len({(tag["epc"], tag["antenna"]) for tag in tags}), "reports")
        # Until no new tag is seen for half a second.
        tags = client.run_for(spec_of(4, start=IMMEDIATE, trigger=2, every=0, antennas=(1,),
                                      ai_stop=b"\3" + bytes(4) +
                                      parameter(185, struct.pack("!BBHHHI", 1, 0, 0, 0, 500, 60000))))
        check_between(len(tags), 10, 16, "tags until no new one comes")
        check(max(tag["seen"] for tag in tags) > 5, "reads do not add up")


@case
def reports_wait_until_asked_for(context):
    with started(context, "--speed", "20") as server:
        client = connected(server)
        client.ask(20, spec_of(1, start=IMMEDIATE, trigger=0))
        client.ask(24, struct.pack("!I", 1))
        time.sleep(0.5)
        client.ask(2, struct.pack("!HBHH", 0, 0, 0, 0))
        check(all(kind != 61 for kind, _ in client.unasked), "a report came unasked")
        client.send(60)
        tags = list(tags_in(client.wait_for(61)))
        check_between(len({tag["epc"] for tag in tags}), 10, 16, "tags")


@case
def the_higher_rank_goes_first(context):
    with started(context, "--speed", "20") as server:
        client = connected(server)
        client.ask(20, spec_of(1, start=IMMEDIATE, priority=3))
        client.ask(20, spec_of(2, start=IMMEDIATE, priority=1, duration_ms=500))
        client.ask(24, struct.pack("!I", 1))
        client.ask(24, struct.pack("!I", 2))
        while client.wait_for(-249)[:5] != b"\1\0\0\0\2":
            pass
        events = [events_in(body).get(249) for kind, body in client.unasked if kind == 63]
        seen = [(event[0], struct.unpack_from("!I", event, 1)[0]) for event in events if event]
        check_equal(seen, [(0, 1), (2, 1), (0, 2), (1, 2)], "starts, preemption and ends")


def access_spec(identifier, operations, epc, count=1):
    """An AccessSpec for the tag with this EPC, whose bits begin after CRC and PC."""
    data = bytes.fromhex(epc)
    target = parameter(339, struct.pack("!BHH", 1 << 6 | 0x20, 32, 8 * len(data)) +
                       b"\xff" * len(data) + struct.pack("!H", 8 * len(data)) + data)
    return parameter(207, struct.pack("!IHBBI", identifier, 0, 1, 0, 0) +
                     parameter(208, struct.pack("!BH", 1, count)) +
                     parameter(209, parameter(338, target) + b"".join(operations)))


def words(*values):
    return struct.pack(f"!H{len(values)}H", len(values), *values)


def read_op(bank, pointer, count, password=0, number=1):
    return parameter(341, struct.pack("!HIBHH", number, password, bank << 6, pointer, count))


def write_op(bank, pointer, values, password=0, number=2):
    return parameter(342, struct.pack("!HIBH", number, password, bank << 6, pointer) + words(*values))


@case
def tags_are_read_written_locked_and_killed(context):
    with started(context, "--speed", "20") as server:
        client = connected(server)
        client.ask(20, spec_of(1, start=IMMEDIATE, selected=0))
        client.ask(24, struct.pack("!I", 1))
        identifier = 0

        def operate(epc, *operations):
            """EPC of the tag, and the results of these operations on it as (type, content)."""
            nonlocal identifier
            identifier += 1
            client.ask(40, access_spec(identifier, operations, epc))
            client.ask(42, struct.pack("!I", identifier))
            while True:
                for tag in tags_in(client.wait_for(61)):
                    if "results" in tag:
                        return tag["epc"], tag["results"]

        first = b"tag_01".hex().upper().ljust(24, "0")
        _, results = operate(first, read_op(2, 0, 2), read_op(3, 0, 1), read_op(3, 9999, 1))
        check_equal([(kind, value[0]) for kind, value in results], [(349, 0), (349, 0), (349, 1)],
                    "results of reading")
        check_equal(results[0][1][5:7], b"\xe2\x00", "class of the TID")
        # After writing, the new EPC is reported.
        new = "30395DFA832E5B0000000001"
        operate(first, write_op(1, 2, [int(new[i:i + 4], 16) for i in range(0, 24, 4)]))
        _, results = operate(new, read_op(1, 2, 6))
        check_equal(results[0][1][5:].hex().upper(), new, "EPC after writing")
        # A length that the EPC memory does not hold is refused.
        epc, results = operate(new, write_op(1, 1, [0x4800]), read_op(1, 1, 1))
        check_equal([value[0] for _, value in results], [1, 0], "results of writing too long a length")
        check_equal((epc, results[1][1][5:]), (new, b"\x30\0"), "EPC and PC")
        # Passwords and locks.
        operate(new, write_op(0, 0, [0, 7, 0xDEAD, 0xBEEF]))
        lock = parameter(344, struct.pack("!HI", 3, 0xDEADBEEF) + parameter(345, b"\0\4"))
        _, results = operate(new, lock, write_op(3, 0, [1]), write_op(3, 0, [2], 0xDEADBEEF),
                             write_op(3, 0, [2], 1), read_op(3, 0, 1))
        check_equal([value[0] for _, value in results], [0, 2, 0, 5, 0], "results after a lock")
        check_equal(results[-1][1][5:], b"\0\2", "the word")
        # Killed only with its password.
        for password, expected in ((8, 4), (7, 0)):
            _, results = operate(new, parameter(343, struct.pack("!HI", 4, password)))
            check_equal(results[0][1][0], expected, f"result of killing with {password}")
        server.wait_for(lambda status: status["tags"] == 15, "the tag is out of the world")
        client.send(44)
        check_equal(len(list(parameters(client.wait_for(54)))), 1, "AccessSpecs that are left")


@case
def a_client_keeps_to_itself(context):
    with started(context, "--speed", "20") as server:
        first = connected(server)
        first.ask(20, spec_of(1, start=IMMEDIATE, duration_ms=1000, selected=0))
        # A second client is rejected, as there is one already.
        address = ("127.0.0.1", first.socket.getpeername()[1])
        with socket.create_connection(address, timeout=10) as other:
            answer = other.recv(1000)
            check_equal(answer[-2:], b"\0\2", "status of the second's attempt")
            check_equal(other.recv(1), b"", "what comes after")
        # Reports are held while no client is connected, if configured so.
        first.ask(3, b"\0" + parameter(226, b"\x80"))
        first.ask(24, struct.pack("!I", 1))
        first.socket.close()
        time.sleep(0.5)
        again = Client(server)
        again.send(26)
        again.wait_for(36)
        check_equal([kind for kind, _ in again.unasked], [63], "messages before it asks")
        again.send(64)
        check_between(len(list(tags_in(again.wait_for(61)))), 50, 2000, "reports that waited")
        again.ask(14)
        check_equal(again.socket.recv(1), b"", "what comes after CLOSE_CONNECTION")


@case
def keepalives_and_antennas_are_reported(context):
    with started(context, "--speed", "10") as server:
        client = connected(server)
        client.ask(3, b"\0" + parameter(220, struct.pack("!BI", 1, 200)))
        begin = time.monotonic()
        for _ in range(5):
            client.wait_for(62)
        check_between(time.monotonic() - begin, 0.05, 2, "five keepalives [s]")
        server.post("/api/antennas/port_3/disconnect")
        check_equal(client.wait_for(-255), b"\0\0\3", "event of a cable that comes off")
        server.post("/api/antennas/port_3/connect")
        check_equal(client.wait_for(-255), b"\1\0\3", "event of a cable that is on again")


@case
def what_is_wrong_gets_its_status(context):
    with started(context, "--speed", "20") as server:
        client = connected(server)
        good = spec_of(1)
        for what, kind, body, expected in (
                ("an unknown message", 77, b"", 109),
                ("no ROSpec", 20, b"", 103),
                ("an ID of 0", 20, spec_of(0), 101),
                ("an antenna that is not there", 20, spec_of(1, antennas=(5,)), 101),
                ("a power that is not there", 20, spec_of(1, setting=transmit(500)), 101),
                ("a start by an input", 20, spec_of(1, start=b"\3"), 111),
                ("a stop after N attempts", 20, spec_of(1, ai_stop=b"\3" + bytes(4) + parameter(
                    185, struct.pack("!BBHHHI", 2, 0, 0, 3, 0, 1000))), 111),
                ("a configured power of 0", 3, b"\0" + transmit(0), 101),
                ("a configured antenna that is not there", 3, b"\0" + transmit(1, antenna=9), 101),
                ("a keepalive of an unknown kind", 3,
                 b"\0" + parameter(220, struct.pack("!BI", 5, 100)), 101),
                ("too many OpSpecs", 40, access_spec(
                    1, [read_op(2, 0, 1, number=i) for i in range(17)], "ABCD"), 105),
                ("GET_ROSPECS with a body", 26, b"\1\2\3", 100),
                ("half a ROSpec", 20, good[:2] + struct.pack("!H", len(good) - 9) + good[4:-9], 100),
                ("another parameter", 20, parameter(207, good[4:]), 103),
                ("a ROSpec that is not there", 24, struct.pack("!I", 4), 101),
                ("an AccessSpec that is not there", 42, struct.pack("!I", 4), 101),
                ("too short a message", 21, b"\0", 100)):
            check_equal(client.status(kind, body), expected, f"status of {what}")
        client.ask(20, good)
        check_equal(client.status(20, good), 101, "status of the same ROSpec twice")
        client.ask(20, spec_of(2))
        client.ask(24, bytes(4))
        client.ask(22, struct.pack("!I", 1))
        check_equal(client.status(22, struct.pack("!I", 2)), 101, "status of a start of the same priority")
        client.ask(21, bytes(4))
        # Another version, and data that is not LLRP: an error, then the connection is closed.
        for data, expected in ((struct.pack("!HII", 2 << 10 | 1, 11, 1) + b"\0", 110),
                               (b"GET / HTTP/1.1\r\n\r\n", 300)):
            other = Client(server) if client is None else client
            other.socket.sendall(data)
            kind, content = other.receive()
            while kind != 100:
                kind, content = other.receive()
            check_equal(struct.unpack_from("!H", content, 4)[0], expected, f"status of {data[:10]!r}")
            check_equal(other.socket.recv(1), b"", "what comes after")
            time.sleep(0.2)
            client = None


@case
def garbage_harms_nobody(context):
    with started(context, "--speed", "5") as server:
        client = connected(server)
        rng = random.Random(2)
        seeds = [(20, spec_of(1, setting=transmit(20))), (3, b"\0" + parameter(244, ALL_EVENTS)),
                 (40, access_spec(1, [read_op(1, 0, 2), write_op(3, 0, [1])], "ABCD")),
                 (24, struct.pack("!I", 1)), (26, b""), (1, b"\0"), (21, struct.pack("!I", 0))]
        memory = server.memory_mb()
        for _ in range(4000):
            kind, body = rng.choice(seeds)
            data = bytearray(body)
            for _ in range(rng.randrange(6)):
                if data:
                    data[rng.randrange(len(data))] = rng.randrange(256)
            client.send(kind, bytes(data))
            while client.receive()[0] in (61, 62, 63):
                pass
        client.ask(21, struct.pack("!I", 0))
        check_between(server.memory_mb(), 0, memory + 60, "memory [MB]")
        client.socket.close()
        port = client_port(server)
        for _ in range(300):
            with socket.create_connection(("127.0.0.1", port), timeout=5) as other:
                try:
                    other.sendall(rng.randbytes(rng.randrange(1, 200)))
                except OSError:
                    pass
        time.sleep(0.3)
        connected(server).ask(1, b"\0")


def client_port(server):
    return next(int(value.rsplit(" ", 1)[1]) for key, value in server.lines if key == "llrp")


@case
def llrpjs_understands_all_of_it(context):
    packages = npm_packages(context.build, HERE, "live")
    with started(context) as server:
        result = run(["node", HERE / "llrp_client.mjs", packages, client_port(server)], timeout=60)
        if not check(result.code == 0, f"llrpjs: {result.err.strip()[-400:]}"):
            return
        found = json.loads(result.out)
    for name, answer in found["answers"].items():
        check_equal(answer["data"]["LLRPStatus"]["StatusCode"], "M_Success", f"status of {name}")
    device = found["answers"]["GET_READER_CAPABILITIES"]["data"]["GeneralDeviceCapabilities"]
    check_equal(device["MaxNumberOfAntennaSupported"], 4, "antennas")
    config = found["answers"]["GET_READER_CONFIG"]["data"]
    check_equal(config["KeepaliveSpec"]["PeriodicTriggerValue"], 50, "keepalive")
    check_equal(found["answers"]["GET_ROSPECS"]["data"]["ROSpec"]["CurrentState"], "Active", "state")
    check_equal({report["AntennaID"]["AntennaID"] for report in found["reports"]}, {1, 3}, "antennas")
    check_equal({report["InventoryParameterSpecID"]["InventoryParameterSpecID"]
                 for report in found["reports"]}, {1234}, "inventory specs")
    kinds = [event["ROSpecEvent"]["EventType"] for event in found["events"] if "ROSpecEvent" in event]
    check_equal(kinds, ["Start_Of_ROSpec", "End_Of_ROSpec"], "events")


def write_pcap(path, messages):
    """Writes (is from the reader, bytes) as packets of a TCP connection in raw IPv4."""
    with open(path, "wb") as file:
        file.write(struct.pack("!IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 101))
        place = {True: 1, False: 1}
        for number, (is_reader, data) in enumerate(messages):
            ports = (5084, 40000) if is_reader else (40000, 5084)
            tcp = struct.pack("!HHIIBBHHH", *ports, place[is_reader], place[not is_reader], 0x50, 0x18,
                              65535, 0, 0)
            packet = struct.pack("!BBHHHBBH4s4s", 0x45, 0, 40 + len(data), number & 0xFFFF, 0, 64, 6, 0,
                                 bytes([127, 0, 0, 1]), bytes([127, 0, 0, 1])) + tcp + data
            place[is_reader] += len(data)
            file.write(struct.pack("!IIII", number, 0, len(packet), len(packet)) + packet)


@case
def tshark_finds_nothing_malformed(context):
    if shutil.which("tshark") is None:
        raise Skip("tshark is missing (scripts/setup --tests installs it)")
    with started(context, "--speed", "20") as server:
        client = connected(server)
        client.ask(1023, struct.pack("!IB", 25882, 21) + bytes(4))
        client.ask(1, b"\0")
        client.ask(2, struct.pack("!HBHH", 0, 0, 0, 0))
        client.run_for(spec_of(1, start=IMMEDIATE, duration_ms=500, selected=0xFFC0,
                               extra=fine_rssi()))
        client.ask(20, spec_of(2, start=IMMEDIATE, selected=0))
        client.ask(24, struct.pack("!I", 2))
        client.ask(40, access_spec(1, [read_op(2, 0, 2), write_op(3, 0, [1]),
                                       parameter(343, struct.pack("!HI", 4, 7)),
                                       parameter(344, struct.pack("!HI", 3, 0) +
                                                 parameter(345, b"\0\4"))],
                                   b"tag_01".hex().ljust(24, "0")))
        client.ask(42, struct.pack("!I", 0))
        client.send(26)
        client.wait_for(36)
        client.send(44)
        client.wait_for(54)
        while not any(kind == 61 and "results" in tag for kind, body in client.unasked
                      for tag in tags_in(body)):
            client.wait_for(61)
        check_equal(client.status(77), 109, "status of an unknown message")
        client.ask(14)
    path = context.folder / "llrp.pcap"
    write_pcap(path, [(True, data) for data in client.received if len(data) < 60000])
    result = run(["tshark", "-r", path, "-d", "tcp.port==5084,llrp", "-T", "fields", "-e", "llrp.type",
                  "-e", "_ws.expert.message", "-e", "_ws.malformed", "-e", "llrp.length"], timeout=120)
    lines = [line.split("\t") for line in result.out.splitlines()]
    check_equal(len(lines), len(client.received), "packets that tshark lists")
    check(all(line[0] for line in lines), "packets that tshark does not take for LLRP")
    # tshark itself has a fault: for Identification it misses the two bytes of the ID's length.
    own_fault = "Incorrect length of parameter: 17 bytes decoded, but 19 bytes claimed."
    odd = [line for line in lines if len(line) > 2 and line[2] and line[1] != own_fault]
    check_equal(odd, [], "packets that tshark finds malformed")
    kinds = {int(line[0]) for line in lines}
    check(kinds >= {11, 12, 13, 30, 34, 36, 50, 52, 54, 61, 63, 100, 4}, f"types seen: {kinds}")


@case
def each_reader_has_a_port_of_its_own(context):
    with started(context, "--speed", "20", scenario="two_antennas") as server:
        readers = [value for key, value in server.lines if key == "llrp"]
        check(len(readers) >= 1, f"readers: {readers}")
        clients = [connected(server, number) for number in range(len(readers))]
        for client in clients:
            client.ask(1, b"\0")


@case
def a_report_is_whole_though_others_read(context):
    """All reads of a ROSpec are in its report, before the event of its end, while another reader reads."""
    scenario = context.folder / "two_readers.yaml"
    antenna = ("  - {{name: a{0}, reader: r{0}, pose: [0, {0}, 1], profiles: [speedway_r420, panel_6dbi], "
               "channel_plan: etsi_low, inventory: gen2}}\n")
    scenario.write_text("duration_s: 100\nmodel: link_budget\nantennas:\n" + antenna.format(1) +
                        antenna.format(2) + "tags:\n"
                        "  - {id: E20000000000000000000001, position: [1.5, 1, 1]}\n"
                        "  - {id: E20000000000000000000002, position: [1.5, 2, 1]}\n")
    with started(context, "--speed", "5", scenario=scenario) as server:
        other = connected(server, 1)
        other.ask(20, spec_of(1, start=IMMEDIATE, trigger=0))
        other.ask(24, struct.pack("!I", 1))
        client = connected(server)
        for _ in range(5):
            client.unasked.clear()
            seen = sum(tag["seen"] for tag in client.run_for(
                spec_of(1, start=IMMEDIATE, duration_ms=100, trigger=2, every=0, selected=0xFFC0)))
            check(seen > 0, "it read nothing")
            time.sleep(0.1)
            client.ask(2, struct.pack("!HBHH", 0, 0, 0, 0))
            check_equal([kind for kind, _ in client.unasked].count(61), 1, "reports")


@case
def a_client_that_takes_nothing_is_disconnected(context):
    """Responses aren't dropped as reports are, so a client that asks but never reads would fill the memory."""
    with started(context) as server:
        client = connected(server)
        memory = server.memory_mb()
        request = struct.pack("!HIIB", 1 << 10 | 1, 11, 1, 0)
        client.socket.settimeout(20)
        try:
            client.socket.sendall(20000 * request)
            end = time.monotonic() + 20
            while check(time.monotonic() < end, "it was not disconnected"):
                client.socket.sendall(request)
                time.sleep(0.01)
        except ConnectionError:
            pass
        check_between(server.memory_mb(), 0, memory + 60, "memory [MB]")
        connected(server).ask(1, b"\0")


@case
def the_papers_model_is_warned_of(context):
    with started(context, "--speed", "20", scenario="paper_warehouse") as server:
        client = connected(server)
        command = parameter(330, b"\0" + parameter(336, struct.pack("!BHI", 2 << 6, 16, 0)))
        client.ask(20, spec_of(1, setting=parameter(222, struct.pack("!H", 0) + command)))
        server.process.send_signal(signal.SIGTERM)
        server.process.wait(timeout=20)
        check_in("has the paper's model: power, carriers, session and Q have no effect",
                 server.process.stderr.read().decode(), "warnings")


@case
def it_ends_within_a_second(context):
    with started(context) as server:
        client = connected(server)
        client.ask(20, spec_of(1, start=IMMEDIATE))
        client.ask(24, struct.pack("!I", 1))
        begin = time.monotonic()
        server.process.send_signal(signal.SIGTERM)
        check_equal(server.process.wait(timeout=20), 0, "exit code")
        check_between(time.monotonic() - begin, 0, 1, "time to end [s]")


@case
def tags_of_the_same_epc_are_refused(context):
    """The tag of the ID "tag_01" has the EPC of its bytes, which is also the hexadecimal ID of another."""
    twin = {"id": b"tag_01".ljust(12, b"\0").hex().upper(), "position": [1, 1, 1]}
    with served(context, context.shipped(PORTAL), "--llrp", "0") as server:
        status, answer = server.ask("POST", "/api/tags", twin)
        check_equal((status, list(answer)), (400, ["error"]), "the answer to a tag with the EPC of tag_01")
        check_in(f"tags 'tag_01' and '{twin['id']}' would have the same EPC, {twin['id']}", answer["error"], "message")
        check(twin["id"] not in {tag["id"] for tag in server.get("/api/tags")["tags"]}, "the tag was added")
        server.post("/api/tags", {"id": "E2801160", "position": [1, 1, 1]})
    with served(context, context.shipped(PORTAL)) as server:
        server.post("/api/tags", twin)  # Without LLRP nobody takes one for the other.


if __name__ == "__main__":
    main()
