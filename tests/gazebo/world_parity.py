#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the poses of a world's solids with those in Gazebo 11.

    world_parity.py [--plugins build/gazebo/lib] [--poses build/release/bin/world_poses]
                    [--model-path DIR]… [--list] WORLD_OR_MODEL…

Each file is loaded by the real gzserver, which reports the poses of all collisions before its first step,
and by Tagfield. A model file is included in a world. Prints one line per file: numbers of solids that
agree to 1e-5 m and rad, that differ, and that exist in only one of the two. The exit code is 1 if any differ.
"""

import argparse
import collections
import itertools
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from gazebo import IN_GAZEBO, TOP, experiment

TOLERANCE = 1e-5  # [m], and of a quaternion's components: Gazebo reads some numbers as single floats
SERVER_S = 120.0

Parity = collections.namedtuple("Parity", "agree differ ours_alone theirs_alone words")


def poses_in(text):
    """Parses lines NAME<tab>seven numbers to {name: [numbers, …]}; names may occur several times."""
    poses = collections.defaultdict(list)
    for line in text.splitlines():
        name, _, numbers = line.partition("\t")
        poses[name].append([float(number) for number in numbers.split()])
    return poses


def tagfield_poses(program, world, model_paths):
    done = subprocess.run([str(program), str(world), *map(str, model_paths)], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        raise RuntimeError(f"Tagfield: {done.stderr.strip() or done.returncode}")
    return poses_in(done.stdout)


def gazebo_poses(plugins, world, model_paths, folder):
    """Poses of the collisions in Gazebo, or None if it does not load the world."""
    out = folder / "poses.txt"
    out.unlink(missing_ok=True)
    home = folder / "home"
    home.mkdir(exist_ok=True)
    env = {**os.environ, "HOME": str(home), "TAGFIELD_POSES": str(out)}
    experiment.gazebo_environment(env, ":".join(map(str, model_paths)), plugins)
    with (folder / "gzserver.log").open("w", encoding="utf-8") as log:
        try:
            subprocess.run([str(IN_GAZEBO), "gzserver", "--verbose", "-s", f"{plugins}/libtagfield_test_poses.so",
                            str(world)], env=env, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                           timeout=SERVER_S, check=False)
        except subprocess.TimeoutExpired:
            return None
    text = out.read_text(encoding="utf-8") if out.exists() else ""
    return poses_in(text[:-len("end\n")]) if text.endswith("end\n") else None


def apart(one, other):
    """The greater of the distances of two poses in position [m] and in their quaternions."""
    turn = min(math.dist(one[3:], other[3:]), math.dist(one[3:], [-part for part in other[3:]]))
    return max(math.dist(one[:3], other[:3]), turn)


def take_nearest_pair(ours, theirs):
    """Removes the two poses nearest to each other from the lists, and returns their distance."""
    one, other = min(itertools.product(ours, theirs), key=lambda pair: apart(*pair))
    ours.remove(one)
    theirs.remove(other)
    return apart(one, other)


def compare(ours, theirs):
    """Compares solids; those with the same name are paired by their poses."""
    agree, words, alone = 0, [], [0, 0]
    for name in sorted({*ours, *theirs}):
        mine, gazebos = list(ours.get(name, [])), list(theirs.get(name, []))
        while mine and gazebos:
            distance = take_nearest_pair(mine, gazebos)
            if distance <= TOLERANCE:
                agree += 1
            else:
                words.append(f"{name} is {distance:.3g} off")
        alone[0] += len(mine)
        alone[1] += len(gazebos)
        words += [f"{name} is Tagfield's alone"] * len(mine) + [f"{name} is Gazebo's alone"] * len(gazebos)
    differ = sum(word.endswith("off") for word in words)
    return Parity(agree, differ, *alone, words)


def as_world(file, folder):
    """The file itself, or a world that includes its model."""
    text = file.read_text(encoding="utf-8", errors="replace")
    if re.search(r"<world[\s>]", text):
        return file
    wrapped = folder / "world.sdf"
    wrapped.write_text(f'<sdf version="1.6"><world name="default"><include><uri>model://{file.parent.name}</uri>'
                       "</include></world></sdf>", encoding="utf-8")
    return wrapped


def parity(file, plugins, program, model_paths, folder):
    """The comparison for a file, or None if Gazebo does not load it."""
    world = as_world(file, folder)
    theirs = gazebo_poses(plugins, world, model_paths, folder)
    return None if theirs is None else compare(tagfield_poses(program, world, model_paths), theirs)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=pathlib.Path, metavar="WORLD_OR_MODEL")
    parser.add_argument("--plugins", type=pathlib.Path, default=TOP / "build/gazebo/lib")
    parser.add_argument("--poses", type=pathlib.Path, default=TOP / "build/release/bin/world_poses")
    parser.add_argument("--model-path", type=pathlib.Path, action="append", default=[])
    parser.add_argument("--list", action="store_true", help="each solid that differs")
    arguments = parser.parse_args()
    sums, loaded, refused = [0, 0, 0, 0], 0, 0
    for file in arguments.files:
        with tempfile.TemporaryDirectory(prefix="world_parity-") as folder:
            try:
                found = parity(file.absolute(), arguments.plugins, arguments.poses,
                               [path.absolute() for path in arguments.model_path], pathlib.Path(folder))
            except RuntimeError as error:
                print(f"{file}: {error}", flush=True)
                refused += 1
                continue
        if found is None:
            print(f"{file}: Gazebo does not load it", flush=True)
            continue
        loaded += 1
        sums = [sum(pair) for pair in zip(sums, found[:4])]
        print(f"{file}: {found.agree} agree, {found.differ} differ, {found.ours_alone} Tagfield's alone, "
              f"{found.theirs_alone} Gazebo's alone", flush=True)
        for word in found.words if arguments.list else []:
            print(f"    {word}")
    print(f"{loaded} files: {sums[0]} solids agree, {sums[1]} differ, {sums[2]} are Tagfield's alone, "
          f"{sums[3]} Gazebo's alone; {refused} files that Gazebo loads and Tagfield refuses")
    sys.exit(1 if refused or any(sums[1:]) else 0)


if __name__ == "__main__":
    main()
