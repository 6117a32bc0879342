#include "tagfield/localization/coherent_reads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tagfield/base/units.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// Reads beyond one for each unknown; fewer fit many places by chance.
constexpr std::size_t kFewestSpare = 16;
/// Antennas whose heights differ by less than this are at one level [m].
constexpr double kLevelExtent = 0.02;

/// Samples of one antenna by carrier [Hz].
using ByCarrier = std::map<double, std::vector<const PhaseSample*>>;

ByCarrier by_carrier(const std::vector<PhaseSample>& series) {
  ByCarrier groups;
  for (const PhaseSample& sample : series) groups[sample.frequency_hz].push_back(&sample);
  return groups;
}

void append(double frequency_hz, const std::vector<const PhaseSample*>& samples, bool offset_known,
            CoherentReads& reads) {
  const Eigen::Index begin = reads.phase.size();
  const auto count = static_cast<Eigen::Index>(samples.size());
  for (Eigen::ArrayXd* column : {&reads.x, &reads.y, &reads.z, &reads.phase}) {
    column->conservativeResize(begin + count);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const PhaseSample& sample = *samples[static_cast<std::size_t>(i)];
    reads.x[begin + i] = sample.p_WA.x();
    reads.y[begin + i] = sample.p_WA.y();
    reads.z[begin + i] = sample.p_WA.z();
    reads.phase[begin + i] = sample.phase_rad;
  }
  reads.groups.push_back({begin, count, 4.0 * kPi / wavelength(frequency_hz), offset_known});
}

/// Travel between two reads [m].
double travel(const CoherentReads& reads, Eigen::Index from, Eigen::Index to) {
  return std::hypot(reads.x[to] - reads.x[from], reads.y[to] - reads.y[from],
                    reads.z[to] - reads.z[from]);
}

void cut(const CoherentReads& reads, const CoherentGroup& group, double length,
         std::vector<CoherentGroup>& pieces) {
  CoherentGroup piece{group.begin, 1, group.wavenumber, false};
  double gone = 0.0;
  for (Eigen::Index i = group.begin + 1; i < group.begin + group.count; ++i) {
    gone += travel(reads, i - 1, i);
    if (gone <= length) {
      ++piece.count;
      continue;
    }
    pieces.push_back(piece);
    piece = {i, 1, group.wavenumber, false};
    gone = 0.0;
  }
  pieces.push_back(piece);
}

}  // namespace

CoherentReads make_coherent_reads(const SamplesOfTag& samples,
                                  const std::set<std::string>& offset_known) {
  CoherentReads reads;
  for (const auto& [antenna, series] : samples) {
    const bool known = offset_known.count(antenna) > 0;
    if (!known && extent_of(series) < kStillExtent) continue;
    for (const auto& [frequency_hz, group] : by_carrier(series)) {
      if (known || group.size() >= 2) append(frequency_hz, group, known, reads);
    }
  }
  return reads;
}

std::string too_few(const CoherentReads& reads) {
  const auto count = static_cast<std::size_t>(reads.phase.size());
  const std::size_t offsets = static_cast<std::size_t>(
      std::count_if(reads.groups.begin(), reads.groups.end(),
                    [](const CoherentGroup& group) { return !group.offset_known; }));
  if (count >= offsets + 2 + kFewestSpare) return "";
  return fmt::format("too few reads: {} on {} channels of the antennas that moved", count,
                     reads.groups.size());
}

std::vector<CoherentGroup> apertures(const CoherentReads& reads, double length) {
  if (!(length < kWholeAperture)) return reads.groups;
  std::vector<CoherentGroup> pieces;
  for (const CoherentGroup& group : reads.groups) cut(reads, group, length, pieces);
  return pieces;
}

FitData layout_of(const CoherentReads& reads) {
  FitData data;
  data.x = reads.x;
  data.y = reads.y;
  data.height_squared = Eigen::ArrayXd::Zero(reads.x.size());
  data.distance = Eigen::ArrayXd::Zero(reads.x.size());
  for (const CoherentGroup& group : reads.groups) {
    data.spans.push_back({group.begin, group.count, kTwoPi / group.wavenumber});
  }
  return data;
}

double longest_wavelength(const CoherentReads& reads) {
  double longest = 0.0;
  for (const CoherentGroup& group : reads.groups) {
    longest = std::max(longest, 4.0 * kPi / group.wavenumber);
  }
  return longest;
}

HeightModel height_model(const LocalizationProblem& problem, const std::string& tag,
                         const CoherentReads& reads) {
  HeightModel model;
  const auto side = side_to_estimate(problem, tag);
  if (!side || reads.z.size() == 0) {
    model.level = plane_height(problem, tag);
    return model;
  }
  const bool level = reads.z.maxCoeff() - reads.z.minCoeff() < kLevelExtent;
  model.kind = level ? HeightModel::Kind::kSquare : HeightModel::Kind::kFree;
  model.level = reads.z.mean();
  model.side = *side;
  return model;
}

FitPlace fit_place(const HeightModel& model, const Eigen::Vector2d& p, double height) {
  const double above = height - model.level;
  return {p.x(), p.y(), model.kind == HeightModel::Kind::kSquare ? above * above : height};
}

Eigen::Vector3d world_place(const HeightModel& model, const FitPlace& place) {
  if (model.kind != HeightModel::Kind::kSquare) return place;
  const double away = std::sqrt(std::max(place.z(), 0.0));
  const double sign = model.side == HeightSide::kAbove ? 1.0 : -1.0;
  return {place.x(), place.y(), model.level + sign * away};
}

}  // namespace tagfield
