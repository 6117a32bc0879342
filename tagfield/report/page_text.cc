// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/page_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/localization/locate.h"
#include "tagfield/report/internal/inventory_section.h"
#include "tagfield/report/text.h"
#include "tagfield/report/tracks_page.h"
#include "tagfield/report/warnings_note.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxSeeds = 6;

std::string paragraph(const std::string& text) { return fmt::format("<p>{}</p>\n", escaped(text)); }

std::size_t count_read(const Summary& summary) {
  return static_cast<std::size_t>(
      std::count_if(summary.tags.begin(), summary.tags.end(),
                    [](const TagOutcome& tag) { return tag.reads > 0; }));
}

bool all_moved(const Summary& summary) {
  return !summary.tags.empty() && std::all_of(summary.tags.begin(), summary.tags.end(),
                                              [](const TagOutcome& tag) { return tag.moved; });
}

/// A moving tag has no single position at which it could be located.
std::string moved_sentence(const Summary& summary) {
  return fmt::format(
      "{} of {} read, {} in all. All of them moved, so none has a single position; tagfield track "
      "follows tags past antennas at rest.",
      grouped(count_read(summary)), counted(summary.tags.size(), "tag"),
      counted(summary.reads, "read"));
}

std::string outcome_sentence(const Summary& summary) {
  const std::size_t located = count(summary, Verdict::kLocated);
  const std::size_t ambiguous = count(summary, Verdict::kAmbiguous);
  const std::size_t lost = count(summary, Verdict::kNotLocated);
  if (located + ambiguous == 0 && all_moved(summary)) return moved_sentence(summary);
  const std::size_t all = count_to_locate(summary);
  const std::string word = summary.seeds.size() > 1 ? "outcome" : "tag";
  std::string text = fmt::format("{} of {} located", grouped(located), counted(all, word));
  if (ambiguous > 0) text += fmt::format(", {} ambiguous", grouped(ambiguous));
  if (lost > 0) text += fmt::format(", {} not located", grouped(lost));
  if (const std::size_t given = summary.tags.size() - all; given > 0) {
    text += fmt::format(", not counting {}", counted(given, "reference tag"));
  }
  const auto errors = error_statistics(summary);
  const bool truth_known =
      std::any_of(summary.tags.begin(), summary.tags.end(),
                  [](const TagOutcome& tag) { return tag.truth_m || tag.moved; });
  if (!errors && truth_known) return text + ". No located tag at rest, so no error to report.";
  if (!errors) return text + ". The true positions are not known, so neither are the errors.";
  return text + fmt::format(". The estimates are off by {} on average and by {} at most.",
                            spoken_length(errors->mean), spoken_length(errors->max));
}

std::string incomplete_note(const Summary& summary) {
  if (summary.complete) return "";
  return "<div class=\"note incomplete\"><p><strong>Incomplete run.</strong> It was interrupted;"
         " everything below holds only for the part that was simulated.</p></div>\n";
}

std::string big(const std::string& name, const std::string& value, bool lead = false) {
  return fmt::format("<div{}><dt>{}</dt><dd>{}</dd></div>\n", lead ? " class=\"lead\"" : "",
                     escaped(name), escaped(value));
}

std::string fact(const std::string& name, const std::string& value) {
  if (value.empty()) return "";
  return "<dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
}

std::string spoken_method(const std::string& method) {
  if (method == "none") return "none: an inventory, no localization";
  if (method == "hyperbola") return "hyperbolic intersections of the unwrapped phase (the paper's)";
  for (const Method& known : built_in_methods()) {
    if (known.name == method) return method + ": " + known.summary;
  }
  return method;
}

std::string spoken_pose(const std::string& pose) {
  if (pose == "true") return "the true antenna poses";
  if (pose == "noisy") return "true poses with an error added";
  if (pose == "odometry") return "wheel odometry";
  if (pose == "slam") return "the robot’s own, by laser and map";
  if (pose == "tf") return "the robot’s own (tf)";
  if (pose == "given") return "as given with the reads";
  return pose;
}

std::string spoken_seeds(const std::vector<std::uint64_t>& seeds) {
  if (seeds.empty()) return "none: the reads came from outside";
  const std::size_t shown = seeds.size() <= kMaxSeeds ? seeds.size() : 1;
  std::string text = fmt::format(
      "{}", fmt::join(seeds.begin(), seeds.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (shown < seeds.size()) text += fmt::format(" … {}", seeds.back());
  return seeds.size() == 1 ? text : fmt::format("{} ({})", seeds.size(), text);
}

std::string spoken_duration(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.{}f} s", seconds, seconds < 10.0 ? 2 : 1);
  return fmt::format("{:.1f} min", seconds / 60.0);
}

/// Percent-encoding as in a URI (RFC 3986).
std::string percent_encoded(const std::string& text) {
  std::string encoded;
  for (const char c : text) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       c == ',' || c == '.' || c == '_' || c == '-';
    if (plain) {
      encoded += c;
    } else {
      encoded += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
  }
  return encoded;
}

}  // namespace

std::string page_header(const Summary& summary, const std::optional<TrackedTags>& tracked) {
  const std::string name = summary.scenario.empty() ? "A run" : summary.scenario;
  std::string html = "<header>\n<p class=\"kind\">Tagfield report</p>\n<h1><bdi>" +
                     breakable(name) + "</bdi></h1>\n";
  if (!summary.description.empty()) {
    html += "<p class=\"muted\">" + escaped(summary.description) + "</p>\n";
  }
  html += incomplete_note(summary);
  html += paragraph(is_inventory_alone(summary)
                        ? inventory_sentence(*summary.inventory, summary.seeds.size())
                        : outcome_sentence(summary));
  if (tracked) {
    html += paragraph(tracks_sentence(tracked->numbers, tracked->orders) +
                      (summary.seeds.size() > 1 ? " That is of the first run;" : "") +
                      " tracks.html has the tracks.");
  }
  return html + "</header>\n";
}

std::string key_numbers(const Summary& summary) {
  std::string html = "<dl class=\"numbers\">\n";
  if (const auto errors = error_statistics(summary)) {
    html += big("Mean error", spoken_length(errors->mean), true);
    html += big("95 % within", spoken_length(errors->p95));
    html += big("Maximum error", spoken_length(errors->max));
  }
  if (count(summary, Verdict::kLocated) == 0 && all_moved(summary)) {
    html += big("Tags read",
                fmt::format("{} of {}", grouped(count_read(summary)), grouped(summary.tags.size())),
                true);
  } else {
    html += big("Located", fmt::format("{} of {}", grouped(count(summary, Verdict::kLocated)),
                                       grouped(count_to_locate(summary))));
  }
  html += big("Reads", grouped(summary.reads));
  html += big("Path", fmt::format("{:.1f} m", summary.path_length_m));
  if (summary.simulated_s > 0.0) html += big("Simulated", spoken_duration(summary.simulated_s));
  if (summary.real_time_factor > 0.0) {
    html +=
        big("Real-time factor",
            summary.real_time_factor < 10.0
                ? fmt::format("{:.1f}×", summary.real_time_factor)
                : grouped(static_cast<std::size_t>(std::lround(summary.real_time_factor))) + "×");
  }
  return html + "</dl>\n";
}

std::string pose_error_text(const Summary& summary) {
  if (!summary.pose_error) return "";
  const PoseErrorSummary& pose = *summary.pose_error;
  std::string text = fmt::format("The robot believed its antenna {} (rms) off its true position.",
                                 spoken_length(pose.position_rms_m));
  if (pose.corrected_rms_m) {
    text += fmt::format(" Localization estimated that error, too, which leaves {} of it.",
                        spoken_length(*pose.corrected_rms_m));
  }
  const auto errors = error_statistics(summary);
  if (!errors || !pose.error_with_true_pose_m) return text;
  const double with_truth = pose.error_with_true_pose_m->mean;
  text +=
      fmt::format(" With the true pose the same reads give {} on average; with the believed one {}",
                  spoken_length(with_truth), spoken_length(errors->mean));
  if (errors->mean > 2.0 * with_truth) {
    return text + ": pose error, not phase noise, sets this figure.";
  }
  if (errors->mean > 1.1 * with_truth) return text + ": the pose error adds to that of the phase.";
  return text + ": here the pose error makes little difference.";
}

std::string compared_pose_text(const Summary& summary) {
  if (!summary.compared_pose) return "";
  const ComparedPose& other = *summary.compared_pose;
  std::string text = fmt::format(
      "The same reads with other antenna poses, {}, {} (rms) off these: {} of {} located",
      spoken_pose(other.pose), spoken_length(other.position_rms_m), grouped(other.located),
      counted(count_to_locate(summary), "tag"));
  if (!other.error_m) return text + ".";
  return text + fmt::format(", off by {} on average and by {} at most.",
                            spoken_length(other.error_m->mean), spoken_length(other.error_m->max));
}

std::string run_facts(const Summary& summary) {
  std::string html = "<dl class=\"facts\">\n";
  const bool is_none = summary.method == "none";
  const bool is_interrupted = is_none && !is_inventory_alone(summary);
  html += fact("Method", is_interrupted ? "none" : spoken_method(summary.method));
  html += fact(is_none ? "Why" : "Chosen by " + summary.method_asked, summary.method_why);
  html += fact("Antenna poses", spoken_pose(summary.pose));
  if (summary.pose_error && summary.pose == "noisy") {  // Of others no such error is stated.
    html += fact("Stated pose error",
                 fmt::format("σ {} per axis, σ {:.2f}° in heading, time constant {:.3g} s",
                             spoken_length(summary.pose_error->sigma_m),
                             degrees(summary.pose_error->yaw_sigma_rad),
                             summary.pose_error->time_constant_s));
  }
  html += fact(summary.seeds.size() > 1 ? "Seeds" : "Seed", spoken_seeds(summary.seeds));
  if (summary.wall_s > 0.0) html += fact("Computed in", spoken_duration(summary.wall_s));
  html += "</dl>\n";
  for (const std::string& pose : {pose_error_text(summary), compared_pose_text(summary)}) {
    if (!pose.empty()) html += "<div class=\"note pose\">" + paragraph(pose) + "</div>\n";
  }
  return html + warnings_note(summary.warnings, "summary.json");
}

std::string data_link(const std::string& file, const std::string& words, const std::string& csv) {
  return fmt::format(
      "<a class=\"data\" download=\"{}\" href=\"data:text/csv;charset=utf-8,{}\">{}</a>",
      escaped(file), percent_encoded(csv), escaped(words));
}

std::string figure_html(const Figure& figure) {
  const std::string number = escaped(figure.number);
  if (!figure.missing.empty()) {
    return fmt::format("<p class=\"muted\"><strong>{}{}</strong> is not drawn: {}</p>\n",
                       escaped(figure.title), number.empty() ? "" : fmt::format(" ({})", number),
                       escaped(figure.missing));
  }
  return fmt::format(
      "<figure id=\"{}\">\n{}<figcaption><strong>{}.</strong> {}{}{}</figcaption>\n</figure>\n",
      escaped(figure.name), inline_svg(figure.svg, figure.title), escaped(figure.title),
      escaped(figure.caption),
      number.empty() ? "" : fmt::format(" <span class=\"muted\">({} of the paper)</span>", number),
      figure.data.empty() ? "" : " " + data_link(figure.name + ".csv", "Data as CSV", figure.data));
}

std::string page_footer() {
  return "<footer>\n<p>Model and experiment follow S. D’Avella, M. Unetti, P. Tripicchio, “RFID "
         "Gazebo-Based Simulator With RSSI and Phase Signals for UHF Tags Localization and "
         "Tracking”, IEEE Access 10, 2022, doi:10.1109/ACCESS.2022.3152199. Please cite "
         "it.</p>\n<p>Made by Tagfield from the files beside this page. The figures are in "
         "figures/ as SVG files, fit for a paper.</p>\n</footer>\n";
}

}  // namespace tagfield
