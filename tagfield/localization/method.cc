#include "tagfield/localization/method.h"

#include "tagfield/base/parallel.h"

namespace tagfield {
TagEstimate reference_estimate(const std::string& tag, const Eigen::Vector3d& p_WT) {
  Candidate there;
  there.p_WT = p_WT;
  there.covariance = Eigen::Matrix3d::Zero();
  TagEstimate estimate;
  estimate.tag = tag;
  estimate.verdict = Verdict::kLocated;
  estimate.reason = "a reference tag: its place was given";
  estimate.candidates = {there};
  return estimate;
}

std::vector<TagEstimate> locate_each(
    const LocalizationProblem& problem, int threads,
    const std::function<TagEstimate(const std::string& tag, const SamplesOfTag& samples)>& locate) {
  std::vector<const SamplesByTag::value_type*> tags;
  tags.reserve(problem.samples.size());
  for (const auto& entry : problem.samples) tags.push_back(&entry);
  std::vector<TagEstimate> estimates(tags.size());
  parallel_for(tags.size(), threads, [&](std::size_t i) {
    const auto& [tag, samples] = *tags[i];
    const auto known = problem.reference_tags.find(tag);
    estimates[i] = known == problem.reference_tags.end() ? locate(tag, samples)
                                                         : reference_estimate(tag, known->second);
  });
  return estimates;
}

}  // namespace tagfield
