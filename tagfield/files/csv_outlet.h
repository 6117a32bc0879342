// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run as CSV files, written during the run: memory does not grow with its length.
#pragma once

#include <memory>

#include "tagfield/files/staged_folder.h"
#include "tagfield/stream/recording.h"

namespace tagfield {

/// Writes reads.csv, antenna_poses.csv and the truth's tables (docs/files.md) to a staged folder,
/// which must outlive it. Throws Error as GrowingFile does, and if an antenna that reports Doppler
/// appears after reads of others were written without that column.
class CsvOutlet final : public ReadListener, public PoseListener, public TruthListener {
 public:
  explicit CsvOutlet(StagedFolder& folder);
  ~CsvOutlet() override;

  void on_read(const TagRead& read) override;
  void on_update(const AntennaInfo& antenna, Time stamp) override;
  void on_antenna_added(const AntennaInfo& antenna) override;
  void on_antenna_removed(const std::string& name) override;
  void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_tag_added(const TagPosition& tag, const std::string& label) override;
  void on_tag_moved(const TagPosition& tag) override;
  void on_robot_pose(const AntennaPose& robot) override;
  void on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_distance(const TrueDistance& distance) override;

 private:
  void begin_reads();

  std::shared_ptr<GrowingFile> reads_;
  std::shared_ptr<GrowingFile> poses_;
  std::shared_ptr<GrowingFile> antennas_;
  std::shared_ptr<GrowingFile> robots_;
  std::shared_ptr<GrowingFile> tags_;
  std::shared_ptr<GrowingFile> distances_;
  bool has_doppler_ = false;  ///< An antenna reports it.
  bool has_begun_ = false;    ///< The header of reads.csv is written.
  FirstPoses believed_;
  FirstPoses placed_;
};

}  // namespace tagfield
