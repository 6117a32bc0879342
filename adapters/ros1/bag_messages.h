// SPDX-License-Identifier: Apache-2.0
/// @file
/// Messages of a bag to BagContent.
#pragma once

#include <rfid_sensor/TagArray.h>

#include <string>

#include "adapters/ros1/bag_content.h"
#include "adapters/ros1/bag_wire.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// Take a message of tagfield_msgs, nav_msgs or tf2_msgs, of ROS 1 or of ROS 2, into `content`.
/// Throw Error where a number is not finite or absurd, a name empty or no text, a stamp no time.
/// Where a stream's stamps go back by over a second the simulation was reset: what `content` held
/// is dropped with a warning, static transforms and the tags' places excepted.
template <class TagReads>
void take_reads(const TagReads& message, const MessagePlace& place, BagContent& content,
                Diagnostics& diagnostics);
template <class AntennaTruth>
void take_antenna_truth(const AntennaTruth& message, const MessagePlace& place, BagContent& content,
                        Diagnostics& diagnostics);
template <class TagPositions>
void take_tag_positions(const TagPositions& message, const MessagePlace& place, BagContent& content,
                        Diagnostics& diagnostics);
/// The robot has the name of the topic's namespace, or "robot" where it has none.
template <class Odometry>
void take_odometry(const Odometry& message, const MessagePlace& place, BagContent& content,
                   Diagnostics& diagnostics);
/// Transforms of a topic "…/tf_static" are static.
template <class TFMessage>
void take_transforms(const TFMessage& message, const MessagePlace& place, BagContent& content,
                     Diagnostics& diagnostics);

/// Likewise one of the published plugin's: the antenna has the second last name of the topic
/// (…/SENSOR/data); all reads have the carrier `frequency_hz`.
void take_array(const rfid_sensor::TagArray& message, const MessagePlace& place,
                double frequency_hz, BagContent& content, Diagnostics& diagnostics);

/// The name of a topic without its namespace: "/a/b/tf" → "tf".
std::string last_name(const std::string& topic);

}  // namespace tagfield
