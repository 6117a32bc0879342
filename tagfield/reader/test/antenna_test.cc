// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/antenna.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/statistics.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::int64_t kUpdates = 20'000;

AntennaParameters antenna_named(const std::string& name, double rate_hz = 15.0) {
  AntennaParameters antenna;
  antenna.name = name;
  antenna.rate_hz = rate_hz;
  return antenna;
}

Time at(std::int64_t nanos) { return Time(Duration(nanos)); }

double any_rate() { return std::pow(10.0, 0.001 * (*rc::gen::inRange(-2000, 3001))); }

std::vector<double> phase_residuals(const AntennaParameters& antenna, const std::string& tag,
                                    double distance_m, std::uint64_t seed = 1,
                                    std::int64_t first = 0) {
  std::vector<double> residuals;
  const double expected =
      4.0 * kPi * distance_m * paper(antenna).model.frequency_hz / kSpeedOfLight;
  for (std::int64_t i = first; i < first + kUpdates; ++i) {
    const TagRead read = read_tag(antenna, tag, {distance_m}, update_stamp(antenna, i), seed);
    residuals.push_back(std::remainder(read.phase_rad - expected, kTwoPi));
  }
  return residuals;
}

TEST(UpdateStamp, CountsFromZero) {
  const AntennaParameters antenna = antenna_named("a");
  EXPECT_EQ(update_stamp(antenna, 0), at(0));
  EXPECT_EQ(update_stamp(antenna, 1), at(66'666'667));
  EXPECT_EQ(update_stamp(antenna, 15), at(1'000'000'000));
}

TEST(UpdateStamp, DoesNotDriftOverAMonth) {
  constexpr std::int64_t kDays = 30;
  EXPECT_EQ(update_stamp(antenna_named("a"), kDays * 86'400 * 15),
            at(kDays * 86'400 * 1'000'000'000));
  for (const double rate : {0.01, 0.3, 29.97, 59.94, 1000.0 / 3.0}) {
    for (std::int64_t day = 1; day <= kDays; ++day) {
      const auto number = static_cast<std::int64_t>(86'400.0 * static_cast<double>(day) * rate);
      const long double exact =
          1e9L * static_cast<long double>(number) / static_cast<long double>(rate);
      const auto nanos = update_stamp(antenna_named("a", rate), number).time_since_epoch().count();
      EXPECT_LE(std::abs(static_cast<double>(static_cast<long double>(nanos) - exact)), 1.0);
    }
  }
}

RC_GTEST_PROP(FirstUpdateAt, IsTheLeastNumberAtOrAfter, ()) {
  const AntennaParameters antenna = antenna_named("a", any_rate());
  const Time time = at(*rc::gen::inRange<std::int64_t>(0, 3'000'000'000'000'000));
  const std::int64_t number = first_update_at(antenna, time);
  RC_ASSERT(update_stamp(antenna, number) >= time);
  RC_ASSERT(update_stamp(antenna, number - 1) < time);
}

RC_GTEST_PROP(FirstUpdateAt, IsTheUpdateItselfOnItsStamp, ()) {
  const AntennaParameters antenna = antenna_named("a", any_rate());
  const auto number = *rc::gen::inRange<std::int64_t>(0, 10'000'000);
  const Time stamp = update_stamp(antenna, number);
  RC_ASSERT(first_update_at(antenna, stamp) == number);
  RC_ASSERT(first_update_at(antenna, stamp + Duration(1)) == number + 1);
  RC_ASSERT(first_update_at(antenna, stamp - Duration(1)) == number);
}

TEST(FirstUpdateAt, OfZeroIsZero) {
  for (const double rate : {0.01, 1.0, 15.0, 1000.0, 1e6}) {
    EXPECT_EQ(first_update_at(antenna_named("a", rate), at(0)), 0);
    EXPECT_EQ(first_update_at(antenna_named("a", rate), at(1)), 1);
  }
}

TEST(FirstUpdateAt, WorksWithTodaysStamps) {
  const Time now = parse_stamp("1700000000.000000000");
  EXPECT_EQ(first_update_at(antenna_named("a"), now), 25'500'000'000);
}

/// P(|1+n|·r ≥ D), n ~ N(0, σ²).
double chance_of_read(double ratio, double sigma) {
  return 1.0 - statistics::normal_cdf((ratio - 1.0) / sigma) +
         statistics::normal_cdf((-ratio - 1.0) / sigma);
}

class PerturbedRange : public testing::TestWithParam<double> {};

TEST_P(PerturbedRange, GivesTheChanceOfAReadAtEachDistance) {
  AntennaParameters antenna = antenna_named("mobile");
  paper(antenna).range_sigma = GetParam();
  for (const double deviation : {-3.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 3.0}) {
    const double distance = paper(antenna).range_m * std::abs(1.0 + deviation * GetParam());
    const double chance = chance_of_read(distance / paper(antenna).range_m, GetParam());
    double reads = 0.0;
    for (std::int64_t i = 0; i < kUpdates; ++i) {
      if (perturbed_range(antenna, update_stamp(antenna, i), 9) >= distance) reads += 1.0;
    }
    // By the normal approximation; with the 27 expected at three σ, its false-alarm probability is
    // about 2e-5.
    const double error = std::sqrt(chance * (1.0 - chance) / kUpdates);
    EXPECT_NEAR(reads / kUpdates, chance, statistics::kNormalBound * error) << distance;
  }
}

// The paper's σr, and one so large that the absolute value matters.
INSTANTIATE_TEST_SUITE_P(Sigmas, PerturbedRange, testing::Values(0.05, 0.2, 1.0));

TEST(PerturbedRangeDraw, FollowsTheFoldedNormalDistribution) {
  const AntennaParameters antenna = antenna_named("mobile");
  std::vector<double> ranges;
  for (std::int64_t i = 0; i < kUpdates; ++i) {
    ranges.push_back(perturbed_range(antenna, update_stamp(antenna, i), 9));
  }
  const auto cdf = [](double range) { return 1.0 - chance_of_read(range / 7.0, 0.05); };
  EXPECT_LT(statistics::kolmogorov(ranges, cdf), statistics::kKolmogorovBound);
}

TEST(PerturbedRangeDraw, IsOneForAnUpdateAndAnotherForEachOther) {
  const AntennaParameters antenna = antenna_named("mobile");
  std::set<double> ranges;
  for (std::int64_t i = 0; i < 1000; ++i) {
    const Time stamp = update_stamp(antenna, i);
    ranges.insert(perturbed_range(antenna, stamp, 1));
    EXPECT_EQ(perturbed_range(antenna, stamp, 1), perturbed_range(antenna, stamp, 1));
    ranges.insert(perturbed_range(antenna_named("fixed"), stamp, 1));
    ranges.insert(perturbed_range(antenna, stamp, 2));
  }
  EXPECT_EQ(ranges.size(), 3000u);
}

TEST(PerturbedRangeDraw, WithoutSpreadIsTheRange) {
  AntennaParameters antenna = antenna_named("mobile");
  paper(antenna).range_sigma = 0.0;
  for (std::int64_t i = 0; i < 100; ++i) EXPECT_EQ(perturbed_range(antenna, at(i), 1), 7.0);
}

TEST(PerturbedRangeDraw, AntennasAndUpdatesAreIndependent) {
  const AntennaParameters a = antenna_named("a");
  const AntennaParameters b = antenna_named("b");
  std::vector<double> of_a;
  std::vector<double> of_b;
  std::vector<double> next;
  for (std::int64_t i = 0; i < kUpdates; ++i) {
    of_a.push_back(perturbed_range(a, update_stamp(a, i), 1));
    of_b.push_back(perturbed_range(b, update_stamp(b, i), 1));
    next.push_back(perturbed_range(a, update_stamp(a, i + 1), 1));
  }
  using statistics::correlation_deviate;
  EXPECT_LT(std::abs(correlation_deviate(of_a, of_b)), statistics::kNormalBound);
  EXPECT_LT(std::abs(correlation_deviate(of_a, next)), statistics::kNormalBound);
}

TEST(ReadTag, ReportsWhoReadWhatAndWhen) {
  AntennaParameters antenna = antenna_named("left");
  antenna.reader = "r1";
  paper(antenna).model.frequency_hz = 915e6;
  paper(antenna).model.phase_noise_rad = 0.0;
  paper(antenna).model.rssi_noise = 0.0;
  const TagRead read = read_tag(antenna, "E280::1", {2.0}, at(123), 1);
  EXPECT_EQ(read.stamp, at(123));
  EXPECT_EQ(read.reader, "r1");
  EXPECT_EQ(read.antenna, "left");
  EXPECT_EQ(read.tag, "E280::1");
  EXPECT_EQ(read.frequency_hz, 915e6);
  EXPECT_EQ(read.phase_rad, paper_phase(paper(antenna).model, 2.0, 0.0));
  EXPECT_EQ(read.rssi_dbm, paper_rssi_dbm(paper(antenna).model, 2.0, 0.0));
}

TEST(ReadTag, IsAFunctionOfSeedAntennaTagAndStamp) {
  const AntennaParameters a = antenna_named("a");
  const auto phase = [](const AntennaParameters& antenna, const std::string& tag, std::int64_t time,
                        std::uint64_t seed) {
    return read_tag(antenna, tag, {2.0}, at(time), seed).phase_rad;
  };
  std::set<double> phases;
  for (std::int64_t time = 0; time < 200; ++time) {
    EXPECT_EQ(phase(a, "t", time, 1), phase(a, "t", time, 1));
    phases.insert({phase(a, "t", time, 1), phase(antenna_named("b"), "t", time, 1),
                   phase(a, "u", time, 1), phase(a, "t", time, 2)});
  }
  EXPECT_EQ(phases.size(), 800u);
}

TEST(ReadTag, IsTheSameWhateverElseIsRead) {
  AntennaParameters antenna = antenna_named("a");
  paper(antenna).model.optional = make_distribution("gamma_distribution", {2.0, 0.1});
  const TagRead alone = read_tag(antenna, "t", {2.0}, at(1000), 1);
  for (int others = 0; others < 20; ++others) {
    perturbed_range(antenna, at(1000), 1);
    read_tag(antenna, "other" + std::to_string(others), {1.0}, at(1000), 1);
    const TagRead again = read_tag(antenna, "t", {2.0}, at(1000), 1);
    EXPECT_EQ(again.phase_rad, alone.phase_rad);
    EXPECT_EQ(again.rssi_dbm, alone.rssi_dbm);
  }
}

TEST(ReadTag, PhaseNoiseIsNormalAroundEquationFour) {
  const AntennaParameters antenna = antenna_named("a");
  const auto cdf = [](double residual) { return statistics::normal_cdf(residual / 0.1); };
  EXPECT_LT(statistics::kolmogorov(phase_residuals(antenna, "tag1", 3.3), cdf),
            statistics::kKolmogorovBound);
}

TEST(ReadTag, PhaseNoiseIsIndependentBetweenTagsAntennasStampsAndSeeds) {
  const AntennaParameters a = antenna_named("a");
  const auto base = phase_residuals(a, "tag1", 3.3);
  for (const auto& other :
       {phase_residuals(a, "tag2", 3.3), phase_residuals(antenna_named("b"), "tag1", 3.3),
        phase_residuals(a, "tag1", 3.3, 1, 1), phase_residuals(a, "tag1", 3.3, 2)}) {
    EXPECT_LT(std::abs(statistics::correlation_deviate(base, other)), statistics::kNormalBound);
  }
  // The same noise at another distance; otherwise the test above could not fail.
  EXPECT_GT(statistics::correlation_deviate(base, phase_residuals(a, "tag1", 1.1)), 100.0);
}

using Change = std::function<void(AntennaParameters&)>;

std::string complaint(const Change& change) {
  AntennaParameters antenna;
  change(antenna);
  return error_of([&] { check(antenna); });
}

TEST(CheckAntenna, TakesTheDefaultsAndTheEdges) {
  EXPECT_EQ(complaint([](AntennaParameters& /*antenna*/) {}), "(no error)");
  EXPECT_EQ(complaint([](auto& antenna) { paper(antenna).range_sigma = 0.0; }), "(no error)");
  EXPECT_EQ(complaint([](auto& antenna) { antenna.rate_hz = 1e6; }), "(no error)");
}

TEST(CheckAntenna, NamesTheParameterThatIsBad) {
  for (const double bad : {kNan, kInfinite, -kInfinite, -1.0}) {
    EXPECT_TRUE(contains(complaint([&](auto& a) { a.rate_hz = bad; }), "rate_hz must"));
    EXPECT_TRUE(contains(complaint([&](auto& a) { paper(a).range_m = bad; }), "range_m must"));
    EXPECT_TRUE(
        contains(complaint([&](auto& a) { paper(a).range_sigma = bad; }), "range_sigma must"));
    EXPECT_TRUE(
        contains(complaint([&](auto& a) { paper(a).model.rssi_noise = bad; }), "rssi_noise must"));
  }
  EXPECT_TRUE(contains(complaint([](auto& a) { a.rate_hz = 0.0; }), "rate_hz must"));
  EXPECT_TRUE(contains(complaint([](auto& a) { a.rate_hz = 1.1e6; }), "rate_hz must"));
  EXPECT_TRUE(contains(complaint([](auto& a) { paper(a).range_m = 0.0; }), "range_m must"));
}

}  // namespace
}  // namespace tagfield
