// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tags near one another: of the fields of a tag and its neighbours, what gets to its chip. See
/// docs/coupling.md.
#pragma once

#include <complex>
#include <cstdint>
#include <utility>
#include <vector>

#include "tagfield/field/tag_index.h"
#include "tagfield/field/tag_population.h"

namespace tagfield {

/// A tag as its neighbours see it.
struct TagAtPose {
  const TagModel* model = nullptr;
  RigidTransform X_WT;
};

/// Shares (see coupled_shares()) of the first tag's and the others' fields in what the first one's
/// chip gets. Each couples as a half-wave dipole along its polarization; those of circular
/// polarization not at all.
Eigen::RowVectorXcd shares_among(const std::vector<TagAtPose>& tags, double lambda_m);

/// Up to how many neighbours couple with a tag: the nearest ones.
inline constexpr std::size_t kMostNeighbours = 24;

/// A tag's neighbours nearer than a wavelength, by rising slots, and its own share.
struct CoupledTag {
  std::complex<double> own = 1.0;
  std::vector<std::pair<std::uint32_t, std::complex<double>>> neighbours;
};

/// Who couples with whom, kept for as long as nobody nearby moves. Not thread-safe.
class TagCouplings {
 public:
  /// Where tags are now. Costs a comparison a tag; what was kept near those that came, went, moved
  /// or turned is dropped.
  void see(const TagPopulation& tags);
  /// Of the tag in `slot`, which was seen. Holds until the next call.
  const CoupledTag& of(std::uint32_t slot, double lambda_m);

 private:
  struct Kept {
    double lambda_m = 0.0;
    CoupledTag coupled;
  };
  struct Seen {
    bool present = false;
    TagAtPose tag;
    std::vector<Kept> kept;  ///< Of the carriers asked for last.
  };
  void place(std::uint32_t slot, const TagAtPose& tag);
  void remove(std::uint32_t slot);
  void drop_around(const Eigen::Vector3d& p_W);
  [[nodiscard]] CoupledTag computed(std::uint32_t slot, double lambda_m);

  static constexpr double kCell_m = 0.35;
  TagIndex index_{kCell_m};
  std::vector<Seen> seen_;  ///< By slot.
  double most_lambda_m_ = 0.0;
  std::vector<std::uint32_t> near_;  ///< Workspace.
};

}  // namespace tagfield
