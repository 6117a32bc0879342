// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tagfield/base/random.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/statistics.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/paper_model.h"

namespace tagfield {
namespace {

using Parameters = std::vector<double>;
using Cdf = std::function<double(double)>;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHuge = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();

std::vector<double> draws_of(const OptionalDistribution& distribution, std::size_t count) {
  std::vector<double> draws;
  for (std::size_t i = 0; i < count; ++i) {  // As in the simulator: one stream per event.
    RandomStream stream(5, Purpose::kOptionalNoise, 1, 2, i);
    draws.push_back(draw(distribution, stream));
  }
  return draws;
}

/// Regularized lower incomplete gamma function by its power series (DLMF 8.7.1), all of whose
/// terms are positive.
double gamma_p(double a, double x) {
  if (x <= 0.0) return 0.0;
  double term = std::exp(a * std::log(x) - x - std::lgamma(a + 1.0));
  double sum = term;
  for (int n = 1; n < 2000; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return sum;
}

struct Case {
  std::string name;
  Parameters parameters;
  Cdf cdf;
};

/// Cumulative distribution functions from textbooks.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [a, b] : {std::pair{-1.0, 1.0}, {0.0, 6.28}, {10.0, 10.5}}) {
    all.push_back({"uniform_real_distribution", {a, b}, [a = a, b = b](double x) {
                     return std::clamp((x - a) / (b - a), 0.0, 1.0);
                   }});
  }
  for (const double rate : {0.1, 1.0, 20.0}) {
    all.push_back({"exponential_distribution", {rate}, [rate](double x) {
                     return x < 0.0 ? 0.0 : -std::expm1(-rate * x);
                   }});
  }
  for (const auto& [shape, scale] : {std::pair{0.5, 2.0}, {1.0, 1.0}, {2.5, 0.3}, {9.0, 0.5}}) {
    all.push_back({"gamma_distribution", {shape, scale}, [k = shape, s = scale](double x) {
                     return gamma_p(k, x / s);
                   }});
  }
  for (const auto& [shape, scale] : {std::pair{0.5, 1.0}, {1.5, 2.0}, {3.0, 0.1}}) {
    all.push_back({"weibull_distribution", {shape, scale}, [k = shape, s = scale](double x) {
                     return x < 0.0 ? 0.0 : -std::expm1(-std::pow(x / s, k));
                   }});
  }
  for (const auto& [m, s] : {std::pair{0.0, 1.0}, {-2.0, 0.1}, {3.0, 40.0}}) {
    all.push_back({"normal_distribution", {m, s}, [m = m, s = s](double x) {
                     return statistics::normal_cdf((x - m) / s);
                   }});
  }
  for (const auto& [m, s] : {std::pair{0.0, 1.0}, {1.0, 0.25}, {-3.0, 2.0}}) {
    all.push_back({"lognormal_distribution", {m, s}, [m = m, s = s](double x) {
                     return x <= 0.0 ? 0.0 : statistics::normal_cdf((std::log(x) - m) / s);
                   }});
  }
  for (const double n : {1.0, 3.0, 10.0}) {
    all.push_back(
        {"chi_squared_distribution", {n}, [n](double x) { return gamma_p(0.5 * n, 0.5 * x); }});
  }
  for (const auto& [m, s] : {std::pair{0.0, 1.0}, {3.0, 0.01}, {-1.0, 50.0}}) {
    all.push_back({"cauchy_distribution", {m, s}, [m = m, s = s](double x) {
                     return 0.5 + std::atan((x - m) / s) / kPi;
                   }});
  }
  return all;
}

TEST(GammaPOfThisTest, GivesPublishedFigures) {
  // χ² tables: the 95 % quantile at 1, 3 and 10 degrees of freedom.
  EXPECT_NEAR(gamma_p(0.5, 0.5 * 3.841), 0.95, 1e-4);
  EXPECT_NEAR(gamma_p(1.5, 0.5 * 7.815), 0.95, 1e-4);
  EXPECT_NEAR(gamma_p(5.0, 0.5 * 18.307), 0.95, 1e-4);
}

class Draw : public testing::TestWithParam<Case> {};

TEST_P(Draw, PassesTheGoodnessOfFitTest) {
  const auto draws = draws_of(make_distribution(GetParam().name, GetParam().parameters), 20'000);
  EXPECT_LT(statistics::kolmogorov(draws, GetParam().cdf), statistics::kKolmogorovBound);
}

TEST_P(Draw, IsAFunctionOfItsStream) {
  const auto distribution = make_distribution(GetParam().name, GetParam().parameters);
  EXPECT_EQ(draws_of(distribution, 100), draws_of(distribution, 100));
}

TEST_P(Draw, IsIndependentFromStreamToStream) {
  const auto draws = draws_of(make_distribution(GetParam().name, GetParam().parameters), 20'000);
  std::vector<double> before;  // Mapped by the distribution function, so that heavy tails do no
                               // harm.
  std::vector<double> after;
  for (std::size_t i = 1; i < draws.size(); ++i) {
    before.push_back(GetParam().cdf(draws[i - 1]));
    after.push_back(GetParam().cdf(draws[i]));
  }
  EXPECT_LT(std::abs(statistics::correlation_deviate(before, after)), statistics::kNormalBound);
}

INSTANTIATE_TEST_SUITE_P(EachDistribution, Draw, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& each) {
                           return each.param.name + "_" + std::to_string(each.index);
                         });

TEST(DrawOfNone, IsZero) {
  RandomStream stream(1, Purpose::kOptionalNoise);
  EXPECT_EQ(draw(OptionalDistribution(), stream), 0.0);
  EXPECT_EQ(draw(make_distribution("none", {}), stream), 0.0);
}

TEST(DrawAtTheEdges, IsFinite) {
  const std::vector<std::pair<std::string, Parameters>> edges = {
      {"uniform_real_distribution", {-8e307, 8e307}}, {"uniform_real_distribution", {0.0, kTiny}},
      {"exponential_distribution", {kTiny}},          {"exponential_distribution", {kHuge}},
      {"gamma_distribution", {1e-300, kHuge}},        {"gamma_distribution", {kHuge, kHuge}},
      {"gamma_distribution", {0.001, 1.0}},           {"weibull_distribution", {kTiny, 1.0}},
      {"weibull_distribution", {kHuge, kHuge}},       {"normal_distribution", {kHuge, kHuge}},
      {"normal_distribution", {-kHuge, kHuge}},       {"lognormal_distribution", {kHuge, 1.0}},
      {"lognormal_distribution", {-kHuge, kHuge}},    {"lognormal_distribution", {0.0, 1000.0}},
      {"chi_squared_distribution", {1e-300}},         {"chi_squared_distribution", {kHuge}},
      {"cauchy_distribution", {kHuge, kHuge}},        {"cauchy_distribution", {0.0, kHuge}},
  };
  for (const auto& [name, parameters] : edges) {
    for (const double value : draws_of(make_distribution(name, parameters), 200)) {
      ASSERT_TRUE(std::isfinite(value)) << name << ' ' << parameters[0];
    }
  }
}

TEST(MakeDistribution, KnowsTheEightNamesAndNone) {
  EXPECT_EQ(distribution_names(),
            (std::vector<std::string>{
                "none", "uniform_real_distribution", "exponential_distribution",
                "gamma_distribution", "weibull_distribution", "normal_distribution",
                "lognormal_distribution", "chi_squared_distribution", "cauchy_distribution"}));
  EXPECT_EQ(make_distribution("none", {}).kind, DistributionKind::kNone);
  const auto gamma = make_distribution("gamma_distribution", {2.0, 0.5});
  EXPECT_EQ(gamma.kind, DistributionKind::kGamma);
  EXPECT_EQ(gamma.parameters, (std::array<double, 2>{2.0, 0.5}));
}

TEST(MakeDistribution, NamesTheNearestOfAMisspeltName) {
  const std::string message = error_of([] { make_distribution("guasian_distribution", {0, 1}); });
  EXPECT_TRUE(contains(message, "unknown distribution 'guasian_distribution'")) << message;
  EXPECT_TRUE(contains(message, "_distribution'?")) << message;
  const std::string cauchy = error_of([] { make_distribution("cauchi_distribution", {0, 1}); });
  EXPECT_TRUE(contains(cauchy, "did you mean 'cauchy_distribution'")) << cauchy;
  EXPECT_TRUE(contains(error_of([] { make_distribution("", {}); }), "known: none, uniform"));
}

TEST(MakeDistribution, WantsTheRightNumberOfParameters) {
  for (const std::string& name : distribution_names()) {
    const std::size_t right = name == "none"                                           ? 0
                              : name.rfind("exp", 0) == 0 || name.rfind("chi", 0) == 0 ? 1
                                                                                       : 2;
    for (std::size_t count = 0; count < 4; ++count) {
      Parameters parameters;
      for (std::size_t i = 0; i < count; ++i) parameters.push_back(1.0 + static_cast<double>(i));
      const std::string message = error_of([&] { make_distribution(name, parameters); });
      if (count == right) {
        EXPECT_EQ(message, "(no error)");
      } else {
        EXPECT_TRUE(contains(message, name + " takes " + std::to_string(right))) << message;
        EXPECT_TRUE(contains(message, "got " + std::to_string(count))) << message;
      }
    }
  }
}

TEST(MakeDistribution, RefusesParametersOutOfRange) {
  const std::vector<std::pair<std::string, Parameters>> bad = {
      {"uniform_real_distribution", {1.0, 1.0}},
      {"uniform_real_distribution", {2.0, 1.0}},
      {"uniform_real_distribution", {-1e308, 1e308}},
      {"exponential_distribution", {0.0}},
      {"exponential_distribution", {-1.0}},
      {"gamma_distribution", {0.0, 1.0}},
      {"gamma_distribution", {1.0, 0.0}},
      {"weibull_distribution", {-1.0, 1.0}},
      {"weibull_distribution", {1.0, 0.0}},
      {"normal_distribution", {0.0, 0.0}},
      {"normal_distribution", {0.0, -1.0}},
      {"lognormal_distribution", {0.0, 0.0}},
      {"chi_squared_distribution", {0.0}},
      {"chi_squared_distribution", {-2.0}},
      {"cauchy_distribution", {0.0, 0.0}},
      {"cauchy_distribution", {0.0, -1.0}},
  };
  for (const auto& [name, parameters] : bad) {
    const std::string message =
        error_of([&, &n = name, &p = parameters] { make_distribution(n, p); });
    EXPECT_TRUE(contains(message, name + ": ")) << name << ": " << message;
  }
}

TEST(MakeDistribution, RefusesWhatIsNotFinite) {
  for (const std::string& name : distribution_names()) {
    for (const double bad : {kNotANumber, kInfinity, -kInfinity}) {
      if (name == "none") continue;
      const bool one = name.rfind("exp", 0) == 0 || name.rfind("chi", 0) == 0;
      EXPECT_THROW(make_distribution(name, one ? Parameters{bad} : Parameters{bad, 1.0}), Error);
      const Parameters second = one ? Parameters{-1.0} : Parameters{1.0, bad};
      EXPECT_THROW(make_distribution(name, second), Error);
    }
  }
}

}  // namespace
}  // namespace tagfield
