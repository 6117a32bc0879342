// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/tag_field.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/range_check.h"

namespace tagfield {
namespace {

void check(const TagOnAir& tag) {
  // Names are formatted only for error messages, since each tag is checked in each round.
  if (!std::isfinite(tag.reply_dbm)) {
    require(false, fmt::format("reply_dbm of tag {}", tag.tag), "finite", tag.reply_dbm);
  }
  if (!(tag.decode_probability >= 0.0 && tag.decode_probability <= 1.0)) {
    require(false, fmt::format("decode_probability of tag {}", tag.tag), "from 0 to 1",
            tag.decode_probability);
  }
}

}  // namespace

void TagField::assign(const std::vector<TagOnAir>& tags) {
  std::vector<std::uint32_t> places;
  for (std::uint32_t i = 0; i < tags.size(); ++i) {
    check(tags[i]);
    const std::uint32_t tag = tags[i].tag;
    if (tag >= places.size()) places.resize(tag + std::size_t{1}, kNone);
    if (places[tag] != kNone) throw Error(fmt::format("tag {} is in the field twice", tag));
    places[tag] = i;
  }
  tags_ = tags;
  places_ = std::move(places);
}

void TagField::remove(std::uint32_t tag) {
  if (!has(tag)) return;
  const std::uint32_t place = places_[tag];
  tags_.erase(tags_.begin() + place);
  places_[tag] = kNone;
  for (std::uint32_t i = place; i < tags_.size(); ++i) places_[tags_[i].tag] = i;
}

}  // namespace tagfield
