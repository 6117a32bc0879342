#include "tagfield/navigation/internal/mrpt_random.h"

#include <mrpt/random/RandomGenerators.h>

namespace tagfield {
namespace {

std::mutex& generator_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

MrptRandom::MrptRandom(RandomStream stream) : lock_(generator_mutex()) {
  // Not randomize(): normal draws come in pairs, and it would keep the half that the one before has
  // left over.
  mrpt::random::getRandomGenerator() =
      mrpt::random::CRandomGenerator(static_cast<std::uint32_t>(stream()));
}

}  // namespace tagfield
