// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/tag_fit.h"

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/fit/circular_mean.h"
#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/fit/symmetric.h"

namespace tagfield {
namespace {

using Span = TagPhases::Span;

/// Value minus range of one read.
double error_of(const TagPhases& phases, const HeightModel& height, const PositionVector& unknowns,
                Eigen::Index i) {
  return phases.value[i] - range_to(height, unknowns, phases.x[i], phases.y[i], phases.z[i]).r;
}

double span_offset(const TagPhases& phases, const HeightModel& height,
                   const PositionVector& unknowns, const Span& span) {
  if (span.offset_known) return 0.0;
  const Eigen::Index end = span.begin + span.count;
  if (phases.unwrapped) {
    double sum = 0.0;
    for (Eigen::Index i = span.begin; i < end; ++i) sum += error_of(phases, height, unknowns, i);
    return sum / static_cast<double>(span.count);
  }
  CircularMean mean;
  for (Eigen::Index i = span.begin; i < end; ++i) {
    mean.add(error_of(phases, height, unknowns, i) * phases.wavenumber[i]);
  }
  return mean.value() / phases.wavenumber[span.begin];
}

/// Linearization e ≈ e₀ − J δ: the sums that the next step needs, in radians, and the correction of
/// each offset.
struct FitStep {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::VectorXd offset_shift;   ///< Mean error of each span [m].
  Eigen::MatrixXd mean_gradient;  ///< Mean gradient of each span, as rows.
  double cost = 0.0;
};

/// State of the iteration.
struct FitPoint {
  TagFit fit;
  FitStep step;
  double cost = 0.0;
};

void add_span(const TagPhases& phases, const HeightModel& height, const TagFit& fit, std::size_t s,
              FitStep& step) {
  const Span& span = phases.spans[s];
  const auto row = static_cast<Eigen::Index>(s);
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  Eigen::Vector3d gradients = Eigen::Vector3d::Zero();
  double errors = 0.0;
  double error_squares = 0.0;
  for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
    const Range range = range_to(height, fit.unknowns, phases.x[i], phases.y[i], phases.z[i]);
    const double error =
        nearest_to_zero(phases, span, phases.value[i] - range.r - fit.offsets[row]);
    squares.noalias() += range.gradient * range.gradient.transpose();
    products += range.gradient * error;
    gradients += range.gradient;
    errors += error;
    error_squares += error * error;
  }
  const auto count = static_cast<double>(span.count);
  // A span has a single wavenumber, as it has one carrier.
  const double weight = phases.wavenumber[span.begin] * phases.wavenumber[span.begin];
  if (!span.offset_known) {
    squares -= gradients * gradients.transpose() / count;
    products -= gradients * (errors / count);
    error_squares -= errors * errors / count;
    step.offset_shift[row] = errors / count;
    step.mean_gradient.row(row) = gradients.transpose() / count;
  }
  step.normal += weight * squares;
  step.gradient += weight * products;
  step.cost += weight * std::max(error_squares, 0.0);
}

FitStep step_at(const TagPhases& phases, const HeightModel& height, const TagFit& fit) {
  FitStep step;
  const auto spans = static_cast<Eigen::Index>(phases.spans.size());
  step.offset_shift = Eigen::VectorXd::Zero(spans);
  step.mean_gradient = Eigen::MatrixXd::Zero(spans, 3);
  for (std::size_t s = 0; s < phases.spans.size(); ++s) add_span(phases, height, fit, s, step);
  if (height.unknowns() == 2) step.normal(2, 2) = 1.0;
  return step;
}

void linearize(const TagPhases& phases, const HeightModel& height, FitPoint& point) {
  point.step = step_at(phases, height, point.fit);
  point.cost = point.step.cost;
}

TagFit moved(const TagFit& fit, const FitStep& step, const PositionVector& move) {
  TagFit next;
  next.unknowns = fit.unknowns + move;
  next.offsets = fit.offsets + step.offset_shift - step.mean_gradient * move;
  return next;
}

}  // namespace

Eigen::VectorXd offsets_at(const TagPhases& phases, const HeightModel& height,
                           const PositionVector& unknowns) {
  Eigen::VectorXd offsets(static_cast<Eigen::Index>(phases.spans.size()));
  for (std::size_t s = 0; s < phases.spans.size(); ++s) {
    offsets[static_cast<Eigen::Index>(s)] = span_offset(phases, height, unknowns, phases.spans[s]);
  }
  return offsets;
}

Eigen::ArrayXd residuals_of(const TagPhases& phases, const HeightModel& height, const TagFit& fit) {
  Eigen::ArrayXd errors(phases.size());
  for (std::size_t s = 0; s < phases.spans.size(); ++s) {
    const Span& span = phases.spans[s];
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const double r = range_to(height, fit.unknowns, phases.x[i], phases.y[i], phases.z[i]).r;
      errors[i] = nearest_to_zero(phases, span,
                                  phases.value[i] - r - fit.offsets[static_cast<Eigen::Index>(s)]);
    }
  }
  return errors;
}

TagFit fit_tag(const TagPhases& phases, const HeightModel& height, const PositionVector& start) {
  constexpr double kTolerance = 1e-6;  // [m]
  constexpr double kRidge = 1e-9;
  constexpr LevenbergMarquardt kHow{.max_steps = 30, .damping = 1e-6, .min_raised = 1e-3};
  FitPoint point;
  point.fit.unknowns = start;
  point.fit.offsets = offsets_at(phases, height, start);
  linearize(phases, height, point);
  point =
      descend(point, kHow, [&](const FitPoint& here, double damping) -> std::optional<FitPoint> {
        const PositionVector move =
            solve_symmetric(damped(here.step.normal, damping, kRidge), here.step.gradient);
        if (!is_worthwhile(move, kTolerance)) return std::nullopt;
        FitPoint there;
        there.fit = moved(here.fit, here.step, move);
        linearize(phases, height, there);
        return there;
      });
  point.fit.offsets += point.step.offset_shift;
  point.fit.cost = point.cost;
  return point.fit;
}

Eigen::Matrix3d normal_of(const TagPhases& phases, const HeightModel& height,
                          const PositionVector& unknowns) {
  TagFit fit;
  fit.unknowns = unknowns;
  fit.offsets = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(phases.spans.size()));
  return step_at(phases, height, fit).normal;
}

}  // namespace tagfield
