// SPDX-License-Identifier: Apache-2.0
/// @file
/// A visualization of a field: tags, antennas, and how strongly each tag was last read.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "tagfield/stream/listeners.h"

namespace tagfield {

/// A colour, each part from 0 to 1.
struct ReadColor {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};

/// Colour of a read whose strength is at `share` between the weakest (0) and the strongest (1):
/// from blue through green to red, weaker ones more transparent. Clamped; never fully transparent.
ReadColor read_color(double share);

/// Colour of a tag that was not read recently.
ReadColor silent_color();

/// An antenna as of its last update.
struct SeenAntenna {
  std::string frame_id;
  RigidTransform X_WA;
  double range_m = 0.0;
};

/// A tag's position and last read.
struct SeenTag {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();
  Time read = Time::min();
  double rssi_dbm = 0.0;
};

/// Collects the state of the field and calls draw() at intervals of simulated time.
class FieldPicture : public ReadListener, public TruthListener {
 public:
  explicit FieldPicture(Duration interval) : interval_(interval) {}

  void on_read(const TagRead& read) final;
  void on_update(const AntennaInfo& antenna, Time stamp) final;
  void on_antenna_removed(const std::string& name) final { antennas_.erase(name); }
  void on_tag_added(const TagPosition& tag, const std::string& label) final;
  void on_tag_moved(const TagPosition& tag) final { tags_[tag.tag].p_WT = tag.p_WT; }
  void on_tag_removed(const std::string& id) final { tags_.erase(id); }
  void on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) final;

 protected:
  /// Called at intervals.
  virtual void draw(Time stamp) = 0;

  /// Colour of the tag at `stamp`.
  [[nodiscard]] ReadColor color_of(const SeenTag& tag, Time stamp) const;
  [[nodiscard]] const std::map<std::string, SeenTag>& tags() const { return tags_; }
  [[nodiscard]] const std::map<std::string, SeenAntenna>& antennas() const { return antennas_; }

 private:
  Duration interval_;
  Time drawn_ = Time::min();
  std::map<std::string, SeenTag> tags_;
  std::map<std::string, SeenAntenna> antennas_;
  std::optional<double> weakest_dbm_;
  std::optional<double> strongest_dbm_;
};

}  // namespace tagfield
