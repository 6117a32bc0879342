/// @file
/// The door of this room: reads and antenna poses in, an estimate for each tag out. Knows nothing
/// of where the tags really are.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/hyperbola.h"
#include "tagfield/localization/tag_estimate.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/reader/tag_read.h"

namespace tagfield {

/// What is known of the tags' heights [m, world]. Where nothing is, a tag is taken to be as high
/// as the antennas are in the mean.
struct TagHeights {
  std::optional<double> of_all;
  std::map<std::string, double> of_tag;  ///< Goes before `of_all`.
};

struct LocalizationOptions {
  HyperbolaOptions hyperbola;
  TagHeights heights;
  double max_pose_gap_s = 0.5;  ///< Reads between poses further apart than this are left out.
  /// Whether phases are known but for half a turn; where not told, the reads tell it.
  std::optional<bool> half_turns;
  int threads = 1;
};

/// Locates every tag in `reads`, in rising order of their IDs, by the paper's method (hyperbola.h).
/// Reads may come in any order; poses give the antennas' believed places and are interpolated at
/// each read's stamp. Reads without a pose are left out with a warning. Deterministic, whatever
/// the number of threads.
std::vector<TagEstimate> locate_tags(const std::vector<TagRead>& reads,
                                     const std::vector<AntennaPose>& poses,
                                     const LocalizationOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
