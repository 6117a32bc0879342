// SPDX-License-Identifier: Apache-2.0
/// @file
/// Synthetic surveys of many kinds: reads of several tags by antennas on a path or at rest, with
/// believed poses and prior knowledge, as locate_tags() takes them.
#pragma once

#include <complex>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/locate.h"
#include "tagfield/localization/test/made_reads.h"
#include "tagfield/localization/test/reflections.h"

namespace tagfield::made {

/// Antenna with a pose relative to a body that follows a path with its x axis.
struct MountedAntenna {
  std::string name = "a";
  Eigen::Vector3d p_BA = Eigen::Vector3d::Zero();
  double yaw_BA = kPi / 2.0;
};

/// How a survey is made.
struct SurveyPlan {
  Path path = l_turn(4.0, 3.5, 0.035);  ///< Positions of the body, 15 a second.
  std::vector<MountedAntenna> antennas = {{}};
  /// Antennas at rest, instead of those on the body.
  std::vector<Eigen::Vector3d> fixed{};
  int channels = 1;  ///< 500 kHz apart from 865.7 MHz on; each has its own offset.
  int dwell = 5;     ///< Steps on a channel.
  int tags = 4;
  int reference_tags = 0;  ///< How many of them are known.
  double nearest_m = 1.0, farthest_m = 3.0;
  double lowest_m = 0.4, highest_m = 0.4;
  double range_m = 5.0;
  double phase_noise_rad = 0.1;
  double rssi_noise_db = 1.0;
  double pose_m = 0.0;   ///< Error of the believed poses, as in Noise.
  double lost = 0.3;     ///< Share of replies lost.
  double strays = 0.0;   ///< Share of reads with any phase.
  double latency_s = 0;  ///< Of the reads' stamps.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< Of tags [m/s].
  std::vector<Mirror> mirrors{};
  bool pi_ambiguity = false;
  bool circular = false;  ///< Right-hand antennas; each tag has one wire in some direction.
  double phase_sign = 1.0;
};

struct Survey {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
  KnownBeforehand known;
  std::map<std::string, Eigen::Vector3d> truth;
  std::map<std::string, double> offsets_rad;  ///< By antenna; those of channels add to them.
};

/// Heading of a path at point i [rad]: of the next step, or of the last one at the end.
inline double heading_at(const Path& path, std::size_t i) {
  const auto step = [&](std::size_t from) { return path[from + 1] - path[from]; };
  std::size_t from = i;
  while (from + 1 < path.size() && step(from).norm() == 0.0) ++from;
  if (from + 1 >= path.size()) from = path.size() - 2;
  return std::atan2(step(from).y(), step(from).x());
}

inline RigidTransform pose_of(const MountedAntenna& antenna, const Path& path, std::size_t i,
                              const Eigen::Vector3d& error) {
  const Eigen::Vector3d p = path[i] + error;
  RigidTransform X_WB = from_planar(p.x(), p.y(), heading_at(path, i));
  X_WB.translation.z() = p.z();
  RigidTransform X_BA = from_planar(antenna.p_BA.x(), antenna.p_BA.y(), antenna.yaw_BA);
  X_BA.translation.z() = antenna.p_BA.z();
  return X_WB * X_BA;
}

/// One-way field at `p_WT`, relative to the direct wave's at 1 m.
inline std::complex<double> field_of(const SurveyPlan& plan, const Eigen::Vector3d& p_WA,
                                     const Eigen::Vector3d& p_WT, double k) {
  const double r = (p_WT - p_WA).norm();
  std::complex<double> field = std::polar(1.0 / r, -k * r);
  for (const Mirror& mirror : plan.mirrors) {
    Eigen::Vector3d image = p_WT;
    image[mirror.axis] = 2.0 * mirror.at - image[mirror.axis];
    const double length = (image - p_WA).norm();
    field -= mirror.gain * std::polar(1.0 / length, -k * length);
  }
  return field;
}

/// Field of two crossed wires fed 90° apart along a tag's wire: its phase turns the reply's.
inline double turn_by_wire(const RigidTransform& X_WA, const Eigen::Vector3d& p_WT,
                           const Eigen::Vector3d& axis_W) {
  const Eigen::Matrix3cd R = X_WA.rotation.toRotationMatrix().cast<std::complex<double>>();
  const Eigen::Vector3cd u = (p_WT - X_WA.translation).normalized().cast<std::complex<double>>();
  const Eigen::Vector3cd wires = R.col(2) + std::complex<double>(0.0, 1.0) * R.col(1);
  const std::complex<double> along = u.transpose() * wires;
  const std::complex<double> h =
      axis_W.cast<std::complex<double>>().transpose() * (wires - u * along);
  return -2.0 * std::arg(h);
}

/// RSSI of an antenna whose lobe is 12 dB down behind it, in half decibels [dBm].
inline double rssi_of(double field, const RigidTransform& X_WA, const Eigen::Vector3d& p_WT,
                      double noise_db) {
  const Eigen::Vector3d way = (p_WT - X_WA.translation).normalized();
  const double cosine = way.dot(X_WA.rotation * Eigen::Vector3d::UnitX());
  const double exact = -35.0 + 40.0 * std::log10(field) + 6.0 * (cosine - 1.0) + noise_db;
  return 0.5 * std::round(2.0 * exact);
}

struct SurveyTag {
  std::string id;
  Eigen::Vector3d p_WT;
  Eigen::Vector3d axis_W;
};

/// The path without the steps in which it stands still, at which nothing is beside it.
inline Path moving_part(const Path& path) {
  Path moving;
  for (const Eigen::Vector3d& p : path) {
    if (moving.empty() || (p - moving.back()).norm() > 0.0) moving.push_back(p);
  }
  return moving;
}

/// Makes the rows of a survey, step by step.
class SurveyMaker {
 public:
  SurveyMaker(const SurveyPlan& plan, Rng& rng) : plan_(plan), rng_(rng) {
    place_tags();
    const bool rests = !plan.fixed.empty();
    const std::size_t steps = plan.path.size();
    const std::size_t count = rests ? plan.fixed.size() : plan.antennas.size();
    for (std::size_t a = 0; a < count; ++a) {
      const std::string name = rests ? "port" + std::to_string(a + 1) : plan.antennas[a].name;
      made_.offsets_rad[name] = uniform(rng, 0.0, kTwoPi);
      std::vector<double> of_channel;
      for (int c = 0; c < plan.channels; ++c) {
        of_channel.push_back(plan.channels == 1 ? 0.0 : uniform(rng, 0.0, kTwoPi));
      }
      channel_offsets_.push_back(std::move(of_channel));
      names_.push_back(name);
    }
    const Noise noise{plan.phase_noise_rad, 0.0, 0.0, plan.pose_m, 5.0};
    const Path beliefs = believed(plan.path, noise, 15.0, rng);
    for (std::size_t i = 0; i < steps; ++i) {
      for (std::size_t a = 0; a < count; ++a) step(i, a, beliefs[i] - plan.path[i]);
    }
  }

  Survey take() { return std::move(made_); }

 private:
  void place_tags() {
    const Path way = moving_part(plan_.path);
    for (int t = 0; t < plan_.tags; ++t) {
      const double z = uniform(rng_, plan_.lowest_m, plan_.highest_m);
      const double away = uniform(rng_, plan_.nearest_m, plan_.farthest_m);
      const Eigen::Vector3d p_WT = beside(way, away, z, rng_);
      const double lean = uniform(rng_, -1.2, 1.2);
      const double bearing = uniform(rng_, 0.0, kTwoPi);
      const Eigen::Vector3d axis_W(std::sin(lean) * std::cos(bearing),
                                   std::sin(lean) * std::sin(bearing), std::cos(lean));
      const std::string id = "tag" + std::to_string(t + 1);
      tags_.push_back({id, p_WT, axis_W});
      made_.truth[id] = p_WT;
      if (t < plan_.reference_tags) made_.known.reference_tags[id] = p_WT;
    }
  }

  void step(std::size_t i, std::size_t a, const Eigen::Vector3d& error) {
    const double time = static_cast<double>(i) / 15.0;
    const bool rests = !plan_.fixed.empty();
    RigidTransform X_WA;
    RigidTransform believed_X_WA;
    if (rests) {
      X_WA = believed_X_WA = from_translation(plan_.fixed[a]);
    } else {
      X_WA = pose_of(plan_.antennas[a], plan_.path, i, Eigen::Vector3d::Zero());
      believed_X_WA = pose_of(plan_.antennas[a], plan_.path, i, error);
    }
    const Time now = time_from_seconds(ReaderSetup{}.start_s + time);
    if (!rests || i == 0) made_.poses.push_back({now, names_[a], believed_X_WA});
    for (const SurveyTag& tag : tags_) {
      read(i, a, X_WA, tag, time, now + duration_from_seconds(plan_.latency_s));
    }
  }

  void read(std::size_t i, std::size_t a, const RigidTransform& X_WA, const SurveyTag& tag,
            double time, Time stamp) {
    const Eigen::Vector3d p_WT = tag.p_WT + time * plan_.velocity;
    const bool is_lost = uniform(rng_, 0.0, 1.0) < plan_.lost;
    const bool is_stray = uniform(rng_, 0.0, 1.0) < plan_.strays;
    const double noise = normal(rng_, plan_.phase_noise_rad);
    const double rssi_noise = normal(rng_, plan_.rssi_noise_db);
    const double any = uniform(rng_, 0.0, kTwoPi);
    if (is_lost || (p_WT - X_WA.translation).norm() > plan_.range_m) return;
    const int channel = (static_cast<int>(i) / plan_.dwell) % plan_.channels;
    const double carrier = 865.7e6 + 500e3 * channel;
    const std::complex<double> field =
        field_of(plan_, X_WA.translation, p_WT, kTwoPi / wavelength(carrier));
    double phase = -2.0 * plan_.phase_sign * std::arg(field) + made_.offsets_rad[names_[a]] +
                   channel_offsets_[a][static_cast<std::size_t>(channel)] + noise;
    if (plan_.circular) phase += turn_by_wire(X_WA, p_WT, tag.axis_W);
    if (plan_.pi_ambiguity && any > kPi) phase += kPi;
    if (is_stray) phase = any;
    made_.reads.push_back({stamp, "reader", names_[a], tag.id, carrier, wrap_to_two_pi(phase),
                           rssi_of(std::abs(field), X_WA, p_WT, rssi_noise)});
  }

  const SurveyPlan& plan_;
  Rng& rng_;
  std::vector<SurveyTag> tags_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> channel_offsets_;
  Survey made_;
};

/// A survey as planned, with the tags' heights known if they are all the same, and otherwise to be
/// estimated above the antennas; the poses' error is stated.
inline Survey make_survey(const SurveyPlan& plan, Rng& rng) {
  Survey made = SurveyMaker(plan, rng).take();
  if (plan.lowest_m == plan.highest_m) {
    made.known.heights.of_all = plan.lowest_m;
  } else {
    made.known.heights.estimated = HeightSide::kAbove;
  }
  made.known.pose_error = PoseErrorModel{plan.pose_m, 0.0, 5.0};
  if (!plan.fixed.empty()) made.known.pose_error.reset();
  if (plan.circular) {
    for (const auto& [antenna, offset] : made.offsets_rad) {
      made.known.circular[antenna] = Hand::kRight;
    }
  }
  return made;
}

}  // namespace tagfield::made
