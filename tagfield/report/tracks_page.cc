// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/tracks_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/report/internal/tables.h"
#include "tagfield/report/page.h"
#include "tagfield/report/page_script.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/passings_figure.h"
#include "tagfield/report/text.h"
#include "tagfield/report/tracks_figure.h"
#include "tagfield/report/warnings_note.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxNamed = 5;  ///< Tags named in a sentence.

std::string tracks_header(const TracksShown& shown) {
  const TrackSummary& summary = *shown.summary;
  return "<header>\n<p class=\"kind\">Tagfield tracks</p>\n<h1><bdi>" + breakable(summary.name) +
         "</bdi></h1>\n<p>" + escaped(tracks_sentence(numbers_of(summary), *shown.orders)) +
         "</p>\n</header>\n";
}

std::string tracks_number(const std::string& name, const std::string& value, bool lead = false) {
  return fmt::format("<div{}><dt>{}</dt><dd>{}</dd></div>\n", lead ? " class=\"lead\"" : "",
                     escaped(name), escaped(value));
}

/// Horizontal velocity halfway [m/s]; none for a tag without a track.
std::optional<Eigen::Vector2d> velocity_of(const TagTrack& tag) {
  if (tag.tracks.empty() || tag.tracks.front().points.empty()) return std::nullopt;
  const std::vector<TrackPoint>& points = tag.tracks.front().points;
  return Eigen::Vector2d(points[points.size() / 2].v_WT.head<2>());
}

std::string spoken_speeds(const std::vector<TagTrack>& tracks) {
  std::vector<double> speeds;
  for (const TagTrack& tag : tracks) {
    const auto velocity = velocity_of(tag);
    if (velocity && tag.verdict == TrackVerdict::kTracked) speeds.push_back(velocity->norm());
  }
  const auto numbers = statistics(std::move(speeds));
  return numbers ? fmt::format("{:.2f} m/s", numbers->median) : "";
}

std::string tracks_numbers(const TracksShown& shown) {
  const TrackSummary& summary = *shown.summary;
  std::string html = "<dl class=\"numbers\">\n";
  html += tracks_number("Tracked",
                        fmt::format("{} of {}", grouped(count(summary, TrackVerdict::kTracked)),
                                    grouped(summary.tags.size())),
                        true);
  if (const std::size_t ambiguous = count(summary, TrackVerdict::kAmbiguous)) {
    html += tracks_number("Ambiguous", grouped(ambiguous));
  }
  if (const auto along = track_statistics(summary, &TrackOutcome::along_m)) {
    html += tracks_number("Mean error along", spoken_length(along->mean));
  }
  if (const auto across = track_statistics(summary, &TrackOutcome::across_m)) {
    html += tracks_number("Mean error across", spoken_length(across->mean));
  }
  const std::string speeds = spoken_speeds(*shown.tracks);
  if (!speeds.empty()) html += tracks_number("Median speed", speeds);
  for (const OrderOutcome& order : summary.orders) {
    if (order.pairs == 0) continue;
    html += tracks_number("In order at " + shortened(order.name, 18),
                          fmt::format("{} of {}", grouped(order.right), grouped(order.pairs)));
  }
  return html + tracks_number("Reads", grouped(shown.read_count)) + "</dl>\n";
}

std::string tracks_fact(const std::string& name, const std::string& value) {
  return "<dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
}

std::string spoken_smoother(const std::string& method) {
  if (method == "ekf") return "extended Kalman filter and smoother";
  if (method == "ukf") return "unscented Kalman filter and smoother";
  return method == "particle" ? "particle filter and smoother" : method;
}

std::string tracks_facts(const TrackSummary& summary) {
  std::string html =
      "<dl class=\"facts\">\n" + tracks_fact("Method", spoken_smoother(summary.method)) +
      tracks_fact(summary.seeds.size() > 1 ? "Seeds" : "Seed",
                  summary.seeds.size() > 1
                      ? fmt::format("{}; the figures show the first, {}",
                                    grouped(summary.seeds.size()), summary.seeds.front())
                      : fmt::format("{}", summary.seeds.front()));
  if (const auto nees = mean_nees(summary)) {
    html += tracks_fact("Squared errors over stated covariances",
                        fmt::format("{:.2f} on average; 1 is right, more is overconfident", *nees));
  }
  return html + "</dl>\n";
}

std::string track_verdict(TrackVerdict verdict) {
  if (verdict == TrackVerdict::kTracked) return "tracked";
  return verdict == TrackVerdict::kAmbiguous ? "ambiguous" : "not tracked";
}

std::string track_millimetres(const std::vector<double>& lengths_m) {
  const auto numbers = statistics(lengths_m);
  return numbers ? fmt::format("{:.1f}", 1e3 * numbers->mean) : "–";
}

std::string track_row(const TagTrack& tag, const TrackOutcome& outcome, bool truth, bool remarks) {
  std::string row = fmt::format(
      "<tr><th scope=\"row\" title=\"{}\"><bdi>{}</bdi></th><td class=\"words\">{}</td><td>{}</td>",
      escaped(tag.tag), escaped(shortened(tag.tag, 28)), track_verdict(tag.verdict),
      grouped(tag.reads));
  const auto velocity = velocity_of(tag);
  if (velocity) {
    const double heading = std::round(10.0 * degrees(std::atan2(velocity->y(), velocity->x())));
    row += fmt::format("<td>{:.3f}</td><td>{}{:.1f}</td><td>{:.1f}</td>", velocity->norm(),
                       heading < 0.0 ? "−" : "", 0.1 * std::abs(heading),
                       1e3 * outcome.expected_error_m);
  } else {
    row += "<td>–</td><td>–</td><td>–</td>";
  }
  if (truth) {
    row += "<td>" + track_millimetres(outcome.along_m) + "</td><td>" +
           track_millimetres(outcome.across_m) + "</td>";
  }
  if (remarks) row += "<td class=\"words\">" + escaped(tag.reason) + "</td>";
  return row + "</tr>\n";
}

std::string tracks_left_out(const TracksShown& shown) {
  if (shown.tracks->size() >= shown.tag_count) return "";
  return fmt::format(
      "<p class=\"muted\">The figures of tracks and speeds show the first {} of {} tags; "
      "tracks.csv holds all.</p>\n",
      grouped(shown.tracks->size()), grouped(shown.tag_count));
}

/// The table of the first seed, whose outcomes come first, in the order of its tracks.
std::string tracks_table(const TracksShown& shown) {
  const std::vector<TagTrack>& tracks = *shown.tracks;
  if (tracks.empty()) return "<p>No tag was read.</p>\n";
  const std::vector<TrackOutcome>& outcomes = shown.summary->tags;
  const bool truth = std::any_of(outcomes.begin(), outcomes.end(),
                                 [](const TrackOutcome& tag) { return !tag.along_m.empty(); });
  const bool remarks = std::any_of(tracks.begin(), tracks.end(),
                                   [](const TagTrack& tag) { return !tag.reason.empty(); });
  std::string html =
      "<div class=\"table\" role=\"region\" aria-label=\"Tags\" tabindex=\"0\"><table>\n"
      "<thead><tr><th scope=\"col\">Tag</th><th scope=\"col\" class=\"words\">Verdict</th>"
      "<th scope=\"col\">Reads</th><th scope=\"col\">Speed<br>[m/s]</th>"
      "<th scope=\"col\">Heading<br>[°]</th><th scope=\"col\">Expected<br>error [mm]</th>";
  if (truth) {
    html +=
        "<th scope=\"col\">Mean error<br>along [mm]</th>"
        "<th scope=\"col\">across<br>[mm]</th>";
  }
  if (remarks) html += "<th scope=\"col\" class=\"words\">Remark</th>";
  html += "</tr></thead>\n<tbody>\n";
  const std::size_t most = std::min({tracks.size(), outcomes.size(), kMaxTableRows});
  for (std::size_t i = 0; i < most; ++i) {
    html += track_row(tracks[i], outcomes[i], truth, remarks);
  }
  html += "</tbody></table></div>\n";
  if (most < shown.tag_count) {
    html += fmt::format("<p class=\"muted\">The first {} of {} tags; verdicts.csv holds all.</p>\n",
                        most, grouped(shown.tag_count));
  }
  return html +
         "<p class=\"muted\">Speed and heading halfway; expected error where the tag came nearest "
         "to an antenna; headings are from x towards y.</p>\n";
}

std::string order_words(const PassingOrder& order) {
  std::string names;
  const std::size_t shown = std::min(order.passings.size(), kMaxNamed);
  for (std::size_t i = 0; i < shown; ++i) {
    names += (names.empty() ? "" : ", ") + clean_text(order.passings[i].tag);
  }
  if (shown < order.passings.size()) {
    names += fmt::format(" and {} more", grouped(order.passings.size() - shown));
  }
  return fmt::format(" {} passed {}, first to last: {}.", counted(order.passings.size(), "tag"),
                     order.name == "line" ? "the line" : clean_text(order.name), names);
}

}  // namespace

std::string tracks_sentence(const TrackNumbers& numbers, const std::vector<PassingOrder>& orders) {
  const std::size_t all = numbers.tracked + numbers.ambiguous + numbers.not_tracked;
  std::string text = fmt::format("{} of {} tracked", grouped(numbers.tracked), counted(all, "tag"));
  if (numbers.ambiguous > 0) text += fmt::format(", {} ambiguous", grouped(numbers.ambiguous));
  text += ".";
  if (numbers.along_m && numbers.across_m) {
    text += fmt::format(
        " The tracks are off by {} along their direction and by {} across it, on average.",
        spoken_length(*numbers.along_m), spoken_length(*numbers.across_m));
  }
  if (!orders.empty() && !orders.front().passings.empty()) text += order_words(orders.front());
  std::string right;
  for (const OrderOutcome& order : numbers.orders) {
    if (order.pairs == 0) continue;
    right += fmt::format("{} at {} {} of {}", right.empty() ? "" : ",",
                         order.name == "line" ? "the line" : clean_text(order.name),
                         grouped(order.right), grouped(order.pairs));
  }
  if (!right.empty()) text += " Neighbours in the right order:" + right + ".";
  return text;
}

std::vector<Figure> tracks_figures(const TracksShown& shown) {
  return {tracks_figure(*shown.tracks, *shown.antennas, *shown.truth, shown.line),
          passings_figure(*shown.reads, *shown.orders), speeds_figure(*shown.tracks)};
}

std::string tracks_page(const TracksShown& shown, const std::vector<Figure>& figures) {
  std::string drawn;
  std::string missing;
  for (const Figure& figure : figures) {
    (figure.missing.empty() ? drawn : missing) += figure_html(figure);
  }
  return page_head(shown.summary->name + " – Tagfield tracks",
                   {table_script().hash, figure_script().hash, link_script().hash}) +
         "<body>\n" + tracks_header(shown) + "<main>\n" + tracks_numbers(shown) +
         warnings_note(shown.summary->warnings, "tracks.json") + tracks_left_out(shown) +
         "<div class=\"figures\">\n" + drawn + "</div>\n" + missing +
         passings_table(*shown.orders) + "<h2>Tags</h2>\n" + tracks_table(shown) +
         tracks_facts(*shown.summary) +
         "</main>\n<footer>\n<p>Made by Tagfield; tracks.csv, verdicts.csv, order.csv and "
         "tracks.json are beside this page; tracks.svg and figures/ are the "
         "figures.</p>\n</footer>\n" +
         script_html(table_script()) + script_html(figure_script()) + script_html(link_script()) +
         "</body>\n</html>\n";
}

}  // namespace tagfield
