// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/internal/statistics.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxTextName = 24;

std::size_t name_width(const Bench& bench) {
  std::size_t width = 6;
  for (const BenchEntry& entry : bench.entries) {
    width = std::max(width, length_of(shortened(entry.name, kMaxTextName)));
  }
  return width;
}

/// Width in characters, not bytes.
std::string padded(const std::string& name, std::size_t width) {
  const std::string text = shortened(name, kMaxTextName);
  return text + std::string(width - length_of(text), ' ');
}

std::string millimetres(const std::optional<ErrorStatistics>& errors,
                        double ErrorStatistics::*property) {
  return errors ? fmt::format("{:.1f}", 1e3 * (*errors).*property) : "-";
}

std::string ratio_text(const std::optional<BoundRatio>& ratio) {
  return ratio ? fmt::format("{:.2f}", ratio->mean) : "-";
}

std::string expected_text(const std::optional<double>& ratio) {
  return ratio ? fmt::format("{:.2f}", *ratio) : "-";
}

/// NEES per degree of freedom, so that 1 is right.
std::string nees_text(const std::optional<NeesSummary>& nees) {
  if (!nees) return "-";
  constexpr const char* kMarks[] = {"", " (cautious)", " (bold)"};
  return fmt::format("{:.2f}{}", nees->mean / nees->expected,
                     kMarks[static_cast<int>(nees->consistency)]);
}

std::string time_text(const std::optional<double>& time_ms) {
  return time_ms ? fmt::format("{:.1f}", *time_ms) : "-";
}

std::string row_of(const BenchEntry& entry, std::size_t width, bool aligned, Timing timing) {
  const EntryStatistics all = statistics_of(entry);
  std::string row =
      fmt::format("  {}  {:>4}/{:<4} {:>5} {:>5} {:>5} {:>8} {:>8} {:>8} {:>8}",
                  padded(entry.name, width), all.located, all.tags, all.ambiguous, all.wrong,
                  all.false_claims, millimetres(all.error_m, &ErrorStatistics::mean),
                  millimetres(all.error_m, &ErrorStatistics::median),
                  millimetres(all.error_m, &ErrorStatistics::p95),
                  millimetres(all.error_m, &ErrorStatistics::max));
  if (aligned) {
    row += fmt::format(" {:>8}", millimetres(all.aligned_error_m, &ErrorStatistics::mean));
  }
  row += fmt::format(" {:>7} {:>7}", expected_text(all.error_over_expected), ratio_text(all.ratio));
  if (timing == Timing::kWithTimes) row += fmt::format(" {:>8}", time_text(all.time_per_tag_ms));
  return row + "  " + nees_text(all.nees) + "\n";
}

std::string head_of(std::size_t width, bool aligned, Timing timing) {
  std::string head =
      fmt::format("  {:<{}}  {:>9} {:>5} {:>5} {:>5} {:>8} {:>8} {:>8} {:>8}", "method", width,
                  "located", "ambig", "wrong", "false", "mean", "median", "p95", "max");
  if (aligned) head += fmt::format(" {:>8}", "aligned");
  head += fmt::format(" {:>7} {:>7}", "/expect", "/bound");
  if (timing == Timing::kWithTimes) head += fmt::format(" {:>8}", "ms/tag");
  return head + "  NEES/dof\n";
}

}  // namespace

std::string bench_to_text(const Bench& bench, Timing timing) {
  const std::size_t width = name_width(bench);
  std::string text;
  for (const BenchCondition& condition : bench.conditions) {
    const std::vector<const BenchEntry*> entries = entries_of(bench, condition.name);
    const std::size_t runs = entries.empty() ? 0 : entries.front()->runs.size();
    const bool aligned = condition.pose != "true";
    text +=
        fmt::format("{} ({}; errors in mm)\n", clean_text(condition.name), counted(runs, "run"));
    text += head_of(width, aligned, timing);
    for (const BenchEntry* entry : entries) text += row_of(*entry, width, aligned, timing);
    text += "\n";
  }
  return text;
}

}  // namespace tagfield
