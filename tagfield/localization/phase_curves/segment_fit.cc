#include "tagfield/localization/phase_curves/segment_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tagfield/base/units.h"
#include "tagfield/fit/levenberg_marquardt.h"

namespace tagfield {
namespace {

std::array<Eigen::ArrayXd*, 4> columns(FitData& data) {
  return {&data.x, &data.y, &data.height_squared, &data.distance};
}

void resize(FitData& data, Eigen::Index count) {
  for (Eigen::ArrayXd* column : columns(data)) column->conservativeResize(count);
}

void copy_read(const FitData& from, Eigen::Index i, FitData& to, Eigen::Index at) {
  to.x[at] = from.x[i];
  to.y[at] = from.y[i];
  to.height_squared[at] = from.height_squared[i];
  to.distance[at] = from.distance[i];
}

/// Spans by falling length, as far as two reads of each fit into `reads`, in their old order.
std::vector<FitData::Span> longest_spans(const FitData& data, Eigen::Index reads) {
  std::vector<FitData::Span> spans = data.spans;
  const auto keep = static_cast<std::size_t>(std::max<Eigen::Index>(1, reads / 2));
  if (spans.size() <= keep) return spans;
  std::stable_sort(spans.begin(), spans.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  spans.resize(keep);
  std::sort(spans.begin(), spans.end(),
            [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return spans;
}

Eigen::Index total_count(const std::vector<FitData::Span>& spans) {
  return std::accumulate(spans.begin(), spans.end(), Eigen::Index{0},
                         [](Eigen::Index sum, const auto& span) { return sum + span.count; });
}

/// Distances from `p` to the reads of one span [m].
Eigen::ArrayXd distances(const FitData& data, const FitData::Span& span, const Eigen::Vector2d& p) {
  return ((data.x.segment(span.begin, span.count) - p.x()).square() +
          (data.y.segment(span.begin, span.count) - p.y()).square() +
          data.height_squared.segment(span.begin, span.count))
      .sqrt();
}

/// A place with the normal matrix, the gradient and the sum of squares there.
struct Point {
  Eigen::Vector2d p;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  double cost = 0.0;
};

void add_span(const FitData& data, const FitData::Span& span, Point& point) {
  const Eigen::Vector2d& p = point.p;
  const Eigen::ArrayXd range = distances(data, span, p).max(1e-9);
  Eigen::ArrayXd error = data.distance.segment(span.begin, span.count) - range;
  // Gradient of the range; the offset is eliminated by taking means out.
  Eigen::ArrayXd ux = (p.x() - data.x.segment(span.begin, span.count)) / range;
  Eigen::ArrayXd uy = (p.y() - data.y.segment(span.begin, span.count)) / range;
  for (Eigen::ArrayXd* column : {&error, &ux, &uy}) *column -= column->mean();
  point.normal(0, 0) += ux.square().sum();
  point.normal(0, 1) += (ux * uy).sum();
  point.normal(1, 1) += uy.square().sum();
  point.gradient += Eigen::Vector2d((ux * error).sum(), (uy * error).sum());
  point.cost += error.square().sum();
}

Point point_at(const FitData& data, const Eigen::Vector2d& p) {
  Point point;
  point.p = p;
  for (const FitData::Span& span : data.spans) add_span(data, span, point);
  point.normal(1, 0) = point.normal(0, 1);
  return point;
}

}  // namespace

FitData make_fit_data(const std::vector<PhaseSegment>& segments, double height) {
  FitData data;
  Eigen::Index total = 0;
  for (const PhaseSegment& segment : segments) {
    const auto count = static_cast<Eigen::Index>(segment.samples.size());
    if (count < 2) continue;
    data.spans.push_back({total, count, wavelength(segment.samples[0].frequency_hz) / 2.0});
    total += count;
  }
  resize(data, total);
  Eigen::Index at = 0;
  for (const PhaseSegment& segment : segments) {
    if (segment.samples.size() < 2) continue;
    for (std::size_t k = 0; k < segment.samples.size(); ++k, ++at) {
      const Eigen::Vector3d& p_WA = segment.samples[k].p_WA;
      data.x[at] = p_WA.x();
      data.y[at] = p_WA.y();
      data.height_squared[at] = (height - p_WA.z()) * (height - p_WA.z());
      data.distance[at] = segment.distance_m[k];
    }
  }
  return data;
}

FitData thinned(const FitData& data, Eigen::Index reads) {
  const std::vector<FitData::Span> spans = longest_spans(data, reads);
  const Eigen::Index step =
      std::max<Eigen::Index>(1, total_count(spans) / std::max<Eigen::Index>(reads, 1));
  FitData thin;
  resize(thin, total_count(spans));
  Eigen::Index at = 0;
  for (const FitData::Span& span : spans) {
    const Eigen::Index begin = at;
    // Short spans keep their first and last read.
    const Eigen::Index stride = std::min(step, span.count - 1);
    for (Eigen::Index i = 0; i < span.count; i += stride)
      copy_read(data, span.begin + i, thin, at++);
    thin.spans.push_back({begin, at - begin, span.cycle_m});
  }
  resize(thin, at);
  return thin;
}

Eigen::ArrayXd residuals(const FitData& data, const Eigen::Vector2d& p) {
  Eigen::ArrayXd all(data.distance.size());
  for (const FitData::Span& span : data.spans) {
    auto error = all.segment(span.begin, span.count);
    error = data.distance.segment(span.begin, span.count) - distances(data, span, p);
    error -= error.mean();
  }
  return all;
}

double sum_of_squares(const FitData& data, const Eigen::Vector2d& p) {
  double sum = 0.0;
  for (const FitData::Span& span : data.spans) {
    double errors = 0.0;
    double squares = 0.0;
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const double dx = data.x[i] - p.x();
      const double dy = data.y[i] - p.y();
      const double error = data.distance[i] - std::sqrt(dx * dx + dy * dy + data.height_squared[i]);
      errors += error;
      squares += error * error;
    }
    sum += std::max(0.0, squares - errors * errors / static_cast<double>(span.count));
  }
  return sum;
}

Eigen::Matrix2d normal_matrix(const FitData& data, const Eigen::Vector2d& p) {
  return point_at(data, p).normal;
}

Eigen::Vector2d refine(const FitData& data, const Eigen::Vector2d& start) {
  constexpr double kTolerance = 1e-7;  // [m]
  constexpr double kRidge = 1e-12;
  constexpr LevenbergMarquardt kHow{
      .most_steps = 40, .damping = 1e-4, .least_damping = 1e-12, .raise = 8.0};
  const auto step = [&](const Point& here, double damping) -> std::optional<Point> {
    const Eigen::Vector2d move = evenly_damped_step(here.normal, here.gradient, damping, kRidge);
    if (!is_worthwhile(move, kTolerance)) return std::nullopt;
    return point_at(data, here.p + move);
  };
  return descend(point_at(data, start), kHow, step).p;
}

std::size_t correct_slips(FitData& data, const Eigen::Vector2d& p) {
  std::size_t slips = 0;
  for (const FitData::Span& span : data.spans) {
    const Eigen::ArrayXd error =
        data.distance.segment(span.begin, span.count) - distances(data, span, p);
    double shift = 0.0;
    for (Eigen::Index i = 1; i < span.count; ++i) {
      const double turns = std::round((error[i] - error[i - 1]) / span.cycle_m);
      if (turns != 0.0) ++slips;
      shift -= turns * span.cycle_m;
      data.distance[span.begin + i] += shift;
    }
  }
  return slips;
}

Eigen::Vector2d mirror_image(const FitData& data, const Eigen::Vector2d& p) {
  const Eigen::Vector2d middle(data.x.mean(), data.y.mean());
  const Eigen::ArrayXd dx = data.x - middle.x();
  const Eigen::ArrayXd dy = data.y - middle.y();
  // The axis along which the points lie: the scatter's eigenvector with the greater eigenvalue.
  const double angle =
      0.5 * std::atan2(2.0 * (dx * dy).sum(), dx.square().sum() - dy.square().sum());
  const Eigen::Vector2d axis(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d apart = p - middle;
  return middle + 2.0 * axis.dot(apart) * axis - apart;
}

}  // namespace tagfield
