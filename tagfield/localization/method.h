// SPDX-License-Identifier: Apache-2.0
/// @file
/// Common interface of all localization methods. Every method takes the same problem and returns
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

/// Result of a method.
struct LocalizationResult {
  /// One for each tag in the problem's samples, in ascending order of IDs.
  std::vector<TagEstimate> estimates;
  std::string method;  ///< Name of the method that made them; for "auto" the one that it chose.
  std::string why;     ///< Why it was chosen, in one line; empty if it was requested.
  /// Antenna poses corrected by methods that estimate their error.
  std::vector<AntennaPose> corrected_poses;
  /// Samples of tags whose phases a method's model explains by more than the distance, such as the
  /// paths of a known world, with that part removed. Positions are checked against these.
  SamplesByTag explained{};
  /// If all tags were refused for a common reason: for each tag, the rms phase residual at its best
  /// position [m].
  std::vector<double> misfits_m{};
};

/// `threads`: how many a method may use; its result must not depend on it.
using LocateFunction = std::function<LocalizationResult(const LocalizationProblem& problem,
                                                        int threads, Diagnostics& diagnostics)>;

/// Settings of methods by key, as written in a file or on the command line.
using MethodSettings = std::vector<RawParameter>;

struct Method {
  std::string name;     ///< As on the command line: "hyperbola".
  std::string summary;  ///< One line for users.
  LocateFunction locate;
  std::vector<SettingHelp> settings{};  ///< Those that it accepts.
  /// Returns the locate function for these settings, all of which it must accept; null if it
  /// accepts none. Throws Error on values out of range.
  std::function<LocateFunction(const MethodSettings&)> with{};
  /// Known or requested inputs that other methods use and this one ignores, by the keys of a
  /// scenario's `localization`: "offset", "pi_ambiguity", "pose_error" and those of EstimateLimits.
  std::vector<std::string> ignores{};
};

/// The same method, marked as ignoring `keys`.
Method ignoring(std::vector<std::string> keys, Method method);

/// Whether all of the methods ignore `key`.
bool all_ignore(const std::vector<Method>& methods, const std::string& key);

/// The method with those of `settings` that it accepts.
Method configured(Method method, const MethodSettings& settings);

/// Throws Error "FILE:LINE: …" on a setting that none of the methods `used` accepts; the message
/// names those of `all` that do.
void refuse_unused(const MethodSettings& settings, const std::vector<Method>& used,
                   const std::vector<Method>& all);

/// The method of that name. Throws Error on an unknown name, suggesting the nearest known one.
Method find_method(const std::vector<Method>& methods, const std::string& name);

/// Estimate of a reference tag: its given position.
TagEstimate reference_estimate(const std::string& tag, const Eigen::Vector3d& p_WT);

/// Reports progress to the problem's on_locating, if set.
void tell(const LocalizationProblem& problem, const std::string& what, double share);

/// Runs `locate` in parallel on each tag that is not a reference tag; reference tags get their
/// known position. For methods that locate one tag at a time.
std::vector<TagEstimate> locate_each(
    const LocalizationProblem& problem, int threads,
    const std::function<TagEstimate(const std::string& tag, const SamplesOfTag& samples)>& locate);

/// Locates one tag.
using LocateTag = std::function<TagEstimate(const LocalizationProblem& problem,
                                            const std::string& tag, const SamplesOfTag& samples)>;

/// A method without settings that locates one tag at a time.
Method one_by_one(const std::string& name, const std::string& summary, const LocateTag& locate);

/// Locate function of a method that only returns estimates.
using LocateAll = std::function<std::vector<TagEstimate>(const LocalizationProblem&, int threads)>;
LocateFunction named(const std::string& method, const LocateAll& locate);

/// Options of a method with settings: `table` has the keys of all that a user may set; `check`, if
/// any, throws Error on inconsistent options.
template <class Options>
struct OptionTable {
  std::vector<Setting<Options>> table;
  std::function<void(const Options&)> check{};
};

/// Throws Error on options that are out of range or inconsistent.
template <class Options>
void check_options(const OptionTable<Options>& of, const Options& options) {
  check_settings(of.table, options);
  if (of.check) of.check(options);
}

/// `options` overridden by the settings. Throws Error on values out of range.
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

/// Locate function of a method with options.
template <class Options>
using LocateWith = std::function<LocalizationResult(const LocalizationProblem&, int threads,
                                                    Diagnostics&, const Options&)>;

/// A method with options. Throws Error on `options` out of range.
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

/// Overload for a method that only returns estimates.
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

/// A method with options that locates one tag at a time.
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
