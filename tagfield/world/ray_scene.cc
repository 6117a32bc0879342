// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/ray_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tagfield/base/error.h"
#include "tagfield/world/internal/ray_scene_impl.h"
#include "tagfield/world/world_mesh.h"

namespace tagfield {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr std::size_t kPacket = 16;
/// How far outside a triangle's edges a hit of Embree's is still accepted; barycentric.
constexpr double kRimTolerance = 0.01;

WorldPlane world_plane(const Collision& collision, const Plane& plane, std::size_t index) {
  const double length = plane.normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw Error(collision.name + ": the plane's normal has no direction");
  }
  const Eigen::Vector3d normal = collision.X_WC.rotation * (plane.normal / length);
  return {normal, normal.dot(collision.X_WC.translation), static_cast<std::uint32_t>(index)};
}

void add_solid(Triangles& triangles, const Collision& collision, std::size_t index) {
  const TriangleMesh mesh = world_mesh(collision);
  const auto first = static_cast<std::uint32_t>(triangles.vertices.size());
  triangles.firsts.back() = static_cast<std::uint32_t>(triangles.indices.size());
  triangles.collisions.insert(triangles.collisions.end(), mesh.triangles.size(),
                              static_cast<std::uint32_t>(index));
  triangles.vertices.insert(triangles.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.indices.push_back({first + a, first + b, first + c});
    const Eigen::Vector3d& p = mesh.vertices[a];
    triangles.areas.emplace_back((mesh.vertices[b] - p).cross(mesh.vertices[c] - p));
    triangles.normals.push_back(triangles.areas.back().normalized());
  }
}

void require_success(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw Error(fmt::format("rays can't be made ready: Embree's error {}", static_cast<int>(error)));
}

/// The intersection of a line with a triangle's plane.
struct PlanePoint {
  double distance;  ///< Along the line from `origin` [m]; not finite if parallel to the plane.
  bool is_in;       ///< In the triangle, or hardly outside.
};

PlanePoint meet(const Triangles& triangles, std::size_t triangle, const Eigen::Vector3d& origin,
                const Eigen::Vector3d& direction) {
  const auto& [i, j, k] = triangles.indices[triangle];
  const Eigen::Vector3d& a = triangles.vertices[i];
  const Eigen::Vector3d to_b = triangles.vertices[j] - a;
  const Eigen::Vector3d to_c = triangles.vertices[k] - a;
  const Eigen::Vector3d& normal = triangles.areas[triangle];
  const double square = normal.squaredNorm();
  const double distance = normal.dot(a - origin) / normal.dot(direction);
  const Eigen::Vector3d p = origin + distance * direction - a;
  // Barycentric coordinates, times `square`.
  const double of_b = normal.dot(p.cross(to_c));
  const double of_c = normal.dot(to_b.cross(p));
  return {distance, std::min({of_b, of_c, square - of_b - of_c}) > -kRimTolerance * square};
}

/// Filter that Embree calls for each hit that it would accept. Its single precision fails where a
/// ray grazes a triangle: hits far outside the triangle are reported (issue 387 of Embree), and
/// true ones are metres off. So each hit is recomputed in double precision and accepted unless it
/// is clearly outside the edges. Near the edges Embree's own decision stands, since with it no ray
/// passes between triangles.
void refine(const RTCFilterFunctionNArguments* hits) {
  const auto& triangles = *static_cast<const Triangles*>(hits->geometryUserPtr);
  const unsigned count = hits->N;
  for (unsigned i = 0; i < count; ++i) {
    if (hits->valid[i] != -1) continue;
    const Eigen::Vector3d origin(RTCRayN_org_x(hits->ray, count, i),
                                 RTCRayN_org_y(hits->ray, count, i),
                                 RTCRayN_org_z(hits->ray, count, i));
    const Eigen::Vector3d direction(RTCRayN_dir_x(hits->ray, count, i),
                                    RTCRayN_dir_y(hits->ray, count, i),
                                    RTCRayN_dir_z(hits->ray, count, i));
    const auto point = meet(triangles, RTCHitN_primID(hits->hit, count, i), origin, direction);
    if (point.distance >= 0.0 && point.is_in) {
      RTCRayN_tfar(hits->ray, count, i) = static_cast<float>(point.distance);
    } else {
      hits->valid[i] = 0;
    }
  }
}

/// Copies the triangles into Embree's buffers; `triangles` must outlive the scene.
void attach(RTCDevice device, RTCScene scene, Triangles& triangles) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* const vertices =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), triangles.vertices.size());
  void* const indices =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangles.indices.size());
  require_success(device);
  for (std::size_t i = 0; i < triangles.vertices.size(); ++i) {
    Eigen::Map<Eigen::Vector3f>(static_cast<float*>(vertices) + 3 * i) =
        triangles.vertices[i].cast<float>();
  }
  std::copy(triangles.indices.begin(), triangles.indices.end(),
            static_cast<std::array<std::uint32_t, 3>*>(indices));
  rtcSetGeometryUserData(geometry, &triangles);
  rtcSetGeometryIntersectFilterFunction(geometry, refine);
  rtcSetGeometryOccludedFilterFunction(geometry, gather_surfaces);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

bool can_hit(const Ray& ray) {
  return ray.origin.allFinite() && ray.direction.allFinite() && ray.max_m >= 0.0F;
}

/// Distance along the ray to the plane, or `otherwise` if that is shorter.
float nearer(const WorldPlane& plane, const Ray& ray, float otherwise) {
  const double slope = plane.normal.dot(ray.direction.cast<double>());
  const double height = plane.normal.dot(ray.origin.cast<double>()) - plane.offset;
  const double distance = -height / slope;
  // Also false for 0/0 and height/0: a ray parallel to the plane doesn't hit it.
  return distance >= 0.0 && distance < static_cast<double>(otherwise) ? static_cast<float>(distance)
                                                                      : otherwise;
}

void put(const Ray& ray, std::size_t lane, RTCRayHit16& packet) {
  packet.ray.org_x[lane] = ray.origin.x();
  packet.ray.org_y[lane] = ray.origin.y();
  packet.ray.org_z[lane] = ray.origin.z();
  packet.ray.dir_x[lane] = ray.direction.x();
  packet.ray.dir_y[lane] = ray.direction.y();
  packet.ray.dir_z[lane] = ray.direction.z();
  packet.ray.tnear[lane] = 0.0F;
  packet.ray.tfar[lane] = ray.max_m;
  packet.ray.time[lane] = 0.0F;
  packet.ray.mask[lane] = ~0U;
  packet.ray.flags[lane] = 0;
  packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
}

RTCRayHit single(const Ray& ray) {
  RTCRayHit hit{};
  hit.ray.org_x = ray.origin.x();
  hit.ray.org_y = ray.origin.y();
  hit.ray.org_z = ray.origin.z();
  hit.ray.dir_x = ray.direction.x();
  hit.ray.dir_y = ray.direction.y();
  hit.ray.dir_z = ray.direction.z();
  hit.ray.tfar = ray.max_m;
  hit.ray.mask = ~0U;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return hit;
}

/// A single device for all scenes, never released: when the last device is released, TBB starts
/// threads of its own, and terminates the program if the system can't start any.
RTCDevice lasting_device() {
  static const RTCDevice device = rtcNewDevice("threads=1");
  return device;
}

}  // namespace

RayScene::Impl::Impl() : device(lasting_device()) {
  if (device == nullptr) throw Error("rays can't be made ready: Embree has no device");
  scene = rtcNewScene(device);
}

RayScene::Impl::~Impl() { rtcReleaseScene(scene); }

float RayScene::Impl::with_planes(const Ray& ray, float distance) const {
  // Up to max_m, but an infinite ray doesn't hit a plane at infinity.
  float nearest = distance == kNothing ? std::nextafter(ray.max_m, kNothing) : distance;
  const float limit = nearest;
  for (const WorldPlane& plane : planes) nearest = nearer(plane, ray, nearest);
  return nearest < limit ? nearest : distance;
}

void RayScene::Impl::intersect(const Ray* rays, std::size_t count, float* distances) const {
  alignas(64) std::array<int, kPacket> valid{};
  RTCRayHit16 packet{};
  for (std::size_t i = 0; i < count; ++i) {
    if (!can_hit(rays[i])) continue;
    valid[i] = -1;
    put(rays[i], i, packet);
  }
  embree::Context context;
  embree::init(context);
  embree::intersect(valid.data(), scene, context, embree::Coherence::kCoherent, packet);
  for (std::size_t i = 0; i < count; ++i) {
    const bool hit = valid[i] != 0 && packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    distances[i] = hit ? packet.ray.tfar[i] : kNothing;
    if (valid[i] != 0 && !planes.empty()) distances[i] = with_planes(rays[i], distances[i]);
  }
}

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>()) {
  Triangles& triangles = impl_->triangles;
  for (std::size_t i = 0; i < scene.collisions.size(); ++i) {
    const Collision& collision = scene.collisions[i];
    triangles.firsts.push_back(0);
    if (const auto* plane = std::get_if<Plane>(&collision.shape)) {
      impl_->planes.push_back(world_plane(collision, *plane, i));
    } else {
      add_solid(triangles, collision, i);
    }
  }
  // Robust: a ray through an edge hits at least one of the triangles that share it.
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);
  if (!triangles.indices.empty()) attach(impl_->device, impl_->scene, triangles);
  rtcCommitScene(impl_->scene);
  require_success(impl_->device);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

float RayScene::distance(const Ray& ray) const {
  if (!can_hit(ray)) return kNothing;
  RTCRayHit hit = single(ray);
  embree::Context context;
  embree::init(context);
  embree::intersect(impl_->scene, context, hit);
  const bool met = hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  return impl_->with_planes(ray, met ? hit.ray.tfar : kNothing);
}

void RayScene::distances(const std::vector<Ray>& rays, std::vector<float>& distances) const {
  distances.resize(rays.size());
  for (std::size_t i = 0; i < rays.size(); i += kPacket) {
    impl_->intersect(&rays[i], std::min(kPacket, rays.size() - i), &distances[i]);
  }
}

}  // namespace tagfield
