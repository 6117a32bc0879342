// SPDX-License-Identifier: Apache-2.0
// A custom localization method: a tag is where its reads are strongest. It is compared with
// Tagfield's hyperbolae, in one scenario with and without pose noise.
#include <cmath>
#include <cstdio>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/locate.h"
#include "tagfield/simulator/simulation.h"

namespace {

// The method's settings.
struct CentroidOptions {
  double power = 1.0;  // Exponent of the received power, as weight of positions.
};

// The mean of the antenna positions at which the tag was read, weighted by the received power: near
// the point of the path that is closest to the tag. It uses no phase, so its error is of the order
// of the distance from the path.
tagfield::TagEstimate centroid(const tagfield::LocalizationProblem& problem, const std::string& tag,
                               const tagfield::SamplesOfTag& samples,
                               const CentroidOptions& options) {
  tagfield::TagEstimate estimate = tagfield::begun(tag, samples);
  if (estimate.reads == 0) return tagfield::not_located(estimate, "no reads");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const auto& [antenna, series] : samples) {
    for (const tagfield::PhaseSample& sample : series) {
      const double weight = std::pow(10.0, options.power * sample.rssi_dbm / 10.0);
      sum += weight * sample.p_WA;
      weights += weight;
    }
  }
  tagfield::Candidate place;
  place.p_WT = sum / weights;
  place.p_WT.z() = tagfield::plane_height(problem, tag);
  estimate.candidates = {place};
  estimate.verdict = tagfield::Verdict::kLocated;
  return estimate;
}

// Its settings can be given in scenarios and suites like those of any other method.
tagfield::Method centroid_method() {
  const tagfield::OptionTable<CentroidOptions> settings{
      {tagfield::setting<CentroidOptions>("power", "", "of the received power, as a weight",
                                          &CentroidOptions::power, tagfield::kOverZero)}};
  return tagfield::one_by_one("centroid", "mean of the antenna's places, weighted by RSSI",
                              settings, CentroidOptions{}, centroid);
}

std::vector<tagfield::Method> all_methods() {
  std::vector<tagfield::Method> methods = tagfield::built_in_methods();
  methods.push_back(centroid_method());
  return methods;
}

// Equivalent to a suite's file, which load_suite() reads.
tagfield::Suite comparison(const std::string& scenario) {
  tagfield::Condition exact;
  exact.name = "true pose";
  exact.scenario = scenario;
  tagfield::Condition noisy = exact;
  noisy.name = "pose 2 cm";
  noisy.settings = {{"pose.source", "noisy"}, {"pose.sigma_m", "0.02"}};
  tagfield::Suite suite;
  suite.name = "own_method";
  suite.count = 3;
  suite.methods = {{"hyperbola", "hyperbola", {}, {}},
                   {"centroid", "centroid", {}, {}},
                   {"sharper", "centroid", {{"localization.power", "2"}}, {}}};
  suite.conditions = {exact, noisy};
  return suite;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: own_method SCENARIO.yaml\n");
    return 2;
  }
  try {
    const tagfield::Bench bench = tagfield::run_bench(comparison(argv[1]), all_methods(), {});
    std::printf("%s", tagfield::bench_to_text(bench, tagfield::Timing::kWithoutTimes).c_str());
  } catch (const tagfield::Error& error) {
    std::fprintf(stderr, "own_method: %s\n", error.what());
    return 2;
  }
}
