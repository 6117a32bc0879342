#include <algorithm>
#include <filesystem>
#include <fstream>

#include "adapters/ros1/bag_recording.h"

namespace tagfield {
namespace {

constexpr const char* kMagic = "#ROSBAG V";

std::string first_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(std::char_traits<char>::length(kMagic), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

}  // namespace

bool is_bag(const std::string& path) {
  const std::filesystem::path name = path;
  const bool named = name.extension() == ".bag" ||
                     (name.extension() == ".active" && name.stem().extension() == ".bag");
  std::error_code error;
  return named || (std::filesystem::is_regular_file(name, error) && first_bytes(path) == kMagic);
}

}  // namespace tagfield
