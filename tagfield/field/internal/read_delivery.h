// SPDX-License-Identifier: Apache-2.0
/// @file
/// Delivery of the output of antennas' updates to listeners in chronological order, although it is
/// generated out of order.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
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

/// Inventory slots continue between updates, so an antenna's update yields reads from before other
/// antennas' updates. Reads are kept here until no earlier one can follow; all else is delivered
/// immediately.
class ReadDelivery {
 public:
  explicit ReadDelivery(Outlets outlets) : outlets_(std::move(outlets)) {}

  [[nodiscard]] const Outlets& outlets() const { return outlets_; }

  void add(const TagRead& read, double distance_m);
  /// All reads that read_tags() yields for `antenna` at `p_WA` [m] at `stamp`. They are generated
  /// on delivery, a piece at a time, so that they need not pass through memory; `tags` must not
  /// change until the next tell().
  void add(const std::shared_ptr<const FieldAntenna>& antenna, Time stamp,
           const TagPopulation& tags, const Eigen::Vector3d& p_WA);
  /// All reads of one update at `stamp`, in order; clears `replies`. `tags` must not change, as
  /// above.
  void add(const std::shared_ptr<const FieldAntenna>& antenna, Time stamp,
           const TagPopulation& tags, std::vector<TagReply>& replies);
  /// `antenna`'s update at `stamp`, to be added after its reads.
  void add(const std::shared_ptr<const AntennaInfo>& antenna, Time stamp,
           const RigidTransform& X_WA, const std::optional<RigidTransform>& X_PA);
  /// A tag's position, valid from `stamp` on; with `label` if it is new.
  void add(Time stamp, const TagPosition& tag, std::optional<std::string> label);
  void add_removed(Time stamp, const std::string& tag);
  void add_placed(Time stamp);
  void add_robot(const AntennaPose& robot);

  /// Delivers everything except the reads after `until`. No reads up to `until` may be added
  /// afterwards.
  void tell(Time until);

  /// The reader's reads that the last tell() kept, in chronological order.
  [[nodiscard]] std::vector<TagRead> kept_reads(const std::string& reader) const;

  /// Number of reads added; those that are generated on delivery count from then on.
  [[nodiscard]] std::int64_t reads() const { return reads_; }

 private:
  struct Read {
    TagRead read;
    double distance_m;
  };
  /// Many reads in compact form; the records for listeners are assembled one by one.
  struct Reads {
    std::shared_ptr<const FieldAntenna> antenna;
    const TagPopulation* tags;
    std::vector<TagReply> replies;
  };
  /// Reads that are not generated yet.
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
  /// Generates reads and counts them, a few hundred per call of `take`.
  void make(Time stamp, const Unmade& unmade, const std::function<void(const PaperReads&)>& take);
  TagsInRange& in_range_of(const std::shared_ptr<const FieldAntenna>& antenna);
  void tell_together(const AntennaParameters& antenna, Time stamp, const TagPopulation& tags,
                     std::span<const TagReply> replies);
  void tell_together(const AntennaParameters& antenna, Time stamp, const TagPopulation& tags,
                     const PaperReads& reads);
  /// Delivers `rows_` and `distance_rows_`.
  void tell_rows(const AntennaParameters& antenna, Time stamp) const;
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
  /// By antenna; kept with it, as another could have its address.
  std::map<std::shared_ptr<const FieldAntenna>, TagsInRange> in_range_;
  std::vector<std::vector<TagReply>> spare_;       ///< Emptied buffers, for reuse.
  std::vector<ReadBatch::Row> rows_;               ///< Kept to save allocations.
  std::vector<DistanceBatch::Row> distance_rows_;  ///< Same.
};

}  // namespace tagfield
