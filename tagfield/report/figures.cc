// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/figures.h"

#include <Eigen/Geometry>

#include "tagfield/report/internal/inventory_figures.h"
#include "tagfield/report/internal/inventory_section.h"
#include "tagfield/report/passings_figure.h"

namespace tagfield {
namespace {

constexpr double kVerticalMotion = 0.05;  ///< [m]
constexpr std::size_t kFewErrors = 20;

bool moves_vertically(const AntennaTrack* track) {
  if (track == nullptr) return false;
  Eigen::AlignedBox1d heights;
  for (const StampedPose& pose : track->best()) {
    heights.extend(pose.X_WB.translation.tail<1>());
  }
  return heights.sizes().x() > kVerticalMotion;
}

void add_navigation(const RunFiles& run, std::vector<Figure>& figures) {
  if (!run.summary.navigation) return;
  figures.push_back(robot_map_figure(run));
  if (run.summary.pose != "true") figures.push_back(pose_error_figure(run));
}

}  // namespace

std::vector<Figure> all_figures(const RunFiles& run) {
  std::vector<Figure> figures;
  if (run.tracked) figures.push_back(passings_figure(run.reads, run.tracked->orders));
  if (run.summary.inventory) {
    figures.push_back(inventory_curve_figure(run));
    figures.push_back(inventory_antennas_figure(run));
  }
  if (is_inventory_alone(run.summary)) {
    figures.push_back(fixed_rssi_figure(run));
    if (hops(run)) figures.push_back(hopping_figure(run));
    return figures;
  }
  figures.push_back(map_figure(run));
  figures.push_back(error_figure(run));
  const auto errors = error_statistics(run.summary);
  const bool several = run.summary.seeds.size() > 1 && errors && errors->count > 1;
  if (several || (errors && errors->count >= kFewErrors)) {
    figures.push_back(distribution_figure(run));
  }
  add_navigation(run, figures);
  if (moves_vertically(busiest_track(run, true))) figures.push_back(height_figure(run));
  figures.push_back(hops(run) ? hopping_figure(run) : phase_figure(run));
  figures.push_back(path_rssi_figure(run));
  figures.push_back(fixed_rssi_figure(run));
  if (figures.back().missing.empty()) figures.push_back(fixed_strip_figure(run));
  return figures;
}

}  // namespace tagfield
