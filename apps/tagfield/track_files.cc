// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/track_files.h"

#include "tagfield/report/tracks_csv.h"
#include "tagfield/report/tracks_figure.h"
#include "tagfield/report/tracks_page.h"

namespace tagfield {

void stage_tracks(const TrackSummary& summary, const TrackingRun& first, bool with_page,
                  StagedFolder& folder) {
  TrackTables(folder).add(first.tracks);
  stage_summary(summary, first, first.tracks.size(), first.reads.size(), with_page, folder);
}

TrackTables::TrackTables(StagedFolder& folder)
    : tracks_(folder.grow("tracks.csv")), verdicts_(folder.grow("verdicts.csv")) {
  tracks_->text() += tracks_to_csv({});
  verdicts_->text() += verdicts_to_csv({});
}

void TrackTables::add(const std::vector<TagTrack>& tracks) {
  for (const TagTrack& track : tracks) {
    tracks_->text() += track_rows({track});
    tracks_->sync();
  }
  verdicts_->text() += verdict_rows(tracks);
  verdicts_->sync();
}

void stage_summary(const TrackSummary& summary, const TrackingRun& first, std::size_t tags,
                   std::size_t reads, bool with_page, StagedFolder& folder) {
  folder.add("order.csv", orders_to_csv(first.orders));
  folder.add("tracks.json", to_json(summary));
  const TracksShown shown{
      tags,         reads,         &summary,      &first.reads, &first.believed_poses,
      &first.truth, &first.tracks, &first.orders, first.line};
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
