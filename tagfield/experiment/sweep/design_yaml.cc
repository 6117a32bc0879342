// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/design_yaml.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/spelling.h"
#include "tagfield/experiment/internal/overrides_yaml.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxSteps = 1'000'000;
constexpr const char* kTargetWords[] = {"mean_m",  "median_m", "p95_m",       "max_m",
                                        "located", "wrong",    "false_claims"};

std::size_t size_in(const YamlValue& value, std::size_t least, std::size_t most) {
  const std::uint64_t number = value.whole_number();
  if (number < least || number > most) {
    value.fail(fmt::format("must be from {} to {}, is {}", least, most, number));
  }
  return number;
}

NumberSpan span_of(YamlMap map, bool of_grid) {
  NumberSpan span;
  span.from = map.at("from").number();
  span.to = map.at("to").number();
  if (!(span.from < span.to)) map.at("to").fail("must be greater than 'from'");
  if (map.has("scale")) span.logarithmic = choice(map.at("scale"), {"linear", "log"}) == 1;
  if (span.logarithmic && !(span.from > 0.0)) {
    map.at("from").fail("must be greater than 0 on a logarithmic scale");
  }
  span.integer = map.boolean("integer", false);
  if (of_grid) span.steps = size_in(map.at("steps"), 2, kMaxSteps);
  map.finish();
  return span;
}

std::vector<std::string> values_in(const YamlValue& value) {
  std::vector<std::string> values;
  for (const YamlValue& one : value.list()) {
    if (one.node().IsNull()) one.fail("is nothing, expected a value");
    values.push_back(yaml_line_of(one.node()));
    if (std::count(values.begin(), values.end(), values.back()) > 1) {
      one.fail(fmt::format("is {} again, expected different values", values.back()));
    }
  }
  if (values.empty()) value.fail("must have at least one value");
  return values;
}

/// The keys of a mapping, each with a list of values or a span of numbers.
std::vector<SweptKey> swept_keys_in(const YamlValue& value, bool of_grid) {
  const YamlMap checked(value);
  std::vector<SweptKey> keys;
  for (const auto& entry : checked.self().node()) {
    const std::string name = YamlValue(entry.first, value.file(), value.path()).text();
    const YamlValue given(entry.second, value.file(), value.path() + "." + name);
    SweptKey key{name, {}, given.location()};
    if (given.node().IsMap()) {
      key.values = span_of(YamlMap(given), of_grid);
    } else if (given.node().IsSequence()) {
      key.values = values_in(given);
    } else {
      given.fail(of_grid ? "must be a list of values, or a mapping {from, to, steps}"
                         : "must be a list of values, or a mapping {from, to}");
    }
    keys.push_back(std::move(key));
  }
  if (keys.empty()) value.fail("must have at least one key of the scenario");
  return keys;
}

ListDesign listed_points(const YamlValue& value) {
  ListDesign design;
  for (const YamlValue& point : value.list()) design.points.push_back(overrides_in(point, ""));
  if (design.points.empty()) value.fail("must have at least one point");
  return design;
}

LatinHypercubeDesign latin_hypercube_of(YamlMap map) {
  LatinHypercubeDesign design;
  design.points = size_in(map.at("points"), 1, kMaxSteps);
  if (map.has("seed")) design.seed = map.at("seed").whole_number();
  design.keys = swept_keys_in(map.at("keys"), false);
  map.finish();
  return design;
}

Halving halving_of(YamlMap map, const std::vector<std::string>& methods, std::uint64_t seeds) {
  Halving halving;
  const std::vector<std::string> words(std::begin(kTargetWords), std::end(kTargetWords));
  halving.target = static_cast<SweepTarget>(choice(map.at("target"), words));
  if (map.has("method")) {
    halving.method = map.at("method").text();
    if (std::find(methods.begin(), methods.end(), halving.method) == methods.end()) {
      map.at("method").fail(fmt::format("is '{}', which is not a method of this suite{}",
                                        halving.method, suggestion(halving.method, methods)));
    }
  } else if (methods.size() == 1) {
    halving.method = methods.front();
  } else {
    map.self().fail("has no 'method': which of the suite's is the one that counts?");
  }
  halving.first_seeds = size_in(map.at("first_seeds"), 1, seeds);
  if (map.has("keep_one_in")) halving.keep_one_in = size_in(map.at("keep_one_in"), 2, 1000);
  if (halving.first_seeds == seeds) {
    map.at("first_seeds").fail("is the suite's number of seeds, so nothing is left to halve");
  }
  map.finish();
  return halving;
}

}  // namespace

SweepDesign sweep_design_of(const YamlValue& value, const std::vector<std::string>& methods,
                            std::uint64_t seeds) {
  YamlMap map(value);
  SweepDesign design;
  design.location = value.location();
  int designs = 0;
  if (map.has("grid")) {
    ++designs;
    design.points = GridDesign{swept_keys_in(map.at("grid"), true)};
  }
  if (map.has("list")) {
    ++designs;
    design.points = listed_points(map.at("list"));
  }
  if (map.has("latin_hypercube")) {
    ++designs;
    design.points = latin_hypercube_of(YamlMap(map.at("latin_hypercube")));
  }
  if (map.has("adaptive")) {
    design.adaptive = halving_of(YamlMap(map.at("adaptive")), methods, seeds);
  }
  map.finish();
  if (designs != 1) value.fail("must have one of 'grid', 'list' and 'latin_hypercube'");
  return design;
}

std::string to_string(SweepTarget target) { return kTargetWords[static_cast<int>(target)]; }

}  // namespace tagfield
