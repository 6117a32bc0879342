// SPDX-License-Identifier: Apache-2.0
/// @file
/// The last minutes of reads and antenna poses, from which tags are located again and again.
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

/// What some tags are to be located from.
struct WindowedReads {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
};

/// Keeps, of what came within `length` of the newest stamp, at most `most_reads` in all, each tag
/// an equal share; a tag loses its oldest.
class ReadWindow {
 public:
  ReadWindow(Duration length, std::size_t most_reads) : length_(length), most_reads_(most_reads) {}

  void add(const TagRead& read);
  /// An antenna's pose X_WA. Of one at rest only the last counts; what it read from elsewhere is
  /// forgotten.
  void add(const AntennaPose& pose, bool is_fixed);
  void clear();

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Reads of those tags of which the largest share is new since they were last taken, `most` at
  /// most, and the poses of their antennas. A tag's turn comes once five reads, and a tenth of all
  /// it has, are new.
  WindowedReads take(std::size_t most);

 private:
  struct Read {
    Time stamp;
    std::uint32_t antenna;  ///< In antennas_.
    double frequency_hz, phase_rad, rssi_dbm;
  };
  struct Tag {
    std::deque<Read> reads;
    std::size_t fresh = 0;  ///< How many of the last have not been taken.
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
  std::size_t most_reads_;
  std::size_t size_ = 0;  ///< Of all reads.
  Time newest_{};
  Time swept_{};
  std::map<std::string, Tag> tags_;
  std::vector<Antenna> antennas_;
  std::map<std::string, std::uint32_t> numbers_;
};

}  // namespace tagfield
