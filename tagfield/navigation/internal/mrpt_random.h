/// @file
/// MRPT draws from one generator that the whole process shares. This lends it out, seeded by one of
/// our streams, so that what is drawn depends on that stream alone.
#pragma once

#include <mutex>

#include "tagfield/base/random.h"

namespace tagfield {

/// For as long as this lives, the thread that made it has MRPT's generator to itself.
class MrptRandom {
 public:
  explicit MrptRandom(RandomStream stream);

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace tagfield
