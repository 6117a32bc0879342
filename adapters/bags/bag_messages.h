// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of messages of the published plugin to BagContent.
#pragma once

#include <rfid_sensor/TagArray.h>

#include "adapters/bags/bag_content.h"
#include "adapters/bags/message_location.h"
#include "tagfield/base/error.h"

namespace tagfield::recorded {

/// As message_content.h: the antenna's name is the second to last part of the topic
/// (…/SENSOR/data); all reads have the carrier `frequency_hz`.
void take_array(const rfid_sensor::TagArray& message, const MessageLocation& place,
                double frequency_hz, BagContent& content, Diagnostics& diagnostics);

}  // namespace tagfield::recorded
