// SPDX-License-Identifier: Apache-2.0
/// @file
/// State that every driver of a field keeps: numbers and names of tags, names of antennas and when
/// they are due. A simulator's adapter adds the poses.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "tagfield/field/rfid_field.h"

namespace tagfield {

/// Collects a FieldStep from the calls between two stamps. Not thread-safe.
class FieldDriver {
 public:
  /// Adds a tag by its ID; it enters the field when it is placed. Throws Error if the ID is taken.
  std::uint32_t add_tag(const std::string& id, const std::string& label = "",
                        std::shared_ptr<const TagModel> model = nullptr);
  /// Sets the tag's pose to `X_WT`; on the first call it appears there, as of `since`. Poses that
  /// are not finite are ignored.
  void place_tag(std::uint32_t number, const RigidTransform& X_WT, Time since);
  /// Frees the number and the ID.
  void remove_tag(std::uint32_t number);

  /// The antenna is not due before start(). Throws Error if the name is taken.
  void add_antenna(const std::shared_ptr<const FieldAntenna>& antenna);
  /// No effect if there is no such antenna.
  void remove_antenna(const std::string& name);
  [[nodiscard]] bool has_antenna(const std::string& name) const;
  /// Its description; null if there is no such antenna.
  [[nodiscard]] std::shared_ptr<const FieldAntenna> antenna(const std::string& name) const;

  /// The antenna updates at its rate from `from` on. `antenna` must have the name of an added
  /// antenna, and may contain more information than when it was added. `at`: the stamps of its
  /// updates instead, in ascending order.
  void start(const std::shared_ptr<const FieldAntenna>& antenna, Time from,
             std::vector<Time> at = {});
  /// Reschedules all started antennas from `from` on, because the updates in between were not made,
  /// or because time jumped back.
  void go_on(Time from);
  /// Stamp of the earliest next update; nullopt if there is none.
  [[nodiscard]] std::optional<Time> next_due() const;
  /// Antennas that are due by `now`, without their poses, in the order in which they were added.
  /// Each is next due at its first update after `now`.
  std::vector<AntennaDue> take_due(Time now);

  /// Whether tags or antennas have been added or removed since the last step.
  [[nodiscard]] bool has_news() const;
  /// All changes since the last step, without antennas that are due.
  FieldStep take_step(Time stamp);

 private:
  struct Tag {
    std::string id;
    std::string label;
    std::shared_ptr<const TagModel> model;
    bool is_placed = false;
  };
  struct Antenna {
    std::shared_ptr<const FieldAntenna> antenna;
    std::vector<Time> at;
    Time due = Time::max();
    bool has_started = false;
  };
  static Time first_due(const Antenna& antenna, Time from);

  std::vector<Tag> tags_;  ///< By number.
  std::vector<std::uint32_t> free_numbers_;
  std::unordered_set<std::string> ids_;
  std::vector<Antenna> antennas_;
  FieldStep next_;
};

}  // namespace tagfield
