// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/coherent_reads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// Travel between two reads [m].
double path_between(const TagPhases& phases, Eigen::Index from, Eigen::Index to) {
  return std::hypot(phases.x[to] - phases.x[from], phases.y[to] - phases.y[from],
                    phases.z[to] - phases.z[from]);
}

void cut(const TagPhases& phases, const TagPhases::Span& span, double length,
         std::vector<Aperture>& pieces) {
  Aperture piece{span.begin, 1, false};
  double gone = 0.0;
  for (Eigen::Index i = span.begin + 1; i < span.begin + span.count; ++i) {
    gone += path_between(phases, i - 1, i);
    if (gone <= length) {
      ++piece.count;
      continue;
    }
    pieces.push_back(piece);
    piece = {i, 1, false};
    gone = 0.0;
  }
  pieces.push_back(piece);
}

}  // namespace

TagPhases coherent_reads(const LocalizationProblem& problem, const SamplesOfTag& samples) {
  std::vector<std::string> use;
  for (const auto& [antenna, series] : samples) {
    const bool known = problem.offset_known.count(antenna) > 0;
    if (known || extent_of(series) >= kStillExtent) use.push_back(antenna);
  }
  return wrapped_phases(problem, samples, use);
}

std::string too_few(const TagPhases& phases) {
  const auto count = static_cast<std::size_t>(phases.size());
  const auto offsets = static_cast<std::size_t>(
      std::count_if(phases.spans.begin(), phases.spans.end(),
                    [](const TagPhases::Span& span) { return !span.offset_known; }));
  if (count >= offsets + 2 + kFewestSpare) return "";
  return fmt::format("too few reads: {} on {} channels of the antennas that moved", count,
                     phases.spans.size());
}

std::vector<Aperture> apertures(const TagPhases& phases, double length) {
  std::vector<Aperture> pieces;
  for (const TagPhases::Span& span : phases.spans) {
    if (length < kWholeAperture) {
      cut(phases, span, length, pieces);
    } else {
      pieces.push_back({span.begin, span.count, span.offset_known});
    }
  }
  return pieces;
}

}  // namespace tagfield
