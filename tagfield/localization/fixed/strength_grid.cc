// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/strength_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tagfield {
namespace {

constexpr double kNearestCell = 0.1;  ///< Smaller distances are clamped to this [m].

/// Maximum change of the lobe's gain [dB] towards the ends of a cross around the cell.
double gain_change(const TagOnGrid& tag, Eigen::Index antenna, Eigen::Index cell, double reach_m,
                   const Lobe& lobe) {
  if (lobe.beam_width_deg == 0.0) return 0.0;
  const auto i = static_cast<std::size_t>(antenna);
  const Eigen::Vector3d way = tag.places.cells[static_cast<std::size_t>(cell)] - tag.p_WA[i];
  double most = 0.0;
  for (const Eigen::Vector3d& step :
       {Eigen::Vector3d(reach_m, 0.0, 0.0), Eigen::Vector3d(0.0, reach_m, 0.0)}) {
    for (const Eigen::Vector3d& there :
         {Eigen::Vector3d(way + step), Eigen::Vector3d(way - step)}) {
      const double gain = lobe_db(lobe, tag.boresight_W[i], there);
      most = std::max(most, std::abs(gain - tag.gain_db(antenna, cell)));
    }
  }
  return most;
}

}  // namespace

PossiblePlaces known_place(const Eigen::Vector3d& p_WT, Eigen::Index areas) {
  return {{p_WT}, Eigen::ArrayXd::Zero(1), Eigen::ArrayXXd::Zero(1, areas)};
}

bool is_known(const PossiblePlaces& places) {
  return places.cells.size() == 1 && places.size_m[0] == 0.0;
}

Eigen::ArrayXd log_prior(const PossiblePlaces& places, const Eigen::ArrayXd& areas) {
  if (is_known(places)) return Eigen::ArrayXd::Zero(1);
  const Eigen::ArrayXd density = (places.density.matrix() * areas.matrix()).array();
  const Eigen::ArrayXd prior = density * places.size_m.square();
  return prior.max(std::numeric_limits<double>::min()).log();
}

TagOnGrid on_grid(const std::vector<std::string>& names, const std::vector<FixedReads>& reads,
                  PossiblePlaces places, const Lobe& lobe) {
  std::vector<double> strengths;
  TagOnGrid tag;
  for (const FixedReads& of : reads) {
    const auto found = std::find(names.begin(), names.end(), of.antenna);
    if (of.strengths < 1.0 || found == names.end()) continue;
    tag.antennas.push_back(static_cast<std::size_t>(found - names.begin()));
    tag.p_WA.push_back(of.p_WA);
    tag.boresight_W.push_back(of.boresight_W);
    strengths.push_back(of.rssi_dbm);
  }
  tag.rssi_dbm = Eigen::Map<const Eigen::VectorXd>(strengths.data(),
                                                   static_cast<Eigen::Index>(strengths.size()));
  put_on(std::move(places), lobe, tag);
  return tag;
}

void put_on(PossiblePlaces places, const Lobe& lobe, TagOnGrid& tag) {
  tag.places = std::move(places);
  const auto count = static_cast<Eigen::Index>(tag.antennas.size());
  const auto cells = static_cast<Eigen::Index>(tag.places.cells.size());
  tag.log_distance.resize(count, cells);
  tag.gain_db.resize(count, cells);
  for (Eigen::Index j = 0; j < cells; ++j) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto antenna = static_cast<std::size_t>(i);
      const Eigen::Vector3d way = tag.places.cells[static_cast<std::size_t>(j)] - tag.p_WA[antenna];
      tag.log_distance(i, j) = std::log10(std::max(way.norm(), kNearestCell));
      tag.gain_db(i, j) = lobe_db(lobe, tag.boresight_W[antenna], way);
    }
  }
}

Eigen::MatrixXd changes_within(const TagOnGrid& tag, double slope_db, double reach,
                               const Lobe& lobe) {
  Eigen::MatrixXd changes(tag.log_distance.rows(), tag.log_distance.cols());
  for (Eigen::Index j = 0; j < changes.cols(); ++j) {
    const double reach_m = reach * tag.places.size_m[j];
    for (Eigen::Index i = 0; i < changes.rows(); ++i) {
      const double distance = std::pow(10.0, tag.log_distance(i, j));
      // The logarithm changes most towards the antenna.
      const double nearest = std::max(distance - reach_m, kNearestCell);
      changes(i, j) = std::abs(slope_db) * std::log10(distance / nearest) +
                      gain_change(tag, i, j, reach_m, lobe);
    }
  }
  return changes;
}

}  // namespace tagfield
