// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/circular_polarization.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Matrix3d;
using Eigen::Vector3d;
/// Place (x, y and the height's unknown), and the wire's direction along two tangents [rad].
using Unknowns = Eigen::Matrix<double, 5, 1>;
using Normal = Eigen::Matrix<double, 5, 5>;

/// Starts of the wire's direction: nearest neighbours are some 35° apart.
constexpr std::size_t kAxes = 16;
/// Misfits that differ by less, in units of the noise of independent reads, are not told apart.
constexpr double kAsGood = 9.0;
/// Further away it is another place [m].
constexpr double kNearPlace = 0.5;
constexpr std::size_t kEnoughReads = 300;

/// What a fit may leave, over the noise: as for the choice of a method (docs/estimators.md).
constexpr double kMostLeft = 1.6;

/// Nothing of a wire that is seen along itself, where arg E·e has no value.
constexpr double kLeastField = 1e-2;

/// One tag's reads, and what of their antennas it takes to turn phases.
struct PolarizedReads {
  TagPhases phases;
  HeightModel height;
  std::vector<Matrix3d> R_WA;  ///< By read.
  std::vector<double> hand;    ///< By read: 1 right, −1 left, 0 not circular.
  double multiple = 1.0;       ///< By which phases were multiplied.
};

/// E·e of the crossed wires, of a tag's wire or, as it is linear in that, of a change of it.
Complex field_at(double hand, const Matrix3d& R_WA, const Vector3d& u_W, const Vector3d& axis_W) {
  const Vector3d across = axis_W - u_W.dot(axis_W) * u_W;
  return {R_WA.col(2).dot(across), hand * R_WA.col(1).dot(across)};
}

double sign_of(Hand hand) { return hand == Hand::kRight ? 1.0 : -1.0; }

/// The antenna's hand, and its way; nothing where one of them is not known.
struct KnownHand {
  Hand hand;
  const BelievedTrack* track;
};
std::optional<KnownHand> known_hand(const LocalizationProblem& problem,
                                    const std::string& antenna) {
  const auto hand = problem.circular.find(antenna);
  const auto track = problem.tracks.find(antenna);
  if (hand == problem.circular.end() || track == problem.tracks.end()) return std::nullopt;
  if (!is_orientation_told(track->second)) return std::nullopt;
  return KnownHand{hand->second, &track->second};
}

/// Every so manyeth read of each span.
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

PolarizedReads reads_of(const LocalizationProblem& problem, const std::string& tag) {
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

/// A place and a direction of the wire, with what they leave.
struct WirePoint {
  PlaceVector place = PlaceVector::Zero();
  Vector3d axis_W = Vector3d::UnitZ();
  Normal normal = Normal::Zero();        ///< [1/m² …], offsets eliminated.
  Unknowns gradient = Unknowns::Zero();  ///< Along which the misfit falls.
  Eigen::ArrayXd errors;                 ///< [m]
  double cost = 0.0;                     ///< Σ errors² [m²].
};

/// Two directions across the wire's.
Eigen::Matrix<double, 3, 2> tangents(const Vector3d& axis_W) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = axis_W.unitOrthogonal();
  across.col(1) = axis_W.cross(across.col(0));
  return across;
}

/// What a read's value has of the wire [m], and its change with the unknowns.
void put_turn(const PolarizedReads& reads, Eigen::Index i, const Vector3d& p_WT,
              const WirePoint& point, const Eigen::Matrix<double, 3, 2>& across, double& turn_m,
              Unknowns& row) {
  const auto at = static_cast<std::size_t>(i);
  if (reads.hand[at] == 0.0) return;
  const Vector3d way(p_WT.x() - reads.phases.x[i], p_WT.y() - reads.phases.y[i],
                     p_WT.z() - reads.phases.z[i]);
  const Vector3d u = way / std::max(way.norm(), 0.01);
  const Complex h = field_at(reads.hand[at], reads.R_WA[at], u, point.axis_W);
  const double scale = -2.0 * reads.multiple / reads.phases.wavenumber[i];
  turn_m = scale * std::arg(h);
  for (int k = 0; k < 2; ++k) {
    const Complex change = field_at(reads.hand[at], reads.R_WA[at], u, across.col(k));
    row[3 + k] = scale * (change * std::conj(h)).imag() / (std::norm(h) + kLeastField);
  }
}

/// Values less ranges and turns, and the change of those with the unknowns.
struct Equations {
  Eigen::ArrayXd errors;
  Eigen::Matrix<double, Eigen::Dynamic, 5> rows;
};

Equations equations_at(const PolarizedReads& reads, const WirePoint& point) {
  const TagPhases& phases = reads.phases;
  Equations all{Eigen::ArrayXd(phases.size()),
                Eigen::Matrix<double, Eigen::Dynamic, 5>(phases.size(), 5)};
  const Vector3d p_WT = to_place(reads.height, point.place);
  const Eigen::Matrix<double, 3, 2> across = tangents(point.axis_W);
  for (Eigen::Index i = 0; i < phases.size(); ++i) {
    const Range range = range_to(reads.height, point.place, phases.x[i], phases.y[i], phases.z[i]);
    Unknowns row = Unknowns::Zero();
    row.head<3>() = range.gradient;
    double turn_m = 0.0;
    put_turn(reads, i, p_WT, point, across, turn_m, row);
    all.errors[i] = phases.value[i] - range.r - turn_m;
    all.rows.row(i) = row.transpose();
  }
  return all;
}

/// Offset that suits the span's errors, by the circular mean.
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

WirePoint fitted(const PolarizedReads& reads, const PlaceVector& place, const Vector3d& axis_W) {
  constexpr LevenbergMarquardt kHow{.most_steps = 20, .damping = 1e-3, .least_raised = 1e-3};
  WirePoint start;
  start.place = place;
  start.axis_W = axis_W;
  linearize(reads, start);
  return descend(start, kHow, [&](const WirePoint& here, double damping) {
    std::optional<WirePoint> there;
    const Unknowns move = damped(here.normal, damping, 1e-9).ldlt().solve(here.gradient);
    if (!is_worthwhile(move, 1e-5)) return there;
    there.emplace();
    there->place = here.place + move.head<3>();
    there->axis_W = (here.axis_W + tangents(here.axis_W) * move.tail<2>()).normalized();
    linearize(reads, *there);
    return there;
  });
}

/// Evenly over half of the sphere, as a wire has no front (Fibonacci's lattice).
Vector3d axis_number(std::size_t i) {
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(kAxes);
  const double radius = std::sqrt(1.0 - z * z);
  const double around = golden * static_cast<double>(i);
  return {radius * std::cos(around), radius * std::sin(around), z};
}

/// Of a candidate: the best fit near it, and those that are as good.
struct WireFits {
  std::vector<WirePoint> fits;  ///< Best first; empty where none is near.
  double noise_m2 = 0.0;        ///< Of an independent read.
};

WireFits fits_near(const PolarizedReads& reads, const Vector3d& p_WT) {
  WireFits all;
  const PlaceVector start = to_unknowns(reads.height, p_WT);
  for (std::size_t i = 0; i < kAxes; ++i) {
    WirePoint fit = fitted(reads, start, axis_number(i));
    if ((fit.place - start).head<2>().norm() < kNearPlace) all.fits.push_back(std::move(fit));
  }
  std::stable_sort(all.fits.begin(), all.fits.end(),
                   [](const auto& a, const auto& b) { return a.cost < b.cost; });
  if (all.fits.empty()) return all;
  const Eigen::ArrayXd& errors = all.fits.front().errors;
  all.noise_m2 = residual_variance(reads.phases.spans, errors) *
                 correlation_factor(reads.phases.spans, errors);
  return all;
}

/// Whether the fit leaves no more than noise, little of it: reflections and pose errors bend phases
/// as wires do, and no wire is to be learnt from those. Differences of neighbours alone don't tell,
/// as what is reflected far away changes from read to read.
bool is_clean(const PolarizedReads& reads, const WirePoint& fit) {
  const std::vector<double> differences = neighbour_differences(reads.phases, fit.errors);
  if (differences.empty()) return false;
  const Eigen::ArrayXd left_rad = fit.errors * reads.phases.wavenumber;
  return left_rad.cos().mean() > kBentShare &&
         std::sqrt(left_rad.square().mean()) < kMostLeft * noise_of_differences(differences);
}

/// By where the place would be for directions all around, each as likely, against where no turn
/// puts it: mean square in x and y.
Eigen::Matrix2d added_by_any_wire(const PolarizedReads& reads, const Vector3d& p_WT) {
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < kAxes; ++i) {
    WirePoint with;
    with.place = to_unknowns(reads.height, p_WT);
    with.axis_W = axis_number(i);
    linearize(reads, with);
    PolarizedReads straight = reads;
    std::fill(straight.hand.begin(), straight.hand.end(), 0.0);
    WirePoint without = with;
    linearize(straight, without);
    const Matrix3d normal = with.normal.topLeftCorner<3, 3>();
    const Vector3d apart =
        damped(normal, 1e-6, 1e-9).ldlt().solve((with.gradient - without.gradient).head<3>());
    squares += apart.head<2>() * apart.head<2>().transpose() / static_cast<double>(kAxes);
  }
  return squares.allFinite() ? squares : Eigen::Matrix2d::Zero();
}

/// By how much the covariance of x and y grows with the wire's direction unknown. A direction
/// that the phases say nothing of is known to a radian or so all the same.
Eigen::Matrix2d added_by_wire(const WirePoint& fit, double noise_m2) {
  Normal normal = fit.normal / noise_m2;
  if (!(normal(2, 2) > 0.0)) normal(2, 2) = 1.0;
  const Matrix3d alone = normal.topLeftCorner<3, 3>().ldlt().solve(Matrix3d::Identity());
  normal.bottomRightCorner<2, 2>() += Eigen::Matrix2d::Identity();
  const Normal both = normal.ldlt().solve(Normal::Identity());
  const Eigen::Matrix2d more = (both.topLeftCorner<2, 2>() - alone.topLeftCorner<2, 2>()).eval();
  return more.allFinite() ? more : Eigen::Matrix2d::Zero();
}

/// And by fits that are as good elsewhere.
Eigen::Matrix2d added_by_others(const WireFits& all) {
  const WirePoint& best = all.fits.front();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double weights = 0.0;
  for (const WirePoint& fit : all.fits) {
    const double weight = std::exp(-0.5 * (fit.cost - best.cost) / all.noise_m2);
    const Eigen::Vector2d apart = (fit.place - best.place).head<2>();
    weights += weight;
    squares += weight * apart * apart.transpose();
  }
  return squares / weights;
}

/// The tag's samples without their turns.
SamplesOfTag turned_back(const LocalizationProblem& problem, const SamplesOfTag& given,
                         const Vector3d& p_WT, const Vector3d& axis_W) {
  SamplesOfTag samples = given;
  for (auto& [antenna, series] : samples) {
    const std::optional<KnownHand> known = known_hand(problem, antenna);
    if (!known) continue;
    for (PhaseSample& sample : series) {
      const RigidTransform X_WA = held_pose_at(known->track->X_WA, sample.stamp);
      const double turn = polarization_turn(known->hand, X_WA.rotation.toRotationMatrix(),
                                            p_WT - sample.p_WA, axis_W);
      sample.phase_rad = wrap_to_two_pi(sample.phase_rad - problem.multiple() * turn);
    }
  }
  return samples;
}

/// What one tag's wire does.
struct TagAllowance {
  bool is_known = false;
  SamplesOfTag samples;
  Eigen::Matrix2d added = Eigen::Matrix2d::Zero();
};

TagAllowance allowance_of(const LocalizationProblem& problem, const TagEstimate& estimate) {
  TagAllowance allowance;
  const PolarizedReads reads = reads_of(problem, estimate.tag);
  const bool any =
      std::any_of(reads.hand.begin(), reads.hand.end(), [](double hand) { return hand != 0.0; });
  if (!any || static_cast<std::size_t>(reads.phases.size()) < kFewestReads + kFewestSpare) {
    return allowance;
  }
  std::vector<WireFits> at_candidates;
  for (const Candidate& candidate : estimate.candidates) {
    WireFits all = fits_near(reads, candidate.p_WT);
    if (!all.fits.empty()) at_candidates.push_back(std::move(all));
  }
  if (at_candidates.empty()) return allowance;
  const auto best = std::min_element(at_candidates.begin(), at_candidates.end(),
                                     [](const WireFits& a, const WireFits& b) {
                                       return a.fits.front().cost < b.fits.front().cost;
                                     });
  for (const WireFits& other : at_candidates) {
    if (&other == &*best) continue;
    const double worse = other.fits.front().cost - best->fits.front().cost;
    if (worse < kAsGood * best->noise_m2) return allowance;
  }
  const WirePoint& fit = best->fits.front();
  allowance.is_known = true;
  if (!is_clean(reads, fit)) {
    allowance.samples = problem.samples.at(estimate.tag);
    allowance.added = added_by_any_wire(reads, estimate.candidates.front().p_WT);
    return allowance;
  }
  allowance.added = added_by_wire(fit, best->noise_m2) + added_by_others(*best);
  allowance.samples = turned_back(problem, problem.samples.at(estimate.tag),
                                  to_place(reads.height, fit.place), fit.axis_W);
  return allowance;
}

}  // namespace

double polarization_turn(Hand hand, const Matrix3d& R_WA, const Vector3d& way_W,
                         const Vector3d& axis_W) {
  const Vector3d u = way_W / std::max(way_W.norm(), 0.01);
  return -2.0 * std::arg(field_at(sign_of(hand), R_WA, u, axis_W));
}

PolarizationAllowance allow_for_polarization(const LocalizationProblem& problem,
                                             const LocalizationResult& result, int threads) {
  PolarizationAllowance all{problem, {}};
  std::vector<TagAllowance> of_tags(result.estimates.size());
  parallel_for(of_tags.size(), threads, [&](std::size_t i) {
    const TagEstimate& estimate = result.estimates[i];
    if (estimate.candidates.empty() || problem.samples.count(estimate.tag) == 0) return;
    if (problem.reference_tags.count(estimate.tag) > 0) return;
    of_tags[i] = allowance_of(problem, estimate);
  });
  for (std::size_t i = 0; i < of_tags.size(); ++i) {
    if (!of_tags[i].is_known) continue;
    const std::string& tag = result.estimates[i].tag;
    all.problem.samples[tag] = std::move(of_tags[i].samples);
    all.added[tag] = of_tags[i].added;
  }
  return all;
}

void add_polarization_error(const PolarizationAllowance& allowance, LocalizationResult& result) {
  for (TagEstimate& estimate : result.estimates) {
    const auto added = allowance.added.find(estimate.tag);
    if (added == allowance.added.end() || estimate.candidates.empty()) continue;
    for (Candidate& candidate : estimate.candidates) add_error(added->second, candidate);
    if (estimate.verdict == Verdict::kLocated) judge(allowance.problem.limits, estimate);
  }
}

}  // namespace tagfield
