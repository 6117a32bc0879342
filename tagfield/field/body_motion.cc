// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/body_motion.h"

#include <algorithm>
#include <utility>

#include "tagfield/field/tag_motion.h"

namespace tagfield {

void BodyMotion::see(const std::vector<MovingBody>& bodies, Time now) {
  if (bodies.empty() && bodies_.empty()) return;
  if (now != now_) {
    bodies_before_ = std::move(bodies_);
    before_ = now_;
  }
  bodies_ = bodies;
  now_ = now;
}

std::vector<MovingBody> BodyMotion::at(Time stamp) const {
  if (bodies_.empty() || stamp >= now_) return bodies_;
  std::vector<MovingBody> then = bodies_;
  const double share = share_at(stamp, before_, now_);
  for (MovingBody& body : then) {
    const auto before =
        std::find_if(bodies_before_.begin(), bodies_before_.end(),
                     [&](const MovingBody& other) { return other.name == body.name; });
    if (before == bodies_before_.end()) continue;
    body.p_W = (1.0 - share) * before->p_W + share * body.p_W;
  }
  return then;
}

}  // namespace tagfield
