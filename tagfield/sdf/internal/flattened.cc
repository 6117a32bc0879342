#include "tagfield/sdf/internal/flattened.h"

#include <algorithm>
#include <string_view>

namespace tagfield::sdf_internal {
namespace {

/// Blanks out [begin, end), but for line ends.
void blank_out(std::string& text, std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t i) { return text.begin() + static_cast<std::ptrdiff_t>(i); };
  std::replace_if(
      at(begin), at(end), [](char c) { return c != '\n'; }, ' ');
}

void blank_out_joints(std::string& text) {
  constexpr std::string_view kEnd = "</joint>";
  for (std::size_t begin = text.find("<joint "); begin != std::string::npos;
       begin = text.find("<joint ", begin + 1)) {
    const std::size_t end = text.find(kEnd, begin);
    if (end == std::string::npos) return;
    blank_out(text, begin, end + kEnd.size());
  }
}

void blank_out_empty_frames(std::string& text) {
  for (const std::string_view attribute :
       {"frame=\"\"", "frame=''", "relative_to=\"\"", "relative_to=''"}) {
    for (std::size_t at = text.find(attribute); at != std::string::npos;
         at = text.find(attribute, at)) {
      blank_out(text, at, at + attribute.size());
    }
  }
}

/// name="a::b" to name="a__b", wherever it stands.
void rename(std::string& text) {
  constexpr std::string_view kName = "name=";
  for (std::size_t at = text.find(kName); at != std::string::npos; at = text.find(kName, at + 1)) {
    const std::size_t begin = at + kName.size();
    if (begin >= text.size() || (text[begin] != '"' && text[begin] != '\'')) continue;
    const std::size_t end = std::min(text.find(text[begin], begin + 1), text.size());
    for (std::size_t colons = text.find("::", begin); colons < end;
         colons = text.find("::", colons)) {
      text[colons] = text[colons + 1] = '_';
    }
  }
}

}  // namespace

std::string without_flattened_names(const std::string& text) {
  std::string mended = text;
  blank_out_joints(mended);
  blank_out_empty_frames(mended);
  rename(mended);
  return mended;
}

}  // namespace tagfield::sdf_internal
