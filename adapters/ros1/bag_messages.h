// SPDX-License-Identifier: Apache-2.0
/// @file
/// Messages of a bag to BagContent.
#pragma once

#include <nav_msgs/Odometry.h>
#include <rfid_sensor/TagArray.h>
#include <tagfield_msgs/AntennaTruth.h>
#include <tagfield_msgs/TagPositions.h>
#include <tagfield_msgs/TagReads.h>
#include <tf2_msgs/TFMessage.h>

#include <string>

#include "adapters/ros1/bag_content.h"
#include "adapters/ros1/bag_wire.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// Takes a message into `content`. Throws Error where a number is not finite or absurd, a name
/// empty or no text, a stamp no time. Where a stream's stamps go back by over a second the
/// simulation was reset: what `content` held is dropped with a warning, static transforms and the
/// tags' places excepted.
void take(const tagfield_msgs::TagReads& message, const MessagePlace& place, BagContent& content,
          Diagnostics& diagnostics);
void take(const tagfield_msgs::AntennaTruth& message, const MessagePlace& place,
          BagContent& content, Diagnostics& diagnostics);
void take(const tagfield_msgs::TagPositions& message, const MessagePlace& place,
          BagContent& content, Diagnostics& diagnostics);
/// The robot has the name of the topic's namespace, or "robot" where it has none.
void take(const nav_msgs::Odometry& message, const MessagePlace& place, BagContent& content,
          Diagnostics& diagnostics);
/// Transforms of a topic "…/tf_static" are static.
void take(const tf2_msgs::TFMessage& message, const MessagePlace& place, BagContent& content,
          Diagnostics& diagnostics);
/// The antenna has the second last name of the topic (…/SENSOR/data); all reads have the carrier
/// `frequency_hz`.
void take(const rfid_sensor::TagArray& message, const MessagePlace& place, double frequency_hz,
          BagContent& content, Diagnostics& diagnostics);

/// The name of a topic without its namespace: "/a/b/tf" → "tf".
std::string last_name(const std::string& topic);

}  // namespace tagfield
