// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/pose_knots.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "tagfield/fit/symmetric.h"
#include "tagfield/localization/joint/internal/periods.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

constexpr double kRigid_m = 0.005;
constexpr double kRigid_rad = 0.0087;  // Half a degree.

double extent_of_track(const Trajectory& track) {
  Eigen::AlignedBox3d box;
  for (const StampedPose& pose : track) box.extend(pose.X_WB.translation);
  return track.empty() ? 0.0 : box.sizes().norm();
}

/// Whether the pose of B in A is constant over a dozen times that both tracks cover.
bool is_rigid(const Trajectory& a, const Trajectory& b) {
  constexpr std::size_t kLooks = 12;
  std::optional<RigidTransform> first;
  std::size_t looks = 0;
  for (std::size_t i = 0; i < kLooks; ++i) {
    const StampedPose& at = a[i * (a.size() - 1) / (kLooks - 1)];
    const auto X_WB = pose_at(b, at.stamp);
    if (!X_WB) continue;
    const RigidTransform X_AB = at.X_WB.inverse() * *X_WB;
    if (!first) first = X_AB;
    ++looks;
    if ((X_AB.translation - first->translation).norm() > kRigid_m ||
        X_AB.rotation.angularDistance(first->rotation) > kRigid_rad) {
      return false;
    }
  }
  return looks >= 2;
}

/// Periods in which antennas of the body read tags.
std::vector<Period> reading_periods(const LocalizationProblem& problem, const Body& body,
                                    double longest_pause_s) {
  std::vector<double> times_s;
  for (const auto& [tag, of_tag] : problem.samples) {
    for (const std::string& antenna : body.antennas) {
      const auto series = of_tag.find(antenna);
      if (series != of_tag.end()) append_times(series->second, times_s);
    }
  }
  return periods_of(std::move(times_s), longest_pause_s);
}

Eigen::Matrix3d model_scale(const PoseErrorModel& model) {
  return Eigen::Vector3d(model.sigma_m, model.sigma_m, model.yaw_sigma_rad).asDiagonal();
}

/// Lower triangular root of a covariance, made positive definite if rounding destroyed that.
Eigen::Matrix3d root(Eigen::Matrix3d covariance) {
  covariance = 0.5 * (covariance + covariance.transpose().eval());
  covariance.diagonal().array() += 1e-12;
  const std::optional<Eigen::Matrix3d> factor = cholesky_factor(covariance);
  if (!factor) return covariance.diagonal().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  return *factor;
}

/// Root of the track's covariance at the first pose not before the given time, or the last.
Eigen::Matrix3d stated_scale(const BelievedTrack& track, double time_s) {
  const auto after = std::lower_bound(
      track.X_WA.begin(), track.X_WA.end(), time_s,
      [](const StampedPose& pose, double t) { return to_seconds(pose.stamp) < t; });
  const auto last = static_cast<std::ptrdiff_t>(track.X_WA.size()) - 1;
  const std::ptrdiff_t i = std::min(after - track.X_WA.begin(), last);
  return root(track.covariance[static_cast<std::size_t>(i)]);
}

PoseKnots::Piece piece_over(const Period& period, double spacing_s, Eigen::Index first) {
  const double length = period.end_s - period.begin_s;
  const auto steps = std::max(1.0, std::ceil(length / spacing_s));
  PoseKnots::Piece piece;
  piece.first = first;
  piece.count = static_cast<Eigen::Index>(steps) + 1;
  piece.begin_s = period.begin_s;
  piece.spacing_s = std::max(length / steps, 1e-6);
  return piece;
}

void add_chain(const LocalizationProblem& problem, const Body& body, const PoseErrorModel* model,
               double spacing_s, PoseKnots& knots) {
  const double longest_pause_s = std::max(knots.time_constant_s, spacing_s);
  PoseKnots::Chain chain;
  chain.reference = body.reference;
  const BelievedTrack& track = problem.tracks.at(body.reference);
  for (const Period& period : reading_periods(problem, body, longest_pause_s)) {
    const PoseKnots::Piece piece = piece_over(period, spacing_s, knots.count());
    for (Eigen::Index k = 0; k < piece.count; ++k) {
      const double time_s = piece.begin_s + static_cast<double>(k) * piece.spacing_s;
      knots.scale.push_back(model != nullptr ? model_scale(*model) : stated_scale(track, time_s));
    }
    chain.pieces.push_back(piece);
  }
  if (chain.pieces.empty()) return;
  for (const std::string& antenna : body.antennas) knots.chain_of[antenna] = knots.chains.size();
  knots.chains.push_back(std::move(chain));
}

/// Interpolation in a pause: the mean of the error given its values at both ends, sinh((T −
/// t)/τ)/sinh(T/τ) of the first plus sinh(t/τ)/sinh(T/τ) of the second, written so that exponents
/// do not overflow.
KnotPlace place_in_pause(Eigen::Index before, double since_s, double pause_s, double tau_s) {
  const double until_s = pause_s - since_s;
  const double whole = -std::expm1(-2.0 * pause_s / tau_s);
  return {before, std::exp(-since_s / tau_s) * -std::expm1(-2.0 * until_s / tau_s) / whole,
          std::exp(-until_s / tau_s) * -std::expm1(-2.0 * since_s / tau_s) / whole};
}

/// The believed position minus the error there.
Eigen::Vector3d corrected_place(const LocalizationProblem& problem, const PoseKnots::Chain& chain,
                                const Eigen::Vector3d& error, const Eigen::Vector3d& p_WA,
                                Time stamp) {
  const auto X_WR = held_pose_at(problem.tracks.at(chain.reference).X_WA, stamp);
  Eigen::Vector3d place = p_WA;
  place.head<2>() -= displacement_of(error, (p_WA - X_WR.translation).head<2>());
  return place;
}

}  // namespace

std::vector<Body> bodies_of(const LocalizationProblem& problem) {
  std::vector<Body> bodies;
  for (const auto& [antenna, track] : problem.tracks) {
    if (extent_of_track(track.X_WA) < kStillExtent) continue;
    const auto same =
        std::find_if(bodies.begin(), bodies.end(), [&, &moving = track](const Body& b) {
          return is_rigid(problem.tracks.at(b.reference).X_WA, moving.X_WA);
        });
    if (same == bodies.end()) {
      bodies.push_back({antenna, {antenna}});
    } else {
      same->antennas.push_back(antenna);
    }
  }
  return bodies;
}

double PoseKnots::Piece::end_s() const {
  return begin_s + static_cast<double>(count - 1) * spacing_s;
}

Eigen::ArrayXd PoseKnots::correlations() const {
  Eigen::ArrayXd rho = Eigen::ArrayXd::Zero(count() + 1);
  for (const Chain& chain : chains) {
    double end_s = -std::numeric_limits<double>::infinity();
    for (const Piece& piece : chain.pieces) {
      rho[piece.first] = std::exp(-(piece.begin_s - end_s) / time_constant_s);
      rho.segment(piece.first + 1, piece.count - 1)
          .setConstant(std::exp(-piece.spacing_s / time_constant_s));
      end_s = piece.end_s();
    }
  }
  return rho;
}

PoseKnots make_knots(const LocalizationProblem& problem, const PoseErrorModel* model,
                     double spacing_s) {
  PoseKnots knots;
  if (model != nullptr) knots.time_constant_s = model->time_constant_s;
  if (model != nullptr && model->sigma_m <= 0.0 && model->yaw_sigma_rad <= 0.0) return knots;
  for (const Body& body : bodies_of(problem)) {
    const bool is_exact = !problem.drift.empty() && problem.drift.count(body.reference) == 0;
    if (is_exact) continue;
    if (body.antennas.size() > 1) knots.size = 3;
    add_chain(problem, body, model, spacing_s, knots);
  }
  return knots;
}

PoseKnots scaled(PoseKnots knots, double factor) {
  for (Eigen::Matrix3d& scale : knots.scale) scale *= factor;
  return knots;
}

KnotPlace place_in(const PoseKnots& knots, const PoseKnots::Chain& chain, double time_s) {
  const auto next = std::upper_bound(
      chain.pieces.begin() + 1, chain.pieces.end(), time_s,
      [](double time, const PoseKnots::Piece& piece) { return time < piece.begin_s; });
  const PoseKnots::Piece& piece = *(next - 1);
  const double end_s = piece.end_s();
  if (next != chain.pieces.end() && time_s > end_s) {
    return place_in_pause(piece.first + piece.count - 1, time_s - end_s, next->begin_s - end_s,
                          knots.time_constant_s);
  }
  const double steps = (time_s - piece.begin_s) / piece.spacing_s;
  const auto last = static_cast<double>(piece.count - 2);
  const double at = std::clamp(std::floor(steps), 0.0, last);
  const double weight = std::clamp(steps - at, 0.0, 1.0);
  return {piece.first + static_cast<Eigen::Index>(at), 1.0 - weight, weight};
}

Eigen::Vector3d error_at(const PoseKnots& knots, const Eigen::VectorXd& u,
                         const PoseKnots::Chain& chain, double time_s) {
  const KnotPlace place = place_in(knots, chain, time_s);
  const auto error = [&](Eigen::Index knot) {
    Eigen::Vector3d padded = Eigen::Vector3d::Zero();
    padded.head(knots.size) = u.segment(knot * knots.size, knots.size);
    return Eigen::Vector3d(knots.scale[static_cast<std::size_t>(knot)] * padded);
  };
  Eigen::Vector3d sum = place.before * error(place.at) + place.after * error(place.at + 1);
  if (knots.size == 2) sum.z() = 0.0;
  return sum;
}

std::vector<AntennaPose> corrected_poses(const LocalizationProblem& problem, const PoseKnots& knots,
                                         const Eigen::VectorXd& u) {
  std::vector<AntennaPose> poses;
  for (const auto& [antenna, track] : problem.tracks) {
    const auto found = knots.chain_of.find(antenna);
    for (const StampedPose& pose : track.X_WA) {
      RigidTransform X_WA = pose.X_WB;
      if (found != knots.chain_of.end()) {
        const PoseKnots::Chain& chain = knots.chains[found->second];
        const Eigen::Vector3d error = error_at(knots, u, chain, to_seconds(pose.stamp));
        X_WA.translation = corrected_place(problem, chain, error, X_WA.translation, pose.stamp);
        X_WA.rotation = Eigen::AngleAxisd(-error.z(), Eigen::Vector3d::UnitZ()) * X_WA.rotation;
      }
      poses.push_back({pose.stamp, antenna, X_WA, std::nullopt});
    }
  }
  return poses;
}

SamplesOfTag corrected_samples(const LocalizationProblem& problem, const PoseKnots& knots,
                               const Eigen::VectorXd& u, const SamplesOfTag& samples) {
  SamplesOfTag corrected = samples;
  for (auto& [antenna, series] : corrected) {
    const auto found = knots.chain_of.find(antenna);
    if (found == knots.chain_of.end()) continue;
    const PoseKnots::Chain& chain = knots.chains[found->second];
    for (PhaseSample& sample : series) {
      const Eigen::Vector3d error = error_at(knots, u, chain, to_seconds(sample.stamp));
      sample.p_WA = corrected_place(problem, chain, error, sample.p_WA, sample.stamp);
    }
  }
  return corrected;
}

}  // namespace tagfield
