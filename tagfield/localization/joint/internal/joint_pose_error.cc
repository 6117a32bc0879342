// SPDX-License-Identifier: Apache-2.0
// Learns how strong the pose error is, and how slow.
#include <utility>

#include "tagfield/localization/joint/internal/joint_state.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// The same displacements in units of other scales.
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

/// A model of the pose error under trial.
struct Trial {
  double factor = 1.0;  ///< On the standard deviations.
  double time_constant_s = 5.0;
  double evidence = 0.0;
  JointSystem system;
};

Trial tried(const JointSystem& from, const PoseKnots& knots, double factor, double time_constant_s,
            int threads) {
  Trial trial{factor, time_constant_s, 0.0, from};
  PoseKnots changed = scaled(knots, factor);
  changed.time_constant_s = time_constant_s;
  rescale(trial.system, changed);
  const double cost = minimize(trial.system, 6, threads);
  trial.evidence = evidence(trial.system, cost, log_determinant_of(trial.system, threads));
  return trial;
}

}  // namespace

void learn_pose_error(JointState& state, int threads) {
  constexpr double kStep = 1.6;
  constexpr int kMostTrials = 24;
  const JointSystem& start = state.system;
  if (start.knots.count() == 0) return;
  const PoseKnots knots = start.knots;
  Trial best = tried(start, knots, 1.0, knots.time_constant_s, threads);
  int trials = 1;
  // Each of the two is made greater or smaller as long as that is more likely.
  for (bool any = true; any && trials < kMostTrials;) {
    any = false;
    for (const auto& [by, of_time] :
         {std::pair{kStep, false}, {1.0 / kStep, false}, {kStep, true}, {1.0 / kStep, true}}) {
      while (trials < kMostTrials) {
        const double factor = of_time ? best.factor : best.factor * by;
        const double time_constant = of_time ? best.time_constant_s * by : best.time_constant_s;
        if (factor < 0.02 || factor > 20.0 || time_constant < 0.2 || time_constant > 200.0) break;
        Trial next = tried(best.system, knots, factor, time_constant, threads);
        ++trials;
        if (!(next.evidence < best.evidence)) break;
        best = std::move(next);
        any = true;
      }
    }
  }
  state.system = std::move(best.system);
  minimize(state.system, kMostRoundsOfJointFit, threads);
}

}  // namespace tagfield
