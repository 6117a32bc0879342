#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Replaying the ground truth of a run reproduces its reads byte for byte."""

from common import case, check, check_equal, check_in, main


def replay(context, scenario, folder, antennas, *arguments):
    truth = folder / "truth"
    recorded = [word for antenna in antennas for word in
                ("--set", f"antennas.{antenna}.recorded={truth / 'antenna_poses.csv'}")]
    return context.simulate(scenario, "--no-page", *recorded,
                            "--set", f"tag_recording={truth / 'tags.csv'}", *arguments,
                            name=f"{folder.name}_again")


@case
def replays_give_the_same_reads(context):
    for scenario, antennas in (("paper_warehouse", ["mobile"]), ("z_axis", ["mobile"]),
                               ("two_antennas", ["mobile"]), ("moving_tags", [])):
        folder = context.simulate(scenario, "--no-page", "--seed", "11", name=scenario)
        again = replay(context, scenario, folder, antennas, "--seed", "11")
        for name in ("reads.csv", "truth/antenna_poses.csv", "truth/tags.csv",
                     "truth/distances.csv"):
            check((again / name).read_bytes() == (folder / name).read_bytes(),
                  f"{scenario}: {name} of the replay differs")


@case
def another_seed_gives_other_reads(context):
    folder = context.simulate("paper_warehouse", "--no-page", name="run")
    again = replay(context, "paper_warehouse", folder, ["mobile"], "--seed", "2")
    check((again / "reads.csv").read_bytes() != (folder / "reads.csv").read_bytes(),
          "reads of another seed are the same")


@case
def replays_need_no_robot(context):
    folder = context.simulate("paper_warehouse", "--no-page", name="run")
    scenario = context.write("replay.yaml", """
antennas:
  - {name: mobile, reader: reader_1, recorded: run/truth/antenna_poses.csv, phase_noise_rad: 0.1,
     rssi_noise: 0.01, communication_gain: 3}
tag_recording: run/truth/tags.csv
""")
    again = context.simulate(scenario, name="again")
    check_equal((again / "reads.csv").read_bytes(), (folder / "reads.csv").read_bytes(), "reads.csv")
    check((again / "report.html").exists(), "the replay has no page")


@case
def bad_recordings_are_reported(context):
    poses = "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n"
    for text, says in (("", "other.csv"), (poses + "0,fixed,1,2,3,0,0,0,1\n", "of antenna 'mobile'"),
                       (poses + "1,mobile,1,2,3,0,0,0,1\n0,mobile,1,2,3,0,0,0,1\n", "'mobile'"),
                       (poses + "0,mobile,1,2,3,0,0,0,9\n", "other.csv:2")):
        path = context.write("other.csv", text)
        result = context.run("run", context.shipped("paper_warehouse"),
                             "--set", f"antennas.mobile.recorded={path}")
        check_equal(result.code, 2, f"exit code with {text!r}")
        check_in(says, result.err, "the complaint")
    result = context.run("run", context.shipped("paper_warehouse"),
                         "--set", f"tag_recording={context.folder / 'none.csv'}")
    check_equal(result.code, 2, "exit code without the table")
    check_in("none.csv", result.err, "the complaint")


if __name__ == "__main__":
    main()
