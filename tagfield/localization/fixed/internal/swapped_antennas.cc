// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/internal/swapped_antennas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// The same tags with two antennas' poses exchanged.
std::vector<TagOnGrid> with_exchanged(const FixedScene& scene, std::vector<TagOnGrid> grids,
                                      const FixedReads& one, const FixedReads& other,
                                      const FixedOptions& options) {
  for (TagOnGrid& grid : grids) {
    for (std::size_t i = 0; i < grid.antennas.size(); ++i) {
      const std::string& antenna = scene.antennas[grid.antennas[i]];
      const bool is_one = antenna == one.antenna;
      if (!is_one && antenna != other.antenna) continue;
      grid.p_WA[i] = is_one ? other.p_WA : one.p_WA;
      grid.boresight_W[i] = is_one ? other.boresight_W : one.boresight_W;
    }
    put_on(grid.places, options, grid);
  }
  return grids;
}

/// At most `most` of them, spread over the list: neighbours in it are often neighbours in space.
std::vector<std::size_t> spread_over(const std::vector<std::size_t>& numbers, std::size_t most) {
  if (numbers.size() <= most) return numbers;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(numbers[i * numbers.size() / most]);
  return some;
}

}  // namespace

std::string swapped_antennas(const FixedScene& scene, const std::vector<std::size_t>& numbers,
                             const FixedOptions& options, int threads) {
  constexpr std::size_t kEnough = 32;
  const std::vector<std::size_t> some = spread_over(numbers, kEnough);
  std::map<std::string, FixedReads> antennas;
  std::vector<TagOnGrid> grids;
  for (const std::size_t number : some) {
    grids.push_back(scene.tags[number].grid);
    for (const FixedReads& of : scene.tags[number].reads) antennas.emplace(of.antenna, of);
  }
  std::vector<std::pair<const FixedReads*, const FixedReads*>> pairs;
  for (auto one = antennas.begin(); one != antennas.end(); ++one) {
    for (auto other = std::next(one); other != antennas.end(); ++other) {
      pairs.emplace_back(&one->second, &other->second);
    }
  }
  std::vector<double> evidences(pairs.size());
  parallel_for(pairs.size(), threads, [&](std::size_t i) {
    const auto exchanged = with_exchanged(scene, grids, *pairs[i].first, *pairs[i].second, options);
    evidences[i] = learn_law(exchanged, scene.antennas.size(), options).evidence;
  });
  const double as_given = some.size() == numbers.size()
                              ? scene.law.evidence
                              : learn_law(grids, scene.antennas.size(), options).evidence;
  const auto best = std::max_element(evidences.begin(), evidences.end());
  if (best == evidences.end()) return "";
  const double by_chance = kMinLogEvidence + std::log(static_cast<double>(pairs.size()));
  // Reflections and unknown lobes also make another order likelier in real rooms, but seldom by as
  // much as the given order explains (docs/methods.md).
  if (*best - as_given < std::max(by_chance, as_given)) return "";
  const auto& [one, other] = pairs[static_cast<std::size_t>(best - evidences.begin())];
  return fmt::format("'{}' and '{}'", one->antenna, other->antenna);
}

}  // namespace tagfield
