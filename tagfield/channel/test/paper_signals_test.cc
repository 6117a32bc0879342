// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/paper_signals.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/test/any_paper_model.h"

namespace tagfield {
namespace {

/// Links with noise words and optional draws of any magnitude.
struct DrawnLinks {
  explicit DrawnLinks(const PaperModel& model, std::size_t count) {
    RandomStream stream(*rc::gen::arbitrary<std::uint64_t>(), Purpose::kReadNoise);
    for (std::size_t i = 0; i < count; ++i) {
      distance.push_back(i % 5 == 0 ? std::pow(10.0, 600.0 * uniform(stream) - 300.0)
                                    : 20.0 * uniform(stream) + 1e-6);
      first.push_back(stream());
      second.push_back(stream());
      optional.push_back(draw(model.optional, stream));
    }
  }
  [[nodiscard]] PaperLinks some(std::size_t begin, std::size_t count) const {
    return {{distance.data() + begin, count},
            {first.data() + begin, count},
            {second.data() + begin, count},
            {optional.data() + begin, count}};
  }
  std::vector<double> distance;
  std::vector<std::uint64_t> first;
  std::vector<std::uint64_t> second;
  std::vector<double> optional;
};

// The equations for one link at a time, with the mathematical functions of the standard library.
RC_GTEST_PROP(PaperSignals, AreTheEquationsOfEachLink, ()) {
  const PaperModel model = any_model();
  const std::size_t count = *rc::gen::inRange<std::size_t>(1, 20);
  const DrawnLinks links(model, count);
  std::vector<double> phase(count);
  std::vector<double> rssi(count);
  paper_signals(model, links.some(0, count), phase, rssi);
  for (std::size_t i = 0; i < count; ++i) {
    const NormalPair drawn = lane_normal_pair(links.first[i], links.second[i]);
    const double noise = model.phase_noise_rad * drawn.first + wrap_to_two_pi(links.optional[i]);
    RC_ASSERT(phase[i] == paper_phase(model, links.distance[i], noise));
    RC_ASSERT(rssi[i] == paper_rssi_dbm(model, links.distance[i], model.rssi_noise * drawn.second));
  }
}

RC_GTEST_PROP(PaperSignals, AreTheSameBitsInEveryBatchAndInstructionSet, ()) {
  const PaperModel model = any_model();
  const std::size_t count = 600;
  const DrawnLinks links(model, count);
  std::vector<double> phase(count);
  std::vector<double> rssi(count);
  paper_signals(model, links.some(0, count), phase, rssi, InstructionSet::kBaseline);
  const std::size_t batch = *rc::gen::inRange<std::size_t>(1, 601);
  for (const InstructionSet set : instruction_sets()) {
    for (std::size_t begin = 0; begin < count; begin += batch) {
      const std::size_t some = std::min(batch, count - begin);
      std::vector<double> phases(some);
      std::vector<double> rssis(some);
      paper_signals(model, links.some(begin, some), phases, rssis, set);
      for (std::size_t i = 0; i < some; ++i) {
        RC_ASSERT(bits_of(phases[i]) == bits_of(phase[begin + i]));
        RC_ASSERT(bits_of(rssis[i]) == bits_of(rssi[begin + i]));
      }
    }
  }
}

}  // namespace
}  // namespace tagfield
