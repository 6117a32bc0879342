// How long each method takes for one tag of 700 reads; see BENCHMARK.md.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "tagfield/base/units.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

constexpr int kReads = 700;

/// Read at `p_WT` from an S-shaped way of 14 m at 2 cm a read; RSSI in whole decibels.
std::vector<PhaseSample> read_at(const Eigen::Vector3d& p_WT, unsigned seed) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::vector<PhaseSample> samples;
  Eigen::Vector3d p_WA(0.0, 0.0, 0.4);
  for (int i = 0; i < kReads; ++i) {
    const double heading = 1.1 * std::sin(kTwoPi * 0.02 * i / 11.0);
    p_WA += 0.02 * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0);
    const double r = (p_WT - p_WA).norm();
    PhaseSample sample;
    sample.stamp = time_from_seconds(1.7e9 + i / 15.0);
    sample.frequency_hz = 865.7e6;
    sample.phase_rad =
        wrap_to_two_pi(4.0 * kPi / wavelength(sample.frequency_hz) * r + 1.0 + noise(rng));
    sample.p_WA = p_WA;
    sample.rssi_dbm = std::round(-30.0 - 40.0 * std::log10(r) + 5.0 * noise(rng));
    samples.push_back(sample);
  }
  return samples;
}

/// The tag 2.5 m beside the way.
LocalizationProblem one_tag() {
  const Eigen::Vector3d p_WT(6.0, 2.5, 0.9);
  LocalizationProblem problem;
  problem.heights.of_all = p_WT.z();
  problem.samples["tag"]["antenna"] = read_at(p_WT, 1);
  for (const PhaseSample& sample : problem.samples["tag"]["antenna"]) {
    problem.tracks["antenna"].X_WA.push_back({sample.stamp, from_translation(sample.p_WA)});
  }
  return problem;
}

/// For those that need them: four reference tags around it, as well read.
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

void locate(benchmark::State& state, const Method& method) {
  LocalizationProblem problem = one_tag();
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
  for (const Method& method : built_in_methods()) {
    benchmark::RegisterBenchmark(("locate/" + method.name).c_str(), [method](
                                                                        benchmark::State& state) {
      locate(state, method);
    })->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
