// SPDX-License-Identifier: Apache-2.0
// Time that each method takes for one tag with 700 reads, and with more and fewer; see
// BENCHMARK.md.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "tagfield/base/units.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

constexpr int kReads = 700;

/// A tag at `p_WT`, read that often in 47 s from an S-shaped path of 14 m; RSSI in whole decibels.
std::vector<PhaseSample> read_at(const Eigen::Vector3d& p_WT, unsigned seed, int reads = kReads) {
  const double step_m = 0.02 * kReads / reads;
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::vector<PhaseSample> samples;
  Eigen::Vector3d p_WA(0.0, 0.0, 0.4);
  for (int i = 0; i < reads; ++i) {
    const double heading = 1.1 * std::sin(kTwoPi * step_m * i / 11.0);
    p_WA += step_m * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0);
    const double r = (p_WT - p_WA).norm();
    PhaseSample sample;
    sample.stamp = time_from_seconds(1.7e9 + step_m * i / 0.3);
    sample.frequency_hz = 865.7e6;
    sample.phase_rad =
        wrap_to_two_pi(4.0 * kPi / wavelength(sample.frequency_hz) * r + 1.0 + noise(rng));
    sample.p_WA = p_WA;
    sample.rssi_dbm = std::round(-30.0 - 40.0 * std::log10(r) + 5.0 * noise(rng));
    samples.push_back(sample);
  }
  return samples;
}

/// A tag 2.5 m beside the path.
LocalizationProblem one_tag(int reads = kReads) {
  const Eigen::Vector3d p_WT(6.0, 2.5, 0.9);
  LocalizationProblem problem;
  problem.heights.of_all = p_WT.z();
  problem.samples["tag"]["antenna"] = read_at(p_WT, 1, reads);
  for (const PhaseSample& sample : problem.samples["tag"]["antenna"]) {
    problem.tracks["antenna"].X_WA.push_back({sample.stamp, from_translation(sample.p_WA)});
  }
  return problem;
}

/// For methods that need them: four reference tags around it with as many reads.
void add_reference_tags(LocalizationProblem& problem) {
  for (const double x : {5.0, 7.0}) {
    for (const double y : {1.5, 3.5}) {
      const std::size_t number = problem.reference_tags.size();
      const std::string id = "reference" + std::to_string(number);
      problem.reference_tags[id] = {x, y, 0.9};
      problem.samples[id]["antenna"] = read_at({x, y, 0.9}, static_cast<unsigned>(number) + 2);
    }
  }
}

void locate(benchmark::State& state, const Method& method, int reads) {
  LocalizationProblem problem = one_tag(reads);
  if (method.name == "landmarc") add_reference_tags(problem);
  for (auto _ : state) {
    Diagnostics diagnostics;
    benchmark::DoNotOptimize(method.locate(problem, 1, diagnostics));
  }
}

}  // namespace
}  // namespace tagfield

int main(int argc, char** argv) {
  using namespace tagfield;
  const auto add = [](const std::string& name, const Method& method, int reads) {
    benchmark::RegisterBenchmark(name.c_str(), [method, reads](benchmark::State& state) {
      locate(state, method, reads);
    })->Unit(benchmark::kMillisecond);
  };
  for (const Method& method : built_in_methods()) add("locate/" + method.name, method, kReads);
  for (const char* name : {"hyperbola", "ml", "sar", "robust"}) {
    for (const int reads : {500, 1500, 5000, 15000}) {
      add(std::string("locate/") + name + "/reads:" + std::to_string(reads),
          find_method(built_in_methods(), name), reads);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
