// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/faults.h"

#include <algorithm>
#include <map>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

constexpr double kWeakest_dbm = -75.0;
constexpr double kStrongest_dbm = -35.0;

/// Random values for one read: first its phase, then its RSSI.
void draw_anew(const Faults& faults, std::uint64_t seed, TagRead& read) {
  const auto stamp = static_cast<std::uint64_t>(read.stamp.time_since_epoch().count());
  RandomStream stream(seed, Purpose::kFault, stream_key(read.antenna), stream_key(read.tag), stamp);
  const double phase_rad = kTwoPi * uniform(stream);
  const double share = uniform(stream);
  if (faults.random_phases) read.phase_rad = wrap_to_two_pi(phase_rad);
  if (faults.random_rssi) {
    read.rssi_dbm = kWeakest_dbm + share * (kStrongest_dbm - kWeakest_dbm);
  }
}

double phase_of_tag(const std::string& tag, std::uint64_t seed) {
  RandomStream stream(seed, Purpose::kFault, stream_key(tag));
  return wrap_to_two_pi(kTwoPi * uniform(stream));
}

void exchange(const std::vector<std::string>& names, std::string& antenna) {
  if (names.empty()) return;
  if (antenna == names[0]) {
    antenna = names[1];
  } else if (antenna == names[1]) {
    antenna = names[0];
  }
}

/// Every other read of each tag gets the ID of the next tag, those of the last tag that of the
/// first.
void mix_tags(std::vector<TagRead>& reads) {
  std::map<std::string, std::size_t> counts;
  for (const TagRead& read : reads) counts[read.tag] = 0;
  for (TagRead& read : reads) {
    const auto own = counts.find(read.tag);
    if (own->second++ % 2 == 0) continue;
    const auto next = std::next(own);
    read.tag = next == counts.end() ? counts.begin()->first : next->first;
  }
}

}  // namespace

std::vector<std::string> fault_names(const Faults& faults) {
  std::vector<std::string> names;
  const auto add = [&](bool there, const char* name) {
    if (there) names.emplace_back(name);
  };
  add(faults.random_phases, "random_phases");
  add(faults.constant_phases, "constant_phases");
  add(faults.wrong_phase_sign, "wrong_phase_sign");
  add(faults.random_rssi, "random_rssi");
  add(faults.duplicate_epcs, "duplicate_epcs");
  add(faults.timestamp_delay_s > 0.0, "timestamp_delay_s");
  add(!faults.swapped_antennas.empty(), "swapped_antennas");
  add(faults.poses_of_another_run, "poses_of_another_run");
  return names;
}

bool has_true_position(const Faults& faults, const std::string& method) {
  if (faults.duplicate_epcs || faults.poses_of_another_run) return false;
  const bool no_phases = faults.random_phases || faults.constant_phases;
  if (no_phases && faults.random_rssi) return false;
  if (is_by_phase(method)) return !no_phases;
  const bool by_rssi_alone = method == "trilateration" || method == "landmarc";
  return !(by_rssi_alone && faults.random_rssi);
}

void add_faults(const Faults& faults, std::uint64_t seed, Recording& recording) {
  const Duration late = duration_from_seconds(faults.timestamp_delay_s);
  for (TagRead& read : recording.reads) {
    draw_anew(faults, seed, read);
    if (faults.constant_phases) read.phase_rad = phase_of_tag(read.tag, seed);
    if (faults.wrong_phase_sign) read.phase_rad = wrap_to_two_pi(-read.phase_rad);
    exchange(faults.swapped_antennas, read.antenna);
    read.stamp += late;
  }
  if (faults.duplicate_epcs) mix_tags(recording.reads);
  if (faults.poses_of_another_run) {
    recording.believed_poses = poses_of_another_run(std::move(recording.believed_poses));
  }
}

std::vector<AntennaPose> poses_of_another_run(std::vector<AntennaPose> poses) {
  if (poses.empty()) return poses;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const AntennaPose& pose : poses) mean += pose.X_WA.translation.head<2>();
  mean /= static_cast<double>(poses.size());
  Eigen::Matrix2d bend;
  bend << 0.8, 0.1, 0.1, -0.5;
  for (AntennaPose& pose : poses) {
    const Eigen::Vector2d from_mean = pose.X_WA.translation.head<2>() - mean;
    pose.X_WA.translation.head<2>() = mean + bend * from_mean;
  }
  return poses;
}

}  // namespace tagfield
