// SPDX-License-Identifier: Apache-2.0
/// @file
/// All antennas with physical models, the air that they share, and their reads.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/field/body_motion.h"
#include "tagfield/field/image_cache.h"
#include "tagfield/field/port_turns.h"
#include "tagfield/field/radio_link.h"
#include "tagfield/field/reader_interference.h"
#include "tagfield/field/tag_coupling.h"
#include "tagfield/field/tag_motion.h"
#include "tagfield/field/tag_population.h"
#include "tagfield/gen2/inventory.h"
#include "tagfield/gen2/tag_memories.h"

namespace tagfield {

struct AirAntenna;

/// With at most this many tags, those at rest keep their images, which is cheaper than computing
/// the antenna's at every update.
inline constexpr std::size_t kMaxTagsWithImages = 64;

/// Generates the reads of antennas update by update. Without an inventory, an antenna reads every
/// tag within range once per update. With one, slots continue between updates: the reads since the
/// last update are returned by the next one, each with its own stamp, with the poses of both ends
/// interpolated to that time. Not thread-safe.
class RadioAir {
 public:
  /// `world` must not be null. Paths to many tags are traced on up to `threads` threads, on which
  /// the results don't depend.
  explicit RadioAir(std::shared_ptr<const RadioWorld> world, int threads = 1);
  ~RadioAir();
  RadioAir(RadioAir&&) noexcept;
  RadioAir& operator=(RadioAir&&) noexcept;

  /// The antenna takes part from its next update on; it must be a physical one. Readers take turns
  /// with their antennas in the order in which these were added.
  void add(const AntennaParameters& antenna, std::uint64_t seed);
  /// No effect if there is no such antenna.
  void remove(const std::string& antenna);
  /// Replaces the world; must not be null.
  void set_world(std::shared_ptr<const RadioWorld> world);
  /// Sets the moving bodies' poses at `now`; to be called before the updates of that time.
  void see(const std::vector<MovingBody>& bodies, Time now);
  /// To be called before the slot is reused for another tag.
  void forget_tag(std::uint32_t slot);

  /// Announces that the antenna is about to update at `X_WA`, which antennas that it interferes
  /// with must know before their own updates of that time. No effect if the pose is not finite, or
  /// if there is no such antenna.
  void expect(const std::string& antenna, const RigidTransform& X_WA);
  /// Updates the antenna at `X_WA` at `now`, which must not decrease: writes the reads since its
  /// last update to `replies` (cleared first), in chronological order. `tags` are at their current
  /// poses. No reads and no update if `X_WA` is not finite. Throws Error if there is no such
  /// antenna.
  void update(const std::string& antenna, const RigidTransform& X_WA, Time now,
              const TagPopulation& tags, std::vector<TagReply>& replies);

  /// The antenna never updates again, so nothing waits for its reads.
  void expect_no_more_of(const std::string& antenna);
  /// No later update yields a read from before this time.
  [[nodiscard]] Time complete_until() const;

  /// Outcomes of the antenna's slots; nullopt without an inventory.
  [[nodiscard]] std::optional<InventoryCounts> counts(const std::string& antenna) const;

 private:
  AirAntenna& antenna_named(const std::string& name);
  void plan_turns();
  void run_inventories(Time begin, Time now, const TagPopulation& tags);
  void run_piece(Time begin, Time end, const TagPopulation& tags);
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
                AirAntenna& antenna, RadioView& view, TagSurroundings& around);
  std::vector<OtherSender> others_of(AirAntenna& antenna, Time now);
  void look_at_others(AirAntenna& antenna, RadioView& view, const std::vector<OtherSender>& others);
  Disturbance disturbance_of(const AirAntenna& antenna, const std::vector<OtherSender>& others,
                             const TagEnd& tag);
  TagEnd tag_end(AirAntenna& antenna, std::uint32_t slot, const TagPopulation& tags,
                 RadioView& view, TagSurroundings& around);
  void compute_links(const RadioView& view);
  template <class Visit>
  void for_each_link(AirAntenna& antenna, const TagPopulation& tags, RadioView& view,
                     const Visit& visit);
  void refresh_field(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                     const TagPopulation& tags);
  void find_powered(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                    const TagPopulation& tags);

  std::shared_ptr<const RadioWorld> world_;
  int threads_ = 1;
  std::unique_ptr<TagMemories> memories_;              ///< Inventories keep pointers to it.
  std::vector<std::unique_ptr<AirAntenna>> antennas_;  ///< In the order in which they were added.
  std::vector<PortCycle> cycles_;
  TagMotion motion_;  ///< Of the tags up to the last update; inventories have run up to it.
  BodyMotion bodies_;
  ImageCache tag_images_;
  TagCouplings couplings_;        ///< Of the tags at the last update, if an antenna needs them.
  bool couplings_seen_ = false;   ///< Already updated for this update.
  std::vector<RadioPath> paths_;  ///< Workspace, as are the following.
  std::vector<std::uint32_t> slots_;
  std::vector<TagSurroundings> arounds_;  ///< Of the following tags.
  std::vector<TagEnd> ends_;
  std::vector<RadioLink> links_;  ///< To the same tags.
  std::vector<TagOnAir> field_;
  std::vector<Singulation> read_;
};

}  // namespace tagfield
