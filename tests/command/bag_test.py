# SPDX-License-Identifier: Apache-2.0
"""`tagfield localize` and `report` of a rosbag: the same as of the tables that the bag was made from,
and one clear line for a bag that is no good."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
# pylint: disable=wrong-import-position
import bags
from bags import RunBag, message_types, require_rosbag, write_bag
from common import (case, check, check_between, check_equal, check_in, check_near, files_in, main,
                    position, read_csv, read_json)

TABLES = ["reads.csv", "truth/antenna_poses.csv", "truth/tags.csv", "truth/distances.csv"]


def odometry_run(context, scenario="paper_warehouse", **options):
    """A run whose robot believes its wheels, and the bag of it. They are so good that their drift, of
    which a bag says nothing, is not what decides which tags are located."""
    require_rosbag()
    folder = context.simulate(scenario, "--no-page", "--set", "pose.source=odometry",
                              "--set", "pose.wheel_noise=0.0005")
    bag = RunBag(context.source, folder)
    return folder, write_bag(context.folder / "run.bag", bag.messages(**options))


@case
def a_bag_gives_what_its_tables_give(context):
    folder, bag = odometry_run(context)
    result = context.run_well("localize", bag, "--scenario", context.shipped("paper_warehouse"),
                              "--out", "bag")
    out = context.folder / "bag"
    for name in TABLES:
        check_equal((out / name).read_bytes(), (folder / name).read_bytes(), name)
    context.run_well("localize", folder / "reads.csv", "--poses",
                     folder / "truth/antenna_poses.csv", "--tag-heights",
                     folder / "tag_heights.csv", "--method", "hyperbola", "--out", "tables")
    check_equal(sorted(map(tuple, map(dict.items, read_csv(out / "estimates.csv")))),
                sorted(map(tuple, map(dict.items,
                                      read_csv(context.folder / "tables/estimates.csv")))),
                "the estimates")
    summary = read_json(out / "summary.json")
    run = read_json(folder / "summary.json")
    check_equal(summary["pose"], "true", "pose")
    check_equal([tag["id"] for tag in summary["tags"]], [tag["id"] for tag in run["tags"]],
                "the order of tags")
    check_near(summary["error_m"]["mean"], run["pose_error"]["error_with_true_pose_m"]["mean"],
               1e-4, "the mean error with the true pose")
    check_between(summary["error_m"]["max"], 0.0, 0.3, "the greatest error")
    # The comparison: the same reads with poses by wheel odometry, as in the run itself.
    compared = summary["compared_pose"]
    check_equal(compared["pose"], "odometry", "compared_pose.pose")
    check_equal(compared["located"], run["located"], "compared_pose.located")
    check_near(compared["position_rms_m"], run["pose_error"]["position_rms_m"], 1e-6,
               "compared_pose.position_rms_m")
    check_near(compared["error_m"]["mean"], run["error_m"]["mean"], 1e-4,
               "compared_pose.error_m.mean")
    check_near(summary["path_length_m"], run["path_length_m"], 0.1, "path_length_m")
    check_near(summary["simulated_s"], run["simulated_s"], 0.2, "simulated_s")
    check_in("pose: true; with odometry, ", result.out, "the table")
    page = (out / "report.html").read_text(encoding="utf-8")
    check_in("The same reads with other antenna poses, wheel odometry", page, "the page")
    check_in("as the robot believed", page, "the page")
    check((out / "top_view.json").exists(), "the scenario's world is not there")


@case
def a_bag_is_located_in_parts_as_its_tables_are(context):
    folder, bag = odometry_run(context)
    known = ["--tag-heights", folder / "tag_heights.csv", "--method", "hyperbola"]
    context.run_well("localize", bag, *known, "--out", "whole")
    result = context.run_well("localize", bag, *known, "--part-reads", 3000, "--out", "parts")
    whole, parts = context.folder / "whole", context.folder / "parts"
    for name in ("estimates.csv", "antenna_poses.csv", *TABLES):
        check_equal((parts / name).read_bytes(), (whole / name).read_bytes(), name)
    check_equal(set(files_in(parts)) ^ set(files_in(whole)), {"compared_poses.csv"}, "the files")
    summary = read_json(parts / "summary.json")
    check_equal(summary["error_m"], read_json(whole / "summary.json")["error_m"], "the errors")
    check_in("its reads are processed in parts: with the poses 'true' alone, without a comparison with others",
             result.err, "what it says")
    context.run_well("localize", bag, *known, "--part-reads", 0, "--out", "at_once")
    check_equal((context.folder / "at_once/summary.json").read_bytes(),
                (whole / "summary.json").read_bytes(), "the summary of all at once")


@case
def poses_can_be_chosen(context):
    folder, bag = odometry_run(context)
    heights = ["--tag-heights", folder / "tag_heights.csv"]
    for words, pose, other in ((["tf"], "odometry", "true"), (["odometry"], "odometry", "true"),
                               (["true"], "true", "odometry"),
                               (["tf", "--frame", "odom"], "odometry", "true")):
        context.run_well("localize", bag, "--poses", *words, *heights, "--out", "out_poses")
        summary = read_json(context.folder / "out_poses/summary.json")
        check_equal(summary["pose"], pose, f"{words}: pose")
        check_equal(summary["compared_pose"]["pose"], other, f"{words}: the other")
        warned = any("they are taken to be the same" in line for line in summary["warnings"])
        check_equal(warned, "--frame" in words, f"{words}: warned of different frames")
    run = read_json(folder / "summary.json")
    context.run_well("localize", bag, "--poses", "tf", *heights, "--method", "hyperbola", "--out",
                     "tf")
    check_equal(read_json(context.folder / "tf/summary.json")["error_m"]["count"],
                run["error_m"]["count"], "located with odometry")


@case
def truth_judges_and_does_not_help(context):
    folder, bag = odometry_run(context, "two_antennas")
    write_bag(context.folder / "blind.bag",
              RunBag(context.source, folder).messages(truth=False))
    heights = ["--tag-heights", folder / "tag_heights.csv"]
    context.run_well("localize", bag, "--poses", "tf", *heights, "--out", "seeing")
    context.run_well("localize", "blind.bag", *heights, "--out", "blind")
    seeing, blind = context.folder / "seeing", context.folder / "blind"
    check_equal({row["tag"]: row["x_m"] for row in read_csv(seeing / "estimates.csv")},
                {row["tag"]: row["x_m"] for row in read_csv(blind / "estimates.csv")},
                "the estimates")
    check(not (blind / "truth").exists(), "a truth was made up")
    summary = read_json(blind / "summary.json")
    check_equal((summary["pose"], summary["compared_pose"], summary["error_m"]),
                ("odometry", None, None), "pose, compared_pose, error_m")


@case
def report_draws_a_page_from_a_bag(context):
    _, bag = odometry_run(context, "two_antennas")
    result = context.run_well("report", bag)
    check_in("page: runs/run/report.html", result.out, "what is printed")
    context.run_well("localize", bag, "--out", "localized")
    check_equal(files_in(context.folder / "runs/run"), files_in(context.folder / "localized"),
                "report's folder")
    context.run_well("report", bag, "--out", "elsewhere")
    check((context.folder / "elsewhere/report.html").exists(), "no page in --out")
    context.run_well("report", context.folder / "elsewhere")
    result = context.run("report", context.folder / "elsewhere", "--out", "x")
    check_equal(result.code, 2, "exit code of report FOLDER --out")


@case
def moving_tags_have_no_one_place(context):
    folder, bag = odometry_run(context, "moving_tags")
    context.run_well("localize", bag, "--scenario", context.shipped("moving_tags"), "--out", "bag")
    moved = [{tag["id"]: tag["moved"] for tag in read_json(where / "summary.json")["tags"]}
             for where in (context.folder / "bag", folder)]
    check_equal(moved[0], moved[1], "which tags moved")
    # A run has one row per update, the results of a bag one per change.
    last = {}
    changes = []
    for row in read_csv(folder / "truth/tags.csv"):
        if last.get(row["tag"]) != position(row):
            last[row["tag"]] = position(row)
            changes.append(row)
    check(read_csv(context.folder / "bag/truth/tags.csv") == changes,
          "truth/tags.csv does not hold the changes of place")


@case
def the_published_plugins_bag_is_read(context):
    folder, _ = odometry_run(context)
    types = message_types(context.source)
    distances = {(row["stamp_s"], row["tag"]): float(row["distance_m"])
                 for row in read_csv(folder / "truth/distances.csv")}
    reads = {}
    for row in read_csv(folder / "reads.csv"):
        reads.setdefault(row["stamp_s"], []).append(row)
    messages = []
    for row in read_csv(folder / "truth/antenna_poses.csv"):
        stamp = bags.time_of(row["stamp_s"])
        tags = [types["rfid_sensor/Tag"](read["tag"], distances[(row["stamp_s"], read["tag"])],
                                         float(read["phase_rad"]), float(read["rssi_dbm"]))
                for read in reads.get(row["stamp_s"], [])]
        messages.append(("/gazebo/mobile/data", stamp, types["rfid_sensor/TagArray"](
            bags.Header(0, stamp, "world"), bags.pose_of(row), len(tags), tags)))
    write_bag(context.folder / "published.bag", messages)
    result = context.run_well("localize", "published.bag", "--tag-heights",
                              folder / "tag_heights.csv", "--out", "published")
    check_in("865.7 MHz is assumed", result.err, "the warnings")
    run = read_json(folder / "summary.json")
    check_equal(read_json(context.folder / "published/summary.json")["located"],
                run["pose_error"]["error_with_true_pose_m"]["count"], "located")
    result = context.run("localize", "published.bag", "--frequency", "865.7e6", "--tag-heights",
                         folder / "tag_heights.csv", "--out", "published")
    check_equal(result.err, "", "warnings where the frequency is given")
    for words, assumed in (([], True), (["--frequency", "865.7e6"], False)):
        result = context.run_well("track", "published.bag", *words, "--out", "tracked")
        check_equal("865.7 MHz is assumed" in result.err, assumed, f"track {words}: {result.err}")


def files_with_times(folder):
    """Every file under a folder with its size and modification time."""
    return {path: (path.stat().st_size, path.stat().st_mtime_ns) for path in folder.rglob("*")}


def expect_complaint(context, arguments, *parts):
    """Expects exit code 2, one line with all `parts`, and no files written."""
    before = files_with_times(context.folder)
    result = context.run(*arguments, "--out", context.folder / "never")
    check_equal(result.code, 2, f"{arguments}: exit code")
    lines = result.err.strip().split("\n")
    check_equal(len(lines), 1, f"{arguments}: lines of {result.err!r}")
    for part in ("tagfield: ", *parts):
        check_in(part, lines[0], f"{arguments}: the complaint")
    check_equal(files_with_times(context.folder), before, f"{arguments}: the folder")


@case
def bad_bags_get_one_line(context):
    folder, bag = odometry_run(context, "two_antennas")
    whole = bag.read_bytes()
    types = message_types(context.source)
    context.write("empty.bag", b"")
    context.write("text.bag", "stamp_s,antenna\n")
    (context.folder / "folder.bag").mkdir()
    for share in (0.001, 0.3, 0.9, 0.999):
        context.write(f"torn{share}.bag", whole[:int(share * len(whole))])
    write_bag(context.folder / "nothing.bag", [])
    nan = types["tagfield_msgs/TagReads"](bags.Header(0, bags.genpy.Time(1, 0), "a"), "a", [
        types["tagfield_msgs/TagRead"](bags.Header(0, bags.genpy.Time(1, 0), "a"), "t", "", "a",
                                       865.7e6, float("nan"), -50.0, 0.0)])
    write_bag(context.folder / "nan.bag", [("/rfid/reads", bags.genpy.Time(1, 0), nan)])
    poseless = RunBag(context.source, folder).messages(truth=False, belief=False)
    write_bag(context.folder / "poseless.bag", poseless)
    # A truncated recording, as rosbag leaves it before it writes the index.
    unindexed = bytearray(whole)
    place = unindexed.index(b"index_pos=") + len(b"index_pos=")
    unindexed[place:place + 8] = bytes(8)
    context.write("unindexed.bag", bytes(unindexed))
    for command in ("localize", "report"):
        expect_complaint(context, [command, "none.bag"], "none.bag: no such file")
        expect_complaint(context, [command, "empty.bag"], "empty.bag: is empty")
        expect_complaint(context, [command, "text.bag"], "is not a rosbag")
        expect_complaint(context, [command, "folder.bag"], "is a folder")
        expect_complaint(context, [command, "nothing.bag"], "has no reads")
        expect_complaint(context, [command, "unindexed.bag"], "rosbag reindex")
        expect_complaint(context, [command, "nan.bag"],
                         "nan.bag: topic /rfid/reads, message 1: reads[0].phase is nan")
        expect_complaint(context, [command, "poseless.bag"], "has no poses of the antennas")
        for share in (0.001, 0.3, 0.9, 0.999):
            expect_complaint(context, [command, f"torn{share}.bag"], f"torn{share}.bag: is cut off")


@case
def messages_received_at_time_0_are_counted(context):
    folder, _ = odometry_run(context, "two_antennas")
    zero = bags.genpy.Time(0, 0)
    messages = [(topic, zero if i < 5 else receipt, message) for i, (topic, receipt, message) in
                enumerate(RunBag(context.source, folder).messages())]
    write_bag(context.folder / "zero.bag", messages, earliest=zero)
    result = context.run_well("localize", "zero.bag", "--out", "zero")
    count = sum(receipt == zero for _, receipt, _ in messages)
    check_in(f"zero.bag: {count} of its messages were received at time 0 and are left out", result.err, "warning")
    # What is missing then may be among them.
    static = [(topic, zero if topic == "/tf_static" else receipt, message)
              for topic, receipt, message in RunBag(context.source, folder).messages(truth=False)]
    write_bag(context.folder / "static.bag", static, earliest=zero)
    expect_complaint(context, ["localize", "static.bag", "--frame", "world"],
                     "has no poses of the antennas", "of its messages were received at time 0")


@case
def gaps_of_transforms_are_not_bridged(context):
    """As in a table of poses, reads where an antenna moved between poses over 0.5 s apart are left out."""
    folder, _ = odometry_run(context, "two_antennas")
    messages = RunBag(context.source, folder).messages(truth=False)
    last = messages[-1][1].to_sec()
    with_gap = [entry for entry in messages
                if entry[0] != "/tf" or not 0.4 * last < entry[1].to_sec() < 0.4 * last + 2.0]
    write_bag(context.folder / "gap.bag", with_gap)
    result = context.run_well("localize", "gap.bag", "--out", "gap")
    check_in("reads have no pose at their stamp and are left out: its poses there are over 0.5 s apart",
             result.err, "warning")
    stamps = [float(row["stamp_s"]) for row in read_csv(context.folder / "gap/antenna_poses.csv")]
    inside = [stamp for stamp in stamps if 0.4 * last + 0.1 < stamp < 0.4 * last + 1.9]
    check_equal(inside, [], "poses in the gap")


@case
def units_of_recordings_are_doubted(context):
    folder, _ = odometry_run(context, "two_antennas")
    run_bag = RunBag(context.source, folder)
    for name, factor, says in (
            ("mhz", (1e-6, 1.0), "mhz.bag: the carrier of a read is 865.7, expected a carrier in Hz, from "
                                 "1e+06 to 1e+11: is it in MHz?"),
            ("degrees", (1.0, 57.3), "degrees.bag: the phase of a read is 3")):
        messages = run_bag.messages()
        for topic, _, message in messages:
            for read in message.reads if topic == "/rfid/reads" else []:
                read.frequency *= factor[0]
                read.phase *= factor[1]
        write_bag(context.folder / f"{name}.bag", messages)
        check_in(says, context.run("localize", f"{name}.bag", "--out", name).err, "warnings")


@case
def options_without_effect_on_a_recording_are_told(context):
    _, bag = odometry_run(context, "two_antennas")
    expect_complaint(context, ["localize", bag, "--frame", "nix"],
                     "--frame nix: there are no transforms (tf) from 'nix' to the frames of the reads")
    result = context.run_well("localize", bag, "--frequency", "866e6", "--out", "out")
    check_in("--frequency has no effect: its reads state their carriers", result.err, "warning")


@case
def compressed_files_are_named_so(context):
    for name, says in (("a.bag.gz", "gunzip a.bag.gz"), ("a.mcap.zst", "zstd -d a.mcap.zst"),
                       ("a_0.db3.zstd", "zstd -d a_0.db3.zstd")):
        context.write(name, b"packed")
        for command in ("localize", "track", "check"):
            arguments = [command, name] if command == "check" else [command, name, "--out", "never"]
            result = context.run(*arguments)
            check_equal(result.code, 2, f"{arguments}: exit code")
            check_in(f"{name}: is compressed as a whole: decompress it first ({says})", result.err,
                     f"{arguments}: complaint")


@case
def bad_options_get_one_line(context):
    folder, bag = odometry_run(context, "two_antennas", truth=False)
    expect_complaint(context, ["localize", bag, "--poses", "poses.csv"], "auto, true, tf or odom")
    expect_complaint(context, ["localize", bag, "--poses", "true"], "has no true antenna poses")
    expect_complaint(context, ["localize", bag, "--frame", "moon"], "from 'moon'")
    expect_complaint(context, ["localize", bag, "--frequency", "0"], "--frequency")
    expect_complaint(context, ["track", bag, "--frame", "moon"], "from 'moon'")
    for words in (["--frame", "map"], ["--frequency", "866e6"]):
        says = f"track: {words[0]} can only be used with a recording of ROS"
        expect_complaint(context, ["track", folder, *words], says)
        expect_complaint(context, ["track", context.source / "scenarios/two_antennas.yaml", *words], says)
    expect_complaint(context, ["localize", bag, "--scenario", "none.yaml"], "none.yaml")
    expect_complaint(context, ["localize", folder / "reads.csv"], "--poses")
    expect_complaint(context, ["localize", folder / "reads.csv", "--poses",
                               folder / "antenna_poses.csv", "--frame", "map"], "--frame")


@case
def nothing_of_an_earlier_run_stays(context):
    folder, bag = odometry_run(context, "two_antennas")
    context.run_well("localize", bag, "--scenario", context.shipped("two_antennas"), "--out", "o")
    write_bag(context.folder / "blind.bag",
              RunBag(context.source, folder).messages(truth=False))
    context.run_well("localize", "blind.bag", "--out", "o")
    left = {name.split("/")[0] for name in files_in(context.folder / "o")}
    check_equal(left, {"reads.csv", "antenna_poses.csv", "corrected_poses.csv", "estimates.csv",
                       "summary.json", "report.html", "figures"}, "what is in the folder")


if __name__ == "__main__":
    main()
