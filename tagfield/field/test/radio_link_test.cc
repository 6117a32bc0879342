// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/radio_link.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tagfield/base/units.h"
#include "tagfield/channel/paper_model.h"
#include "tagfield/field/radio_port.h"
#include "tagfield/field/tag_population.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

RadioWorld empty_world() {
  Diagnostics diagnostics;
  return radio_world(Scene{}, {}, diagnostics);
}

/// A circularly polarized antenna of 6 dBi that radiates `eirp_dbm`, without other effects.
RadioModel antenna(double eirp_dbm, double frequency_hz) {
  RadioModel model;
  model.effects = no_effects();
  model.effects.polarization = true;
  model.antenna.gain_dbi = 6.0;
  model.antenna.polarization = PolarizationKind::kRightCircular;
  model.transmit_power_dbm = eirp_dbm - 6.0;
  model.plan = fixed_plan(frequency_hz);
  return model;
}

TagModel tag(double gain_dbi, double sensitivity_dbm) {
  TagModel model;
  model.antenna.gain_dbi = gain_dbi;
  model.sensitivity_dbm = sensitivity_dbm;
  return model;
}

RadioLink link_at(const RadioModel& model, const TagModel& kind, const RadioWorld& world,
                  double distance_m) {
  const RadioView view = view_from(model, world, {}, model.plan.carriers_hz.front(), 0, 1);
  std::vector<RadioPath> paths;
  return link_of(view, {kind, from_xyz_rpy({distance_m, 0, 0}, {0, 0, kPi}), 7}, paths);
}

struct RangeCase {
  double frequency_hz;
  double eirp_dbm;
  double range_m;
};

class PublishedRange : public testing::TestWithParam<RangeCase> {};

TEST_P(PublishedRange, IsWhereTheChipGetsItsSensitivity) {
  const auto [frequency, eirp, range] = GetParam();
  const RadioWorld world = empty_world();
  const RadioModel model = antenna(eirp, frequency);
  const TagModel kind = tag(2.0, -20.0);
  // The figures assume a polarization loss of 3 dB, which is 10 log10 2 here: 0.12 % of the range.
  EXPECT_GE(tag_margin_db(link_at(model, kind, world, range - 0.025), kind), 0.0);
  EXPECT_LT(tag_margin_db(link_at(model, kind, world, range + 0.01), kind), 0.0);
}

INSTANTIATE_TEST_SUITE_P(EtsiAndFcc, PublishedRange,
                         testing::Values(RangeCase{865.7e6, 35.15, 14.05},
                                         RangeCase{915e6, 36.0, 14.66}));

TEST(Reply, IsAsStrongAsTheBudgetOnPaperSays) {
  const RadioWorld world = empty_world();
  const RadioModel model = antenna(35.15, 865.7e6);
  const TagModel kind = tag(2.0, -20.0);
  // Rounded to 0.1 dB, and for twice 3 dB of polarization loss instead of 20 log10 2.
  constexpr double kRounding = 0.05 + 0.021;
  EXPECT_NEAR(link_at(model, kind, world, 1.0).reply_dbm, -28.2, kRounding);
  EXPECT_NEAR(link_at(model, kind, world, 2.0).reply_dbm, -40.3, kRounding);
  EXPECT_NEAR(link_at(model, kind, world, 5.0).reply_dbm, -56.2, kRounding);
}

TEST(Reply, PhaseGrowsByTheRoundTrip) {
  const RadioWorld world = empty_world();
  for (const auto& [frequency, slope] : {std::pair{865.7e6, 36.287}, std::pair{915e6, 38.354}}) {
    const RadioModel model = antenna(35.15, frequency);
    const auto phase = [&](double d) {
      return reply_of(link_at(model, tag(2.0, -20.0), world, d), 0.0, Vector3d::Zero()).phase_rad;
    };
    EXPECT_NEAR(wrap_to_pi(phase(3.01) - phase(3.0)), 0.01 * slope, 1e-5);
    EXPECT_NEAR(wrap_to_pi(phase(3.0) - 4.0 * kPi * 3.0 / wavelength(frequency)), 0.0, 1e-9);
  }
}

TEST(Reply, WithoutEffectsHasThePapersMean) {
  // Eq. (5) with gain G is 40 log10(Gλ/(4πD)): a power of 40 log10 G above the plain link.
  const RadioWorld world = empty_world();
  RadioModel model = antenna(0.0, 865.7e6);
  model.effects = no_effects();
  model.antenna = {};
  constexpr double kGain = 3.0;
  model.transmit_power_dbm = 40.0 * std::log10(kGain);
  TagModel kind = tag(0.0, -90.0);
  kind.modulation_db = 0.0;
  PaperModel paper;
  paper.communication_gain = kGain;
  for (double d = 0.3; d < 7.0; d += 0.1) {
    const RadioLink link = link_at(model, kind, world, d);
    EXPECT_EQ(std::round(link.reply_dbm), paper_rssi_dbm(paper, d, 0.0)) << d;
    const Reply reply = reply_of(link, 0.0, Vector3d::Zero());
    EXPECT_NEAR(wrap_to_pi(reply.phase_rad - paper_phase(paper, d, 0.0)), 0.0, 1e-9) << d;
  }
}

TEST(Doppler, IsTwiceTheRadialSpeedOverTheWavelength) {
  const RadioWorld world = empty_world();
  const RadioModel model = antenna(35.15, 865.7e6);
  const RadioLink link = link_at(model, tag(2.0, -20.0), world, 3.0);
  const Vector3d nearer(1.5, 0.3, 0.0);
  EXPECT_NEAR(reply_of(link, 0.0, nearer).doppler_hz, 2.0 * 1.5 / wavelength(865.7e6), 1e-9);
}

TEST(Doppler, IsThePhasesRateOfChangeAmongManyPaths) {
  Scene scene;
  scene.collisions.push_back({"hall", Box{{8.0, 6.0, 3.0}}, from_translation({3.0, 1.0, 1.0})});
  Diagnostics diagnostics;
  const RadioWorld world = radio_world(scene, {}, diagnostics);
  RadioModel model = antenna(35.15, 865.7e6);
  model.effects.reflections = model.effects.occlusion = model.effects.patterns = true;
  model.effects.diffuse = true;
  model.diffuse_k_db = 6.0;
  model.reflection_order = 2;
  const TagModel kind = tag(2.0, -20.0);
  const auto link_from = [&](const Vector3d& p) {
    const RadioView view = view_from(model, world, from_translation(p), 865.7e6, 3, 1);
    std::vector<RadioPath> paths;
    return link_of(view, {kind, from_xyz_rpy({3.0, 0.5, 0.4}, {0.2, 0, 2.0}), 7}, paths);
  };
  const Vector3d v(0.3, -0.2, 0.1);
  constexpr double kShort = 1e-5;
  const double before = reply_of(link_from(-kShort * v), 0.0, v).phase_rad;
  const double after = reply_of(link_from(kShort * v), 0.0, v).phase_rad;
  const double by_difference = -wrap_to_pi(after - before) / (2.0 * kShort) / kTwoPi;
  // Patterns and polarization change slightly with the direction, which the slope ignores.
  EXPECT_NEAR(reply_of(link_from(Vector3d::Zero()), 0.0, v).doppler_hz, by_difference, 0.15);
}

TEST(Receiver, OfItsOwnMakesTheProductOfTwoLinks) {
  const RadioWorld world = empty_world();
  RadioModel model = antenna(35.15, 865.7e6);
  model.antenna.polarization = PolarizationKind::kLinear;  // The same towards both positions.
  model.X_AR = from_translation({0.0, 1.0, 0.0});
  const RadioLink link = link_at(model, tag(2.0, -20.0), world, 2.0);
  const double lambda = wavelength(865.7e6);
  EXPECT_NEAR(std::abs(link.forward) / std::abs(link.backward), std::sqrt(5.0) / 2.0, 1e-3);
  const double expected = -kTwoPi / lambda * (2.0 + std::sqrt(5.0));
  EXPECT_NEAR(wrap_to_pi(std::arg(link.forward * link.backward) - expected), 0.0, 0.02);
}

/// Two metal walls, 3 m from the path on both sides.
RadioWorld walls() {
  Scene scene;
  for (const double y : {-3.5, 3.5}) {
    scene.collisions.push_back({"wall::l::c", Box{{20.0, 1.0, 8.0}}, from_translation({0, y, 0})});
  }
  RadioWorldOptions options;
  options.rules = {{"wall", find_material(known_materials(), "metal"), {}}};
  Diagnostics diagnostics;
  return radio_world(scene, options, diagnostics);
}

TEST(MovingBodies, TakeOfEachPathWhatTheyTakeOfItsLegs) {
  const RadioWorld world = walls();
  RadioModel model = antenna(30.0, 915e6);
  model.effects.occlusion = true;
  model.effects.reflections = true;
  model.reflection_order = 2;
  const TagModel kind = tag(2.0, -20.0);
  const RigidTransform X_WA = from_translation({-2.0, 0.4, 0.0});
  const RigidTransform X_WT = from_xyz_rpy({2.0, -0.3, 0.1}, {0, 0, kPi});
  RadioView view = view_from(model, world, X_WA, 915e6, 0, 1);
  MovingBody body;
  body.material = find_material(known_materials(), "metal");
  body.p_W = {0.2, 0.1, 0.0};
  body.half_m = {0.2, 0.3, 0.9};
  view.bodies = {body};
  std::vector<RadioPath> paths;
  trace_paths(world.scene, *view.images, X_WT.translation, view.tracing, paths);
  ASSERT_GE(paths.size(), 5U);
  std::complex<double> sum = 0.0;
  const ChannelEffects effects{false, true};
  for (const RadioPath& path : paths) {
    std::complex<double> h =
        path_gain(path, {model.antenna, X_WA}, {kind.antenna, X_WT}, world, view.carrier, effects);
    std::vector<Vector3d> points = {X_WA.translation};
    for (int i = 0; i < path.bounce_count; ++i) {
      points.push_back(path.bounces.at(static_cast<std::size_t>(i)).p_W);
    }
    points.push_back(X_WT.translation);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      h *= past_body(body, points[i], points[i + 1], view.carrier);
    }
    sum += h;
  }
  const TagEnd end{kind, X_WT, 7};
  EXPECT_LT(std::abs(link_of(view, end, paths).forward - sum), 1e-12);
  // The tag's images give the same result, with reversed paths.
  const ImageSet images = images_of(world.scene, X_WT.translation, view.tracing);
  const TagEnd with_images{kind, X_WT, 7, &images};
  EXPECT_LT(std::abs(link_of(view, with_images, paths).forward - sum), 1e-9);
  view.bodies.clear();
  EXPECT_GT(std::abs(link_of(view, end, paths).forward - sum), 1e-3);
}

bool is_equal(const RadioLink& one, const RadioLink& other) {
  return one.forward == other.forward && one.backward == other.backward &&
         one.tag_dbm == other.tag_dbm && one.reply_dbm == other.reply_dbm &&
         one.phase_slope_W == other.phase_slope_W;
}

RC_GTEST_PROP(PathCache, ChangesNoLink, ()) {
  static const RadioWorld world = walls();
  RadioModel model = antenna(30.0, 915e6);
  model.effects.occlusion = true;
  model.effects.reflections = true;
  model.effects.diffuse = *rc::gen::arbitrary<bool>();
  model.diffuse_k_db = 6.0;
  model.reflection_order = *rc::gen::inRange(0, 3);
  if (*rc::gen::arbitrary<bool>()) model.X_AR = from_translation({0.0, 0.4, 0.0});
  const std::array<TagModel, 2> kinds{tag(2.0, -20.0), tag(0.0, -15.0)};
  MovingBody body;
  body.material = find_material(known_materials(), "metal");
  body.half_m = {0.2, 0.3, 0.9};
  PathCache there;
  PathCache back;
  std::vector<RadioPath> paths;
  // The properties of the link that change from one time to the next: often none.
  for (int time = 0; time < 30; ++time) {
    const int turn = *rc::gen::element(0, 0, 0, 1);
    const RigidTransform X_WA =
        from_xyz_rpy({-2.0, 0.1 * *rc::gen::element(0, 0, 0, 1), 0.0}, {0.0, 0.0, 0.3 * turn});
    const RigidTransform X_WT =
        from_xyz_rpy({2.0, -0.3 * *rc::gen::element(1, 1, 1, 2), 0.1}, {0.0, 0.0, kPi});
    const double frequency_hz = *rc::gen::element(915e6, 915.5e6, 916e6);
    RadioView view = view_from(model, world, X_WA, frequency_hz, 3, 1);
    if (*rc::gen::inRange(0, 5) == 0) view.bodies = {body};
    const TagModel& kind = kinds.at(*rc::gen::element(0U, 0U, 0U, 1U));
    const RadioLink plain = link_of(view, {kind, X_WT, 7}, paths);
    const RadioLink kept = link_of(view, {kind, X_WT, 7, nullptr, nullptr, &there, &back}, paths);
    RC_ASSERT(is_equal(plain, kept));
  }
}

TEST(PathCache, KeepsGainsOfEndsAtRestByCarrier) {
  const RadioWorld world = walls();
  RadioModel model = antenna(30.0, 915e6);
  model.effects.occlusion = true;
  const TagModel kind = tag(2.0, -20.0);
  PathCache memory;
  std::vector<RadioPath> paths;
  for (int time = 0; time < 200; ++time) {
    const double frequency_hz = 902e6 + 0.25e6 * (time % 100);
    const RadioView view = view_from(model, world, {}, frequency_hz, 0, 1);
    link_of(view, {kind, from_translation({2.0, 0.0, 0.0}), 7, nullptr, nullptr, &memory}, paths);
  }
  EXPECT_EQ(memory.gains.size(), 64U);
  const RadioView moved = view_from(model, world, from_translation({0.1, 0, 0}), 902e6, 0, 1);
  link_of(moved, {kind, from_translation({2.0, 0.0, 0.0}), 7, nullptr, nullptr, &memory}, paths);
  EXPECT_TRUE(memory.gains.empty());
}

TEST(Diffuse, HasThePowerOfItsKFactor) {
  const RadioWorld world = empty_world();
  RadioModel model = antenna(35.15, 865.7e6);
  model.effects.diffuse = true;
  model.diffuse_k_db = 3.0;
  const TagModel kind = tag(2.0, -20.0);
  double direct = 0.0;
  double rest = 0.0;
  std::vector<RadioPath> paths;
  constexpr int kTags = 4000;
  for (std::uint64_t key = 0; key < kTags; ++key) {
    const RadioView view = view_from(model, world, {}, 865.7e6, 3, 1);
    const std::complex<double> h =
        link_of(view, {kind, from_xyz_rpy({3, 0, 0}, {0, 0, kPi}), key}, paths).forward;
    RadioModel still = model;
    still.effects.diffuse = false;
    const RadioView plain = view_from(still, world, {}, 865.7e6, 3, 1);
    const std::complex<double> alone =
        link_of(plain, {kind, from_xyz_rpy({3, 0, 0}, {0, 0, kPi}), key}, paths).forward;
    direct += std::norm(alone);
    rest += std::norm(h - alone);
  }
  // Relative error of a mean of this many exponential draws: 1.6 %; five of those.
  EXPECT_NEAR(rest / direct, std::pow(10.0, -0.3), 0.08 * std::pow(10.0, -0.3));
}

TEST(MostRange, IsTheFreeSpaceRange) {
  EXPECT_NEAR(max_range_m(antenna(35.15, 865.7e6), tag(2.0, -20.0)), 14.05 * std::sqrt(2.0), 0.05);
}

/// Two kinds of tags on a spiral in all orientations, in runs of the same kind.
std::vector<TagEnd> tags_on_a_spiral(const TagModel& first, const TagModel& second) {
  std::vector<TagEnd> tags;
  for (int i = 0; i < 300; ++i) {
    const double t = 0.1 * i;
    const RigidTransform X_WT = from_xyz_rpy(
        {(0.5 + t) * std::cos(t), (0.5 + t) * std::sin(t), 0.1 * t}, {t, 0.3 * t, -0.7 * t});
    tags.push_back({i % 150 < 100 ? first : second, X_WT, 7});
  }
  return tags;
}

// The same antenna with occlusion switched on, in a world without obstacles: its links are traced
// one by one.
TEST(LinksOf, AreThoseThatAreTracedOneByOneInEmptySpace) {
  const RadioWorld world = empty_world();
  TagModel dipole = tag(2.15, -18.0);
  dipole.antenna.shape = PatternShape::kDipole;
  const TagModel even = tag(1.0, -15.0);
  const std::vector<TagEnd> tags = tags_on_a_spiral(dipole, even);
  for (const bool has_receiver : {false, true}) {
    RadioModel model = antenna(33.0, 865.7e6);
    model.effects.patterns = true;
    model.antenna.shape = PatternShape::kPatch;
    model.antenna.beam_width_rad = radians(70.0);
    model.antenna.vertical_beam_width_rad = radians(65.0);
    if (has_receiver) model.X_AR = from_translation({0.0, 0.4, 0.1});
    RadioModel looking = model;
    looking.effects.occlusion = true;
    const RigidTransform X_WA = from_xyz_rpy({0.2, 0.1, 1.5}, {0.1, 0.2, 0.3});
    const RadioView view = view_from(model, world, X_WA, 865.7e6, 0, 1);
    const RadioView traced = view_from(looking, world, X_WA, 865.7e6, 0, 1);
    std::vector<RadioPath> paths;
    std::vector<RadioLink> links(tags.size());
    links_of(view, tags, paths, links);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const RadioLink other = link_of(traced, tags[i], paths);
      EXPECT_NEAR(links[i].tag_dbm, other.tag_dbm, 1e-9) << i;
      EXPECT_NEAR(links[i].reply_dbm, other.reply_dbm, 1e-9) << i;
      EXPECT_NEAR(wrap_to_pi(std::arg(links[i].forward) - std::arg(other.forward)), 0.0, 1e-9);
      EXPECT_NEAR(wrap_to_pi(std::arg(links[i].backward) - std::arg(other.backward)), 0.0, 1e-9);
      EXPECT_LT((links[i].phase_slope_W - other.phase_slope_W).norm(), 1e-9);
      const RadioLink alone = link_of(view, tags[i], paths);
      EXPECT_EQ(alone.forward, links[i].forward);
      EXPECT_EQ(alone.backward, links[i].backward);
      EXPECT_EQ(alone.tag_dbm, links[i].tag_dbm);
      EXPECT_EQ(alone.reply_dbm, links[i].reply_dbm);
      EXPECT_EQ(alone.phase_slope_W, links[i].phase_slope_W);
    }
  }
}

// A coupled tag is not computed in the batch of the others, whose links remain bit-identical.
TEST(LinksOf, AreTheSameBesideTagsThatCouple) {
  const RadioWorld world = empty_world();
  TagModel dipole = tag(2.15, -18.0);
  dipole.antenna.shape = PatternShape::kDipole;
  std::vector<TagEnd> tags = tags_on_a_spiral(dipole, dipole);
  const RadioModel model = antenna(33.0, 865.7e6);
  const RadioView view = view_from(model, world, from_translation({0.2, 0.1, 1.5}), 865.7e6, 0, 1);
  std::vector<RadioPath> paths;
  std::vector<RadioLink> alone(tags.size());
  links_of(view, tags, paths, alone);
  TagSurroundings halved;
  halved.own = 0.5;
  for (std::size_t i = 0; i < tags.size(); i += 37) tags[i].around = &halved;
  std::vector<RadioLink> links(tags.size());
  links_of(view, tags, paths, links);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const double share = tags[i].around != nullptr ? 0.5 : 1.0;
    EXPECT_NEAR(links[i].tag_dbm, alone[i].tag_dbm + to_db(share * share), 1e-9);
    if (share == 1.0) {
      EXPECT_EQ(links[i].forward, alone[i].forward) << i;
    }
  }
}

TEST(StraightLinksOf, AreThoseOfATagOfThePopulation) {
  const RadioWorld world = empty_world();
  const RadioModel model = antenna(33.0, 865.7e6);
  const RadioView view = view_from(model, world, from_translation({0.2, 0.1, 1.5}), 865.7e6, 0, 1);
  TagPopulation tags(3.5);
  std::vector<TagInView> seen;
  for (std::uint32_t i = 0; i < 100; ++i) {
    tags.add(i, std::to_string(i), {0.1 * i, 3.0, 1.0});
  }
  tags.for_each([&](std::uint32_t slot) {
    seen.push_back({&tags.model(slot), {&tags.rotation(slot), &tags.position(slot)}});
  });
  std::vector<RadioLink> links(seen.size());
  straight_links_of(view, seen, links);
  std::vector<RadioPath> paths;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const RadioLink link = link_of(view, {tags.model(i), tags.pose(i), tags.key(i)}, paths);
    EXPECT_EQ(links[i].forward, link.forward);
    EXPECT_EQ(links[i].reply_dbm, link.reply_dbm);
  }
}

TEST(ReplyPhases, AreThoseOfTheRepliesInEveryInstructionSet) {
  const RadioWorld world = empty_world();
  const TagModel even = tag(1.0, -15.0);
  const std::vector<TagEnd> tags = tags_on_a_spiral(even, even);
  for (const bool has_receiver : {false, true}) {
    RadioModel model = antenna(33.0, 865.7e6);
    if (has_receiver) model.X_AR = from_translation({0.0, 0.4, 0.1});
    const RadioView view =
        view_from(model, world, from_translation({0.2, 0.1, 1.5}), 865.7e6, 0, 1);
    std::vector<RadioPath> paths;
    std::vector<RadioLink> links(tags.size());
    links_of(view, tags, paths, links);
    links.push_back({});  // Nothing arrives.
    for (const double offset : {0.0, 6.283, -17.0, 12345.0}) {
      std::vector<double> phases(links.size());
      reply_phases(view, links, offset, phases, InstructionSet::kBaseline);
      for (std::size_t i = 0; i < links.size(); ++i) {
        const double alone = reply_of(links[i], offset, Vector3d::Zero()).phase_rad;
        EXPECT_TRUE(0.0 <= phases[i] && phases[i] < kTwoPi) << phases[i];
        EXPECT_NEAR(wrap_to_pi(phases[i] - alone), 0.0, 3e-15 + 1e-15 * std::abs(offset)) << i;
      }
      for (const InstructionSet set : instruction_sets()) {
        for (const std::size_t count : {1U, 7U, 65U, 301U}) {
          std::vector<double> some(count);
          reply_phases(view, {links.data(), count}, offset, some, set);
          EXPECT_TRUE(std::equal(some.begin(), some.end(), phases.begin()));
        }
      }
    }
  }
}

}  // namespace
}  // namespace tagfield
