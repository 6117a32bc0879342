// SPDX-License-Identifier: Apache-2.0
/// @file
/// Interfaces for the output of a run while it runs: reads, reported poses and, separate from them,
/// the ground truth. Limited to C++17, because the ROS 1 adapters include it together with the
/// message headers of ROS 1, which are C++17.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

/// An antenna, as known to outlets.
struct AntennaInfo {
  std::string name;          ///< Unique over all readers.
  std::string reader;        ///< Name of its reader.
  std::string sensor;        ///< Name of its sensor; "" if there is none.
  std::string name_space;    ///< Namespace of its topics; "" for none.
  std::string frame_id;      ///< Frame A of the antenna.
  std::string parent_frame;  ///< Frame P in which its pose is reported; "" for the world.
  double range_m = 0.0;      ///< Nominal range, e.g. for drawing.
  bool is_fixed = false;     ///< It doesn't move in the world.
  bool reports_doppler = false;
};

/// Reads of one antenna at one time. Names are valid only during the call.
struct ReadBatch {
  struct Row {
    const std::string* tag = nullptr;  ///< Its ID; never null.
    double frequency_hz = 0.0;         ///< As in TagRead.
    double phase_rad = 0.0;
    double rssi_dbm = 0.0;
    std::optional<double> doppler_hz{};
  };
  Time stamp;
  const std::string& reader;
  const std::string& antenna;
  const std::vector<Row>& rows;
};

/// The distances of the reads in a ReadBatch, in the same order.
struct DistanceBatch {
  struct Row {
    const std::string* tag = nullptr;  ///< Its ID; never null.
    double distance_m = 0.0;
  };
  Time stamp;
  const std::string& antenna;
  const std::vector<Row>& rows;
};

/// Receives reads. All calls come from one thread at a time.
class ReadListener {
 public:
  ReadListener() = default;
  virtual ~ReadListener() = default;
  ReadListener(const ReadListener&) = delete;
  ReadListener& operator=(const ReadListener&) = delete;

  /// One read. Over all antennas, stamps never decrease until on_restart().
  virtual void on_read(const TagRead& read) = 0;
  /// Many reads in one call, for listeners that process batches faster than single reads.
  virtual void on_reads(const ReadBatch& batch) {
    TagRead read{batch.stamp, batch.reader, batch.antenna, {}};
    for (const ReadBatch::Row& row : batch.rows) {
      read.tag = *row.tag;
      read.frequency_hz = row.frequency_hz;
      read.phase_rad = row.phase_rad;
      read.rssi_dbm = row.rssi_dbm;
      read.doppler_hz = row.doppler_hz;
      on_read(read);
    }
  }
  /// The antenna's update at `stamp`, after its reads except those that reads of other antennas may
  /// still precede.
  virtual void on_update(const AntennaInfo& /*antenna*/, Time /*stamp*/) {}
  virtual void on_antenna_added(const AntennaInfo& /*antenna*/) {}
  virtual void on_antenna_removed(const std::string& /*name*/) {}
  /// Time jumps back: all that follows belongs to another run.
  virtual void on_restart() {}
};

/// Receives the antennas' poses as reported: from their mount, or from a robot's pose estimate.
class PoseListener {
 public:
  PoseListener() = default;
  virtual ~PoseListener() = default;
  PoseListener(const PoseListener&) = delete;
  PoseListener& operator=(const PoseListener&) = delete;

  /// Called at an update, before its ReadListener::on_update(): X_PA in antenna.parent_frame.
  virtual void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) = 0;
};

/// Receives the ground truth, for evaluation or drawing.
class TruthListener {
 public:
  TruthListener() = default;
  virtual ~TruthListener() = default;
  TruthListener(const TruthListener&) = delete;
  TruthListener& operator=(const TruthListener&) = delete;

  /// `label` is the tag's name in the driver's world; "" if it has none.
  virtual void on_tag_added(const TagPosition& /*tag*/, const std::string& /*label*/) {}
  virtual void on_tag_moved(const TagPosition& /*tag*/) {}
  virtual void on_tag_removed(const std::string& /*id*/) {}
  /// All tags that appeared, disappeared or moved up to `stamp` have been reported.
  virtual void on_tags_placed(Time /*stamp*/) {}
  virtual void on_robot_pose(const AntennaPose& /*robot*/) {}
  /// Called at an update, before its ReadListener::on_update().
  virtual void on_antenna_pose(const AntennaInfo& /*antenna*/, const AntennaPose& /*pose*/) {}
  /// The distance of a read, before the read; for a batch of reads, all distances come before the
  /// first read.
  virtual void on_distance(const TrueDistance& /*distance*/) {}
  /// Many distances in one call, before the corresponding ReadListener::on_reads().
  virtual void on_distances(const DistanceBatch& batch) {
    TrueDistance distance{batch.stamp, batch.antenna, {}};
    for (const DistanceBatch::Row& row : batch.rows) {
      distance.tag = *row.tag;
      distance.distance_m = row.distance_m;
      on_distance(distance);
    }
  }
};

/// All listeners, each kind notified in order of attachment.
struct Outlets {
  std::vector<std::shared_ptr<PoseListener>> poses;
  std::vector<std::shared_ptr<TruthListener>> truth;
  std::vector<std::shared_ptr<ReadListener>> reads;
};

/// Adds an outlet as every kind of listener that it implements.
template <class Outlet>
void attach(const std::shared_ptr<Outlet>& outlet, Outlets& outlets) {
  if constexpr (std::is_base_of_v<PoseListener, Outlet>) outlets.poses.push_back(outlet);
  if constexpr (std::is_base_of_v<TruthListener, Outlet>) outlets.truth.push_back(outlet);
  if constexpr (std::is_base_of_v<ReadListener, Outlet>) outlets.reads.push_back(outlet);
}

}  // namespace tagfield
