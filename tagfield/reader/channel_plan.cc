// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/channel_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tagfield/base/error.h"
#include "tagfield/base/random.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr const char* kFcc = "fcc";
constexpr double kMinCarrier = 1e6;
constexpr double kMaxCarrier = 300e9;

std::vector<double> evenly(double first_hz, double step_hz, int count) {
  std::vector<double> carriers;
  carriers.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) carriers.push_back(first_hz + i * step_hz);
  return carriers;
}

std::vector<ChannelPlan> make_plans() {
  return {// ERC/REC 70-03, annex 11: four channels of 200 kHz, 2 W ERP; EN 302 208: 4 s at most.
          {"etsi_low", {865.7e6, 866.3e6, 866.9e6, 867.5e6}, 4.0, 865e6, 868e6, 33.01, 200e3},
          // ERC/REC 70-03, annex 11: 400 kHz wide, 4 W ERP.
          {"etsi_high", {916.3e6, 917.5e6, 918.7e6}, 4.0, 915e6, 921e6, 36.02, 400e3},
          // 47 CFR 15.247: 50 channels, at most 0.4 s in 20 s, 1 W into 6 dBi: 36 dBm EIRP.
          {kFcc, evenly(902.75e6, 0.5e6, 50), 0.4, 902e6, 928e6, 36.0 - kDipole_dbi, 500e3},
          // MIIT 2007-205: 920.625 to 924.375 MHz in steps of 250 kHz, 2 W ERP, at most 2 s.
          {"china", evenly(920.625e6, 0.25e6, 16), 2.0, 920e6, 925e6, 33.01, 250e3}};
}

void check_carrier(const ChannelPlan& plan, double carrier_hz) {
  require(carrier_hz >= kMinCarrier && carrier_hz <= kMaxCarrier, "a carrier",
          "from 1 MHz to 300 GHz", carrier_hz);
  const bool has_band = plan.band_high_hz > 0.0;
  if (has_band && !(carrier_hz > plan.band_low_hz && carrier_hz < plan.band_high_hz)) {
    throw Error(fmt::format("carrier {:g} MHz is outside the plan's band, {:g} to {:g} MHz",
                            carrier_hz * 1e-6, plan.band_low_hz * 1e-6, plan.band_high_hz * 1e-6));
  }
}

/// Fisher-Yates shuffle.
std::vector<std::size_t> hop_order(std::size_t count, std::uint64_t reader_key,
                                   std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  RandomStream stream(seed, Purpose::kHopping, reader_key);
  for (std::size_t left = count; left > 1; --left) {
    std::swap(order[left - 1], order[static_cast<std::size_t>(stream() % left)]);
  }
  return order;
}

}  // namespace

const std::vector<ChannelPlan>& known_plans() {
  static const std::vector<ChannelPlan> all = make_plans();
  return all;
}

const ChannelPlan& known_plan(const std::string& name) {
  const std::vector<ChannelPlan>& all = known_plans();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const ChannelPlan& plan) { return plan.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const ChannelPlan& plan : all) names.push_back(plan.name);
  throw Error(fmt::format("there is no channel plan '{}'{}", name, suggestion(name, names)));
}

ChannelPlan fixed_plan(double frequency_hz) {
  ChannelPlan plan;
  plan.name = "fixed";
  plan.carriers_hz = {frequency_hz};
  return plan;
}

std::optional<double> max_conducted_dbm(const ChannelPlan& plan) {
  constexpr std::size_t kManyChannels = 50;
  if (plan.name != kFcc) return std::nullopt;
  return plan.carriers_hz.size() >= kManyChannels ? 30.0 : 10.0 * std::log10(250.0);
}

void check(const ChannelPlan& plan) {
  if (plan.carriers_hz.empty()) throw Error("a channel plan needs one carrier or more");
  require_in_range("dwell_s", plan.dwell_s, 1e-3, 1e6, "s");
  for (const double carrier : plan.carriers_hz) check_carrier(plan, carrier);
}

std::size_t channel_at(const ChannelPlan& plan, Time time, std::uint64_t reader_key,
                       std::uint64_t seed, std::size_t turn) {
  const std::size_t count = plan.carriers_hz.size();
  if (count == 1) return 0;
  const auto dwell = static_cast<std::int64_t>(std::llround(plan.dwell_s * 1e9));
  const std::int64_t nanoseconds = time.time_since_epoch().count();
  std::int64_t number = nanoseconds / dwell;
  if (nanoseconds % dwell < 0) --number;
  const auto periods = static_cast<std::int64_t>(count);
  const auto place = static_cast<std::size_t>(((number % periods) + periods) % periods);
  return hop_order(count, reader_key, seed)[(place + turn) % count];
}

}  // namespace tagfield
