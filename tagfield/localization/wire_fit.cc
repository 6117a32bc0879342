// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/wire_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tagfield/base/units.h"
#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/fit/symmetric.h"
#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/coherent_reads.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Normal = Eigen::Matrix<double, 5, 5>;

/// Starting directions of the wire: nearest neighbours are some 35° apart.
constexpr std::size_t kAxes = 16;
/// A fit further away is a different position [m].
constexpr double kNearPlace = 0.5;
/// If no fit near a position is clean, others start this far to all sides of it [m].
constexpr double kBeside = 0.2;
constexpr std::size_t kEnoughReads = 300;

/// Largest ratio of misfit to noise: as for the choice of a method (docs/estimators.md).
constexpr double kMaxLeft = 1.6;

/// Damps the derivative for a wire seen end-on, where arg E·e is undefined.
constexpr double kMinField = 1e-2;

/// Every n-th read of each span.
TagPhases fewer(const TagPhases& phases) {
  const auto stride =
      static_cast<Eigen::Index>(static_cast<std::size_t>(phases.size()) / kEnoughReads + 1);
  if (stride == 1) return phases;
  std::vector<Eigen::Index> reads;
  std::vector<TagPhases::Span> spans;
  for (TagPhases::Span span : phases.spans) {
    const Eigen::Index begin = span.begin;
    const Eigen::Index end = span.begin + span.count;
    span.begin = static_cast<Eigen::Index>(reads.size());
    for (Eigen::Index i = begin; i < end; i += stride) reads.push_back(i);
    span.count = static_cast<Eigen::Index>(reads.size()) - span.begin;
    if (span.count > 0) spans.push_back(span);
  }
  return chosen(phases, reads, std::move(spans));
}

/// Two directions perpendicular to the wire.
Eigen::Matrix<double, 3, 2> tangents(const Vector3d& axis_W) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = axis_W.unitOrthogonal();
  across.col(1) = axis_W.cross(across.col(0));
  return across;
}

/// Contribution of the wire to a read's value [m], and its derivative with respect to the wire's
/// direction.
void put_turn(const PolarizedReads& reads, Eigen::Index i, const Vector3d& p_WT,
              const WirePoint& point, const Eigen::Matrix<double, 3, 2>& across, double& turn_m,
              WireUnknowns& row) {
  const auto at = static_cast<std::size_t>(i);
  if (reads.hand[at] == 0.0) return;
  const Vector3d way(p_WT.x() - reads.phases.x[i], p_WT.y() - reads.phases.y[i],
                     p_WT.z() - reads.phases.z[i]);
  const Vector3d u = way / std::max(way.norm(), 0.01);
  const Complex h = crossed_wires_on(reads.hand[at], reads.R_WA[at], u, point.axis_W);
  const double scale = -2.0 * reads.multiple / reads.phases.wavenumber[i];
  turn_m = scale * std::arg(h);
  for (int k = 0; k < 2; ++k) {
    const Complex change = crossed_wires_on(reads.hand[at], reads.R_WA[at], u, across.col(k));
    row[3 + k] = scale * (change * std::conj(h)).imag() / (std::norm(h) + kMinField);
  }
}

/// Values minus ranges and phase rotations, and the derivatives of the sum of these two.
struct Equations {
  Eigen::ArrayXd errors;
  Eigen::Matrix<double, Eigen::Dynamic, 5> rows;
};

Equations equations_at(const PolarizedReads& reads, const WirePoint& point) {
  const TagPhases& phases = reads.phases;
  Equations all{Eigen::ArrayXd(phases.size()),
                Eigen::Matrix<double, Eigen::Dynamic, 5>(phases.size(), 5)};
  const Vector3d p_WT = to_position(reads.height, point.place);
  const Eigen::Matrix<double, 3, 2> across = tangents(point.axis_W);
  for (Eigen::Index i = 0; i < phases.size(); ++i) {
    const Range range = range_to(reads.height, point.place, phases.x[i], phases.y[i], phases.z[i]);
    WireUnknowns row = WireUnknowns::Zero();
    row.head<3>() = range.gradient;
    double turn_m = 0.0;
    put_turn(reads, i, p_WT, point, across, turn_m, row);
    all.errors[i] = phases.value[i] - range.r - turn_m;
    all.rows.row(i) = row.transpose();
  }
  return all;
}

/// Best offset for the span's errors, their circular mean.
double offset_in(const TagPhases::Span& span, const Eigen::ArrayXd& errors) {
  if (span.offset_known) return 0.0;
  Complex sum = 0.0;
  for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
    sum += std::polar(1.0, kTwoPi * errors[i] / span.cycle_m);
  }
  return std::arg(sum) / kTwoPi * span.cycle_m;
}

void linearize(const PolarizedReads& reads, WirePoint& point) {
  Equations all = equations_at(reads, point);
  point.normal.setZero();
  point.gradient.setZero();
  for (const TagPhases::Span& span : reads.phases.spans) {
    auto errors = all.errors.segment(span.begin, span.count);
    auto rows = all.rows.middleRows(span.begin, span.count);
    errors -= offset_in(span, all.errors);
    for (double& error : errors) error -= span.cycle_m * std::round(error / span.cycle_m);
    if (!span.offset_known) {
      errors -= errors.mean();
      rows.rowwise() -= rows.colwise().mean().eval();
    }
    point.normal.noalias() += rows.transpose() * rows;
    point.gradient.noalias() += rows.transpose() * errors.matrix();
  }
  if (reads.height.unknowns() == 2) point.normal(2, 2) = 1.0;
  point.errors = std::move(all.errors);
  point.cost = point.errors.square().sum();
}

WirePoint fitted(const PolarizedReads& reads, const PositionVector& place, const Vector3d& axis_W) {
  constexpr LevenbergMarquardt kHow{.max_steps = 20, .damping = 1e-3, .min_raised = 1e-3};
  WirePoint start;
  start.place = place;
  start.axis_W = axis_W;
  linearize(reads, start);
  return descend(start, kHow, [&](const WirePoint& here, double damping) {
    std::optional<WirePoint> there;
    const WireUnknowns move = solve_symmetric(damped(here.normal, damping, 1e-9), here.gradient);
    if (!is_worthwhile(move, 1e-5)) return there;
    there.emplace();
    there->place = here.place + move.head<3>();
    there->axis_W = (here.axis_W + tangents(here.axis_W) * move.tail<2>()).normalized();
    linearize(reads, *there);
    return there;
  });
}

/// Evenly distributed over a hemisphere, as a wire has no front (Fibonacci lattice).
Vector3d axis_number(std::size_t i) {
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(kAxes);
  const double radius = std::sqrt(1.0 - z * z);
  const double around = golden * static_cast<double>(i);
  return {radius * std::cos(around), radius * std::sin(around), z};
}

/// Adds the fits started from there that end near `found`; all are sorted, best first.
void add_fits(const PolarizedReads& reads, const PositionVector& found, const PositionVector& start,
              std::vector<WirePoint>& fits) {
  for (std::size_t i = 0; i < kAxes; ++i) {
    WirePoint fit = fitted(reads, start, axis_number(i));
    if ((fit.place - found).head<2>().norm() < kNearPlace) fits.push_back(std::move(fit));
  }
  std::stable_sort(fits.begin(), fits.end(),
                   [](const auto& a, const auto& b) { return a.cost < b.cost; });
}

/// Increase of the covariance because the wire's direction is unknown. A direction that the phases
/// do not constrain has a prior of about a radian.
Matrix3d added_by_direction(const HeightModel& height, const WirePoint& fit, double noise_m2) {
  Normal normal = fit.normal / noise_m2;
  if (!(normal(2, 2) > 0.0)) normal(2, 2) = 1.0;
  const Matrix3d alone = invert_symmetric(Matrix3d(normal.topLeftCorner<3, 3>()));
  normal.bottomRightCorner<2, 2>() += Eigen::Matrix2d::Identity();
  const Normal both = invert_symmetric(normal);
  const Matrix3d J = place_jacobian(height, fit.place, both(2, 2));
  const Matrix3d more = J * (both.topLeftCorner<3, 3>() - alone) * J.transpose();
  return more.allFinite() ? more : Matrix3d::Zero();
}

/// Mean square shift due to other fits that are nearly as good, weighted by likelihood.
Matrix3d added_by_others(const HeightModel& height, const WireFits& all) {
  const WirePoint& best = all.fits.front();
  Matrix3d squares = Matrix3d::Zero();
  double weights = 0.0;
  for (const WirePoint& fit : all.fits) {
    const double weight = std::exp(-0.5 * (fit.cost - best.cost) / all.noise_m2);
    const Vector3d apart = to_position(height, fit.place) - to_position(height, best.place);
    weights += weight;
    squares += weight * apart * apart.transpose();
  }
  return squares / weights;
}

}  // namespace

std::complex<double> crossed_wires_on(double hand, const Matrix3d& R_WA, const Vector3d& u_W,
                                      const Vector3d& axis_W) {
  const Vector3d across = axis_W - u_W.dot(axis_W) * u_W;
  return {R_WA.col(2).dot(across), hand * R_WA.col(1).dot(across)};
}

std::optional<KnownHand> known_hand(const LocalizationProblem& problem,
                                    const std::string& antenna) {
  const auto hand = problem.circular.find(antenna);
  const auto track = problem.tracks.find(antenna);
  if (hand == problem.circular.end() || track == problem.tracks.end()) return std::nullopt;
  if (!is_orientation_known(track->second)) return std::nullopt;
  return KnownHand{hand->second, &track->second};
}

PolarizedReads polarized_reads(const LocalizationProblem& problem, const std::string& tag) {
  PolarizedReads reads;
  reads.phases = fewer(coherent_reads(problem, problem.samples.at(tag)));
  reads.height = height_model(problem, tag, reads.phases);
  reads.multiple = problem.multiple();
  reads.R_WA.assign(static_cast<std::size_t>(reads.phases.size()), Matrix3d::Identity());
  reads.hand.assign(reads.R_WA.size(), 0.0);
  for (const TagPhases::Span& span : reads.phases.spans) {
    const std::optional<KnownHand> known = known_hand(problem, span.antenna);
    if (!known) continue;
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Time stamp = time_from_seconds(reads.phases.time_s[i]);
      reads.R_WA[at] = held_pose_at(known->track->X_WA, stamp).rotation.toRotationMatrix();
      reads.hand[at] = sign_of(known->hand);
    }
  }
  return reads;
}

WireFits fit_wire(const PolarizedReads& reads, const Vector3d& p_WT) {
  WireFits all;
  const PositionVector found = to_unknowns(reads.height, p_WT);
  add_fits(reads, found, found, all.fits);
  // Together with an estimated height, a wire seen almost end-on shifts positions by decimetres.
  if (reads.height.unknowns() == 3 && (all.fits.empty() || !is_clean(reads, all.fits.front()))) {
    for (const auto& [x, y] : {std::pair(1.0, 0.0), {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
      add_fits(reads, found, found + kBeside * PositionVector(x, y, 0.0), all.fits);
    }
  }
  if (all.fits.empty()) return all;
  const Eigen::ArrayXd& errors = all.fits.front().errors;
  all.noise_m2 = residual_variance(reads.phases.spans, errors) *
                 correlation_factor(reads.phases.spans, errors);
  return all;
}

bool is_clean(const PolarizedReads& reads, const WirePoint& fit) {
  const std::vector<double> differences = neighbour_differences(reads.phases, fit.errors);
  if (differences.empty()) return false;
  const Eigen::ArrayXd left_rad = fit.errors * reads.phases.wavenumber;
  return left_rad.cos().mean() > kBentShare &&
         std::sqrt(left_rad.square().mean()) < kMaxLeft * noise_of_differences(differences);
}

Matrix3d added_by_any_wire(const PolarizedReads& reads, const Vector3d& p_WT) {
  Matrix3d squares = Matrix3d::Zero();
  PolarizedReads straight = reads;
  std::fill(straight.hand.begin(), straight.hand.end(), 0.0);
  for (std::size_t i = 0; i < kAxes; ++i) {
    WirePoint with;
    with.place = to_unknowns(reads.height, p_WT);
    with.axis_W = axis_number(i);
    linearize(reads, with);
    WirePoint without = with;
    linearize(straight, without);
    const Matrix3d normal = with.normal.topLeftCorner<3, 3>();
    const PositionVector shift = solve_symmetric(
        damped(normal, 1e-6, 1e-9), Vector3d((with.gradient - without.gradient).head<3>()));
    const Vector3d apart =
        to_position(reads.height, with.place + shift) - to_position(reads.height, with.place);
    squares += apart * apart.transpose() / static_cast<double>(kAxes);
  }
  return squares.allFinite() ? squares : Matrix3d::Zero();
}

Matrix3d added_by_wire(const HeightModel& height, const WireFits& all) {
  return added_by_direction(height, all.fits.front(), all.noise_m2) + added_by_others(height, all);
}

}  // namespace tagfield
