// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/yaml_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tagfield/base/spelling.h"

namespace tagfield {
namespace fs = std::filesystem;

std::size_t choice(const YamlValue& value, const std::vector<std::string>& choices) {
  const std::string word = value.text();
  const auto found = std::find(choices.begin(), choices.end(), word);
  if (found == choices.end()) {
    value.fail(fmt::format("is '{}', which is not known{}", word, suggestion(word, choices)));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::string resolve_path(const YamlValue& value) {
  const fs::path given = value.text();
  const bool from_file = value.location().file == value.file();
  if (given.is_absolute() || !from_file) return given.string();
  return (fs::path(value.file()).parent_path() / given).lexically_normal().string();
}

double seconds_of(const YamlValue& value, NumberRange range) {
  const double seconds = value.number(range);
  try {
    time_from_seconds(seconds);
  } catch (const Error& error) {
    value.fail(error.what());
  }
  return seconds;
}

Lifetime lifetime_of(YamlMap& map) {
  Lifetime lifetime;
  if (map.has("appears_s")) {
    lifetime.appears = time_from_seconds(seconds_of(map.at("appears_s"), kNotNegative));
  }
  if (map.has("disappears_s")) {
    lifetime.disappears = time_from_seconds(seconds_of(map.at("disappears_s"), kPositive));
    if (*lifetime.disappears <= lifetime.appears) {
      map.at("disappears_s").fail("must be later than appears_s");
    }
  }
  return lifetime;
}

Eigen::Vector3d position_of(const YamlValue& value) {
  const std::vector<double> n = value.lengths(3, 3);
  return {n[0], n[1], n[2]};
}

TagArea tag_area_of(YamlMap& map) {
  TagArea area;
  if (map.has("side")) area.side = static_cast<TagSide>(choice(map.at("side"), tag_sides()));
  if (map.has("box")) {
    const std::vector<double> n = map.at("box").lengths(4, 4);
    const Eigen::Vector2d one(n[0], n[1]);
    const Eigen::Vector2d other(n[2], n[3]);
    area.box = Eigen::AlignedBox2d(one.cwiseMin(other), one.cwiseMax(other));
  }
  return area;
}

RigidTransform pose_of(const YamlValue& value) {
  const std::vector<double> n = value.lengths(3, 6);
  if (n.size() == 3) return from_translation({n[0], n[1], n[2]});
  if (n.size() != 6) value.fail("must be [x, y, z] or [x, y, z, roll, pitch, yaw]");
  return from_xyz_rpy({n[0], n[1], n[2]}, {n[3], n[4], n[5]});
}

Trajectory trajectory_of(const YamlValue& value, std::size_t columns) {
  Trajectory trajectory;
  for (const YamlValue& row : value.list()) {
    const std::vector<double> n = row.numbers(columns, columns);
    const double seconds = seconds_of(row.list().front(), NumberRange::kAny);
    for (std::size_t i = 1; i < columns; ++i) row.require_length(n[i]);
    trajectory.push_back(
        {time_from_seconds(seconds), from_translation({n[1], n[2], columns > 3 ? n[3] : 0.0})});
  }
  if (trajectory.empty()) value.fail("must have at least one row [t, x, y, ...]");
  try {
    require_rising_stamps(trajectory);
  } catch (const Error& error) {
    value.fail(error.what());
  }
  return trajectory;
}

}  // namespace tagfield
