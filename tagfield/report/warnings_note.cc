// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/warnings_note.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxItems = 50;
constexpr std::size_t kMaxPlaces = 12;   ///< Listed of merged warnings.
constexpr std::size_t kLeastShared = 5;  ///< Words at the end that merged warnings share.

using Words = std::vector<std::string>;

/// Warnings that end in the same words.
struct Alike {
  std::vector<Words> warnings;
  std::size_t shared = 0;  ///< Number of words at the end that all of them have.
};

Words words_in(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string joined(const Words& words, std::size_t first, std::size_t last) {
  std::string text;
  for (std::size_t i = first; i < last; ++i) text += (i == first ? "" : " ") + words[i];
  return text;
}

std::size_t shared_end(const Words& a, const Words& b) {
  const auto differ = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  return static_cast<std::size_t>(differ.first - a.rbegin());
}

/// Merges if the shared words are most of both warnings.
bool merge(const Words& words, Alike& group) {
  const std::size_t shared = std::min(shared_end(words, group.warnings.front()), group.shared);
  const std::size_t all = std::max(words.size(), group.warnings.front().size());
  const bool equal = shared == words.size() && shared == group.warnings.front().size();
  if (!equal && (shared < kLeastShared || 2 * shared < all)) return false;
  group.warnings.push_back(words);
  group.shared = shared;
  return true;
}

std::vector<Alike> grouped_by_end(const std::vector<std::string>& warnings) {
  std::vector<Alike> groups;
  for (const std::string& warning : warnings) {
    const Words words = words_in(warning);
    const bool is_merged = std::any_of(groups.begin(), groups.end(),
                                       [&](Alike& group) { return merge(words, group); });
    if (!is_merged) groups.push_back({{words}, words.size()});
  }
  return groups;
}

/// What stands before the shared words of each, in brackets; "" if nothing does.
std::string beginnings(const Alike& group) {
  std::string text;
  const std::size_t shown = std::min(group.warnings.size(), kMaxPlaces);
  for (std::size_t i = 0; i < shown; ++i) {
    const Words& words = group.warnings[i];
    std::string begin = joined(words, 0, words.size() - group.shared);
    if (!begin.empty() && begin.back() == ':') begin.pop_back();
    if (!begin.empty()) text += (text.empty() ? "" : "; ") + begin;
  }
  if (!text.empty() && shown < group.warnings.size()) {
    text += fmt::format("; and {} more", grouped(group.warnings.size() - shown));
  }
  return text;
}

std::string item(const Alike& group) {
  const Words& first = group.warnings.front();
  if (group.warnings.size() == 1) return "<li>" + escaped(joined(first, 0, first.size())) + "</li>";
  const std::string begin = beginnings(group);
  return fmt::format("<li>{}{} <span class=\"muted\">({} times{}{})</span></li>",
                     begin.empty() ? "" : "… ",
                     escaped(joined(first, first.size() - group.shared, first.size())),
                     grouped(group.warnings.size()), begin.empty() ? "" : ": ", escaped(begin));
}

std::string list_of(const std::vector<Alike>& groups, const std::string& file) {
  std::string html = "<ul>\n";
  const std::size_t shown = std::min(groups.size(), kMaxItems);
  for (std::size_t i = 0; i < shown; ++i) html += item(groups[i]) + "\n";
  if (shown < groups.size()) {
    html += fmt::format("<li>and {} more{}</li>\n", grouped(groups.size() - shown),
                        file.empty() ? "" : " in " + escaped(file));
  }
  return html + "</ul>";
}

}  // namespace

std::string warnings_note(const std::vector<std::string>& warnings, const std::string& file) {
  if (warnings.empty()) return "";
  const std::string head = "<strong>" + counted(warnings.size(), "warning") + "</strong>";
  const std::string list = list_of(grouped_by_end(warnings), file);
  if (warnings.size() <= kMaxOpenWarnings) {
    return "<div class=\"note\"><p>" + head + "</p>" + list + "</div>\n";
  }
  return "<details class=\"note\"><summary>" + head + "</summary>" + list + "</details>\n";
}

}  // namespace tagfield
