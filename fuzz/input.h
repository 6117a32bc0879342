// SPDX-License-Identifier: Apache-2.0
/// @file
/// Shared by the fuzzers: an input as a file, and which exceptions are acceptable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tagfield/base/error.h"

/// libFuzzer's entry point, defined by each fuzz target.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace tagfield::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};  // NOLINT: bytes as text.
}

/// A temporary folder of this process, deleted with it.
class InputFolder {
 public:
  InputFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tagfield-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw Error(name + ": can't be made");
    path_ = name;
  }
  ~InputFolder() {
    std::error_code unheard;
    std::filesystem::remove_all(path_, unheard);
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  /// Writes `text` to a file and returns its path.
  std::string write(const std::string& name, std::string_view text) const {
    const std::string path = path_ + "/" + name;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    return path;
  }

 private:
  std::string path_;
};

inline const InputFolder& folder() {
  static const InputFolder one;
  return one;
}

/// Only Error may be thrown: anything else ends the process, and is a finding.
template <class Use>
int refused_or_taken(const Use& use) {
  try {
    use();
  } catch (const Error& error) {
    const std::string_view line = error.what();
    if (line.empty() || line.find('\n') != std::string_view::npos) std::abort();  // One line.
  }
  return 0;
}

}  // namespace tagfield::fuzz
