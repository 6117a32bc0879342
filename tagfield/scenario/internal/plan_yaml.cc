// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/plan_yaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tagfield/base/units.h"
#include "tagfield/scenario/internal/idle_keys.h"
#include "tagfield/scenario/internal/zones_yaml.h"
#include "tagfield/scenario/orientations.h"
#include "tagfield/scenario/yaml_values.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxPlaces = 200'000;
constexpr std::size_t kMaxMounts = 20'000;

/// One number for all axes, or one per axis.
Eigen::Vector3d spacing_of(YamlMap& map, double otherwise_m) {
  if (!map.has("spacing_m")) return Eigen::Vector3d::Constant(otherwise_m);
  const YamlValue value = map.at("spacing_m");
  if (value.node().IsScalar()) return Eigen::Vector3d::Constant(value.number(kPositive));
  const std::vector<double> n = value.lengths(3, 3);
  if (!(n[0] > 0.0 && n[1] > 0.0 && n[2] > 0.0)) value.fail("must be greater than 0");
  return {n[0], n[1], n[2]};
}

/// Evenly spaced positions from `low` to `high` inclusive, at most `spacing` apart.
std::vector<double> spread(double low, double high, double spacing) {
  const double gaps = std::ceil((high - low) / spacing - 1e-9);
  if (!(gaps < static_cast<double>(kMaxPlaces)))
    throw Error("has too many positions: expected a greater spacing_m");
  const auto count = static_cast<std::size_t>(std::max(gaps, 0.0)) + 1;
  std::vector<double> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = count == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(count - 1);
    places.push_back(low + share * (high - low));
  }
  return places;
}

std::vector<Eigen::Vector3d> places_in(const Eigen::AlignedBox3d& box,
                                       const Eigen::Vector3d& spacing_m) {
  const std::vector<double> x = spread(box.min().x(), box.max().x(), spacing_m.x());
  const std::vector<double> y = spread(box.min().y(), box.max().y(), spacing_m.y());
  const std::vector<double> z = spread(box.min().z(), box.max().z(), spacing_m.z());
  if (static_cast<double>(x.size()) * static_cast<double>(y.size()) *
          static_cast<double>(z.size()) >
      static_cast<double>(kMaxPlaces)) {
    throw Error(
        fmt::format("has more than {} positions: expected a greater spacing_m", kMaxPlaces));
  }
  std::vector<Eigen::Vector3d> places;
  for (const double h : z) {
    for (const double b : y) {
      for (const double a : x) places.emplace_back(a, b, h);
    }
  }
  return places;
}

std::vector<Eigen::Vector3d> tag_places(YamlMap& map) {
  std::vector<Eigen::Vector3d> places;
  for (const YamlValue& place : map.list("points")) places.push_back(position_of(place));
  if (!map.has("box")) {
    if (places.empty()) map.self().fail("has neither 'box' nor 'points'");
    return places;
  }
  const YamlValue box = map.at("box");
  if (!places.empty()) box.fail("is given beside 'points', expected one of them");
  if (box.lengths(4, 6).size() != 6) box.fail("must have 6 numbers: x0, y0, z0, x1, y1, z1");
  try {
    return places_in(box_of(box), spacing_of(map, 0.5));
  } catch (const Error& error) {
    box.fail(error.what());
  }
}

std::vector<Eigen::Quaterniond> orientations_of(YamlMap& map) {
  if (!map.has("orientations")) return {Eigen::Quaterniond::Identity()};
  const YamlValue value = map.at("orientations");
  if (value.node().IsScalar()) {
    static_cast<void>(choice(value, {"any"}));
    return orientations_along_axes();
  }
  std::vector<Eigen::Quaterniond> all;
  for (const YamlValue& one : value.list()) {
    const std::vector<double> rpy = one.lengths(3, 3);
    all.push_back(from_xyz_rpy({0, 0, 0}, {rpy[0], rpy[1], rpy[2]}).rotation);
  }
  if (all.empty()) value.fail("is empty, expected 'any' or [roll, pitch, yaw] [rad]");
  return all;
}

/// The settings of `map` as written, without those of profiles.
std::vector<RawParameter> written(YamlMap& map, const std::vector<SettingHelp>& settings) {
  std::vector<RawParameter> all;
  for (const SettingHelp& setting : settings) {
    if (map.has(setting.key)) all.push_back(raw_parameter(setting.key, map.at(setting.key)));
  }
  return all;
}

PlanTags tags_of(YamlMap map, const RadioDefaults& radio, Diagnostics& diagnostics) {
  PlanTags tags;
  tags.location = map.self().location();
  tags.name = map.at("name").text();
  tags.zone = map.text("zone", "");
  tags.places = tag_places(map);
  tags.orientations = orientations_of(map);
  tags.model = tag_model_of(map, radio, diagnostics);
  if (!tags.model) tags.model = default_tag_model();
  tags.settings = written(map, tag_settings());
  warn_of_idle_settings(*tags.model, fmt::format("plan's tags '{}'", tags.name), diagnostics);
  if (map.has("profile")) {
    const YamlValue profile = map.at("profile");
    tags.settings.insert(tags.settings.begin(),
                         {"profile", profile_file_of_tag(profile), profile.location()});
  }
  if (map.has("path")) tags.path = trajectory_of(map.at("path"));
  tags.count = tags.places.size();
  if (map.has("count")) {
    const YamlValue count = map.at("count");
    tags.count = count.whole_number();
    if (tags.count == 0 || tags.count > kMaxPlaces) {
      count.fail(fmt::format("must be from 1 to {}, is {}", kMaxPlaces, tags.count));
    }
  }
  map.finish();
  return tags;
}

/// The given points, or points on a line or in the parallelogram spanned by three corners.
std::vector<Eigen::Vector3d> mount_points(YamlMap& map) {
  std::vector<Eigen::Vector3d> points;
  for (const YamlValue& point : map.list("points")) points.push_back(position_of(point));
  const bool has_line = map.has("line");
  const bool has_wall = map.has("surface");
  if (int(!points.empty()) + int(has_line) + int(has_wall) != 1) {
    map.self().fail("must have one of 'points', 'line' and 'surface'");
  }
  if (!points.empty()) return points;
  const YamlValue value = map.at(has_line ? "line" : "surface");
  std::vector<Eigen::Vector3d> corners;
  for (const YamlValue& corner : value.list()) corners.push_back(position_of(corner));
  const std::size_t expected = has_line ? 2 : 3;
  if (corners.size() != expected) {
    value.fail(fmt::format("must have {} corners [x, y, z], has {}", expected, corners.size()));
  }
  const double spacing_m = map.number("spacing_m", 1.0, kPositive);
  const Eigen::Vector3d along = corners[1] - corners[0];
  const Eigen::Vector3d across = has_line ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                          : Eigen::Vector3d(corners[2] - corners[0]);
  try {
    const std::vector<double> steps = spread(0.0, along.norm(), spacing_m);
    const std::vector<double> rows = spread(0.0, across.norm(), spacing_m);
    if (steps.size() * rows.size() > kMaxMounts) {
      throw Error(fmt::format("has more than {} mounts: expected a greater spacing_m", kMaxMounts));
    }
    for (const double row : rows) {
      for (const double step : steps) {
        Eigen::Vector3d point = corners[0];
        if (along.norm() > 0.0) point += step * along.normalized();
        if (across.norm() > 0.0) point += row * across.normalized();
        points.push_back(point);
      }
    }
  } catch (const Error& error) {
    value.fail(error.what());
  }
  return points;
}

/// Orientations of the boresight: [roll, pitch, yaw], in degrees.
std::vector<Eigen::Vector3d> looks_of(YamlMap& map) {
  std::vector<Eigen::Vector3d> rpy;
  for (const YamlValue& look : map.list("rpy_deg")) {
    const std::vector<double> n = look.lengths(3, 3);
    rpy.emplace_back(radians(n[0]), radians(n[1]), radians(n[2]));
  }
  if (rpy.empty())
    map.self().fail("has no 'rpy_deg': [[roll, pitch, yaw], …], [0, 90, 0] looks down");
  return rpy;
}

std::vector<double> powers_of(YamlMap& map, const RadioModel& model) {
  std::vector<double> powers;
  if (!map.has("powers_dbm")) return {model.transmit_power_dbm};
  for (const YamlValue& power : map.at("powers_dbm").list()) powers.push_back(power.number());
  if (powers.empty()) map.at("powers_dbm").fail("is empty");
  return powers;
}

/// The maximum power at the reader's port that the regulation allows with this antenna [dBm].
double max_power_dbm(const RadioModel& model) {
  constexpr double kDipole_dbi = 2.15;
  const double by_eirp = model.plan.max_erp_dbm + kDipole_dbi - to_db(peak_gain(model.antenna));
  return std::min(by_eirp, max_conducted_dbm(model.plan).value_or(by_eirp)) + model.cable_loss_db;
}

void require_legal(const YamlValue& where, const PlanMount& mount, const RadioModel& model) {
  if (model.plan.max_erp_dbm == 0.0) return;
  const double most = max_power_dbm(model);
  for (const double power : mount.power_dbm) {
    if (power <= most + 0.05) continue;
    where.fail(
        fmt::format("sends {:g} dBm to this antenna, more than the {:.1f} dBm that the plan "
                    "{} allows: lower powers_dbm or transmit_power_dbm",
                    power, most, model.plan.name));
  }
}

void add_mounts(YamlMap map, const RadioDefaults& radio, Diagnostics& diagnostics,
                std::vector<PlanMount>& mounts) {
  PlanMount like;
  like.location = map.self().location();
  const std::string name = map.at("name").text();
  like.zone = map.text("zone", "");
  like.cost = map.number("cost", 0.0, kNotNegative);
  const std::vector<Eigen::Vector3d> points = mount_points(map);
  const std::vector<Eigen::Vector3d> looks = looks_of(map);
  const PropagationModel model = radio.model;
  if (model == PropagationModel::kPaper) {
    map.self().fail(
        "needs model: link_budget or model: multipath: the paper's antennas have no power");
  }
  Diagnostics at_profiles_power;  // The powers in powers_dbm apply instead, and are checked below.
  const std::shared_ptr<const RadioModel> made =
      radio_model_of(map, model, radio, at_profiles_power);
  like.antenna.model = made;
  like.antenna.rate_hz = map.number("rate_hz", like.antenna.rate_hz, kPositive);
  like.settings = written(map, antenna_settings());
  for (const YamlValue& profile : map.list("profiles")) {
    like.profiles.push_back(profile_file_of_antenna(profile));
  }
  warn_of_idle_settings(*made, fmt::format("mount '{}'", name), diagnostics);
  if (map.has("powers_dbm") && map.has("transmit_power_dbm")) {
    diagnostics.warn(
        map.at("transmit_power_dbm").location(),
        fmt::format("transmit_power_dbm of mount '{}' has no effect beside powers_dbm", name));
  }
  like.power_dbm = powers_of(map, *made);
  require_legal(map.self(), like, *made);
  // Links are evaluated at the highest of the powers.
  auto strongest = std::make_shared<RadioModel>(*made);
  strongest->transmit_power_dbm = *std::max_element(like.power_dbm.begin(), like.power_dbm.end());
  Diagnostics found;
  check(*strongest, found);
  for (const std::string& warning : found.warnings()) diagnostics.warn(like.location, warning);
  like.antenna.model = std::shared_ptr<const RadioModel>(std::move(strongest));
  map.finish();
  for (std::size_t i = 0; i < points.size(); ++i) {
    PlanMount mount = like;
    mount.name = points.size() == 1 ? name : fmt::format("{}_{}", name, i + 1);
    for (const Eigen::Vector3d& rpy : looks) mount.X_WA.push_back(from_xyz_rpy(points[i], rpy));
    mounts.push_back(std::move(mount));
  }
}

/// Removes mounts at positions where no antenna may be mounted.
void leave_out_forbidden(YamlMap& map, std::vector<PlanMount>& mounts) {
  for (const YamlValue& value : map.list("forbidden")) {
    const Eigen::AlignedBox3d box = box_of(value);
    const auto inside = [&](const PlanMount& mount) {
      return box.contains(mount.X_WA.front().translation);
    };
    const std::size_t before = mounts.size();
    mounts.erase(std::remove_if(mounts.begin(), mounts.end(), inside), mounts.end());
    if (mounts.empty() && before > 0) value.fail("leaves no mount: all are in forbidden zones");
  }
}

std::size_t count_of(YamlMap& map, const char* key, std::size_t otherwise, std::size_t most) {
  if (!map.has(key)) return otherwise;
  const YamlValue value = map.at(key);
  const std::uint64_t number = value.whole_number();
  if (number == 0 || number > most) {
    value.fail(fmt::format("must be from 1 to {}, is {}", most, number));
  }
  return number;
}

/// A share from 0 to 1, with 0 itself only if `zero` is set.
double share_of(const YamlValue& value, bool zero) {
  const double share = value.number();
  if (share > (zero ? -1e-300 : 0.0) && share <= 1.0) return share;
  value.fail(fmt::format("must be from 0 to 1, is {:g}", share));
}

PlanLimits limits_of(YamlMap map) {
  PlanLimits limits;
  limits.antennas = count_of(map, "antennas", limits.antennas, 256);
  limits.readers = count_of(map, "readers", limits.readers, 256);
  limits.ports = count_of(map, "ports", limits.ports, 256);
  limits.reader_cost = map.number("reader_cost", 0.0, kNotNegative);
  if (map.has("cost")) limits.cost = map.at("cost").number(kPositive);
  if (map.has("cross_reads")) limits.cross = share_of(map.at("cross_reads"), true);
  map.finish();
  return limits;
}

PlanAim aim_of(YamlMap map) {
  PlanAim aim;
  std::string of_tags;
  for (const char* const key : {"read_probability", "dwell_reads", "position_error_m"}) {
    if (!map.has(key)) continue;
    if (!of_tags.empty()) {
      map.at(key).fail(fmt::format("is given beside '{}', expected one of them", of_tags));
    }
    of_tags = key;
  }
  if (map.has("read_probability"))
    aim.read_probability = share_of(map.at("read_probability"), false);
  if (map.has("dwell_reads")) {
    aim.dwell_reads = map.at("dwell_reads").number(kPositive);
    if (*aim.dwell_reads < 1.0) map.at("dwell_reads").fail("must be at least 1");
  }
  if (map.has("position_error_m")) {
    aim.position_error_m = map.at("position_error_m").number(kPositive);
  }
  if (map.has("share")) aim.share = share_of(map.at("share"), false);
  if (map.has("minimize")) {
    const YamlValue minimize = map.at("minimize");
    aim.minimize = choice(minimize, {"antennas", "cost"}) == 0 ? PlanAim::Minimize::kAntennas
                                                               : PlanAim::Minimize::kCost;
    if (!aim.share) minimize.fail("has no effect without 'share', which says what is enough");
  }
  map.finish();
  return aim;
}

/// A position error is defined for stationary tags only.
void require_rest(const YamlValue& aim, const std::vector<PlanTags>& tags) {
  for (const PlanTags& group : tags) {
    if (group.path.empty()) continue;
    aim.fail(
        fmt::format("has 'position_error_m', but the tags '{}' move along a path", group.name));
  }
}

void require_unique_names(const std::vector<PlanMount>& mounts) {
  std::set<std::string> names;
  for (const PlanMount& mount : mounts) {
    if (names.insert(mount.name).second) continue;
    fail(mount.location, fmt::format("there is a mount '{}' already", mount.name));
  }
}

}  // namespace

PlanSpec plan_of(YamlMap map, const RadioDefaults& radio, double duration_s,
                 Diagnostics& diagnostics) {
  PlanSpec plan;
  plan.dwell_s = map.number("dwell_s", duration_s, kPositive);
  if (plan.dwell_s > 86'400.0) map.at("dwell_s").fail("must be at most a day");
  plan.margin_db = map.number("margin_db", 0.0, kNotNegative);
  for (const YamlValue& tags : map.list("tags")) {
    plan.tags.push_back(tags_of(YamlMap(tags), radio, diagnostics));
  }
  for (const YamlValue& mount : map.list("mounts")) {
    add_mounts(YamlMap(mount), radio, diagnostics, plan.mounts);
  }
  if (plan.mounts.empty()) map.self().fail("has no 'mounts': positions where antennas can be");
  leave_out_forbidden(map, plan.mounts);
  require_unique_names(plan.mounts);
  if (map.has("limits")) plan.limits = limits_of(YamlMap(map.at("limits")));
  if (map.has("aim")) plan.aim = aim_of(YamlMap(map.at("aim")));
  if (plan.aim.position_error_m) require_rest(map.at("aim"), plan.tags);
  map.finish();
  return plan;
}

}  // namespace tagfield
