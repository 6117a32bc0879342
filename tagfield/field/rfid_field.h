// SPDX-License-Identifier: Apache-2.0
/// @file
/// A field of tags and antennas that a driver advances in steps; listeners receive the antennas'
/// reads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/channel/material.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/reader/antenna.h"
#include "tagfield/stream/listeners.h"
#include "tagfield/world/scene.h"

namespace tagfield {

struct MovingBody;
struct TagModel;

/// The properties of an antenna that don't change during its lifetime.
struct FieldAntenna {
  AntennaParameters parameters;
  std::uint64_t seed = 1;
  std::string sensor;        ///< Name of its sensor; "" if there is none.
  std::string name_space;    ///< Namespace of its topics; "" for none.
  std::string frame_id;      ///< Frame of the antenna.
  std::string parent_frame;  ///< Frame in which its pose is reported; "" for the world.
  bool is_fixed = false;     ///< It doesn't move in the world.
};

/// A tag that appears, with its driver's number, which is reused after the tag has disappeared.
struct TagAdded {
  std::uint32_t number = 0;
  std::string id;     ///< Unique among the tags present.
  std::string label;  ///< Its name in the driver's world; "" if it has none.
  RigidTransform X_WT;
  std::shared_ptr<const TagModel> model{};  ///< Its kind; null for default_tag_model().
  Time since{};                             ///< When it appeared; not after the step's stamp.
};

struct TagMoved {
  std::uint32_t number = 0;
  RigidTransform X_WT;
};

/// The objects in the driver's world, for antennas whose waves interact with them.
struct FieldWorld {
  Scene scene;
  RadioWorldOptions materials;
};

/// An antenna to be updated.
struct AntennaDue {
  std::shared_ptr<const FieldAntenna> antenna;
  RigidTransform X_WA;
  std::optional<RigidTransform> X_PA;  ///< As reported in its parent frame, if it is reported.
  bool is_last = false;                ///< The antenna never updates again.
};

/// Applied in this order: antennas and tags are removed, the world changes, antennas and tags are
/// added, tags move, antennas update.
struct FieldStep {
  Time stamp;
  std::vector<std::uint32_t> removed;
  std::vector<TagAdded> added;
  std::vector<TagMoved> moved;
  std::vector<AntennaDue> due;
  std::vector<std::string> antennas_removed;  ///< Names.
  std::vector<std::shared_ptr<const FieldAntenna>> antennas_added;
  std::vector<AntennaPose> robots;  ///< True poses, for TruthListeners.
  /// Moving obstacles to waves, with their poses at the stamp; null for none.
  std::shared_ptr<const std::vector<MovingBody>> bodies;
  std::shared_ptr<const FieldWorld> world;  ///< Null if unchanged; initially empty.
};

struct RadioWorld;

/// Processes the steps of a driver, which may be a clock with robots, another simulator, or a
/// recording. Antennas must be added before they update; when time jumps back, everything starts
/// anew. Not thread-safe.
class RfidField {
 public:
  /// `world`: the initial world for wave propagation; null for empty space. Paths to many tags are
  /// traced on up to `threads` threads, on which the reads don't depend.
  explicit RfidField(Outlets outlets, std::shared_ptr<const RadioWorld> world = nullptr,
                     int threads = 1);
  ~RfidField();
  RfidField(RfidField&&) noexcept;
  RfidField& operator=(RfidField&&) noexcept;

  /// Applies the step and notifies the listeners. Poses that are not finite are skipped: a tag
  /// stays where it was, an antenna skips its update. Throws Error on a tag ID that is already
  /// present, and on an unknown tag number or antenna name.
  void step(const FieldStep& step);
  /// Delivers reads held back because an earlier one could still have followed.
  void finish();
  /// The reader's reads that are held back now, in chronological order. Listeners still receive
  /// them.
  [[nodiscard]] std::vector<TagRead> held_reads(const std::string& reader) const;

  /// Warnings since the last call, without duplicates: guessed materials, a world that can't be
  /// prepared for wave propagation, in which case the previous one is kept.
  std::vector<std::string> take_warnings();

  /// Number of reads generated so far.
  [[nodiscard]] std::int64_t reads() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
