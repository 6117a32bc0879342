// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/population.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tagfield/poses/rigid_transform.h"
#include "tagfield/sdf/internal/models.h"
#include "tagfield/sdf/internal/xml_file.h"

namespace tagfield::sdf_internal {
namespace {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

/// The numbers of a child of `element`, or SDF's default for it.
std::vector<double> numbers_in(Context& context, const XMLElement& element, const char* name,
                               const std::vector<double>& otherwise) {
  const XMLElement* child = element.FirstChildElement(name);
  if (child == nullptr || text_of(*child).empty()) return otherwise;
  return numbers_of(*child, otherwise.size(), context.diagnostics);
}

/// A number of copies, rows or columns.
int count_in(Context& context, const XMLElement& element, const char* name) {
  const double count = std::floor(numbers_in(context, element, name, {1.0}).front());
  if (count > static_cast<double>(kMaxModels)) {
    fail(location_of(element), fmt::format("<{}> of over {}", name, kMaxModels));
  }
  return static_cast<int>(std::max(0.0, count));
}

Vector3d vector_in(Context& context, const XMLElement& element, const char* name,
                   const Vector3d& otherwise) {
  const std::vector<double> n =
      numbers_in(context, element, name, {otherwise.x(), otherwise.y(), otherwise.z()});
  return {n[0], n[1], n[2]};
}

/// Rows and columns around the pose's position. Gazebo turns all of them about the first one.
std::vector<Vector3d> grid(Context& context, const XMLElement& distribution,
                           const RigidTransform& X_WP) {
  const int rows = count_in(context, distribution, "rows");
  const int columns = count_in(context, distribution, "cols");
  const Vector3d step = vector_in(context, distribution, "step", {0.5, 0.5, 0.0});
  const Vector3d first =
      X_WP.translation - 0.5 * Vector3d((columns - 1) * step.x(), (rows - 1) * step.y(), 0.0);
  if (static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) > kMaxModels) {
    fail(location_of(distribution), fmt::format("a grid of over {} models", kMaxModels));
  }
  std::vector<Vector3d> positions;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      positions.push_back(first + X_WP.rotation * Vector3d(column * step.x(), row * step.y(), 0.0));
    }
  }
  return positions;
}

/// In a row along an axis of the box. Gazebo turns the row about the box's lowest corner.
std::vector<Vector3d> row(Context& context, const XMLElement& population, int axis,
                          const RigidTransform& X_WP) {
  const int count = count_in(context, population, "model_count");
  const Vector3d size =
      vector_in(context, *population.FirstChildElement("box"), "size", {1.0, 1.0, 1.0});
  std::vector<Vector3d> positions;
  for (int i = 0; i < count; ++i) {
    Vector3d p = 0.5 * size;
    p[axis] = i * size[axis] / count;
    positions.push_back(X_WP.translation - 0.5 * size + X_WP.rotation * p);
  }
  return positions;
}

bool is_in_a_row(const std::string& type) {
  return type == "linear-x" || type == "linear-y" || type == "linear-z";
}

bool has(const XMLElement& element, const char* name) {
  return element.FirstChildElement(name) != nullptr;
}

/// Why Gazebo places no copies, or others in each run; "" if it places some.
std::string why_left_out(const XMLElement& population, const std::string& type) {
  if (!has(population, "model") && !has(population, "include")) return "it lacks <model>";
  if (!has(population, "pose")) return "it lacks <pose>";
  if (type == "random" || type == "uniform") {
    return "Gazebo draws the positions at random, others in each run";
  }
  if (is_in_a_row(type)) return has(population, "box") ? "" : "it lacks <box>";
  if (type != "grid") {
    return fmt::format("its distribution is '{}' (expected grid, linear-x, linear-y or linear-z)",
                       type);
  }
  for (const char* name : {"rows", "cols", "step"}) {
    if (!has(*population.FirstChildElement("distribution"), name)) {
      return fmt::format("its <distribution> lacks <{}>", name);
    }
  }
  return "";
}

}  // namespace

std::vector<Vector3d> positions_of(Context& context, const XMLElement& population) {
  const XMLElement* const distribution = population.FirstChildElement("distribution");
  const std::string type = distribution == nullptr ? "" : child_text(*distribution, "type");
  std::string why = why_left_out(population, type);
  std::vector<Vector3d> positions;
  if (why.empty()) {
    const RigidTransform X_WP = pose_of(*population.FirstChildElement("pose"), context.diagnostics);
    positions = is_in_a_row(type) ? row(context, population, type.back() - 'x', X_WP)
                                  : grid(context, *distribution, X_WP);
    if (positions.empty()) why = "it asks for less than one copy";
  }
  if (!why.empty()) {
    context.diagnostics.warn(
        location_of(population),
        fmt::format("<population> '{}' is left out: {}", attribute_of(population, "name"), why));
  }
  return positions;
}

}  // namespace tagfield::sdf_internal
