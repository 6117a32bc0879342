// SPDX-License-Identifier: Apache-2.0
/// @file
/// Placement of antennas: ranked layouts, with their costs, what they read, and the uncertainty of
/// that.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/report/coverage.h"

namespace tagfield {

/// One antenna of a layout.
struct PlannedAntenna {
  std::string name;
  std::string mount;
  std::string reader;
  std::string zone;                                        ///< "" for none.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();           ///< [m]
  Eigen::Vector3d boresight_W = Eigen::Vector3d::UnitX();  ///< Unit vector.
  double power_dbm = 0.0;                                  ///< At the reader's port.
  double cost = 0.0;
};

/// How many of a zone's tags are read, and how many by readers of other zones.
struct PlannedZone {
  std::string zone;
  std::size_t tags = 0;
  ExpectedCount read;   ///< Tags read by any reader, counted as in PlannedLayout::read.
  ExpectedCount cross;  ///< Tags read by a reader of another zone.
};

/// The aim for each tag.
struct PlannedAim {
  enum class Kind { kReadProbability, kReads, kPosition };
  Kind kind = Kind::kReadProbability;
  /// Value beyond which more is worth nothing: a probability, reads within the dwell time, or a
  /// bound on the position error [m].
  double value = 1.0;
  std::optional<double> share{};   ///< Share of it over all tags that is sufficient,
  bool is_for_least_cost = false;  ///< reached with the lowest cost instead of the fewest antennas.
};

/// "read", "read at least 5 times", "locatable to within 0.3 m": description of the tags that
/// attain the aim.
std::string words_for(const PlannedAim& aim);

/// The best layout found for one number of antennas.
struct PlannedLayout {
  std::vector<PlannedAntenna> antennas;
  std::size_t readers = 0;
  double cost = 0.0;
  double score = 0.0;  ///< The objective of the selection (SelectionProblem), before contention.
  /// Compared with PlannedAim::share: the score if the aim is a probability, else the forecast
  /// share of tags that attain the aim.
  double share = 0.0;
  double bound = 1.0;     ///< Upper bound for layouts with as many antennas within the limits.
  bool is_exact = false;  ///< Whether the bound is from an integer program.
  /// Tags that are read within the dwell time or, if the aim is not just a probability, attain the
  /// aim. Includes slots and hops, as all counts do.
  ExpectedCount read;
  /// Tags read by a reader of another zone, without subtracting `plan.margin_db` from the links.
  ExpectedCount cross;
  std::vector<PlannedZone> zones;
  /// For each of AntennaPlan::places, the read probability, or the share of orientations and fading
  /// states in which the aim is attained.
  std::vector<double> places;
  /// If the aim is a position error, for each of the places its bound in the plane [m, RMS];
  /// infinite if too few antennas read it, or all from the same direction.
  std::vector<double> errors_m;
};

/// A possible position of tags.
struct PlannedPlace {
  std::string group;
  std::string zone;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
};

/// A position that remains hard to read, and why.
struct HardPlace {
  std::size_t place = 0;  ///< Index into AntennaPlan::places.
  double probability = 0.0;
  std::string best_antenna;
  double distance_m = 0.0;
  double median_db = 0.0;  ///< Margin of the best link, median over fading and orientations.
  std::string why;
};

/// The result of the chosen layout under a changed assumption.
struct PlanVariant {
  std::string what;
  ExpectedCount read;
};

/// The chosen layout in full simulations.
struct PlanCheck {
  std::vector<std::uint64_t> seeds;
  std::vector<double> read;  ///< Tags, by seed.
  std::size_t inside = 0;    ///< Number of runs within the stated interval.
  /// Tags read by readers of other zones, by seed, and number of runs within the stated interval;
  /// empty if there are fewer than two zones.
  std::vector<double> cross;
  std::size_t cross_inside = 0;
};

struct AntennaPlan {
  std::string scenario;
  std::string description;
  double dwell_s = 0.0;
  std::size_t tags = 0;     ///< Number of tags present in the dwell time.
  std::size_t options = 0;  ///< Number of options to mount an antenna, including powers.
  PlannedAim aim;
  std::optional<double> cross_limit;
  std::string limits;                ///< Human-readable.
  std::string stopped_by;            ///< What prevents more antennas; "" for nothing.
  std::optional<double> guaranteed;  ///< Share of the optimum that the greedy selection guarantees.
  std::vector<PlannedLayout> layouts;  ///< From one antenna upwards.
  std::size_t chosen = 0;              ///< Index into `layouts`.
  bool reaches_aim = true;
  std::vector<PlannedPlace> places;
  std::vector<HardPlace> hard;  ///< Of the chosen layout, hardest first.
  std::vector<PlanVariant> sensitivity;
  std::optional<PlanCheck> check;
  std::vector<std::string> warnings;
};

/// `antennas,readers,cost,score,share,bound,read_mean,read_low,read_high,cross_worst`, one row per
/// layout.
std::string plan_layouts_to_csv(const AntennaPlan& plan);
/// `antennas,antenna,mount,reader,zone,x_m,y_m,z_m,boresight_x,…,power_dbm,cost`, one row per
/// antenna of each layout.
std::string plan_antennas_to_csv(const AntennaPlan& plan);
/// `group,zone,x_m,y_m,z_m,p_1,p_2,…`: PlannedLayout::places by number of antennas, and
/// `error_m_1,…` if the aim is a position error, empty for infinite; one row per place.
std::string plan_positions_to_csv(const AntennaPlan& plan);
/// Everything except the places as JSON text.
std::string plan_to_json(const AntennaPlan& plan);

}  // namespace tagfield
