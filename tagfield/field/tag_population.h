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

/// Tags under slot numbers: their IDs and where they are now.
class TagPopulation {
 public:
  /// `cell_m` > 0 as in TagIndex: half of the antennas' range serves well.
  explicit TagPopulation(double cell_m) : index_(cell_m), models_{default_tag_model()} {}

  /// Adds a tag at `p_WT` [m] in a slot that its driver chose, best among the lowest that are free.
  /// Throws Error if the slot or the ID is taken, or the position not finite.
  void add(std::uint32_t slot, const std::string& id, const Eigen::Vector3d& p_WT);
  /// Moves the tag in `slot`. Throws Error if the position is not finite.
  void move(std::uint32_t slot, const Eigen::Vector3d& p_WT) {
    index_.place(slot, p_WT);
    ++version_;
  }
  /// Turns the tag in `slot`, which lies as the world does where it is not told.
  void turn(std::uint32_t slot, const Eigen::Quaterniond& R_WT) {
    tags_[slot].R_WT = R_WT;
    ++version_;
  }
  /// Says what kind of tag is in `slot`; default_tag_model() where it is not told.
  void set_model(std::uint32_t slot, std::shared_ptr<const TagModel> model);
  /// Takes out the tag in `slot`, which must hold one.
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
  /// All kinds of tags that were ever told of; the default one is the first.
  [[nodiscard]] const std::vector<std::shared_ptr<const TagModel>>& models() const {
    return models_;
  }
  /// stream_key() of the ID.
  [[nodiscard]] std::uint64_t key(std::uint32_t slot) const { return keys_[slot]; }
  [[nodiscard]] const TagIndex& index() const { return index_; }
  [[nodiscard]] std::size_t size() const { return ids_.size(); }
  /// Grows with each change of any tag: while it stays, all are where and what they were.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Calls `visit(slot)` for each tag, in rising order of slots.
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
  std::vector<std::uint64_t> keys_;  ///< By slot, close together: each read needs one.
  std::unordered_set<std::string> ids_;
  std::uint64_t version_ = 0;
};

/// What an antenna sees of one tag: a TagRead without what all of an antenna have in common.
struct TagReply {
  std::uint32_t slot = 0;
  Time stamp;                 ///< When the tag answered.
  double frequency_hz = 0.0;  ///< Carrier.
  double phase_rad = 0.0;     ///< In [0, 2π).
  double rssi_dbm = 0.0;      ///< A whole number by the paper's model.
  double distance_m = 0.0;    ///< The truth behind it.
  std::optional<double> doppler_hz;
};

/// The reads of the antenna's update at `stamp` with the antenna at `p_WA` [m]: of all tags within
/// perturbed_range(), in rising order of slots, some hundreds a call of `take`. Each is what
/// read_tag() gives for that tag. None where `p_WA` is not finite.
void read_tags(const AntennaParameters& antenna, const Eigen::Vector3d& p_WA, Time stamp,
               std::uint64_t seed, const TagPopulation& tags,
               const std::function<void(std::span<const TagReply>)>& take);

/// The whole record of a reply.
TagRead to_read(const AntennaParameters& antenna, const std::string& tag, const TagReply& reply);

}  // namespace tagfield
