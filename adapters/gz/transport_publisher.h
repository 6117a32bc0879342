// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads and their ground truth as messages on Gazebo's transport.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tagfield/stream/listeners.h"

namespace tagfield {

/// Publishes its input, in simulated time, as messages of the package `tagfield.msgs`, which is the
/// same for all versions of Gazebo:
///
///   /rfid/reads            TagReads       every update of every antenna, even without reads
///   /rfid/truth/antennas   AntennaTruth   every update of every antenna
///   /rfid/truth/tags       TagPositions   all tags when the set changes, and once a second
///   /rfid/truth/tags_moved TagPositions   tags that moved, before the reads
///
/// The first two are under /NAMESPACE for an antenna with a namespace. This transport keeps no
/// messages for late subscribers, so all tags are sent again periodically. Messages without a
/// subscriber are not generated.
class TransportPublisher final : public ReadListener, public TruthListener {
 public:
  TransportPublisher();
  ~TransportPublisher() override;

  void on_read(const TagRead& read) override;
  void on_update(const AntennaInfo& antenna, Time stamp) override;
  void on_antenna_added(const AntennaInfo& antenna) override;
  void on_antenna_removed(const std::string& name) override;
  void on_tag_added(const TagPosition& tag, const std::string& label) override;
  void on_tag_moved(const TagPosition& tag) override;
  void on_tag_removed(const std::string& id) override;
  void on_tags_placed(Time stamp) override;
  void on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_distance(const TrueDistance& distance) override;
  void on_restart() override;

 private:
  struct Topics;
  struct AntennaTopics;
  /// State of one antenna since its last update.
  struct Update {
    RigidTransform X_WA;
    std::vector<TagRead> reads;
    std::vector<double> distances_m;
  };
  AntennaTopics& topics_in(const std::string& name_space);
  [[nodiscard]] bool are_tags_due(Time stamp) const;
  void publish_tags(Time stamp);

  std::unique_ptr<Topics> topics_;
  std::map<std::string, Update> updates_;          ///< By antenna.
  std::map<std::string, Eigen::Vector3d> places_;  ///< By tag.
  std::set<std::string> moved_;
  bool has_changed_ = false;
  Time last_sent_ = Time::min();  ///< When all tags were last sent.
};

}  // namespace tagfield
