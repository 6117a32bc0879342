#include "navigation/internal/mrpt_random.h"

#include <mrpt/random/RandomGenerators.h>

namespace tagfield {
namespace {

std::mutex& generator_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

MrptRandom::MrptRandom(RandomStream stream) : lock_(generator_mutex()) {
  mrpt::random::getRandomGenerator().randomize(static_cast<std::uint32_t>(stream()));
}

}  // namespace tagfield
