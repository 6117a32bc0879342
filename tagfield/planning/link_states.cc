// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/link_states.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/planning/local_link.h"

namespace tagfield {
namespace {

constexpr double kStep_db = 0.25;
constexpr int kMaxSteps = 126;
constexpr std::int8_t kNoLink = -128;

std::int8_t step_of(double margin_db) {
  if (margin_db < -0.5 * kMaxSteps) return kNoLink;
  return static_cast<std::int8_t>(
      std::clamp<long>(std::lround(std::floor(margin_db / kStep_db)), -kMaxSteps, kMaxSteps));
}

}  // namespace

LinkStates::LinkStates(const std::vector<double>& margins_db) {
  bool any = false;
  steps_.reserve(margins_db.size());
  for (const double margin_db : margins_db) {
    steps_.push_back(step_of(margin_db));
    any = any || steps_.back() != kNoLink;
  }
  if (!any) steps_.clear();
}

std::size_t LinkStates::carriers() const { return steps_.size() / kFadingPositions; }

double LinkStates::margin_db(std::size_t place, std::size_t carrier) const {
  const std::int8_t step = steps_[place * carriers() + carrier];
  return step == kNoLink ? kNothing_db : kStep_db * step;
}

double LinkStates::share_heard(std::size_t place, double less_db) const {
  if (is_empty()) return 0.0;
  std::size_t heard = 0;
  for (std::size_t carrier = 0; carrier < carriers(); ++carrier) {
    if (margin_db(place, carrier) >= less_db) ++heard;
  }
  return static_cast<double>(heard) / static_cast<double>(carriers());
}

double LinkStates::share_heard(double less_db) const {
  double sum = 0.0;
  for (std::size_t place = 0; place < kFadingPositions; ++place) sum += share_heard(place, less_db);
  return sum / static_cast<double>(kFadingPositions);
}

double LinkStates::best_db() const {
  const auto best = std::max_element(steps_.begin(), steps_.end());
  return best == steps_.end() || *best == kNoLink ? kNothing_db : kStep_db * *best;
}

}  // namespace tagfield
