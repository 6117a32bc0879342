// SPDX-License-Identifier: Apache-2.0
/// @file
/// Who is told what a run yields, while it runs: reads, told poses, and apart from them the truth.
/// In C++17, as the headers of ROS 1's messages are, which its adapters read, too.
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

/// An antenna, as outlets name it.
struct AntennaInfo {
  std::string name;          ///< Unique over all readers.
  std::string reader;        ///< Name of the reader that it belongs to.
  std::string sensor;        ///< Name of the sensor that it is; "" where there is none.
  std::string name_space;    ///< Of its topics; "" for none.
  std::string frame_id;      ///< Frame A of the antenna.
  std::string parent_frame;  ///< Frame P that its pose is told in; "" for the world.
  double range_m = 0.0;      ///< Nominal, as for a picture.
  bool is_fixed = false;     ///< It is at rest in the world.
  bool tells_doppler = false;
};

/// Reads of one antenna at one time. Names are valid for the call.
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

/// The distances behind a ReadBatch, in its order.
struct DistanceBatch {
  struct Row {
    const std::string* tag = nullptr;  ///< Its ID; never null.
    double distance_m = 0.0;
  };
  Time stamp;
  const std::string& antenna;
  const std::vector<Row>& rows;
};

/// Gets reads. All calls come from one thread at a time.
class ReadListener {
 public:
  ReadListener() = default;
  virtual ~ReadListener() = default;
  ReadListener(const ReadListener&) = delete;
  ReadListener& operator=(const ReadListener&) = delete;

  /// One read. Over all antennas, stamps never fall until on_restart().
  virtual void on_read(const TagRead& read) = 0;
  /// Many at once, for those who can take them faster than one by one.
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
  /// The antenna's update at `stamp`, after its reads but for those that earlier ones may precede.
  virtual void on_update(const AntennaInfo& /*antenna*/, Time /*stamp*/) {}
  virtual void on_antenna_added(const AntennaInfo& /*antenna*/) {}
  virtual void on_antenna_removed(const std::string& /*name*/) {}
  /// Time goes back: what comes is another run's.
  virtual void on_restart() {}
};

/// Gets the antennas' poses as they are told: by their mount, or as a robot believes.
class PoseListener {
 public:
  PoseListener() = default;
  virtual ~PoseListener() = default;
  PoseListener(const PoseListener&) = delete;
  PoseListener& operator=(const PoseListener&) = delete;

  /// At an update, before its ReadListener::on_update(): X_PA in antenna.parent_frame.
  virtual void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) = 0;
};

/// Gets what really was: to judge by, or to draw.
class TruthListener {
 public:
  TruthListener() = default;
  virtual ~TruthListener() = default;
  TruthListener(const TruthListener&) = delete;
  TruthListener& operator=(const TruthListener&) = delete;

  /// `label` is what the driver's world calls the tag; "" where it does not.
  virtual void on_tag_added(const TagPosition& /*tag*/, const std::string& /*label*/) {}
  virtual void on_tag_moved(const TagPosition& /*tag*/) {}
  virtual void on_tag_removed(const std::string& /*id*/) {}
  /// All that came, went or moved up to `stamp` has been told.
  virtual void on_tags_placed(Time /*stamp*/) {}
  virtual void on_robot_pose(const AntennaPose& /*robot*/) {}
  /// At an update, before its ReadListener::on_update().
  virtual void on_antenna_pose(const AntennaInfo& /*antenna*/, const AntennaPose& /*pose*/) {}
  /// Of each read, before it; of reads that come at once, of all before the first.
  virtual void on_distance(const TrueDistance& /*distance*/) {}
  /// Many at once, before their ReadListener::on_reads().
  virtual void on_distances(const DistanceBatch& batch) {
    TrueDistance distance{batch.stamp, batch.antenna, {}};
    for (const DistanceBatch::Row& row : batch.rows) {
      distance.tag = *row.tag;
      distance.distance_m = row.distance_m;
      on_distance(distance);
    }
  }
};

/// Who is told, each in the order of attachment.
struct Outlets {
  std::vector<std::shared_ptr<PoseListener>> poses;
  std::vector<std::shared_ptr<TruthListener>> truth;
  std::vector<std::shared_ptr<ReadListener>> reads;
};

/// Adds an outlet as each kind of listener that it is.
template <class Outlet>
void attach(const std::shared_ptr<Outlet>& outlet, Outlets& outlets) {
  if constexpr (std::is_base_of_v<PoseListener, Outlet>) outlets.poses.push_back(outlet);
  if constexpr (std::is_base_of_v<TruthListener, Outlet>) outlets.truth.push_back(outlet);
  if constexpr (std::is_base_of_v<ReadListener, Outlet>) outlets.reads.push_back(outlet);
}

}  // namespace tagfield
