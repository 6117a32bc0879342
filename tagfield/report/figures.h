// SPDX-License-Identifier: Apache-2.0
/// @file
/// The figures of the report, each in a source file of its own. All are 560 units wide.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/run_files.h"
#include "tagfield/report/svg.h"

namespace tagfield {

/// A drawing with its texts, or the reason why there is none.
struct Figure {
  std::string name;     ///< Of the file, without ".svg"; also its anchor on the page.
  std::string number;   ///< Of the paper's figure: "Fig. 9"; "" if it is none of the paper's.
  std::string title;    ///< A few words.
  std::string caption;  ///< What it shows, plain text.
  Svg svg;
  std::string missing;  ///< Why it can't be drawn; "" if it is.
  std::string data{};   ///< The data as CSV with a header; "" if not available.
};

inline constexpr std::size_t kMaxRows = 40;     ///< Tags shown individually, with their names.
inline constexpr std::size_t kMaxMarks = 1500;  ///< Points in one figure.

/// Fig. 9: path, true tags and estimates over the world from above.
Figure map_figure(const RunFiles& run);

/// Fig. 6: the map that the robot navigated with, and its path while mapping.
Figure robot_map_figure(const RunFiles& run);

/// The error of the moving antennas' believed poses over time: horizontally and in heading.
Figure pose_error_figure(const RunFiles& run);

/// Fig. 10: the error of each tag: bars for one seed, boxes for several, a histogram for many tags.
Figure error_figure(const RunFiles& run);

/// The cumulative distribution of the errors of all tags and seeds.
Figure distribution_figure(const RunFiles& run);

/// Fig. 11: height of the moving antenna over time.
Figure height_figure(const RunFiles& run);

/// Fig. 12: unwrapped phase distance of the tag with the most reads, and the true change.
Figure phase_figure(const RunFiles& run);

/// Whether that tag's phases are of several carriers, so that eq. (9) can't unwrap them.
bool hops(const RunFiles& run);

/// Replaces Fig. 12 if the reader hops: how well the phases agree with each position around the
/// tag, or, if that can't be drawn, the phases by carrier.
Figure hopping_figure(const RunFiles& run);

/// Fig. 13: RSSI of that tag along the path of the moving antenna.
Figure path_rssi_figure(const RunFiles& run);

/// Fig. 14: mean RSSI of all tags at the fixed antenna, from above.
Figure fixed_rssi_figure(const RunFiles& run);

/// With Fig. 14: every RSSI of each tag at the fixed antenna.
Figure fixed_strip_figure(const RunFiles& run);

/// All figures in the order of the page. Those that make no sense for this run (such as a height
/// that never changes) are left out; those that a reader might expect state what is missing.
std::vector<Figure> all_figures(const RunFiles& run);

/// The step at which to take every `step`-th of `count` items to get at most `most` ≥ 1.
inline std::size_t thinning(std::size_t count, std::size_t most) {
  return count == 0 ? 1 : (count + most - 1) / most;
}

}  // namespace tagfield
