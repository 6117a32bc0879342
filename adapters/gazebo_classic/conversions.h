// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversions of Gazebo 11's times and poses to Tagfield's.
#pragma once

#include <gazebo/common/Time.hh>

#include "adapters/gazebo_common/conversions.h"
#include "tagfield/base/time.h"

namespace tagfield {

inline Time from_gazebo(const gazebo::common::Time& time) {
  return Time(std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nsec));
}

}  // namespace tagfield
