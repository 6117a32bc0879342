// SPDX-License-Identifier: Apache-2.0
/// @file
/// Image sources of positions at rest, kept from one read to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// Image sources by number (a tag's slot). They are computed when they are requested for the second
/// time at the same position, so that moving tags cost nothing; and only up to a number of bytes,
/// so that large numbers of tags don't fill the memory. Not thread-safe.
class ImageCache {
 public:
  explicit ImageCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Images of the position for up to `options.order` reflections; null if they are not available.
  /// The pointer is valid until the next call with that number.
  const ImageSet* find(const RadioScene& scene, std::uint32_t number, const Eigen::Vector3d& p_W,
                       const TraceOptions& options);
  void forget(std::uint32_t number);

 private:
  struct Place {
    Eigen::Vector3d p_W;
    int order = -1;  ///< Order of `images`; negative if there are none yet.
    ImageSet images;
  };
  void drop(Place& place);

  std::size_t max_bytes_;
  std::size_t bytes_ = 0;
  std::unordered_map<std::uint32_t, Place> places_;
};

}  // namespace tagfield
