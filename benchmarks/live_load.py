#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Cost of a live world under load, with readers at their maximum rate and many clients.

    benchmarks/live_load.py [--tags 10000] [--readers 4] [--seconds 20] [--watchers 100]

Starts mosquitto and 'tagfield serve' in real time, one LLRP client per reader that selects the fastest
mode (FM0, 640 kHz) and a report per tag read, one WebSocket client and one MQTT subscriber. Prints the
reads per second that each client receives, the speed relative to real time, the server's CPU load in
cores, and its memory. --watchers adds WebSocket clients, every other one of which never reads its
socket. Needs mosquitto, mosquitto-clients and python3-websocket.
"""

import argparse
import json
import os
import pathlib
import select
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

import websocket

SOURCE = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(SOURCE / "examples/07_llrp_client"), str(SOURCE / "tests/live"),
                str(SOURCE / "tests/command")]
from llrp_client import Reader, parameter  # noqa: E402


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


def write_scenario(path, tags, readers):
    """Readers 100 m apart, each facing a wall of tags at a distance of 3 m."""
    lines = ["name: load", "model: link_budget", "duration_s: 1",
             f"tag_profile: {SOURCE}/profiles/tags/monza_r6.yaml", "antennas:"]
    for i in range(readers):
        lines.append(
            f"  - {{name: port_{i}, reader: reader_{i}, pose: [0, {100 * i}, 1.5, 0, 0, 0], rate_hz: 20, "
            f"profiles: [{SOURCE}/profiles/readers/speedway_r420.yaml, "
            f"{SOURCE}/profiles/antennas/panel_6dbi.yaml], channel_plan: fcc}}")
    lines.append("tags:")
    for i in range(tags):
        reader, place = i % readers, i // readers
        y, z = place % 50, place // 50
        lines.append(f"  - {{id: 3034{i:020d}, position: [3, {100 * reader - 1.25 + 0.05 * y:.2f}, "
                     f"{0.3 + 0.05 * z:.2f}]}}")
    path.write_text("\n".join(lines) + "\n")


def ro_spec():
    command = parameter(330, b"\0" + parameter(335, struct.pack("!HH", 0, 0)) +
                        parameter(336, struct.pack("!BHI", 0, 2500, 0)) +
                        parameter(1023, struct.pack("!IIH", 25882, 23, 2)))
    vendor = b"".join(parameter(1023, struct.pack("!IIH", 25882, kind, 1)) for kind in (52, 53, 67))
    return parameter(177, struct.pack("!IBB", 1, 0, 0) +
                     parameter(178, parameter(179, b"\1") + parameter(182, b"\0" + bytes(4))) +
                     parameter(183, struct.pack("!HH", 1, 0) + parameter(184, b"\0" + bytes(4)) +
                               parameter(186, struct.pack("!HB", 1, 1) +
                                         parameter(222, struct.pack("!H", 0) + command))) +
                     parameter(237, struct.pack("!BH", 1, 1) +
                               parameter(238, struct.pack("!H", 0x1780)) +
                               parameter(1023, struct.pack("!II", 25882, 50) + vendor)))


class Counter(threading.Thread):
    """Counts the reads that a client receives, until the server ends."""

    def __init__(self, follow):
        super().__init__(daemon=True)
        self.count = 0
        self.follow = follow
        self.start()

    def run(self):
        try:
            for number in self.follow():
                self.count += number
        except (OSError, ValueError, EOFError, websocket.WebSocketException):
            pass  # The server has ended.


def llrp_reads(port):
    reader = Reader("127.0.0.1", port, 60)
    reader.ask(20, ro_spec())
    reader.ask(24, struct.pack("!I", 1))
    while True:
        kind, body = reader.receive()
        if kind == 61:
            yield body.count(b"\x8d\x30\x34")  # header of an EPC-96 parameter, and the common prefix of these EPCs


def frames_of(port):
    return websocket.create_connection(f"ws://127.0.0.1:{port}/api/live", timeout=60)


def frame_reads(port):
    client = frames_of(port)
    while True:
        frame = json.loads(client.recv())
        yield sum(read[6] for read in frame.get("reads", []))


def watch(clients):
    """Receives and discards the data of every other client."""
    while readable := select.select([client.sock for client in clients[::2]], [], [], 5)[0]:
        for one in readable:
            if not one.recv(1 << 20):
                return


def mqtt_reads(subscriber):
    while subscriber.stdout.readline():
        yield 1


def processor_seconds(process):
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory_mb(process):
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    return 0.0


def status(port):
    import http.client
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
    connection.request("GET", "/api/status")
    answer = json.loads(connection.getresponse().read())
    connection.close()
    return answer


def measure(asked, folder):
    scenario = folder / "load.yaml"
    write_scenario(scenario, asked.tags, asked.readers)
    broker_port = free_port()
    broker = subprocess.Popen(["/usr/sbin/mosquitto", "-p", str(broker_port)],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(0.5)
    subscriber = subprocess.Popen(["mosquitto_sub", "-h", "127.0.0.1", "-p", str(broker_port), "-q", "1",
                                   "-t", "tagfield/#"], stdout=subprocess.PIPE)
    server = subprocess.Popen(
        [asked.tagfield, "serve", scenario, "--http", "0", "--llrp", "0", "--mqtt",
         f"mqtt://127.0.0.1:{broker_port}/tagfield"], stdout=subprocess.PIPE)
    try:
        llrp_ports, http_port = [], None
        while http_port is None:
            line = server.stdout.readline().decode()
            if line.startswith("llrp:"):
                llrp_ports.append(int(line.rsplit(" ", 1)[1]))
            if line.startswith("http:"):
                http_port = int(line.rsplit(":", 1)[1])
        clients = {f"llrp {i + 1}": Counter(lambda port=port: llrp_reads(port))
                   for i, port in enumerate(llrp_ports)}
        clients["websocket"] = Counter(lambda: frame_reads(http_port))
        clients["mqtt"] = Counter(lambda: mqtt_reads(subscriber))
        watchers = [frames_of(http_port) for _ in range(asked.watchers)]
        if watchers:
            threading.Thread(target=watch, args=(watchers,), daemon=True).start()
        time.sleep(5)
        begin, used, at = time.monotonic(), processor_seconds(server), status(http_port)["time"]
        counts = {name: client.count for name, client in clients.items()}
        time.sleep(asked.seconds)
        passed = time.monotonic() - begin
        rates = {name: (client.count - counts[name]) / passed for name, client in clients.items()}
        pace = (status(http_port)["time"] - at) / passed
        share = (processor_seconds(server) - used) / passed
        return rates, pace, share, memory_mb(server)
    finally:
        server.terminate()
        server.wait()
        subscriber.terminate()
        subscriber.wait()
        broker.terminate()
        broker.wait()


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--tagfield", default=SOURCE / "build/release/bin/tagfield")
    arguments.add_argument("--tags", type=int, default=10_000)
    arguments.add_argument("--readers", type=int, default=4)
    arguments.add_argument("--watchers", type=int, default=0)
    arguments.add_argument("--seconds", type=float, default=20)
    asked = arguments.parse_args()
    with tempfile.TemporaryDirectory(prefix="tagfield-") as folder:
        rates, pace, share, memory = measure(asked, pathlib.Path(folder))
    for name, rate in rates.items():
        print(f"{name:<10} {rate:8.0f} reads/s")
    print(f"pace       {pace:8.3f} of real time")
    print(f"server     {share:8.2f} of a core, {memory:.0f} MB")


if __name__ == "__main__":
    main()
