// SPDX-License-Identifier: Apache-2.0
/// @file
/// Small random selection problems.
#pragma once

#include <cmath>
#include <cstdint>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/layout/selection.h"

namespace tagfield {

/// `options` on two thirds as many sites, in two zones, over `elements`. Every third problem limits
/// only the number of antennas; the others also limit readers, cost and cross reads, and have a
/// cap.
inline SelectionProblem random_problem(std::uint64_t number, std::size_t options,
                                       std::size_t elements) {
  RandomStream stream(number, Purpose::kPlaces);
  SelectionProblem problem;
  const bool has_limits = number % 3 != 0;
  problem.zones = has_limits ? 2 : 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < elements; ++i) {
    problem.elements.push_back({0.1 + uniform(stream), has_limits ? i % 2 : kNoZone});
    sum += problem.elements.back().weight;
  }
  for (SelectionElement& element : problem.elements) element.weight /= sum;
  const std::size_t sites = has_limits ? 2 * options / 3 : options;
  for (std::size_t i = 0; i < options; ++i) {
    SelectionOption option;
    option.site = i % sites;
    option.zone = has_limits ? option.site % 2 : kNoZone;
    option.cost = 1.0 + 3.0 * uniform(stream);
    for (std::size_t element = 0; element < elements; ++element) {
      const bool is_own = !has_limits || problem.elements[element].zone == option.zone;
      if (uniform(stream) > (is_own ? 0.45 : 0.1)) continue;
      // Some elements are never missed.
      const double miss = uniform(stream) < 0.1 ? 0.0 : uniform(stream);
      option.misses.push_back({static_cast<std::uint32_t>(element), static_cast<float>(miss)});
      // With better links than those counted on for reads.
      if (!is_own) {
        option.crossings.push_back(option.misses.back());
        option.crossings.back().probability *= 0.9F;
      }
    }
    problem.options.push_back(std::move(option));
  }
  problem.limits.antennas = 3 + number % 3;
  if (!has_limits) return problem;
  problem.limits.readers = 3;
  problem.limits.ports = 2;
  problem.limits.reader_cost = 2.0;
  problem.limits.cost = 14.0;
  problem.limits.cross = 0.25;
  problem.cap = number % 2 == 0 ? 1.0 : 0.8;
  return problem;
}

/// The same for Worth::kReads and Worth::kPlace: each option that may read an element does so a few
/// times, or gives information about its position in some direction.
inline SelectionProblem random_problem(std::uint64_t number, std::size_t options,
                                       std::size_t elements, Worth worth) {
  SelectionProblem problem = random_problem(number, options, elements);
  problem.worth = worth;
  if (worth == Worth::kProbability) return problem;
  RandomStream stream(number, Purpose::kPlaces, 1);
  for (SelectionOption& option : problem.options) {
    for (const Miss& miss : option.misses) {
      option.reads.push_back({miss.element, static_cast<float>(4.0 * uniform(stream))});
      const double turn = kTwoPi * uniform(stream);
      const double information = 50.0 * uniform(stream);
      option.information.push_back(
          {miss.element, static_cast<float>(information * std::pow(std::cos(turn), 2)),
           static_cast<float>(information * std::cos(turn) * std::sin(turn)),
           static_cast<float>(information * std::pow(std::sin(turn), 2))});
    }
  }
  problem.cap = worth == Worth::kReads ? 5.0 : 1.0;
  problem.error_m = 0.4;
  problem.spread_m = 2.0;
  return problem;
}

}  // namespace tagfield
