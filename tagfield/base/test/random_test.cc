// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/random.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bitset>
#include <cmath>
#include <set>
#include <vector>

#include "tagfield/base/stream_words.h"
#include "tagfield/base/test/statistics.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Words = std::array<std::uint64_t, 4>;
using Key = std::array<std::uint64_t, 2>;
__extension__ using Wide = unsigned __int128;

std::uint64_t high(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::uint64_t>((static_cast<Wide>(a) * b) >> 64U);
}

/// Philox-4x64-10 as printed in section 3.3 of Salmon et al. (SC'11).
Words philox(Words x, Key key) {
  constexpr std::uint64_t kM0 = 0xD2E7470EE14C6C93;
  constexpr std::uint64_t kM1 = 0xCA5A826395121157;
  for (int round = 0; round < 10; ++round) {
    x = {high(kM1, x[2]) ^ x[1] ^ key[0], kM1 * x[2], high(kM0, x[0]) ^ x[3] ^ key[1], kM0 * x[0]};
    key[0] += 0x9E3779B97F4A7C15;
    key[1] += 0xBB67AE8584CAA73B;
  }
  return x;
}

std::vector<std::uint64_t> words_of(RandomStream stream, std::size_t count) {
  std::vector<std::uint64_t> words(count);
  for (std::uint64_t& word : words) word = stream();
  return words;
}

/// Number of bits in which two streams differ, as a deviate of N(0, 1) if they are independent.
double difference_deviate(const RandomStream& a, const RandomStream& b) {
  constexpr std::size_t kCount = 4000;
  const auto first = words_of(a, kCount);
  const auto second = words_of(b, kCount);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    differing += std::bitset<64>(first[i] ^ second[i]).count();
  }
  const double bits = 64.0 * kCount;
  return (static_cast<double>(differing) - 0.5 * bits) / std::sqrt(0.25 * bits);
}

TEST(PhiloxOfThisTest, GivesThePublishedKnownAnswers) {
  // kat_vectors of Random123: philox4x64 10, all bits zero and all bits one.
  EXPECT_EQ(philox({}, {}), (Words{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b,
                                   0x7e68b68aec7ba23b}));
  const std::uint64_t ones = ~std::uint64_t{0};
  EXPECT_EQ(
      philox({ones, ones, ones, ones}, {ones, ones}),
      (Words{0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}));
}

RC_GTEST_PROP(RandomStream, IsPhiloxOfItsKeys,
              (std::uint64_t seed, std::uint64_t a, std::uint64_t b, std::uint64_t c)) {
  const auto words = words_of(RandomStream(seed, Purpose::kOdometry, a, b, c), 12);
  for (std::uint64_t block = 0; block < 3; ++block) {
    const Words expected = philox({a, b, c, block}, {seed, 4});
    for (std::size_t i = 0; i < 4; ++i) RC_ASSERT(words[4 * block + i] == expected[i]);
  }
}

TEST(RandomStream, BytesArePinned) {
  EXPECT_EQ(words_of(RandomStream(42, Purpose::kReadRange, 1, 2, 3), 5),
            (std::vector<std::uint64_t>{0x4a8d35db6dcfad64, 0x7b2a6701d85aef86, 0xbf5066b7947d5372,
                                        0x1da386853f20cf47, 0xfc977c445c5a9d77}));
}

TEST(RandomStream, EveryKeyMakesItAnother) {
  const RandomStream base(1, Purpose::kReadNoise, 2, 3, 4);
  const std::vector<RandomStream> others = {{2, Purpose::kReadNoise, 2, 3, 4},
                                            {1, Purpose::kReadRange, 2, 3, 4},
                                            {1, Purpose::kReadNoise, 3, 3, 4},
                                            {1, Purpose::kReadNoise, 2, 4, 4},
                                            {1, Purpose::kReadNoise, 2, 3, 5}};
  for (const RandomStream& other : others) {
    EXPECT_NE(words_of(base, 1), words_of(other, 1));
    EXPECT_LT(std::abs(difference_deviate(base, other)), statistics::kNormalBound);
  }
}

TEST(RandomStream, LagsAreUncorrelated) {
  constexpr std::size_t kCount = 40'000;
  std::vector<double> draws;
  for (const std::uint64_t word : words_of(RandomStream(7, Purpose::kReadNoise), kCount + 8)) {
    draws.push_back(static_cast<double>(word) * 0x1p-64);
  }
  const std::vector<double> first(draws.begin(), draws.begin() + kCount);
  for (const int lag : {1, 2, 3, 4, 5, 8}) {
    const std::vector<double> later(draws.begin() + lag, draws.begin() + lag + kCount);
    EXPECT_LT(std::abs(statistics::correlation_deviate(first, later)), statistics::kNormalBound)
        << lag;
  }
  const auto cdf = [](double u) { return u; };
  EXPECT_LT(statistics::kolmogorov(draws, cdf), statistics::kKolmogorovBound);
}

TEST(Uniform, IsTheTopOfAWord) {
  RandomStream words(3, Purpose::kReadNoise);
  RandomStream draws(3, Purpose::kReadNoise);
  RandomStream above(3, Purpose::kReadNoise);
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t top = words() / 2048;
    EXPECT_EQ(std::ldexp(uniform(draws), 53), static_cast<double>(top));
    EXPECT_EQ(std::ldexp(uniform_above_0(above), 53), static_cast<double>(top + 1));
  }
}

TEST(StandardNormalPair, FollowsBoxAndMullersFormula) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomStream words(seed, Purpose::kReadNoise);
    RandomStream normals(seed, Purpose::kReadNoise);
    const double turn = static_cast<double>(static_cast<std::int64_t>(words())) * 0x1p-63;
    const double radius =
        std::sqrt(-2.0 * std::log((static_cast<double>(words()) + 0.5) * 0x1p-64));
    const auto [x, y] = standard_normal_pair(normals);
    EXPECT_NEAR(x, radius * std::sin(kPi * turn), 1e-9);
    EXPECT_NEAR(y, radius * std::cos(kPi * turn), 1e-9);
  }
}

TEST(StandardNormalPair, HasTheNormalDistribution) {
  constexpr std::size_t kCount = 40'000;
  std::vector<double> first;
  std::vector<double> second;
  std::vector<double> first_squared;
  std::vector<double> second_squared;
  for (std::uint64_t i = 0; i < kCount; ++i) {  // As in the simulator: one stream per event.
    RandomStream stream(11, Purpose::kReadNoise, 1, 2, i);
    const auto [x, y] = standard_normal_pair(stream);
    first.push_back(x);
    second.push_back(y);
    first_squared.push_back(x * x);
    second_squared.push_back(y * y);
  }
  using namespace statistics;
  for (const auto& draws : {first, second}) {
    EXPECT_LT(kolmogorov(draws, normal_cdf), kKolmogorovBound);
    EXPECT_LT(std::abs(mean(draws)) * std::sqrt(kCount), kNormalBound);
    // The variance of a sample's variance is 2/n.
    EXPECT_LT(std::abs(variance(draws) - 1.0) * std::sqrt(kCount / 2.0), kNormalBound);
  }
  EXPECT_LT(std::abs(correlation_deviate(first, second)), kNormalBound);
  EXPECT_LT(std::abs(correlation_deviate(first_squared, second_squared)), kNormalBound);
}

TEST(StandardNormal, IsTheFirstOfThePair) {
  RandomStream one(3, Purpose::kPoseError);
  RandomStream two(3, Purpose::kPoseError);
  EXPECT_EQ(standard_normal(one), standard_normal_pair(two)[0]);
}

TEST(FirstWords, AreThoseOfEachStream) {
  const std::vector<std::uint64_t> keys = {0, 1, 7, ~std::uint64_t{0}};
  std::vector<std::uint64_t> first(keys.size());
  std::vector<std::uint64_t> second(keys.size());
  first_words(5, Purpose::kReadNoise, 11, keys, 13, first, second);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    RandomStream stream(5, Purpose::kReadNoise, 11, keys[i], 13);
    EXPECT_EQ(first[i], stream());
    EXPECT_EQ(second[i], stream());
  }
}

TEST(StreamKey, IsFnv1a) {
  // Test vectors of FNV-1a, 64 bits (Fowler, Noll, Vo; appendix C of the IETF draft).
  EXPECT_EQ(stream_key(""), 0xcbf29ce484222325U);
  EXPECT_EQ(stream_key("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(stream_key("foobar"), 0x85944171f73967e8U);
}

TEST(StreamKey, TellsManyNamesApart) {
  std::set<std::uint64_t> keys;
  for (int i = 0; i < 100'000; ++i) keys.insert(stream_key("tag" + std::to_string(i)));
  EXPECT_EQ(keys.size(), 100'000u);
  EXPECT_NE(stream_key("\xff"), stream_key("\x7f"));
}

}  // namespace
}  // namespace tagfield
