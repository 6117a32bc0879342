// SPDX-License-Identifier: Apache-2.0
/// @file
/// All antennas of physical models, the air that they share, and what they read.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/field/image_cache.h"
#include "tagfield/field/port_turns.h"
#include "tagfield/field/radio_link.h"
#include "tagfield/field/reader_interference.h"
#include "tagfield/field/tag_coupling.h"
#include "tagfield/field/tag_population.h"
#include "tagfield/gen2/inventory.h"
#include "tagfield/gen2/tag_memories.h"

namespace tagfield {

struct AirAntenna;

/// Makes reads of what antennas say of themselves update by update. Without an inventory an antenna
/// reads all that it hears, once an update. With one, slots go on between the updates: what was
/// read since the last one comes out with the next, each read with a stamp of its own, the ends'
/// places interpolated at that. Not thread-safe.
class RadioAir {
 public:
  /// `world` must not be null.
  explicit RadioAir(std::shared_ptr<const RadioWorld> world);
  ~RadioAir();
  RadioAir(RadioAir&&) noexcept;
  RadioAir& operator=(RadioAir&&) noexcept;

  /// From its next update on; it must be a physical one. Readers take their antennas' turns in
  /// the order in which they came.
  void add(const AntennaParameters& antenna, std::uint64_t seed);
  /// Nothing where there is no such antenna.
  void remove(const std::string& antenna);
  /// The world is another one from now on; must not be null.
  void set_world(std::shared_ptr<const RadioWorld> world);
  /// What moves is here at `now`; to be told before the updates of that time.
  void see(const std::vector<MovingBody>& bodies, Time now);
  /// Before the slot is another tag's.
  void forget_tag(std::uint32_t slot);

  /// The antenna is about to update at `X_WA`, as others that it disturbs shall know before their
  /// own updates of that time. Nothing where that is not finite, or there is no such antenna.
  void expect(const std::string& antenna, const RigidTransform& X_WA);
  /// The antenna is at `X_WA` at `now`, which must not go back: into `replies` (emptied first) what
  /// it has read since its last update, in order of time. `tags` are where they are now. None, and
  /// no update, where `X_WA` is not finite. Throws Error if the antenna is not there.
  void update(const std::string& antenna, const RigidTransform& X_WA, Time now,
              const TagPopulation& tags, std::vector<TagReply>& replies);

  /// The antenna never updates again, so nothing is waited for of it.
  void expect_no_more_of(const std::string& antenna);
  /// Up to then, no update to come yields a read that was made earlier.
  [[nodiscard]] Time complete_until() const;

  /// What the antenna's slots came to; none without an inventory.
  [[nodiscard]] std::optional<InventoryCounts> counts(const std::string& antenna) const;

 private:
  AirAntenna& antenna_named(const std::string& name);
  void plan_turns();
  void run_inventories(Time now, const TagPopulation& tags);
  void run_piece(Time begin, Time end, const TagPopulation& tags);
  void remember_places(Time now, const TagPopulation& tags);
  [[nodiscard]] RigidTransform tag_pose(std::uint32_t slot, Time stamp,
                                        const TagPopulation& tags) const;
  [[nodiscard]] Eigen::Vector3d tag_velocity(std::uint32_t slot) const;
  bool sees_the_same(AirAntenna& antenna, const RigidTransform& X_WA, const TagPopulation& tags);
  RadioLink link_of_read(AirAntenna& antenna, const RigidTransform& X_WA,
                         const RigidTransform& X_WT, std::uint32_t slot, Time stamp,
                         double frequency_hz, const TagPopulation& tags);
  void read_pending(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                    const TagPopulation& tags, std::vector<TagReply>& replies);
  void read_all(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                const TagPopulation& tags, std::vector<TagReply>& replies);
  [[nodiscard]] std::vector<MovingBody> bodies_at(const RadioModel& model, Time stamp) const;
  const ImageSet* tag_images(const RadioView& view, std::uint32_t slot, const RigidTransform& X_WT);
  void surround(TagEnd& tag, std::uint32_t slot, Time stamp, const TagPopulation& tags,
                AirAntenna& antenna, RadioView& view);
  std::vector<OtherSender> others_of(AirAntenna& antenna, Time now);
  void look_at_others(AirAntenna& antenna, RadioView& view, const std::vector<OtherSender>& others);
  Disturbance disturbance_of(const AirAntenna& antenna, const std::vector<OtherSender>& others,
                             const TagEnd& tag);
  TagEnd tag_end(AirAntenna& antenna, std::uint32_t slot, const TagPopulation& tags,
                 RadioView& view);
  template <class Visit>
  void for_each_link(AirAntenna& antenna, const TagPopulation& tags, RadioView& view,
                     const Visit& visit);
  void refresh_field(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                     const TagPopulation& tags);
  void find_powered(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                    const TagPopulation& tags);

  std::shared_ptr<const RadioWorld> world_;
  std::unique_ptr<TagMemories> memories_;  ///< Where inventories can go on pointing to it.
  std::vector<std::unique_ptr<AirAntenna>> antennas_;  ///< As they came.
  std::vector<PortCycle> cycles_;
  Time before_{};                               ///< The last update but one at another time,
  std::optional<Time> ran_to_;                  ///< and the last, as far as inventories have come.
  std::vector<Eigen::Vector3d> places_before_;  ///< Where tags were, by slot; NaN where not known.
  std::vector<Eigen::Vector3d> places_;
  /// What moves, at the last update but one at another time, and at the last.
  std::vector<MovingBody> bodies_before_;
  std::vector<MovingBody> bodies_;
  Time bodies_seen_before_{};
  Time bodies_seen_{};
  ImageCache tag_images_;
  TagCouplings couplings_;        ///< Of the last update's tags, where an antenna asks for it.
  bool couplings_seen_ = false;   ///< In this update.
  TagSurroundings around_;        ///< Of the link in work.
  std::vector<RadioPath> paths_;  ///< Workspace, like these.
  std::vector<std::uint32_t> slots_;
  std::vector<TagOnAir> field_;
  std::vector<Singulation> read_;
};

}  // namespace tagfield
