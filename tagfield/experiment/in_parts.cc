// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/in_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "tagfield/report/text.h"

namespace tagfield {
namespace {

/// A message without its numbers.
std::string kind_of(const std::string& message) {
  std::string kind;
  std::copy_if(message.begin(), message.end(), std::back_inserter(kind),
               [](char c) { return (c < '0' || c > '9') && c != '.' && c != '-'; });
  return kind;
}

/// Number of parts located by each method, "ml of 12, joint of 3".
std::string spoken(const std::map<std::string, std::size_t>& parts_by_method) {
  std::vector<std::string> words;
  words.reserve(parts_by_method.size());
  for (const auto& [method, parts] : parts_by_method) {
    words.push_back(fmt::format("{} of {}", method, parts));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

void WarningsOfParts::take(const Diagnostics& of_part) {
  std::set<std::string> seen;
  for (const std::string& warning : of_part.warnings()) {
    const std::string kind = kind_of(warning);
    const auto [entry, is_new] = said_.try_emplace(kind, warning, 0);
    if (is_new) order_.push_back(kind);
    if (seen.insert(kind).second) ++entry->second.second;
  }
}

void WarningsOfParts::give(Diagnostics& diagnostics) const {
  for (const std::string& kind : order_) {
    const auto& [text, parts] = said_.at(kind);
    diagnostics.warn(parts_ == 1 ? text
                                 : fmt::format("{} (so in {} of {} parts)", text, parts, parts_));
  }
}

LocalizationResult locate_in_parts(const ReadParts& parts, const std::vector<AntennaPose>& poses,
                                   const LocalizationOptions& options, Diagnostics& diagnostics) {
  LocalizationOptions of_part = options;
  of_part.on_locating = nullptr;
  WarningsOfParts warnings(parts.count);
  std::map<std::string, TagEstimate> estimates;
  std::map<std::string, std::size_t> methods;
  LocalizationResult all;
  for (std::size_t i = 0; i < parts.count; ++i) {
    if (options.on_locating) {
      options.on_locating("in " + counted(parts.count, "part"),
                          static_cast<double>(i) / static_cast<double>(parts.count));
    }
    Diagnostics of_this;
    LocalizationResult result = locate_tags(parts.reads(i), poses, of_part, of_this);
    warnings.take(of_this);
    for (TagEstimate& estimate : result.estimates) {
      std::string tag = estimate.tag;
      estimates.emplace(std::move(tag), std::move(estimate));
    }
    if (methods.empty()) all.why = result.why;
    all.method = result.method;
    ++methods[result.method];
  }
  warnings.give(diagnostics);
  if (methods.size() > 1) {
    all.method = options.method;
    all.why = "located in parts: " + spoken(methods);
  }
  for (auto& [tag, estimate] : estimates) all.estimates.push_back(std::move(estimate));
  return all;
}

}  // namespace tagfield
