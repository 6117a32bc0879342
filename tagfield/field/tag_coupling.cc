// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_coupling.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/channel/mutual_impedance.h"

namespace tagfield {
namespace {

/// The number of carriers of most plans with few channels.
constexpr std::size_t kMaxKept = 4;

bool is_wire(const TagAtPose& tag) {
  return tag.model->antenna.polarization == PolarizationKind::kLinear;
}

Eigen::Vector3d wire_W(const TagAtPose& tag) {
  const double tilt = tag.model->antenna.tilt_rad;
  return tag.X_WT.rotation * Eigen::Vector3d(0.0, std::sin(tilt), std::cos(tilt));
}

bool is_same(const TagAtPose& a, const TagAtPose& b) {
  return a.model == b.model && a.X_WT.translation == b.X_WT.translation &&
         a.X_WT.rotation.coeffs() == b.X_WT.rotation.coeffs();
}

}  // namespace

Eigen::RowVectorXcd shares_among(const std::vector<TagAtPose>& tags, double lambda_m) {
  const auto count = static_cast<Eigen::Index>(tags.size());
  Eigen::MatrixXcd mutual = Eigen::MatrixXcd::Zero(count, count);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_wire(tags[i]) || !is_wire(tags[j])) continue;
      const std::complex<double> of_both =
          mutual_impedance(kTwoPi / lambda_m, wire_W(tags[i]), wire_W(tags[j]),
                           tags[i].X_WT.translation - tags[j].X_WT.translation);
      const auto row = static_cast<Eigen::Index>(i);
      const auto column = static_cast<Eigen::Index>(j);
      mutual(row, column) = of_both;
      mutual(column, row) = of_both;
    }
  }
  return coupled_shares(mutual);
}

void TagCouplings::see(const TagPopulation& tags) {
  for (std::uint32_t slot = 0; slot < seen_.size(); ++slot) {
    if (seen_[slot].present && !tags.has(slot)) remove(slot);
  }
  tags.for_each([&](std::uint32_t slot) {
    if (slot >= seen_.size()) seen_.resize(slot + std::size_t{1});
    const TagAtPose tag{&tags.model(slot), tags.pose(slot)};
    if (!seen_[slot].present || !is_same(seen_[slot].tag, tag)) place(slot, tag);
  });
}

void TagCouplings::place(std::uint32_t slot, const TagAtPose& tag) {
  if (seen_[slot].present) drop_around(seen_[slot].tag.X_WT.translation);
  seen_[slot].present = true;
  seen_[slot].tag = tag;
  index_.place(slot, tag.X_WT.translation);
  drop_around(tag.X_WT.translation);
}

void TagCouplings::remove(std::uint32_t slot) {
  drop_around(seen_[slot].tag.X_WT.translation);
  index_.remove(slot);
  seen_[slot] = {};
}

void TagCouplings::drop_around(const Eigen::Vector3d& p_W) {
  index_.within(p_W, max_lambda_m_, near_);
  for (const std::uint32_t slot : near_) seen_[slot].kept.clear();
}

const CoupledTag& TagCouplings::of(std::uint32_t slot, double lambda_m) {
  max_lambda_m_ = std::max(max_lambda_m_, lambda_m);
  std::vector<Kept>& kept = seen_[slot].kept;
  const auto found = std::find_if(kept.begin(), kept.end(),
                                  [&](const Kept& one) { return one.lambda_m == lambda_m; });
  if (found != kept.end()) return found->coupled;
  if (kept.size() >= kMaxKept) kept.erase(kept.begin());
  kept.push_back({lambda_m, computed(slot, lambda_m)});
  return kept.back().coupled;
}

CoupledTag TagCouplings::computed(std::uint32_t slot, double lambda_m) {
  const Eigen::Vector3d p_W = seen_[slot].tag.X_WT.translation;
  index_.within(p_W, lambda_m, near_);
  near_.erase(std::remove(near_.begin(), near_.end(), slot), near_.end());
  if (near_.size() > kMaxNeighbours) {
    const auto distance = [&](std::uint32_t other) {
      return (seen_[other].tag.X_WT.translation - p_W).squaredNorm();
    };
    std::stable_sort(near_.begin(), near_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
    near_.resize(kMaxNeighbours);
    std::sort(near_.begin(), near_.end());
  }
  CoupledTag coupled;
  if (near_.empty()) return coupled;
  std::vector<TagAtPose> tags = {seen_[slot].tag};
  for (const std::uint32_t other : near_) tags.push_back(seen_[other].tag);
  const Eigen::RowVectorXcd shares = shares_among(tags, lambda_m);
  coupled.own = shares(0);
  for (std::size_t i = 0; i < near_.size(); ++i) {
    coupled.neighbours.emplace_back(near_[i], shares(static_cast<Eigen::Index>(i) + 1));
  }
  return coupled;
}

}  // namespace tagfield
