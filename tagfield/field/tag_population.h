// SPDX-License-Identifier: Apache-2.0
/// @file
/// All tags that antennas can read, and the reads of one update.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/field/tag_index.h"
#include "tagfield/reader/antenna.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Tags by slot number: their IDs and current poses.
class TagPopulation {
 public:
  /// `cell_m` > 0 as in TagIndex: half of the antennas' range is a good choice.
  explicit TagPopulation(double cell_m) : index_(cell_m), models_{default_tag_model()} {}

  /// Adds a tag at `p_WT` [m] in a slot chosen by its driver, preferably the lowest free one.
  /// Throws Error if the slot or the ID is taken, or the position not finite.
  void add(std::uint32_t slot, const std::string& id, const Eigen::Vector3d& p_WT);
  /// Moves the tag in `slot`. Throws Error if the position is not finite.
  void move(std::uint32_t slot, const Eigen::Vector3d& p_WT) {
    index_.place(slot, p_WT);
    ++version_;
  }
  /// Sets the orientation of the tag in `slot`, which is initially that of the world.
  void turn(std::uint32_t slot, const Eigen::Quaterniond& R_WT) {
    tags_[slot].R_WT = R_WT;
    ++version_;
  }
  /// Sets the kind of the tag in `slot`, initially default_tag_model().
  void set_model(std::uint32_t slot, std::shared_ptr<const TagModel> model);
  /// Removes the tag in `slot`, which must contain one.
  void remove(std::uint32_t slot);

  [[nodiscard]] bool has(std::uint32_t slot) const {
    return slot < tags_.size() && tags_[slot].present;
  }
  [[nodiscard]] const std::string& id(std::uint32_t slot) const { return tags_[slot].id; }
  [[nodiscard]] const Eigen::Vector3d& position(std::uint32_t slot) const {
    return index_.position(slot);
  }
  [[nodiscard]] const Eigen::Quaterniond& rotation(std::uint32_t slot) const {
    return tags_[slot].R_WT;
  }
  [[nodiscard]] RigidTransform pose(std::uint32_t slot) const {
    return {rotation(slot), position(slot)};
  }
  [[nodiscard]] const TagModel& model(std::uint32_t slot) const { return *tags_[slot].model; }
  /// All kinds of tags ever used; the default one is the first.
  [[nodiscard]] const std::vector<std::shared_ptr<const TagModel>>& models() const {
    return models_;
  }
  /// stream_key() of the ID.
  [[nodiscard]] std::uint64_t key(std::uint32_t slot) const { return keys_[slot]; }
  [[nodiscard]] const TagIndex& index() const { return index_; }
  [[nodiscard]] std::size_t size() const { return ids_.size(); }
  /// Increases with each change of any tag: as long as it is unchanged, all tags are.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Calls `visit(slot)` for each tag, in ascending order of slots.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::uint32_t slot = 0; slot < tags_.size(); ++slot) {
      if (tags_[slot].present) visit(slot);
    }
  }

 private:
  struct Tag {
    std::string id;
    bool present = false;
    Eigen::Quaterniond R_WT = Eigen::Quaterniond::Identity();
    const TagModel* model = nullptr;  ///< One of `models_`.
  };

  TagIndex index_;
  std::vector<std::shared_ptr<const TagModel>> models_;
  std::vector<Tag> tags_;
  std::vector<std::uint64_t> keys_;  ///< By slot; contiguous, as each read needs one.
  std::unordered_set<std::string> ids_;
  std::uint64_t version_ = 0;
};

/// An antenna's reply from one tag: a TagRead without the data common to all reads of an antenna.
struct TagReply {
  std::uint32_t slot = 0;
  Time stamp;                 ///< When the tag answered.
  double frequency_hz = 0.0;  ///< Carrier.
  double phase_rad = 0.0;     ///< In [0, 2π).
  double rssi_dbm = 0.0;      ///< An integer in the paper's model.
  double distance_m = 0.0;    ///< The true distance.
  std::optional<double> doppler_hz;
};

/// Tags near an antenna, as columns of the same length, in ascending order of slots.
struct NearTags {
  std::vector<std::uint32_t> slots;
  std::vector<std::uint64_t> keys;  ///< stream_key() of the IDs.
  std::vector<double> distances_m;  ///< From the antenna.
};

/// The tags near an antenna, which stay the same as long as neither it nor any tag moves.
struct TagsInRange {
  const TagPopulation* tags = nullptr;
  std::uint64_t version = 0;  ///< TagPopulation::version().
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();
  double reach_m = -1.0;  ///< At least the antenna's range, which may be perturbed.
  NearTags all;           ///< Within `reach_m`.
  double farthest_m = 0.0;
  NearTags part;  ///< Workspace.
};

/// Reads of one antenna at one time in the paper's model, as columns of the same length.
struct PaperReads {
  std::span<const std::uint32_t> slots;
  std::span<const double> phases_rad;
  std::span<const double> rssis_dbm;
  std::span<const double> distances_m;
  double frequency_hz = 0.0;
};

/// The reads of the antenna's update at `stamp` with the antenna at `p_WA` [m]: of all tags within
/// perturbed_range(), in ascending order of slots, a few hundred per call of `take`. Each equals
/// the result of read_tag() for that tag. None if `p_WA` is not finite. `near` is the antenna's, of
/// the last call.
void read_tags(const AntennaParameters& antenna, const Eigen::Vector3d& p_WA, Time stamp,
               std::uint64_t seed, const TagPopulation& tags, TagsInRange& near,
               const std::function<void(const PaperReads&)>& take);

/// Number `i` of `reads` in the form of a reply.
TagReply to_reply(const PaperReads& reads, std::size_t i, Time stamp);

/// The complete record of a reply.
TagRead to_read(const AntennaParameters& antenna, const std::string& tag, const TagReply& reply);

}  // namespace tagfield
