// SPDX-License-Identifier: Apache-2.0
/// @file
/// What every driver of a field keeps alike: numbers and names of tags, names of antennas and when
/// they are due. A simulator's adapter adds where things are.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "tagfield/field/rfid_field.h"

namespace tagfield {

/// Gathers a FieldStep from what is said between two stamps. Not thread-safe.
class FieldDriver {
 public:
  /// A tag by its ID; not in the field before it is placed. Throws Error if the ID is taken.
  std::uint32_t add_tag(const std::string& id, const std::string& label = "",
                        std::shared_ptr<const TagModel> model = nullptr);
  /// The tag is at `X_WT`; the first time it appears there, since `since`. What is not finite is
  /// passed over.
  void place_tag(std::uint32_t number, const RigidTransform& X_WT, Time since);
  /// The number and the ID are free again.
  void remove_tag(std::uint32_t number);

  /// Not due before start(). Throws Error if the name is taken.
  void add_antenna(const std::shared_ptr<const FieldAntenna>& antenna);
  /// Nothing where there is no such antenna.
  void remove_antenna(const std::string& name);
  [[nodiscard]] bool has_antenna(const std::string& name) const;
  /// What is told of it; null where there is no such antenna.
  [[nodiscard]] std::shared_ptr<const FieldAntenna> antenna(const std::string& name) const;

  /// The antenna updates at its rate from `from` on; `antenna` has its name, and may tell more than
  /// what was added. `at`: the stamps of its updates instead, rising.
  void start(const std::shared_ptr<const FieldAntenna>& antenna, Time from,
             std::vector<Time> at = {});
  /// All that have started go on at `from`: the updates between were not made, or time went back.
  void go_on(Time from);
  /// Stamp of the next update of all; none where there is none.
  [[nodiscard]] std::optional<Time> next_due() const;
  /// Antennas that are due by `now`, without their poses, in the order in which they were added.
  /// Each is due again by its first update after `now`.
  std::vector<AntennaDue> take_due(Time now);

  /// Whether anything has come or gone since the last step.
  [[nodiscard]] bool has_news() const;
  /// What was said since the last step, without antennas that are due.
  FieldStep take_step(Time stamp);

 private:
  struct Tag {
    std::string id;
    std::string label;
    std::shared_ptr<const TagModel> model;
    bool is_told = false;  ///< It has a place.
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
