// SPDX-License-Identifier: Apache-2.0
// Replaces bag_recording.cc in programs that load the bag reader at run time.
#include <filesystem>

#include "adapters/bags/bag_reader.h"
#include "tagfield/base/loaded_library.h"

namespace tagfield {
namespace {

/// Path of the reader relative to the program, as built or as installed.
std::string reader_file() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "lib/tagfield/rosbag.so";
}

struct BagReader : LoadedLibrary {
  BagReader() : LoadedLibrary("Recordings of ROS", reader_file()) {}
  decltype(&tagfield_read_bag) read = function("tagfield_read_bag");
};

}  // namespace

BagRecording read_bag(const std::string& path, const BagOptions& options,
                      Diagnostics& diagnostics) {
  static const BagReader reader;
  BagRecording recording;
  reader.read(path, options, diagnostics, recording);
  return recording;
}

}  // namespace tagfield
