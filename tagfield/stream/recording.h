// SPDX-License-Identifier: Apache-2.0
/// @file
/// The whole output of a run, kept in memory.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tagfield/stream/listeners.h"

namespace tagfield {

/// The output of a run, in chronological order.
struct Recording {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> believed_poses;  ///< A fixed antenna has one row.
  Truth truth;
};

/// Decides which poses are recorded: for a fixed antenna, only the first.
class FirstPoses {
 public:
  bool is_new(const AntennaInfo& antenna) {
    return !antenna.is_fixed || seen_.insert(antenna.name).second;
  }
  void forget(const std::string& antenna) { seen_.erase(antenna); }

 private:
  std::set<std::string> seen_;
};

/// Appends everything it receives to a recording, which must outlive it.
class Recorder final : public ReadListener, public PoseListener, public TruthListener {
 public:
  explicit Recorder(Recording& recording) : recording_(recording) {}

  void on_read(const TagRead& read) override { recording_.reads.push_back(read); }
  // Rows are constructed in place: copying their names twice would take longer than all else.
  void on_reads(const ReadBatch& batch) override {
    for (const ReadBatch::Row& row : batch.rows) recording_.reads.emplace_back(ReadOf{batch, row});
  }
  void on_antenna_removed(const std::string& name) override {
    believed_.forget(name);
    placed_.forget(name);
  }
  void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) override {
    if (believed_.is_new(antenna)) recording_.believed_poses.push_back(pose);
  }
  void on_tag_added(const TagPosition& tag, const std::string& /*label*/) override {
    recording_.truth.tag_positions.push_back(tag);
  }
  void on_tag_moved(const TagPosition& tag) override {
    recording_.truth.tag_positions.push_back(tag);
  }
  void on_robot_pose(const AntennaPose& robot) override {
    recording_.truth.robot_poses.push_back(robot);
  }
  void on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) override {
    if (placed_.is_new(antenna)) recording_.truth.antenna_poses.push_back(pose);
  }
  void on_distance(const TrueDistance& distance) override {
    recording_.truth.distances.push_back(distance);
  }
  void on_distances(const DistanceBatch& batch) override {
    for (const DistanceBatch::Row& row : batch.rows) {
      recording_.truth.distances.emplace_back(DistanceOf{batch, row});
    }
  }

 private:
  /// Converts to a read in place: emplace_back() doesn't accept the members of a plain struct with
  /// all compilers.
  struct ReadOf {
    const ReadBatch& batch;
    const ReadBatch::Row& row;
    explicit operator TagRead() const {
      return {batch.stamp,      batch.reader,  batch.antenna, *row.tag,
              row.frequency_hz, row.phase_rad, row.rssi_dbm,  row.doppler_hz};
    }
  };
  struct DistanceOf {
    const DistanceBatch& batch;
    const DistanceBatch::Row& row;
    explicit operator TrueDistance() const {
      return {batch.stamp, batch.antenna, *row.tag, row.distance_m};
    }
  };

  Recording& recording_;
  FirstPoses believed_;
  FirstPoses placed_;
};

/// Outlets that keep the whole run in `recording`, which must outlive them.
inline Outlets recorded_in(Recording& recording) {
  Outlets outlets;
  attach(std::make_shared<Recorder>(recording), outlets);
  return outlets;
}

}  // namespace tagfield
