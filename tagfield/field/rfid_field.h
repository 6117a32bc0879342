// SPDX-License-Identifier: Apache-2.0
/// @file
/// A field of tags and antennas that a driver moves in steps: what the antennas read is told to
/// whoever listens.
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

/// What belongs to one antenna as long as it lives.
struct FieldAntenna {
  AntennaParameters parameters;
  std::uint64_t seed = 1;
  std::string sensor;        ///< Name of the sensor that it is; "" where there is none.
  std::string name_space;    ///< Of its topics; "" for none.
  std::string frame_id;      ///< Of the antenna.
  std::string parent_frame;  ///< Of what its pose is told in; "" for the world.
  bool is_fixed = false;     ///< It is at rest in the world.
};

/// A tag that appears under its driver's number, which is used again after the tag went.
struct TagAdded {
  std::uint32_t number = 0;
  std::string id;     ///< Unique among the tags present.
  std::string label;  ///< What the driver's world calls it; "" where it does not.
  RigidTransform X_WT;
  std::shared_ptr<const TagModel> model{};  ///< Its kind; default_tag_model() where it is null.
  Time since{};                             ///< When it came; not after the step's stamp.
};

struct TagMoved {
  std::uint32_t number = 0;
  RigidTransform X_WT;
};

/// What stands in the driver's world, for antennas whose waves meet it.
struct FieldWorld {
  Scene scene;
  RadioWorldOptions materials;
};

/// An antenna to be updated.
struct AntennaDue {
  std::shared_ptr<const FieldAntenna> antenna;
  RigidTransform X_WA;
  std::optional<RigidTransform> X_PA;  ///< As it is told in its parent frame, where it is told.
  bool is_last = false;                ///< The antenna never updates again.
};

/// First antennas and tags go, then the world changes, then antennas and tags come, then tags move,
/// and then antennas update.
struct FieldStep {
  Time stamp;
  std::vector<std::uint32_t> removed;
  std::vector<TagAdded> added;
  std::vector<TagMoved> moved;
  std::vector<AntennaDue> due;
  std::vector<std::string> antennas_removed;  ///< Names.
  std::vector<std::shared_ptr<const FieldAntenna>> antennas_added;
  std::vector<AntennaPose> robots;  ///< True poses, for those who are told the truth.
  /// What moves and is in waves' way, where it is at the stamp; null for nothing.
  std::shared_ptr<const std::vector<MovingBody>> bodies;
  std::shared_ptr<const FieldWorld> world;  ///< Null where it is the one before; at first empty.
};

struct RadioWorld;

/// Takes the steps of a driver, which may be a clock with robots, another simulator, or a
/// recording. Antennas must be added before they update; when time goes back all begin anew. Not
/// thread-safe.
class RfidField {
 public:
  /// `world`: as waves see it at first; empty space where it is null.
  explicit RfidField(Outlets outlets, std::shared_ptr<const RadioWorld> world = nullptr);
  ~RfidField();
  RfidField(RfidField&&) noexcept;
  RfidField& operator=(RfidField&&) noexcept;

  /// Applies the step and tells the listeners. Poses that are not finite are left out: a tag stays
  /// where it was, an antenna skips its update. Throws Error on a tag ID that is present already,
  /// and on a tag's number or an antenna's name that is not.
  void step(const FieldStep& step);
  /// Tells what was kept back because something earlier could still have come.
  void finish();

  /// What was odd since the last call, each only once: guessed materials, a world that can't be
  /// made ready for waves, which then stays the one before.
  std::vector<std::string> take_warnings();

  /// Made so far.
  [[nodiscard]] std::int64_t reads() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
