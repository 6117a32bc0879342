#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""'tagfield serve' with well-behaved and misbehaving HTTP and WebSocket clients.

    http_test.py --tagfield PROGRAM --source SOURCE_DIR --build BUILD_DIR
"""

import http.client
import json
import math
import os
import pathlib
import random
import signal
import socket
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "command"))
from common import (case, check, check_between, check_equal, check_in,  # noqa: E402
                    check_near, main, read_csv, read_json, run)
from npm import require_node  # noqa: E402
from served import served  # noqa: E402

try:
    import jsonschema
    import websocket
except ImportError as missing:
    print(f"skipped: {missing.name} is missing (python3-jsonschema, python3-websocket)")
    sys.exit(77)

PORTAL = "portal"


def as_json_schema(node, components):
    """Converts an OpenAPI 3.0 schema to JSON Schema draft 4, with `nullable` as type "null"."""
    if isinstance(node, list):
        return [as_json_schema(entry, components) for entry in node]
    if not isinstance(node, dict):
        return node
    if "$ref" in node:
        return as_json_schema(components[node["$ref"].rsplit("/", 1)[1]], components)
    schema = {key: as_json_schema(value, components) for key, value in node.items()}
    if schema.pop("nullable", False) is True and "type" in schema:
        schema["type"] = [schema["type"], "null"]
    return schema


class Contract:
    """The served openapi.json, with checks of responses against it."""

    def __init__(self, server):
        self.document = server.get("/api/openapi.json")
        self.components = self.document["components"]["schemas"]
        self.unseen = {(method.upper(), path) for path, methods in self.document["paths"].items()
                       for method in methods}

    def schema(self, method, path, status):
        operation = self.document["paths"][path][method.lower()]
        responses = operation["responses"]
        content = responses["200" if status == 200 else "4XX"]["content"]
        return as_json_schema(next(iter(content.values()))["schema"], self.components)

    def check(self, method, path, status, answer):
        self.unseen.discard((method, path))
        try:
            jsonschema.Draft4Validator(self.schema(method, path, status)).validate(answer)
        except jsonschema.ValidationError as error:
            check(False, f"{method} {path} ({status}): {error.message} at {list(error.path)}")


def reads_of(server, count, target="/api/reads"):
    """The first `count` lines of a stream."""
    connection = server.connection()
    connection.request("GET", target)
    response = connection.getresponse()
    check_equal(response.getheader("Content-Type"), "application/jsonl", "type of the stream")
    lines = [json.loads(response.readline()) for _ in range(count)]
    connection.close()
    return lines


@case
def all_that_openapi_describes_is_so(context):
    with served(context, context.shipped(PORTAL)) as server:
        contract = Contract(server)

        def ask(method, path, body=None, expected=200, **names):
            target = path
            for name, value in names.items():
                target = target.replace("{" + name + "}", value)
            query = {"/api/explain": "?antenna=port_1&tag=tag_01",
                     "/api/coverage": "?antenna=port_1&height=0.9&cell=0.5"}.get(path, "")
            status, answer = server.ask(method, target + query, body)
            check_equal(status, expected, f"{method} {target}: {answer}, status")
            contract.check(method, path, status, answer)
            return answer

        for path in ("status", "scene", "antennas", "tags", "explain", "coverage"):
            ask("GET", f"/api/{path}")
        ask("GET", "/api/estimates", expected=400)  # without --locate
        ask("GET", "/api/plan", expected=400)  # without a plan
        ask("POST", "/api/speed", {"speed": 2})
        ask("POST", "/api/pause")
        ask("POST", "/api/step", {"seconds": 0.25})
        ask("POST", "/api/resume")
        ask("POST", "/api/tags", {"id": "a b/c", "position": [1, 2, 0.5], "like": "tag_01"})
        ask("POST", "/api/tags/{id}/move", {"position": [2, 2, 0.5]}, id="a%20b%2Fc")
        ask("POST", "/api/tags/{id}/detune", {"db": 1}, id="a%20b%2Fc")
        tags = {tag["id"]: tag for tag in ask("GET", "/api/tags")["tags"]}
        check_equal(tags["a b/c"]["position"], [2, 2, 0.5], "place of the tag that was moved")
        ask("DELETE", "/api/tags/{id}", id="a%20b%2Fc")
        ask("DELETE", "/api/tags/{id}", id="a%20b%2Fc", expected=400)
        ask("POST", "/api/antennas", {"name": "port_5", "like": "port_1",
                                      "pose": [2, 2, 2.5, 0, 1.57, 0]})
        ask("POST", "/api/antennas/{name}/move", {"pose": [2, 2, 2, 0, 1.57, 0]}, name="port_5")
        ask("POST", "/api/antennas/{name}/disconnect", name="port_5")
        ask("POST", "/api/antennas/{name}/connect", name="port_5")
        ask("DELETE", "/api/antennas/{name}", name="port_5")
        added = ask("POST", "/api/obstacles", {"name": "pallet", "position": [1, 1], "size": [1, 0.8]})
        check_equal(added["material"], "metal", "material of the obstacle")
        ask("GET", "/api/scene")
        ask("DELETE", "/api/obstacles/{name}", name="pallet")
        for line in reads_of(server, 50):
            contract.check("GET", "/api/reads", 200, line)
        check_equal(contract.unseen, set(), "what was not tried")


@case
def reads_are_those_of_the_headless_run(context):
    folder = context.simulate(PORTAL, "--record-only", "--set", "duration_s=5")
    expected = read_csv(folder / "reads.csv")
    with served(context, context.shipped(PORTAL), "--paused", "--speed", "max") as server:
        connection = server.connection()
        connection.request("GET", "/api/reads")
        response = connection.getresponse()
        time.sleep(0.2)  # until it is subscribed
        server.post("/api/resume")
        lines = [json.loads(response.readline()) for _ in expected]
        connection.close()
    check_between(len(expected), 500, 5000, "number of reads")
    for row, line in zip(expected, lines):
        streamed = (line["epc"], line["antennaName"], line["peakRssiCdbm"], line["timestamp"])
        of_run = (row["tag"], row["antenna"], round(float(row["rssi_dbm"]) * 100),
                  f"2020-01-01T00:00:{float(row['stamp_s']):012.9f}Z")
        if not check_equal(streamed, of_run, "read"):
            break
        check_near(line["phaseAngle"], float(row["phase_rad"]) * 57.29577951308232, 1e-4, "phase")


@case
def streams_are_of_what_is_asked_for(context):
    with served(context, context.shipped(PORTAL), "--speed", "10") as server:
        lines = reads_of(server, 20, "/api/reads?tag=tag_03&antenna=port_2")
        check_equal({(line["epc"], line["antennaName"], line["antennaPort"]) for line in lines},
                    {("tag_03", "port_2", 2)}, "tags and antennas")


@case
def time_goes_as_requested(context):
    with served(context, context.shipped(PORTAL), "--paused") as server:
        check_equal(server.get("/api/status")["time"], 0, "time at first")
        time.sleep(0.3)
        check_equal(server.get("/api/status")["time"], 0, "time while paused")
        server.post("/api/step", {"seconds": 0.5})
        status = server.wait_for(lambda now: now["paused"], "it is paused after a step")
        check_near(status["time"], 0.5, 1e-9, "time after a step")
        server.post("/api/speed", {"speed": 20})
        server.post("/api/resume")
        begin = time.monotonic()
        before = server.get("/api/status")["time"]
        time.sleep(1.5)
        after = server.get("/api/status")["time"]
        passed = time.monotonic() - begin
        check_between((after - before) / passed, 12, 24, "pace at a speed of 20")


@case
def short_steps_add_up(context):
    with served(context, context.shipped(PORTAL), "--paused", "--set", "time_step_s=0.01") as server:
        for _ in range(20):
            server.post("/api/step", {"seconds": 0.005})
            status = server.wait_for(lambda now: now["paused"], "it is paused after a step")
        check_near(status["time"], 0.1, 1e-9, "time after 20 steps of 0.005 s")
        for seconds in (1e-7, 2e6):
            check_equal(server.ask("POST", "/api/step", {"seconds": seconds})[0], 400, f"a step of {seconds} s")


@case
def second_step_does_not_replace_the_first(context):
    with served(context, context.shipped(PORTAL), "--paused") as server:
        server.post("/api/step", {"seconds": 1.5})
        status, answer = server.ask("POST", "/api/step", {"seconds": 0.1})
        check_equal((status, list(answer)), (409, ["error"]), "answer to a second step")
        check_in("a step is running, to 1.5 s", answer["error"], "message")
        status = server.wait_for(lambda now: now["paused"], "it is paused after the step")
        check_near(status["time"], 1.5, 1e-9, "time after both")
        server.post("/api/step", {"seconds": 0.1})


@case
def unknown_parameters_are_refused(context):
    with served(context, context.shipped(PORTAL), "--paused") as server:
        for target, said in (("/api/reads?antena=port_1", "did you mean 'antenna'?"),
                             ("/api/explain?antenna=port_1&tga=tag_01", "did you mean 'tag'?"),
                             ("/api/status?full=1", "'?full' is not a parameter here: expected none")):
            status, answer = server.ask("GET", target)
            check_equal(status, 400, f"status of {target}")
            check_in(said, answer["error"], f"message of {target}")
        check_equal(server.ask("GET", "/api/reads?tag=%zz")[0], 400, "status of a broken escape")


def frames(server, count, headers=None):
    client = websocket.create_connection(f"ws://127.0.0.1:{server.port}/api/live", timeout=20,
                                         header=headers or [])
    for _ in range(count):
        yield json.loads(client.recv())
    client.close()


@case
def pages_get_frames(context):
    with served(context, context.shipped("warehouse_physics")) as server:
        tags = {tag["id"] for tag in server.get("/api/tags")["tags"]}
        antennas = {antenna["name"]: antenna for antenna in server.get("/api/antennas")["antennas"]}
        seen = list(frames(server, 40))
        times = [frame["time"] for frame in seen]
        check(all(a < b for a, b in zip(times, times[1:])), f"times do not rise: {times}")
        check_between(times[-1] - times[0], 1.0, 4.0, "time of forty frames")
        reads = [read for frame in seen for read in frame["reads"]]
        check(reads and all(read[0] in tags and read[1] in antennas for read in reads),
              f"reads of unknown tags or antennas: {reads[:3]}")
        moving = {name for name, antenna in antennas.items() if antenna["robot"]}
        check_equal({row[0] for frame in seen for row in frame["antennas"]}, moving,
                    "antennas that move")
        robots = [frame["robots"][0] for frame in seen]
        check(robots[0][1:3] != robots[-1][1:3], "the robot stands")


@case
def the_example_in_javascript_prints_reads(context):
    require_node(18)
    with served(context, context.shipped(PORTAL)) as server:
        result = run(["node", context.source / "examples/08_live_client/reads.mjs",
                      server.addresses["http"], "tag_01", "30"])
        check_equal(result.code, 0, f"exit code of the example ({result.err})")
        lines = result.out.splitlines()
        check_equal(len(lines), 30, "lines")
        check(all("dBm" in line for line in lines), f"lines without RSSI: {lines[0]}")
        moved = [float(line.split("moved ")[1].split(" mm")[0]) for line in lines if "moved" in line]
        check(len(moved) > 10, "no carrier came twice")
        check_between(max(map(abs, moved)), 0, 0.25 * 299792458 / 902e6 * 1000, "largest change [mm]")


@case
def tags_are_located_while_reads_come_in(context):
    with served(context, context.shipped("paper_warehouse"), "--speed", "10", "--locate") as server:
        contract = Contract(server)
        truth = {tag["id"]: tag["position"] for tag in server.get("/api/tags")["tags"]}
        first = next(frames(server, 1))
        check(len(first["estimates"]) < len(truth), "all tags are located from the start")
        server.wait_for(lambda status: status["time"] > 100, "the end of the path", 30)
        server.post("/api/pause")
        # Reads so far are still processed, which may take long on a busy machine.
        end = time.monotonic() + 60
        while time.monotonic() < end:
            answer = server.get("/api/estimates")
            contract.check("GET", "/api/estimates", 200, answer)
            if len([one for one in answer["estimates"] if one["verdict"] == "located"]) == 10:
                break
            time.sleep(0.2)
        check_equal({one["id"] for one in answer["estimates"]}, set(truth), "tags with an estimate")
        for one in answer["estimates"]:
            check_equal(one["verdict"], "located", f"{one['id']}: {one['reason']}, verdict")
            place = one["candidates"][0]
            error = math.dist(place["position"][:2], truth[one["id"]][:2])
            check_between(error, 0, 0.02 + 5 * place["expectedError"], f"error of {one['id']} [m]")
        # A new client receives all of them at once.
        rows = {row[0]: row[1:] for row in next(frames(server, 1))["estimates"]}
        check_equal(set(rows), set(truth), "tags with an estimate in the frame")
        for one in answer["estimates"]:
            check_near(rows[one["id"]][0], one["candidates"][0]["position"][0], 0.05, "x of an estimate")


@case
def a_plan_is_shown_beside_its_layout(context):
    out = context.folder / "plan"
    context.run_well("plan", context.shipped("plan/room"), "--samples", "8", "--out", out)
    written = read_json(out / "plan.json")
    with served(context, out / "layout.yaml", "--allow-outside") as server:
        contract = Contract(server)
        check(server.get("/api/status")["plan"], "the status has no plan")
        plan = server.get("/api/plan")
        contract.check("GET", "/api/plan", 200, plan)
        check_equal(len(plan["layouts"][plan["chosen"]]["antennas"]), written["chosen_antennas"], "antennas")
        rows = read_csv(out / "plan_positions.csv")
        check_equal(len(plan["positions"]), len(rows), "positions")
        check_equal(plan["percent"][2], [round(100 * float(row["p_3"])) for row in rows], "percent with three antennas")
    # A plan of another scenario is served if requested explicitly; an invalid one is rejected immediately.
    with served(context, context.shipped(PORTAL), "--plan", out) as server:
        check_equal(server.get("/api/plan")["scenario"], "room", "scenario of the plan")
    result = context.run("serve", context.shipped(PORTAL), "--http", "0", "--plan", context.folder)
    check_equal((result.code, result.err.count("\n")), (2, 1), "code and lines without a plan")
    check_in("plan.json", result.err, "stderr without a plan")
    (out / "plan.json").write_text("{}", encoding="utf-8")
    with served(context, out / "layout.yaml", "--allow-outside") as server:
        check(not server.get("/api/status")["plan"], "a plan that is not whole is shown")


def turned(q, v):
    """v rotated by the quaternion [x, y, z, w]."""
    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    t = [2 * n for n in cross(q[:3], v)]
    return [v[i] + q[3] * t[i] + cross(q[:3], t)[i] for i in range(3)]


def distance_to_box(origin, direction, solid):
    """Distance along a ray to a box, by the slab method; infinite if it misses."""
    *p, qx, qy, qz, qw = solid["pose"]
    back = [-qx, -qy, -qz, qw]
    o = turned(back, [origin[i] - p[i] for i in range(3)])
    d = turned(back, direction)
    enter, leave = 0.0, math.inf
    for i in range(3):
        half = solid["box"][i] / 2
        if abs(d[i]) < 1e-12:
            if abs(o[i]) > half:
                return math.inf
            continue
        near, far = sorted(((-half - o[i]) / d[i], (half - o[i]) / d[i]))
        enter, leave = max(enter, near), min(leave, far)
    return enter if enter <= leave else math.inf


@case
def lasers_end_where_things_stand(context):
    with served(context, context.shipped("paper_warehouse"), "--paused") as server:
        boxes = [solid for solid in server.get("/api/scene")["solids"] if "box" in solid]
        (scan,) = next(frames(server, 1))["scans"]
        check_equal(scan["robot"], server.get("/api/antennas")["antennas"][0]["robot"], "robot")
        met = 0
        for i, distance in enumerate(scan["ranges"]):
            angle = scan["angle_min"] + i * scan["angle_step"]
            beam = turned(scan["origin"][3:], [math.cos(angle), math.sin(angle), 0])
            nearest = min(distance_to_box(scan["origin"][:3], beam, box) for box in boxes)
            # Five standard deviations of the noise; other shapes may be in front of the box.
            check(distance < nearest + 0.055, f"beam {i} of {distance} m goes through {nearest} m")
            met += abs(distance - nearest) < 0.055
        check(met > 100, f"only {met} of {len(scan['ranges'])} beams end on boxes")


@case
def what_others_change_is_reported_while_paused(context):
    with served(context, context.shipped(PORTAL), "--paused") as server:
        client = websocket.create_connection(f"ws://127.0.0.1:{server.port}/api/live", timeout=20)
        first = json.loads(client.recv())
        check(first["paused"] and not first.get("changed"), f"frame of a new client: {first}")
        server.post("/api/tags/tag_01/move", {"position": [1, 1, 1]})
        frame = json.loads(client.recv())
        check(frame["paused"] and frame.get("changed"), f"frame after a move: {frame}")
        server.post("/api/step", {"seconds": 0.1})
        while not frame["paused"] or frame["time"] == 0:
            frame = json.loads(client.recv())
        check_near(frame["time"], 0.1, 1e-9, "time of the frame after a step")
        client.close()


@case
def a_cable_that_is_off_reads_nothing(context):
    # Paused, as reads from before the disconnection would be reported, too.
    with served(context, context.shipped(PORTAL), "--speed", "20", "--paused") as server:
        server.post("/api/antennas/port_1/disconnect")
        status, answer = server.ask("GET", "/api/explain?antenna=port_1&tag=tag_01")
        check_equal((status, answer.get("error")), (400, "antenna 'port_1' is disconnected"),
                    "explanation")
        server.post("/api/resume")
        lines = reads_of(server, 500)
        check_equal({line["antennaName"] for line in lines}, {"port_2", "port_3", "port_4"},
                    "antennas")
        server.post("/api/antennas/port_1/connect")
        check("port_1" in {line["antennaName"] for line in reads_of(server, 1000)},
              "port_1 does not read again")


@case
def strangers_are_turned_away(context):
    with served(context, context.shipped(PORTAL), "--paused") as server:
        own = f"127.0.0.1:{server.port}"
        for headers, expected in (({"Host": "evil.example"}, 403),
                                  ({"Host": own, "Origin": "http://evil.example"}, 403),
                                  ({"Host": own, "Origin": "null"}, 403),
                                  ({"Host": own, "Origin": f"http://{own}"}, 200)):
            status, _ = server.ask("POST", "/api/pause", headers=headers)
            check_equal(status, expected, f"status with {headers}")
        status, _ = server.ask("GET", "/api/tags", headers={"Host": "evil.example"})
        check_equal(status, 403, "status of a look by another host's name")
        status, _ = server.ask("POST", "/api/step", '{"seconds": 1}',
                               {"Content-Type": "text/plain"})
        check_equal(status, 415, "status of a form's body")
        try:
            client = websocket.create_connection(f"ws://{own}/api/live", timeout=20,
                                                 origin="http://evil.example")
            client.close()
            check(False, "a page of another site gets frames")
        except websocket.WebSocketBadStatusException as error:
            check_equal(error.status_code, 403, "status of a WebSocket of another site")


@case
def whoever_can_reach_it_needs_the_token_to_command(context):
    with served(context, context.shipped(PORTAL), "--paused", "--listen", "0.0.0.0", "--token",
                "a secret") as server:
        check_equal(server.get("/api/status")["paused"], True, "paused")
        for word, expected in ((None, 401), ("Bearer wrong", 401), ("Bearer a secret", 200)):
            headers = {"Authorization": word} if word else {}
            status, _ = server.ask("POST", "/api/resume", headers=headers)
            check_equal(status, expected, f"status with {word}")
        server.process.send_signal(signal.SIGTERM)
        server.process.wait(timeout=20)
        check_in("others can reach 0.0.0.0", server.process.stderr.read().decode(), "warnings")


def exchange(server, data, seconds=5):
    """Sends bytes and returns the response, b"" if there is none."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=seconds) as client:
        try:
            client.sendall(data)
            client.shutdown(socket.SHUT_WR)
            return client.recv(65536)
        except OSError:
            return b""


@case
def what_is_too_much_or_no_http_is_refused(context):
    with served(context, context.shipped(PORTAL), "--paused") as server:
        host = f"Host: 127.0.0.1:{server.port}\r\n".encode()
        body = b"x" * 70000
        for data, expected in (
                (b"POST /api/step HTTP/1.1\r\n" + host +
                 b"Content-Length: 70000\r\nContent-Type: application/json\r\n\r\n" + body, b"413"),
                (b"GET / HTTP/1.1\r\n" + host + b"X: " + b"y" * 20000 + b"\r\n\r\n", b"431"),
                (b"\x16\x03\x01\x00\xa5\x01\x00\x00\xa1\x03\x03", b"400"),
                (b"GET /%zz HTTP/1.1\r\n" + host + b"\r\n", b"400"),
                (b"GET /api/nothing HTTP/1.1\r\n" + host + b"\r\n", b"404"),
                (b"PUT /api/status HTTP/1.1\r\n" + host + b"Content-Length: 0\r\n\r\n", b"405")):
            answer = exchange(server, data)
            check_equal(answer[9:12], expected, f"status of {data[:30]!r}: {answer[:80]!r}")
        server.get("/api/status")


@case
def handshakes_without_a_key_are_refused_in_json(context):
    with served(context, context.shipped(PORTAL)) as server:
        begin = (f"GET /api/live HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nUpgrade: websocket\r\n"
                 "Connection: Upgrade\r\n")
        key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
        for headers in ("Sec-WebSocket-Version: 13\r\n", key, key + "Sec-WebSocket-Version: 12\r\n",
                        "Sec-WebSocket-Key: short\r\nSec-WebSocket-Version: 13\r\n"):
            head, _, body = exchange(server, (begin + headers + "\r\n").encode()).partition(b"\r\n\r\n")
            check_equal(head[9:12], b"400", f"status with {headers!r}")
            check_in("Sec-WebSocket-Key", json.loads(body)["error"], f"error with {headers!r}")


@case
def expectations_are_answered_before_the_body(context):
    with served(context, context.shipped(PORTAL), "--paused") as server:
        def asked(client, kind, origin=""):
            client.sendall((f"POST /api/step HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n{origin}"
                            f"Content-Type: {kind}\r\nExpect: 100-continue\r\nContent-Length: 16\r\n\r\n").encode())
            return client.recv(65536)
        with socket.create_connection(("127.0.0.1", server.port), timeout=20) as client:
            for _ in range(2):  # also the second one of a connection
                check_equal(asked(client, "application/json"), b"HTTP/1.1 100 Continue\r\n\r\n", "the first answer")
                client.sendall(b'{"seconds": 0.5}')
                check_equal(client.recv(65536)[:12], b"HTTP/1.1 200", "the answer after the body")
                status = server.wait_for(lambda now: now["paused"], "it is paused after the step")
        check_near(status["time"], 1, 1e-9, "time after both steps")
        for kind, origin, expected in (("text/plain", "", b"415"),
                                       ("application/json", "Origin: http://evil.com\r\n", b"403")):
            with socket.create_connection(("127.0.0.1", server.port), timeout=20) as client:
                check_equal(asked(client, kind, origin)[9:12], expected, f"{kind} {origin!r}")


@case
def garbage_harms_nobody(context):
    with served(context, context.shipped(PORTAL), "--speed", "5") as server:
        rng = random.Random(1)
        host = f"127.0.0.1:{server.port}"
        seeds = [f"POST /api/tags HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\n"
                 'Content-Length: 40\r\n\r\n{"id": "x", "position": [1, 2, 3]}      ',
                 f"GET /api/explain?antenna=port_1&tag=tag_01 HTTP/1.1\r\nHost: {host}\r\n\r\n",
                 f"GET /api/live HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\n"
                 "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                 "Sec-WebSocket-Version: 13\r\n\r\n\x81\x05hello"]
        memory = server.memory_mb()
        for _ in range(1500):
            data = bytearray(rng.choice(seeds).encode("latin-1"))
            for _ in range(rng.randrange(1, 12)):
                place = rng.randrange(len(data))
                data[place:place + rng.randrange(3)] = rng.randbytes(rng.randrange(3))
            exchange(server, bytes(data))
        server.get("/api/status")
        check_between(server.memory_mb(), 0, memory + 60, "memory [MB]")


@case
def a_hundred_clients_at_once_and_some_that_do_nothing(context):
    with served(context, context.shipped(PORTAL)) as server:
        idle = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(100)]
        clients = [websocket.create_connection(f"ws://127.0.0.1:{server.port}/api/live", timeout=20)
                   for _ in range(100)]
        for client in clients:
            for _ in range(5):
                check("time" in json.loads(client.recv()), "a frame without time")
        check_between(server.get("/api/status")["pace"], 0.9, 1.1, "pace")
        for client in clients:
            client.close()
        for client in idle:
            client.close()


@case
def who_falls_behind_loses_its_own_oldest(context):
    with served(context, context.shipped(PORTAL), "--speed", "max") as server:
        slow = server.connection(timeout=2)
        slow.request("GET", "/api/reads")
        response = slow.getresponse()
        server.wait_for(lambda now: now["time"] > 600, "ten minutes are simulated", 60)
        check_between(server.memory_mb(), 0, 1500 if "TAGFIELD_SANITIZED" in os.environ else 300, "memory [MB]")
        server.post("/api/pause")
        lines = []
        try:
            while line := response.readline():
                lines.append(json.loads(line))
        except TimeoutError:
            pass
        slow.close()
        dropped = sum(line.get("dropped", 0) for line in lines)
        check(dropped > 1000, f"it reports {dropped} lost reads")
        now = server.get("/api/status")["time"]
        minute = f"2020-01-01T00:{int((now - 5) // 60):02}"
        last = lines[-1].get("timestamp", "")
        check(last >= minute, f"the last read is of {last}, after {now} s")


@case
def it_ends_within_a_second(context):
    with served(context, context.shipped("warehouse_physics"), "--locate") as server:
        clients = [websocket.create_connection(f"ws://127.0.0.1:{server.port}/api/live", timeout=20)
                   for _ in range(20)]
        begin = time.monotonic()
        server.process.send_signal(signal.SIGTERM)
        code = server.process.wait(timeout=20)
        check_between(time.monotonic() - begin, 0, 1, "time to end [s]")
        check_equal(code, 0, "exit code")
        for client in clients:
            client.close()


def keep_asking(server, is_over, ask):
    """Repeats a request, ignoring errors, until `is_over` is set."""
    while not is_over.is_set():
        try:
            ask(server)
        except (OSError, ValueError, http.client.HTTPException, websocket.WebSocketException):
            pass


@case
def it_ends_in_the_middle_of_all_that_can_be_asked(context):
    generator = random.Random(11)
    pallet = {"name": "pallet", "position": [1, 1], "size": [1, 1]}
    askers = [
        lambda server: server.ask("GET", "/api/coverage?antenna=port_1&height=0.9&cell=0.2"),
        lambda server: server.ask("GET", "/api/explain?antenna=port_1&tag=tag_03"),
        lambda server: list(frames(server, 5)),
        lambda server: reads_of(server, 50),
        lambda server: server.ask("POST", "/api/tags/tag_03/move", {"position": [1, 1, 1]}),
        lambda server: [server.ask("POST", f"/api/antennas/port_1/{what}")
                        for what in ("disconnect", "connect")],
        lambda server: [server.ask("POST", "/api/obstacles", pallet),
                        server.ask("DELETE", "/api/obstacles/pallet")],
    ]
    for _ in range(6):
        is_over = threading.Event()
        with served(context, context.shipped(PORTAL), "--speed", "max") as server:
            threads = [threading.Thread(target=keep_asking, args=(server, is_over, ask), daemon=True)
                       for ask in askers]
            for thread in threads:
                thread.start()
            time.sleep(generator.uniform(0.3, 2.0))
            server.process.send_signal(signal.SIGTERM)
            check_equal(server.process.wait(timeout=20), 0, "exit code")
            is_over.set()
            for thread in threads:
                thread.join()


@case
def a_port_that_is_taken_is_said(context):
    with served(context, context.shipped(PORTAL), "--paused") as server:
        result = context.run("serve", context.shipped(PORTAL), "--http", str(server.port))
        check_equal(result.code, 2, "exit code")
        check_in(f"HTTP can't listen on 127.0.0.1 port {server.port}", result.err, "message")
    for arguments, word in ((["--listen", "nowhere"], "'nowhere' is not an IP address"),
                            (["--locate", "--set", "localization.method=none"],
                             "serve: the scenario's localization is 'none': expected --method METHOD with --locate"),
                            (["--speed", "-1"], "--speed: '-1': expected a multiple of real time")):
        result = context.run("serve", context.shipped(PORTAL), *arguments)
        check_equal(result.code, 2, f"exit code with {arguments}")
        check_in(word, result.err, "message")


if __name__ == "__main__":
    main()
