# SPDX-License-Identifier: Apache-2.0
"""Synthetic tables of reads and poses, generated from equations, for tests of the commands.

Independent of the simulator: phase = 4 pi r/lambda + offset + noise, for a static or moving tag that is
read by an antenna on a path. Also the Cramér-Rao bound of such reads.
"""

import cmath
import csv
import math
import pathlib
import subprocess

C = 299792458.0
FCC = [902.75e6 + 0.5e6 * i for i in range(50)]
RAIL_CHANNELS = [920.625e6 + 0.5e6 * i for i in range(8)]
TURN = 2 * math.pi


def rail(stops=50, step=0.02, time_apart=0.2):
    """Times and positions along a straight rail."""
    return [(i * time_apart, (i * step, 0.0)) for i in range(stops)]


def circle(radius=1.5, rate=15.0, speed=0.3):
    count = int(TURN * radius / speed * rate)
    return [(i / rate, (radius * math.cos(TURN * i / count), radius * math.sin(TURN * i / count)))
            for i in range(count)]


def straight(length=6.0, rate=15.0, speed=0.3):
    return [(i / rate, (speed * i / rate, 0.0)) for i in range(int(length / speed * rate))]


def one_channel(way, _random):
    return [(t, p, 866.9e6) for t, p in way]


def sequential(way, _random):
    """Passes along the complete path, one per channel, in order of time."""
    last = way[-1][0] + 1.0
    return [(t + last * c, p, carrier) for c, carrier in enumerate(RAIL_CHANNELS) for t, p in way]


def interleaved(way, _random):
    """The channel changes from read to read."""
    return [(t, p, RAIL_CHANNELS[i % len(RAIL_CHANNELS)]) for i, (t, p) in enumerate(way)]


def all_at_each(way, _random):
    """All channels at each position."""
    return [(t + 0.01 * c, p, carrier) for t, p in way for c, carrier in enumerate(RAIL_CHANNELS)]


def hopping(way, random, dwell=0.4):
    """FCC hopping: the next of 50 channels every `dwell` seconds."""
    order = FCC[:]
    random.shuffle(order)
    return [(t, p, order[int(t / dwell) % len(order)]) for t, p in way]


def offsets_of(random):
    """Phase offsets by channel, each drawn at its first use."""
    drawn = {}
    return lambda carrier: drawn.setdefault(carrier, random.uniform(0, TURN))


def phase_of(r, carrier, offset, sign=1.0):
    return sign * 2 * TURN * r * carrier / C + offset


def read_tag(visits, place, random, sigma=0.1, offset=None, velocity=(0.0, 0.0)):
    """Rows (t, p, carrier, phase, rssi) of a tag."""
    offset = offset or offsets_of(random)
    rows = []
    for t, p, carrier in visits:
        r = math.dist((place[0] + velocity[0] * t, place[1] + velocity[1] * t), p)
        rows.append((t, p, carrier, phase_of(r, carrier, offset(carrier)) + random.gauss(0, sigma),
                     -40 - 40 * math.log10(max(r, 0.05)) + random.gauss(0, 1)))
    return rows


def with_phase(rows, change):
    return [(t, p, carrier, change(phase), rssi) for t, p, carrier, phase, rssi in rows]


def outliers(rows, share, random):
    return with_phase(rows, lambda phase: random.uniform(0, TURN) if random.random() < share
                      else phase)


def pi_ambiguity(rows, random):
    return with_phase(rows, lambda phase: phase + math.pi * random.randrange(2))


def stepped(rows):
    return with_phase(rows, lambda phase: round(phase / TURN * 4096) * TURN / 4096)


def write(folder, tags, poses=None):
    """Writes reads.csv and poses.csv of `tags` (rows by ID), in order of time; `poses` are (t, p), by
    default those of the rows."""
    folder = pathlib.Path(folder)
    with open(folder / "reads.csv", "w", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow("stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm".split(","))
        every = [(tag, row) for tag, rows in tags.items() for row in rows]
        for tag, (t, _, carrier, phase, rssi) in sorted(every, key=lambda read: read[1][0]):
            out.writerow([f"{t:.6f}", "r", "a", tag, f"{carrier:.0f}", f"{phase % TURN:.6f}",
                          f"{rssi:.1f}"])
    poses = poses or sorted({(round(t, 6), p) for rows in tags.values() for t, p, *_ in rows})
    with open(folder / "poses.csv", "w", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow("stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw".split(","))
        for t, p in poses:
            out.writerow([f"{t:.6f}", "a", f"{p[0]:.6f}", f"{p[1]:.6f}", 0, 0, 0, 0, 1])


def write_room(folder, tags, antennas, references=None):
    """Likewise for fixed antennas, with rows (t, antenna, carrier, phase, rssi) and positions of antennas
    by name; positions of reference tags are written to references.csv."""
    folder = pathlib.Path(folder)
    with open(folder / "reads.csv", "w", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow("stamp_s,antenna,tag,frequency_hz,phase_rad,rssi_dbm".split(","))
        for tag, rows in tags.items():
            for t, antenna, carrier, phase, rssi in rows:
                out.writerow([f"{t:.6f}", antenna, tag, f"{carrier:.0f}", f"{phase % TURN:.6f}",
                              f"{rssi:.1f}"])
    with open(folder / "poses.csv", "w", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow("stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw".split(","))
        for name, p in antennas.items():
            out.writerow([0, name, p[0], p[1], 0, 0, 0, 0, 1])
    with open(folder / "references.csv", "w", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow("tag,x_m,y_m,z_m".split(","))
        for tag, p in (references or {}).items():
            out.writerow([tag, p[0], p[1], 0])


def read_in_room(places, antennas, random, sigma=0.1, fading=3.0):
    """Rows of tags that each fixed antenna reads twice on each of 50 channels, with phase offsets per
    antenna and channel; RSSI has a fading term per antenna and tag."""
    offsets = {name: offsets_of(random) for name in antennas}
    tags = {}
    for tag, place in places.items():
        rows = []
        for name, p in antennas.items():
            r = math.dist(place, p)
            rssi = -42 - 34 * math.log10(r) + random.gauss(0, fading)
            for i in range(100):
                carrier = FCC[i % 50]
                rows.append((0.05 * i, name, carrier, phase_of(r, carrier, offsets[name](carrier)) +
                             random.gauss(0, sigma), rssi))
        tags[tag] = rows
    return tags


def estimates(folder):
    """Rows of estimates.csv by tag, best candidate first."""
    found = {}
    with open(pathlib.Path(folder) / "estimates.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["tag"], []).append(row)
    return found


def localize(program, folder, *arguments):
    """The estimates and the output of the command."""
    folder = pathlib.Path(folder)
    result = subprocess.run([program, "localize", folder / "reads.csv", "--poses",
                             folder / "poses.csv", "--out", folder / "out", *arguments],
                            capture_output=True, text=True, check=True)
    return estimates(folder / "out"), result.stdout + result.stderr


def bound_trace(rows, place, sigma):
    """Trace of the Cramér-Rao bound of x and y [m²], with an unknown phase offset per channel."""
    channels = {}
    for _, p, carrier, *_ in rows:
        channels.setdefault(carrier, []).append(p)
    xx = xy = yy = 0.0
    for carrier, places in channels.items():
        k = 2 * TURN * carrier / C
        slopes = []
        for p in places:
            r = math.dist(p, place)
            slopes.append((k * (place[0] - p[0]) / r, k * (place[1] - p[1]) / r))
        mean = [sum(s[i] for s in slopes) / len(slopes) for i in range(2)]
        for gx, gy in slopes:
            gx, gy = gx - mean[0], gy - mean[1]
            xx, xy, yy = xx + gx * gx, xy + gx * gy, yy + gy * gy
    return sigma**2 * (xx + yy) / (xx * yy - xy * xy)


def echoed(rows, place, echo, strength):
    """Phases and RSSI of a tag with a second propagation path from the image `echo`."""
    changed = []
    for t, p, carrier, phase, rssi in rows:
        k = TURN * carrier / C
        wave = (cmath.rect(1 / math.dist(p, place), k * math.dist(p, place)) +
                cmath.rect(strength / math.dist(p, echo), k * math.dist(p, echo)))
        direct = cmath.rect(1 / math.dist(p, place), k * math.dist(p, place))
        ratio = (wave / direct)**2
        changed.append((t, p, carrier, phase + cmath.phase(ratio),
                        rssi + 20 * math.log10(max(abs(ratio), 1e-6))))
    return changed
