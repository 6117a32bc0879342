/// @file
/// Reads, and the truth behind them, as ROS messages.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "adapters/ros1/ros_link.h"
#include "tagfield/field/rfid_field.h"

namespace tagfield {

/// `text` with what a ROS name can't hold replaced by '_'.
std::string ros_name(const std::string& text);

/// Publishes what a field's listener hears. The names of reads, antennas and tf are in the
/// antenna's name space, those of tags in none.
///
///   ~SENSOR/data           rfid_sensor/TagArray        the published plugin's message, latched
///   rfid/reads             tagfield_msgs/TagReads      every update of every antenna
///   tf                     tf2_msgs/TFMessage          parent frame → antenna's frame
///   rfid/truth/antennas    tagfield_msgs/AntennaTruth  every update of every antenna
///   rfid/truth/tags        tagfield_msgs/TagPositions  all tags when the set changes, latched
///   rfid/truth/tags_moved  tagfield_msgs/TagPositions  those that moved, before the reads
class RfidPublisher final : public FieldListener {
 public:
  explicit RfidPublisher(std::shared_ptr<RosLink> link);
  ~RfidPublisher() override;

  void tags_changed(Time stamp, const FieldTags& tags) override;
  void tags_moved(Time stamp, const std::vector<std::uint32_t>& slots,
                  const FieldTags& tags) override;
  void antenna_updated(const AntennaUpdate& update) override;
  void antenna_added(const FieldAntenna& antenna) override;
  void antenna_removed(const std::string& antenna) override;

 private:
  struct TagTopics;
  struct Topics;
  struct AntennaTopics;
  Topics& topics_in(const std::string& name_space);
  AntennaTopics& topics_of(const FieldAntenna& antenna);

  std::shared_ptr<RosLink> link_;
  std::unique_ptr<TagTopics> truth_;
  std::map<std::string, std::unique_ptr<Topics>> by_name_space_;
  std::map<std::string, std::unique_ptr<AntennaTopics>> by_antenna_;
};

/// The frame that truth and markers are told in.
inline constexpr const char* kWorldFrame = "world";

}  // namespace tagfield
