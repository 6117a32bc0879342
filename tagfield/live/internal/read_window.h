// SPDX-License-Identifier: Apache-2.0
/// @file
/// The last minutes of reads and antenna poses, from which tags are repeatedly located.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Input for locating some tags.
struct WindowedReads {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
};

/// Keeps the reads and poses within `length` of the newest timestamp, at most `max_reads` reads in
/// all, divided equally among the tags, but at least 100 each. A tag loses its oldest reads first.
class ReadWindow {
 public:
  ReadWindow(Duration length, std::size_t max_reads) : length_(length), max_reads_(max_reads) {}

  void add(const TagRead& read);
  /// Adds an antenna's pose X_WA. For a fixed antenna only the last one counts, and reads from
  /// other poses are forgotten.
  void add(const AntennaPose& pose, bool is_fixed);
  void clear();

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Takes the reads of at most `most` tags, those with the largest fraction of reads new since
  /// last taken, and the poses of their antennas. A tag becomes due once at least five of its
  /// reads, and a tenth of them, are new.
  WindowedReads take(std::size_t most);

 private:
  struct Read {
    Time stamp;
    std::uint32_t antenna;  ///< Index into antennas_.
    double frequency_hz, phase_rad, rssi_dbm;
  };
  struct Tag {
    std::deque<Read> reads;
    std::size_t fresh = 0;  ///< Number of the latest reads not yet taken.
  };
  struct Antenna {
    std::string name, reader;
    std::deque<AntennaPose> poses;
  };

  std::uint32_t antenna_number(const std::string& name);
  [[nodiscard]] std::size_t share() const;
  void drop_oldest(Tag& tag);
  void drop_outdated(Tag& tag);
  void forget_reads_of(std::uint32_t antenna);
  void sweep();
  [[nodiscard]] std::vector<std::map<std::string, Tag>::iterator> due(std::size_t most);

  Duration length_;
  std::size_t max_reads_;
  std::size_t size_ = 0;  ///< Total number of reads.
  Time newest_{};
  Time swept_{};
  std::map<std::string, Tag> tags_;
  std::vector<Antenna> antennas_;
  std::map<std::string, std::uint32_t> numbers_;
};

}  // namespace tagfield
