#include "tagfield/localization/locate.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/half_turns.h"
#include "tagfield/localization/phase_sample.h"

namespace tagfield {
namespace {

void check_height(double height, const std::string& of) {
  if (!std::isfinite(height)) throw Error(fmt::format("the height of {} must be finite", of));
}

void check(const TagHeights& heights) {
  if (heights.of_all) check_height(*heights.of_all, "all tags");
  for (const auto& [tag, height] : heights.of_tag) check_height(height, "tag '" + tag + "'");
}

/// Mean height of the antennas that moved while they read a tag, as only those locate it; of all
/// where none did; 0 without samples.
double mean_antenna_height(const SamplesOfTag& samples) {
  double sum[2] = {0.0, 0.0};
  double count[2] = {0.0, 0.0};
  for (const auto& [antenna, series] : samples) {
    const int moved = extent_of(series) >= kStillExtent ? 1 : 0;
    for (const PhaseSample& sample : series) sum[moved] += sample.p_WA.z();
    count[moved] += static_cast<double>(series.size());
  }
  for (const int moved : {1, 0}) {
    if (count[moved] > 0.0) return sum[moved] / count[moved];
  }
  return 0.0;
}

double height_of(const std::string& tag, const SamplesOfTag& samples, const TagHeights& heights) {
  const auto known = heights.of_tag.find(tag);
  if (known != heights.of_tag.end()) return known->second;
  return heights.of_all ? *heights.of_all : mean_antenna_height(samples);
}

}  // namespace

std::vector<TagEstimate> locate_tags(const std::vector<TagRead>& reads,
                                     const std::vector<AntennaPose>& poses,
                                     const LocalizationOptions& options, Diagnostics& diagnostics) {
  check(options.heights);
  SamplesByTag joined = join_reads_with_poses(reads, poses, options.max_pose_gap_s, diagnostics);
  if (options.half_turns.value_or(has_half_turns(joined))) {
    if (!options.half_turns) {
      diagnostics.warn("phases jump by half turns: they are taken as known but for π");
    }
    double_phases(joined);
  }
  std::vector<const SamplesByTag::value_type*> tags;
  tags.reserve(joined.size());
  for (const auto& entry : joined) tags.push_back(&entry);
  std::vector<TagEstimate> estimates(tags.size());
  parallel_for(tags.size(), options.threads, [&](std::size_t i) {
    const auto& [tag, samples] = *tags[i];
    const double height = height_of(tag, samples, options.heights);
    estimates[i] = locate_by_hyperbolae(tag, samples, height, options.hyperbola);
  });
  return estimates;
}

}  // namespace tagfield
