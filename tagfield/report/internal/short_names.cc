// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/short_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tagfield/report/text.h"

namespace tagfield {
namespace {

/// The numbers of different names that look alike.
using Alike = std::vector<std::size_t>;

std::vector<Alike> look_alikes(const std::vector<std::string>& shown) {
  std::map<std::string, Alike> numbers;
  for (std::size_t i = 0; i < shown.size(); ++i) numbers[shown[i]].push_back(i);
  std::vector<Alike> all;
  for (const auto& [name, alike] : numbers) {
    if (alike.size() > 1) all.push_back(alike);
  }
  return all;
}

/// Number of bytes that all these names begin with, without a part of a character.
std::size_t common_beginning(const std::vector<std::string>& names, const Alike& alike) {
  const std::string& first = names[alike.front()];
  std::size_t common = first.size();
  for (const std::size_t i : alike) {
    const std::string& name = names[i];
    const auto [end, other] = std::mismatch(first.begin(), first.end(), name.begin(), name.end());
    common = std::min(common, static_cast<std::size_t>(end - first.begin()));
  }
  const auto is_inside = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (common > 0 && common < first.size() && is_inside(first[common])) --common;
  return common;
}

}  // namespace

std::vector<std::string> distinct_names(const std::vector<std::string>& names, std::size_t most) {
  std::vector<std::string> whole;
  whole.reserve(names.size());
  for (const std::string& name : names) whole.push_back(clean_text(name));
  std::vector<std::string> shown;
  shown.reserve(whole.size());
  for (const std::string& name : whole) shown.push_back(shortened(name, most));
  for (const Alike& alike : look_alikes(shown)) {
    const std::size_t common = common_beginning(whole, alike);
    for (const std::size_t i : alike) {
      shown[i] = shortened("…" + whole[i].substr(common), most);
    }
  }
  for (const Alike& alike : look_alikes(shown)) {
    for (const std::size_t i : alike) {
      const std::string number = fmt::format("{}: ", i + 1);
      shown[i] = number + shortened(whole[i], most - std::min(number.size(), most - 3));
    }
  }
  return shown;
}

void add_short_name(Svg& svg, const Place& place, const std::string& shown,
                    const std::string& whole, Anchor anchor) {
  const std::string clean = clean_text(whole);
  if (shown == clean) return add_text(svg, place, shown, anchor);
  begin_group(svg, "class=\"short-name\"");
  svg.body += "<title>" + escaped(clean) + "</title>\n";
  add_text(svg, place, shown, anchor);
  end_group(svg);
}

}  // namespace tagfield
