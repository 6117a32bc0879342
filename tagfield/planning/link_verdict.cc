// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/link_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Smaller losses don't explain anything [dB].
constexpr double kWorthSaying_db = 3.0;
constexpr double kSeen_db = 1.0;
constexpr double kSeldom = 0.5;

/// Gain of the line that starts with `beginning`; 0 if there is none.
double line(const std::vector<BudgetLine>& lines, const std::string& beginning) {
  for (const BudgetLine& line : lines) {
    if (line.what.rfind(beginning, 0) == 0) return line.db;
  }
  return 0.0;
}

std::string behind(const std::vector<SurfaceOnPath>& between) {
  const SurfaceOnPath* worst = nullptr;
  for (const SurfaceOnPath& met : between) {
    if (met.gain_db > -kSeen_db && !met.opaque) continue;
    const bool is_worse = worst == nullptr || (met.opaque && !worst->opaque) ||
                          (met.opaque == worst->opaque && met.gain_db < worst->gain_db);
    if (is_worse) worst = &met;
  }
  return worst == nullptr ? "" : fmt::format("{} ({})", worst->object, worst->material);
}

/// The moving body that attenuates the direct path most; "" if none does noticeably.
std::string behind_body(const std::vector<BudgetLine>& lines) {
  constexpr const char* kPast = "past ";
  const BudgetLine* worst = nullptr;
  for (const BudgetLine& line : lines) {
    if (line.what.rfind(kPast, 0) != 0 || line.db > -kSeen_db) continue;
    if (worst == nullptr || line.db < worst->db) worst = &line;
  }
  return worst == nullptr ? "" : worst->what.substr(std::string(kPast).size());
}

bool is_blocked(const std::vector<SurfaceOnPath>& between) {
  return std::any_of(between.begin(), between.end(),
                     [](const SurfaceOnPath& met) { return met.opaque; });
}

/// The greatest of the avoidable losses, as ", …"; the distance if there is none.
std::string cause(const RadioModel& model, const TagModel& tag, const LinkExplanation& link) {
  const PhysicalLink& physical = *link.physical;
  const double beam_db = line(physical.to_tag, "antenna gain") - to_db(peak_gain(model.antenna));
  const double tag_db = line(physical.to_tag, "tag gain") - to_db(peak_gain(tag.antenna));
  double others_db = 0.0;
  for (const BudgetLine& of_way : physical.to_tag) {
    if (of_way.what.find("with it") != std::string::npos) others_db = of_way.db;
  }
  struct Cause {
    double db;
    const char* words;
  };
  const Cause all[] = {{beam_db, "off the antenna's beam"},
                       {tag_db, "as the tag hardly radiates in that direction"},
                       {line(physical.to_tag, "polarization"), "by crossed polarization"},
                       {others_db, "in a fade"},
                       {line(physical.to_tag, "coupling"), "by tags nearby"},
                       {line(physical.to_tag, "detuning"), "by what the tag is mounted on"}};
  const Cause& worst = *std::min_element(
      std::begin(all), std::end(all), [](const Cause& a, const Cause& b) { return a.db < b.db; });
  if (worst.db > -kWorthSaying_db - 0.2) return fmt::format(", {:.2f} m away", link.distance_m);
  return fmt::format(", {} ({})", worst.words, signed_db(worst.db));
}

std::string margins(const PhysicalLink& link) {
  std::string at_tag = signed_db(link.tag_margin_db()) + " at the tag";
  // For a tag without power, the margin at the reader means nothing.
  if (link.tag_margin_db() < 0.0) return at_tag;
  return at_tag + ", " + signed_db(link.reader_margin_db()) + " at the reader";
}

/// The strongest interfering reader, at the tag or at the reader.
std::string disturbed(const LinkInterference& by) {
  const bool at_tag = !by.tag_hears();
  const auto power = [&](const InterferingReader& one) {
    return at_tag ? one.at_tag_dbm : one.in_replies_dbm;
  };
  const InterferingReader& worst =
      *std::max_element(by.by.begin(), by.by.end(),
                        [&](const auto& a, const auto& b) { return power(a) < power(b); });
  if (at_tag) {
    return fmt::format("command not decodable at the tag ({1} over reader {0}, {2} needed)",
                       worst.reader, signed_db(by.capture_db), signed_db(by.required_capture_db));
  }
  return fmt::format("reply not decodable beside reader {} (SINR {}, {} needed)", worst.reader,
                     signed_db(by.sinr_db), signed_db(by.required_sinr_db));
}

void judge_physical(const LinkQuestion& question, LinkExplanation& link) {
  const PhysicalLink& physical = *link.physical;
  const TagModel& tag = *(question.tag.model ? question.tag.model : default_tag_model());
  const bool has_turn = !physical.takes_inventory || (physical.turn && *physical.turn <= link.time);
  const std::string there = behind(physical.between);
  const std::string back = behind(physical.between_return);
  const std::string surface = there.empty() ? back : there;
  const std::string what = surface.empty() ? behind_body(physical.to_tag) : surface;
  link.read = physical.heard() && has_turn;
  if (!physical.arrives && (is_blocked(physical.between) || is_blocked(physical.between_return))) {
    link.verdict = "not read: blocked by " + what;
  } else if (!physical.has_power()) {
    const RadioModel& model = *tagfield::physical(question.antenna.parameters);
    link.verdict = "not read: " + margins(physical) +
                   (what.empty() ? cause(model, tag, link) : ", behind " + what);
  } else if (!physical.heard()) {
    link.verdict = "not read: " + disturbed(*physical.interference) + "; " + margins(physical);
  } else if (!has_turn) {
    link.verdict =
        "not read just now: the antenna's turn " +
        (physical.turn ? fmt::format("is at {:g} s", to_seconds(*physical.turn)) : "never comes") +
        "; " + margins(physical);
  } else if (physical.decode_probability && *physical.decode_probability < kSeldom) {
    link.verdict = fmt::format("seldom read: {:.0f} % of its replies come through; {}",
                               100.0 * *physical.decode_probability, margins(physical));
  } else {
    link.verdict = "read: " + margins(physical);
  }
}

void judge_paper(LinkExplanation& link) {
  const PaperLink& paper = *link.paper;
  const double inside_m = paper.perturbed_range_m - link.distance_m;
  link.read = inside_m >= 0.0;
  link.verdict =
      fmt::format("{}: {:.2f} m {} the range of {:.2f} m ({:.2f} m in this update)",
                  link.read ? "read" : "not read", std::abs(inside_m),
                  link.read ? "inside" : "beyond", paper.range_m, paper.perturbed_range_m);
  if (!link.read || paper.rssi_dbm >= paper.sensitivity_dbm.value_or(paper.rssi_dbm)) return;
  link.read = false;
  link.verdict =
      fmt::format("not read: {:.0f} dBm without noise are below the sensitivity of {:g} dBm",
                  paper.rssi_dbm, *paper.sensitivity_dbm);
}

}  // namespace

std::string signed_db(double db) {
  constexpr double kLeast_db = -250.0;
  if (db < kLeast_db) return "nothing";
  const std::string number = fmt::format("{:.1f}", std::abs(db));
  return fmt::format("{}{} dB", db < 0.0 && number != "0.0" ? "−" : "+", number);
}

void judge(const LinkQuestion& question, LinkExplanation& link) {
  if (link.paper) {
    judge_paper(link);
  } else {
    judge_physical(question, link);
  }
  if (link.absent.empty()) return;
  link.read = false;
  link.verdict = "not read: " + link.absent;
}

}  // namespace tagfield
