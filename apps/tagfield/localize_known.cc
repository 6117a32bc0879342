// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/localize_known.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/number_checks.h"
#include "tagfield/base/number.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/experiment/odometry_drift.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/files/tag_positions_csv.h"

namespace tagfield {
namespace {

TagHeights heights_of(const LocalizeArguments& arguments) {
  TagHeights heights;
  heights.of_all = arguments.tag_height_m;
  heights.of_tag = arguments.tables.heights;
  const std::string& side =
      arguments.height_side.empty() ? arguments.old_height_side : arguments.height_side;
  if (side == "above") heights.estimated = HeightSide::kAbove;
  if (side == "below") heights.estimated = HeightSide::kBelow;
  return heights;
}

/// Parses "RAD", which applies to all antennas, or "ANTENNA=RAD".
KnownOffset parse_offset(const std::string& word) {
  const std::size_t equals = word.rfind('=');
  const std::string number = equals == std::string::npos ? word : word.substr(equals + 1);
  const auto offset = parse_number(number);
  if (!offset || equals == 0) {
    throw Error("localize: --offset is '" + word + "', expected RAD or ANTENNA=RAD");
  }
  return {equals == std::string::npos ? "" : word.substr(0, equals), std::nullopt, *offset};
}

/// An offset for each antenna of the reads for which one is given; one with its name takes
/// precedence.
std::vector<KnownOffset> offsets_of(const std::vector<std::string>& words,
                                    const ReadOverview& reads) {
  std::set<std::string> antennas;
  for (const auto& [antenna, last] : reads.last_by_antenna) antennas.insert(antenna);
  std::vector<KnownOffset> named;
  std::vector<KnownOffset> of_all;
  for (const std::string& word : words) {
    KnownOffset offset = parse_offset(word);
    if (!offset.antenna.empty() && antennas.count(offset.antenna) == 0) {
      throw Error(fmt::format(
          "localize: --offset: there are no reads of antenna '{}'{}", offset.antenna,
          suggestion(offset.antenna, std::vector<std::string>(antennas.begin(), antennas.end()))));
    }
    (offset.antenna.empty() ? of_all : named).push_back(std::move(offset));
  }
  for (KnownOffset offset : of_all) {
    for (const std::string& antenna : antennas) {
      offset.antenna = antenna;
      named.push_back(offset);
    }
  }
  return named;
}

/// Where tags can be; corners of the box in any order.
TagArea area_of(const LocalizeArguments& arguments) {
  TagArea area;
  if (!arguments.side.empty()) area.side = tag_side(arguments.side);
  if (arguments.box.empty()) return area;
  const Eigen::Vector2d one(arguments.box[0], arguments.box[1]);
  const Eigen::Vector2d other(arguments.box[2], arguments.box[3]);
  area.box = Eigen::AlignedBox2d(one.cwiseMin(other), one.cwiseMax(other));
  return area;
}

template <class Value>
void warn_of_unread(const std::string& option, const std::string& file,
                    const std::map<std::string, Value>& named, const ReadOverview& reads,
                    Diagnostics& diagnostics) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> first;
  std::size_t count = 0;
  for (const auto& [tag, value] : named) {
    if (reads.count_by_tag.count(tag) > 0) continue;
    if (++count <= kNamed) first.push_back(tag);
  }
  if (count == 0) return;
  const std::string hint = count == 1 ? suggestion(first.front(), reads.tags) : "";
  diagnostics.warn({file, 0}, fmt::format("{}: {} of {} tags were never read, '{}'{}{}", option,
                                          count, named.size(), fmt::join(first, "', '"),
                                          count > kNamed ? " and so on" : "", hint));
}

}  // namespace

KnownTables known_tables(const LocalizeArguments& arguments) {
  KnownTables tables;
  if (!arguments.heights_file.empty())
    tables.heights = read_tag_heights_csv(arguments.heights_file);
  if (!arguments.references_file.empty()) {
    tables.references = read_tag_positions_csv(arguments.references_file);
  }
  if (!arguments.odometry_file.empty()) {
    tables.odometry = read_odometry_csv(arguments.odometry_file);
  }
  return tables;
}

void warn_of_unread_tags(const LocalizeArguments& asked, const KnownTables& tables,
                         const ReadOverview& reads, Diagnostics& diagnostics) {
  if (!asked.references_file.empty()) {
    warn_of_unread("--reference", asked.references_file, tables.references, reads, diagnostics);
  }
  if (!asked.heights_file.empty()) {
    warn_of_unread("--tag-heights", asked.heights_file, tables.heights, reads, diagnostics);
  }
}

namespace {

void add_pose_error_options(CLI::App& command, LocalizeArguments& arguments) {
  CLI::Option* sigma =
      command
          .add_option("--pose-sigma", arguments.pose_sigma_m,
                      "Error of the poses, standard deviation in x and y [m]; 0 for exact "
                      "(default: the covariances in the table of poses, or unknown)")
          ->check(CLI::Range(0.0, kMaxLength_m));
  command
      .add_option("--odometry", arguments.odometry_file,
                  "The poses are wheel odometry: where its antennas are on their robots, and its "
                  "errors, as odometry.csv of a run (docs/files.md); its drift is then in the "
                  "expected errors")
      ->excludes(sigma);
  command.add_option("--pose-yaw-sigma", arguments.pose_yaw_sigma_deg, "Likewise in yaw [deg]")
      ->check(fault_of_non_negative)
      ->needs(sigma);
  command
      .add_option("--pose-time-constant", arguments.pose_time_constant_s,
                  "Time constant of the poses' error [s] (default 5)")
      ->check(fault_of_positive)
      ->needs(sigma);
  CLI::Option* map_sigma = command
                               .add_option("--map-sigma", arguments.map_sigma_m,
                                           "Error of the map that the poses refer to, as a whole: "
                                           "standard deviation of its shift in x and y [m]")
                               ->check(CLI::Range(0.0, kMaxLength_m));
  command
      .add_option("--map-yaw-sigma", arguments.map_yaw_sigma_deg,
                  "Likewise of its rotation about the first pose [deg]")
      ->check(fault_of_non_negative)
      ->needs(map_sigma);
}

}  // namespace

void add_known_options(CLI::App& command, LocalizeArguments& arguments) {
  CLI::Option* of_all =
      command
          .add_option("--tag-height", arguments.tag_height_m,
                      "Height of the tags [m, world] (default: the mean height of the antenna)")
          ->check(CLI::Range(-kMaxLength_m, kMaxLength_m));
  command.add_option("--tag-heights", arguments.heights_file,
                     "CSV: tag,height_m; takes precedence over --tag-height");
  CLI::Option* vertical =
      command
          .add_option("--vertical-side", arguments.height_side,
                      "above or below: unknown heights are estimated, on that side of the antennas")
          ->check(CLI::IsMember({"above", "below"}))
          ->excludes(of_all);
  // The original name; in other commands --height is a number.
  command.add_option("--height", arguments.old_height_side)
      ->check(CLI::IsMember({"above", "below"}))
      ->excludes(of_all)
      ->excludes(vertical)
      ->group("");
  command
      .add_option("--circular", arguments.circular,
                  "right or left: hand of the antennas' circular polarization, to allow for the "
                  "phase shift by the orientation of a tag's wire; requires the antennas' "
                  "orientation in the poses")
      ->check(CLI::IsMember({"right", "left"}));
  command
      .add_option(
          "--side", arguments.side,
          "Side of the antennas' path on which tags are: left or right of the motion, or +x, "
          "-x, +y, -y")
      ->check(CLI::IsMember({"left", "right", "+x", "-x", "+y", "-y"}));
  command
      .add_option("--box", arguments.box,
                  "Box in which tags are, seen from above: X0 Y0 X1 Y1 [m, world]")
      ->expected(4)
      ->delimiter(',')
      ->check(CLI::Range(-kMaxLength_m, kMaxLength_m));
  command.add_option("--reference", arguments.references_file,
                     "Tags at known positions (CSV: tag,x_m,y_m,z_m)");
  command
      .add_option("--offset", arguments.offsets,
                  "Known phase offset [rad]: RAD of all antennas or ANTENNA=RAD. Can be given "
                  "several times")
      ->take_all()
      ->allow_extra_args(false);
  add_pose_error_options(command, arguments);
  command
      .add_option("--world-sigma", arguments.world_sigma_m,
                  "For 'multipath': how far surfaces of the scenario's world may be from their "
                  "stated positions, standard deviation in x and y [m] (default 0 in the folder of "
                  "a run, else 0.01)")
      ->check(CLI::Range(0.0, kMaxLength_m))
      ->needs("--scenario");
}

void take_known(const LocalizeArguments& arguments, const ReadOverview& reads,
                KnownBeforehand& known) {
  if (arguments.tag_height_m || !arguments.heights_file.empty() || !arguments.height_side.empty() ||
      !arguments.old_height_side.empty()) {
    known.heights = heights_of(arguments);
  }
  if (!arguments.side.empty() || !arguments.box.empty()) known.area = area_of(arguments);
  if (!arguments.references_file.empty()) {
    known.reference_tags = arguments.tables.references;
  }
  if (!arguments.offsets.empty()) known.offsets = offsets_of(arguments.offsets, reads);
  if (!arguments.odometry_file.empty()) known.drift = drift_by(arguments.tables.odometry);
  if (arguments.circular.empty()) return;
  const Hand hand = arguments.circular == "right" ? Hand::kRight : Hand::kLeft;
  for (const auto& [antenna, last] : reads.last_by_antenna) known.circular[antenna] = hand;
}

std::optional<MapError> map_error_of(const LocalizeArguments& arguments, const std::string& poses) {
  if (!arguments.map_sigma_m || poses == "true") return std::nullopt;
  const double sigma_m = *arguments.map_sigma_m;
  const double sigma_rad = radians(arguments.map_yaw_sigma_deg.value_or(0.0));
  MapError error;
  error.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  return error;
}

double world_sigma_of(const LocalizeArguments& arguments, const std::string& method,
                      const KnownBeforehand& known) {
  if (arguments.world_sigma_m && (!known.trace || (method != "multipath" && method != "auto"))) {
    throw Error(
        "localize: --world-sigma has no effect: it requires method multipath or auto, and a "
        "scenario with model: multipath");
  }
  return arguments.world_sigma_m.value_or(is_run(arguments.recording) ? 0.0
                                                                      : kMeasuredWorldSigma_m);
}

std::optional<PoseErrorModel> pose_error_of(const LocalizeArguments& arguments,
                                            const Scenario* scenario, const std::string& poses) {
  if (poses == "true") return PoseErrorModel{};
  if (arguments.pose_sigma_m) {
    PoseErrorModel model;
    model.sigma_m = *arguments.pose_sigma_m;
    model.yaw_sigma_rad = radians(arguments.pose_yaw_sigma_deg.value_or(0.0));
    model.time_constant_s = arguments.pose_time_constant_s.value_or(model.time_constant_s);
    return model;
  }
  if (scenario == nullptr) return std::nullopt;
  if (!arguments.odometry_file.empty()) return scenario->localization.pose_error;
  if (poses == "given") return known_beforehand(*scenario).pose_error;
  return scenario->localization.pose_error;
}

void warn_of_unused_options(const LocalizeArguments& arguments, const Method& method,
                            const std::string& poses, Diagnostics& diagnostics) {
  const auto warn = [&](bool is_unused, const char* option, const std::string& why) {
    if (is_unused) diagnostics.warn(fmt::format("{} has no effect with {}", option, why));
  };
  const bool is_exact = poses == "true";
  warn(!arguments.offsets.empty() && all_ignore({method}, "offset"), "--offset", method.name);
  warn(arguments.pose_sigma_m && is_exact, "--pose-sigma", "the true poses");
  warn(arguments.pose_sigma_m && !is_exact && all_ignore({method}, "pose_error"), "--pose-sigma",
       method.name);
  warn(arguments.map_sigma_m && is_exact, "--map-sigma", "the true poses");
}

}  // namespace tagfield
