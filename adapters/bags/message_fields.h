// SPDX-License-Identifier: Apache-2.0
/// @file
/// Fields of recorded messages of ROS 1 and ROS 2, checked and converted. Throw Error, naming the
/// message and the field, if a number is not finite or is absurd, a name is empty or not text, or a
/// stamp is invalid.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include "adapters/bags/bag_content.h"
#include "adapters/bags/message_location.h"
#include "tagfield/base/error.h"
#include "tagfield/base/range_check.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield::recorded {

constexpr double kMaxFrequency = 1e12;  ///< [Hz]
constexpr double kMaxLevel = 1e6;       ///< [dBm]

/// Name of a list's element, formatted for error messages only: "reads[3].epc".
struct FieldName {
  const char* list = "";
  std::size_t index = 0;
  const char* field = "";
};
std::string to_text(const FieldName& name);
inline const std::string& to_text(const std::string& name) { return name; }

template <class Name>
double checked(double value, double greatest, const Name& what, const MessageLocation& place) {
  if (!(std::abs(value) <= greatest)) {
    fail_at(place, fmt::format("{} is {}, expected a number within ±{:g}", to_text(what), value,
                               greatest));
  }
  return value;
}

/// "" if it is a name, else what is wrong with it.
std::string fault_of_name(const std::string& name);

template <class Name>
const std::string& checked_name(const std::string& name, const Name& what,
                                const MessageLocation& place) {
  const std::string fault = fault_of_name(name);
  if (!fault.empty()) fail_at(place, fmt::format("{} {}", to_text(what), fault));
  return name;
}

/// Of ROS 2.
template <class Stamp>
auto stamp_of(const Stamp& stamp, const MessageLocation& place) -> decltype(stamp.nanosec, Time()) {
  if (stamp.sec < 0) fail_at(place, fmt::format("stamp is {} s, expected 0 or more", stamp.sec));
  if (stamp.nanosec >= 1'000'000'000) {
    fail_at(place, fmt::format("header.stamp is {} s and {} ns, expected a time", stamp.sec,
                               stamp.nanosec));
  }
  return Time(std::chrono::seconds(stamp.sec) + Duration(stamp.nanosec));
}

/// Of ROS 1.
template <class Stamp>
auto stamp_of(const Stamp& stamp, const MessageLocation& place) -> decltype(stamp.nsec, Time()) {
  constexpr std::uint32_t kLastSecond = 4'000'000'000;
  if (stamp.nsec >= 1'000'000'000 || stamp.sec > kLastSecond) {
    fail_at(place,
            fmt::format("header.stamp is {} s and {} ns, expected a time", stamp.sec, stamp.nsec));
  }
  return Time(std::chrono::seconds(stamp.sec) + Duration(stamp.nsec));
}

template <typename Point>  // geometry_msgs' Point or Vector3
Eigen::Vector3d place_of(const Point& p, const std::string& what, const MessageLocation& place) {
  return {checked(p.x, kMaxCoordinate_m, what + ".x", place),
          checked(p.y, kMaxCoordinate_m, what + ".y", place),
          checked(p.z, kMaxCoordinate_m, what + ".z", place)};
}

template <typename Quaternion>
Eigen::Quaterniond rotation_of(const Quaternion& q, const std::string& what,
                               const MessageLocation& place) {
  const Eigen::Quaterniond quaternion(q.w, q.x, q.y, q.z);
  const auto rotation = as_rotation(quaternion);
  if (!rotation) {
    fail_at(place, fmt::format("{} has length {:.3g}, expected 1", what, quaternion.norm()));
  }
  return *rotation;
}

template <typename Pose>
RigidTransform pose_of(const Pose& pose, const std::string& what, const MessageLocation& place) {
  return {rotation_of(pose.orientation, what + ".orientation", place),
          place_of(pose.position, what + ".position", place)};
}

/// "/map" and "map" are the same frame in tf.
std::string frame_of(const std::string& frame);
/// A topic's name without its namespace: "/a/b/tf" → "tf".
std::string last_name(const std::string& topic);
/// "/p3at/ground_truth/odom" → "p3at"
std::string robot_of(const std::string& topic);

/// Records the stamp of a stream. If it goes back by more than a second, the simulation was reset:
/// the previous `content` is then dropped with a warning, except for static transforms and tag
/// positions.
void follow_clock(const std::string& stream, Time stamp, const MessageLocation& place,
                  BagContent& content, Diagnostics& diagnostics);

}  // namespace tagfield::recorded
