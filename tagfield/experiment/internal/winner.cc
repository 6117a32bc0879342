// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/winner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "tagfield/experiment/internal/statistics.h"

namespace tagfield {
namespace {

using TagOfSeed = std::pair<std::uint64_t, std::string>;

std::map<TagOfSeed, double> errors_by_tag(const BenchEntry& entry) {
  std::map<TagOfSeed, double> errors;
  for (const MethodRun& run : entry.runs) {
    for (const TagRecord& tag : run.tags) {
      if (tag.error) errors.emplace(TagOfSeed(run.seed, tag.tag), *tag.error);
    }
  }
  return errors;
}

bool are_alike(const BenchEntry& one, const BenchEntry& other) {
  const std::map<TagOfSeed, double> errors = errors_by_tag(one);
  std::vector<double> differences;
  for (const auto& [tag, error] : errors_by_tag(other)) {
    const auto same = errors.find(tag);
    if (same != errors.end()) differences.push_back(error - same->second);
  }
  if (differences.size() < 2) return false;
  const auto count = static_cast<double>(differences.size());
  double mean = 0.0;
  for (const double difference : differences) mean += difference / count;
  double squares = 0.0;
  for (const double difference : differences) squares += std::pow(difference - mean, 2);
  return std::abs(mean) <= 1.96 * std::sqrt(squares / (count - 1.0) / count);
}

double mean_error(const BenchEntry& entry) {
  const std::optional<ErrorStatistics> errors = statistics_of(entry).error_m;
  return errors ? errors->mean : std::numeric_limits<double>::infinity();
}

}  // namespace

std::size_t count_right(const BenchEntry& entry) {
  const std::vector<double> errors = errors_of(entry);
  return static_cast<std::size_t>(
      std::count_if(errors.begin(), errors.end(), [](double error) { return error <= kWrong_m; }));
}

std::optional<Winner> winner_of(const std::vector<const BenchEntry*>& entries) {
  std::size_t most = 0;
  for (const BenchEntry* entry : entries) most = std::max(most, count_right(*entry));
  if (most == 0) return std::nullopt;
  std::vector<const BenchEntry*> competitors;
  for (const BenchEntry* entry : entries) {
    if (static_cast<double>(count_right(*entry)) >= kCompetes * static_cast<double>(most)) {
      competitors.push_back(entry);
    }
  }
  Winner winner;
  winner.entry = *std::min_element(
      competitors.begin(), competitors.end(),
      [](const BenchEntry* a, const BenchEntry* b) { return mean_error(*a) < mean_error(*b); });
  for (const BenchEntry* entry : competitors) {
    if (entry != winner.entry && are_alike(*winner.entry, *entry)) winner.alike.push_back(entry);
  }
  return winner;
}

}  // namespace tagfield
