// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/drive_samples.h"

#include <algorithm>

#include "tagfield/planning/moment.h"

namespace tagfield {
namespace {

const Duration kLook = std::chrono::nanoseconds(66'666'667);

DriveSample sample_at(const Scenario& scenario, const Simulation& simulation, Time stamp) {
  DriveSample sample;
  sample.stamp = stamp;
  for (const AntennaSpec& antenna : scenario.antennas) {
    sample.X_WA.push_back(simulation.antenna_pose(antenna, stamp));
  }
  for (const TagSpec& tag : scenario.tags) {
    sample.X_WT.push_back(simulation.tag_pose(tag, stamp));
  }
  return sample;
}

bool any_elsewhere(const std::vector<RigidTransform>& from, const std::vector<RigidTransform>& to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (is_elsewhere(from[i], to[i])) return true;
  }
  return false;
}

bool can_move(const Scenario& scenario) {
  const bool any_antenna = std::any_of(
      scenario.antennas.begin(), scenario.antennas.end(), [](const AntennaSpec& antenna) {
        return !antenna.on.empty() || antenna.lift.travel_m > 0.0 || !antenna.recorded.empty();
      });
  return any_antenna || std::any_of(scenario.tags.begin(), scenario.tags.end(), moves);
}

}  // namespace

bool is_elsewhere(const RigidTransform& from, const RigidTransform& to) {
  return (to.translation - from.translation).norm() >= kSampleDistance_m ||
         from.rotation.angularDistance(to.rotation) >= kSampleTurn_rad;
}

std::vector<DriveSample> sample_drive(const Scenario& scenario, std::uint64_t seed,
                                      std::optional<Time> time) {
  Simulation simulation = simulation_at(scenario, seed, time.value_or(Time{}));
  std::vector<DriveSample> samples = {
      sample_at(scenario, simulation, time.value_or(simulation.now()))};
  if (time || !can_move(scenario)) return samples;
  Time looked{};
  while (!simulation.finished()) {
    simulation.skip_step();
    if (simulation.now() - looked < kLook && !simulation.finished()) continue;
    looked = simulation.now();
    DriveSample sample = sample_at(scenario, simulation, looked);
    const DriveSample& last = samples.back();
    if (any_elsewhere(last.X_WA, sample.X_WA) || any_elsewhere(last.X_WT, sample.X_WT)) {
      samples.push_back(std::move(sample));
    }
  }
  return samples;
}

std::vector<std::size_t> places_of(const std::vector<DriveSample>& samples, std::size_t antenna) {
  std::vector<std::size_t> places = {0};
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (is_elsewhere(samples[places.back()].X_WA[antenna], samples[i].X_WA[antenna])) {
      places.push_back(i);
    }
  }
  return places;
}

bool moves_in(const std::vector<DriveSample>& samples, std::size_t tag) {
  return std::any_of(samples.begin(), samples.end(), [&](const DriveSample& sample) {
    return is_elsewhere(samples.front().X_WT[tag], sample.X_WT[tag]);
  });
}

}  // namespace tagfield
