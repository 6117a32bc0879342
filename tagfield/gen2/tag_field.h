// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tags that an antenna currently powers.
#pragma once

#include <cstdint>
#include <vector>

namespace tagfield {

/// A powered tag.
struct TagOnAir {
  std::uint32_t tag = 0;            ///< Its index in the population.
  double reply_dbm = 0.0;           ///< Strength of its reply at the reader [dBm].
  double decode_probability = 1.0;  ///< That RN16 and EPC are decoded if alone.
};

/// A list of tags with constant-time lookup.
class TagField {
 public:
  /// Throws Error, and changes nothing, if a tag is listed twice, its strength is not finite or its
  /// probability is not from 0 to 1.
  void assign(const std::vector<TagOnAir>& tags);
  void remove(std::uint32_t tag);

  [[nodiscard]] const std::vector<TagOnAir>& tags() const { return tags_; }
  [[nodiscard]] bool has(std::uint32_t tag) const {
    return tag < places_.size() && places_[tag] != kNone;
  }
  /// The tag, which must be in the list.
  [[nodiscard]] const TagOnAir& at(std::uint32_t tag) const { return tags_[places_[tag]]; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  std::vector<TagOnAir> tags_;
  std::vector<std::uint32_t> places_;  ///< Indices into `tags_`, by tag.
};

}  // namespace tagfield
