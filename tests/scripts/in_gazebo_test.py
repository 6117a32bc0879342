#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/in-gazebo: commands run in the root of Gazebo 11 as if they ran here, and leave no mounts behind.

    in_gazebo_test.py SOURCE_DIR

Skipped (77) if there is no Gazebo 11.
"""

import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time

SKIP = 77


class Room:
    def __init__(self, source):
        self.program = str(source / "scripts/in-gazebo")

    def run(self, *command, **options):
        return subprocess.run([self.program, *command], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False, timeout=60, **options)


def mounts():
    return pathlib.Path("/proc/self/mounts").read_text(encoding="utf-8")


def has_gazebo(room, _):
    assert "version 11." in room.run("gzserver", "--version").stdout


def gives_half_of_the_processors_to_gzserver(room, folder):
    world = folder / "empty.world"
    world.write_text("<sdf version='1.6'><world name='w'/></sdf>", encoding="utf-8")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        env = {**os.environ, "GAZEBO_MASTER_URI": f"http://127.0.0.1:{free.getsockname()[1]}"}
    with subprocess.Popen([room.program, "gzserver", str(world)], env=env, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as server:
        try:
            until = time.monotonic() + 60
            while b"gzserver" not in pathlib.Path(f"/proc/{server.pid}/cmdline").read_bytes().split(b"\0")[0]:
                assert server.poll() is None and time.monotonic() < until
                time.sleep(0.1)
            given = os.sched_getaffinity(server.pid)
        finally:
            server.terminate()
            server.wait(60)
    had = sorted(os.sched_getaffinity(0))
    assert given == set(had[:(len(had) + 1) // 2]), (given, had)
    assert room.run("nproc").stdout.strip() == str(len(had))  # other commands are not affected


def ends_with_the_commands_code(room, _):
    assert room.run("bash", "-c", "exit 7").returncode == 7
    assert room.run("no-such-program").returncode == 127
    assert room.run().returncode == 2


def keeps_folder_files_and_arguments(room, folder):
    done = room.run("bash", "-c", "pwd; printf '%s|' \"$@\"; echo made > file", "x", "a b", "*", "",
                    cwd=folder)
    assert done.stdout == f"{folder}\na b|*||", done
    file = folder / "file"
    assert file.read_text(encoding="utf-8") == "made\n"
    assert file.stat().st_uid == os.getuid()


def keeps_the_environment(room, _):
    settings = {"GAZEBO_IP": "127.0.0.1", "ROS_MASTER_URI": "http://x:1", "TAGFIELD_X": "a b\nc",
                "DISPLAY": ":7", "ASAN_OPTIONS": "x=1"}
    done = room.run("env", "--null", env={**os.environ, **settings})
    seen = dict(entry.split("=", 1) for entry in done.stdout.split("\0") if entry)
    for name, value in settings.items():
        assert seen[name] == value, (name, seen.get(name))
    assert os.access(seen["HOME"], os.W_OK), seen["HOME"]


def has_shared_memory_and_processes(room, _):
    done = room.run("bash", "-c", "test -w /dev/shm && test -e /proc/self/exe && : > /dev/null")
    assert done.returncode == 0, done


def gives_signals_to_the_command(room, _):
    script = "trap 'echo caught; exit 3' TERM; echo ready; while :; do sleep 0.05; done"
    with subprocess.Popen([room.program, "bash", "-c", script], text=True,
                          stdout=subprocess.PIPE) as process:
        assert process.stdout.readline() == "ready\n"
        process.send_signal(signal.SIGTERM)
        assert process.wait(30) == 3
        assert process.stdout.read() == "caught\n"


def leaves_no_mount(room, _):
    before = mounts()
    with subprocess.Popen([room.program, "bash", "-c", "echo ready; sleep 60"], text=True,
                          stdout=subprocess.PIPE) as process:
        assert process.stdout.readline() == "ready\n"
        assert mounts() == before
        process.kill()
        process.wait(30)
    time.sleep(0.1)
    assert mounts() == before


def says_what_is_missing(room, folder):
    if room.run("true", env={**os.environ, "TAGFIELD_GAZEBO_ROOT": str(folder)}).returncode == 0:
        return  # Gazebo 11 is installed natively, without a root
    done = room.run("true", env={**os.environ, "TAGFIELD_GAZEBO_ROOT": str(folder)})
    assert done.returncode == SKIP
    assert "scripts/gazebo-root" in done.stderr and done.stderr.count("\n") == 1, done.stderr


TESTS = (has_gazebo, gives_half_of_the_processors_to_gzserver, ends_with_the_commands_code,
         keeps_folder_files_and_arguments, keeps_the_environment,
         has_shared_memory_and_processes, gives_signals_to_the_command, leaves_no_mount,
         says_what_is_missing)


def main():
    room = Room(pathlib.Path(sys.argv[1]).resolve())
    there = room.run("true")
    if there.returncode == SKIP:
        print(there.stderr, end="")
        sys.exit(SKIP)
    failures = 0
    for test in TESTS:
        with tempfile.TemporaryDirectory(prefix="in-gazebo-") as folder:
            try:
                test(room, pathlib.Path(folder).resolve())
                print(f"good  {test.__name__}")
            except AssertionError as error:
                failures += 1
                print(f"BAD   {test.__name__}: {error!r}")
    print(f"{len(TESTS)} tests, {failures} failures")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
