// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/plane_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/fit/symmetric.h"

namespace tagfield {
namespace {

/// The longest spans, as many as `reads` allows with two reads each, in their original order.
std::vector<TagPhases::Span> longest_spans(const TagPhases& phases, Eigen::Index reads) {
  std::vector<TagPhases::Span> spans = phases.spans;
  const auto keep = static_cast<std::size_t>(std::max<Eigen::Index>(1, reads / 2));
  if (spans.size() <= keep) return spans;
  std::stable_sort(spans.begin(), spans.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  spans.resize(keep);
  std::sort(spans.begin(), spans.end(),
            [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return spans;
}

Eigen::Index total_count(const std::vector<TagPhases::Span>& spans) {
  return std::accumulate(spans.begin(), spans.end(), Eigen::Index{0},
                         [](Eigen::Index sum, const auto& span) { return sum + span.count; });
}

/// Distances from `p` to the reads of one span [m].
Eigen::ArrayXd distances(const TagPhases& phases, const TagPhases::Span& span, double height,
                         const Eigen::Vector2d& p) {
  return ((phases.x.segment(span.begin, span.count) - p.x()).square() +
          (phases.y.segment(span.begin, span.count) - p.y()).square() +
          (height - phases.z.segment(span.begin, span.count)).square())
      .sqrt();
}

/// A position with its normal matrix, gradient and sum of squares.
struct PlanePoint {
  Eigen::Vector2d p;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  double cost = 0.0;
};

void add_span(const TagPhases& phases, const TagPhases::Span& span, double height,
              PlanePoint& point) {
  const Eigen::Vector2d& p = point.p;
  const Eigen::ArrayXd range = distances(phases, span, height, p).max(1e-9);
  Eigen::ArrayXd error = phases.value.segment(span.begin, span.count) - range;
  // Gradient of the range; subtracting means eliminates the offset.
  Eigen::ArrayXd ux = (p.x() - phases.x.segment(span.begin, span.count)) / range;
  Eigen::ArrayXd uy = (p.y() - phases.y.segment(span.begin, span.count)) / range;
  for (Eigen::ArrayXd* column : {&error, &ux, &uy}) *column -= column->mean();
  point.normal(0, 0) += ux.square().sum();
  point.normal(0, 1) += (ux * uy).sum();
  point.normal(1, 1) += uy.square().sum();
  point.gradient += Eigen::Vector2d((ux * error).sum(), (uy * error).sum());
  point.cost += error.square().sum();
}

PlanePoint point_at(const TagPhases& phases, double height, const Eigen::Vector2d& p) {
  PlanePoint point;
  point.p = p;
  for (const TagPhases::Span& span : phases.spans) add_span(phases, span, height, point);
  point.normal(1, 0) = point.normal(0, 1);
  return point;
}

}  // namespace

TagPhases thinned(const TagPhases& phases, Eigen::Index reads) {
  std::vector<TagPhases::Span> spans = longest_spans(phases, reads);
  const Eigen::Index step =
      std::max<Eigen::Index>(1, total_count(spans) / std::max<Eigen::Index>(reads, 1));
  std::vector<Eigen::Index> kept;
  for (TagPhases::Span& span : spans) {
    const auto begin = static_cast<Eigen::Index>(kept.size());
    // Short spans keep their first and last read.
    const Eigen::Index stride = std::min(step, span.count - 1);
    for (Eigen::Index i = 0; i < span.count; i += stride) kept.push_back(span.begin + i);
    span.begin = begin;
    span.count = static_cast<Eigen::Index>(kept.size()) - begin;
  }
  return chosen(phases, kept, std::move(spans));
}

Eigen::ArrayXd residuals(const TagPhases& phases, double height, const Eigen::Vector2d& p) {
  Eigen::ArrayXd all(phases.value.size());
  for (const TagPhases::Span& span : phases.spans) {
    auto error = all.segment(span.begin, span.count);
    error = phases.value.segment(span.begin, span.count) - distances(phases, span, height, p);
    error -= error.mean();
  }
  return all;
}

double sum_of_squares(const TagPhases& phases, double height, const Eigen::Vector2d& p) {
  double sum = 0.0;
  for (const TagPhases::Span& span : phases.spans) {
    double errors = 0.0;
    double squares = 0.0;
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const double dx = phases.x[i] - p.x();
      const double dy = phases.y[i] - p.y();
      const double up = height - phases.z[i];
      const double error = phases.value[i] - std::sqrt(dx * dx + dy * dy + up * up);
      errors += error;
      squares += error * error;
    }
    sum += std::max(0.0, squares - errors * errors / static_cast<double>(span.count));
  }
  return sum;
}

Eigen::Vector2d refine(const TagPhases& phases, double height, const Eigen::Vector2d& start) {
  constexpr double kTolerance = 1e-7;  // [m]
  constexpr double kRidge = 1e-12;
  constexpr LevenbergMarquardt kHow{
      .max_steps = 40, .damping = 1e-4, .min_damping = 1e-12, .raise = 8.0};
  const auto step = [&](const PlanePoint& here, double damping) -> std::optional<PlanePoint> {
    const Eigen::Vector2d move =
        solve_symmetric(evenly_damped(here.normal, damping, kRidge), here.gradient);
    if (!is_worthwhile(move, kTolerance)) return std::nullopt;
    return point_at(phases, height, here.p + move);
  };
  return descend(point_at(phases, height, start), kHow, step).p;
}

std::size_t correct_slips(TagPhases& phases, double height, const Eigen::Vector2d& p) {
  std::size_t slips = 0;
  for (const TagPhases::Span& span : phases.spans) {
    const Eigen::ArrayXd error =
        phases.value.segment(span.begin, span.count) - distances(phases, span, height, p);
    double shift = 0.0;
    for (Eigen::Index i = 1; i < span.count; ++i) {
      const double turns = std::round((error[i] - error[i - 1]) / span.cycle_m);
      if (turns != 0.0) ++slips;
      shift -= turns * span.cycle_m;
      phases.value[span.begin + i] += shift;
    }
  }
  return slips;
}

}  // namespace tagfield
