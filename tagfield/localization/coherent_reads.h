/// @file
/// Phases as they were measured, not unwrapped: reads of one antenna on one carrier share an
/// offset, and that is all that is asked of them. For the methods that add up waves
/// (docs/methods.md).
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tagfield/localization/phase_sample.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/segment_fit.h"

namespace tagfield {

/// Reads that share one phase offset: φ = offset + k r, with the antenna-tag distance r.
struct CoherentGroup {
  Eigen::Index begin = 0;
  Eigen::Index count = 0;
  double wavenumber = 0.0;    ///< k = 4π/λ [rad/m], there and back.
  bool offset_known = false;  ///< The offset is 0, as it was taken out.
};

/// All reads of a tag, group after group, each in rising order of time.
struct CoherentReads {
  Eigen::ArrayXd x, y, z;  ///< Antenna [m, world].
  Eigen::ArrayXd phase;    ///< [rad]
  std::vector<CoherentGroup> groups;
};

/// Length of an aperture that takes in all of a group [m].
inline constexpr double kWholeAperture = std::numeric_limits<double>::infinity();

/// Groups the samples by antenna and carrier. Reads that can tell nothing are left out: of antennas
/// that stood still, and single ones, unless their offset is known.
CoherentReads make_coherent_reads(const SamplesOfTag& samples,
                                  const std::set<std::string>& offset_known);

/// Why so few reads can't locate a tag; empty if they might.
std::string too_few(const CoherentReads& reads);

/// The groups cut into pieces over each of which the antenna travelled at most `length` [m]. Pieces
/// of a group have offsets of their own, so only a whole group keeps its known one.
std::vector<CoherentGroup> apertures(const CoherentReads& reads, double length);

/// The antennas' places and groups in the form that residuals.h and mirror_image() take; distances
/// and heights are 0.
FitData layout_of(const CoherentReads& reads);

/// Longest wavelength λ among the groups [m].
double longest_wavelength(const CoherentReads& reads);

/// How a tag's height enters its distance from the antennas.
struct HeightModel {
  enum class Kind {
    kKnown,   ///< It is `level`.
    kSquare,  ///< Antennas are at `level`; q = (z − level)² is unknown, which r² is linear in.
    kFree,    ///< Antennas are at several heights; z itself is unknown.
  };
  Kind kind = Kind::kKnown;
  double level = 0.0;                    ///< [m, world]
  HeightSide side = HeightSide::kAbove;  ///< Of `level`, on which a tag of unknown height is.
};

/// The problem's knowledge of this tag's height.
HeightModel height_model(const LocalizationProblem& problem, const std::string& tag,
                         const CoherentReads& reads);

/// A place as the fit sees it: (x, y, v) with v the height z [m], or q [m²] in Kind::kSquare.
using FitPlace = Eigen::Vector3d;

/// (z_tag − z_antenna)² [m²] of a tag with this v.
inline double height_squared(const HeightModel& model, double v, double antenna_z) {
  return model.kind == HeightModel::Kind::kSquare ? v : (v - antenna_z) * (v - antenna_z);
}

/// A place at (x, y) and `height` [m] as the fit sees it.
FitPlace fit_place(const HeightModel& model, const Eigen::Vector2d& p, double height);

/// The place in the world; a negative q counts as 0.
Eigen::Vector3d world_place(const HeightModel& model, const FitPlace& place);

}  // namespace tagfield
