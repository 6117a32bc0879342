// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/outlet_arguments.h"

#include <fmt/format.h>

#include <thread>

#include "adapters/ros2/domain.h"
#include "adapters/ros2/mcap_file.h"
#include "adapters/ros2/ros2_outlet.h"
#include "adapters/ros2/ros2_robot.h"
#include "adapters/ros2/tee_sink.h"
#include "apps/tagfield/speed_option.h"
#include "tagfield/base/error.h"
#include "tagfield/scenario/driven_robot.h"

namespace tagfield {
namespace {

constexpr const char* kNodeName = "tagfield";
// Usually enough for running nodes to discover us.
constexpr Duration kMaxWait = std::chrono::seconds(2);
constexpr std::chrono::milliseconds kSettling(300);

/// One sink that forwards to all of `sinks`.
std::shared_ptr<ros2::MessageSink> joined(
    const std::vector<std::shared_ptr<ros2::MessageSink>>& sinks) {
  return sinks.size() == 1 ? sinks.front() : std::make_shared<ros2::TeeSink>(sinks);
}

std::shared_ptr<ros2::Ros2Outlet> attach_sink(const std::shared_ptr<ros2::MessageSink>& sink,
                                              const ScenarioWithWorld& loaded,
                                              RunControl& control) {
  auto outlet = std::make_shared<ros2::Ros2Outlet>(sink);
  for (const RobotSpec& robot : loaded.scenario.robots) outlet->expect_robot(robot.name);
  attach(outlet, control.outlets);
  attach(std::make_shared<ros2::Ros2Markers>(sink), control.outlets);
  if (loaded.scenario.pose.source == PoseSource::kSlam) {
    control.navigation =
        std::make_shared<ros2::Ros2Navigation>(sink, outlet, navigation_of(loaded.scenario).laser);
  }
  return outlet;
}

RemoteDriving driving_of(const OutletArguments& arguments, const ScenarioWithWorld& loaded,
                         const std::shared_ptr<ros2::DdsSink>& dds,
                         const std::shared_ptr<ros2::MessageSink>& sink,
                         const std::shared_ptr<ros2::Ros2Outlet>& outlet) {
  std::set<std::string> antennas;
  for (const AntennaSpec& antenna : loaded.scenario.antennas) {
    if (antenna.on == arguments.drive) antennas.insert(antenna.parameters.name);
  }
  outlet->mount(arguments.drive, antennas, ros2::kBaseFrame);
  const auto warn = [](const std::string& line) {
    fmt::print(stderr, "tagfield: warning: {}\n", line);
  };
  return {arguments.drive,
          std::make_shared<ros2::Ros2Robot>(dds, sink, outlet, navigation_of(loaded.scenario).laser,
                                            warn),
          {std::make_shared<const RayScene>(loaded.scene), loaded.scenario.obstacles}};
}

}  // namespace

void add_outlet_options(CLI::App& command, OutletArguments& arguments) {
  CLI::Option* ros2 =
      command.add_flag("--ros2", arguments.ros2,
                       "Publish the run to ROS 2, in real time: /rfid/reads, /tf, /clock and more "
                       "(docs/ros2.md). Of several seeds, the first");
  command
      .add_option("--domain", arguments.domain,
                  "Domain of ROS 2 (default: ROS_DOMAIN_ID, or else 0)")
      ->check(CLI::Range(std::uint32_t{0}, static_cast<std::uint32_t>(ros2::kLastDomain)))
      ->needs(ros2);
  command.add_option("--mcap", arguments.mcap,
                     "Record the same messages into this MCAP file, for rosbag2 and Foxglove "
                     "(docs/mcap.md). Of several seeds, the first");
  command
      .add_option("--drive", arguments.drive,
                  "This robot is driven from outside, by Nav2 for example: /cmd_vel in, /odom, "
                  "/scan and frames out, until the scenario's duration is over or Ctrl-C. It is a "
                  "single run: not with --seeds or --breakdown")
      ->needs(ros2)
      ->excludes("--seeds")
      ->excludes("--breakdown");
  add_speed_option(command, arguments.speed, "as the scenario says; with --ros2 1");
}

void apply(const OutletArguments& arguments, Scenario& scenario, Diagnostics& diagnostics) {
  if (!arguments.drive.empty()) let_be_driven(arguments.drive, scenario, diagnostics);
  if (arguments.speed) {
    scenario.real_time = *arguments.speed;
  } else if (arguments.ros2 && !(scenario.real_time > 0.0)) {
    scenario.real_time = 1.0;
  }
}

RunOutlets attach_outlets(const OutletArguments& arguments, const ScenarioWithWorld& loaded,
                          RunControl& control) {
  RunOutlets run;
  if (!arguments.mcap.empty()) run.sinks.push_back(ros2::mcap_file(arguments.mcap));
  std::shared_ptr<ros2::DdsSink> dds;
  if (arguments.ros2) {
    const std::uint32_t domain =
        arguments.domain ? *arguments.domain : ros2::domain_of_environment();
    dds = std::make_shared<ros2::DdsSink>(domain, kNodeName);
    run.sinks.push_back(dds);
  }
  if (run.sinks.empty()) return run;
  const std::shared_ptr<ros2::MessageSink> sink = joined(run.sinks);
  const auto outlet = attach_sink(sink, loaded, control);
  if (!arguments.drive.empty()) run.driving = driving_of(arguments, loaded, dds, sink, outlet);
  if (dds && dds->wait_for_reader(kMaxWait)) std::this_thread::sleep_for(kSettling);
  return run;
}

}  // namespace tagfield
