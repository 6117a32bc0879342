// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads and their ground truth as ROS messages.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "adapters/ros1/ros_link.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// `text` with characters that are invalid in ROS names replaced by '_'.
std::string ros_name(const std::string& text);

/// Publishes its input. Topics of reads, antennas and tf are in the antenna's namespace, those of
/// tags in none.
///
///   ~SENSOR/data           rfid_sensor/TagArray        the published plugin's message, latched
///   rfid/reads             tagfield_msgs/TagReads      every update of every antenna
///   tf                     tf2_msgs/TFMessage          parent frame → antenna's frame
///   rfid/truth/antennas    tagfield_msgs/AntennaTruth  every update of every antenna
///   rfid/truth/tags        tagfield_msgs/TagPositions  all tags when the set changes, latched
///   rfid/truth/tags_moved  tagfield_msgs/TagPositions  tags that moved, before the reads
class RfidPublisher final : public ReadListener, public PoseListener, public TruthListener {
 public:
  explicit RfidPublisher(std::shared_ptr<RosLink> link);
  ~RfidPublisher() override;

  void on_read(const TagRead& read) override;
  void on_update(const AntennaInfo& antenna, Time stamp) override;
  void on_antenna_added(const AntennaInfo& antenna) override;
  void on_antenna_removed(const std::string& name) override;
  void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_tag_added(const TagPosition& tag, const std::string& label) override;
  void on_tag_moved(const TagPosition& tag) override;
  void on_tag_removed(const std::string& id) override;
  void on_tags_placed(Time stamp) override;
  void on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_distance(const TrueDistance& distance) override;

 private:
  struct TagTopics;
  struct Topics;
  struct AntennaTopics;
  /// Reads of an antenna since its last update, and their ground truth.
  struct Update {
    std::vector<TagRead> reads;
    std::vector<double> distances_m;
    RigidTransform X_WA;
  };
  struct Tag {
    std::string label;
    TagPosition position;
  };
  Topics& topics_in(const std::string& name_space);
  AntennaTopics& topics_of(const AntennaInfo& antenna);
  void publish_in_old_form(const AntennaInfo& antenna, Time stamp, const Update& update);

  std::shared_ptr<RosLink> link_;
  std::unique_ptr<TagTopics> truth_;
  std::map<std::string, std::unique_ptr<Topics>> by_name_space_;
  std::map<std::string, std::unique_ptr<AntennaTopics>> by_antenna_;
  std::map<std::string, Update> updates_;  ///< By antenna.
  std::map<std::string, Tag> tags_;
  std::vector<std::string> moved_;  ///< IDs, since tags were last published.
  bool has_changed_ = false;        ///< Tags were added or removed since then.
};

/// The frame of truth and markers.
inline constexpr const char* kWorldFrame = "world";

}  // namespace tagfield
