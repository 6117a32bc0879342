// SPDX-License-Identifier: Apache-2.0
// A custom outlet: counts each antenna's reads per second during the run, and tracks the greatest
// distance of a tag that was read.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/simulator/simulation.h"

namespace {

class ReadRate final : public tagfield::ReadListener, public tagfield::TruthListener {
 public:
  // Stamps never decrease, even across antennas.
  void on_read(const tagfield::TagRead& read) override {
    const double second = tagfield::to_seconds(read.stamp);
    if (second >= next_) print(second);
    ++counts_[read.antenna];
  }
  // The truth is separate from the reads: a real reader would not report it.
  void on_distance(const tagfield::TrueDistance& distance) override {
    farthest_m_ = std::max(farthest_m_, distance.distance_m);
  }

 private:
  void print(double second) {
    std::printf("%5.1f s:", next_);
    for (auto& [antenna, count] : counts_) {
      std::printf(" %s %.0f reads/s", antenna.c_str(), count / kInterval);
      count = 0.0;
    }
    std::printf(", up to %.2f m away\n", farthest_m_);
    while (next_ <= second) next_ += kInterval;
  }

  static constexpr double kInterval = 5.0;  // [s]
  double next_ = kInterval;
  double farthest_m_ = 0.0;
  std::map<std::string, double> counts_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: own_outlet SCENARIO\n"), 2;
  tagfield::Diagnostics diagnostics;
  const auto loaded = tagfield::load_scenario_with_world(argv[1], {}, diagnostics);
  tagfield::Outlets outlets;
  attach(std::make_shared<ReadRate>(), outlets);
  tagfield::Simulation simulation(loaded.scenario, /*seed=*/1, outlets);
  while (!simulation.finished()) simulation.step();
}
