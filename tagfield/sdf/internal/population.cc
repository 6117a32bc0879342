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

void leave_out(Context& context, const XMLElement& population, const std::string& reason) {
  context.diagnostics.warn(
      location_of(population),
      fmt::format("<population> '{}' is left out: {}", attribute_of(population, "name"), reason));
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
std::vector<Vector3d> row(int axis, int count, const Vector3d& size, const RigidTransform& X_WP) {
  std::vector<Vector3d> positions;
  for (int i = 0; i < count; ++i) {
    Vector3d p = 0.5 * size;
    p[axis] = i * size[axis] / count;
    positions.push_back(X_WP.translation - 0.5 * size + X_WP.rotation * p);
  }
  return positions;
}

}  // namespace

std::vector<Vector3d> positions_of(Context& context, const XMLElement& population) {
  const auto unless_none = [&](std::vector<Vector3d> positions) {
    if (positions.empty()) leave_out(context, population, "it asks for less than one copy");
    return positions;
  };
  const XMLElement* const pose = population.FirstChildElement("pose");
  const XMLElement* const box = population.FirstChildElement("box");
  const XMLElement* const distribution = population.FirstChildElement("distribution");
  const std::string type = distribution == nullptr ? "" : child_text(*distribution, "type");
  const auto lacks = [&](const XMLElement& element, const char* name) {
    if (element.FirstChildElement(name) != nullptr) return false;
    leave_out(context, population, fmt::format("<{}> lacks <{}>", element.Name(), name));
    return true;
  };
  if (lacks(population, "pose")) return {};
  const RigidTransform X_WP = pose_of(*pose, context.diagnostics);
  if (type == "grid") {
    for (const char* name : {"rows", "cols", "step"}) {
      if (lacks(*distribution, name)) return {};
    }
    return unless_none(grid(context, *distribution, X_WP));
  }
  if (type == "linear-x" || type == "linear-y" || type == "linear-z") {
    if (lacks(population, "box")) return {};
    return unless_none(row(type.back() - 'x', count_in(context, population, "model_count"),
                           vector_in(context, *box, "size", {1.0, 1.0, 1.0}), X_WP));
  }
  leave_out(context, population,
            type == "random" || type == "uniform"
                ? "Gazebo draws the positions at random, others in each run"
                : fmt::format("its distribution is '{}' (expected grid, linear-x, linear-y or "
                              "linear-z)",
                              type));
  return {};
}

}  // namespace tagfield::sdf_internal
