// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/calibration_profile.h"

#include <fmt/format.h>

#include "tagfield/base/units.h"
#include "tagfield/files/csv.h"
#include "tagfield/scenario/yaml_map.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

constexpr double kMaxPlace = 10.0;         ///< [m]
constexpr double kMaxTimeOffset = 3600.0;  ///< [s]

CalibratedValue value_of(YamlMap map, double most) {
  CalibratedValue value;
  const YamlValue figure = map.at("value");
  value.value = figure.number();
  if (std::abs(value.value) > most) {
    figure.fail(fmt::format("must be within ±{}, is {}", most, value.value));
  }
  value.sigma = map.number("sigma", 0.0, NumberRange::kNotNegative);
  value.observable = map.boolean("observable", true);
  map.finish();
  return value;
}

ChannelOffset offset_of(YamlMap map) {
  ChannelOffset offset;
  offset.frequency_hz = map.at("frequency_hz").number(NumberRange::kPositive);
  offset.value_rad = wrap_to_two_pi(map.at("value_rad").number());
  offset.sigma_rad = map.number("sigma_rad", 0.0, NumberRange::kNotNegative);
  offset.reads = map.has("reads") ? map.at("reads").whole_number() : 0;
  map.finish();
  return offset;
}

AntennaCalibration antenna_of(YamlMap map) {
  AntennaCalibration antenna;
  antenna.reads = map.has("reads") ? map.at("reads").whole_number() : 0;
  if (map.has("phase_sign")) {
    const YamlValue sign = map.at("phase_sign");
    if (std::abs(sign.number()) != 1.0) sign.fail("must be 1 or -1");
    antenna.phase_sign = sign.number() > 0.0 ? 1 : -1;
  }
  antenna.noise_rad = map.number("noise_rad", 0.0, NumberRange::kNotNegative);
  if (map.has("phase_centre_m")) {
    YamlMap place(map.at("phase_centre_m"));
    antenna.phase_centre_m[0] = value_of(YamlMap(place.at("x")), kMaxPlace);
    antenna.phase_centre_m[1] = value_of(YamlMap(place.at("y")), kMaxPlace);
    antenna.phase_centre_m[2] = value_of(YamlMap(place.at("z")), kMaxPlace);
    place.finish();
  }
  if (map.has("time_offset_s")) {
    antenna.time_offset_s = value_of(YamlMap(map.at("time_offset_s")), kMaxTimeOffset);
  }
  antenna.tag_scatter_rad = map.number("tag_scatter_rad", 0.0, NumberRange::kNotNegative);
  for (const YamlValue& offset : map.list("offsets")) {
    antenna.offsets.push_back(offset_of(YamlMap(offset)));
  }
  map.finish();
  return antenna;
}

}  // namespace

Calibration read_calibration(const std::string& path) {
  const YAML::Node root = read_yaml(path);
  YamlMap map(YamlValue(root, path, ""));
  Calibration calibration;
  calibration.name = map.at("name").text();
  choice(map.at("kind"), {"calibration"});
  calibration.pi_ambiguity = map.boolean("pi_ambiguity", false);
  const YamlValue antennas = map.at("antennas");
  YamlMap by_name(antennas);
  for (const auto& entry : antennas.node()) {
    const auto name = entry.first.as<std::string>();
    calibration.antennas[name] = antenna_of(YamlMap(by_name.at(name)));
  }
  map.finish();
  return calibration;
}

}  // namespace tagfield
