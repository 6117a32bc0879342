// SPDX-License-Identifier: Apache-2.0
/// @file
/// The state of an antenna in the air that antennas share, and what it sees.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tagfield/field/port_turns.h"
#include "tagfield/field/radio_link.h"
#include "tagfield/field/radio_port.h"
#include "tagfield/field/tag_motion.h"
#include "tagfield/gen2/inventory.h"

namespace tagfield {

/// The state of an antenna between updates.
struct AirAntenna {
  /// A tag that was read since the last update, with its pose at the time.
  struct Pending {
    std::uint32_t slot;
    Time stamp;
    RigidTransform X_WT;
  };
  /// Results since antenna and tags came to rest: as long as neither moves and there are no bodies
  /// or other readers, links depend only on the carrier.
  struct AtRest {
    RigidTransform X_WA;
    std::uint64_t tags = 0;                           ///< TagPopulation::version().
    bool is_known = false;                            ///< For the last update.
    std::map<double, std::vector<TagOnAir>> powered;  ///< By carrier.
    std::map<double, std::unordered_map<std::uint32_t, RadioLink>> read;  ///< By carrier and slot.
  };
  AntennaParameters parameters;
  RadioPort port;
  std::unique_ptr<Inventory> inventory;
  std::optional<Time> updated;  ///< Last update,
  RigidTransform X_WA;          ///< and the pose at that time.
  std::vector<Pending> pending;
  bool is_over = false;                    ///< It never updates again.
  std::shared_ptr<const ImageSet> images;  ///< Last computed; kept while at rest.
  std::shared_ptr<const ImageSet> receiver_images;
  std::vector<PathCache> memories;  ///< By slot, for those in range; empty in empty space.
  std::vector<PathCache> receiver_memories;
  std::optional<RigidTransform> X_WA_sending;  ///< For other antennas; unset at first.
  double interference_mw = 0.0;                ///< In its tags' replies, since the last update.
  AtRest at_rest;

  [[nodiscard]] const RadioModel& model() const { return *physical(parameters); }
  [[nodiscard]] RigidTransform pose_at(Time stamp, const RigidTransform& X_WA_now, Time now) const {
    if (!updated) return X_WA_now;
    return interpolate(X_WA, X_WA_now, share_at(stamp, *updated, now));
  }
  [[nodiscard]] Eigen::Vector3d velocity(const RigidTransform& X_WA_now, Time now) const {
    if (!updated || now <= *updated) return Eigen::Vector3d::Zero();
    return (X_WA_now.translation - X_WA.translation) / to_seconds(now - *updated);
  }
};

/// The antenna's view from `X_WA`, without images and bodies.
RadioView bare_view_of(const AirAntenna& antenna, const RadioWorld& world,
                       const RigidTransform& X_WA, double frequency_hz);

/// Adds the images of the view's antenna, and of its receiver if that is another one, computed only
/// if the antenna has moved.
void add_images(AirAntenna& antenna, RadioView& view);

/// Ensures a cache for each of the slots if paths are traced.
void make_room(const std::vector<std::uint32_t>& slots, const RadioView& view, AirAntenna& antenna);

/// Whether the antenna transmits before its next update.
bool has_turn_soon(const AirAntenna& antenna, const std::vector<PortCycle>& cycles, Time now);

}  // namespace tagfield
