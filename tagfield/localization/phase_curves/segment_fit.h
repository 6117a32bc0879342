/// @file
/// Least squares on unwrapped phase: how well a place explains the segments, each of which has an
/// offset of its own, and the best place near a given one.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tagfield/localization/phase_curves/unwrap.h"

namespace tagfield {

/// Segments laid out for the fit. All reads of all segments, one after the other.
struct FitData {
  struct Span {
    Eigen::Index begin = 0;
    Eigen::Index count = 0;
    double cycle_m = 0.0;  ///< λ/2: what one turn of the phase is in distance.
  };
  Eigen::ArrayXd x, y;            ///< Antenna [m].
  Eigen::ArrayXd height_squared;  ///< (z_tag − z_antenna)² [m²].
  Eigen::ArrayXd distance;        ///< Unwrapped distance since the segment's first read [m].
  std::vector<Span> spans;
};

/// Lays out the segments of at least two reads, for a tag at `height` [m].
FitData make_fit_data(const std::vector<PhaseSegment>& segments, double height);

/// About `reads` of the reads, spread evenly, every segment of `data` represented by two or more
/// as long as `reads` allows (after that the shorter segments are left out).
FitData thinned(const FitData& data, Eigen::Index reads);

/// Unwrapped distance less predicted distance at `p`, each segment's mean removed [m].
Eigen::ArrayXd residuals(const FitData& data, const Eigen::Vector2d& p);

/// Sum of the squared residuals [m²].
double sum_of_squares(const FitData& data, const Eigen::Vector2d& p);

/// Σ Jᵀ J of the residuals at `p`, offsets eliminated.
Eigen::Matrix2d normal_matrix(const FitData& data, const Eigen::Vector2d& p);

/// The local minimum of sum_of_squares() near `start`: Gauss and Newton's method with Levenberg's
/// damping. Finite for finite input.
Eigen::Vector2d refine(const FitData& data, const Eigen::Vector2d& start);

/// Puts cycle slips right: where the residual at `p` jumps by more than a quarter wavelength from
/// one read of a segment to the next, the rest of the segment is moved by whole cycles. How many
/// jumps there were.
std::size_t correct_slips(FitData& data, const Eigen::Vector2d& p);

/// Mirror image of `p` across the principal axis of the antenna's places, seen from above.
Eigen::Vector2d mirror_image(const FitData& data, const Eigen::Vector2d& p);

}  // namespace tagfield
