// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where in a hall tags would be read: a grid of cells at several heights, and the scenario's own
/// tags. docs/coverage.md explains the figures.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// A grid of square cells.
struct CoverageGrid {
  Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();  ///< Minimum x and y.
  double step_m = 0.1;
  std::size_t columns = 0;  ///< Along x.
  std::size_t rows = 0;     ///< Along y.

  [[nodiscard]] Eigen::Vector2d middle(std::size_t column, std::size_t row) const {
    return corner_m + step_m * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                               static_cast<double>(row) + 0.5);
  }
  [[nodiscard]] std::size_t size() const { return columns * rows; }
};

/// Value where no signal arrives [dB, dBm].
inline constexpr double kNoPower_db = -400.0;
/// Below this, no signal is considered to arrive.
inline constexpr double kMinPower_db = -250.0;
/// Minimum probability for a tag to count as read.
inline constexpr double kReadProbability = 0.5;

/// A tag at one position, for the antenna position with the greatest margin.
struct CoverageCell {
  double power_dbm = kNoPower_db;  ///< At the chip; in the paper's model the RSSI.
  double reply_dbm = kNoPower_db;  ///< At the reader's port; in the paper's model, too, the RSSI.
  double margin_db = kNoPower_db;  ///< The smaller of the tag's and the reader's.
  double probability = 0.0;        ///< Maximum over all antennas and their positions.
  int antenna = -1;                ///< Index into Coverage::antennas; -1 if no signal arrives.
};

struct CoverageLayer {
  double height_m = 0.0;
  std::vector<CoverageCell> cells;  ///< Row by row from the minimum y, with x ascending in each.
};

struct CoverageAntenna {
  std::string name;
  std::vector<Eigen::Vector3d> places_W;  ///< Evaluated positions [m]; one if it is fixed.
  bool by_paper = false;  ///< Whether it has the paper's model, which has no margins in dB.
};

/// Minimum probability for an unintended reader to count as one that reads a tag.
inline constexpr double kCrossProbability = 0.05;
/// A tag is never read if the margins of all links are below this in every fading state.
inline constexpr double kNeverMargin_db = -6.0;

/// The outcome for a tag over the whole run.
enum class TagVerdict {
  kNever,      ///< Every link falls short by more than fading can make up for.
  kIntended,   ///< More likely than not, an intended reader reads it, and no other one does.
  kAlsoOther,  ///< An intended reader reads it, and others do as well.
  kWrong,      ///< More likely than not, other readers read it, but no intended one does.
  kSeldom,     ///< It may be read, but less likely than not.
};

/// Probability that a reader reads a tag at least once in the run.
struct ReaderChance {
  std::string reader;
  double probability = 0.0;
  bool is_meant = true;  ///< Whether the tag is meant for it.
};

/// The expected value of a count in the run, and its 95 % confidence interval.
struct ExpectedCount {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// One of the scenario's own tags.
struct TagCoverage {
  std::string id;
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();  ///< [m] Where it appears, if it moves.
  int nearest = -1;                                ///< The antenna that comes closest.
  double nearest_m = 0.0;                          ///< Its minimum distance.
  CoverageCell best;                   ///< For the antenna with the greatest margin, at one time.
  double probability = 0.0;            ///< Of being read at least once in the run.
  std::vector<ReaderChance> readers;   ///< Those that may read it, the likeliest first.
  std::vector<std::string> meant_for;  ///< Readers of its zone, or the nearest antenna's.
  TagVerdict verdict = TagVerdict::kNever;
};

struct Coverage {
  std::string scenario;
  std::string description;
  std::string tag_kind;     ///< Human-readable.
  std::string orientation;  ///< Human-readable.
  std::string moment;       ///< Human-readable: the whole drive, or one time.
  std::vector<CoverageAntenna> antennas;
  CoverageGrid grid;
  std::vector<CoverageLayer> layers;
  std::vector<TagCoverage> tags;
  double run_s = 0.0;           ///< Time that the tags' probabilities are for.
  ExpectedCount expected_read;  ///< Number of tags read in that time.
  std::vector<std::string> warnings;
};

/// Share of a layer's cells in which a tag is read.
double share_read(const CoverageLayer& layer);

/// Whether all antennas have the paper's model, so that powers are RSSI.
bool is_by_paper(const Coverage& coverage);

/// `x_m,y_m,power_dbm,reply_dbm,margin_db,probability,antenna`, one row per cell; empty fields
/// where no signal arrives.
std::string coverage_to_csv(const Coverage& coverage, const CoverageLayer& layer);

/// `tag,x_m,y_m,z_m,verdict,nearest,nearest_m,meant_for,read_by,read_probability,power_dbm,
/// reply_dbm,margin_db,probability`; `read_by` lists the readers that read it with a probability of
/// at least kCrossProbability.
std::string coverage_tags_to_csv(const Coverage& coverage);

/// "coverage_1.25m.csv".
std::string coverage_file(const CoverageLayer& layer);

/// A summary of the coverage as JSON text.
std::string coverage_to_json(const Coverage& coverage);

/// "never", "intended", "also_other", "wrong", "seldom".
const char* word_of(TagVerdict verdict);

}  // namespace tagfield
