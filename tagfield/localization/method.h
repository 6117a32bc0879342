// SPDX-License-Identifier: Apache-2.0
/// @file
/// A localization method, as all who run one see it. Every method takes the same problem and gives
/// the same kind of result, so that they can be compared and exchanged.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/setting.h"
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
  /// Of tags whose phases a method's model explains beyond the distance, as by the paths of a known
  /// world: their samples without that. Places are held against these.
  SamplesByTag explained{};
  /// Where all tags were refused for what they have in common: the rms that each one's best place
  /// left of its phases [m].
  std::vector<double> misfits_m{};
};

/// `threads`: on how many a method may work; its result must not depend on it.
using LocateFunction = std::function<LocalizationResult(const LocalizationProblem& problem,
                                                        int threads, Diagnostics& diagnostics)>;

/// Settings of methods by key, as they stood in a file or on the command line.
using MethodSettings = std::vector<RawParameter>;

struct Method {
  std::string name;     ///< As on the command line: "hyperbola".
  std::string summary;  ///< One line for people.
  LocateFunction locate;
  std::vector<SettingHelp> settings{};  ///< That it takes.
  /// How it locates with settings, all of which it takes; null where it takes none. Throws Error on
  /// values out of their range.
  std::function<LocateFunction(const MethodSettings&)> with{};
  /// What others make use of that may be known or asked for, and this one does not, by the keys of
  /// a scenario's `localization`: "offset", "half_turns", "pose_error" and those of EstimateLimits.
  std::vector<std::string> ignores{};
};

/// The same, which makes no use of `keys`.
Method ignoring(std::vector<std::string> keys, Method method);

/// Whether none of the methods makes use of `key`.
bool all_ignore(const std::vector<Method>& methods, const std::string& key);

/// The method with those of `settings` that it takes.
Method configured(Method method, const MethodSettings& settings);

/// Throws Error "FILE:LINE: …" on a setting that none of the methods `used` takes, which says which
/// of `all` do.
void refuse_unused(const MethodSettings& settings, const std::vector<Method>& used,
                   const std::vector<Method>& all);

/// The method of that name. Throws Error on an unknown one, with the nearest known.
Method find_method(const std::vector<Method>& methods, const std::string& name);

/// Estimate of a reference tag: the place that was given.
TagEstimate reference_estimate(const std::string& tag, const Eigen::Vector3d& p_WT);

/// Tells the problem's on_locating, if it has one.
void tell(const LocalizationProblem& problem, const std::string& what, double share);

/// Runs `locate` on each tag that is not a reference tag, in parallel; reference tags get their
/// known place. For methods that take one tag at a time.
std::vector<TagEstimate> locate_each(
    const LocalizationProblem& problem, int threads,
    const std::function<TagEstimate(const std::string& tag, const SamplesOfTag& samples)>& locate);

/// Locates one tag.
using LocateTag = std::function<TagEstimate(const LocalizationProblem& problem,
                                            const std::string& tag, const SamplesOfTag& samples)>;

/// A method without settings that takes one tag at a time.
Method one_by_one(const std::string& name, const std::string& summary, const LocateTag& locate);

/// The door of a method that only makes estimates.
using LocateAll = std::function<std::vector<TagEstimate>(const LocalizationProblem&, int threads)>;
LocateFunction named(const std::string& method, const LocateAll& locate);

/// What a method has that takes settings: `table` has the keys of all that a user may want to set,
/// `check`, if any, throws Error on options that don't go together.
template <class Options>
struct OptionTable {
  std::vector<Setting<Options>> table;
  std::function<void(const Options&)> check{};
};

/// Throws Error on options that are out of their range or don't go together.
template <class Options>
void check_options(const OptionTable<Options>& of, const Options& options) {
  check_settings(of.table, options);
  if (of.check) of.check(options);
}

/// `options` with what the settings say instead. Throws Error on values out of their range.
template <class Options>
Options changed_options(const OptionTable<Options>& of, Options options,
                        const MethodSettings& settings) {
  apply_settings(of.table, settings, options);
  try {
    check_options(of, options);
  } catch (const Error& error) {
    fail(place_of(error.what(), settings, {}), error.what());
  }
  return options;
}

/// How a method with options locates.
template <class Options>
using LocateWith = std::function<LocalizationResult(const LocalizationProblem&, int threads,
                                                    Diagnostics&, const Options&)>;

/// A method with options. Throws Error on `options` out of their range.
template <class Options>
Method method_with(const std::string& name, const std::string& summary,
                   const OptionTable<Options>& table, const Options& options,
                   const std::type_identity_t<LocateWith<Options>>& locate) {
  check_options(table, options);
  const auto bound = [locate](const Options& of) -> LocateFunction {
    return [locate, of](const LocalizationProblem& problem, int threads, Diagnostics& diagnostics) {
      return locate(problem, threads, diagnostics, of);
    };
  };
  return {name, summary, bound(options), helps_of(table.table, options),
          [=](const MethodSettings& settings) {
            return bound(changed_options(table, options, settings));
          }};
}

/// Likewise one that only makes estimates.
template <class Options>
Method method_with(const std::string& name, const std::string& summary,
                   const OptionTable<Options>& table, const Options& options,
                   const std::type_identity_t<std::function<std::vector<TagEstimate>(
                       const LocalizationProblem&, int threads, const Options&)>>& locate) {
  const auto result = [name, locate](const LocalizationProblem& problem, int threads,
                                     Diagnostics& diagnostics, const Options& of) {
    return named(name, [&](const LocalizationProblem& asked, int on) {
      return locate(asked, on, of);
    })(problem, threads, diagnostics);
  };
  return method_with(name, summary, table, options, LocateWith<Options>(result));
}

/// Likewise one that takes one tag at a time.
template <class Options>
Method one_by_one(const std::string& name, const std::string& summary,
                  const OptionTable<Options>& table, const Options& options,
                  const std::type_identity_t<
                      std::function<TagEstimate(const LocalizationProblem&, const std::string& tag,
                                                const SamplesOfTag&, const Options&)>>& locate) {
  return method_with(name, summary, table, options,
                     [locate](const LocalizationProblem& problem, int threads, const Options& of) {
                       return locate_each(problem, threads,
                                          [&](const std::string& tag, const SamplesOfTag& samples) {
                                            return locate(problem, tag, samples, of);
                                          });
                     });
}

}  // namespace tagfield
