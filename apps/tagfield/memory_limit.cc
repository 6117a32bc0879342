// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/memory_limit.h"

#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tagfield/base/error.h"
#include "tagfield/base/sanitized.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxSystemBytes = 100'000;  // Of system information files.

/// The number at the beginning of a text; none for "max".
std::optional<std::uint64_t> number_in(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return std::nullopt;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data() + begin, text.data() + text.size(), number);
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

std::string text_of(const char* path) {
  try {
    return read_text_file(path, kMaxSystemBytes);
  } catch (const Error&) {
    return {};
  }
}

/// Value of a line "NAME: NUMBER kB" [bytes].
std::uint64_t kilobytes_of(const std::string& text, std::string_view name) {
  const std::size_t begin = text.find(name);
  if (begin == std::string::npos) return 0;
  return 1024 * number_in(std::string_view(text).substr(begin + name.size())).value_or(0);
}

/// Available memory [bytes]; none if unknown.
std::optional<std::uint64_t> left_on_machine() {
  const std::string text = text_of("/proc/meminfo");
  const std::uint64_t available = kilobytes_of(text, "MemAvailable:");
  if (available == 0) return std::nullopt;
  return available + kilobytes_of(text, "SwapFree:");
}

std::optional<std::uint64_t> left_in_container() {
  const auto most = number_in(text_of("/sys/fs/cgroup/memory.max"));
  if (!most) return std::nullopt;
  const std::uint64_t taken = number_in(text_of("/sys/fs/cgroup/memory.current")).value_or(0);
  return *most - std::min(*most, taken);
}

}  // namespace

void limit_memory_to_what_is_left() {
  if constexpr (kSanitized) return;
  std::optional<std::uint64_t> left = left_on_machine();
  const std::optional<std::uint64_t> in_container = left_in_container();
  if (in_container && (!left || *in_container < *left)) left = in_container;
  rlimit limit{};
  if (!left || ::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, *left);
  (void)::setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace tagfield
