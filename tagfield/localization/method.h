/// @file
/// A localization method, as all who run one see it. Every method takes the same problem and gives
/// the same kind of result, so that they can be compared and exchanged.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_estimate.h"
#include "tagfield/poses/trajectory.h"

namespace tagfield {

/// What a method gives.
struct LocalizationResult {
  /// One for each tag in the problem's samples, in rising order of their IDs.
  std::vector<TagEstimate> estimates;
  std::string method;  ///< Name of the method that made them; of "auto" the one that it chose.
  std::string why;     ///< Why it was chosen, in one line; empty where it was asked for.
  /// Antenna poses with their error taken out, of methods that estimate it.
  std::vector<AntennaPose> corrected_poses;
};

/// `threads`: on how many a method may work; its result must not depend on it.
using LocateFunction = std::function<LocalizationResult(const LocalizationProblem& problem,
                                                        int threads, Diagnostics& diagnostics)>;

struct Method {
  std::string name;     ///< As on the command line: "hyperbola".
  std::string summary;  ///< One line for people.
  LocateFunction locate;
};

/// Estimate of a reference tag: the place that was given.
TagEstimate reference_estimate(const std::string& tag, const Eigen::Vector3d& p_WT);

/// Runs `locate` on each tag that is not a reference tag, in parallel; reference tags get their
/// known place. For methods that take one tag at a time.
std::vector<TagEstimate> locate_each(
    const LocalizationProblem& problem, int threads,
    const std::function<TagEstimate(const std::string& tag, const SamplesOfTag& samples)>& locate);

}  // namespace tagfield
