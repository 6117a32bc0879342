// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/store/work_hash.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cstring>
#include <filesystem>
#include <set>
#include <variant>

#include "tagfield/files/files.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

/// FNV-1a, 64 bits, of parts that are each prefixed with their length.
class ContentHash {
 public:
  void add(std::string_view bytes) {
    add(static_cast<std::uint64_t>(bytes.size()));
    add_bytes(bytes.data(), bytes.size());
  }
  void add(std::uint64_t number) { add_bytes(&number, sizeof number); }
  void add(double number) { add_bytes(&number, sizeof number); }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  void add_bytes(const void* data, std::size_t count) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < count; ++i) hash_ = (hash_ ^ byte[i]) * 0x100000001b3U;
  }

  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

template <typename Matrix>
void add_numbers(const Matrix& numbers, ContentHash& hash) {
  for (Eigen::Index i = 0; i < numbers.size(); ++i) hash.add(double{numbers.data()[i]});
}

void add_to_hash(const RigidTransform& transform, ContentHash& hash) {
  add_numbers(transform.translation, hash);
  add_numbers(transform.rotation.coeffs(), hash);
}

/// Adds a shape's parameters.
struct AddShape {
  ContentHash& hash;
  void operator()(const Box& box) const { add_numbers(box.size, hash); }
  void operator()(const Cylinder& cylinder) const {
    hash.add(cylinder.radius);
    hash.add(cylinder.length);
  }
  void operator()(const Sphere& sphere) const { hash.add(sphere.radius); }
  void operator()(const Plane& plane) const { add_numbers(plane.normal, hash); }
  void operator()(const MeshPtr& mesh) const {
    for (const Eigen::Vector3d& vertex : mesh->vertices) add_numbers(vertex, hash);
    for (const auto& corners : mesh->triangles) {
      for (const std::uint32_t corner : corners) hash.add(std::uint64_t{corner});
    }
  }
};

void add_to_hash(const std::vector<Placement>& placements, ContentHash& hash) {
  for (const Placement& placement : placements) {
    hash.add(placement.name);
    add_to_hash(placement.X_WS, hash);
    for (const RawParameter& parameter : placement.parameters) {
      hash.add(parameter.key);
      hash.add(parameter.value);
    }
  }
}

void add_to_hash(const Scene& scene, ContentHash& hash) {
  for (const Collision& collision : scene.collisions) {
    hash.add(collision.name);
    hash.add(static_cast<std::uint64_t>(collision.shape.index()));
    std::visit(AddShape{hash}, collision.shape);
    add_to_hash(collision.X_WC, hash);
    for (const std::string& look : collision.looks) hash.add(look);
  }
  add_to_hash(scene.antennas, hash);
  add_to_hash(scene.tags, hash);
}

/// Adds a file's bytes, or those of all files in a folder; nothing if it does not exist.
void add_file(const fs::path& path, ContentHash& hash) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) {
    hash.add(read_text_file(path.string()));
  } else if (fs::is_directory(path, error)) {
    std::set<fs::path> files;
    fs::recursive_directory_iterator entry(path, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
      std::error_code gone;
      if (entry->is_regular_file(gone)) files.insert(entry->path());
    }
    if (error) fail({path.string(), 0}, "can't be listed: " + error.message());
    for (const fs::path& file : files) add_file(file, hash);
  }
}

/// Adds files named by scalars of a YAML document, relative to `folder`.
void add_named_files(const YAML::Node& node, const fs::path& folder, int level, ContentHash& hash) {
  constexpr int kMaxLevels = 100;
  if (level > kMaxLevels) return;
  if (node.IsScalar()) {
    std::error_code error;
    const fs::path path = folder / node.Scalar();
    if (!node.Scalar().empty() && fs::is_regular_file(path, error)) add_file(path, hash);
  } else if (node.IsSequence() || node.IsMap()) {
    for (const auto& entry : node) {
      add_named_files(node.IsMap() ? entry.second : entry, folder, level + 1, hash);
    }
  }
}

void add_overrides(const std::vector<Override>& overrides, ContentHash& hash) {
  for (const auto& [key, value] : overrides) {
    hash.add(key);
    hash.add(value);
    std::error_code error;
    if (!value.empty() && fs::is_regular_file(value, error)) add_file(value, hash);
  }
}

/// Adds the scenario's file, and the files that it names.
void add_scenario(const std::string& path, ContentHash& hash) {
  hash.add(read_text_file(path));
  add_named_files(read_yaml(path), fs::path(path).parent_path(), 0, hash);
}

void add_world(const std::string& path, std::vector<Override> overrides, const WorldOptions& world,
               ContentHash& hash) {
  // Localization settings don't affect the world, and may belong to a method that is unknown here.
  std::erase_if(overrides, [](const Override& setting) {
    return setting.first.rfind("localization", 0) == 0;
  });
  Diagnostics unheard;
  add_to_hash(load_scenario_with_world(path, overrides, unheard, world).scene, hash);
}

void add_recording(const SuiteRecording& recording, ContentHash& hash) {
  for (const std::string& path :
       {recording.reads, recording.format, recording.poses, recording.truth, recording.heights}) {
    hash.add(path.empty() ? std::string_view("") : "file");
    if (!path.empty()) add_file(path, hash);
  }
}

}  // namespace

std::string work_hash(const std::string& suite_text, const Suite& suite,
                      const std::vector<std::string>& words) {
  ContentHash hash;
  hash.add(suite_text);
  for (const std::string& word : words) hash.add(word);
  std::set<std::string> scenarios;
  std::set<std::string> files;
  for (const Condition& condition : suite.conditions) {
    if (condition.recording) {
      add_recording(*condition.recording, hash);
    } else if (scenarios.insert(condition.scenario).second) {
      add_scenario(condition.scenario, hash);
      add_world(condition.scenario, condition.settings, condition.world, hash);
    }
    for (const Override& setting : condition.settings) {
      if (files.insert(setting.second).second) add_overrides({setting}, hash);
    }
  }
  return hash.text();
}

std::string work_hash(const std::string& scenario_path, const std::vector<Override>& overrides,
                      const Scene& scene, const std::vector<std::string>& words) {
  ContentHash hash;
  add_scenario(scenario_path, hash);
  add_overrides(overrides, hash);
  for (const std::string& word : words) hash.add(word);
  add_to_hash(scene, hash);
  return hash.text();
}

}  // namespace tagfield
