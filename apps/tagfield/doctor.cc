// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <sstream>

#include "adapters/ros2/dds_sink.h"
#include "adapters/ros2/domain.h"
#include "apps/tagfield/build_info.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/shared_folder.h"
#include "tagfield/base/error.h"
#include "tagfield/base/lanes.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

/// Something that Tagfield can use, and whether it is available.
struct Ability {
  std::string key;         ///< "gazebo".
  bool works = false;      ///< It was tried and works.
  std::string what;        ///< What was found, or is missing.
  std::string how_to_get;  ///< If missing: a command, or where to read about it.
};

// --- System queries ----------------------------------------------------------

/// Output of a command, without the trailing line end; none if it fails or takes longer than a
/// minute. `command` is a literal from this file.
std::optional<std::string> output_of(const std::string& command) {
  flush_output();
  // The memory limit of this program must not apply to others, some of which reserve a lot and use
  // little.
  const std::string line = fmt::format(
      "ulimit -S -d unlimited 2>/dev/null; exec timeout 60 sh -c '{}' 2>/dev/null </dev/null",
      command);
  std::FILE* const pipe = ::popen(line.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string output;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
    output.append(block.data(), count);
  }
  if (::pclose(pipe) != 0) return std::nullopt;
  while (!output.empty() && output.back() == '\n') output.pop_back();
  return output;
}

/// Whether a program of that name is on the PATH.
bool is_on_path(const std::string& program) {
  return output_of("command -v " + program).has_value();
}

std::string first_match(const std::string& text, const char* pattern) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : "";
}

/// A figure of /proc/meminfo [GB].
std::optional<double> memory_gb(const std::string& key) {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    double kilobytes = 0.0;
    if (words >> name >> kilobytes && name == key + ":") return kilobytes * 1024.0 / 1e9;
  }
  return std::nullopt;
}

// --- Checks ------------------------------------------------------------------

Ability machine() {
  const char* const kNames[] = {"the baseline only", "AVX2", "AVX-512"};
  const std::optional<double> total = memory_gb("MemTotal");
  const std::optional<double> left = memory_gb("MemAvailable");
  return {
      "machine", true,
      fmt::format(
          "{} threads, {}vector instructions: {}", default_threads(),
          total && left ? fmt::format("{:.1f} of {:.1f} GB of memory free, ", *left, *total) : "",
          kNames[static_cast<std::size_t>(instruction_sets().back())]),
      ""};
}

Ability shared_files() {
  std::error_code error;
  std::string missing;
  for (const char* name : {"profiles", "scenarios", "worlds", "models", "templates"}) {
    if (!fs::is_directory(shared_folder(name), error)) missing += fmt::format(" {}", name);
  }
  const std::string place = shared_folder("scenarios").parent_path().string();
  if (missing.empty()) return {"files", true, "scenarios, worlds and profiles in " + place, ""};
  return {"files", false, fmt::format("missing in {}:{}", place, missing),
          "install Tagfield again"};
}

Ability gazebo() {
  const std::optional<std::string> version = output_of("gzserver --version");
  const std::string number = first_match(version.value_or(""), "version (11\\.[0-9.]*[0-9])");
  if (!number.empty()) return {"gazebo", true, "Gazebo " + number, ""};
  const char* const given_root = std::getenv("TAGFIELD_GAZEBO_ROOT");
  const fs::path root = given_root != nullptr ? fs::path(given_root)
                                              : fs::path(TAGFIELD_SOURCES) / "build/gazebo-root";
  std::error_code error;
  if (fs::exists(root / "etc/tagfield-packages", error)) {
    return {"gazebo", true,
            fmt::format("Gazebo 11 in a Debian 11 in {} (scripts/in-gazebo)", root.string()), ""};
  }
  return {"gazebo", false, "no Gazebo 11",
          "in a source tree: scripts/gazebo-root (docs/gazebo.md)"};
}

Ability gz_sim() {
  for (const char* command : {"gz sim --versions", "ign gazebo --versions"}) {
    const std::string number =
        first_match(output_of(command).value_or(""), "([0-9]+\\.[0-9.]*[0-9])");
    if (!number.empty()) return {"gz-sim", true, "gz-sim " + number, ""};
  }
  return {"gz-sim", false, "no gz-sim (Fortress or later)",
          "https://gazebosim.org/docs, then docs/gz.md"};
}

Ability ros1() {
  if (!is_on_path("roscore")) {
    return {"roscore", false, "no ROS 1 to run nodes with (roscore); rosbags need none",
            "apt-get install python3-roslaunch, where the system has ROS 1"};
  }
  return {"roscore", true,
          "ROS 1; ROS_MASTER_URI is " + output_of("printenv ROS_MASTER_URI").value_or("not set"),
          ""};
}

/// The network interface that Cyclone DDS uses here, from its own log when a node joins.
std::string dds_interfaces() {
  const fs::path log =
      fs::temp_directory_path() / fmt::format("tagfield-doctor-{}.log", ::getpid());
  const char* const own = std::getenv("CYCLONEDDS_URI");
  const std::string before = own == nullptr ? "" : own;
  const std::string uri = fmt::format(
      "{}{}<CycloneDDS><Domain><Tracing><Category>config</Category><OutputFile>{}</OutputFile></"
      "Tracing>"
      "</Domain></CycloneDDS>",
      before, before.empty() ? "" : ",", log.string());
  ::setenv("CYCLONEDDS_URI", uri.c_str(), 1);
  const auto tell = [&]() -> std::string {
    const ros2::DdsSink node(ros2::domain_of_environment(), "tagfield_doctor");
    return read_text_file(log.string());
  };
  std::string text;
  try {
    text = tell();
  } catch (...) {
    std::error_code error;
    fs::remove(log, error);
    throw;
  }
  std::error_code error;
  fs::remove(log, error);
  return first_match(text, "selected interfaces?:? *([^\\n]*)");
}

Ability ros2_messages() {
  if (!ros2::kHasDds) {
    return {"ros2", false, "built without ROS 2",
            "build with -DTAGFIELD_ROS2=ON and cyclonedds-dev"};
  }
  try {
    const std::string interfaces = dds_interfaces();
    const bool installed = is_on_path("ros2");
    return {
        "ros2", true,
        fmt::format("a node joined domain {} through Cyclone DDS{}; {}",
                    ros2::domain_of_environment(), interfaces.empty() ? "" : " on " + interfaces,
                    installed ? "ROS 2 is installed" : "ROS 2 itself is not installed, nor needed"),
        ""};
  } catch (const Error& error) {
    return {"ros2", false, error.what(), "docs/ros2.md, about CYCLONEDDS_URI"};
  }
}

/// Checks WebGL by drawing a triangle in a headless browser.
Ability browser() {
  std::string program;
  for (const char* name :
       {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"}) {
    if (program.empty() && is_on_path(name)) program = name;
  }
  if (program.empty()) {
    return {"browser", false,
            "no Chromium here to try WebGL in; pages open in any browser with WebGL 2",
            "apt-get install chromium"};
  }
  const std::string folder =
      (fs::temp_directory_path() / fmt::format("tagfield-doctor-{}", ::getpid())).string();
  const std::string command = fmt::format(
      "{} --headless=new --no-first-run {}--enable-unsafe-swiftshader --user-data-dir={} "
      "--dump-dom "
      "\"data:text/"
      "html,<script>c=document.createElement(\\\"canvas\\\").getContext(\\\"webgl2\\\");"
      "document.title=c?c.getParameter(c.VERSION):0</script>\"",
      program, ::geteuid() == 0 ? "--no-sandbox " : "", folder);
  const std::string version =
      first_match(output_of(command).value_or(""), "<title>(WebGL 2[^<]*)</title>");
  std::error_code error;
  fs::remove_all(folder, error);
  if (version.empty()) {
    return {"browser", false, program + " is installed, but does not draw WebGL 2",
            "open pages in another browser, or on another machine"};
  }
  return {"browser", true, fmt::format("{} draws {}", program, version), ""};
}

Ability mpi(const BuildInfo& build) {
  bool built = false;
  for (const OptionalPart& part : build.parts) built = built || (part.key == "mpi" && part.present);
  if (!built) return {"mpi", false, "built without MPI", "libopenmpi-dev, then build again"};
  if (!is_on_path("mpirun")) return {"mpi", false, "no mpirun", "apt-get install openmpi-bin"};
  const std::string version = output_of("mpirun --version").value_or("");
  return {"mpi", true, version.substr(0, version.find('\n')), ""};
}

/// An interpreter of Python, and which modules it finds.
struct PythonFound {
  std::string program;  ///< Its path.
  std::string line;     ///< Path, version and modules, for people.
  bool has_tagfield = false;
};

/// Asks an interpreter by its name or path; none if there is none.
std::optional<PythonFound> python_found(const std::string& program) {
  constexpr const char* kAsk =
      "import importlib, sys\n"
      "sys.path = [path for path in sys.path if path]\n"  // Not to import source folders.
      "print(sys.executable, sys.version.split()[0])\n"
      "for name in (\"tagfield\", \"numpy\", \"pandas\", \"matplotlib\"):\n"
      "    try:\n"
      "        print(name, importlib.import_module(name).__version__)\n"
      "    except ImportError:\n"
      "        print(name, \"missing\")\n";
  const std::optional<std::string> answer =
      output_of(fmt::format("exec {} -c \"{}\"", program,
                            std::regex_replace(std::string(kAsk), std::regex("\""), "\\\"")));
  if (!answer) return std::nullopt;
  const std::string line = std::regex_replace(*answer, std::regex("\n"), ", ");
  const auto says = [&](const char* what) { return line.find(what) != std::string::npos; };
  return PythonFound{line.substr(0, line.find(' ')), line,
                     !says("tagfield missing") && !says("numpy missing")};
}

/// Debian's packages are for /usr/bin/python3, which need not be the first on the PATH.
Ability python() {
  constexpr const char* kSystem = "/usr/bin/python3";
  const std::optional<PythonFound> first = python_found("python3");
  if (first && first->has_tagfield) return {"python", true, first->line, ""};
  const bool is_system = first && first->program == kSystem;
  const std::optional<PythonFound> system = is_system ? first : python_found(kSystem);
  if (!first && !system) return {"python", false, "no python3", "apt-get install python3"};
  if (system && system->has_tagfield) {
    return {"python", true,
            system->line + (first ? "; not the first python3 on the PATH: " + first->line : ""),
            ""};
  }
  const std::string package = "apt-get install python3-tagfield";
  if (!first || is_system) {
    return {"python", false, system->line, package + ", or docs/python.md from sources"};
  }
  return {"python", false, first->line + (system ? "; " + system->line : ""),
          fmt::format("{} for {}; docs/python.md for {}", package, kSystem, first->program)};
}

std::vector<Ability> abilities(const BuildInfo& build) {
  std::vector<Ability> all = {machine(), shared_files()};
  for (const OptionalPart& part : build.parts) {
    if (part.key == "mpi" || part.key == "ros2") continue;  // Checked in more detail below.
    all.push_back({part.key, part.present,
                   part.present ? part.is_for : "built without " + part.is_for,
                   part.present ? "" : part.needs});
  }
  for (const Ability& ability :
       {ros2_messages(), mpi(build), python(), ros1(), gazebo(), gz_sim(), browser()}) {
    all.push_back(ability);
  }
  return all;
}

// --- Output ------------------------------------------------------------------

void print_abilities(const BuildInfo& build, const std::vector<Ability>& all) {
  fmt::print("tagfield {}, commit {}\n\nWorks:\n", build.version,
             build.commit.empty() ? "unknown" : build.commit);
  for (const Ability& ability : all) {
    if (ability.works) fmt::print("  {:<9} {}\n", ability.key, ability.what);
  }
  bool first = true;
  for (const Ability& ability : all) {
    if (ability.works) continue;
    if (first) fmt::print("\nNot here, and how to get it if it is wanted:\n");
    first = false;
    fmt::print("  {:<9} {}\n            {}\n", ability.key, ability.what, ability.how_to_get);
  }
}

void print_abilities_json(const BuildInfo& build, const std::vector<Ability>& all) {
  nlohmann::ordered_json json = {{"version", build.version},
                                 {"commit", build.commit},
                                 {"findings", nlohmann::ordered_json::array()}};
  for (const Ability& ability : all) {
    json["findings"].push_back({{"key", ability.key},
                                {"works", ability.works},
                                {"what", ability.what},
                                {"how_to_get", ability.how_to_get}});
  }
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

void add_doctor_command(CLI::App& app, Action& chosen) {
  const auto as_json = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("doctor", "Show what works on this machine, and how to get the rest");
  add_json_option(*command, *as_json);
  command->footer(
      "Nothing is guessed: programs are asked for their versions, a node joins the ROS 2 domain\n"
      "for a moment, and Chromium, if installed, draws in WebGL. Nothing is changed.");
  command->callback([as_json, &chosen] {
    chosen = [as_json] {
      const BuildInfo build = build_info();
      const std::vector<Ability> all = abilities(build);
      *as_json ? print_abilities_json(build, all) : print_abilities(build, all);
      return kExitOk;
    };
  });
}

}  // namespace tagfield
