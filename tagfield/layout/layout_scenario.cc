// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/layout_scenario.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tagfield/base/number.h"
#include "tagfield/layout/link_matrix.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

const PlanMount& mount_of(const PlanSpec& plan, const PlannedAntenna& antenna) {
  return *std::find_if(plan.mounts.begin(), plan.mounts.end(),
                       [&](const PlanMount& mount) { return mount.name == antenna.mount; });
}

/// The mount's pose with the antenna's boresight.
RigidTransform pose_of(const PlanMount& mount, const PlannedAntenna& antenna) {
  const auto off = [&](const RigidTransform& X) {
    return (X.rotation * Eigen::Vector3d::UnitX() - antenna.boresight_W).norm();
  };
  return *std::min_element(
      mount.X_WA.begin(), mount.X_WA.end(),
      [&](const RigidTransform& a, const RigidTransform& b) { return off(a) < off(b); });
}

double duration_of(const PlanSpec& plan) {
  double duration_s = plan.dwell_s;
  for (const PlanTags& tags : plan.tags) {
    duration_s = std::max(duration_s, stops_of(tags, plan.dwell_s).back().end_s);
  }
  return duration_s;
}

Trajectory motion_of(const PlanTags& tags, const PlanTag& tag) {
  const Eigen::Quaterniond& R_WT = tags.orientations[tag.orientation];
  const Eigen::Vector3d& p = tags.places[tag.place];
  if (tags.path.empty()) return {{Time{}, {R_WT, p}}};
  Trajectory motion = tags.path;
  for (StampedPose& pose : motion) pose.X_WB = {R_WT, pose.X_WB.translation + p};
  return motion;
}

/// A single tag keeps its name.
std::string id_of(const PlanTags& tags, std::size_t number) {
  return tags.count == 1 && tags.places.size() == 1 ? tags.name
                                                    : fmt::format("{}_{}", tags.name, number + 1);
}

/// Roll, pitch and yaw of a rotation Rz(yaw) Ry(pitch) Rx(roll) [rad].
Eigen::Vector3d rpy_of(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d R = q.toRotationMatrix();
  const double pitch = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  if (std::abs(R(2, 0)) > 1.0 - 1e-12) {  // Straight up or down: yaw only.
    return {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  }
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

YAML::Node flow(const std::vector<double>& numbers) {
  YAML::Node node(YAML::NodeType::Sequence);
  for (const double number : numbers) node.push_back(fmt::format("{:.10g}", number + 0.0));
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

std::vector<double> numbers_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// A setting as written in a file: several words become a list.
YAML::Node value_of(const std::string& text) {
  if (text.find(' ') == std::string::npos) return YAML::Node(text);
  YAML::Node node(YAML::NodeType::Sequence);
  node.SetStyle(YAML::EmitterStyle::Flow);
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (end > begin) node.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return node;
}

std::string from_folder(const fs::path& file, const std::string& folder) {
  if (folder.empty()) return fs::absolute(file).string();
  std::error_code error;
  const fs::path relative = fs::relative(fs::absolute(file), fs::absolute(folder), error);
  return error || relative.empty() ? fs::absolute(file).string() : relative.string();
}

/// Rewrites a path from the scenario's file relative to `folder`; leaves a name that is no file
/// unchanged.
void move_path(YAML::Node node, const std::string& scenario, const std::string& folder) {
  if (!node.IsScalar()) return;
  const bool is_from_command = node.Tag() == "!set";
  const fs::path base = is_from_command ? fs::path() : fs::path(scenario).parent_path();
  const fs::path file = base / node.Scalar();
  std::error_code error;
  if (fs::exists(file, error)) node = from_folder(file, folder);
}

/// Rewrites all paths of a scenario except those of antennas and tags, which are replaced.
void move_paths(YAML::Node root, const std::string& scenario, const std::string& folder) {
  const auto move = [&](const YAML::Node& node) { move_path(node, scenario, folder); };
  if (root["world"].IsMap()) {
    if (root["world"]["path"]) move(root["world"]["path"]);
    if (root["world"]["model_paths"]) {
      for (YAML::Node path : root["world"]["model_paths"]) move(path);
    }
  }
  if (root["tag_profile"]) move(root["tag_profile"]);
  if (root["navigation"].IsMap() && root["navigation"]["map"]) move(root["navigation"]["map"]);
}

YAML::Node antenna_node(const PlanSpec& plan, const PlannedAntenna& antenna,
                        const std::string& folder) {
  const PlanMount& mount = mount_of(plan, antenna);
  const RigidTransform X_WA = pose_of(mount, antenna);
  YAML::Node node;
  node["name"] = antenna.name;
  node["reader"] = antenna.reader;
  std::vector<double> pose = numbers_of(X_WA.translation);
  for (const double angle : numbers_of(rpy_of(X_WA.rotation))) pose.push_back(angle);
  node["pose"] = flow(pose);
  node["rate_hz"] = fmt::format("{:g}", mount.antenna.rate_hz);
  for (const std::string& profile : mount.profiles) {
    node["profiles"].push_back(from_folder(profile, folder));
  }
  for (const RawParameter& setting : mount.settings) node[setting.key] = value_of(setting.value);
  node["transmit_power_dbm"] = fmt::format("{:g}", antenna.power_dbm);
  return node;
}

YAML::Node tag_node(const PlanTags& tags, const PlanTag& tag, std::size_t number,
                    const std::string& folder) {
  YAML::Node node;
  node["id"] = id_of(tags, number);
  const Trajectory motion = motion_of(tags, tag);
  if (motion.size() == 1) {
    node["position"] = flow(numbers_of(motion.front().X_WB.translation));
  } else {
    for (const StampedPose& pose : motion) {
      std::vector<double> row = {to_seconds(pose.stamp)};
      for (const double x : numbers_of(pose.X_WB.translation)) row.push_back(x);
      node["trajectory"].push_back(flow(row));
    }
  }
  const Eigen::Vector3d rpy = rpy_of(motion.front().X_WB.rotation);
  if (rpy.norm() > 1e-12) node["rpy"] = flow(numbers_of(rpy));
  for (const RawParameter& setting : tags.settings) {
    node[setting.key] = setting.key == "profile" ? YAML::Node(from_folder(setting.value, folder))
                                                 : value_of(setting.value);
  }
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

/// Adds a box around each zone's tags, and the readers that serve the zone.
void add_zones(const PlanSpec& plan, const PlannedLayout& layout, YAML::Node& root) {
  for (const PlannedZone& zone : layout.zones) {
    Eigen::AlignedBox2d box;
    for (const PlanTags& tags : plan.tags) {
      if (tags.zone != zone.zone) continue;
      const auto stops = stops_of(tags, plan.dwell_s);
      for (const Eigen::Vector3d& place : tags.places) {
        box.extend(Eigen::Vector2d((stops.front().p_W + place).head<2>()));
        if (!tags.path.empty()) {
          box.extend(Eigen::Vector2d((tags.path.front().X_WB.translation + place).head<2>()));
        }
      }
    }
    if (box.isEmpty()) continue;
    YAML::Node node;
    node["name"] = zone.zone;
    const double rim = 0.01;
    node["box"] =
        flow({box.min().x() - rim, box.min().y() - rim, box.max().x() + rim, box.max().y() + rim});
    std::vector<std::string> readers;
    for (const PlannedAntenna& antenna : layout.antennas) {
      if (antenna.zone == zone.zone) readers.push_back(antenna.reader);
    }
    for (const std::string& reader : distinct(readers)) node["readers"].push_back(reader);
    root["zones"].push_back(node);
  }
}

/// The other keys keep the order of the file.
std::vector<PlanTag> written_tags(const ScenarioToPlan& to_plan, std::uint64_t seed) {
  return tags_of_sample(to_plan.plan, seed, 0);
}

}  // namespace

Scenario scenario_of_layout(const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                            std::uint64_t seed, std::size_t sample, double less_db) {
  const PlanSpec& plan = to_plan.plan;
  Scenario scenario = to_plan.loaded.scenario;
  scenario.antennas.clear();
  scenario.tags.clear();
  scenario.zones.clear();
  scenario.localization.method = kNoLocalization;
  scenario.duration_s = duration_of(plan);
  for (const PlannedAntenna& planned : layout.antennas) {
    const PlanMount& mount = mount_of(plan, planned);
    auto model = std::make_shared<RadioModel>(*physical(mount.antenna));
    model->transmit_power_dbm = planned.power_dbm;
    AntennaSpec antenna;
    antenna.parameters = mount.antenna;
    antenna.parameters.name = planned.name;
    antenna.parameters.reader = planned.reader;
    antenna.parameters.model = std::shared_ptr<const RadioModel>(std::move(model));
    antenna.X_PA = pose_of(mount, planned);
    scenario.antennas.push_back(std::move(antenna));
  }
  std::vector<std::shared_ptr<const TagModel>> kinds;
  for (const PlanTags& group : plan.tags) {
    auto kind = std::make_shared<TagModel>(*group.model);
    kind->detuning_db += less_db;
    kinds.push_back(std::move(kind));
  }
  std::vector<std::size_t> numbers(plan.tags.size(), 0);
  for (const PlanTag& tag : tags_of_sample(plan, seed, sample)) {
    const PlanTags& group = plan.tags[tag.group];
    TagSpec spec;
    spec.id = id_of(group, numbers[tag.group]++);
    spec.model = kinds[tag.group];
    spec.motion = motion_of(group, tag);
    scenario.tags.push_back(std::move(spec));
  }
  return scenario;
}

std::string layout_to_yaml(const std::string& path, const std::vector<Override>& overrides,
                           const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                           std::uint64_t seed, const std::string& folder) {
  YAML::Node root = read_yaml(path);
  for (const auto& [key, value] : overrides) set_in_yaml(root, key, value);
  move_paths(root, path, folder);
  for (const char* const key :
       {"plan", "antennas", "tags", "tag_table", "tag_recording", "zones", "localization"}) {
    root.remove(key);
  }
  root["name"] = to_plan.loaded.scenario.name + "_layout";
  root["duration_s"] = fmt::format("{:g}", duration_of(to_plan.plan));
  root["localization"] = std::string(kNoLocalization);
  for (const PlannedAntenna& antenna : layout.antennas) {
    root["antennas"].push_back(antenna_node(to_plan.plan, antenna, folder));
  }
  add_zones(to_plan.plan, layout, root);
  std::vector<std::size_t> numbers(to_plan.plan.tags.size(), 0);
  for (const PlanTag& tag : written_tags(to_plan, seed)) {
    root["tags"].push_back(
        tag_node(to_plan.plan.tags[tag.group], tag, numbers[tag.group]++, folder));
  }
  YAML::Emitter emitter;
  emitter << root;
  if (!emitter.good()) throw Error("the layout cannot be written: " + emitter.GetLastError());
  return "# A layout of tagfield plan: run, bench and serve take it as it is.\n" +
         std::string(emitter.c_str()) + "\n";
}

}  // namespace tagfield
