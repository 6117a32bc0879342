// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where antennas go: ranked layouts, what each costs and reads, and how sure that is.
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

/// How much of a zone's tags are read, and by others.
struct PlannedZone {
  std::string zone;
  std::size_t tags = 0;
  ExpectedCount read;   ///< Tags, by anyone, as PlannedLayout::read counts them.
  ExpectedCount cross;  ///< Tags that a reader of another zone reads.
};

/// What each tag is to have.
struct PlannedAim {
  enum class Kind { kReadProbability, kReads, kPosition };
  Kind kind = Kind::kReadProbability;
  /// Beyond which more is worth nothing: a probability, reads in the time, or a bound on the error
  /// of its place [m].
  double value = 1.0;
  std::optional<double> share{};   ///< Of it that is enough, over all tags,
  bool is_for_least_cost = false;  ///< for the least cost, instead of antennas.
};

/// "read", "read at least 5 times", "locatable to within 0.3 m": tags that have what is aimed at.
std::string words_for(const PlannedAim& aim);

/// The best layout found of so many antennas.
struct PlannedLayout {
  std::vector<PlannedAntenna> antennas;
  std::size_t readers = 0;
  double cost = 0.0;
  double score = 0.0;  ///< What the choice maximizes (SelectionProblem), before contention.
  /// To be held against PlannedAim::share: of a probability the score, else the share of tags that
  /// have what is aimed at, as forecast.
  double share = 0.0;
  double bound = 1.0;     ///< No layout of as many antennas within the limits has more.
  bool is_exact = false;  ///< The bound is of an integer program.
  /// Tags that have in the time what is aimed at, if that is not a mere probability; else that are
  /// read. Slots and hops included, as in all counts.
  ExpectedCount read;
  /// Tags that a reader of another zone reads, with links as they are, `plan.margin_db` not taken
  /// off.
  ExpectedCount cross;
  std::vector<PlannedZone> zones;
  /// For AntennaPlan::places, the probability to be read, or the share of orientations and fading
  /// states in which the aim is met.
  std::vector<double> places;
  /// Where positions are aimed at, for each place the bound on its error [m], root mean square over
  /// the plane; infinite where too few antennas read it, or from one direction.
  std::vector<double> errors_m;
};

/// A place where tags can be.
struct PlannedPlace {
  std::string group;
  std::string zone;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
};

/// A place that stays hard to read, and why.
struct HardPlace {
  std::size_t place = 0;  ///< Index into AntennaPlan::places.
  double probability = 0.0;
  std::string best_antenna;
  double distance_m = 0.0;
  double median_db = 0.0;  ///< Margin of the best link, the median over fading and orientations.
  std::string why;
};

/// What becomes of the chosen layout where something is otherwise.
struct PlanVariant {
  std::string what;
  ExpectedCount read;
};

/// The chosen layout in full simulations.
struct PlanCheck {
  std::vector<std::uint64_t> seeds;
  std::vector<double> read;  ///< Tags, by seed.
  std::size_t inside = 0;    ///< Of the runs, those within the stated range.
  /// Tags that readers of other zones read, by seed, and how many of that lie within the stated
  /// range; empty where there are no two zones.
  std::vector<double> cross;
  std::size_t cross_inside = 0;
};

struct AntennaPlan {
  std::string scenario;
  std::string description;
  double dwell_s = 0.0;
  std::size_t tags = 0;     ///< That are there in the time.
  std::size_t options = 0;  ///< Ways to mount an antenna, powers included.
  PlannedAim aim;
  std::optional<double> cross_limit;
  std::string limits;                  ///< For people.
  std::string stopped_by;              ///< What keeps more antennas out; "" for nothing.
  std::optional<double> guaranteed;    ///< Share of the best that greed has for sure.
  std::vector<PlannedLayout> layouts;  ///< From one antenna up.
  std::size_t chosen = 0;              ///< Index into `layouts`.
  bool reaches_aim = true;
  std::vector<PlannedPlace> places;
  std::vector<HardPlace> hard;  ///< Of the chosen layout, the hardest first.
  std::vector<PlanVariant> sensitivity;
  std::optional<PlanCheck> check;
  std::vector<std::string> warnings;
};

/// `antennas,readers,cost,score,share,bound,read_mean,read_low,read_high,cross_worst`, a row a
/// layout.
std::string plan_layouts_to_csv(const AntennaPlan& plan);
/// `antennas,antenna,mount,reader,zone,x_m,y_m,z_m,boresight_x,…,power_dbm,cost`, a row an antenna
/// of each layout.
std::string plan_antennas_to_csv(const AntennaPlan& plan);
/// `group,zone,x_m,y_m,z_m,p_1,p_2,…`: by number of antennas what PlannedLayout::places has, and
/// `error_m_1,…` where positions are aimed at, empty for infinite; a row a place.
std::string plan_places_to_csv(const AntennaPlan& plan);
/// All but the places as JSON text.
std::string plan_to_json(const AntennaPlan& plan);

}  // namespace tagfield
