#!/usr/bin/python3
"""Physical models in Gazebo read what the headless simulator reads, with Gazebo's own geometry."""

import itertools

from gazebo import (
    Run, case, check, check_equal, check_in, check_near, insert, main, read_csv, remove, schedule)

SECONDS = 5.0
# Of reads.csv; Doppler is not in the messages.
COMPARED = ("stamp_s", "reader", "antenna", "tag", "frequency_hz", "phase_rad", "rssi_dbm")


def solid(name, pose, *shapes):
    """A static model, a collision a shape."""
    collisions = "".join(f'<collision name="part_{i}"><pose>{at}</pose><geometry>{shape}</geometry>'
                         f'</collision>' for i, (at, shape) in enumerate(shapes))
    return (f'<model name="{name}"><static>1</static><pose>{pose}</pose><link name="link">'
            f'<pose>0.1 0 0 0 0 0.05</pose>{collisions}<visual name="skin"><geometry><box>'
            f'<size>1 1 1</size></box></geometry><material><script><name>Gazebo/WoodPallet</name>'
            f'</script></material></visual></link></model>')


def box(x, y, z):
    return f"<box><size>{x} {y} {z}</size></box>"


def hall(folder):
    """The hall's file: floor, walls, a metal rack, a pillar, a tank, and a crate from a mesh's file."""
    mesh = folder / "crate.stl"
    mesh.write_text(stl_box(0.5, 1.0, 0.75), encoding="utf-8")
    rack = [("0 0 {} 0 0 0".format(height), box(0.8, 4.0, 0.05)) for height in (0.5, 1.5, 2.5)]
    parts = (
        solid("floor", "0 0 0 0 0 0",
              ("0 0 0 0 0 0", "<plane><normal>0 0 1</normal><size>50 50</size></plane>")),
        solid("north_wall", "0 6 1.5 0 0 0", ("0 0 0 0 0 0", box(14, 0.2, 3))),
        solid("east_wall", "6 0 1.5 0 0 1.5707963", ("0 0 0 0 0 0", box(12, 0.2, 3))),
        solid("rack", "2.5 1 0 0 0 0.2", *rack, ("0.4 0 1.5 0 0 0", box(0.02, 4.0, 3.0))),
        solid("pillar", "-1.5 2 1.5 0 0 0",
              ("0 0 0 0 0.1 0", "<cylinder><radius>0.3</radius><length>3</length></cylinder>")),
        solid("tank", "-3 -2 1 0 0 0", ("0 0 0 0 0 0", "<sphere><radius>0.6</radius></sphere>")),
        solid("crate", "0.5 -3 0.5 0 0 0.7",
              ("0 0 0.2 0 0 0", f"<mesh><uri>file://{mesh}</uri><scale>1.5 1 -2</scale></mesh>")))
    path = folder / "hall.world"
    path.write_text('<?xml version="1.0"?><sdf version="1.6"><world name="hall"><physics type="ode">'
                    '<max_step_size>0.001</max_step_size><real_time_update_rate>0'
                    '</real_time_update_rate></physics><gravity>0 0 0</gravity>'
                    f'{"".join(parts)}</world></sdf>', encoding="utf-8")
    return path


def stl_box(x, y, z):
    """A box around the origin as an STL file's text."""
    corners = [tuple(sign * size / 2 for sign, size in zip(signs, (x, y, z)))
               for signs in itertools.product((-1, 1), repeat=3)]
    faces = ((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6),
             (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3))
    lines = ["solid box"]
    for face in faces:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex {} {} {}".format(*corners[i]) for i in face]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid box", ""])


def scenario(context, model, settings):
    """Tags at rest on all sides of the rack, one that moves; a gate at rest and a cart that moves."""
    tags = [f"  - {{id: tag_{i}, position: [{x}, {y}, {z}]}}" for i, (x, y, z) in enumerate(
        itertools.product((-2.5, 1.2, 3.4), (-1.5, 0.5, 3.0), (0.7, 1.9)))]
    return context.write(f"{model}.yaml", f"""\
name: physics
seed: 21
duration_s: {SECONDS}
model: {model}
world:
  path: {hall(context.folder)}
  materials: {{rack: metal, "*wall": brick, crate: slats, Gazebo/None: glass}}
  default_material: plasterboard
materials:
  - {{name: slats, permittivity: 2.1, conductivity_s_m: 0.004, wall_m: 0.02}}
antennas:
  - {{name: gate, reader: r1, pose: [-4, -1, 2.2, 0, 0.2, 0.3], {settings}}}
  - {{name: cart, reader: r1, pose: [-3, 4, 1, 0, 0, -0.6], transmit_power_dbm: 27, {settings}}}
tags:
{chr(10).join(tags)}
  - {{id: tilted, position: [0, -1, 1], rpy: [0.4, 0, 1], sensitivity_dbm: -20}}
  - {{id: mover, position: [-2, 4.5, 1.2]}}
""")


def in_gazebo(context, path, events="", pace=0):
    """Runs the scenario in Gazebo, with the cart and one tag on their way; gives the located run's
    folder, what Gazebo said, and the schedule's log."""
    world = context.folder / f"{path.stem}.world"
    context.run_well("gazebo", path, "--out", world, "--real-time", pace)
    folder = context.folder / path.stem
    log = context.folder / f"{path.stem}.log"
    motions = ('<move time="0" model="cart" velocity="0.6 -0.15 0"/>'
               '<move time="1" model="mover" velocity="0.8 -0.4 0.1"/>')
    text = world.read_text(encoding="utf-8").replace(
        "</world>", schedule(log, motions + events, stop=SECONDS) + "</world>")
    with Run(context, text, name=path.stem, record=True) as running:
        running.finish(log)
        said = running.log()
    ours = [line for line in said.split("\n") if "[Err]" in line and "plugin" in line]
    check_equal(ours, [], "the plugins' errors")
    context.run_well("localize", folder / "run.bag", "--scenario", path, "--out",
                     folder / "located")
    return folder / "located", said, log.read_text(encoding="utf-8")


def headless(context, path, run):
    """The poses that Gazebo produced, replayed."""
    again = context.folder / f"{path.stem}_again"
    recorded = [word for antenna in ("gate", "cart") for word in
                ("--set", f"antennas.{antenna}.recorded={run}/truth/antenna_poses.csv")]
    # The last update is one step of physics behind the end.
    context.run_well("run", path, "--out", again, "--no-page", *recorded, "--set",
                     f"tag_recording={run}/truth/tags.csv", "--set", f"duration_s={SECONDS + 1}")
    return again


def reads_in(folder):
    """Sorted, as antennas that update at one stamp have no order among them."""
    return sorted(tuple(row[name] for name in COMPARED) for row in read_csv(folder / "reads.csv"))


def check_parity(context, model, settings, least):
    path = scenario(context, model, settings)
    run, _, _ = in_gazebo(context, path)
    expected = reads_in(run)
    actual = reads_in(headless(context, path, run))
    check(len(expected) >= least, f"only {len(expected)} reads")
    check_equal({read[2] for read in expected}, {"gate", "cart"}, "antennas that read")
    check("mover" in {read[3] for read in expected}, "the tag that moves was never read")
    odd = sorted(set(expected) ^ set(actual))
    check(len(actual) == len(expected),
          f"{len(actual)} reads in the replay, {len(expected)} in Gazebo; in one alone: {odd[:3]}")
    differing = [pair for pair in zip(expected, actual) if pair[0] != pair[1]]
    check(not differing, f"{len(differing)} of {len(expected)} reads differ, as {differing[:2]}")
    return expected


@case
def the_link_budget_is_the_same(context):
    check_parity(context, "link_budget", "channel_plan: etsi_low", 500)


@case
def multipath_of_order_two_is_the_same(context):
    reads = check_parity(context, "multipath", "reflection_order: 2, channel_plan: fcc", 500)
    check(len({read[4] for read in reads}) > 5, "the carriers don't hop")


INVENTORY = "inventory: gen2, session: s0, target: alternate, port_dwell_s: 0.3"


@case
def the_link_budget_with_inventory_is_the_same(context):
    reads = check_parity(context, "link_budget", INVENTORY, 300)
    check(len({read[0] for read in reads}) == len(reads), "reads of an inventory share stamps")


@case
def multipath_with_inventory_is_the_same(context):
    check_parity(context, "multipath", f"{INVENTORY}, encoding: miller4, diffuse_k_db: 8", 300)


@case
def without_noise_and_steps_the_waves_are_the_same(context):
    path = scenario(context, "multipath", "without: [noise, quantization, half_turns]")
    run, _, _ = in_gazebo(context, path)
    expected = reads_in(run)
    actual = reads_in(headless(context, path, run))
    check(len(expected) > 500, f"only {len(expected)} reads")
    odd = sorted(set(expected) ^ set(actual))
    check(len(actual) == len(expected),
          f"{len(actual)} reads in the replay, {len(expected)} in Gazebo; in one alone: {odd[:3]}")
    for one, other in zip(expected, actual):
        check_equal(other[:5], one[:5], "stamp, antenna, tag and carrier")
        check_near(float(other[5]), float(one[5]), 1e-6, f"phase of {one}")
        check_near(float(other[6]), float(one[6]), 1e-6, f"power of {one}")


def seconds_of(events, log):
    """When the schedule saw an event [s]."""
    return [int(line.split()[0]) * 1e-9 for line in log.split("\n") if line.endswith(events)][0]


@case
def models_that_come_and_go_shade_the_tags(context):
    """A metal screen around the gate for a second; what can move is no wall."""
    screen = solid("metal_screen", "-3.8 -1 2.2 0 0 0", ("0 0 0 0 0 0", box(0.02, 8, 8)))
    loose = solid("loose", "-3.7 -1 2.2 0 0 0", ("0 0 0 0 0 0", box(0.02, 3, 3)))
    loose = loose.replace("<static>1</static>", "")
    path = scenario(context, "link_budget", "channel_plan: etsi_low")
    events = insert(1, loose) + insert(2, screen) + remove(3, "metal_screen")
    # Gazebo lets models come and go ten times a second of wall time.
    run, said, log = in_gazebo(context, path, events, pace=1)
    stamps = [float(read[0]) for read in reads_in(run) if read[2] == "gate"]
    comes, goes = seconds_of("+ metal_screen", log), seconds_of("- metal_screen", log)
    check(seconds_of("+ loose", log) < comes - 0.2 < goes - 0.4 < SECONDS - 0.6, log)
    for begin, end, is_open in ((0, comes, True), (comes, goes, False), (goes, SECONDS, True)):
        found = [stamp for stamp in stamps if begin < stamp < end]
        check(bool(found) == is_open, f"{len(found)} reads from {begin} s to {end} s")
    check_in("materials are guessed from names", said, "the log")


if __name__ == "__main__":
    main()
