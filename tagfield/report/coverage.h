// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where in a hall tags would be read: a grid of cells at several heights, and the scenario's own
/// tags. docs/coverage.md says what the figures mean.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// Cells of a square grid, each with its middle half a step from its edges.
struct CoverageGrid {
  Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();  ///< Least x and y.
  double step_m = 0.1;
  std::size_t columns = 0;  ///< Along x.
  std::size_t rows = 0;     ///< Along y.

  [[nodiscard]] Eigen::Vector2d middle(std::size_t column, std::size_t row) const {
    return corner_m + step_m * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                               static_cast<double>(row) + 0.5);
  }
  [[nodiscard]] std::size_t size() const { return columns * rows; }
};

/// What nothing arrives at has [dB, dBm].
inline constexpr double kNoPower_db = -400.0;
/// Below this nothing is said to arrive.
inline constexpr double kLeastPower_db = -250.0;
/// From this probability on a tag counts as read.
inline constexpr double kReadProbability = 0.5;

/// A tag in one place, of the antenna place with the greatest margin.
struct CoverageCell {
  double power_dbm = kNoPower_db;  ///< At the chip; by the paper's model the RSSI.
  double reply_dbm = kNoPower_db;  ///< At the reader's port; by the paper's model as well.
  double margin_db = kNoPower_db;  ///< The lesser of tag's and reader's.
  double probability = 0.0;        ///< Greatest over all antennas and their places.
  int antenna = -1;                ///< Index into Coverage::antennas; -1 where nothing arrives.
};

struct CoverageLayer {
  double height_m = 0.0;
  std::vector<CoverageCell> cells;  ///< Row by row from the least y on, x rising in each.
};

struct CoverageAntenna {
  std::string name;
  std::vector<Eigen::Vector3d> places_W;  ///< All where it was taken to be [m]; one if it is fixed.
  bool by_paper = false;                  ///< The paper's model, which has no margins in dB.
};

/// From this probability on, a reader that a tag is not meant for counts as one that reads it.
inline constexpr double kCrossProbability = 0.05;
/// A tag of which every link lacks more than that in every fading state is never read.
inline constexpr double kNeverMargin_db = -6.0;

/// What becomes of a tag over the whole run.
enum class TagVerdict {
  kNever,      ///< Every link is short of what it takes by more than any fading gives.
  kIntended,   ///< A reader that it is meant for reads it, more likely than not, and no other.
  kAlsoOther,  ///< One that it is meant for, and others.
  kWrong,      ///< More likely than not others do, but not one that it is meant for.
  kSeldom,     ///< It may be read, but less likely than not.
};

/// How likely a reader reads a tag at least once in the run.
struct ReaderChance {
  std::string reader;
  double probability = 0.0;
  bool is_meant = true;  ///< The tag is meant for it.
};

/// A count expected of the run, and the range that it is in with 95 % confidence.
struct ExpectedCount {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// One of the scenario's own tags.
struct TagCoverage {
  std::string id;
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();  ///< [m] Where it begins, if it moves.
  int nearest = -1;                                ///< The antenna that comes nearest.
  double nearest_m = 0.0;                          ///< How near.
  CoverageCell best;                   ///< By the antenna with the greatest margin, at one moment.
  double probability = 0.0;            ///< To be read at least once in the run.
  std::vector<ReaderChance> readers;   ///< Those that may read it, the likeliest first.
  std::vector<std::string> meant_for;  ///< Readers: of its zone, or the nearest antenna's.
  TagVerdict verdict = TagVerdict::kNever;
};

struct Coverage {
  std::string scenario;
  std::string description;
  std::string tag_kind;     ///< For people.
  std::string orientation;  ///< Likewise.
  std::string moment;       ///< Likewise: the whole drive, or one time.
  std::vector<CoverageAntenna> antennas;
  CoverageGrid grid;
  std::vector<CoverageLayer> layers;
  std::vector<TagCoverage> tags;
  double run_s = 0.0;           ///< That the tags' probabilities are for.
  ExpectedCount expected_read;  ///< Of the tags, in that time.
  std::vector<std::string> warnings;
};

/// Share of a layer's cells in which a tag is read.
double share_read(const CoverageLayer& layer);

/// Whether all antennas are of the paper's model: then powers are RSSI.
bool is_by_paper(const Coverage& coverage);

/// `x_m,y_m,power_dbm,reply_dbm,margin_db,probability,antenna`, a row a cell; empty fields where
/// nothing arrives.
std::string coverage_to_csv(const Coverage& coverage, const CoverageLayer& layer);

/// `tag,x_m,y_m,z_m,verdict,nearest,nearest_m,meant_for,read_by,read_probability,power_dbm,
/// reply_dbm,margin_db,probability`; `read_by` has the readers that read it with at least
/// kCrossProbability.
std::string coverage_tags_to_csv(const Coverage& coverage);

/// "coverage_1.25m.csv".
std::string coverage_file(const CoverageLayer& layer);

/// Summary of all as JSON text.
std::string coverage_to_json(const Coverage& coverage);

/// "never", "intended", "also_other", "wrong", "seldom".
const char* word_of(TagVerdict verdict);

}  // namespace tagfield
