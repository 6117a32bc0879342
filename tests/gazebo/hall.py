# SPDX-License-Identifier: Apache-2.0
"""A hall of metal, brick and meshes in which both Gazebos and the headless simulator give equal reads."""

import itertools

from common import read_csv

SECONDS = 5.0
# Columns of reads.csv; Doppler is not in the messages.
COMPARED = ("stamp_s", "reader", "antenna", "tag", "frequency_hz", "phase_rad", "rssi_dbm")


def solid(name, pose, *shapes):
    """A static model with one collision per shape."""
    collisions = "".join(f'<collision name="part_{i}"><pose>{at}</pose><geometry>{shape}</geometry>'
                         f'</collision>' for i, (at, shape) in enumerate(shapes))
    return (f'<model name="{name}"><static>1</static><pose>{pose}</pose><link name="link">'
            f'<pose>0.1 0 0 0 0 0.05</pose>{collisions}<visual name="skin"><geometry><box>'
            f'<size>1 1 1</size></box></geometry><material><script><name>Gazebo/WoodPallet</name>'
            f'</script></material></visual></link></model>')


def box(x, y, z):
    return f"<box><size>{x} {y} {z}</size></box>"


def hall(folder, scale):
    """The hall's file: floor, walls, a metal rack, a pillar, a tank, and a crate from a mesh file."""
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
              ("0 0 0.2 0 0 0", f"<mesh><uri>file://{mesh}</uri><scale>{scale}</scale></mesh>")))
    path = folder / "hall.world"
    path.write_text('<?xml version="1.0"?><sdf version="1.6"><world name="hall"><physics type="ode">'
                    '<max_step_size>0.001</max_step_size><real_time_update_rate>0'
                    '</real_time_update_rate></physics><gravity>0 0 0</gravity>'
                    f'{"".join(parts)}</world></sdf>', encoding="utf-8")
    return path


def stl_box(x, y, z):
    """A box around the origin in the text form of STL."""
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


def scenario(context, model, settings, *, scale="1.5 1 -2", cart="transmit_power_dbm: 27, "):
    """Static tags on all sides of the rack and a moving one; a static gate and a moving cart. The scale
    mirrors the crate."""
    tags = [f"  - {{id: tag_{i}, position: [{x}, {y}, {z}]}}" for i, (x, y, z) in enumerate(
        itertools.product((-2.5, 1.2, 3.4), (-1.5, 0.5, 3.0), (0.7, 1.9)))]
    tilted = "" if model == "paper" else ", sensitivity_dbm: -20"
    return context.write(f"{model}.yaml", f"""\
name: physics
seed: 21
duration_s: {SECONDS}
model: {model}
world:
  path: {hall(context.folder, scale)}
  materials: {{rack: metal, "*wall": brick, crate: slats, Gazebo/None: glass}}
  default_material: plasterboard
materials:
  - {{name: slats, permittivity: 2.1, conductivity_s_m: 0.004, wall_m: 0.02}}
antennas:
  - {{name: gate, reader: r1, pose: [-4, -1, 2.2, 0, 0.2, 0.3], {settings}}}
  - {{name: cart, reader: r1, pose: [-3, 4, 1, 0, 0, -0.6], {cart}{settings}}}
tags:
{chr(10).join(tags)}
  - {{id: tilted, position: [0, -1, 1], rpy: [0.4, 0, 1]{tilted}}}
  - {{id: mover, position: [-2, 4.5, 1.2]}}
""")


def headless(context, path, run):
    """Runs the scenario headless with the poses from Gazebo."""
    again = context.folder / f"{path.stem}_again"
    recorded = [word for antenna in ("gate", "cart") for word in
                ("--set", f"antennas.{antenna}.recorded={run}/truth/antenna_poses.csv")]
    # The last update is one step of physics behind the end.
    context.run_well("run", path, "--out", again, "--no-page", *recorded, "--set",
                     f"tag_recording={run}/truth/tags.csv", "--set", f"duration_s={SECONDS + 1}")
    return again


def reads_in(folder):
    """The reads, sorted, as the order of antennas that update at the same stamp is undefined."""
    return sorted(tuple(row[name] for name in COMPARED) for row in read_csv(folder / "reads.csv"))
