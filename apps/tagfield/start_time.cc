// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/start_time.h"

#include <fmt/format.h>

#include "tagfield/base/error.h"
#include "tagfield/base/utc.h"

namespace tagfield {
namespace {

// Neither a simulation nor a clock that starts with its reader reaches 31 years.
constexpr Time kUnixTime(std::chrono::seconds(1'000'000'000));

}  // namespace

void add_start_option(CLI::App& command, std::string& start) {
  command.add_option("--start", start,
                     "Date and time at stamp 0, by default 2020-01-01T00:00:00Z; stamps that are "
                     "Unix time are taken as such");
}

Time start_time(const std::string& command, const std::string& start, Time first_stamp) {
  if (start.empty()) return first_stamp > kUnixTime ? Time{} : utc_from_text("2020-01-01");
  try {
    return utc_from_text(start);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: --start: {}", command, error.what()));
  }
}

}  // namespace tagfield
