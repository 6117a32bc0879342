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

enum class TagVerdict {
  kNever,      ///< No antenna reads it.
  kIntended,   ///< Its nearest antenna reads it, and no other does.
  kAlsoOther,  ///< Its nearest antenna and others.
  kWrong,      ///< Others, but not its nearest.
};

/// One of the scenario's own tags.
struct TagCoverage {
  std::string id;
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();  ///< [m] Where it begins, if it moves.
  int nearest = -1;          ///< The antenna that comes nearest: the one it is meant for.
  double nearest_m = 0.0;    ///< How near.
  CoverageCell best;         ///< By the antenna with the greatest margin.
  std::vector<int> read_by;  ///< Antennas that read it, rising.
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
  std::vector<std::string> warnings;
};

/// Share of a layer's cells in which a tag is read.
double share_read(const CoverageLayer& layer);

/// Whether all antennas are of the paper's model: then powers are RSSI.
bool is_by_paper(const Coverage& coverage);

/// `x_m,y_m,power_dbm,reply_dbm,margin_db,probability,antenna`, a row a cell; empty fields where
/// nothing arrives.
std::string coverage_to_csv(const Coverage& coverage, const CoverageLayer& layer);

/// `tag,x_m,y_m,z_m,verdict,nearest,nearest_m,read_by,power_dbm,reply_dbm,margin_db,probability`.
std::string coverage_tags_to_csv(const Coverage& coverage);

/// "coverage_1.25m.csv".
std::string coverage_file(const CoverageLayer& layer);

/// Summary of all as JSON text.
std::string coverage_to_json(const Coverage& coverage);

/// "never", "intended", "also_other", "wrong".
const char* word_of(TagVerdict verdict);

}  // namespace tagfield
