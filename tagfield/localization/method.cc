// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <set>

#include "tagfield/base/parallel.h"
#include "tagfield/base/spelling.h"

namespace tagfield {
namespace {

std::vector<std::string> names_of(const std::vector<Method>& methods) {
  std::vector<std::string> names;
  names.reserve(methods.size());
  for (const Method& method : methods) names.push_back(method.name);
  return names;
}

bool takes(const Method& method, const std::string& key) { return has_key(method.settings, key); }

/// The keys of all settings, each once.
std::vector<std::string> keys_of(const std::vector<Method>& methods) {
  std::set<std::string> keys;
  for (const Method& method : methods) {
    for (const SettingHelp& help : method.settings) keys.insert(help.key);
  }
  return {keys.begin(), keys.end()};
}

/// " (did you mean 'stride_m'?)", or else the settings of the methods in use.
std::string instead_of(const std::string& key, const std::vector<Method>& used,
                       const std::vector<Method>& all) {
  const std::string nearest = nearest_word(key, keys_of(all));
  if (!nearest.empty()) return fmt::format(" (did you mean '{}'?)", nearest);
  const std::vector<std::string> known = keys_of(used);
  return known.empty() ? "" : fmt::format(" (known: {})", fmt::join(known, ", "));
}

/// Which methods accept the setting, or that none does.
std::string who_takes(const std::string& key, const std::vector<Method>& used,
                      const std::vector<Method>& all) {
  std::vector<Method> those;
  for (const Method& method : all) {
    if (takes(method, key)) those.push_back(method);
  }
  if (those.empty()) return "is a setting of no method" + instead_of(key, used, all);
  return fmt::format("is a setting of {}", fmt::join(names_of(those), ", "));
}

}  // namespace

Method configured(Method method, const MethodSettings& settings) {
  MethodSettings own;
  std::copy_if(settings.begin(), settings.end(), std::back_inserter(own),
               [&](const RawParameter& setting) { return takes(method, setting.key); });
  if (!own.empty()) method.locate = method.with(own);
  return method;
}

void refuse_unused(const MethodSettings& settings, const std::vector<Method>& used,
                   const std::vector<Method>& all) {
  for (const RawParameter& setting : settings) {
    const bool is_used = std::any_of(
        used.begin(), used.end(), [&](const Method& method) { return takes(method, setting.key); });
    if (is_used) continue;
    fail(setting.location,
         fmt::format("{} is not used by {}: it {}", setting.key, fmt::join(names_of(used), ", "),
                     who_takes(setting.key, used, all)));
  }
}

Method find_method(const std::vector<Method>& methods, const std::string& name) {
  for (const Method& method : methods) {
    if (method.name == name) return method;
  }
  throw Error(fmt::format("there is no method '{}'{}", name, suggestion(name, names_of(methods))));
}

TagEstimate reference_estimate(const std::string& tag, const Eigen::Vector3d& p_WT) {
  Candidate there;
  there.p_WT = p_WT;
  there.covariance = Eigen::Matrix3d::Zero();
  TagEstimate estimate;
  estimate.tag = tag;
  estimate.verdict = Verdict::kLocated;
  estimate.reason = "a reference tag: its position was given";
  estimate.candidates = {there};
  return estimate;
}

void tell(const LocalizationProblem& problem, const std::string& what, double share) {
  if (problem.on_locating) problem.on_locating(what, share);
}

std::vector<TagEstimate> locate_each(
    const LocalizationProblem& problem, int threads,
    const std::function<TagEstimate(const std::string& tag, const SamplesOfTag& samples)>& locate) {
  std::vector<const SamplesByTag::value_type*> tags;
  tags.reserve(problem.samples.size());
  for (const auto& entry : problem.samples) tags.push_back(&entry);
  std::vector<TagEstimate> estimates(tags.size());
  std::atomic<std::size_t> done{0};
  parallel_for(tags.size(), threads, [&](std::size_t i) {
    const auto& [tag, samples] = *tags[i];
    const auto known = problem.reference_tags.find(tag);
    estimates[i] = known == problem.reference_tags.end() ? locate(tag, samples)
                                                         : reference_estimate(tag, known->second);
    tell(problem, "tags", static_cast<double>(++done) / static_cast<double>(tags.size()));
  });
  return estimates;
}

Method ignoring(std::vector<std::string> keys, Method method) {
  method.ignores = std::move(keys);
  return method;
}

bool all_ignore(const std::vector<Method>& methods, const std::string& key) {
  return std::all_of(methods.begin(), methods.end(), [&](const Method& method) {
    return std::find(method.ignores.begin(), method.ignores.end(), key) != method.ignores.end();
  });
}

LocateFunction named(const std::string& method, const LocateAll& locate) {
  return [=](const LocalizationProblem& problem, int threads, Diagnostics&) {
    LocalizationResult result;
    result.method = method;
    result.estimates = locate(problem, threads);
    return result;
  };
}

Method one_by_one(const std::string& name, const std::string& summary, const LocateTag& locate) {
  return {name, summary, named(name, [locate](const LocalizationProblem& problem, int threads) {
            return locate_each(problem, threads,
                               [&](const std::string& tag, const SamplesOfTag& samples) {
                                 return locate(problem, tag, samples);
                               });
          })};
}

}  // namespace tagfield
