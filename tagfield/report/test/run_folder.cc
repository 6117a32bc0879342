// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/test/run_folder.h"

#include <cmath>
#include <filesystem>

#include "tagfield/base/units.h"
#include "tagfield/files/files.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/truth_csv.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

constexpr int kSteps = 200;
constexpr double kStep = 0.1;   ///< [s]
constexpr double kSpeed = 0.4;  ///< [m/s]
const Eigen::Vector3d kFixed(6.0, 1.0, 1.5);

Eigen::Vector3d tag_place(std::size_t index) {
  const auto i = static_cast<double>(index);
  return {4.0 + 0.1 * std::fmod(i, 3.0), 0.3 * i, 1.0};
}

/// Position along a square of 2 m.
Eigen::Vector3d place_at(double travelled, double height) {
  const double along = std::fmod(travelled, 8.0);
  if (along < 2.0) return {along, 0.0, height};
  if (along < 4.0) return {2.0, along - 2.0, height};
  if (along < 6.0) return {6.0 - along, 2.0, height};
  return {0.0, 8.0 - along, height};
}

std::vector<AntennaPose> poses_of(const FolderPlan& plan) {
  std::vector<AntennaPose> poses;
  if (plan.fixed) poses.push_back({Time(), "fixed", from_translation(kFixed)});
  for (int i = 0; plan.moving && i < kSteps; ++i) {
    const double height = 1.5 + plan.lift_m * i / kSteps;
    poses.push_back({time_from_seconds(i * kStep), "mobile",
                     from_translation(place_at(i * kStep * kSpeed, height))});
  }
  return poses;
}

TagRead read_at(const AntennaPose& pose, const std::string& tag, const Eigen::Vector3d& p_WT,
                double carrier_hz, double offset_rad) {
  const double distance = (p_WT - pose.X_WA.translation).norm();
  const double phase =
      wrap_to_two_pi(offset_rad + 2.0 * kTwoPi * distance / wavelength(carrier_hz));
  return {pose.stamp, "reader", pose.antenna, tag, carrier_hz, phase, -50.0 - 4.0 * distance};
}

std::vector<TagRead> reads_of(const FolderPlan& plan, const std::vector<AntennaPose>& poses) {
  std::vector<TagRead> reads;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (std::size_t i = 0; plan.reads && i < plan.tags.size(); ++i) {
      const std::size_t channel = k % plan.carriers_hz.size();
      reads.push_back(read_at(poses[k], plan.tags[i], tag_place(i), plan.carriers_hz[channel],
                              1.3 * static_cast<double>(channel)));
    }
  }
  return reads;
}

Truth truth_of(const FolderPlan& plan) {
  Truth truth;
  truth.antenna_poses = poses_of(plan);
  for (std::size_t i = 0; i < plan.tags.size(); ++i) {
    truth.tag_positions.push_back({Time(), plan.tags[i], tag_place(i)});
  }
  return truth;
}

constexpr const char* kTopView =
    R"([{"name": "rack", "z_min": 0, "z_max": 2, "rings": [[[4,-1],[5,-1],[5,3],[4,3]]]}])";

}  // namespace

RunFolder::RunFolder(const FolderPlan& plan) : path_(parent_.file("run")) {
  StagedFolder folder(path_);
  const std::vector<AntennaPose> poses = poses_of(plan);
  folder.add("summary.json", to_json(summary_of(plan)));
  folder.add("antenna_poses.csv", poses_to_csv(poses));
  folder.add("reads.csv", reads_to_csv(reads_of(plan, poses)));
  if (plan.truth) stage_truth(truth_of(plan), folder);
  if (plan.top_view) folder.add("top_view.json", kTopView);
  folder.commit();
}

std::string RunFolder::text(const std::string& name) const {
  const std::string file = path_ + "/" + name;
  return fs::exists(file) ? read_text_file(file) : "";
}

void RunFolder::put(const std::string& name, const std::string& text) const {
  fs::create_directories(fs::path(path_ + "/" + name).parent_path());
  write_text_file(path_ + "/" + name, text);
}

void RunFolder::remove(const std::string& name) const { fs::remove_all(path_ + "/" + name); }

std::vector<std::string> many_tags(int count) {
  std::vector<std::string> tags;
  for (int i = 0; i < count; ++i) tags.push_back(std::string("t").append(std::to_string(i)));
  return tags;
}

Summary summary_of(const FolderPlan& plan) {
  Summary summary;
  summary.scenario = "square";
  summary.seeds = plan.seeds;
  summary.method = "hyperbola";
  summary.pose = plan.truth ? "true" : "given";
  for (const std::uint64_t seed : plan.seeds) {
    for (std::size_t i = 0; i < plan.tags.size(); ++i) {
      TagOutcome outcome;
      outcome.seed = seed;
      if (plan.truth) outcome.truth_m = tag_place(i);
      const Eigen::Vector3d estimate = tag_place(i) + plan.error_m * Eigen::Vector3d::UnitX();
      outcome.estimate = {plan.tags[i], Verdict::kLocated, "", {{estimate, 0.004, 0.012}}, kSteps};
      summary.tags.push_back(outcome);
    }
  }
  return summary;
}

}  // namespace tagfield
