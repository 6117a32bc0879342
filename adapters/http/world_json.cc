// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/world_json.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tagfield/base/units.h"
#include "tagfield/channel/radio_world.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield::http {
namespace {

/// Resolution of a beam's grid: fine enough for its half-power contour, small enough for a page.
constexpr int kPolarSteps = 36;
constexpr int kAzimuthSteps = 24;
constexpr double kMinGain_db = -40.0;

Json mesh_json(const TriangleMesh& mesh) {
  Json vertices = Json::array();
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    // A tenth of a millimetre is enough for display.
    for (int i = 0; i < 3; ++i) vertices.push_back(std::round(vertex[i] * 1e4) / 1e4);
  }
  Json triangles = Json::array();
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) triangles.push_back(corner);
  }
  return {{"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}};
}

/// Each mesh once, however often it is used.
class Meshes {
 public:
  std::size_t number_of(const MeshPtr& mesh) {
    const auto [entry, is_new] = numbers_.emplace(mesh.get(), json_.size());
    if (is_new) json_.push_back(mesh_json(*mesh));
    return entry->second;
  }
  Json take() { return std::move(json_); }

 private:
  std::map<const TriangleMesh*, std::size_t> numbers_;
  Json json_ = Json::array();
};

void add_shape(const Shape& shape, Meshes& meshes, Json& solid) {
  if (const auto* box = std::get_if<Box>(&shape)) solid["box"] = point_json(box->size);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    solid["cylinder"] = {cylinder->radius, cylinder->length};
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape)) solid["sphere"] = sphere->radius;
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    solid["plane"] = {plane->size.x(), plane->size.y()};
    solid["normal"] = point_json(plane->normal);
  }
  if (const auto* mesh = std::get_if<MeshPtr>(&shape)) solid["mesh"] = meshes.number_of(*mesh);
}

/// Material of each collision; "" if unknown.
std::vector<std::string> materials_of(const Scene& scene, const Scenario& scenario) {
  std::vector<std::string> names(scene.collisions.size());
  Diagnostics unheard;  // Already reported on loading, if relevant.
  try {
    const RadioWorld world = radio_world(scene, scenario.materials, unheard);
    for (std::size_t i = 0; i < names.size(); ++i) {
      names[i] = world.materials[world.material_of[i]].name;
    }
  } catch (const Error&) {
    // A world that is unsuitable for wave propagation can still be displayed.
    return names;
  }
  return names;
}

}  // namespace

std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json point_json(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json pose_json(const RigidTransform& X) {
  const Eigen::Vector3d& p = X.translation;
  const Eigen::Quaterniond& q = X.rotation;
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

Json solids_json(const Scene& scene, const Scenario& scenario) {
  const std::vector<std::string> materials = materials_of(scene, scenario);
  Meshes meshes;
  Json solids = Json::array();
  for (std::size_t i = 0; i < scene.collisions.size(); ++i) {
    const Collision& collision = scene.collisions[i];
    Json solid = {
        {"name", collision.name}, {"material", materials[i]}, {"pose", pose_json(collision.X_WC)}};
    add_shape(collision.shape, meshes, solid);
    solids.push_back(std::move(solid));
  }
  return {{"name", scenario.name},
          {"description", scenario.description},
          {"solids", std::move(solids)},
          {"meshes", meshes.take()},
          {"map", nullptr}};
}

Json obstacle_json(const ObstacleSpec& obstacle, Time now) {
  const Eigen::Vector3d p_W = held_position_at(obstacle.motion, now);
  const BodySpec body = obstacle.body.value_or(BodySpec{});
  Json json = {{"name", obstacle.name},
               {"position", {p_W.x(), p_W.y()}},
               {"size", {obstacle.size_m.x(), obstacle.size_m.y()}},
               {"radius", obstacle.radius_m},
               {"yaw", obstacle.yaw_rad},
               {"height", body.height_m},
               {"material", body.material.name}};
  if (obstacle.motion.size() > 1) {
    json["motion"] = Json::array();
    for (const StampedPose& pose : obstacle.motion) {
      const Eigen::Vector3d& p = pose.X_WB.translation;
      json["motion"].push_back({to_seconds(pose.stamp), p.x(), p.y()});
    }
  }
  if (obstacle.appears > Time{}) json["appears"] = to_seconds(obstacle.appears);
  if (obstacle.disappears) json["disappears"] = to_seconds(*obstacle.disappears);
  return json;
}

Json obstacles_json(const Scenario& scenario, Time now) {
  Json all = Json::array();
  for (const ObstacleSpec& obstacle : scenario.obstacles) {
    if (!obstacle.disappears || now < *obstacle.disappears) {
      all.push_back(obstacle_json(obstacle, now));
    }
  }
  return all;
}

Json paths_json(const Scenario& scenario) {
  Json all = Json::array();
  for (const RobotSpec& robot : scenario.robots) {
    Json points = Json::array();
    points.push_back({robot.start.x, robot.start.y, 0.0});
    for (const Eigen::Vector2d& waypoint : robot.waypoints) {
      points.push_back({waypoint.x(), waypoint.y(), 0.0});
    }
    all.push_back({{"name", robot.name}, {"points", std::move(points)}});
  }
  return all;
}

Json beam_json(const AntennaParameters& antenna) {
  const RadioModel* const model = physical(antenna);
  if (model == nullptr || !model->effects.patterns) return nullptr;
  const double peak = peak_gain(model->antenna);
  Json theta = Json::array();
  Json phi = Json::array();
  Json gains = Json::array();
  for (int k = 0; k < kAzimuthSteps; ++k) phi.push_back(2.0 * kPi * k / kAzimuthSteps);
  for (int i = 0; i <= kPolarSteps; ++i) {
    const double off = kPi * i / kPolarSteps;
    theta.push_back(off);
    Json row = Json::array();
    for (int k = 0; k < kAzimuthSteps; ++k) {
      const double about = 2.0 * kPi * k / kAzimuthSteps;
      const Eigen::Vector3d u_A(std::cos(off), std::sin(off) * std::cos(about),
                                std::sin(off) * std::sin(about));
      const double gain_db = to_db(gain(model->antenna, u_A) / peak);
      row.push_back(std::round(std::max(gain_db, kMinGain_db) * 100.0) / 100.0);
    }
    gains.push_back(std::move(row));
  }
  return {{"theta", theta}, {"phi", phi}, {"gain_db", gains}};
}

Json antenna_json(const AntennaSpec& spec, const RigidTransform& X_WA, std::size_t port,
                  const std::vector<std::shared_ptr<const TagModel>>& kinds) {
  const AntennaParameters& parameters = spec.parameters;
  const auto power_dbm = transmit_power_dbm(parameters);
  return {{"name", parameters.name},
          {"reader", parameters.reader},
          {"port", port},
          {"robot", spec.on},
          {"pose", pose_json(X_WA)},
          {"model", meets_world(parameters) ? "physical" : "paper"},
          {"range", largest_range_m(parameters, kinds)},
          {"frequency", nominal_frequency_hz(parameters)},
          {"power_dbm", power_dbm ? Json(*power_dbm) : Json(nullptr)},
          {"beam", beam_json(parameters)}};
}

Json covariance_json(const Candidate& place) {
  if (!place.covariance) {
    const double equal = 0.5 * place.expected_error_m * place.expected_error_m;
    return {equal, 0.0, equal};
  }
  const Eigen::Matrix3d& known = *place.covariance;
  return {known(0, 0), known(0, 1), known(1, 1)};
}

}  // namespace tagfield::http
