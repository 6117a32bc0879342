#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Generates seeds for the fuzzers from files of the repository.

    fuzz/seeds.py FOLDER

FOLDER/TARGET/… are valid inputs of each fuzz target (fuzz/TARGET.cc).
"""

import io
import lzma
import pathlib
import sqlite3
import struct
import sys
import tarfile
import tempfile
import zlib

SOURCE = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(SOURCE / "examples/07_llrp_client"), str(SOURCE / "tests/live"),
                str(SOURCE / "tests/command")]
from llrp_client import parameter, ro_spec  # noqa: E402
from llrp_test import (ALL_EVENTS, access_spec, read_op, spec_of, transmit,  # noqa: E402
                       write_op)

EPC = "303400000000000000000001"


def message(kind, body=b""):
    return struct.pack("!HII", 1 << 10 | kind, 10 + len(body), 1) + body


def llrp():
    one = struct.pack("!I", 1)
    go_on = message(72) * 5
    add, enable, start = message(20, spec_of(1)), message(24, one), message(22, one)
    access = access_spec(1, [read_op(1, 0, 2), write_op(3, 0, [1])], EPC)
    yield "inventory", message(20, ro_spec(1, 20)) + message(24, one) + go_on + message(60)
    yield "power", message(20, spec_of(1, setting=transmit(20))) + enable + start + go_on
    yield "access", message(40, access) + message(41, one) + add + enable + start + go_on + message(44)
    yield "configure", message(3, b"\0" + parameter(244, ALL_EVENTS)) + message(2, bytes(7)) + go_on
    yield "ask", b"".join(message(kind, b"\0") for kind in (1, 26, 44, 60, 14))
    yield "end", add + enable + start + message(23, one) + message(25, one) + message(21, bytes(4))
    yield "custom", message(1023, struct.pack("!IBI", 25882, 21, 0)) + message(14)


def http():
    requests = [
        ("GET /api/status", ""), ("GET /api/scene", ""), ("GET /api/antennas", ""),
        ("GET /api/tags", ""), (f"GET /api/explain?antenna=left&tag={EPC}", ""),
        ("GET /api/coverage?antenna=left&height=1&cell=1", ""), ("GET /api/estimates", ""),
        ("POST /api/speed", '{"speed": 2}'), ("POST /api/step", '{"seconds": 0.01}'),
        ("POST /api/resume", ""), ("POST /api/pause", ""),
        ("POST /api/tags", '{"id": "a b/c", "position": [1, 2, 0.5]}'),
        ("POST /api/tags/a%20b%2Fc/move", '{"position": [2, 2, 0.5]}'),
        ("POST /api/tags/a%20b%2Fc/detune", '{"db": 1}'), ("DELETE /api/tags/a%20b%2Fc", ""),
        ("POST /api/antennas", '{"name": "five", "like": "left", "pose": [2, 2, 2, 0, 1.57, 0]}'),
        ("POST /api/antennas/five/move", '{"pose": [2, 2, 2, 0, 0, 0]}'),
        ("POST /api/antennas/five/disconnect", ""), ("POST /api/antennas/five/connect", ""),
        ("DELETE /api/antennas/five", ""),
        ("POST /api/obstacles", '{"name": "p", "position": [1, 1], "size": [1, 0.8], "yaw_deg": 5}'),
        ("DELETE /api/obstacles/p", "")]
    for i, (request, body) in enumerate(requests):
        yield f"one_{i}", f"{request}\n{body}\n".encode()
    yield "all", "".join(f"{request}\n{body}\n" for request, body in requests).encode()


def scenario():
    for path in sorted(SOURCE.glob("scenarios/*.yaml")):
        # Files that it refers to are missing here: without them, more of the scenario is parsed.
        lines = [line for line in path.read_text(encoding="utf-8").splitlines()
                 if "world" not in line and "profiles/" not in line and "path:" not in line]
        yield path.stem, path.read_bytes()
        yield path.stem + "_alone", "\n".join(lines).encode()
    yield "bodies", (b"obstacles:\n  - {name: w, radius_m: 0.2, trajectory: [[0, 0, 1], [2, 0, 3]]}\n"
                     b"  - {name: p, size: [1, 2], position: [0, 1], appears_s: 1, disappears_s: 2}\n")


def tables():
    yield "reads", b"\0" + (SOURCE / "examples/03_own_csv/reads.csv").read_bytes()[:4000]
    yield "poses", b"\1" + (SOURCE / "examples/03_own_csv/poses.csv").read_bytes()[:4000]
    yield "places", b"\2tag,x_m,y_m,z_m\na,1,2,3\n\"b \"\"c\",-1e-3,0,1.5\n"
    yield "heights", b"\3tag,z_m\na,1.5\nb,-2\n"


def epc():
    for i, uri in enumerate((
            "urn:epc:id:sgtin:0614141.812345.7", "urn:epc:id:sscc:0614141.1234567890",
            "urn:epc:id:grai:0614141.12345.400", "urn:epc:tag:sgtin-96:3.0614141.812345.6789",
            "urn:epc:id:giai:0614141.12345400", "urn:epc:id:gid:95100000.12345.400")):
        yield f"uri_{i}", b"\0" + uri.encode()
    yield "hex", b"\1" + b"3074257BF7194E4000001A85"
    for i, pattern in enumerate(("urn:epc:pat:sgtin-96:3.0614141.*.*",
                                 "urn:epc:pat:sgtin-96:3.0614141.X.[10-20]", "urn:epc:idpat:*")):
        yield f"pattern_{i}", b"\2" + pattern.encode()
    yield "events", (b"\3reports:\n  - name: dock\n    period_s: 2\n    duration_s: 2\n"
                     b"    sets: [current, additions, deletions]\n")


def grey_png(rows):
    """A greyscale PNG image with 8 bits per pixel."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    pixels = b"".join(b"\0" + bytes(row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))


def world():
    triangle = "0 0 0 1 0 0 0 1 0"
    yield "dae", (b"\0<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
                  b"version='1.4.1'><asset><up_axis>Z_UP</up_axis></asset><library_geometries>"
                  b"<geometry id='g'><mesh><source id='p'><float_array id='a' count='9'>" +
                  triangle.encode() + b"</float_array><technique_common><accessor source='#a' count='3' "
                  b"stride='3'><param name='X' type='float'/><param name='Y' type='float'/><param name='Z' "
                  b"type='float'/></accessor></technique_common></source><vertices id='v'><input "
                  b"semantic='POSITION' source='#p'/></vertices><triangles count='1'><input "
                  b"semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles></mesh></geometry>"
                  b"</library_geometries><library_visual_scenes><visual_scene id='s'><node>"
                  b"<instance_geometry url='#g'/></node></visual_scene></library_visual_scenes><scene>"
                  b"<instance_visual_scene url='#s'/></scene></COLLADA>")
    corners = [0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0]
    yield "stl", b"\1" + bytes(80) + struct.pack("<I12fH", 1, *corners, 0)
    yield "stl_text", (b"\1solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                       b"vertex 0 1 0\nendloop\nendfacet\nendsolid s\n")
    yield "obj", b"\2v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n"
    yield "heights", b"\xff" + grey_png([[0, 90, 200], [10, 255, 30], [40, 50, 60]])
    yield "frames", (
        b"\3<sdf version='1.7'><world name='w'><frame name='f' attached_to='m::j'><pose>1 2 3 0 0 1"
        b"</pose></frame><model name='m' placement_frame='g'><pose relative_to='f'/><frame name='g'/>"
        b"<link name='l'><pose degrees='1' relative_to='__model__'>0 0 1 0 0 90</pose><collision name='c'>"
        b"<geometry><polyline><height>2</height><point>0 0</point><point>1 0</point><point>0 1</point>"
        b"</polyline></geometry></collision><sensor name='s' type='rfidtag'/></link><joint name='j' "
        b"type='fixed'><parent>world</parent><child>l</child></joint><include merge='1'>"
        b"<uri>world.sdf</uri></include></model><state world_name='w'><insertions><model name='n'>"
        b"<link name=l><collision name='c'><geometry><capsule/></geometry></collision></link></model>"
        b"</insertions><deletions><name>x</name></deletions><model name='m'><pose>0 0 1 0 0 0</pose>"
        b"<link name='l'><pose>1 1 1 0 0 0</pose></link></model></state></world></sdf>")
    model = b"<model name='m'><link name='l'/></model><pose>1 2 3 0 0 1</pose><box><size>3 2 1</size></box>"
    yield "populations", (
        b"\3<sdf version='1.7'><world name='w'><population name='p'>" + model + b"<model_count>3"
        b"</model_count><distribution><type>linear-x</type></distribution></population><population "
        b"name='q'>" + model + b"<distribution><type>grid</type><rows>2</rows><cols>3</cols><step>0.5 0.5 0"
        b"</step></distribution></population></world></sdf>")
    for path in sorted([*SOURCE.glob("worlds/*.sdf"), *SOURCE.glob("models/*/model.sdf")]):
        yield path.parent.name + "_" + path.stem, b"\3" + path.read_bytes()


def a_map():
    keys = "image: map.pgm\nresolution: 0.05\norigin: [-1, 2, 0]\nnegate: 0\n" \
           "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    yield "binary", keys.encode() + b"\0P5 3 2 255\n\xfe\xfe\0\0\xcd\xfe"
    yield "text", (keys + "mode: scale\n").encode() + b"\0P2\n# a comment\n2 2\n65535\n0 1 65535 7\n"


def mcap():
    def record(op, content):
        return struct.pack("<BQ", op, len(content)) + content

    def text(word):
        return struct.pack("<I", len(word)) + word

    magic = b"\x89MCAP0\r\n"
    schema = record(3, struct.pack("<H", 1) + text(b"t") + text(b"ros2msg") + text(b"int8 a\n"))
    channel = record(4, struct.pack("<HH", 1, 1) + text(b"/t") + text(b"cdr") + struct.pack("<I", 0))
    messages = b"".join(record(5, struct.pack("<HIQQ", 1, i, i, i) + b"\0\1\0\0" + bytes([i]))
                        for i in range(3))
    chunk = record(6, struct.pack("<QQQI", 0, 2, len(schema + channel + messages), 0) + text(b"") +
                   struct.pack("<Q", len(schema + channel + messages)) + schema + channel + messages)
    header = record(1, text(b"ros2") + text(b"seeds"))
    end = record(15, struct.pack("<I", 0)) + record(2, struct.pack("<QQI", 0, 0, 0)) + magic
    yield "plain", magic + header + schema + channel + messages + end
    yield "chunk", magic + header + chunk + end


def settings():
    for path in sorted(SOURCE.glob("scenarios/bench/*.yaml")):
        yield "suite_" + path.stem, b"\0" + path.read_bytes()
    for path in sorted(SOURCE.glob("profiles/*/*.yaml")):
        kind = b"\2" if path.parent.name == "datasets" else b"\1"
        yield f"{path.parent.name}_{path.stem}", kind + path.read_bytes()
    yield "calibration", (b"\3name: own\nkind: calibration\nantennas:\n  left:\n    reads: 5\n"
                          b"    phase_sign: -1\n    phase_centre_m: {x: {value: 1, sigma: 0.1}, y: {value: 0}, "
                          b"z: {value: 1, observable: false}}\n    offsets:\n"
                          b"      - {frequency_hz: 866.9e6, value_rad: 1, sigma_rad: 0.1, reads: 5}\n")


def dataset():
    table = "time,epc,antenna,phase,rssi,frequency,x,y,z\n" + "".join(
        f"{i / 10},E2 00 {i % 3},1,{i % 6},-{50 + i},866.9,{i},2,1.5\n" for i in range(8))
    for path in sorted(SOURCE.glob("profiles/datasets/*.yaml")):
        yield path.stem, path.read_bytes() + b"\0" + table.encode()
    yield "own", (b"name: own\nstamp: {column: time, unit: s}\ntag: {column: epc}\n"
                  b"antenna: {column: antenna}\nphase: {column: phase, unit: radians}\n"
                  b"rssi: {column: rssi, unit: dbm}\nfrequency: {column: frequency, unit: mhz}\n"
                  b"position: {columns: [x, y, z], unit: m}\n\0" + table.encode())


# A TagReads message (tagfield_msgs/msg) with one read, serialized field by field for ROS 1 and as CDR.
READ_NUMBERS = (866.9e6, 1.5, -60.0, 0.25)


def ros1_reads():
    def text(word):
        return struct.pack("<I", len(word)) + word

    header = struct.pack("<III", 0, 5, 7) + text(b"antenna_frame")
    read = header + text(EPC.encode()) + text(b"reader") + text(b"left") + struct.pack("<4d", *READ_NUMBERS)
    return header + text(b"left") + struct.pack("<I", 1) + read


def cdr_reads():
    out = bytearray()

    def word(number):
        out.extend(bytes(-len(out) % 4) + struct.pack("<I", number))

    def text(content):
        word(len(content) + 1)
        out.extend(content + b"\0")

    def header():
        word(5)
        word(7)
        text(b"antenna_frame")

    header()
    text(b"left")
    word(1)
    header()
    for content in (EPC.encode(), b"reader", b"left"):
        text(content)
    out.extend(bytes(-len(out) % 8) + struct.pack("<4d", *READ_NUMBERS))
    return b"\0\1\0\0" + bytes(out)


def bag():
    """A ROS 1 bag (http://wiki.ros.org/Bags/Format/2.0): one chunk with one message."""
    def fields(**values):
        entries = [name.encode() + b"=" + value for name, value in values.items()]
        return b"".join(struct.pack("<I", len(entry)) + entry for entry in entries)

    def record(header, data):
        return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data

    number = struct.pack("<I", 0)
    stamp = struct.pack("<II", 5, 7)
    connection = record(fields(op=b"\7", conn=number, topic=b"/rfid/reads"), fields(
        topic=b"/rfid/reads", type=b"tagfield_msgs/TagReads",
        md5sum=b"01f0afc8593e413b6bbdbbf60aacb33b", message_definition=b"string antenna\n"))
    message = record(fields(op=b"\2", conn=number, time=stamp), ros1_reads())
    content = connection + message
    chunk = record(fields(op=b"\5", compression=b"none", size=struct.pack("<I", len(content))), content)
    index = record(fields(op=b"\4", ver=struct.pack("<I", 1), conn=number, count=struct.pack("<I", 1)),
                   stamp + struct.pack("<I", len(connection)))
    begin = b"#ROSBAG V2.0\n"
    chunk_at = len(begin) + 4096
    header = fields(op=b"\3", index_pos=struct.pack("<Q", chunk_at + len(chunk) + len(index)),
                    conn_count=struct.pack("<I", 1), chunk_count=struct.pack("<I", 1))
    info = record(fields(op=b"\6", ver=struct.pack("<I", 1), chunk_pos=struct.pack("<Q", chunk_at),
                         start_time=stamp, end_time=stamp, count=struct.pack("<I", 1)),
                  number + struct.pack("<I", 1))
    return begin + record(header, b" " * (4096 - 8 - len(header))) + chunk + index + connection + info


def recording():
    """Each recording twice: with reads held in memory, and read again (first byte of 128 or more)."""
    for kind, (name, content) in enumerate(recordings()):
        yield name, bytes([kind]) + content
        yield f"{name}_told", bytes([129 + kind]) + content


def recordings():
    """A rosbag, an MCAP file and a rosbag2 database (SQLite)."""
    topic, kind = "/rfid/reads", "tagfield_msgs/msg/TagReads"
    yield "bag", bag()

    def mcap_record(op, content):
        return struct.pack("<BQ", op, len(content)) + content

    def text(word):
        return struct.pack("<I", len(word)) + word.encode()

    magic = b"\x89MCAP0\r\n"
    yield "mcap", magic + b"".join((
        mcap_record(1, text("ros2") + text("seeds")),
        mcap_record(3, struct.pack("<H", 1) + text(kind) + text("ros2msg") + text("string antenna\n")),
        mcap_record(4, struct.pack("<HH", 1, 1) + text(topic) + text("cdr") + struct.pack("<I", 0)),
        mcap_record(5, struct.pack("<HIQQ", 1, 0, 0, 0) + cdr_reads()),
        mcap_record(15, struct.pack("<I", 0)), mcap_record(2, struct.pack("<QQI", 0, 0, 0)))) + magic
    with tempfile.TemporaryDirectory(prefix="tagfield-") as folder:
        path = pathlib.Path(folder) / "run.db3"
        with sqlite3.connect(path) as database:
            database.executescript(
                "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
                " serialization_format TEXT NOT NULL);"
                "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
                " timestamp INTEGER NOT NULL, data BLOB NOT NULL);")
            database.execute("INSERT INTO topics VALUES (1, ?, ?, 'cdr')", (topic, kind))
            database.execute("INSERT INTO messages VALUES (1, 1, 5, ?)", (cdr_reads(),))
        database.close()
        yield "db3", path.read_bytes()


def archive():
    def packed(mode):
        out = io.BytesIO()
        with tarfile.open(fileobj=out, mode=mode) as tar:
            for name in ("run/reads.csv", "run/poses.csv"):
                content = b"stamp,tag\n1,a\n"
                entry = tarfile.TarInfo(name)
                entry.size = len(content)
                tar.addfile(entry, io.BytesIO(content))
        return out.getvalue()

    yield "tar", b"\0" + packed("w")
    yield "tar_gz", b"\1" + packed("w:gz")
    yield "csv_xz", b"\3" + lzma.compress(b"stamp,tag\n1,a\n")
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w") as tar:
        for name, kind in (("../out.csv", tarfile.REGTYPE), ("link.csv", tarfile.SYMTYPE)):
            entry = tarfile.TarInfo(name)
            entry.type = kind
            entry.linkname = "/etc/passwd"
            tar.addfile(entry)
    yield "tar_out", b"\0" + out.getvalue()


TARGETS = {"llrp": llrp, "http": http, "scenario": scenario, "tables": tables, "epc": epc,
         "world": world, "map": a_map, "mcap": mcap, "settings": settings, "dataset": dataset,
         "recording": recording, "archive": archive}


def write_all(folder):
    for target, seeds in TARGETS.items():
        place = pathlib.Path(folder) / target
        place.mkdir(parents=True, exist_ok=True)
        for name, content in seeds():
            (place / name).write_bytes(content)


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    write_all(sys.argv[1])
