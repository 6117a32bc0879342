// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/held_reads.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

TagRead&& with_wrapped_phase(TagRead&& read) {
  read.phase_rad = wrap_to_two_pi(read.phase_rad);
  return std::move(read);
}

/// Reads the recording again and passes on what follows after that many resets.
void tell_again(const std::string& path, const GoThrough& go_through, std::size_t resets,
                std::size_t count, const BagReads& to) {
  std::size_t resets_left = resets;
  std::size_t passed_on = 0;
  const BagReadSink sink{[&](TagRead&& read, const std::string& /*frame*/) {
                           if (resets_left > 0) return;
                           ++passed_on;
                           if (to.on_read) to.on_read(with_wrapped_phase(std::move(read)));
                         },
                         [&](TrueDistance&& distance) {
                           if (resets_left == 0 && to.on_distance) to.on_distance(distance);
                         },
                         [&] { resets_left -= resets_left > 0 ? 1 : 0; }, true};
  Diagnostics reported_before;
  go_through(sink, to.on_progress, reported_before);
  if (passed_on == count) return;
  fail({path, 0}, fmt::format("had {} reads at first and {} when they were read again: expected a "
                              "recording that does not change",
                              count, passed_on));
}

}  // namespace

BagReadSink HeldReads::sink() {
  return {[this](TagRead&& read, const std::string& frame) { add(std::move(read), frame); },
          [this](TrueDistance&& distance) { add(std::move(distance)); },
          [this] { *this = HeldReads(most_, resets_ + 1); }};
}

void HeldReads::give(BagContent& content, BagRecording& recording) {
  recording.reads = std::move(reads_);
  content.truth.distances = std::move(distances_);
  content.updates.insert(content.updates.end(), std::make_move_iterator(updates_.begin()),
                         std::make_move_iterator(updates_.end()));
}

void HeldReads::add(TagRead&& read, const std::string& frame) {
  units_.add_carrier(read.frequency_hz);
  units_.add_phase(read.phase_rad);
  if (overview_) return tagfield::add(read, *overview_);
  if (updates_.empty() || updates_.back().stamp != read.stamp ||
      updates_.back().antenna != read.antenna) {
    updates_.push_back({read.stamp, read.antenna, frame});
  }
  reads_.push_back(with_wrapped_phase(std::move(read)));
  if (reads_.size() > most_) hold_no_more();
}

void HeldReads::add(TrueDistance&& distance) {
  has_distances_ = true;
  if (overview_) return;
  distances_.push_back(std::move(distance));
  if (distances_.size() > most_) hold_no_more();
}

void HeldReads::hold_no_more() {
  overview_ = overview_of(reads_);
  std::vector<TagRead>().swap(reads_);
  std::vector<TrueDistance>().swap(distances_);
  std::vector<RecordedUpdate>().swap(updates_);
}

UnreportedReads unreported_reads(const std::string& path, const GoThrough& go_through,
                                 const HeldReads& held) {
  const std::size_t count = held.overview()->count;
  return {*held.overview(), held.has_distances(),
          [path, go_through, resets = held.resets(), count](const BagReads& to) {
            tell_again(path, go_through, resets, count, to);
          }};
}

}  // namespace tagfield
