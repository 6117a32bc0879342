// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include "tagfield/sdf/internal/collada.h"

namespace tagfield {
namespace {

/// More than any mesh of a world needs; larger files are refused instead of filling the memory.
constexpr std::uintmax_t kMaxFileBytes = 1'000'000'000;
constexpr std::size_t kMaxTriangles = 20'000'000;

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  fail({path, 0}, message);
}

/// Assimp's messages may contain line breaks.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

void require_readable(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse(path, "no such mesh file");
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error) refuse(path, "can't be read: " + error.message());
  if (bytes > kMaxFileBytes) refuse(path, "mesh file is larger than 1 GB");
}

const aiScene* read_file(Assimp::Importer& importer, const std::string& path) {
  constexpr unsigned kSteps =
      aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_ValidateDataStructure;
  if (!is_collada(path)) return importer.ReadFile(path, kSteps);
  const std::string geometry = collada_geometry(path);
  return importer.ReadFileFromMemory(geometry.data(), geometry.size(), kSteps, "dae");
}

const aiScene& import_file(Assimp::Importer& importer, const std::string& path) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = read_file(importer, path);
  if (scene == nullptr) {
    refuse(path, "can't be read as a mesh: " + on_one_line(importer.GetErrorString()));
  }
  if (scene->mRootNode == nullptr) refuse(path, "holds no mesh");
  return *scene;
}

Eigen::Affine3d to_eigen(const aiMatrix4x4& matrix) {
  Eigen::Affine3d transform;
  transform.matrix() << matrix.a1, matrix.a2, matrix.a3, matrix.a4, matrix.b1, matrix.b2, matrix.b3,
      matrix.b4, matrix.c1, matrix.c2, matrix.c3, matrix.c4, 0.0, 0.0, 0.0, 1.0;
  return transform;
}

/// Collects the triangles of the nodes it visits, merging vertices with equal coordinates.
class MeshGatherer {
 public:
  MeshGatherer(const aiScene& scene, const std::string& path, const std::string& submesh)
      : scene_(scene), path_(path), submesh_(submesh) {}

  void walk(const aiNode& node, const Eigen::Affine3d& X_FP) {
    const Eigen::Affine3d X_FN = X_FP * to_eigen(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& part = *scene_.mMeshes[node.mMeshes[i]];
      if (is_wanted(node, part)) add_part(part, X_FN);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], X_FN);
  }

  [[nodiscard]] MeshFile result() const { return {mesh_, {materials_.begin(), materials_.end()}}; }
  [[nodiscard]] const std::set<std::string>& parts() const { return parts_; }

 private:
  /// In Gazebo, a part of a Collada file is named after its node, a part of an OBJ file after its
  /// group.
  bool is_wanted(const aiNode& node, const aiMesh& part) {
    parts_.insert(node.mName.C_Str());
    return submesh_.empty() || submesh_ == node.mName.C_Str() || submesh_ == part.mName.C_Str();
  }

  void add_part(const aiMesh& part, const Eigen::Affine3d& X_FN) {
    if (mesh_.triangles.size() + part.mNumFaces > kMaxTriangles) {
      refuse(path_, "mesh has more than 20 million triangles");
    }
    std::vector<std::uint32_t> indices;
    indices.reserve(part.mNumVertices);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& p = part.mVertices[i];
      indices.push_back(index_of(X_FN * Eigen::Vector3d(p.x, p.y, p.z)));
    }
    add_faces(part, indices, X_FN.linear().determinant() < 0.0);
    add_material(part);
  }

  /// A mirroring transform turns faces inside out, so the order of vertices is reversed.
  void add_faces(const aiMesh& part, const std::vector<std::uint32_t>& indices, bool mirrored) {
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;
      const std::array<std::uint32_t, 3> corners = {
          indices[face.mIndices[0]], indices[face.mIndices[1]], indices[face.mIndices[2]]};
      mesh_.triangles.push_back(
          mirrored ? std::array<std::uint32_t, 3>{corners[0], corners[2], corners[1]} : corners);
    }
  }

  std::uint32_t index_of(const Eigen::Vector3d& p) {
    if (!p.allFinite()) refuse(path_, "mesh has a vertex that is not finite");
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [entry, is_new] = index_of_place_.try_emplace({p.x(), p.y(), p.z()}, next);
    if (is_new) mesh_.vertices.push_back(p);
    return entry->second;
  }

  void add_material(const aiMesh& part) {
    if (part.mMaterialIndex >= scene_.mNumMaterials) return;
    aiString name;
    scene_.mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
    const std::string text = name.C_Str();
    // Assimp gives a part without a material one of its own, which is not in the file.
    if (!text.empty() && text != AI_DEFAULT_MATERIAL_NAME) materials_.insert(text);
  }

  const aiScene& scene_;
  const std::string& path_;
  const std::string& submesh_;
  TriangleMesh mesh_;
  std::set<std::string> materials_;
  std::set<std::string> parts_;
  std::map<std::array<double, 3>, std::uint32_t> index_of_place_;
};

void apply_scale(TriangleMesh& mesh, const Eigen::Vector3d& scale) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = vertex.cwiseProduct(scale);
  if (scale.prod() >= 0.0) return;
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

void move_to_centre(TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex -= bounds.center();
}

void require_triangles(const MeshGatherer& gatherer, const MeshFile& file, const std::string& path,
                       const std::string& submesh) {
  if (!file.mesh.triangles.empty()) return;
  if (submesh.empty()) refuse(path, "mesh has no triangles");
  std::string known;
  for (const std::string& part : gatherer.parts()) known += (known.empty() ? "" : ", ") + part;
  refuse(path, "mesh has no part '" + submesh + "' with triangles (parts: " + known + ")");
}

void require_finite(const TriangleMesh& mesh, const std::string& path) {
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    if (!vertex.allFinite()) refuse(path, "mesh has a vertex that is not finite once scaled");
  }
}

MeshFile read_here(const std::string& path, const Eigen::Vector3d& scale,
                   const std::string& submesh, bool center) {
  Assimp::Importer importer;
  const aiScene& scene = import_file(importer, path);
  MeshGatherer gatherer(scene, path, submesh);
  gatherer.walk(*scene.mRootNode, Eigen::Affine3d::Identity());
  MeshFile file = gatherer.result();
  require_triangles(gatherer, file, path, submesh);
  apply_scale(file.mesh, scale);
  if (center) move_to_centre(file.mesh);
  require_finite(file.mesh, path);
  return file;
}

/// Rows, preceded by their number.
template <typename Row>
void append(const Row* rows, std::uint64_t count, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
  bytes.append(reinterpret_cast<const char*>(rows), count * sizeof(Row));
}

template <typename Rows>
Rows take(std::string_view& bytes) {
  using Row = typename Rows::value_type;
  std::uint64_t count = 0;
  if (bytes.size() < sizeof(count)) throw Error("a mesh is cut off");
  std::memcpy(&count, bytes.data(), sizeof(count));
  bytes.remove_prefix(sizeof(count));
  if (count > bytes.size() / sizeof(Row)) throw Error("a mesh is cut off");
  Rows rows;
  rows.resize(count);
  std::memcpy(static_cast<void*>(rows.data()), bytes.data(), count * sizeof(Row));
  bytes.remove_prefix(count * sizeof(Row));
  return rows;
}

void append(const std::string& text, std::string& bytes) {
  append(text.data(), text.size(), bytes);
}

std::string bytes_of(const MeshFile& file) {
  std::string bytes;
  append(file.mesh.vertices.data(), file.mesh.vertices.size(), bytes);
  append(file.mesh.triangles.data(), file.mesh.triangles.size(), bytes);
  for (const std::string& material : file.materials) append(material, bytes);
  return bytes;
}

MeshFile mesh_in(std::string_view bytes) {
  MeshFile file;
  file.mesh.vertices = take<std::vector<Eigen::Vector3d>>(bytes);
  file.mesh.triangles = take<std::vector<std::array<std::uint32_t, 3>>>(bytes);
  while (!bytes.empty()) file.materials.push_back(take<std::string>(bytes));
  return file;
}

std::string request_of(const std::string& path, const Eigen::Vector3d& scale,
                       const std::string& submesh, bool center) {
  std::string bytes;
  append(path, bytes);
  append(scale.data(), 3, bytes);
  append(submesh, bytes);
  bytes += center ? '1' : '0';
  return bytes;
}

/// Runs in the reader's process.
std::string answer_to(const std::string& request) {
  std::string_view bytes = request;
  const auto path = take<std::string>(bytes);
  const auto scale = take<std::vector<double>>(bytes);
  const auto submesh = take<std::string>(bytes);
  return bytes_of(read_here(path, {scale[0], scale[1], scale[2]}, submesh, bytes == "1"));
}

/// Far more than assimp needs for a valid mesh.
WorkLimits limits_of(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  const std::uint64_t size = error ? 0 : bytes;
  return {2 + static_cast<unsigned>(size / 1'000'000), 256'000'000 + 200 * size};
}

}  // namespace

MeshReader::MeshReader() : process_(answer_to) {}

MeshFile MeshReader::read(const std::string& path, const Eigen::Vector3d& scale,
                          const std::string& submesh, bool center) {
  require_readable(path);
  return mesh_in(process_.ask(path, limits_of(path), request_of(path, scale, submesh, center)));
}

}  // namespace tagfield
