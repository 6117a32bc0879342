// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/fixed.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "method_study.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/fixed/channel_offsets.h"

namespace tagfield {
namespace {

using namespace made;

constexpr double kRoom = 6.0;    // [m]
constexpr double kHeight = 1.0;  // Of tags and antennas [m].

struct Room {
  LocalizationProblem problem;
  std::map<std::string, Eigen::Vector3d> truth;
};

struct RoomNoise {
  double phase_rad = 0.1;
  double fading_db = 3.0;
  double slope_db = 32.0;
  double antenna_db = 3.0;
};

Eigen::Vector3d corner(int number) {
  return {kRoom * (number % 2), kRoom * static_cast<int>(number / 2), kHeight};
}

double carrier(int channel) { return 902.75e6 + 0.5e6 * channel; }

using Places = std::map<std::string, Eigen::Vector3d>;

/// Four antennas in the corners read tags on 50 channels twice; each channel of each port has its
/// own offset. No tag area is given.
Room room_with(const Places& truth, const RoomNoise& noise, Rng& rng) {
  Room made;
  made.truth = truth;
  made.problem.heights.of_all = kHeight;
  for (int a = 0; a < 4; ++a) {
    const std::string antenna = "port" + std::to_string(a);
    made.problem.tracks[antenna].X_WA.push_back({Time{}, from_translation(corner(a))});
    const double level = -45.0 + normal(rng, noise.antenna_db);
    std::vector<double> offsets;
    for (int c = 0; c < 50; ++c) offsets.push_back(uniform(rng, 0.0, kTwoPi));
    for (const auto& [tag, p_WT] : made.truth) {
      const double distance = (p_WT - corner(a)).norm();
      const double rssi =
          level - noise.slope_db * std::log10(distance) + normal(rng, noise.fading_db);
      for (int i = 0; i < 100; ++i) {
        const double k = 2.0 * kTwoPi / wavelength(carrier(i % 50));
        made.problem.samples[tag][antenna].push_back(
            {time_from_seconds(0.05 * i + 0.01 * a),
             wrap_to_two_pi(offsets[static_cast<std::size_t>(i % 50)] + k * distance +
                            normal(rng, noise.phase_rad)),
             carrier(i % 50), corner(a), rssi});
      }
    }
  }
  return made;
}

/// A room with tags between the corners.
Room room(int tags, const RoomNoise& noise, Rng& rng) {
  Places truth;
  for (int i = 0; i < tags; ++i) {
    truth["t" + std::to_string(100 + i)] = {uniform(rng, 0.3, kRoom - 0.3),
                                            uniform(rng, 0.3, kRoom - 0.3), kHeight};
  }
  Room made = room_with(truth, noise, rng);
  made.problem.area.box =
      Eigen::AlignedBox2d(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(kRoom, kRoom));
  return made;
}

LocalizationResult located(const Room& room, Diagnostics& diagnostics,
                           const FixedOptions& options = {}) {
  return fixed_method(options).locate(room.problem, 1, diagnostics);
}

Tally tally_of(const Room& room, const LocalizationResult& result) {
  Tally tally;
  for (const TagEstimate& estimate : result.estimates) {
    if (room.problem.reference_tags.count(estimate.tag) > 0) continue;
    tally.add(estimate, room.truth.at(estimate.tag));
  }
  return tally;
}

double calibration_of(const Tally& tally) {
  return std::sqrt(tally.square_ratios / static_cast<double>(tally.errors.size()));
}

/// Variance of a position from the slopes of phase over frequency, in closed form: the slope of a
/// line through n points about their mean, with one reference tag as noisy as the tag. RSSI adds
/// nothing to it.
double bound(const Eigen::Vector3d& p_WT, double sigma_rad, int reads) {
  double mean = 0.0;
  double squares = 0.0;
  for (int c = 0; c < 50; ++c) mean += 2.0 * kTwoPi / wavelength(carrier(c)) / 50.0;
  for (int c = 0; c < 50; ++c) {
    squares += std::pow(2.0 * kTwoPi / wavelength(carrier(c)) - mean, 2);
  }
  const double of_distance = 2.0 * sigma_rad * sigma_rad / (reads * squares);
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (int a = 0; a < 4; ++a) {
    const Eigen::Vector2d u = (p_WT - corner(a)).head<2>().normalized();
    information += u * u.transpose() / of_distance;
  }
  return information.inverse().trace();
}

TEST(Fixed, MeetsTheBoundOfPhasesOverChannelsWithOneReferenceTag) {
  Rng rng(3);
  Room made = room(31, {}, rng);
  made.problem.reference_tags["t100"] = made.truth.at("t100");
  Diagnostics diagnostics;
  const LocalizationResult result = located(made, diagnostics);
  double squares = 0.0;
  double bounds = 0.0;
  for (const TagEstimate& estimate : result.estimates) {
    ASSERT_EQ(estimate.verdict, Verdict::kLocated) << estimate.reason;
    if (estimate.tag == "t100") continue;
    const Eigen::Vector3d& p_WT = made.truth.at(estimate.tag);
    squares += std::pow(level_error(estimate.candidates.front(), p_WT), 2);
    bounds += bound(p_WT, 0.1, 2);
  }
  // The reference's noise is common to all errors, so they scatter more than 60 independent
  // coordinates.
  EXPECT_GT(std::sqrt(squares / bounds), 0.6);
  EXPECT_LT(std::sqrt(squares / bounds), 1.4);
  EXPECT_LT(calibration_of(tally_of(made, result)), 1.6);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(Fixed, TagsBeyondTheAntennasAreLocatedOnAllSides) {
  Rng rng(12);
  const RoomNoise noise{0.1, 0.1, 40.0, 0.1};
  constexpr double kHalf = 0.5 * kRoom;
  constexpr double kBeyond = 1.0;  // [m]
  const Places beyond{{"below", {kHalf, -kBeyond, kHeight}},
                      {"left", {-kBeyond, kHalf, kHeight}},
                      {"above", {kHalf, kRoom + kBeyond, kHeight}},
                      {"right", {kRoom + kBeyond, kHalf, kHeight}}};
  const Places references = room(4, noise, rng).truth;
  Places truth = references;
  truth.insert(beyond.begin(), beyond.end());
  Room made = room_with(truth, noise, rng);
  made.problem.reference_tags = references;
  made.problem.has_phases = false;
  FixedOptions options;
  options.fading_db = options.antenna_sigma_db = options.tag_sigma_db = 0.1;
  Diagnostics diagnostics;
  for (const TagEstimate& estimate : located(made, diagnostics, options).estimates) {
    if (beyond.count(estimate.tag) == 0) continue;
    ASSERT_EQ(estimate.verdict, Verdict::kLocated) << estimate.tag << " " << estimate.reason;
    EXPECT_LT(level_error(estimate.candidates.front(), beyond.at(estimate.tag)), 0.4)
        << estimate.tag;
  }
}

TEST(Fixed, StrengthsAloneGiveHonestPlacesAndItSaysWhatIsMissing) {
  Rng rng(4);
  double squares = 0.0;
  double count = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Room made = room(20, {}, rng);
    Diagnostics diagnostics;
    const Tally tally = tally_of(made, located(made, diagnostics));
    squares += tally.square_ratios;
    count += static_cast<double>(tally.errors.size());
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    EXPECT_NE(diagnostics.warnings().front().find("--reference"), std::string::npos);
  }
  EXPECT_GT(count, 60.0);
  EXPECT_GT(std::sqrt(squares / count), 0.75);
  EXPECT_LT(std::sqrt(squares / count), 1.25);
}

TEST(Fixed, LearnsALawWithoutNoise) {
  Rng rng(5);
  const Room made = room(20, {0.1, 0.0, 30.0, 2.0}, rng);
  Diagnostics diagnostics;
  FixedOptions options;
  options.tag_sigma_db = 0.1;
  Tally tally = tally_of(made, located(made, diagnostics, options));
  tally.finish();
  EXPECT_EQ(tally.errors.size(), 20U);
  EXPECT_LT(tally.mean(), 0.3);
}

/// Rooms whose RSSI follows its law almost exactly, as stated: positions are then known to
/// centimetres, which is far less than the cells of the first grid.
TEST(Fixed, ALawThatHoldsExactlyIsFoundWithoutABox) {
  FixedOptions options;
  options.fading_db = 0.2;
  options.antenna_sigma_db = options.tag_sigma_db = 0.1;
  options.slope_sigma_db = 1.0;
  Rng rng(13);
  for (int i = 0; i < 6; ++i) {
    Room made = room(6, {0.1, 0.2, 40.0, 0.1}, rng);
    made.problem.area.box.reset();
    made.problem.has_phases = false;
    Diagnostics diagnostics;
    const Tally tally = tally_of(made, located(made, diagnostics, options));
    ASSERT_EQ(tally.errors.size(), 6U) << i;
    EXPECT_LT(*std::max_element(tally.errors.begin(), tally.errors.end()), 0.5) << i;
  }
}

/// Where nothing says that tags can be far outside the antennas, a box of 18 m around the room
/// tells as much as none, and neither pulls tags out of it.
TEST(Fixed, AGenerousBoxIsAsGoodAsNone) {
  Rng rng(14);
  Tally with;
  Tally without;
  for (int i = 0; i < 4; ++i) {
    Room made = room(20, {}, rng);
    made.problem.has_phases = false;
    Diagnostics diagnostics;
    made.problem.area.box = Eigen::AlignedBox2d(Eigen::Vector2d(-kRoom, -kRoom),
                                                Eigen::Vector2d(2.0 * kRoom, 2.0 * kRoom));
    for (const TagEstimate& estimate : located(made, diagnostics).estimates) {
      with.add(estimate, made.truth.at(estimate.tag));
    }
    made.problem.area.box.reset();
    for (const TagEstimate& estimate : located(made, diagnostics).estimates) {
      without.add(estimate, made.truth.at(estimate.tag));
    }
  }
  with.finish();
  without.finish();
  EXPECT_GT(with.errors.size(), 60U);
  EXPECT_GT(without.errors.size(), 60U);
  EXPECT_NEAR(with.mean() / without.mean(), 1.0, 0.2);
  EXPECT_LT(without.mean(), 2.0);
  for (const Tally& tally : {with, without}) {
    EXPECT_GT(calibration_of(tally), 0.75);
    EXPECT_LT(calibration_of(tally), 1.25);
  }
}

TEST(Fixed, StrengthsThatSayNothingLocateNothing) {
  Rng rng(6);
  for (int i = 0; i < 12; ++i) {
    Room made = room(1 + i, {}, rng);
    for (auto& [tag, samples] : made.problem.samples) {
      for (auto& [antenna, series] : samples) {
        const double rssi = uniform(rng, -75.0, -35.0);
        for (PhaseSample& sample : series) sample.rssi_dbm = rssi;
      }
    }
    Diagnostics diagnostics;
    for (const TagEstimate& estimate : located(made, diagnostics).estimates) {
      EXPECT_EQ(estimate.verdict, Verdict::kNotLocated) << i;
    }
  }
}

void exchange(Room& made, const std::string& one, int place, const std::string& other,
              int other_place) {
  for (auto& [tag, samples] : made.problem.samples) {
    for (PhaseSample& sample : samples[one]) sample.p_WA = corner(other_place);
    for (PhaseSample& sample : samples[other]) sample.p_WA = corner(place);
  }
}

TEST(Fixed, SwappedAntennasAreRefusedAndNamed) {
  Rng rng(10);
  Room made = room(16, {0.1, 1.5, 32.0, 1.0}, rng);
  exchange(made, "port0", 0, "port1", 1);
  Diagnostics diagnostics;
  for (const TagEstimate& estimate : located(made, diagnostics).estimates) {
    EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
    EXPECT_NE(estimate.reason.find("'port0' and 'port1' exchanged"), std::string::npos)
        << estimate.reason;
  }
}

// If neighbours in a square are exchanged, half of the order is still right, so a path-loss law
// mostly still holds.
TEST(Fixed, SwappedAntennasAreFoundThoughALawHolds) {
  Rng rng(11);
  int located_tags = 0;
  for (int i = 0; i < 4; ++i) {
    Room made = room(20, {}, rng);
    exchange(made, "port0", 0, "port2", 2);
    Diagnostics diagnostics;
    for (const TagEstimate& estimate : located(made, diagnostics).estimates) {
      located_tags += estimate.verdict == Verdict::kLocated ? 1 : 0;
    }
  }
  EXPECT_EQ(located_tags, 0);
}

TEST(Fixed, ATagThatTwoAntennasReadIsRefusedWithWhatWouldHelp) {
  Rng rng(7);
  Room made = room(5, {}, rng);
  made.problem.samples["t100"].erase("port0");
  made.problem.samples["t100"].erase("port1");
  Diagnostics diagnostics;
  const TagEstimate estimate = located(made, diagnostics).estimates.front();
  EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
  EXPECT_NE(estimate.reason.find("by 2 antennas at rest, at least 3"), std::string::npos);
}

std::vector<std::vector<FixedReads>> reads_of(const Room& room) {
  std::vector<std::vector<FixedReads>> all;
  for (const auto& [tag, samples] : room.problem.samples) {
    all.push_back(fixed_reads(room.problem, samples));
  }
  return all;
}

TEST(Fixed, ChannelsReportedInAnotherOrderAreFoundOut) {
  Rng rng(8);
  Room made = room(24, {0.3, 3.0, 32.0, 3.0}, rng);
  EXPECT_FALSE(is_out_of_order(reads_of(made)));
  std::vector<int> order;
  for (int c = 0; c < 50; ++c) order.push_back(c);
  std::shuffle(order.begin(), order.end(), rng);
  for (auto& [tag, samples] : made.problem.samples) {
    for (auto& [antenna, series] : samples) {
      for (PhaseSample& sample : series) {
        const auto channel =
            static_cast<std::size_t>(std::lround((sample.frequency_hz - carrier(0)) / 0.5e6));
        sample.frequency_hz = carrier(order[channel]);
      }
    }
  }
  EXPECT_TRUE(is_out_of_order(reads_of(made)));
  EXPECT_FALSE(is_out_of_order(reads_of(room(4, {}, rng))));  // Too few tags to tell.
}

/// By the definition of the beam width: half the power one way, a quarter there and back.
TEST(Lobe, HalfAWidthOffItsBoresightIsHalfThePower) {
  Lobe lobe;
  lobe.beam_width_deg = 70.0;
  const Eigen::Vector3d off(std::cos(radians(35.0)), std::sin(radians(35.0)), 0.0);
  EXPECT_NEAR(lobe_db(lobe, Eigen::Vector3d::UnitX(), off), 20.0 * std::log10(0.5), 1e-9);
  EXPECT_NEAR(lobe_db(lobe, Eigen::Vector3d::UnitX(), 3.0 * Eigen::Vector3d::UnitX()), 0.0, 1e-12);
  EXPECT_NEAR(lobe_db(lobe, Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitX()), -50.0, 1e-9);
  EXPECT_EQ(lobe_db({}, Eigen::Vector3d::UnitX(), off), 0.0);
}

/// Known antenna lobes are compensated; if they are not known, the same RSSI values mislead.
TEST(Fixed, KnownLobesAreTakenOut) {
  Rng rng(9);
  Room made = room(20, {0.1, 0.5, 40.0, 0.0}, rng);
  FixedOptions with;
  with.beam_width_deg = 60.0;
  for (int a = 0; a < 4; ++a) {
    const std::string antenna = "port" + std::to_string(a);
    RigidTransform& X_WA = made.problem.tracks[antenna].X_WA.front().X_WB;
    const Eigen::Vector3d inwards = Eigen::Vector3d(kRoom / 2, kRoom / 2, kHeight) - corner(a);
    X_WA.rotation =
        Eigen::AngleAxisd(std::atan2(inwards.y(), inwards.x()), Eigen::Vector3d::UnitZ());
    for (auto& [tag, samples] : made.problem.samples) {
      const double gain = lobe_db(with, inwards, made.truth.at(tag) - corner(a));
      for (PhaseSample& sample : samples[antenna]) sample.rssi_dbm += gain;
    }
  }
  Diagnostics diagnostics;
  Tally known = tally_of(made, located(made, diagnostics, with));
  Tally unknown = tally_of(made, located(made, diagnostics));
  known.finish();
  unknown.finish();
  ASSERT_GE(known.errors.size(), 18U);
  ASSERT_GE(unknown.errors.size(), 10U);
  EXPECT_LT(known.mean(), 0.5 * unknown.mean());
}

}  // namespace
}  // namespace tagfield
