// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/tracker.h"

namespace tagfield {

std::string to_string(TrackVerdict verdict) {
  if (verdict == TrackVerdict::kTracked) return "tracked";
  return verdict == TrackVerdict::kAmbiguous ? "ambiguous" : "not_tracked";
}

}  // namespace tagfield
