// SPDX-License-Identifier: Apache-2.0
/// @file
/// Images of places that stay where they are, kept from one read to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// Images by number (a tag's slot). A place gets images when it is asked for a second time at the
/// same point, so that those that move cost nothing; and only up to a number of bytes, so that
/// crowds don't fill the memory. Not thread-safe.
class ImageCache {
 public:
  explicit ImageCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Images of the place for up to `options.order` mirrors; null where there are none to be had.
  /// The pointer holds until the next call.
  const ImageSet* find(const RadioScene& scene, std::uint32_t number, const Eigen::Vector3d& p_W,
                       const TraceOptions& options);
  void forget(std::uint32_t number);

 private:
  struct Place {
    Eigen::Vector3d p_W;
    int order = -1;  ///< That `images` were made for; none yet below 0.
    ImageSet images;
  };
  void drop(Place& place);

  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::unordered_map<std::uint32_t, Place> places_;
};

}  // namespace tagfield
