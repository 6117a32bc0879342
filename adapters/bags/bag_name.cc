// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "adapters/bags/bag_recording.h"
#include "adapters/rosbag2/recording_files.h"

namespace tagfield {
namespace {

const std::string kMagic = "#ROSBAG V";

std::string first_bytes(const std::string& path, std::size_t count) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return "";
  std::ifstream file(path, std::ios::binary);
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

}  // namespace

bool is_bag(const std::string& path) {
  const std::filesystem::path name = path;
  const bool named = name.extension() == ".bag" ||
                     (name.extension() == ".active" && name.stem().extension() == ".bag");
  return named || !decompressor_of(path).empty() || is_ros2_recording(path) ||
         first_bytes(path, kMagic.size()) == kMagic;
}

}  // namespace tagfield
