// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether all tags of a markup are properly nested and closed.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace tagfield {

/// The first tag that is not closed or was never opened; "" if there is none. Knows HTML's void
/// elements.
inline std::string unbalanced_tag(const std::string& markup) {
  static const std::set<std::string> without_end = {"meta", "br", "wbr", "!DOCTYPE", "?xml"};
  std::vector<std::string> open;
  for (std::size_t at = markup.find('<'); at != std::string::npos; at = markup.find('<', at + 1)) {
    const std::size_t end = markup.find('>', at);
    if (end == std::string::npos) return "<";
    const std::string tag = markup.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return tag;
      open.pop_back();
    } else if (tag.back() != '/' && without_end.count(name) == 0) {
      open.push_back(name);
      // The content of a script is not markup.
      if (name == "script") at = markup.find("</script>", end) - 1;
    }
  }
  return open.empty() ? "" : open.back();
}

}  // namespace tagfield
