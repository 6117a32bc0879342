// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/forecast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/gen2/link_timing.h"
#include "tagfield/planning/local_link.h"
#include "tagfield/planning/test/radio_hall.h"

namespace tagfield {
namespace {

/// States heard on the first `heard` of eight carriers, at all positions.
LinkStates heard_on(std::size_t heard) {
  std::vector<double> margins;
  for (std::size_t place = 0; place < kFadingPositions; ++place) {
    for (std::size_t carrier = 0; carrier < 8; ++carrier) {
      margins.push_back(carrier < heard ? 5.0 : -5.0);
    }
  }
  return LinkStates(margins);
}

ForecastPort port_with(const std::string& name, Session session) {
  RadioModel model = isotropic_model();
  model.plan = known_plan("fcc");
  model.gen2.emplace();
  model.gen2->inventory.session = session;
  ForecastPort port;
  port.antenna.name = name;
  port.antenna.reader = "reader";
  port.antenna.model = std::make_shared<const RadioModel>(model);
  port.group = "reader";
  return port;
}

ForecastRequest one_port(const LinkStates& states, std::size_t tags, double duration_s) {
  ForecastRequest request;
  request.ports = {port_with("a", Session::kS1)};
  request.duration_s = duration_s;
  for (std::size_t i = 0; i < tags; ++i) {
    ForecastTag tag;
    tag.links.push_back({0, 0.0, 1e9, &states});
    request.tags.push_back(tag);
  }
  return request;
}

TEST(LinkStates, AreKeptToAQuarterOfADecibel) {
  const LinkStates states = heard_on(2);
  EXPECT_EQ(states.carriers(), 8U);
  EXPECT_DOUBLE_EQ(states.share_heard(), 0.25);
  EXPECT_DOUBLE_EQ(states.share_heard(5.0), 0.25);
  EXPECT_DOUBLE_EQ(states.share_heard(5.25), 0.0);
  EXPECT_DOUBLE_EQ(states.best_db(), 5.0);
  EXPECT_TRUE(LinkStates(std::vector<double>(72, kNothing_db)).is_empty());
  // Never rounded up.
  EXPECT_DOUBLE_EQ(LinkStates(std::vector<double>(9, 0.2)).best_db(), 0.0);
  EXPECT_DOUBLE_EQ(LinkStates(std::vector<double>(9, -0.01)).best_db(), -0.25);
}

TEST(Forecast, ReadsWhatIsHeardAndNothingElse) {
  const LinkStates all = heard_on(8);
  const LinkStates none = heard_on(0);
  ForecastRequest request = one_port(all, 20, 2.0);
  request.tags[7].links[0].states = &none;
  const Forecast made = forecast(request);
  for (std::size_t tag = 0; tag < 20; ++tag) {
    EXPECT_EQ(made.probability[tag], tag == 7 ? 0.0 : 1.0) << tag;
  }
  EXPECT_DOUBLE_EQ(made.tags_read.mean, 19.0);
}

TEST(Forecast, OfASampledCarrierIsTheChanceOfItsChannelsToBeOn) {
  const LinkStates one = heard_on(1);
  // Two different channels of fifty; the first sampled carrier represents seven.
  ForecastRequest request = one_port(one, 1, 2.0 * known_plan("fcc").dwell_s);
  request.samples = 20000;
  const Forecast made = forecast(request);
  const double p = 1.0 - (43.0 * 42.0) / (50.0 * 49.0);
  // Within 4 standard errors.
  EXPECT_NEAR(made.probability[0], p, 4.0 * std::sqrt(p * (1.0 - p) / 20000.0));
}

TEST(Forecast, SharesSlotsAmongMany) {
  const LinkStates all = heard_on(8);
  const ForecastRequest request = one_port(all, 2000, 1.0);
  const LinkSettings link = physical(request.ports[0].antenna)->gen2->link;
  // Framed ALOHA at its optimum reads in 1/e of the slots, with as many empty (R. Roberts, 1975).
  const double read = std::exp(-1.0);
  const double slot_s = query_rep_s(link, Session::kS1) + read * read_slot_s(link) +
                        read * empty_slot_s(link) + (1.0 - 2.0 * read) * collided_slot_s(link);
  const double best = read / slot_s;
  const Forecast made = forecast(request);
  EXPECT_LT(made.tags_read.mean, 1.05 * best);
  EXPECT_GT(made.tags_read.mean, 0.7 * best);
}

/// Tags that were read stay silent until all are read, whatever the session, even if a reader then
/// inventories them again. So as many reads as there are tags include all of them.
TEST(Forecast, ReadsAllTagsOnceBeforeAnyTwice) {
  const LinkStates all = heard_on(8);
  for (const Session session : {Session::kS0, Session::kS2}) {
    ForecastRequest request = one_port(all, 150, 0.0);
    const ForecastPort asked = port_with("a", session);
    RadioModel model = *physical(asked.antenna);
    model.gen2->inventory.target = Target::kAlternate;
    request.ports = {asked};
    request.ports[0].antenna.model = std::make_shared<const RadioModel>(model);
    const double slot_s = query_rep_s(model.gen2->link, session) + read_slot_s(model.gen2->link);
    // At least one slot per tag; at worst a read in 0.7/e of the slots.
    request.duration_s = 150.0 * slot_s * std::exp(1.0) / 0.7;
    EXPECT_EQ(forecast(request).tags_read.mean, 150.0);
    request.duration_s = 75.0 * slot_s;
    EXPECT_LE(forecast(request).tags_read.high, 76.0);
  }
}

TEST(Forecast, IsTheSameForAnyNumberOfThreads) {
  const LinkStates some = heard_on(3);
  ForecastRequest request = one_port(some, 300, 1.0);
  const Forecast alone = forecast(request);
  request.threads = 4;
  const Forecast together = forecast(request);
  EXPECT_EQ(alone.probability, together.probability);
  EXPECT_EQ(alone.by_port, together.by_port);
}

TEST(RangeOf, IsStudentsPredictionRange) {
  // For 10 samples 0 … 9: mean 4.5, s = 3.0277, t(0.975; 9) = 2.262; plus half a count.
  std::vector<double> samples;
  for (int i = 0; i < 10; ++i) samples.push_back(i);
  const Forecasted range = range_of(samples, 100.0);
  EXPECT_NEAR(range.mean, 4.5, 1e-12);
  EXPECT_NEAR(range.high, 4.5 + 2.262 * 3.02765 * std::sqrt(1.1) + 0.5, 0.03);
  EXPECT_EQ(range.low, 0.0);
}

TEST(SampledCarriers, StandForAllChannels) {
  RadioModel model = isotropic_model();
  for (const char* const name : {"fcc", "etsi_low", "etsi_high", "china"}) {
    model.plan = known_plan(name);
    const std::vector<double> sampled = sampled_carriers(model);
    EXPECT_EQ(hopped_channels(model), model.plan.carriers_hz.size());
    for (std::size_t channel = 0; channel < model.plan.carriers_hz.size(); ++channel) {
      const std::size_t of_channel = sampled_carrier_of(model, channel);
      ASSERT_LT(of_channel, sampled.size()) << name;
      // None is nearer.
      const double off_hz = std::abs(model.plan.carriers_hz[channel] - sampled[of_channel]);
      for (const double other : sampled) {
        EXPECT_LE(off_hz, std::abs(model.plan.carriers_hz[channel] - other) + 1.0) << name;
      }
    }
  }
  model.effects.hopping = false;
  EXPECT_EQ(hopped_channels(model), 1U);
  EXPECT_EQ(sampled_carrier_of(model, 0), 0U);
}

}  // namespace
}  // namespace tagfield
