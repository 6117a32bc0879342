// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which values of which scenario keys a sweep tries, as plain structs. docs/sweep.md tells how to
/// write one as YAML.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// Numbers from one to another, both included.
struct NumberSpan {
  double from = 0.0;
  double to = 1.0;
  bool logarithmic = false;  ///< Steps are factors; then 0 < from < to.
  bool whole = false;        ///< Rounded to whole numbers.
  std::size_t steps = 0;     ///< How many values a grid takes of it, at least 2.
};

/// A key of the scenario, as after `--set`, and the values that it is given, as YAML.
struct SweptKey {
  std::string key;
  std::variant<std::vector<std::string>, NumberSpan> values;
  Location location;
};

/// Every combination of the keys' values; the last key varies fastest.
struct GridDesign {
  std::vector<SweptKey> keys;
};

/// Points as they are given: key and value, as YAML.
struct ListDesign {
  std::vector<std::vector<std::pair<std::string, std::string>>> points;
};

/// So many points that each key's range, cut into as many strata of equal share, has one point in
/// each (McKay, Beckman and Conover, 1979). Values that are listed take turns.
struct LatinHypercubeDesign {
  std::size_t points = 0;
  std::uint64_t seed = 1;
  std::vector<SweptKey> keys;
};

/// What the best points are best in.
enum class SweepTarget { kMean, kMedian, kP95, kMax, kLocated, kWrong, kFalseClaims };

/// Successive halving (Jamieson and Talwalkar, 2016): all points get some seeds, the best part of
/// them more, and so on until the last have all.
struct Halving {
  SweepTarget target = SweepTarget::kMean;
  std::string method;             ///< By name; that whose results are compared.
  std::uint64_t first_seeds = 1;  ///< Of each point in the first rung.
  std::uint64_t keep_one_in =
      3;  ///< Of the points, for the next rung, with as many times the seeds.
};

struct SweepDesign {
  std::variant<GridDesign, ListDesign, LatinHypercubeDesign> points;
  std::optional<Halving> adaptive;
  Location location;
};

}  // namespace tagfield
