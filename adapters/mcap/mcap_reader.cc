// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/mcap_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <queue>
#include <utility>
#include <vector>

#include "adapters/mcap/internal/input_file.h"
#include "adapters/mcap/internal/records.h"
#include "adapters/mcap/internal/scan.h"

namespace tagfield {
namespace {

using mcap_internal::Contents;
using mcap_internal::InputFile;
using mcap_internal::message_in;
using mcap_internal::Op;
using mcap_internal::Piece;
using mcap_internal::take_record;

constexpr std::uint64_t kMaxHeldBytes = std::uint64_t{512} << 20U;

/// Log time and position of a message, in an order in which equal times keep their file order.
using Entry = std::pair<std::uint64_t, std::size_t>;

/// The messages of a piece in memory.
struct Held {
  std::string records;
  std::vector<Entry> order;
  std::size_t next = 0;

  [[nodiscard]] std::uint64_t size() const { return records.size() + order.size() * sizeof(Entry); }
};

std::string records_of(InputFile& file, const Piece& piece) {
  const std::string_view bytes = file.view(piece.offset, piece.length);
  if (!piece.is_chunk) return std::string(bytes);
  std::string records;
  if (mcap_internal::open_chunk(bytes, records) != nullptr) {
    fail({file.path(), 0}, "has been changed while it was read");
  }
  return records;
}

Held hold(InputFile& file, const std::set<McapChannelId>& wanted, const Piece& piece) {
  Held held;
  held.records = records_of(file, piece);
  std::string_view rest = held.records;
  for (std::size_t at = 0; const auto record = take_record(rest);
       at = held.records.size() - rest.size()) {
    const auto message = record->op == Op::kMessage ? message_in(record->content) : std::nullopt;
    if (message && wanted.count(message->channel) > 0) {
      held.order.emplace_back(message->log_time_ns, at);
    }
  }
  std::sort(held.order.begin(), held.order.end());
  return held;
}

/// Merges pieces by time: a piece is in memory from when its first message may be next until its
/// last one was passed.
class Merge {
 public:
  Merge(InputFile& file, const Contents& contents, const std::set<McapChannelId>& wanted)
      : file_(file), contents_(contents), wanted_(wanted) {
    for (std::size_t i = 0; i < contents.pieces.size(); ++i) {
      if (has_wanted(contents.pieces[i])) by_time_.push_back(i);
    }
    std::stable_sort(by_time_.begin(), by_time_.end(), [&](std::size_t a, std::size_t b) {
      return contents_.pieces[a].first_ns < contents_.pieces[b].first_ns;
    });
  }

  void run(const std::function<void(const McapMessage&)>& tell) {
    for (hold_what_is_due(); !heads_.empty(); hold_what_is_due()) {
      const std::size_t piece = heads_.top().second;
      heads_.pop();
      Held& held = held_.at(piece);
      std::string_view bytes =
          std::string_view(held.records).substr(held.order[held.next++].second);
      tell(*message_in(take_record(bytes)->content));
      go_on(piece, held);
    }
  }

 private:
  [[nodiscard]] bool has_wanted(const Piece& piece) const {
    return std::any_of(piece.channels.begin(), piece.channels.end(),
                       [&](McapChannelId channel) { return wanted_.count(channel) > 0; });
  }

  void hold_what_is_due() {
    for (; next_ < by_time_.size(); ++next_) {
      const Piece& piece = contents_.pieces[by_time_[next_]];
      if (!heads_.empty() && piece.first_ns > heads_.top().first) return;
      Held& held = held_[by_time_[next_]] = hold(file_, wanted_, piece);
      held_bytes_ += held.size();
      if (held_bytes_ > kMaxHeldBytes) {
        fail({file_.path(), 0}, "has chunks of more than 512 MB that overlap in time");
      }
      go_on(by_time_[next_], held);
    }
  }

  void go_on(std::size_t piece, const Held& held) {
    if (held.next < held.order.size()) {
      heads_.emplace(held.order[held.next].first, piece);
      return;
    }
    held_bytes_ -= held.size();
    held_.erase(piece);
  }

  InputFile& file_;
  const Contents& contents_;
  const std::set<McapChannelId>& wanted_;
  std::vector<std::size_t> by_time_;  ///< Pieces by their first message.
  std::size_t next_ = 0;              ///< Index of the next of these.
  std::map<std::size_t, Held> held_;
  std::uint64_t held_bytes_ = 0;
  /// The next message of each piece in memory: its time, and the piece.
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heads_;
};

}  // namespace

struct McapReader::State {
  InputFile file;
  Contents contents;
};

McapReader::McapReader(const std::string& path, Diagnostics& diagnostics)
    : state_(new State{InputFile(path), {}}) {
  state_->contents = mcap_internal::scan(state_->file, diagnostics);
}

McapReader::~McapReader() = default;

const std::string& McapReader::profile() const { return state_->contents.profile; }

const std::map<McapChannelId, McapChannel>& McapReader::channels() const {
  return state_->contents.channels;
}

const std::map<std::uint16_t, std::shared_ptr<const McapSchema>>& McapReader::schemas() const {
  return state_->contents.schemas;
}

std::uint64_t McapReader::message_count(McapChannelId channel) const {
  const auto found = state_->contents.counts.find(channel);
  return found == state_->contents.counts.end() ? 0 : found->second;
}

void McapReader::read(const std::function<void(const McapMessage&)>& tell) {
  std::set<McapChannelId> all;
  for (const auto& [id, channel] : channels()) all.insert(id);
  read(all, tell);
}

void McapReader::read(const std::set<McapChannelId>& wanted,
                      const std::function<void(const McapMessage&)>& tell) {
  std::set<McapChannelId> known;
  for (const McapChannelId id : wanted) {
    if (channels().count(id) > 0) known.insert(id);
  }
  Merge(state_->file, state_->contents, known).run(tell);
}

}  // namespace tagfield
