// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/track_files.h"

#include "tagfield/report/tracks_csv.h"
#include "tagfield/report/tracks_figure.h"
#include "tagfield/report/tracks_page.h"

namespace tagfield {

void stage_tracks(const TrackSummary& summary, const TrackingRun& first, bool with_page,
                  StagedFolder& folder) {
  folder.add("tracks.csv", tracks_to_csv(first.tracks));
  folder.add("verdicts.csv", verdicts_to_csv(first.tracks));
  folder.add("order.csv", orders_to_csv(first.orders));
  folder.add("tracks.json", to_json(summary));
  const TracksShown shown{&summary,     &first.reads,  &first.believed_poses,
                          &first.truth, &first.tracks, &first.orders};
  const std::vector<Figure> figures = tracks_figures(shown);
  for (const Figure& figure : figures) {
    const bool is_map = figure.name == "tracks";
    if (!figure.missing.empty() || !(with_page || is_map)) continue;
    folder.add(is_map ? "tracks.svg" : "figures/" + figure.name + ".svg",
               standalone_svg(figure.svg, figure.title, figure.caption));
  }
  if (with_page) folder.add("tracks.html", tracks_page(shown, figures));
}

const std::vector<std::filesystem::path>& track_file_names() {
  static const std::vector<std::filesystem::path> all = {
      "tracks.csv",  "verdicts.csv",         "order.csv",         "tracks.json", "tracks.svg",
      "tracks.html", "figures/passings.svg", "figures/speeds.svg"};
  return all;
}

}  // namespace tagfield
