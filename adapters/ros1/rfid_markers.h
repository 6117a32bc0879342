// SPDX-License-Identifier: Apache-2.0
/// @file
/// A field's tags and antennas as markers for RViz.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "adapters/ros1/ros_link.h"
#include "tagfield/field/field_picture.h"

namespace tagfield {

/// Publishes rfid/markers (visualization_msgs/MarkerArray) in frame "world" twice per simulated
/// second: all tags as one list of cubes, coloured by the RSSI of their last read (namespace
/// "tags"); for each antenna an arrow along its x axis ("antennas") and its range as a sphere
/// ("ranges"). Only while there are subscribers.
class RfidMarkers final : public FieldPicture {
 public:
  explicit RfidMarkers(std::shared_ptr<RosLink> link);
  ~RfidMarkers() override;

 protected:
  void draw(Time stamp) override;

 private:
  struct Topic;
  std::shared_ptr<RosLink> link_;
  std::unique_ptr<Topic> topic_;
  std::set<std::string> drawn_antennas_;
};

}  // namespace tagfield
