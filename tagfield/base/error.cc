#include "tagfield/base/error.h"

#include <algorithm>

namespace tagfield {
namespace {

std::string prefixed(const Location& location, const std::string& message) {
  const std::string place = to_string(location);
  return place.empty() ? message : place + ": " + message;
}

}  // namespace

std::string to_string(const Location& location) {
  if (location.file.empty() || location.line <= 0) return location.file;
  return location.file + ":" + std::to_string(location.line);
}

void fail(const Location& location, const std::string& message) {
  throw Error(prefixed(location, message));
}

void Diagnostics::warn(const std::string& message) {
  if (std::find(warnings_.begin(), warnings_.end(), message) == warnings_.end()) {
    warnings_.push_back(message);
  }
}

void Diagnostics::warn(const Location& location, const std::string& message) {
  warn(prefixed(location, message));
}

}  // namespace tagfield
