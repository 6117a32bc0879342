// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which values of which scenario keys a sweep runs, as plain structs. docs/sweep.md describes the
/// YAML format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// A closed interval of numbers.
struct NumberSpan {
  double from = 0.0;
  double to = 1.0;
  bool logarithmic = false;  ///< Steps are factors; then 0 < from < to.
  bool integer = false;      ///< Rounded to integers.
  std::size_t steps = 0;     ///< Number of values that a grid takes from it, at least 2.
};

/// A key of the scenario, as for `--set`, and its values, as YAML.
struct SweptKey {
  std::string key;
  std::variant<std::vector<std::string>, NumberSpan> values;
  Location location;
};

/// Every combination of the keys' values; the last key varies fastest.
struct GridDesign {
  std::vector<SweptKey> keys;
};

/// Explicitly listed points: key and value, as YAML.
struct ListDesign {
  std::vector<std::vector<std::pair<std::string, std::string>>> points;
};

/// Points such that, with each key's range divided into as many equal strata as there are points,
/// each stratum contains one point (McKay, Beckman and Conover, 1979). Listed values are used in
/// turn.
struct LatinHypercubeDesign {
  std::size_t points = 0;
  std::uint64_t seed = 1;
  std::vector<SweptKey> keys;
};

/// The quantity by which points are ranked.
enum class SweepTarget { kMean, kMedian, kP95, kMax, kLocated, kWrong, kFalseClaims };

/// Successive halving (Jamieson and Talwalkar, 2016): all points get a few seeds, the best ones get
/// more, and so on until the last ones have all.
struct Halving {
  SweepTarget target = SweepTarget::kMean;
  std::string method;             ///< Name of the method whose results are compared.
  std::uint64_t first_seeds = 1;  ///< Of each point in the first rung.
  std::uint64_t keep_one_in = 3;  ///< Share of points kept per rung, as 1/n; seeds grow n-fold.
};

struct SweepDesign {
  std::variant<GridDesign, ListDesign, LatinHypercubeDesign> points;
  std::optional<Halving> adaptive;
  Location location;
};

}  // namespace tagfield
