// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tagfield/base/error.h"
#include "tagfield/base/random.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/spelling.h"
#include "tagfield/channel/paper_model.h"

namespace tagfield {
namespace {

struct Entry {
  const char* name;
  DistributionKind kind;
  std::vector<const char*> parameters;
};

const std::vector<Entry>& entries() {
  using Kind = DistributionKind;
  static const std::vector<Entry> all = {
      {"none", Kind::kNone, {}},
      {"uniform_real_distribution", Kind::kUniform, {"a", "b"}},
      {"exponential_distribution", Kind::kExponential, {"lambda"}},
      {"gamma_distribution", Kind::kGamma, {"alpha", "beta"}},
      {"weibull_distribution", Kind::kWeibull, {"a", "b"}},
      {"normal_distribution", Kind::kNormal, {"mean", "stddev"}},
      {"lognormal_distribution", Kind::kLognormal, {"m", "s"}},
      {"chi_squared_distribution", Kind::kChiSquared, {"n"}},
      {"cauchy_distribution", Kind::kCauchy, {"a", "b"}},
  };
  return all;
}

const Entry& entry_named(const std::string& name) {
  for (const Entry& entry : entries()) {
    if (name == entry.name) return entry;
  }
  throw Error(
      fmt::format("unknown distribution '{}'{}", name, suggestion(name, distribution_names())));
}

/// Which parameters must be greater than 0.
std::array<bool, 2> must_be_positive(DistributionKind kind) {
  switch (kind) {
    case DistributionKind::kExponential:
    case DistributionKind::kChiSquared:
      return {true, false};
    case DistributionKind::kGamma:
    case DistributionKind::kWeibull:
      return {true, true};
    case DistributionKind::kNormal:
    case DistributionKind::kLognormal:
    case DistributionKind::kCauchy:
      return {false, true};
    case DistributionKind::kNone:
    case DistributionKind::kUniform:
      break;
  }
  return {false, false};
}

void check_parameters(const Entry& entry, const std::vector<double>& parameters) {
  if (parameters.size() != entry.parameters.size()) {
    throw Error(fmt::format("{} takes {} parameter{} ({}), got {}", entry.name,
                            entry.parameters.size(), entry.parameters.size() == 1 ? "" : "s",
                            fmt::join(entry.parameters, ", "), parameters.size()));
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string name = fmt::format("{}: {}", entry.name, entry.parameters[i]);
    require(std::isfinite(parameters[i]), name, "finite", parameters[i]);
    require(!must_be_positive(entry.kind)[i] || parameters[i] > 0.0, name, "greater than 0",
            parameters[i]);
  }
  // The width of [a, b) must be finite, too.
  if (entry.kind == DistributionKind::kUniform &&
      !(parameters[0] < parameters[1] && std::isfinite(parameters[1] - parameters[0]))) {
    throw Error(fmt::format("{}: a must be less than b, got {} and {}", entry.name, parameters[0],
                            parameters[1]));
  }
}

double draw_unbounded(const OptionalDistribution& distribution, RandomStream& stream) {
  const auto [a, b] = distribution.parameters;
  switch (distribution.kind) {
    case DistributionKind::kNone:
      return 0.0;
    case DistributionKind::kUniform:
      return std::uniform_real_distribution<double>(a, b)(stream);
    case DistributionKind::kExponential:
      return std::exponential_distribution<double>(a)(stream);
    case DistributionKind::kGamma:
      return std::gamma_distribution<double>(a, b)(stream);
    case DistributionKind::kWeibull:
      return std::weibull_distribution<double>(a, b)(stream);
    case DistributionKind::kNormal:
      return a + b * standard_normal(stream);
    case DistributionKind::kLognormal:
      return std::exp(a + b * standard_normal(stream));
    case DistributionKind::kChiSquared:
      return std::chi_squared_distribution<double>(a)(stream);
    case DistributionKind::kCauchy:
      return std::cauchy_distribution<double>(a, b)(stream);
  }
  return 0.0;
}

}  // namespace

const std::vector<std::string>& distribution_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Entry& entry : entries()) all.emplace_back(entry.name);
    return all;
  }();
  return names;
}

OptionalDistribution make_distribution(const std::string& name,
                                       const std::vector<double>& parameters) {
  const Entry& entry = entry_named(name);
  check_parameters(entry, parameters);
  OptionalDistribution distribution;
  distribution.kind = entry.kind;
  std::copy(parameters.begin(), parameters.end(), distribution.parameters.begin());
  return distribution;
}

double draw(const OptionalDistribution& distribution, RandomStream& stream) {
  constexpr double kMost = std::numeric_limits<double>::max();
  const double value = draw_unbounded(distribution, stream);
  return std::isnan(value) ? 0.0 : std::clamp(value, -kMost, kMost);
}

}  // namespace tagfield
