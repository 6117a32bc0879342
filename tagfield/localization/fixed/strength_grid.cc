// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/strength_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tagfield {
namespace {

constexpr double kNearestCell = 0.1;  ///< Smaller distances are clamped to this [m].

/// Maximum change of the lobe's gain [dB] towards the ends of a cross of this half width.
double gain_change(const Lobe& lobe, const Eigen::Vector3d& boresight_W, const Eigen::Vector3d& way,
                   double reach_m) {
  if (lobe.beam_width_deg == 0.0 || reach_m == 0.0) return 0.0;
  const double here = lobe_db(lobe, boresight_W, way);
  double most = 0.0;
  for (const double step : {-reach_m, reach_m}) {
    const double along_x = lobe_db(lobe, boresight_W, way + step * Eigen::Vector3d::UnitX());
    const double along_y = lobe_db(lobe, boresight_W, way + step * Eigen::Vector3d::UnitY());
    most = std::max({most, std::abs(along_x - here), std::abs(along_y - here)});
  }
  return most;
}

/// Maximum change of log₁₀ r within this distance: towards the antenna.
double log_change(double distance, double reach_m) {
  return std::log10(distance / std::max(distance - reach_m, kNearestCell));
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
  for (Eigen::MatrixXd* of :
       {&tag.log_distance, &tag.gain_db, &tag.log_change, &tag.gain_change_db}) {
    of->resize(count, cells);
  }
  for (Eigen::Index j = 0; j < cells; ++j) {
    const double corner = std::sqrt(0.5) * tag.places.size_m[j];
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto antenna = static_cast<std::size_t>(i);
      const Eigen::Vector3d way = tag.places.cells[static_cast<std::size_t>(j)] - tag.p_WA[antenna];
      const double distance = std::max(way.norm(), kNearestCell);
      tag.log_distance(i, j) = std::log10(distance);
      tag.gain_db(i, j) = lobe_db(lobe, tag.boresight_W[antenna], way);
      tag.log_change(i, j) = log_change(distance, corner);
      tag.gain_change_db(i, j) = gain_change(lobe, tag.boresight_W[antenna], way, corner);
    }
  }
}

}  // namespace tagfield
