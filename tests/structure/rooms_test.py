#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Layering of the sources: which room (component) may include which, and what is banned from the core.

    rooms_test.py SOURCE_DIR

Checks every .h and .cc of the source tree, then that violations are detected: each rule is broken once in
a small tree, which must give that error and none for other files.
"""

import pathlib
import re
import sys
import tempfile

# In the same order as in docs/architecture.md: a room includes only itself and rooms listed before it.
ROOMS = ["base", "poses", "stream", "epc", "files", "motion", "world", "sdf", "map", "laser",
         "propagation", "channel", "gen2", "reader", "settings", "field", "fit", "localization",
         "tracking", "calibration", "report", "navigation", "scenario", "events", "simulator",
         "planning", "layout", "experiment", "live"]
# Rooms that a room must not include although they are listed before it.
FORBIDDEN = {"localization": {"world", "sdf", "field"}, "tracking": {"world", "sdf", "field"},
             "calibration": {"world", "sdf", "field", "tracking"}, "field": {"files"},
             "report": {"reader", "field"}, "navigation": {"reader", "field", "localization"},
             "scenario": {"report"}}
FOLDERS = ["tagfield", "adapters", "apps", "benchmarks", "examples", "python"]
ROS = ("ros/", "rclcpp/", "rosbag/", "tf2", "tf/", "tagfield_msgs/", "rfid_sensor/", "std_msgs/",
       "geometry_msgs/", "nav_msgs/", "sensor_msgs/", "visualization_msgs/", "rosgraph_msgs/")
GAZEBO = ("gazebo/", "gz/", "ignition/")
ALIENS = (*ROS, *GAZEBO, "mrpt/", "mpi.h")
ROS1 = "adapters/ros1/"
BAGS = "adapters/bags/"
ROS2 = "adapters/ros2/"
CLASSIC = "adapters/gazebo_classic/"
MCAP = "adapters/mcap/"
GZ = "adapters/gz/"
WORLDS = "adapters/gazebo_world/"
COMMON = "adapters/gazebo_common/"
# The only source of the plugin for gz-sim that connects gz-sim and ROS 2.
GZ_JOINT = "adapters/gz/rfid_system.cc"
ROSBAG2 = "adapters/rosbag2/"
ARCHIVE = "adapters/archive/"
MQTT = "adapters/mqtt/"
EPCIS = "adapters/epcis/"
MPI = "adapters/mpi/"
SQLITE = "adapters/sqlite/"
# What adapters for container formats may include.
UNDER_MCAP = (MCAP, "tagfield/base/", "tagfield/files/")
UNDER_ARCHIVE = (ARCHIVE, "tagfield/base/")
UNDER_SQLITE = (SQLITE, "tagfield/base/", "tagfield/files/")
UNDER_ROSBAG2 = (ROSBAG2, MCAP, "tagfield/base/", "tagfield/scenario/yaml_map.h")
# The thin plugin entry points that connect Gazebo and ROS.
JOINTS = "adapters/gazebo_classic/plugins/"
# No room prints, and few read a clock.
QUIET = {
    r"\bstd::c(out|err|log)\b": "prints",
    r"(?<![\w.])(f|v|vf)?printf\s*\(|\b(fmt|std)::print(ln)?\b|\bputs\s*\(": "prints",
    r"\b(system|steady|high_resolution)_clock\b|\bgettimeofday\b|\bclock_gettime\b":
        "looks at a clock",
    r"\bstd::(random_device|mt19937|default_random_engine)\b|(?<![\w.:])s?rand\s*\(":
        "draws random numbers by itself",
    r"<sys/socket\.h>|<netinet/": "opens sockets",
}
# field_worker.cc reports the CPU time of its thread.
QUIET_EXCEPT = {("tagfield/field/field_worker.cc", "looks at a clock")}
# Rooms that publish the ground truth or evaluate by it.
TRUTH_ROOMS = {"stream", "files", "field", "report", "simulator", "planning", "layout", "experiment"}
# The robot's particle filter draws from a generator that is seeded by a RandomStream for each scan.
ALLOWED = {("navigation", "std::mt19937")}
# For real-time pacing, to report the duration of a method, or for the time limit of an exact search.
CLOCK_ROOMS = {"simulator", "layout", "experiment", "live"}

# Compiled as one translation unit each for Gazebo 11 (tagfield_compile_together).
TOGETHER = {"base", "poses", "stream", "epc", "files", "motion", "world", "propagation", "channel", "gen2",
            "reader", "settings", "field"}
LOCAL = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
LOCAL_NAME = re.compile(r"^(?:constexpr|const) [^=({;]*?\b(k\w+)(?=\[| =|\{|\()|"
                        r"^(?:struct|class|enum class|enum) (\w+)[^;\n]*\{", re.MULTILINE)

NAMESPACE = re.compile(r"^namespace ([\w:]+) \{$", re.MULTILINE)
TYPE = re.compile(
    r"^(?:struct|class|union|enum class|enum) (?:alignas\(\w+\) )?(\w+)(?!::)[^;\n:]*(?:: [^\n]*)?\{|^using (\w+) =",
    re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def without_comments(text):
    return COMMENT.sub(lambda match: "\n" * match.group().count("\n"), text)


def room_of(path):
    """The room of a core file, or the top folder of any other file."""
    parts = path.split("/")
    return parts[1] if parts[0] == "tagfield" and len(parts) > 2 else parts[0]


def is_test(path):
    return "test" in path.split("/")[:-1] or path.startswith("tests/")


def line_at(text, offset):
    return text[:offset].count("\n") + 1


def adapter_fault(path, header):
    """Why an adapter must not include `header`, of the project or a third party, or None."""
    if path.startswith(ROS1) and header.startswith((CLASSIC, *GAZEBO)):
        return "adapters/ros1/ knows no Gazebo"
    if path.startswith(BAGS) and header.startswith((CLASSIC, ROS1, *GAZEBO)):
        return "adapters/bags/ knows neither Gazebo nor a running ROS"
    if path.startswith(ROS2) and header.startswith((CLASSIC, ROS1, *GAZEBO)):
        return "adapters/ros2/ knows neither Gazebo nor ROS 1"
    if (path.startswith(CLASSIC) and not path.startswith(JOINTS) and not is_test(path) and
            header.startswith((ROS1, *ROS))):
        return "of adapters/gazebo_classic/ only plugins/ knows ROS"
    if path.startswith(WORLDS) and header.startswith(ALIENS):
        return "adapters/gazebo_world/ knows neither Gazebo nor ROS"
    if path.startswith((GZ, COMMON)) and header.startswith((CLASSIC, ROS1, "gazebo/")):
        return "adapters/gz/ and gazebo_common/ know neither Gazebo 11 nor ROS 1"
    if path.startswith((GZ, COMMON)) and path != GZ_JOINT and header.startswith((ROS2, *ROS)):
        return "of adapters/gz/ only rfid_system.cc knows ROS 2"
    if path.startswith(MCAP) and (header.startswith(ALIENS) or header.split("/")[0] in FOLDERS and
                                  not header.startswith(UNDER_MCAP)):
        return "adapters/mcap/ knows neither RFID nor ROS"
    if path.startswith(ARCHIVE) and (header.startswith(ALIENS) or header.split("/")[0] in FOLDERS and
                                     not header.startswith(UNDER_ARCHIVE)):
        return "adapters/archive/ knows neither RFID nor ROS"
    if path.startswith(MPI) and header.split("/")[0] in FOLDERS and not header.startswith(MPI):
        return "adapters/mpi/ knows nothing but MPI"
    if path.startswith(SQLITE) and header.split("/")[0] in FOLDERS and not header.startswith(UNDER_SQLITE):
        return "adapters/sqlite/ knows nothing but tables"
    if path.startswith((MQTT, EPCIS)) and header.startswith((CLASSIC, ROS1, ROS2, *ALIENS)):
        return "adapters/mqtt/ and epcis/ know neither Gazebo nor ROS"
    if path.startswith(ROSBAG2) and (header.startswith(ALIENS) or header.split("/")[0] in FOLDERS and
                                     not header.startswith(UNDER_ROSBAG2)):
        return "adapters/rosbag2/ knows neither RFID nor messages"
    return None


def order_fault(path, header):
    """Why `path` must not include the project's `header`, or None."""
    if not path.startswith("tagfield/"):
        folder, other = path.split("/")[0], header.split("/")[0]
        if header.startswith("tagfield/experiment/") and folder == "adapters":
            return "adapters/ must not know experiment/"
        if other in ("tagfield", folder) or (folder == "apps" and other == "adapters"):
            return None
        if folder == "python" and other == "apps":
            return None  # For the same arguments and messages as the command.
        return f"{folder}/ must not include it"
    if not header.startswith("tagfield/"):
        return "a room must not include it"
    room, other = room_of(path), room_of(header)
    if other not in ROOMS:
        return f"{other} is no room of docs/architecture.md"
    if other == room:
        return None
    if room in ROOMS and ROOMS.index(other) > ROOMS.index(room):
        return f"{other}/ is below {room}/"
    if other in FORBIDDEN.get(room, ()):
        return f"{room}/ must not know {other}/"
    return None


def may_see_truth(path):
    if path.startswith("tagfield/"):
        return room_of(path) in TRUTH_ROOMS
    return path.startswith(("adapters/", "apps/", "examples/", "python/"))


def include_faults(path, text):
    for match in INCLUDE.finditer(text):
        quote, header = match.groups()
        place = f"{path}:{line_at(text, match.start())}: includes {header}"
        own = header.split("/")[0] in FOLDERS and quote == '"'
        fault = (order_fault(path, header) if own else None) or adapter_fault(path, header)
        if fault:
            yield f"{place}: {fault}"
        if own and "/internal/" in header and room_of(header) != room_of(path):
            yield f"{place}: internal to another room"
        if own and "/test/" in header and not is_test(path):
            yield f"{place}: a test's helper"
        if header.startswith("sdf/") and not path.startswith((CLASSIC, GZ, COMMON)):
            yield f"{place}: only the plugins for Gazebo include sdformat"
        if (header.startswith(ALIENS) and
                not path.startswith(("adapters/", "tests/gazebo/", "tests/gz/"))):
            yield f"{place}: no ROS, Gazebo, MRPT or MPI here"
        if (header.endswith(("/truth.h", "/truth_csv.h")) and not may_see_truth(path) and
                not is_test(path)):
            yield f"{place}: only who makes the truth or judges by it may see it"


def word_faults(path, text):
    bare = without_comments(text)
    if path.startswith("tagfield/") and not is_test(path):
        for pattern, what in QUIET.items():
            match = re.search(pattern, bare)
            if what == "looks at a clock" and room_of(path) in CLOCK_ROOMS:
                continue
            if match and (room_of(path), match.group()) in ALLOWED:
                continue
            if match and (path, what) not in QUIET_EXCEPT:
                yield f"{path}:{line_at(bare, match.start())}: a room {what}: {match.group()}"


# With only a path as argument, these functions throw on errors of the system.
THROWS = re.compile(r"\b(?:fs|std::filesystem)::(?:exists|is_regular_file|is_directory)"
                    r"\((?!status\)|fs::symlink_status\()(?:[^(),]|\([^()]*\))*\)")


def path_faults(path, text):
    if path.startswith("tests/") or is_test(path):
        return
    bare = without_comments(text)
    for match in THROWS.finditer(bare):
        yield f"{path}:{line_at(bare, match.start())}: throws: {match.group()}, use base/file_kind.h"


def header_faults(path, text):
    if not path.endswith(".h"):
        return
    if "#pragma once" not in text:
        yield f"{path}:1: has no #pragma once"
    if not re.match(r"(// SPDX-[^\n]*\n)?/// @file\n/// \S", text):
        yield f"{path}:1: does not begin with '/// @file' and what it is"
    match = re.search(r"^using namespace", text, re.MULTILINE)
    if match:
        yield f"{path}:{line_at(text, match.start())}: using namespace in a header"


def types_of(path, text):
    """Types that a header defines for its includers: (name with namespace, file and line)."""
    if not path.endswith(".h"):
        return
    space = NAMESPACE.search(text)
    for match in TYPE.finditer(text):
        name = match.group(1) or match.group(2)
        if is_test(path) and match.group(2):
            continue  # an alias in a test's header
        yield f"{space.group(1)}::{name}" if space else name, f"{path}:{line_at(text, match.start())}"


def repeated_types(files):
    """Types with the same name, which violate the one-definition rule and confuse readers."""
    seen = {}
    for path, text in files:
        for name, place in types_of(path, text):
            if name in seen:
                yield f"{place}: defines {name}, as {seen[name]} does"
            seen[name] = place


def repeated_local_names(files):
    """Constants and types in anonymous namespaces of one room with the same name, which clash where its
    sources are compiled together."""
    seen = {}
    for path, text in files:
        if not path.startswith("tagfield/") or room_of(path) not in TOGETHER or is_test(path):
            continue
        for match in (name for local in LOCAL.finditer(text) for name in
                      LOCAL_NAME.finditer(text, local.start(1), local.end(1))):
            name = match.group(1) or match.group(2)
            first = seen.setdefault((room_of(path), name), path)
            if first != path:
                yield f"{path}:{line_at(text, match.start())}: defines {name}, as {first} does"


def sources(root):
    """Every .h and .cc of the project: (path from the top, text)."""
    for folder in [*FOLDERS, "tests"]:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".h", ".cc") and path.is_file():
                yield str(path.relative_to(root)), path.read_text(encoding="utf-8")


def table_faults(text):
    """Faults of the table of rooms in docs/architecture.md."""
    rows = re.findall(r"^\| `tagfield/(\w+)/` \| (.*) \|$", text, re.MULTILINE)
    if [room for room, _ in rows] != ROOMS:
        yield f"docs/architecture.md: its rooms are not, in this order, {', '.join(ROOMS)}"
    for room, clause in rows:
        if len(clause) > 80 or re.search(r"[;.(]", clause):
            yield f"docs/architecture.md: {room}/ is not one plain clause: {clause}"


def link_faults(path, text):
    """Rooms that a room's CMake target links although they are listed after it."""
    room = room_of(path)
    for other in re.findall(r"tagfield::(\w+)", without_tests(text)):
        if other in ROOMS and ROOMS.index(other) > ROOMS.index(room):
            yield f"{path}: links {other}/, which is below {room}/"


def without_tests(cmake):
    """A room's CMakeLists.txt without its tests."""
    return re.sub(r"^if\(TAGFIELD_TESTS\)$.*?^endif\(\)$", "", cmake, flags=re.MULTILINE | re.DOTALL)


def faults(root):
    found = []
    table = root / "docs/architecture.md"
    if table.exists():
        found.extend(table_faults(table.read_text(encoding="utf-8")))
    for path in sorted((root / "tagfield").glob("*/CMakeLists.txt")):
        if path.parent.name in ROOMS:
            found.extend(link_faults(str(path.relative_to(root)), path.read_text(encoding="utf-8")))
    rooms = sorted(path.name for path in (root / "tagfield").iterdir() if path.is_dir())
    for room in rooms:
        if room not in ROOMS:
            found.append(f"tagfield/{room}: is no room of docs/architecture.md")
    for path, text in sources(root):
        for rule in (include_faults, word_faults, path_faults, header_faults):
            found.extend(rule(path, text))
    found.extend(repeated_types(sources(root)))
    found.extend(repeated_local_names(sources(root)))
    return found


# --- Detection of planted faults ------------------------------------------------------------------

GOOD = {
    "tagfield/base/error.h": "/// @file\n/// Errors.\n#pragma once\n",
    "tagfield/world/scene.h": '/// @file\n/// A scene.\n#pragma once\n'
                              '#include "tagfield/base/error.h"\n',
    "tagfield/files/csv.cc": '#include "tagfield/base/error.h"\n// std::cout is not used here\n'
                             "void f(char* b) { snprintf(b, 1, \"\"); }\n",
    "tagfield/stream/truth.h": "/// @file\n/// The truth.\n#pragma once\nnamespace tagfield {\n"
                               "struct Truth {\n",
    "tagfield/report/page.h": "/// @file\n/// A page.\n#pragma once\nnamespace tagfield::page {\n"
                              "struct Truth {\n",
    "tagfield/world/room.h": "/// @file\n/// A room.\n#pragma once\nnamespace tagfield {\nstruct Truth;\n",
    "tagfield/stream/test/truth_test.cc": '#include "tagfield/stream/truth.h"\n'
                                          "void g() { std::cout << 1; }\n",
    "tagfield/simulator/run.cc": '#include "tagfield/stream/truth.h"\n#include <chrono>\n'
                                 "auto now = std::chrono::steady_clock::now();\n",
    "tagfield/experiment/bench/run_bench.cc": '#include "tagfield/simulator/run.h"\n'
                                              '#include "tagfield/stream/truth.h"\n',
    "apps/tagfield/main.cc": '#include "tagfield/simulator/run.h"\n#include "adapters/bags/bag.h"\n'
                             'int main() { printf("x"); }\n',
    "adapters/bags/bag.cc": '#include <rosbag/bag.h>\n#include <tagfield_msgs/TagReads.h>\n'
                            '#include "tagfield/stream/truth.h"\n',
    "adapters/gazebo_classic/field.cc": '#include <gazebo/gazebo.hh>\n#include <sdf/sdf.hh>\n'
                                        '#include "tagfield/base/error.h"\n',
    "tagfield/files/kind.cc": "bool a = fs::exists(path, error) || fs::is_directory(status);\n"
                              "bool b = fs::exists(fs::symlink_status(path / x, error));\n",
    "tagfield/reader/antenna.cc": "namespace {\nconstexpr double kNear = 1.0;\nstruct Lobe {\n}  // namespace\n",
    "tagfield/channel/antenna.cc": "namespace {\nconstexpr double kNear = 2.0;\n}  // namespace\n",
    "adapters/mcap/writer.cc": '#include "adapters/mcap/records.h"\n'
                               '#include "tagfield/base/error.h"\n#include <zstd.h>\n',
    "adapters/gazebo_classic/plugins/a.cc": '#include "adapters/ros1/link.h"\n'
                                            '#include "adapters/gazebo_classic/field.h"\n',
}
PLANTED = (  # a file, its content, part of the expected message
    ("tagfield/base/a.cc", '#include "tagfield/world/scene.h"\n', "world/ is below base/"),
    ("tagfield/channel/a.cc", '#include "tagfield/reader/antenna.h"\n', "reader/ is below channel/"),
    ("tagfield/report/a.cc", '#include "tagfield/simulator/run.h"\n', "simulator/ is below report/"),
    ("tagfield/simulator/a.cc", '#include "tagfield/experiment/bench/bench.h"\n',
     "experiment/ is below simulator/"),
    ("tagfield/files/a.cc", '#include "apps/tagfield/table.h"\n', "a room must not include it"),
    ("tagfield/simulator/a.cc", '#include "adapters/bags/bag.h"\n', "a room must not include it"),
    ("adapters/ros1/a.cc", '#include "tagfield/experiment/bench/bench.h"\n',
     "adapters/ must not know experiment/"),
    ("tagfield/localization/a.cc", '#include "tagfield/world/scene.h"\n',
     "localization/ must not know world/"),
    ("tagfield/scenario/a.cc", '#include "tagfield/report/page.h"\n',
     "scenario/ must not know report/"),
    ("tagfield/localization/a.cc", '#include "tagfield/stream/truth.h"\n', "may see it"),
    ("apps/tagfield/a.cc", "bool a = fs::exists(folder / name());\n", "use base/file_kind.h"),
    ("tagfield/world/a.cc", "#include <sdf/Root.hh>\n",
     "only the plugins for Gazebo include sdformat"),
    ("benchmarks/a.cc", '#include "tagfield/stream/truth.h"\n', "may see it"),
    ("tagfield/simulator/a.cc", '#include "tagfield/sdf/internal/poses.h"\n',
     "internal to another room"),
    ("tagfield/report/a.cc", '#include "tagfield/base/test/statistics.h"\n', "a test's helper"),
    ("tagfield/simulator/a.cc", "#include <ros/ros.h>\n", "no ROS"),
    ("tagfield/navigation/a.cc", "#include <mrpt/random.h>\n", "no ROS"),
    ("apps/tagfield/a.cc", "#include <rosbag/bag.h>\n", "no ROS"),
    ("apps/tagfield/a.cc", "#include <tagfield_msgs/TagReads.h>\n", "no ROS"),
    ("apps/tagfield/a.cc", "#include <gazebo/gazebo.hh>\n", "no ROS"),
    ("adapters/ros1/a.cc", '#include "adapters/gazebo_classic/field.h"\n', "knows no Gazebo"),
    ("adapters/ros1/a.cc", "#include <gazebo/gazebo.hh>\n", "knows no Gazebo"),
    ("adapters/bags/a.cc", '#include "adapters/ros1/ros_link.h"\n', "neither Gazebo nor a running ROS"),
    ("adapters/ros2/a.cc", '#include "adapters/ros1/ros_link.h"\n', "neither Gazebo nor ROS 1"),
    ("adapters/gazebo_classic/a.cc", '#include "adapters/ros1/link.h"\n', "only plugins/"),
    ("adapters/gazebo_world/a.cc", "#include <ros/ros.h>\n", "neither Gazebo nor ROS"),
    ("adapters/gz/a.cc", "#include <gazebo/gazebo.hh>\n", "neither Gazebo 11 nor ROS 1"),
    ("adapters/gazebo_common/a.cc", '#include "adapters/gazebo_classic/field.h"\n',
     "neither Gazebo 11 nor ROS 1"),
    ("adapters/gz/a.cc", '#include "adapters/ros2/dds_sink.h"\n', "only rfid_system.cc"),
    ("adapters/mcap/a.cc", '#include "tagfield/stream/truth.h"\n', "knows neither RFID nor ROS"),
    ("adapters/mcap/a.cc", '#include "adapters/bags/bag.h"\n', "knows neither RFID nor ROS"),
    ("adapters/mcap/a.cc", "#include <rosbag/bag.h>\n", "knows neither RFID nor ROS"),
    ("adapters/mqtt/a.cc", '#include "adapters/ros2/cdr.h"\n', "know neither Gazebo nor ROS"),
    ("adapters/epcis/a.cc", "#include <ros/ros.h>\n", "know neither Gazebo nor ROS"),
    ("adapters/archive/a.cc", '#include "tagfield/stream/tag_read.h"\n',
     "adapters/archive/ knows neither RFID nor ROS"),
    ("adapters/mpi/a.cc", '#include "tagfield/base/error.h"\n', "knows nothing but MPI"),
    ("adapters/sqlite/a.cc", '#include "tagfield/stream/tag_read.h"\n', "knows nothing but tables"),
    ("adapters/rosbag2/a.cc", '#include "adapters/ros2/cdr.h"\n', "knows neither RFID nor messages"),
    ("adapters/ros1/a.cc", '#include "apps/tagfield/table.h"\n', "adapters/ must not include it"),
    ("tagfield/world/a.h", "/// @file\n/// It.\n#pragma once\nusing namespace std;\n",
     "using namespace"),
    ("tagfield/world/a.h", "/// @file\n/// It.\n", "#pragma once"),
    ("tagfield/world/a.h", "#pragma once\n", "/// @file"),
    ("tagfield/world/a.cc", "void f() { std::cout << 1; }\n", "prints"),
    ("tagfield/simulator/a.cc", 'void f() { std::printf("x"); }\n', "prints"),
    ("tagfield/world/a.cc", 'void f() { fmt::print("x"); }\n', "prints"),
    ("tagfield/world/a.cc", "auto t = std::chrono::system_clock::now();\n", "looks at a clock"),
    ("tagfield/world/a.cc", "std::random_device device;\n", "random numbers"),
    ("tagfield/world/a.h",
     "/// @file\n/// It.\n#pragma once\nnamespace tagfield {\nstruct Truth final {\n",
     "defines tagfield::Truth, as tagfield/stream/truth.h:5 does"),
    ("tagfield/world/a.h",
     "/// @file\n/// It.\n#pragma once\nnamespace tagfield {\nusing Truth = int;\n",
     "defines tagfield::Truth, as tagfield/stream/truth.h:5 does"),
    ("tagfield/reader/gain.cc", "namespace {\nconstexpr int kNear = 2;\n}  // namespace\n",
     "defines kNear, as tagfield/reader/antenna.cc does"),
    ("tagfield/reader/gain.cc", "namespace {\nclass Lobe {\n}  // namespace\n",
     "defines Lobe, as tagfield/reader/antenna.cc does"),
    ("tagfield/kitchen/a.cc", "\n", "kitchen: is no room"),
    ("tagfield/world/CMakeLists.txt", "LINKS tagfield::base tagfield::reader\n",
     "links reader/, which is below world/"),
    ("docs/architecture.md", "| `tagfield/base/` | units |\n", "its rooms are not"),
)


def write_tree(root, files):
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def blind_spots():
    """Planted faults that this test does not detect."""
    with tempfile.TemporaryDirectory(prefix="rooms_test-") as folder:
        root = pathlib.Path(folder) / "good"
        write_tree(root, GOOD)
        for fault in faults(root):
            yield f"complains of a good tree: {fault}"
        for number, (name, text, says) in enumerate(PLANTED):
            root = pathlib.Path(folder) / str(number)
            write_tree(root, {**GOOD, name: text})
            found = faults(root)
            elsewhere = [fault for fault in found if not fault.startswith(name.rsplit("/", 1)[0])]
            if elsewhere or not any(says in fault for fault in found):
                yield f"{name} with {text!r} gives {found}, expected one with {says!r}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    count = sum(1 for _ in sources(root))
    found = [*faults(root), *blind_spots()]
    if count < 50:
        found.append(f"only {count} files were found under {root}: looked in the wrong place?")
    for fault in found:
        print(fault)
    print(f"{count} files and {len(PLANTED)} planted faults, {len(found)} failures")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
