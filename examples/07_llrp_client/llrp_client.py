#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""An LLRP client in 150 lines, using only Python's standard library.

    tagfield serve scenarios/portal.yaml --llrp 5084 &
    examples/07_llrp_client/llrp_client.py --port 5084 --seconds 3

Connects to a reader, starts an inventory with all antennas, and prints EPC, antenna, RSSI and phase
of each tag report. The client also works with real readers that support the vendor extension for phase.
"""

import argparse
import socket
import struct

IMPINJ = 25882


def parameter(kind, content):
    """A TLV parameter: a header with type and length, then the content."""
    return struct.pack("!HH", kind, 4 + len(content)) + content


def custom(subtype, content):
    return parameter(1023, struct.pack("!II", IMPINJ, subtype) + content)


class Reader:
    """A connection to a reader."""

    def __init__(self, host, port, timeout=20):
        self.socket = socket.create_connection((host, port), timeout=timeout)
        self.last_id = 0
        self.receive()  # READER_EVENT_NOTIFICATION: connected

    def send(self, kind, body=b""):
        self.last_id += 1
        self.socket.sendall(struct.pack("!HII", 1 << 10 | kind, 10 + len(body), self.last_id) + body)

    def receive(self):
        """(type, body) of the next message."""
        kind, length, _ = struct.unpack("!HII", self.read(10))
        return kind & 0x3FF, self.read(length - 10)

    def read(self, count):
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise ConnectionError("the reader has closed the connection")
            data += part
        return data

    def ask(self, kind, body=b""):
        """Sends a request and returns its response's body; skips reports that arrive before it."""
        self.send(kind, body)
        answer = {1023: 1023, 14: 4}.get(kind, kind + 10)
        while True:
            got, content = self.receive()
            if got == 100 or got == answer:
                at = 5 if kind == 1023 else 0
                status, length = struct.unpack_from("!HH", content, at + 4)
                if status != 0:
                    raise RuntimeError(content[at + 8:at + 8 + length].decode())
                return content
            if got == 62:
                self.send(72)  # KEEPALIVE_ACK


def ro_spec(identifier, milliseconds, every=1):
    """An ROSpec that starts at once, reads with all antennas, and reports phase and RSSI.

    every: number of tag reads per report.
    """
    start, stop = parameter(179, b"\1"), parameter(182, struct.pack("!BI", 1, milliseconds))
    inventory = parameter(186, struct.pack("!HB", 1, 1))
    antennas = parameter(183, struct.pack("!HH", 1, 0) + parameter(184, struct.pack("!BI", 0, 0)) +
                         inventory)
    selected = parameter(238, struct.pack("!H", 0x1780))  # antenna, RSSI, first seen, last seen, count
    vendor = custom(50, custom(52, b"\0\1") + custom(53, b"\0\1") + custom(67, b"\0\1"))
    report = parameter(237, struct.pack("!BH", 1, every) + selected + vendor)
    return parameter(177, struct.pack("!IBB", identifier, 0, 0) + parameter(178, start + stop) +
                     antennas + report)


# TV parameters, which have a fixed length: name and struct format by type.
FIXED = {1: ("antenna", "!H"), 2: ("first_us", "!Q"), 3: ("uptime_us", "!Q"), 4: ("last_us", "!Q"),
         5: ("last_uptime_us", "!Q"), 6: ("rssi_dbm", "!b"), 7: ("channel", "!H"), 8: ("seen", "!H"),
         9: ("ro_spec", "!I"), 10: ("inventory_spec", "!H"), 11: ("crc", "!H"), 12: ("pc", "!H"),
         14: ("spec_index", "!H"), 16: ("access_spec", "!I")}
CUSTOM = {56: ("phase", "!H"), 57: ("rssi_cdbm", "!h"), 68: ("doppler", "!h")}


def parameters(data):
    """Yields (type, content) of each parameter."""
    while data:
        kind = data[0] & 0x7F
        if data[0] & 0x80:
            size = 1 + (12 if kind == 13 else struct.calcsize(FIXED[kind][1]))
            yield kind, data[1:size]
        else:
            kind, size = struct.unpack_from("!HH", data)
            yield kind & 0x3FF, data[4:size]
        data = data[size:]


def tags_in(report):
    """Yields a dictionary for each tag report of an RO_ACCESS_REPORT."""
    for _, content in parameters(report):
        tag = {}
        for kind, value in parameters(content):
            if kind == 13:
                tag["epc"] = value.hex().upper()
            elif kind == 241:
                tag["epc"] = value[2:].hex().upper()
            elif kind in FIXED:
                tag[FIXED[kind][0]] = struct.unpack(FIXED[kind][1], value)[0]
            elif kind == 1023:
                name, form = CUSTOM[struct.unpack_from("!II", value)[1]]
                tag[name] = struct.unpack_from(form, value, 8)[0]
            else:
                tag.setdefault("results", []).append((kind, value))
        yield tag


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--host", default="127.0.0.1")
    arguments.add_argument("--port", type=int, default=5084)
    arguments.add_argument("--seconds", type=float, default=3.0)
    asked = arguments.parse_args()
    reader = Reader(asked.host, asked.port, asked.seconds + 20)
    reader.ask(1023, struct.pack("!IB", IMPINJ, 21) + bytes(4))  # enables the vendor extension
    reader.ask(21, struct.pack("!I", 0))  # DELETE_ROSPEC: all
    # SET_READER_CONFIG: enables events when an ROSpec starts and ends.
    reader.ask(3, b"\0" + parameter(244, parameter(245, struct.pack("!HB", 2, 0x80))))
    reader.ask(20, ro_spec(1, round(1000 * asked.seconds)))  # ADD_ROSPEC
    reader.ask(24, struct.pack("!I", 1))  # ENABLE_ROSPEC
    while True:
        kind, body = reader.receive()
        if kind == 61:
            for tag in tags_in(body):
                print(f"{tag['epc']}  antenna {tag['antenna']}  {tag['rssi_cdbm'] / 100:7.2f} dBm  "
                      f"phase {360 * tag['phase'] / 4096:6.2f} deg")
        if kind == 63 and any(inner == 249 and content[0] == 1 for _, outer in parameters(body)
                              for inner, content in parameters(outer)):
            break  # the ROSpec has ended
    reader.ask(14)  # CLOSE_CONNECTION


if __name__ == "__main__":
    main()
