// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/propagation/internal/beam.h"
#include "tagfield/propagation/internal/check_options.h"
#include "tagfield/propagation/internal/facet_blocks.h"
#include "tagfield/propagation/trace_paths.h"

namespace tagfield {
namespace {

/// An antenna or image must be further than this from a facet's plane to be mirrored [m].
constexpr double kMinHeight = 1e-6;

class Builder {
 public:
  Builder(const RadioScene& scene, const Eigen::Vector3d& p_WA, const TraceOptions& options)
      : scene_(scene), options_(options), inside_(shells_around(scene, p_WA)) {
    set_.p_WA = p_WA;
    sides_.assign(scene.facet_blocks().size() * kFacetLanes, 0.0F);
    for (std::size_t i = 0; i < scene.facets().size(); ++i) {
      const Facet& facet = scene.facets()[i];
      if (!facet.two_sided) sides_[i] = static_cast<float>(mirrors(facet));
    }
  }

  ImageSet build() {
    for (int order = 1; order <= options_.order; ++order) {
      const auto end = static_cast<std::int32_t>(set_.images.size());
      if (order == 1) mirror_antenna();
      for (; order > 1 && first_ < end; ++first_) mirror(first_);
    }
    set_.beams = beam_blocks(set_.images, beams_, set_.p_WA);
    set_.around = std::move(inside_);
    return std::move(set_);
  }

 private:
  void mirror_antenna() {
    for (std::uint32_t facet = 0; facet < scene_.facets().size(); ++facet) add(-1, facet);
  }

  /// Adds all images of one image.
  void mirror(std::int32_t parent) {
    candidates_.clear();
    add_facets_in(scene_.facet_blocks(), sides_, beams_[static_cast<std::size_t>(parent)],
                  at(parent), instruction_sets().back(), candidates_);
    for (const std::uint32_t facet : candidates_) {
      if (is_before_mirror(at(parent), facet)) add(parent, facet);
    }
  }

  [[nodiscard]] const Image& at(std::int32_t image) const {
    return set_.images[static_cast<std::size_t>(image)];
  }

  [[nodiscard]] bool is_front(std::uint32_t facet, const Eigen::Vector3d& normal) const {
    return scene_.facets()[facet].normal_W.dot(normal) > 0.0;
  }

  /// Whether part of `facet` is in front of the facet of `image`.
  [[nodiscard]] bool is_before_mirror(const Image& image, std::uint32_t facet) const {
    return image.facet != facet &&
           scene_.reaches(image.facet, is_front(image.facet, image.normal_W), facet);
  }

  /// Which side of a facet of a closed surface reflects: 1 its front, -1 its back.
  [[nodiscard]] int mirrors(const Facet& facet) const { return inside_[facet.shell] != 0 ? -1 : 1; }

  /// 1 if the facet reflects a wave from `p` on its front, -1 if on its back, 0 if not at all.
  [[nodiscard]] int side(const Facet& facet, const Eigen::Vector3d& p) const {
    const double height = facet.normal_W.dot(p) - facet.offset_m;
    const int there = height > kMinHeight ? 1 : (height < -kMinHeight ? -1 : 0);
    if (facet.two_sided) return there;
    return there == mirrors(facet) ? there : 0;
  }

  void add(std::int32_t parent, std::uint32_t index) {
    const Facet& facet = scene_.facets()[index];
    const Eigen::Vector3d p = parent < 0 ? set_.p_WA : at(parent).p_W;
    const int way = side(facet, p);
    if (way == 0) return;
    if (parent >= 0 && !scene_.reaches(index, way > 0, at(parent).facet)) return;
    Image image;
    image.normal_W = way * facet.normal_W;
    image.offset_m = way * facet.offset_m;
    image.p_W = p - 2.0 * (image.normal_W.dot(p) - image.offset_m) * image.normal_W;
    image.facet = index;
    image.parent = parent;
    image.order = parent < 0 ? 1 : at(parent).order + 1;
    add_seen(image, facet);
  }

  /// Adds the image unless it is visible from nowhere.
  void add_seen(const Image& image, const Facet& facet) {
    if (facet.unbounded) {
      add_endless(image);
      return;
    }
    Window window = whole_window(facet);
    if (image.parent >= 0) {
      const auto part =
          window_in(beams_[static_cast<std::size_t>(image.parent)], at(image.parent), facet);
      if (!part) return;
      window = *part;
    }
    if (distance_to(window, facet, image.p_W) > options_.max_length_m) return;
    push(image, beam_through(window, image, facet));
  }

  void add_endless(const Image& image) {
    if (image.offset_m - image.normal_W.dot(image.p_W) > options_.max_length_m) return;
    const bool first = image.parent < 0;
    push(image, first ? open_beam()
                      : mirrored_beam(beams_[static_cast<std::size_t>(image.parent)], image));
  }

  void push(const Image& image, const BeamSides& beam) {
    set_.images.push_back(image);
    beams_.push_back(beam);
  }

  const RadioScene& scene_;
  const TraceOptions& options_;
  std::vector<char> inside_;
  ReflectingSides sides_;
  ImageSet set_;
  std::vector<BeamSides> beams_;  ///< Of each image.
  std::vector<std::uint32_t> candidates_;
  std::int32_t first_ = 0;  ///< Index of the first image that has not been mirrored yet.
};

}  // namespace

ImageSet images_of(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                   const TraceOptions& options) {
  check(options);
  if (!is_place(p_WA)) return {p_WA, {}, {}};
  return Builder(scene, p_WA, options).build();
}

}  // namespace tagfield
