// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where moving bodies were at the last two times that they were seen, and between them.
#pragma once

#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/channel/moving_body.h"

namespace tagfield {

/// The moving bodies at the last two times.
class BodyMotion {
 public:
  /// Sets the bodies' poses at `now`, which must not decrease.
  void see(const std::vector<MovingBody>& bodies, Time now);

  [[nodiscard]] bool empty() const { return bodies_.empty(); }
  /// The bodies with positions interpolated to `stamp`.
  [[nodiscard]] std::vector<MovingBody> at(Time stamp) const;

 private:
  std::vector<MovingBody> bodies_;  ///< At now_.
  std::vector<MovingBody> bodies_before_;
  Time now_{};
  Time before_{};
};

}  // namespace tagfield
