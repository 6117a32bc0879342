// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/localization_yaml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "tagfield/base/units.h"
#include "tagfield/localization/locate.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

/// The method of that name; throws Error if there is none.
Method method_of(const YamlValue& value, const std::vector<Method>& methods) {
  std::vector<std::string> names;
  names.reserve(methods.size());
  for (const Method& method : methods) names.push_back(method.name);
  return methods[static_cast<std::size_t>(choice(value, names))];
}

/// The settings that are given, as written.
std::vector<RawParameter> settings_of(YamlMap& map, const std::vector<SettingHelp>& helps) {
  std::vector<RawParameter> settings;
  for (const SettingHelp& help : helps) {
    if (!map.has(help.key)) continue;
    const YamlValue value = map.at(help.key);
    settings.push_back({help.key, value.text(), value.location()});
  }
  return settings;
}

/// The settings of all methods, without duplicates.
std::vector<SettingHelp> settings_of(const std::vector<Method>& methods) {
  std::vector<SettingHelp> all;
  for (const Method& method : methods) {
    std::copy_if(method.settings.begin(), method.settings.end(), std::back_inserter(all),
                 [&](const SettingHelp& help) { return !has_key(all, help.key); });
  }
  return all;
}

PoseErrorModel pose_error_of(YamlMap map) {
  PoseErrorModel model;
  model.sigma_m = map.number("sigma_m", model.sigma_m, kNotNegative);
  model.yaw_sigma_rad = radians(map.number("yaw_sigma_deg", 0.0, kNotNegative));
  model.time_constant_s = map.number("time_constant_s", model.time_constant_s, kPositive);
  map.finish();
  return model;
}

/// Warns about what is given but used by none of the methods.
void warn_of_ignored(YamlMap& map, const std::vector<Method>& used, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  names.reserve(used.size());
  for (const Method& method : used) names.push_back(method.name);
  for (const char* const key :
       {"offset", "pi_ambiguity", "pose_error", "max_expected_error_m", "max_rms_m"}) {
    if (!map.has(key) || !all_ignore(used, key)) continue;
    diagnostics.warn(map.at(key).location(), fmt::format("localization.{} has no effect with {}",
                                                         key, fmt::join(names, " and ")));
  }
}

/// Reads the methods in use and checks their settings.
void read_methods(YamlMap& map, const std::vector<Method>& methods, LocalizationSpec& spec,
                  Diagnostics& diagnostics) {
  std::vector<Method> used = {map.has("method") ? method_of(map.at("method"), methods)
                                                : find_method(methods, spec.method)};
  spec.method = used.front().name;
  for (const YamlValue& other : map.list("compare")) {
    used.push_back(method_of(other, methods));
    spec.compare.push_back(used.back().name);
  }
  spec.settings = settings_of(map, settings_of(methods));
  refuse_unused(spec.settings, used, methods);
  for (const Method& method : used) configured(method, spec.settings);
  warn_of_ignored(map, used, diagnostics);
}

/// Nothing is localized, so no setting of localization has an effect.
void warn_of_settings_of_none(YamlMap& map, Diagnostics& diagnostics) {
  for (const auto& entry : map.self().node()) {
    const std::string key = entry.first.as<std::string>("");
    if (key == "method") continue;
    diagnostics.warn(map.at(key).location(),
                     fmt::format("localization.{} has no effect with method: none", key));
  }
}

Eigen::Vector2d level_point(const YamlValue& value) {
  const std::vector<double> n = value.lengths(2, 2);
  return {n[0], n[1]};
}

Lane lane_of(YamlMap map) {
  Lane lane;
  lane.point = level_point(map.at("point"));
  lane.heading_rad = radians(map.number("heading_deg", 0.0));
  lane.lateral_sigma_m = map.number("lateral_sigma_m", lane.lateral_sigma_m, kPositive);
  lane.heading_sigma_rad =
      radians(map.number("heading_sigma_deg", lane.heading_sigma_rad / radians(1.0), kPositive));
  lane.bidirectional = map.boolean("bidirectional", lane.bidirectional);
  lane.acceleration_noise = map.number("acceleration_noise", lane.acceleration_noise, kNotNegative);
  map.finish();
  return lane;
}

PassingLine passing_line_of(YamlMap map) {
  PassingLine line;
  line.point = level_point(map.at("point"));
  line.heading_rad = radians(map.number("heading_deg", 90.0));
  map.finish();
  return line;
}

}  // namespace

LocalizationSpec localization_of(const YamlValue& value, const std::vector<Method>& methods,
                                 Diagnostics& diagnostics) {
  LocalizationSpec spec;
  if (value.node().IsScalar()) {
    static_cast<void>(choice(value, {kNoLocalization}));
    spec.method = kNoLocalization;
    return spec;
  }
  YamlMap map(value);
  if (map.has("method") && map.at("method").text() == kNoLocalization) {
    warn_of_settings_of_none(map, diagnostics);
    spec.method = kNoLocalization;
    return spec;
  }
  read_methods(map, methods, spec, diagnostics);
  if (map.has("pi_ambiguity")) spec.pi_ambiguity = map.at("pi_ambiguity").boolean();
  if (map.has("offset")) spec.offset_known = choice(map.at("offset"), {"unknown", "known"}) == 1;
  for (const YamlValue& tag : map.list("reference_tags")) spec.reference_tags.push_back(tag.text());
  if (map.has("pose_error")) spec.pose_error = pose_error_of(YamlMap(map.at("pose_error")));
  spec.area = tag_area_of(map);
  EstimateLimits& limits = spec.limits;
  limits.max_expected_error_m =
      map.number("max_expected_error_m", limits.max_expected_error_m, kPositive);
  limits.max_rms_m = map.number("max_rms_m", limits.max_rms_m, kPositive);
  if (map.has("tag_height_m")) {
    spec.known_height = KnownHeight::kNumber;
    spec.height_m = map.at("tag_height_m").number();
  } else if (map.has("tag_heights")) {
    constexpr KnownHeight kKinds[] = {KnownHeight::kTag, KnownHeight::kAntenna, KnownHeight::kAbove,
                                      KnownHeight::kBelow};
    spec.known_height =
        kKinds[choice(map.at("tag_heights"), {"known", "unknown", "above", "below"})];
  }
  map.finish();
  return spec;
}

TrackingSpec tracking_of(YamlMap map) {
  TrackingSpec spec;
  TrackingOptions& options = spec.options;
  if (map.has("method")) {
    const std::vector<std::string> methods = {"ekf", "ukf", "particle"};
    options.method = track_method(methods[choice(map.at("method"), methods)]);
  }
  if (map.has("lane")) options.lane = lane_of(YamlMap(map.at("lane")));
  if (map.has("line")) spec.line = passing_line_of(YamlMap(map.at("line")));
  apply_settings(tracking_settings(), settings_of(map, helps_of(tracking_settings())), options);
  const auto of_particles = settings_of(map, helps_of(particle_track_settings()));
  if (!of_particles.empty() && options.method != TrackMethod::kParticle) {
    fail(of_particles.front().location,
         fmt::format("{} is not used by {}: it is a setting of particle", of_particles.front().key,
                     to_string(options.method)));
  }
  apply_settings(particle_track_settings(), of_particles, options);
  map.finish();
  try {
    check(options);
  } catch (const Error& error) {
    map.self().fail(error.what());
  }
  return spec;
}

}  // namespace tagfield
