// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tagfield/report/axes.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/figure_data.h"

namespace tagfield {
namespace {

std::vector<Place> curve_of(const Axes& axes, const Trajectory& path, double start_s) {
  std::vector<Place> places;
  const std::size_t step = thinning(path.size(), kMaxMarks);
  for (std::size_t i = 0; i < path.size(); i += step) {
    places.push_back(
        place_in(axes, to_seconds(path[i].stamp) - start_s, path[i].X_WB.translation.z()));
  }
  return places;
}

Axes height_axes(const AntennaTrack& track, double start_s) {
  double low = track.best().front().X_WB.translation.z();
  double high = low;
  for (const Trajectory* path : {&track.best(), &track.believed}) {
    for (const StampedPose& pose : *path) {
      low = std::min(low, pose.X_WB.translation.z());
      high = std::max(high, pose.X_WB.translation.z());
    }
  }
  const double last = to_seconds(track.best().back().stamp) - start_s;
  Axes axes{tight_scale(0.0, std::max(last, 1e-3), 6), round_scale(low, high, 5)};
  axes.x.from = 52.0;
  axes.x.to = kDrawingWidth - 18.0;
  axes.y.from = 270.0;
  axes.y.to = 34.0;
  return axes;
}

}  // namespace

Figure height_figure(const RunFiles& run) {
  Figure figure{"fig11_antenna_height", "Fig. 11", "Height of the antenna", "", {}, ""};
  const AntennaTrack* track = busiest_track(run, true);
  if (track == nullptr) {
    figure.missing = "no antenna moves.";
    return figure;
  }
  const double start = to_seconds(track->best().front().stamp);
  const Axes axes = height_axes(*track, start);
  figure.svg.height = 318.0;
  draw_axes(figure.svg, axes, "time since the start [s]", "height [m]");
  add_polyline(figure.svg, curve_of(axes, track->best(), start), styled("path"));
  const Trajectory& path = track->best();
  figure.data = "time_s,height_m\n";
  for (std::size_t i = 0; i < path.size(); i += thinning(path.size(), kMaxMarks)) {
    add_data(figure.data, to_seconds(path[i].stamp) - start, path[i].X_WB.translation.z());
  }
  figure.caption = "Height of " + clean_text(track->antenna) +
                   " above the world's origin while the robot drives: the antenna moves vertically "
                   "too.";
  return figure;
}

}  // namespace tagfield
