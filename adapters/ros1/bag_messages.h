// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of a bag's messages to BagContent.
#pragma once

#include <rfid_sensor/TagArray.h>

#include <string>

#include "adapters/ros1/bag_content.h"
#include "adapters/ros1/bag_wire.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// Add a message of tagfield_msgs, nav_msgs or tf2_msgs, from ROS 1 or ROS 2, to `content`. Throw
/// Error if a number is not finite or is absurd, a name is empty or not text, or a stamp is
/// invalid. If the stamps of a stream go back by more than a second, the simulation was reset: the
/// previous `content` is then dropped with a warning, except for static transforms and tag
/// positions.
template <class TagReads>
void take_reads(const TagReads& message, const MessageLocation& place, BagContent& content,
                Diagnostics& diagnostics);
template <class AntennaTruth>
void take_antenna_truth(const AntennaTruth& message, const MessageLocation& place,
                        BagContent& content, Diagnostics& diagnostics);
template <class TagPositions>
void take_tag_positions(const TagPositions& message, const MessageLocation& place,
                        BagContent& content, Diagnostics& diagnostics);
/// The robot's name is the topic's namespace, or "robot" if there is none.
template <class Odometry>
void take_odometry(const Odometry& message, const MessageLocation& place, BagContent& content,
                   Diagnostics& diagnostics);
/// Transforms of a topic "…/tf_static" are static.
template <class TFMessage>
void take_transforms(const TFMessage& message, const MessageLocation& place, BagContent& content,
                     Diagnostics& diagnostics);

/// Same, for a message of the published plugin: the antenna's name is the second to last part of
/// the topic (…/SENSOR/data); all reads have the carrier `frequency_hz`.
void take_array(const rfid_sensor::TagArray& message, const MessageLocation& place,
                double frequency_hz, BagContent& content, Diagnostics& diagnostics);

/// A topic's name without its namespace: "/a/b/tf" → "tf".
std::string last_name(const std::string& topic);

}  // namespace tagfield
