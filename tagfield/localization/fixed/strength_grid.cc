// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/strength_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tagfield {
namespace {

constexpr double kNearestCell = 0.1;  ///< Smaller distances are clamped to this [m].
const double kLog10 = std::log(10.0);

/// Maximum change of the lobe's gain [dB] from that `here` towards the ends of a cross of this half
/// width.
double gain_change(const AimedLobe& lobe, const Eigen::Vector3d& way, double here, double reach_m) {
  if (lobe.exponent == 0.0 || reach_m == 0.0) return 0.0;
  double most = 0.0;
  for (const double step : {-reach_m, reach_m}) {
    const double along_x = lobe_db(lobe, way + step * Eigen::Vector3d::UnitX());
    const double along_y = lobe_db(lobe, way + step * Eigen::Vector3d::UnitY());
    most = std::max({most, std::abs(along_x - here), std::abs(along_y - here)});
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
  tag.log_change.resize(count, cells);
  tag.gain_change_db.resize(count, cells);
  Eigen::Array3Xd ways(3, cells);
  const Eigen::ArrayXd corners = std::sqrt(0.5) * tag.places.size_m;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto antenna = static_cast<std::size_t>(i);
    for (Eigen::Index j = 0; j < cells; ++j) {
      ways.col(j) = tag.places.cells[static_cast<std::size_t>(j)] - tag.p_WA[antenna];
    }
    const Eigen::ArrayXd distance =
        ways.square().colwise().sum().sqrt().max(kNearestCell).transpose();
    const Eigen::ArrayXd nearest = (distance - corners).max(kNearestCell);
    tag.log_distance.row(i) = (distance.log() / kLog10).transpose();
    tag.log_change.row(i) = ((distance / nearest).log() / kLog10).transpose();
    const AimedLobe of = aimed(lobe, tag.boresight_W[antenna]);
    for (Eigen::Index j = 0; j < cells; ++j) {
      tag.gain_db(i, j) = lobe_db(of, ways.col(j));
      tag.gain_change_db(i, j) = gain_change(of, ways.col(j), tag.gain_db(i, j), corners[j]);
    }
  }
}

TagOnGrid with_cells(const TagOnGrid& tag, const std::vector<Eigen::Index>& numbers) {
  TagOnGrid some;
  some.antennas = tag.antennas;
  some.p_WA = tag.p_WA;
  some.boresight_W = tag.boresight_W;
  some.rssi_dbm = tag.rssi_dbm;
  some.places.cells.reserve(numbers.size());
  for (const Eigen::Index number : numbers) {
    some.places.cells.push_back(tag.places.cells[static_cast<std::size_t>(number)]);
  }
  some.places.size_m = tag.places.size_m(numbers);
  some.places.density = tag.places.density(numbers, Eigen::all);
  some.log_distance = tag.log_distance(Eigen::all, numbers);
  some.gain_db = tag.gain_db(Eigen::all, numbers);
  some.log_change = tag.log_change(Eigen::all, numbers);
  some.gain_change_db = tag.gain_change_db(Eigen::all, numbers);
  return some;
}

TagOnGrid joined(const std::vector<TagOnGrid>& parts) {
  Eigen::Index cells = 0;
  for (const TagOnGrid& part : parts) cells += part.places.size_m.size();
  TagOnGrid sum = with_cells(parts.front(), {});
  sum.places.cells.reserve(static_cast<std::size_t>(cells));
  sum.places.size_m.resize(cells);
  sum.places.density.resize(cells, parts.front().places.density.cols());
  const auto antennas = static_cast<Eigen::Index>(sum.antennas.size());
  for (Eigen::MatrixXd* of :
       {&sum.log_distance, &sum.gain_db, &sum.log_change, &sum.gain_change_db}) {
    of->resize(antennas, cells);
  }
  for (const TagOnGrid& part : parts) {
    const auto first = static_cast<Eigen::Index>(sum.places.cells.size());
    const Eigen::Index count = part.places.size_m.size();
    sum.places.cells.insert(sum.places.cells.end(), part.places.cells.begin(),
                            part.places.cells.end());
    sum.places.size_m.segment(first, count) = part.places.size_m;
    sum.places.density.middleRows(first, count) = part.places.density;
    sum.log_distance.middleCols(first, count) = part.log_distance;
    sum.gain_db.middleCols(first, count) = part.gain_db;
    sum.log_change.middleCols(first, count) = part.log_change;
    sum.gain_change_db.middleCols(first, count) = part.gain_change_db;
  }
  return sum;
}

}  // namespace tagfield
