// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/image_cache.h"

namespace tagfield {
namespace {

std::size_t bytes_of(const ImageSet& images) {
  return images.images.capacity() * sizeof(Image) + images.beams.capacity() * sizeof(BeamBlock) +
         images.around.capacity();
}

}  // namespace

const ImageSet* ImageCache::find(const RadioScene& scene, std::uint32_t number,
                                 const Eigen::Vector3d& p_W, const TraceOptions& options) {
  const auto [entry, is_new] = places_.try_emplace(number, Place{p_W, -1, {}});
  Place& place = entry->second;
  if (is_new) return nullptr;
  if (place.p_W != p_W) {
    drop(place);
    place.p_W = p_W;
    return nullptr;
  }
  if (place.order < options.order) {
    drop(place);
    if (bytes_ >= max_bytes_) return nullptr;
    place.images = images_of(scene, p_W, options);
    place.order = options.order;
    bytes_ += bytes_of(place.images);
  }
  return &place.images;
}

void ImageCache::forget(std::uint32_t number) {
  const auto found = places_.find(number);
  if (found == places_.end()) return;
  drop(found->second);
  places_.erase(found);
}

void ImageCache::drop(Place& place) {
  if (place.order < 0) return;
  bytes_ -= bytes_of(place.images);
  place.images = {};
  place.order = -1;
}

}  // namespace tagfield
