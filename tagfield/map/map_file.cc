// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/map_file.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "tagfield/base/number.h"
#include "tagfield/base/spelling.h"
#include "tagfield/files/files.h"
#include "tagfield/map/internal/pgm.h"

namespace tagfield {
namespace {

// Values written by map_saver; 205 of 255 is between the two thresholds.
constexpr char kFreeGrey = static_cast<char>(254);
constexpr char kOccupiedGrey = 0;
constexpr char kUnknownGrey = static_cast<char>(205);
constexpr double kOccupiedThreshold = 0.65;
constexpr double kFreeThreshold = 0.196;

constexpr std::uintmax_t kMaxYamlBytes = 1'000'000;
constexpr std::uintmax_t kMaxImageBytes = 2'000'000'000;
constexpr double kMaxResolution = 1000.0;  // [m]
constexpr double kMaxOrigin = 1e9;         // [m]

enum class Mode { kTrinary, kScale, kRaw };

/// Contents of the YAML file.
struct MapFrame {
  std::string image;
  double resolution_m = 0.0;
  Eigen::Vector2d origin;
  bool negate = false;
  double occupied_threshold = 0.0;
  double free_threshold = 0.0;
  Mode mode = Mode::kTrinary;
};

/// Keys of the YAML file, each unique.
class MapYaml {
 public:
  MapYaml(const std::string& text, const std::string& file) : file_(file) {
    try {
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      fail({file_, error.mark.line + 1}, "is not YAML: " + error.msg);
    }
    if (!root_.IsMap()) fail({file_, 1}, "is not a map's YAML: expected 'image: …' and so on");
    for (const auto& entry : root_) add(entry.first, entry.second);
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& message) const {
    fail({file_, line_of(entries_.at(key))}, fmt::format("{} {}", key, message));
  }

  [[nodiscard]] bool has(const std::string& key) const { return entries_.count(key) > 0; }

  [[nodiscard]] std::string text(const std::string& key) const {
    const YAML::Node node = at(key);
    if (!node.IsScalar() || node.Scalar().empty()) refuse(key, "must be a text that is not empty");
    return node.Scalar();
  }

  [[nodiscard]] double number(const std::string& key, double least, double most) const {
    return number(key, at(key), least, most);
  }

  [[nodiscard]] std::array<double, 3> origin() const {
    const YAML::Node node = at("origin");
    if (!node.IsSequence() || node.size() != 3) refuse("origin", "must be [x, y, yaw]");
    std::array<double, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
      numbers.at(i) = number("origin", node[i], -kMaxOrigin, kMaxOrigin);
    }
    return numbers;
  }

  [[nodiscard]] bool flag(const std::string& key) const {
    const std::string word = text(key);
    if (word != "0" && word != "1" && word != "true" && word != "false") {
      refuse(key, fmt::format("must be 0 or 1, is '{}'", word));
    }
    return word == "1" || word == "true";
  }

  void warn_of_strangers(const std::vector<std::string>& known, Diagnostics& diagnostics) const {
    for (const auto& [key, node] : entries_) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      diagnostics.warn({file_, line_of(node)},
                       fmt::format("unknown key '{}'{}", key, suggestion(key, known)));
    }
  }

 private:
  static int line_of(const YAML::Node& node) {
    return node.Mark().is_null() ? 0 : node.Mark().line + 1;
  }

  void add(const YAML::Node& key, const YAML::Node& value) {
    if (!key.IsScalar()) fail({file_, line_of(key)}, "a key is not a word");
    if (!entries_.emplace(key.Scalar(), value).second) {
      fail({file_, line_of(key)}, fmt::format("has '{}' twice", key.Scalar()));
    }
  }

  [[nodiscard]] YAML::Node at(const std::string& key) const {
    const auto found = entries_.find(key);
    if (found == entries_.end()) fail({file_, 0}, fmt::format("has no '{}'", key));
    return found->second;
  }

  [[nodiscard]] double number(const std::string& key, const YAML::Node& node, double least,
                              double most) const {
    const auto number = node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
    if (!number) refuse(key, "must be a number");
    if (*number < least || *number > most) {
      refuse(key, fmt::format("must be {} to {}, is {}", least, most, *number));
    }
    return *number;
  }

  std::string file_;
  YAML::Node root_;
  std::map<std::string, YAML::Node> entries_;
};

Mode mode_of(const MapYaml& yaml) {
  if (!yaml.has("mode")) return Mode::kTrinary;
  const std::string word = yaml.text("mode");
  if (word == "trinary") return Mode::kTrinary;
  if (word == "scale") return Mode::kScale;
  if (word != "raw") yaml.refuse("mode", fmt::format("'{}' is not trinary, scale or raw", word));
  return Mode::kRaw;
}

void read_thresholds(const MapYaml& yaml, MapFrame& frame) {
  frame.occupied_threshold = yaml.number("occupied_thresh", 0.0, 1.0);
  frame.free_threshold = yaml.number("free_thresh", 0.0, 1.0);
  if (frame.free_threshold >= frame.occupied_threshold) {
    yaml.refuse("free_thresh", fmt::format("must be less than occupied_thresh ({}), is {}",
                                           frame.occupied_threshold, frame.free_threshold));
  }
}

MapFrame frame_from(const MapYaml& yaml) {
  MapFrame frame;
  frame.image = yaml.text("image");
  frame.resolution_m = yaml.number("resolution", 0.0, kMaxResolution);
  if (frame.resolution_m < 1e-6) yaml.refuse("resolution", "must be greater than 0 [m]");
  const auto [x, y, yaw] = yaml.origin();
  if (yaw != 0.0) yaml.refuse("origin", fmt::format("has a yaw of {}, but must have 0", yaw));
  frame.origin = {x, y};
  frame.negate = yaml.flag("negate");
  read_thresholds(yaml, frame);
  frame.mode = mode_of(yaml);
  return frame;
}

/// Cell from a grey value as a share of white; see docs/map.md.
std::int8_t cell_from(double lightness, const MapFrame& frame) {
  if (frame.negate) lightness = 1.0 - lightness;
  if (frame.mode == Mode::kRaw) {
    const double value = std::round(255.0 * lightness);
    return static_cast<std::int8_t>(value <= 100.0 ? value : -1.0);
  }
  const double occupied = 1.0 - lightness;
  if (occupied > frame.occupied_threshold) return 100;
  if (occupied < frame.free_threshold) return 0;
  if (frame.mode == Mode::kTrinary) return -1;
  const double share =
      (occupied - frame.free_threshold) / (frame.occupied_threshold - frame.free_threshold);
  return static_cast<std::int8_t>(1.0 + 98.0 * share);
}

OccupancyGrid grid_from(const GreyImage& image, const MapFrame& frame) {
  std::vector<std::int8_t> cell_of_grey;
  for (int grey = 0; grey <= image.white; ++grey) {
    cell_of_grey.push_back(cell_from(static_cast<double>(grey) / image.white, frame));
  }
  OccupancyGrid grid{frame.resolution_m, image.width, image.height, frame.origin, {}};
  grid.cells.resize(image.greys.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const std::uint16_t grey = image.greys[grid.index(x, grid.height - 1 - y)];
      grid.cells[grid.index(x, y)] = cell_of_grey[grey];
    }
  }
  return grid;
}

char grey_of(std::int8_t cell) {
  if (is_free(cell)) return kFreeGrey;
  return is_occupied(cell) ? kOccupiedGrey : kUnknownGrey;
}

}  // namespace

std::string map_to_pgm(const OccupancyGrid& grid) {
  std::string bytes =
      fmt::format("P5\n# {} m a cell\n{} {}\n255\n", grid.resolution_m, grid.width, grid.height);
  for (int y = grid.height - 1; y >= 0; --y) {
    for (int x = 0; x < grid.width; ++x) bytes.push_back(grey_of(grid.cells[grid.index(x, y)]));
  }
  return bytes;
}

std::string map_to_yaml(const OccupancyGrid& grid, const std::string& image) {
  YAML::Emitter quoted;
  quoted << YAML::DoubleQuoted << image;
  return fmt::format(
      "image: {}\nresolution: {}\norigin: [{}, {}, 0.0]\nnegate: 0\noccupied_thresh: {}\n"
      "free_thresh: {}\n",
      quoted.c_str(), grid.resolution_m, grid.origin.x(), grid.origin.y(), kOccupiedThreshold,
      kFreeThreshold);
}

OccupancyGrid read_map(const std::string& yaml_path, Diagnostics& diagnostics) {
  const std::string text = read_text_file(yaml_path, kMaxYamlBytes);
  if (text.empty()) fail({yaml_path, 0}, "the file is empty");
  const MapYaml yaml(text, yaml_path);
  yaml.warn_of_strangers(
      {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"},
      diagnostics);
  const MapFrame frame = frame_from(yaml);
  const auto image_path = (std::filesystem::path(yaml_path).parent_path() / frame.image).string();
  return grid_from(read_pgm(read_text_file(image_path, kMaxImageBytes), image_path), frame);
}

}  // namespace tagfield
