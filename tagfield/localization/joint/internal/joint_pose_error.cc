// SPDX-License-Identifier: Apache-2.0
// Estimation of the magnitude and time constant of the pose error.
#include <utility>
#include <vector>

#include "tagfield/localization/joint/internal/joint_state.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// Expresses the same displacements in units of other scales.
void rescale(JointSystem& system, const PoseKnots& knots) {
  const int size = knots.size;
  for (Index k = 0; k < knots.count(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    u.head(size) = system.u.segment(k * size, size);
    const Eigen::Vector3d error = system.knots.scale[at] * u;
    Eigen::Matrix3d scale = knots.scale[at];
    if (size == 2) scale(2, 2) = 1.0;
    system.u.segment(k * size, size) = scale.triangularView<Eigen::Lower>().solve(error).head(size);
  }
  system.knots = knots;
}

/// State of a system, without its reads.
struct Standing {
  PoseKnots knots;
  Eigen::VectorXd u;
  std::vector<TagFit> fits;
};

Standing standing_of(const JointSystem& system) {
  Standing at{system.knots, system.u, {}};
  at.fits.reserve(system.tags.size());
  for (const JointTag& tag : system.tags) at.fits.push_back(tag.fit);
  return at;
}

void put(const Standing& at, JointSystem& system) {
  system.knots = at.knots;
  system.u = at.u;
  for (std::size_t i = 0; i < at.fits.size(); ++i) system.tags[i].fit = at.fits[i];
}

/// A model of the pose error under trial.
struct Trial {
  double factor = 1.0;  ///< On the standard deviations.
  double time_constant_s = 5.0;
  double evidence = 0.0;
  Standing at;
};

/// Minimizes from `from` with the given model; the system keeps the result.
Trial tried(JointSystem& system, const Standing& from, const PoseKnots& knots, double factor,
            double time_constant_s, int threads) {
  put(from, system);
  PoseKnots changed = scaled(knots, factor);
  changed.time_constant_s = time_constant_s;
  rescale(system, changed);
  const double cost = minimize(system, 6, threads);
  const double value = evidence(system, cost, log_determinant_of(system, threads));
  return {factor, time_constant_s, value, standing_of(system)};
}

}  // namespace

void learn_pose_error(JointState& state, int threads) {
  constexpr double kStep = 1.6;
  constexpr int kMaxTrials = 24;
  JointSystem& system = state.system;
  if (system.knots.count() == 0) return;
  const PoseKnots knots = system.knots;
  Trial best = tried(system, standing_of(system), knots, 1.0, knots.time_constant_s, threads);
  int trials = 1;
  // Increases or decreases each of the two as long as the evidence improves.
  for (bool any = true; any && trials < kMaxTrials;) {
    any = false;
    for (const auto& [by, of_time] :
         {std::pair{kStep, false}, {1.0 / kStep, false}, {kStep, true}, {1.0 / kStep, true}}) {
      while (trials < kMaxTrials) {
        const double factor = of_time ? best.factor : best.factor * by;
        const double time_constant = of_time ? best.time_constant_s * by : best.time_constant_s;
        if (factor < 0.02 || factor > 20.0 || time_constant < 0.2 || time_constant > 200.0) break;
        Trial next = tried(system, best.at, knots, factor, time_constant, threads);
        ++trials;
        if (!(next.evidence < best.evidence)) break;
        best = std::move(next);
        any = true;
      }
    }
  }
  put(best.at, system);
  minimize(system, kMaxRoundsOfJointFit, threads);
}

}  // namespace tagfield
