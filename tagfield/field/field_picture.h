// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a person wants to see of a field: tags, antennas, and how strongly each tag was read last.
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

/// Colour of a read whose strength is `share` of the way from the weakest (0) to the strongest (1):
/// blue over green to red, weaker more transparent. Clamped; never fully transparent.
ReadColor read_color(double share);

/// Colour of a tag that was not read lately.
ReadColor silent_color();

/// An antenna as it was updated last.
struct SeenAntenna {
  std::string frame_id;
  RigidTransform X_WA;
  double range_m = 0.0;
};

/// A tag where it is, as it was read last.
struct SeenTag {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();
  Time read = Time::min();
  double rssi_dbm = 0.0;
};

/// Gathers what it is told and hands out a picture at intervals of simulated time.
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
