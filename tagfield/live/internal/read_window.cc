// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/internal/read_window.h"

#include <algorithm>
#include <set>

namespace tagfield {
namespace {

/// Fewer new reads would hardly change an estimate.
constexpr std::size_t kMinFresh = 5;
/// Least number of reads kept per tag, however many tags there are.
constexpr std::size_t kMinShare = 100;

}  // namespace

std::uint32_t ReadWindow::antenna_number(const std::string& name) {
  const auto [entry, is_new] = numbers_.emplace(name, static_cast<std::uint32_t>(antennas_.size()));
  if (is_new) antennas_.push_back({name, "", {}});
  return entry->second;
}

std::size_t ReadWindow::share() const {
  return std::max(kMinShare, max_reads_ / std::max<std::size_t>(1, tags_.size()));
}

void ReadWindow::drop_oldest(Tag& tag) {
  tag.reads.pop_front();
  tag.fresh = std::min(tag.fresh, tag.reads.size());
  --size_;
}

void ReadWindow::drop_outdated(Tag& tag) {
  while (!tag.reads.empty() && tag.reads.front().stamp < newest_ - length_) drop_oldest(tag);
}

void ReadWindow::add(const TagRead& read) {
  const std::uint32_t antenna = antenna_number(read.antenna);
  antennas_[antenna].reader = read.reader;
  newest_ = std::max(newest_, read.stamp);
  if (newest_ > swept_ + length_) sweep();
  Tag& tag = tags_[read.tag];
  tag.reads.push_back({read.stamp, antenna, read.frequency_hz, read.phase_rad, read.rssi_dbm});
  ++tag.fresh;
  ++size_;
  drop_outdated(tag);
  while (tag.reads.size() > share()) drop_oldest(tag);
}

/// Called from time to time, so that tags that are no longer read are dropped, too.
void ReadWindow::sweep() {
  swept_ = newest_;
  for (auto entry = tags_.begin(); entry != tags_.end();) {
    drop_outdated(entry->second);
    entry = entry->second.reads.empty() ? tags_.erase(entry) : std::next(entry);
  }
}

void ReadWindow::forget_reads_of(std::uint32_t antenna) {
  for (auto& [name, tag] : tags_) {
    const auto is_its = [antenna](const Read& read) { return read.antenna == antenna; };
    const auto kept = std::remove_if(tag.reads.begin(), tag.reads.end(), is_its);
    size_ -= static_cast<std::size_t>(tag.reads.end() - kept);
    tag.reads.erase(kept, tag.reads.end());
    tag.fresh = tag.reads.size();
  }
}

void ReadWindow::add(const AntennaPose& pose, bool is_fixed) {
  const std::uint32_t number = antenna_number(pose.antenna);
  std::deque<AntennaPose>& poses = antennas_[number].poses;
  newest_ = std::max(newest_, pose.stamp);
  if (!is_fixed) {
    poses.push_back(pose);
    while (poses.front().stamp < newest_ - length_) poses.pop_front();
    return;
  }
  const bool is_elsewhere =
      poses.size() != 1 || !(poses.front().X_WA.translation == pose.X_WA.translation &&
                             poses.front().X_WA.rotation.coeffs() == pose.X_WA.rotation.coeffs());
  if (!is_elsewhere) return;
  if (!poses.empty()) forget_reads_of(number);
  poses.assign(1, pose);
}

void ReadWindow::clear() {
  tags_.clear();
  antennas_.clear();
  numbers_.clear();
  size_ = 0;
  newest_ = swept_ = Time{};
}

std::vector<std::map<std::string, ReadWindow::Tag>::iterator> ReadWindow::due(std::size_t most) {
  std::vector<std::map<std::string, Tag>::iterator> all;
  for (auto entry = tags_.begin(); entry != tags_.end(); ++entry) {
    drop_outdated(entry->second);
    const Tag& tag = entry->second;
    if (tag.fresh >= kMinFresh && 10 * tag.fresh >= tag.reads.size()) all.push_back(entry);
  }
  const auto share_of_fresh = [](const Tag& tag) {
    return static_cast<double>(tag.fresh) / static_cast<double>(tag.reads.size());
  };
  std::stable_sort(all.begin(), all.end(), [&](const auto& one, const auto& other) {
    return share_of_fresh(one->second) > share_of_fresh(other->second);
  });
  if (all.size() > most) all.resize(most);
  return all;
}

WindowedReads ReadWindow::take(std::size_t most) {
  WindowedReads taken;
  std::set<std::uint32_t> heard;
  for (const auto& entry : due(most)) {
    Tag& tag = entry->second;
    tag.fresh = 0;
    for (const Read& read : tag.reads) {
      const Antenna& antenna = antennas_[read.antenna];
      heard.insert(read.antenna);
      taken.reads.push_back({read.stamp, antenna.reader, antenna.name, entry->first,
                             read.frequency_hz, read.phase_rad, read.rssi_dbm});
    }
  }
  for (const std::uint32_t antenna : heard) {
    const std::deque<AntennaPose>& poses = antennas_[antenna].poses;
    taken.poses.insert(taken.poses.end(), poses.begin(), poses.end());
  }
  return taken;
}

}  // namespace tagfield
