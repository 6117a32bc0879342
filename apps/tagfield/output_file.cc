// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/output_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

/// Room for the comments before a world's first element.
constexpr std::size_t kBeginning = 65536;

std::string beginning_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kBeginning, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

bool is_of_kind(const OutputFile& output) {
  const std::string text = beginning_of(output.path);
  return text.empty() ||
         std::any_of(output.marks.begin(), output.marks.end(), [&text](const std::string& mark) {
           return text.find(mark) != std::string::npos;
         });
}

}  // namespace

OutputFile mcap_output(const std::string& path) {
  return {"--mcap", path, "an MCAP file", {"\x89MCAP"}};
}

void add_force_option(CLI::App& command, bool& force) {
  command.add_flag("--force", force, "Replace an existing file of another kind");
}

void require_replaceable(const OutputFile& output, const std::vector<std::string>& inputs,
                         bool force) {
  std::error_code error;
  // Nothing is lost in a device or pipe; writing to a folder fails.
  if (output.path.empty() || !fs::is_regular_file(output.path, error)) return;
  for (const std::string& input : inputs) {
    const fs::path file = is_folder(input) ? fs::path(input) / "reads.csv" : fs::path(input);
    if (!fs::equivalent(file, output.path, error)) continue;
    throw Error(fmt::format("{} {}: would replace an input of this command, expected another file",
                            output.option, output.path));
  }
  if (force || is_of_kind(output)) return;
  throw Error(
      fmt::format("{} {}: exists and is not {}: give another file, or --force to replace it",
                  output.option, output.path, output.kind));
}

}  // namespace tagfield
