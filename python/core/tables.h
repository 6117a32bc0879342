// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a run yields, as tables, and tables as what the rooms take.
#pragma once

#include <string>
#include <vector>

#include "python/core/arrays.h"
#include "tagfield/experiment/experiment.h"
#include "tagfield/stream/recording.h"

namespace tagfield::python {

/// All of a run as rows. Antennas, readers, tags and robots have one number in all tables.
struct RunTables {
  Names readers, antennas, tags, robots;
  std::vector<ReadRow> reads;
  std::vector<PoseRow> poses;  ///< As believed; a fixed antenna has one row.
  std::vector<PoseRow> true_antennas, true_robots;
  std::vector<TagRow> true_tags;
  std::vector<DistanceRow> distances;
};

ReadRow row_of(const TagRead& read, RunTables& names);
PoseRow row_of(const AntennaPose& pose, Names& names);

/// Appends everything it receives to tables, which must outlive it.
class TableRecorder final : public ReadListener, public PoseListener, public TruthListener {
 public:
  explicit TableRecorder(RunTables& tables) : tables_(tables) {}

  void on_read(const TagRead& read) override { tables_.reads.push_back(row_of(read, tables_)); }
  void on_antenna_removed(const std::string& name) override {
    believed_.forget(name);
    placed_.forget(name);
  }
  void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) override {
    if (believed_.is_new(antenna)) tables_.poses.push_back(row_of(pose, tables_.antennas));
  }
  void on_tag_added(const TagPosition& tag, const std::string& label) override;
  void on_tag_moved(const TagPosition& tag) override { on_tag_added(tag, ""); }
  void on_robot_pose(const AntennaPose& robot) override {
    tables_.true_robots.push_back(row_of(robot, tables_.robots));
  }
  void on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) override {
    if (placed_.is_new(antenna)) tables_.true_antennas.push_back(row_of(pose, tables_.antennas));
  }
  void on_distance(const TrueDistance& distance) override;

 private:
  RunTables& tables_;
  FirstPoses believed_;
  FirstPoses placed_;
};

/// `reads` of other origin, and antenna poses, as tables: {"reads", "poses"}.
py::dict tables_of(const std::vector<TagRead>& reads, const std::vector<AntennaPose>& poses);

/// The tables as a dict: reads, poses, true_antennas, true_robots, true_tags, true_distances.
py::dict to_python(RunTables tables);

/// Reads and poses back from tables, with the names of their columns.
std::vector<TagRead> reads_from(const Rows<ReadRow>& rows, const std::vector<std::string>& readers,
                                const std::vector<std::string>& antennas,
                                const std::vector<std::string>& tags);
std::vector<AntennaPose> poses_from(const Rows<PoseRow>& rows,
                                    const std::vector<std::string>& names);
std::vector<TagPosition> places_from(const Rows<TagRow>& rows,
                                     const std::vector<std::string>& tags);

/// What was located, judged: {"estimates", "candidates"}.
py::dict estimates_of(const std::vector<TagOutcome>& outcomes);

}  // namespace tagfield::python
