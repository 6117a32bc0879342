// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/command_method.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

#include "tagfield/base/file_kind.h"
#include "tagfield/files/files.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/files/tag_positions_csv.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/report/estimates_csv.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

/// A temporary folder that the destructor deletes.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "tagfield-method-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw Error(fmt::format("'{}' can't be made: {}", name, std::strerror(errno)));
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Reads in chronological order. Phases with π ambiguity are in [0, π).
std::vector<TagRead> reads_of(const LocalizationProblem& problem) {
  std::vector<TagRead> reads;
  for (const auto& [tag, samples] : problem.samples) {
    for (const auto& [antenna, series] : samples) {
      for (const PhaseSample& sample : series) {
        reads.push_back({sample.stamp, "", antenna, tag, sample.frequency_hz / problem.multiple(),
                         sample.phase_rad / problem.multiple(), sample.rssi_dbm});
      }
    }
  }
  std::stable_sort(reads.begin(), reads.end(),
                   [](const TagRead& a, const TagRead& b) { return a.stamp < b.stamp; });
  return reads;
}

std::vector<AntennaPose> poses_of(const LocalizationProblem& problem) {
  std::vector<AntennaPose> poses;
  for (const auto& [antenna, track] : problem.tracks) {
    for (std::size_t i = 0; i < track.X_WA.size(); ++i) {
      AntennaPose pose{track.X_WA[i].stamp, antenna, track.X_WA[i].X_WB};
      if (!track.covariance.empty()) pose.covariance = track.covariance[i];
      poses.push_back(pose);
    }
  }
  return poses;
}

std::map<std::string, double> heights_of(const LocalizationProblem& problem) {
  std::map<std::string, double> heights;
  for (const auto& [tag, samples] : problem.samples) {
    const auto known = problem.heights.of_tag.find(tag);
    if (known != problem.heights.of_tag.end()) {
      heights[tag] = known->second;
    } else if (problem.heights.of_all) {
      heights[tag] = *problem.heights.of_all;
    }
  }
  return heights;
}

void write_problem(const LocalizationProblem& problem, const fs::path& folder) {
  write_text_file((folder / "reads.csv").string(), reads_to_csv(reads_of(problem)));
  write_text_file((folder / "antenna_poses.csv").string(), poses_to_csv(poses_of(problem)));
  const auto heights = heights_of(problem);
  if (!heights.empty()) {
    write_text_file((folder / "tag_heights.csv").string(), tag_heights_to_csv(heights));
  }
  if (!problem.reference_tags.empty()) {
    write_text_file((folder / "reference_tags.csv").string(),
                    tag_positions_to_csv(problem.reference_tags));
  }
}

/// Runs the program with its output in `log`; returns waitpid()'s status.
int run_program(const std::string& command, const std::string& folder, const std::string& log) {
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0600);
  ::posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  std::string words[] = {"sh", "-c", command + " \"$1\"", "sh", folder};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(),
                       words[3].data(), words[4].data(), nullptr};
  pid_t program = 0;
  const int fault = ::posix_spawn(&program, "/bin/sh", &files, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&files);
  if (fault != 0)
    throw Error(fmt::format("the command can't be started: {}", std::strerror(fault)));
  int status = 0;
  while (::waitpid(program, &status, 0) < 0) {
    if (errno != EINTR) throw Error(fmt::format("the command was lost: {}", std::strerror(errno)));
  }
  return status;
}

/// ": " and the last non-empty line of the log, or nothing.
std::string last_line(const fs::path& log) {
  constexpr std::size_t kMaxLog = 1U << 26U;
  std::string text = is_there(log) ? read_text_file(log.string(), kMaxLog) : "";
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  const std::size_t begin = text.rfind('\n');
  if (begin != std::string::npos) text.erase(0, begin + 1);
  return text.empty() ? "" : ": " + text;
}

void run_command(const std::string& command, const fs::path& folder) {
  const fs::path log = folder / "output.txt";
  const int status = run_program(command, folder.string(), log.string());
  if (WIFSIGNALED(status)) {
    throw Error(
        fmt::format("the command was ended by signal {}{}", WTERMSIG(status), last_line(log)));
  }
  if (WEXITSTATUS(status) != 0) {
    throw Error(
        fmt::format("the command ended with code {}{}", WEXITSTATUS(status), last_line(log)));
  }
  if (!is_there(folder / "estimates.csv")) {
    throw Error(fmt::format(
        "the command wrote no estimates.csv into the folder that it was given{}", last_line(log)));
  }
}

/// The tags that a program may have heard of.
std::set<std::string> tags_of(const LocalizationProblem& problem) {
  std::set<std::string> tags;
  for (const auto& [tag, samples] : problem.samples) tags.insert(tag);
  for (const auto& [tag, place] : problem.reference_tags) tags.insert(tag);
  return tags;
}

/// The program's estimates for the problem's tags.
std::map<std::string, TagEstimate> estimates_in(const LocalizationProblem& problem,
                                                const std::string& name, const fs::path& folder,
                                                Diagnostics& diagnostics) {
  const fs::path file = folder / "estimates.csv";
  std::map<std::string, TagEstimate> estimates;
  const auto height = [&](const std::string& tag) {
    return problem.samples.count(tag) > 0 ? plane_height(problem, tag) : 0.0;
  };
  try {
    std::vector<TagEstimate> all = read_estimates_csv(file.string(), height);
    drop_strangers({fmt::format("method '{}': estimates.csv", name), 0}, "the reads have",
                   tags_of(problem), all, diagnostics);
    for (TagEstimate& estimate : all) estimates[estimate.tag] = std::move(estimate);
  } catch (const Error& error) {
    std::string said = error.what();
    if (said.rfind(folder.string(), 0) == 0) said.erase(0, folder.string().size() + 1);
    throw Error(said);
  }
  return estimates;
}

std::vector<TagEstimate> locate(const std::string& name, const std::string& command,
                                const LocalizationProblem& problem, Diagnostics& diagnostics) {
  const TemporaryFolder folder;
  write_problem(problem, folder.path());
  run_command(command, folder.path());
  std::map<std::string, TagEstimate> found =
      estimates_in(problem, name, folder.path(), diagnostics);
  std::vector<TagEstimate> estimates;
  for (const auto& [tag, samples] : problem.samples) {
    const auto reference = problem.reference_tags.find(tag);
    const auto of_tag = found.find(tag);
    if (reference != problem.reference_tags.end()) {
      estimates.push_back(reference_estimate(tag, reference->second));
    } else if (of_tag == found.end()) {
      estimates.push_back(not_located(begun(tag, samples), "the command gave no position"));
    } else {
      of_tag->second.reads = count_reads(samples);
      estimates.push_back(std::move(of_tag->second));
    }
  }
  return estimates;
}

}  // namespace

Method command_method(const std::string& name, const std::string& command) {
  const auto is_plain = [](unsigned char character) {
    return std::isalnum(character) != 0 || character == '_' || character == '-' || character == '.';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_plain)) {
    throw Error(fmt::format(
        "method '{}': a command's name must consist of letters, digits, '_', '-' and '.'", name));
  }
  Method method;
  method.name = name;
  method.summary = command;
  method.locate = [name, command](const LocalizationProblem& problem, int /*threads*/,
                                  Diagnostics& diagnostics) {
    LocalizationResult result;
    result.method = name;
    try {
      result.estimates = locate(name, command, problem, diagnostics);
    } catch (const Error& error) {
      throw Error(fmt::format("method '{}': {}", name, error.what()));
    }
    return result;
  };
  return method;
}

}  // namespace tagfield
