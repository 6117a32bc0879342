// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/image_cache.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

constexpr std::size_t kPlenty = std::size_t{1} << 30U;

RadioScene hall() {
  Scene scene;
  scene.collisions.push_back({"hall", Box{{8.0, 6.0, 3.0}}, {}});
  return RadioScene(scene);
}

TraceOptions of_order(int order) {
  TraceOptions options;
  options.order = order;
  return options;
}

const Eigen::Vector3d kHere(1.0, 0.5, 0.2);

TEST(ImageCache, GivesImagesFromTheSecondTimeOnAtTheSamePlace) {
  const RadioScene scene = hall();
  ImageCache cache(kPlenty);
  EXPECT_EQ(cache.find(scene, 7, kHere, of_order(2)), nullptr);
  const ImageSet* const images = cache.find(scene, 7, kHere, of_order(2));
  ASSERT_NE(images, nullptr);
  const ImageSet made = images_of(scene, kHere, of_order(2));
  EXPECT_EQ(images->p_WA, kHere);
  EXPECT_EQ(images->around, made.around);
  ASSERT_EQ(images->images.size(), made.images.size());
  for (std::size_t i = 0; i < made.images.size(); ++i) {
    EXPECT_EQ(images->images[i].p_W, made.images[i].p_W);
  }
}

TEST(ImageCache, HasNoneForPlacesThatMove) {
  const RadioScene scene = hall();
  ImageCache cache(kPlenty);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d moved = kHere + Eigen::Vector3d(0.1 * i, 0.0, 0.0);
    EXPECT_EQ(cache.find(scene, 7, moved, of_order(1)), nullptr) << i;
  }
}

TEST(ImageCache, MakesThemAnewForAHigherOrder) {
  const RadioScene scene = hall();
  ImageCache cache(kPlenty);
  cache.find(scene, 7, kHere, of_order(1));
  EXPECT_EQ(cache.find(scene, 7, kHere, of_order(1))->images.size(), 6U);
  EXPECT_GT(cache.find(scene, 7, kHere, of_order(2))->images.size(), 6U);
}

TEST(ImageCache, ForgetsANumberThatIsAnotherTagsNow) {
  const RadioScene scene = hall();
  ImageCache cache(kPlenty);
  cache.find(scene, 7, kHere, of_order(1));
  cache.find(scene, 7, kHere, of_order(1));
  cache.forget(7);
  cache.forget(8);
  EXPECT_EQ(cache.find(scene, 7, kHere, of_order(1)), nullptr);
}

TEST(ImageCache, KeepsToItsBytes) {
  const RadioScene scene = hall();
  ImageCache cache(1);
  for (std::uint32_t number = 0; number < 3; ++number) {
    cache.find(scene, number, kHere, of_order(1));
  }
  // The first still fits; then the cache is full.
  EXPECT_NE(cache.find(scene, 0, kHere, of_order(1)), nullptr);
  EXPECT_EQ(cache.find(scene, 1, kHere, of_order(1)), nullptr);
  cache.forget(0);
  EXPECT_NE(cache.find(scene, 1, kHere, of_order(1)), nullptr);
}

}  // namespace
}  // namespace tagfield
