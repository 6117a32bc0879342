// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/radio_air.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tagfield/base/units.h"
#include "tagfield/channel/mutual_impedance.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

constexpr double kFrequency = 865.7e6;

std::shared_ptr<const RadioWorld> free_space() {
  Diagnostics diagnostics;
  return std::make_shared<const RadioWorld>(radio_world(Scene{}, {}, diagnostics));
}

/// Isotropic ends in free space, without noise, so that the reads are known in closed form.
RadioModel plain_model() {
  RadioModel model;
  model.effects = no_effects();
  model.plan = fixed_plan(kFrequency);
  model.transmit_power_dbm = 30.0;
  return model;
}

RadioModel gen2_model(Session session = Session::kS0) {
  RadioModel model = plain_model();
  model.effects.inventory = true;
  model.gen2 = Gen2Reader{};
  model.gen2->inventory.session = session;
  model.gen2->inventory.target = session == Session::kS0 ? Target::kAlternate : Target::kA;
  return model;
}

AntennaParameters antenna(const std::string& reader, const std::string& name,
                          const RadioModel& model) {
  AntennaParameters parameters;
  parameters.reader = reader;
  parameters.name = name;
  parameters.rate_hz = 15.0;
  parameters.model = std::make_shared<const RadioModel>(model);
  return parameters;
}

std::shared_ptr<const TagModel> isotropic_tag() {
  TagModel tag;
  tag.sensitivity_dbm = -15.0;
  return std::make_shared<const TagModel>(tag);
}

TagPopulation row_of_tags(int count, double spacing_m) {
  TagPopulation tags(3.0);
  const auto kind = isotropic_tag();
  for (int i = 0; i < count; ++i) {
    const auto slot = static_cast<std::uint32_t>(i);
    tags.add(slot, "tag" + std::to_string(i), {2.0, spacing_m * i, 0.0});
    tags.set_model(slot, kind);
  }
  return tags;
}

Time at_update(int number) { return time_from_seconds(number / 15.0); }

/// Distance at which −15 dBm are received of 30 dBm: 20 log10(4πd/λ) = 45.
double range_of_plain_link() {
  return wavelength(kFrequency) / (4.0 * kPi) * std::pow(10.0, 45.0 / 20.0);
}

TEST(RadioAir, WithoutInventoryReadsAllThatAnswersOnceAnUpdate) {
  RadioAir air(free_space());
  air.add(antenna("r", "a", plain_model()), 1);
  const TagPopulation tags = row_of_tags(20, 0.5);
  std::vector<TagReply> replies;
  air.update("a", {}, at_update(0), tags, replies);
  std::size_t expected = 0;
  for (int i = 0; i < 20; ++i) {
    if (std::hypot(2.0, 0.5 * i) <= range_of_plain_link()) ++expected;
  }
  ASSERT_EQ(replies.size(), expected);
  EXPECT_LT(expected, 20U);
  for (const TagReply& reply : replies) {
    const double d = tags.position(reply.slot).norm();
    EXPECT_EQ(reply.stamp, at_update(0));
    EXPECT_EQ(reply.frequency_hz, kFrequency);
    EXPECT_NEAR(wrap_to_pi(reply.phase_rad - 4.0 * kPi * d / wavelength(kFrequency)), 0.0, 1e-9);
    EXPECT_NEAR(reply.distance_m, d, 1e-12);
  }
}

TEST(RadioAir, InventoryStampsEachReadAndMeasuresItWhereTheAntennaWasThen) {
  RadioAir air(free_space());
  air.add(antenna("r", "a", gen2_model()), 1);
  TagPopulation tags = row_of_tags(5, 0.2);
  const Vector3d antenna_speed(0.0, 0.6, 0.0);
  const Vector3d tag_speed(-0.3, 0.0, 0.1);
  const auto tag_at = [&](std::uint32_t slot, double t) -> Vector3d {
    const Vector3d start(2.0, 0.2 * slot, 0.0);
    return slot == 3 ? Vector3d(start + tag_speed * t) : start;
  };
  std::vector<TagReply> replies;
  std::set<Time> stamps;
  std::set<std::uint32_t> seen;
  for (int i = 0; i < 30; ++i) {
    const double now = to_seconds(at_update(i));
    tags.move(3, tag_at(3, now));
    air.update("a", from_translation(antenna_speed * now), at_update(i), tags, replies);
    for (const TagReply& reply : replies) {
      const double t = to_seconds(reply.stamp);
      const double d = (tag_at(reply.slot, t) - antenna_speed * t).norm();
      EXPECT_NEAR(wrap_to_pi(reply.phase_rad - 4.0 * kPi * d / wavelength(kFrequency)), 0.0, 1e-6);
      const Vector3d way = (tag_at(reply.slot, t) - antenna_speed * t) / d;
      const Vector3d closing = antenna_speed - (reply.slot == 3 ? tag_speed : Vector3d::Zero());
      EXPECT_NEAR(*reply.doppler_hz, 2.0 * way.dot(closing) / wavelength(kFrequency), 1e-3);
      EXPECT_LE(reply.stamp, at_update(i));
      stamps.insert(reply.stamp);
      seen.insert(reply.slot);
    }
    if (i > 0) {
      EXPECT_GT(replies.size(), 1U) << i;
    }
  }
  EXPECT_EQ(seen.size(), 5U);
  EXPECT_GT(stamps.size(), 150U);  // No two simultaneous reads.
}

TEST(RadioAir, TagsThatAreOutOfPowerAreNotRead) {
  RadioAir air(free_space());
  air.add(antenna("r", "a", gen2_model()), 1);
  const TagPopulation tags = row_of_tags(20, 0.5);
  std::vector<TagReply> replies;
  for (int i = 0; i < 30; ++i) {
    air.update("a", {}, at_update(i), tags, replies);
    for (const TagReply& reply : replies) EXPECT_LE(reply.distance_m, range_of_plain_link());
  }
  EXPECT_GT(air.counts("a")->rounds, 10);
  EXPECT_FALSE(air.counts("b"));
}

TEST(RadioAir, PortsReadInTheirTurnsOnly) {
  RadioAir air(free_space());
  RadioModel model = gen2_model();
  model.gen2->port_dwell_s = 0.25;
  air.add(antenna("r", "a", model), 1);
  air.add(antenna("r", "b", model), 1);
  const TagPopulation tags = row_of_tags(3, 0.3);
  std::vector<TagReply> replies;
  std::map<std::string, int> reads;
  for (int i = 0; i < 60; ++i) {
    for (const std::string name : {"a", "b"}) {
      air.update(name, {}, at_update(i), tags, replies);
      for (const TagReply& reply : replies) {
        const double into = std::fmod(to_seconds(reply.stamp), 0.5);
        EXPECT_EQ(into < 0.25, name == "a") << name << ' ' << to_seconds(reply.stamp);
        ++reads[name];
      }
    }
  }
  EXPECT_GT(reads["a"], 50);
  EXPECT_GT(reads["b"], 50);
}

TEST(RadioAir, TagsRememberInASessionWhoeverAsks) {
  RadioAir air(free_space());
  air.add(antenna("r", "a", gen2_model(Session::kS2)), 1);
  air.add(antenna("q", "z", gen2_model(Session::kS2)), 1);
  const TagPopulation tags = row_of_tags(10, 0.3);
  std::vector<TagReply> replies;
  std::multiset<std::uint32_t> read;
  for (int i = 0; i < 60; ++i) {
    for (const std::string name : {"a", "z"}) {
      air.update(name, {}, at_update(i), tags, replies);
      for (const TagReply& reply : replies) read.insert(reply.slot);
    }
  }
  for (std::uint32_t slot = 0; slot < 10; ++slot) EXPECT_EQ(read.count(slot), 1U) << slot;
}

TEST(RadioAir, TagInAFreedSlotIsAnother) {
  RadioAir air(free_space());
  air.add(antenna("r", "a", gen2_model(Session::kS2)), 1);
  TagPopulation tags = row_of_tags(1, 0.3);
  std::vector<TagReply> replies;
  int reads = 0;
  for (int i = 0; i < 40; ++i) {
    if (i == 20) {
      air.forget_tag(0);
      tags.remove(0);
      tags.add(0, "new", {2.0, 0.1, 0.0});
      tags.set_model(0, isotropic_tag());
    }
    air.update("a", {}, at_update(i), tags, replies);
    reads += static_cast<int>(replies.size());
    EXPECT_EQ(reads, i < 1 ? 0 : (i <= 20 ? 1 : 2)) << i;
  }
}

TEST(RadioAir, GivesTheSameReadsForTheSameSeedAndOthersForAnother) {
  const auto run = [](std::uint64_t seed) {
    RadioModel model = gen2_model();
    model.effects = {};
    model.plan = known_plan("etsi_low");
    RadioAir air(free_space());
    air.add(antenna("r", "a", model), seed);
    const TagPopulation tags = row_of_tags(6, 0.3);
    std::vector<TagReply> replies;
    std::string all;
    for (int i = 0; i < 100; ++i) {
      air.update("a", from_translation({0.0, 0.02 * i, 0.0}), at_update(i), tags, replies);
      for (const TagReply& reply : replies) {
        all += std::to_string(reply.slot) + ' ' + format_stamp(reply.stamp) + ' ' +
               std::to_string(reply.phase_rad) + ' ' + std::to_string(reply.frequency_hz) + '\n';
      }
    }
    return all;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
  EXPECT_GT(run(1).size(), 1000U);
}

/// A floor and two shelves.
std::shared_ptr<const RadioWorld> furnished() {
  Scene scene;
  scene.collisions.push_back({"floor", Plane{Vector3d::UnitZ()}, {}});
  for (const double y : {-1.0, 2.0}) {
    scene.collisions.push_back(
        {"shelf", Box{Vector3d(1.2, 0.3, 1.4)}, from_translation({1.5, y, 0.7})});
  }
  Diagnostics diagnostics;
  return std::make_shared<const RadioWorld>(radio_world(scene, {}, diagnostics));
}

/// All replies of two antennas that move among closely spaced tags, by `threads` threads.
std::string replies_by(int threads, int tag_count, const RadioModel& model) {
  RadioAir air(furnished(), threads);
  air.add(antenna("r", "a", model), 1);
  air.add(antenna("s", "b", model), 1);
  TagPopulation tags(3.0);
  for (int i = 0; i < tag_count; ++i) {
    const auto slot = static_cast<std::uint32_t>(i);
    tags.add(slot, "tag" + std::to_string(i), {2.0 + 0.05 * (i % 7), 0.05 * (i / 7), 0.9});
    tags.set_model(slot, isotropic_tag());
  }
  std::vector<TagReply> replies;
  std::string all;
  for (int i = 0; i < 4; ++i) {
    tags.move(3, {2.0 - 0.1 * i, 0.4, 1.1});
    for (const std::string name : {"a", "b"}) {
      const Vector3d start(0.0, name == "a" ? 0.5 : 1.5, 1.2);
      air.update(name, from_translation(start + Vector3d(0.0, 0.02 * i, 0.0)), at_update(i), tags,
                 replies);
      for (const TagReply& reply : replies) {
        all += fmt::format("{} {} {} {} {} {}\n", name, reply.slot, format_stamp(reply.stamp),
                           reply.phase_rad, reply.rssi_dbm, *reply.doppler_hz);
      }
    }
  }
  return all;
}

TEST(RadioAir, RepliesDoNotDependOnTheNumberOfThreads) {
  RadioModel straight = plain_model();
  straight.effects.occlusion = true;
  straight.interference = true;
  straight.effects.interference = true;
  RadioModel reflected = straight;
  reflected.effects.reflections = true;
  reflected.reflection_order = 2;
  RadioModel coupled = reflected;
  coupled.effects.coupling = true;
  coupled.tag_coupling = true;
  RadioModel inventory = gen2_model();
  inventory.effects.occlusion = true;
  inventory.effects.reflections = true;
  inventory.reflection_order = 1;
  const std::vector<std::pair<RadioModel, int>> cases{
      {straight, 600}, {reflected, 60}, {reflected, 300}, {coupled, 100}, {inventory, 120}};
  for (const auto& [model, tags] : cases) {
    const std::string one = replies_by(1, tags, model);
    EXPECT_GT(std::count(one.begin(), one.end(), '\n'), 40);
    EXPECT_EQ(replies_by(2, tags, model), one);
    EXPECT_EQ(replies_by(5, tags, model), one);
  }
}

TEST(RadioAir, AntennaThatIsNowhereReadsNothing) {
  RadioAir air(free_space());
  air.add(antenna("r", "a", gen2_model()), 1);
  const TagPopulation tags = row_of_tags(3, 0.3);
  std::vector<TagReply> replies(3);
  air.update("a", from_translation(Vector3d::Constant(std::nan(""))), at_update(0), tags, replies);
  EXPECT_TRUE(replies.empty());
  EXPECT_THROW(air.update("b", {}, at_update(0), tags, replies), Error);
  air.remove("a");
  EXPECT_THROW(air.update("a", {}, at_update(0), tags, replies), Error);
}

/// The tags that reader "r" reads in a row of tags with another reader at the end of the row.
std::set<std::uint32_t> read_beside_another(const RadioModel& model, const Vector3d& p_other) {
  RadioAir air(free_space());
  air.add(antenna("other", "z", model), 1);
  air.add(antenna("r", "a", model), 1);
  TagPopulation tags(3.0);
  for (std::uint32_t slot = 0; slot < 9; ++slot) {
    tags.add(slot, "tag" + std::to_string(slot), {0.5 * (slot + 1.0), 0.0, 0.0});
    tags.set_model(slot, isotropic_tag());
  }
  std::set<std::uint32_t> read;
  std::vector<TagReply> replies;
  for (int i = 0; i < 10; ++i) {
    air.update("z", from_translation(p_other), at_update(i), tags, replies);
    air.update("a", {}, at_update(i), tags, replies);
    for (const TagReply& reply : replies) read.insert(reply.slot);
  }
  return read;
}

TEST(RadioAir, TagsInTwoFieldsAnswerTheOneThatIsStrongEnough) {
  RadioModel model = plain_model();
  const Vector3d p_other(5.0, 0.0, 0.0);
  // The range is 4.9 m: all tags are in both fields.
  EXPECT_EQ(read_beside_another(model, p_other).size(), 9U);
  model.interference = true;
  model.effects.interference = true;
  model.gen2 = Gen2Reader{};  // Only its link counts, as the effect is off.
  model.hardware.noise_figure_db = 0.0;
  model.plan = known_plan("etsi_low");
  // Power density is proportional to 1/d²: (5 − d)/d ≥ 10^(6.94/20) = 2.223 up to d = 1.551 m.
  // Replies from there are at least −44 dBm, and the received power of the other reader at 5 m is
  // 30 − 45.2 dBm − 6 dB on the same carrier with FM0, so that Miller is required.
  EXPECT_EQ(read_beside_another(model, p_other), (std::set<std::uint32_t>{0, 1, 2}));
  model.gen2->link.encoding = Encoding::kFm0;
  EXPECT_EQ(read_beside_another(model, p_other), (std::set<std::uint32_t>{}));
}

TEST(RadioAir, OtherReadersMakePhasesNoisierInSlotsToo) {
  RadioModel model = gen2_model();
  model.effects.noise = true;
  model.hardware.phase_floor_rad = 0.0;
  model.interference = true;
  const auto spread = [&](bool disturbed) {
    RadioModel own = model;
    own.effects.interference = disturbed;
    RadioAir air(free_space());
    air.add(antenna("r", "a", own), 1);
    air.add(antenna("other", "z", own), 1);
    const TagPopulation tags = row_of_tags(1, 1.0);
    double sum = 0.0;
    int count = 0;
    std::vector<TagReply> replies;
    for (int i = 0; i < 60; ++i) {
      air.update("a", {}, at_update(i), tags, replies);
      for (const TagReply& reply : replies) {
        if (i < 3) continue;  // Before both were received.
        const double error =
            wrap_to_pi(reply.phase_rad - 4.0 * kPi * reply.distance_m / wavelength(kFrequency));
        sum += error * error;
        ++count;
      }
      air.update("z", from_translation({-8.0, 0.0, 0.0}), at_update(i), tags, replies);
    }
    EXPECT_GT(count, 300);
    return std::sqrt(sum / count);
  };
  const double noise_mw = from_db(noise_dbm(model.hardware));
  const double amplitude = wavelength(kFrequency) / (4.0 * kPi * 8.0);
  const double interference_mw =
      from_db(30.0) * amplitude * amplitude *
      share_in_replies(transmit_spectrum_of(model), 0.0, model.gen2->link, 250e3);
  EXPECT_GT(interference_mw, 10.0 * noise_mw);
  EXPECT_NEAR(spread(true) / spread(false), std::sqrt(1.0 + interference_mw / noise_mw),
              0.1 * std::sqrt(1.0 + interference_mw / noise_mw));
}

TEST(RadioAir, CoupledTagsTakeInWhatTheTwoPortGives) {
  // Two vertical dipoles at equal distances from the antenna: the same field at both, h/(1 + z) at
  // each chip.
  RadioModel model = plain_model();
  model.tag_coupling = true;
  model.effects.coupling = true;
  TagModel dipole;
  dipole.sensitivity_dbm = -15.0;
  const auto kind = std::make_shared<const TagModel>(dipole);
  const double apart_m = 0.06;
  const auto read_with = [&](const RadioModel& used) {
    RadioAir air(free_space());
    air.add(antenna("r", "a", used), 1);
    TagPopulation tags(3.0);
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      tags.add(slot, "tag" + std::to_string(slot), {2.0, apart_m * (slot - 0.5), 0.0});
      tags.set_model(slot, kind);
    }
    std::vector<TagReply> replies;
    air.update("a", {}, at_update(0), tags, replies);
    return replies;
  };
  const auto coupled = read_with(model);
  model.effects.coupling = false;
  const auto alone = read_with(model);
  ASSERT_EQ(coupled.size(), 2U);
  ASSERT_EQ(alone.size(), 2U);
  const double k = kTwoPi / wavelength(kFrequency);
  const std::complex<double> z =
      parallel_impedance(k, apart_m, 0.0) / (2.0 * kDipoleImpedance_ohm.real());
  const std::complex<double> factor = 1.0 / (1.0 + z);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(coupled[i].rssi_dbm - alone[i].rssi_dbm, 40.0 * std::log10(std::abs(factor)), 1e-9);
    EXPECT_NEAR(wrap_to_pi(coupled[i].phase_rad - alone[i].phase_rad + 2.0 * std::arg(factor)), 0.0,
                1e-9);
  }
}

}  // namespace
}  // namespace tagfield
