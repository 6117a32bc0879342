// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/bound.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/joint/joint_system.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// Knots per time constant. The joint estimate, which is solved many times, uses fewer.
constexpr double kKnotsPerTimeConstant = 75.0;

/// Antennas that moved while they read the tag, or whose offset is known: the others carry no
/// information.
std::vector<std::string> telling_antennas(const LocalizationProblem& truth,
                                          const SamplesOfTag& samples) {
  std::vector<std::string> antennas;
  for (const auto& [antenna, series] : samples) {
    if (extent_of(series) >= kStillExtent || truth.offset_known.count(antenna) > 0) {
      antennas.push_back(antenna);
    }
  }
  return antennas;
}

double noise_of(const BoundInput& input, const std::string& antenna) {
  const auto found = input.phase_noise_rad.find(antenna);
  if (found == input.phase_noise_rad.end() || !(found->second > 0.0)) {
    throw Error("the phase noise of antenna '" + antenna + "' must be known and over 0");
  }
  // Doubled phases have twice the noise.
  return found->second * (input.truth.pi_ambiguity ? 2.0 : 1.0);
}

/// Scales wavenumbers so that each antenna's noise becomes that of the system, 1 rad.
void scale_by_noise(const BoundInput& input, TagPhases& phases) {
  for (const TagPhases::Span& span : phases.spans) {
    phases.wavenumber.segment(span.begin, span.count) /= noise_of(input, span.antenna);
  }
}

JointTag tag_at(const BoundInput& input, const PoseKnots& knots, const std::string& tag,
                const SamplesOfTag& samples, const Eigen::Vector3d& p_WT) {
  const LocalizationProblem& truth = input.truth;
  JointTag joint;
  joint.id = tag;
  joint.phases = wrapped_phases(truth, samples, telling_antennas(truth, samples));
  joint.height = height_model(truth, tag, joint.phases);
  joint.fixed = truth.reference_tags.count(tag) > 0;
  joint.fit.unknowns = to_unknowns(joint.height, p_WT);
  joint.fit.offsets = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joint.phases.spans.size()));
  scale_by_noise(input, joint.phases);
  attach(truth, knots, joint);
  return joint;
}

JointSystem system_at_truth(const BoundInput& input) {
  JointSystem system;
  system.noise_rad = 1.0;
  const PoseErrorModel exact;
  const PoseErrorModel& model = input.truth.pose_error ? *input.truth.pose_error : exact;
  system.knots = make_knots(input.truth, &model, model.time_constant_s / kKnotsPerTimeConstant);
  system.u = Eigen::VectorXd::Zero(system.knots.count() * system.knots.size);
  for (const auto& [tag, samples] : input.truth.samples) {
    const auto place = input.places.find(tag);
    if (place == input.places.end()) continue;
    JointTag joint = tag_at(input, system.knots, tag, samples, place->second);
    if (joint.phases.size() > 3) system.tags.push_back(std::move(joint));
  }
  return system;
}

/// Converts covariances of the unknowns to those of positions.
void to_positions(const JointSystem& system, Eigen::MatrixXd& covariance) {
  std::vector<Eigen::Matrix3d> J;
  for (std::size_t i = 0; i < system.tags.size(); ++i) {
    const JointTag& tag = system.tags[i];
    const auto at = 3 * static_cast<Eigen::Index>(i);
    J.push_back(place_jacobian(tag.height, tag.fit.unknowns, covariance(at + 2, at + 2)));
  }
  for (std::size_t i = 0; i < J.size(); ++i) {
    for (std::size_t j = 0; j < J.size(); ++j) {
      auto block = covariance.block<3, 3>(3 * static_cast<Eigen::Index>(i),
                                          3 * static_cast<Eigen::Index>(j));
      block = (J[i] * block * J[j].transpose()).eval();
    }
  }
}

/// Covariance of all tags' unknowns; 0 between tags if cross-covariances are not available.
Eigen::MatrixXd whole(const JointCovariance& covariance) {
  if (covariance.of_all.size() > 0) return covariance.of_all;
  const auto tags = static_cast<Eigen::Index>(covariance.of_tag.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * tags, 3 * tags);
  for (Eigen::Index i = 0; i < tags; ++i) {
    all.block<3, 3>(3 * i, 3 * i) = covariance.of_tag[static_cast<std::size_t>(i)];
  }
  return all;
}

Bounds bounds_of(const JointSystem& system) {
  Bounds bounds;
  for (const JointTag& tag : system.tags) bounds.tags.push_back(tag.id);
  bounds.covariance = whole(covariance_of(system, 1));
  to_positions(system, bounds.covariance);
  return bounds;
}

}  // namespace

Bounds single_bounds(const BoundInput& input) {
  const JointSystem all = system_at_truth(input);
  const auto size = 3 * static_cast<Eigen::Index>(all.tags.size());
  Bounds bounds;
  bounds.covariance = Eigen::MatrixXd::Zero(size, size);
  for (const JointTag& tag : all.tags) {
    JointSystem alone;
    alone.knots = all.knots;
    alone.u = all.u;
    alone.noise_rad = all.noise_rad;
    alone.tags = {tag};
    const auto at = 3 * static_cast<Eigen::Index>(bounds.tags.size());
    bounds.covariance.block<3, 3>(at, at) = bounds_of(alone).covariance;
    bounds.tags.push_back(tag.id);
  }
  return bounds;
}

Bounds joint_bounds(const BoundInput& input) { return bounds_of(system_at_truth(input)); }

Eigen::Matrix3d covariance_of(const Bounds& bounds, std::size_t i) {
  const auto at = 3 * static_cast<Eigen::Index>(i);
  return bounds.covariance.block<3, 3>(at, at);
}

double mean_horizontal_error(const Eigen::Matrix3d& covariance) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(covariance.topLeftCorner<2, 2>());  // Iterating takes seconds to compile.
  const double low = std::max(axes.eigenvalues()[0], 0.0);
  const double high = std::max(axes.eigenvalues()[1], 0.0);
  if (high <= 0.0) return 0.0;
  // std::comp_ellint_2 takes the modulus, the root of the parameter.
  return std::sqrt(2.0 * high / kPi) * std::comp_ellint_2(std::sqrt(1.0 - low / high));
}

}  // namespace tagfield
