// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/sweep_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tagfield/base/file_kind.h"
#include "tagfield/files/files.h"
#include "tagfield/files/folder_entries.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSourceFile = "sweep.json";
constexpr const char* kRungsFile = "rungs.json";
constexpr std::size_t kMaxSourceBytes = 64'000'000;

std::string path_in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "host";
  return name.data();
}

/// Writes a file under a name unique to this process, across machines, and moves it into place.
void publish(const std::string& path, const std::string& text) {
  const std::string own = fmt::format("{}.{}.{}", path, host_name(), ::getpid());
  write_text_file(own, text);
  std::error_code error;
  fs::rename(own, path, error);
  if (error) fail({path, 0}, fmt::format("can't be written: {}", error.message()));
}

nlohmann::ordered_json read_json_of(const std::string& path) {
  auto json = nlohmann::ordered_json::parse(read_text_file(path, kMaxSourceBytes), nullptr, false);
  if (!json.is_object()) fail({path, 0}, "is damaged: it is not a JSON object");
  return json;
}

/// The positive integer that makes up the whole text; none if it is not one.
std::optional<std::size_t> positive_in(std::string_view text) {
  std::size_t number = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ec != std::errc{} || result.ptr != end || number == 0) return std::nullopt;
  return number;
}

std::string folder_of_shards(std::size_t count) { return fmt::format("of_{}", count); }

void add_logs(const fs::path& folder, std::vector<std::string>& logs) {
  for (const fs::path& entry : entries_of(folder)) {
    if (entry.extension() == ".log") logs.push_back(entry.string());
  }
}

std::vector<std::string> logs_without(const std::string& folder, const std::string& left_out) {
  std::vector<std::string> logs;
  for (const fs::path& group : entries_of(path_in(folder, "shards"))) {
    if (group.filename() != left_out) add_logs(group, logs);
  }
  std::sort(logs.begin(), logs.end());
  return logs;
}

}  // namespace

void claim_sweep_folder(const std::string& folder, const SweepSource& source) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail({folder, 0}, fmt::format("can't be made: {}", error.message()));
  const std::string path = path_in(folder, kSourceFile);
  if (!is_there(path)) {
    const nlohmann::ordered_json json = {{"tagfield", source.head.program},
                                         {"work", source.head.work},
                                         {"suite", source.suite},
                                         {"text", source.text}};
    publish(path, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  const LogHead found = read_sweep_source(folder).head;
  if (found == source.head) return;
  if (found.program != source.head.program) {
    fail({folder, 0}, fmt::format("holds a sweep by tagfield {}, and this is {}: give another "
                                  "--out, or continue with that version",
                                  found.program, source.head.program));
  }
  fail({folder, 0}, fmt::format("holds the sweep of another suite, or of one whose files were "
                                "changed since (its hash is {}, this one's {}): give another --out",
                                found.work, source.head.work));
}

SweepSource read_sweep_source(const std::string& folder) {
  const std::string path = path_in(folder, kSourceFile);
  if (!is_there(path)) fail({folder, 0}, "is not the folder of a sweep: it has no sweep.json");
  const nlohmann::ordered_json json = read_json_of(path);
  try {
    return {{json.at("tagfield").get<std::string>(), json.at("work").get<std::string>()},
            json.at("suite").get<std::string>(),
            json.at("text").get<std::string>()};
  } catch (const nlohmann::json::exception&) {
    fail({path, 0}, "is damaged: it lacks 'tagfield', 'work', 'suite' or 'text'");
  }
}

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto index = positive_in(std::string_view(text).substr(0, slash));
    const auto count = positive_in(std::string_view(text).substr(slash + 1));
    if (index && count && *index <= *count) return {*index, *count};
  }
  throw Error(fmt::format("--shard is '{}', expected I/N with I from 1 to N, such as 3/8", text));
}

std::string shard_log(const std::string& folder, const Shard& shard) {
  return path_in(folder,
                 fmt::format("shards/{}/{}.log", folder_of_shards(shard.count), shard.index));
}

std::string rank_log(const std::string& folder, const Shard& rank) {
  return path_in(folder, fmt::format("shards/mpi_of_{}/{}.log", rank.count, rank.index));
}

std::string new_log_of_runs_again(const std::string& folder) {
  for (std::size_t i = 1;; ++i) {
    std::string path = path_in(folder, fmt::format("shards/again/{}.log", i));
    if (!is_there(path)) return path;
  }
}

std::vector<std::string> all_logs(const std::string& folder) { return logs_without(folder, ""); }

std::vector<std::string> logs_for(const std::string& folder, const Shard& shard) {
  std::vector<std::string> logs = logs_without(folder, folder_of_shards(shard.count));
  const std::string own = shard_log(folder, shard);
  if (is_there(own)) logs.push_back(own);
  return logs;
}

ClosedRungs read_closed_rungs(const std::string& folder, const LogHead& head) {
  const std::string path = path_in(folder, kRungsFile);
  if (!is_there(path)) return {};
  const nlohmann::ordered_json json = read_json_of(path);
  try {
    if (json.at("work").get<std::string>() != head.work) fail({path, 0}, "is of another sweep");
    return {json.at("survivors").get<std::vector<std::vector<std::uint64_t>>>()};
  } catch (const nlohmann::json::exception&) {
    fail({path, 0}, "is damaged: expected 'work' and 'survivors'");
  }
}

void write_closed_rungs(const std::string& folder, const LogHead& head, const ClosedRungs& closed) {
  const nlohmann::ordered_json json = {{"work", head.work}, {"survivors", closed.survivors}};
  publish(path_in(folder, kRungsFile), json.dump() + "\n");
}

}  // namespace tagfield
