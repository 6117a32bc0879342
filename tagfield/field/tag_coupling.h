// SPDX-License-Identifier: Apache-2.0
/// @file
/// Coupling of tags close to each other: how much of the fields of a tag and its neighbours reaches
/// its chip. See docs/coupling.md.
#pragma once

#include <complex>
#include <cstdint>
#include <utility>
#include <vector>

#include "tagfield/field/tag_index.h"
#include "tagfield/field/tag_population.h"

namespace tagfield {

/// A tag for the coupling with its neighbours.
struct TagAtPose {
  const TagModel* model = nullptr;
  RigidTransform X_WT;
};

/// Weights (see coupled_shares()) of the fields at the first tag and at the others in the signal at
/// the first one's chip. Each tag couples as a half-wave dipole along its polarization; circularly
/// polarized ones don't couple.
Eigen::RowVectorXcd shares_among(const std::vector<TagAtPose>& tags, double lambda_m);

/// Maximum number of neighbours that couple with a tag: the nearest ones.
inline constexpr std::size_t kMaxNeighbours = 24;

/// A tag's neighbours within a wavelength, in ascending order of slots, and its own weight.
struct CoupledTag {
  std::complex<double> own = 1.0;
  std::vector<std::pair<std::uint32_t, std::complex<double>>> neighbours;
};

/// The couplings between tags, cached as long as no tag nearby moves. Not thread-safe.
class TagCouplings {
 public:
  /// Updates the tags' poses. Costs one comparison per tag; cached couplings near tags that
  /// appeared, disappeared, moved or rotated are dropped.
  void see(const TagPopulation& tags);
  /// The couplings of the tag in `slot`, as of the last see(). Valid until the next call.
  const CoupledTag& of(std::uint32_t slot, double lambda_m);

 private:
  struct Kept {
    double lambda_m = 0.0;
    CoupledTag coupled;
  };
  struct Seen {
    bool present = false;
    TagAtPose tag;
    std::vector<Kept> kept;  ///< For the last carriers requested.
  };
  void place(std::uint32_t slot, const TagAtPose& tag);
  void remove(std::uint32_t slot);
  void drop_around(const Eigen::Vector3d& p_W);
  [[nodiscard]] CoupledTag computed(std::uint32_t slot, double lambda_m);

  static constexpr double kCell_m = 0.35;
  TagIndex index_{kCell_m};
  std::vector<Seen> seen_;  ///< By slot.
  double max_lambda_m_ = 0.0;
  std::vector<std::uint32_t> near_;  ///< Workspace.
};

}  // namespace tagfield
