// SPDX-License-Identifier: Apache-2.0
/// @file
/// What antennas' updates yield, told in order of time although it does not come so.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/field/rfid_field.h"
#include "tagfield/field/tag_population.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// Slots of an inventory go on between updates, so an antenna's update yields reads from before
/// other antennas' updates. Reads are kept here until none earlier can come; all else is told at
/// once.
class Telling {
 public:
  explicit Telling(Outlets outlets) : outlets_(std::move(outlets)) {}

  [[nodiscard]] const Outlets& outlets() const { return outlets_; }

  void add(const TagRead& read, double distance_m);
  /// All that read_tags() reads with `antenna` at `p_WA` [m] at `stamp`. It is made when it is
  /// told, a piece at a time, so that it need not go through memory; `tags` must stay as they are
  /// until the next tell().
  void add(const std::shared_ptr<const FieldAntenna>& antenna, Time stamp,
           const TagPopulation& tags, const Eigen::Vector3d& p_WA);
  /// All of one update at `stamp`, in order: `replies` become empty. `tags` likewise.
  void add(const std::shared_ptr<const FieldAntenna>& antenna, Time stamp,
           const TagPopulation& tags, std::vector<TagReply>& replies);
  /// `antenna`'s update at `stamp`, after its reads were added.
  void add(const std::shared_ptr<const AntennaInfo>& antenna, Time stamp,
           const RigidTransform& X_WA, const std::optional<RigidTransform>& X_PA);
  /// A tag's place, from `stamp` on; `label` where it is new.
  void add(Time stamp, const TagPosition& tag, std::optional<std::string> label);
  void add_removed(Time stamp, const std::string& tag);
  void add_placed(Time stamp);
  void add_robot(const AntennaPose& robot);

  /// Tells all but the reads after `until`, up to which no read will be added any more.
  void tell(Time until);

  /// How many reads were added; those that are made as they are told count from then on.
  [[nodiscard]] std::int64_t reads() const { return reads_; }

 private:
  struct Read {
    TagRead read;
    double distance_m;
  };
  /// Many reads as they were made: what listeners are told is put together one by one.
  struct Reads {
    std::shared_ptr<const FieldAntenna> antenna;
    const TagPopulation* tags;
    std::vector<TagReply> replies;
  };
  /// Reads that are not made yet.
  struct Unmade {
    std::shared_ptr<const FieldAntenna> antenna;
    const TagPopulation* tags;
    Eigen::Vector3d p_WA;
  };
  struct Update {
    std::shared_ptr<const AntennaInfo> antenna;
    RigidTransform X_WA;
    std::optional<RigidTransform> X_PA;
  };
  struct Place {
    TagPosition tag;
    std::optional<std::string> label;
  };
  struct Removed {
    std::string tag;
  };
  struct Placed {};
  using What = std::variant<Read, Reads, Unmade, Update, Place, Removed, Placed, AntennaPose>;
  struct Event {
    Time stamp;
    What what;
  };
  void push(Time stamp, What what);
  void tell(Time stamp, const Read& read) const;
  void tell(Time stamp, const Reads& reads);
  void tell(Time stamp, const Unmade& unmade);
  /// Makes reads, and counts them, some hundreds a call of `take`.
  void make(Time stamp, const Unmade& unmade,
            const std::function<void(std::span<const TagReply>)>& take);
  void tell_together(const AntennaParameters& antenna, Time stamp, const TagPopulation& tags,
                     std::span<const TagReply> replies);
  [[nodiscard]] static bool is_kept(const Event& event, Time until);
  void keep(Event& event, std::vector<Event>& kept);
  void tell(Time stamp, const Update& update) const;
  void tell(Time stamp, const Place& place) const;
  void tell(Time stamp, const Removed& removed) const;
  void tell(Time stamp, const Placed& placed) const;
  void tell(Time stamp, const AntennaPose& robot) const;

  Outlets outlets_;
  std::vector<Event> events_;
  bool is_sorted_ = true;
  std::int64_t reads_ = 0;
  std::vector<std::vector<TagReply>> spare_;       ///< Emptied, to be filled anew.
  std::vector<ReadBatch::Row> rows_;               ///< Kept to save allocations.
  std::vector<DistanceBatch::Row> distance_rows_;  ///< Likewise.
};

}  // namespace tagfield
