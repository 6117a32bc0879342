// SPDX-License-Identifier: Apache-2.0
/// @file
/// The path of a wave from an antenna to a tag: direct, or reflected by facets.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace tagfield {

/// Maximum number of reflections on a path.
inline constexpr int kMaxBounces = 3;

/// Reflection of the wave by a facet.
struct Bounce {
  std::uint32_t solid = 0;                        ///< Index into Scene::collisions.
  std::uint32_t facet = 0;                        ///< Index into RadioScene::facets().
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d normal_W =
      Eigen::Vector3d::Zero();  ///< Unit vector, towards the side of the wave.
};

/// A solid that the wave passes through on one leg.
struct Crossing {
  std::uint32_t solid = 0;     ///< Index into Scene::collisions.
  int leg = 0;                 ///< Leg 0 starts at the antenna.
  double length_m = 0.0;       ///< Length inside, along the leg; 0 for a single sheet.
  double cos_incidence = 1.0;  ///< At p_W, between the leg and the surface's normal: 0 … 1.
  Eigen::Vector3d normal_W =
      Eigen::Vector3d::Zero();  ///< Unit vector at p_W, against the wave's direction of travel.
  /// Where the wave enters, or leaves if the leg begins inside [m].
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
};

/// The legs are antenna to bounces[0], from bounce to bounce, and from the last one to the tag:
/// bounce_count + 1 of them.
struct RadioPath {
  int bounce_count = 0;
  std::array<Bounce, kMaxBounces> bounces;  ///< The first `bounce_count` are set.
  std::vector<Crossing> crossings;          ///< In the order in which the wave reaches them.
  double length_m = 0.0;                    ///< Total of all legs.
  Eigen::Vector3d departure_W =
      Eigen::Vector3d::Zero();  ///< Unit vector: direction of travel at the antenna.
  Eigen::Vector3d arrival_W =
      Eigen::Vector3d::Zero();  ///< Unit vector: direction of travel at the tag.
  bool blocked = false;  ///< Passes through an opaque solid; only with TraceOptions::keep_blocked.
};

}  // namespace tagfield
