// How fast the signal models are: links a second of the paper's model and of the link budget, an
// antenna that moves among tags with reflections, and Gen2 inventory with four antennas.
// BENCHMARK.md has the results and the commands.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/lanes.h"
#include "tagfield/base/units.h"
#include "tagfield/field/radio_air.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {
namespace {

/// Tags within a disc of 5 m around the origin, 1 m to 2.5 m high.
TagPopulation tags_around(std::int64_t count, const Eigen::Vector3d& middle) {
  TagPopulation tags(3.5);
  RandomStream stream(1, Purpose::kPlaces);
  for (std::int64_t i = 0; i < count; ++i) {
    const double radius = 5.0 * std::sqrt(uniform(stream));
    const double around = kTwoPi * uniform(stream);
    tags.add(static_cast<std::uint32_t>(i), fmt::format("tag{}", i),
             middle + Eigen::Vector3d(radius * std::cos(around), radius * std::sin(around),
                                      1.0 + 1.5 * uniform(stream)));
  }
  return tags;
}

AntennaParameters antenna(const std::string& name, std::shared_ptr<const RadioModel> radio) {
  AntennaParameters parameters;
  parameters.name = name;
  parameters.model = std::move(radio);
  return parameters;
}

/// An omnidirectional antenna strong enough for all tags around it.
RadioModel strong_model() {
  RadioModel model;
  model.plan = fixed_plan(865.7e6);
  model.antenna.shape = PatternShape::kDipole;
  model.antenna.gain_dbi = 2.15;
  model.transmit_power_dbm = 36.0;
  return model;
}

std::shared_ptr<const RadioWorld> world_at(const std::string& path) {
  Diagnostics diagnostics;
  const Scene scene = path.empty() ? Scene{} : load_world(path, {}, diagnostics);
  return std::make_shared<const RadioWorld>(radio_world(scene, {}, diagnostics));
}

void count_links(benchmark::State& state, std::size_t links) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(links));
}

void paper_model(benchmark::State& state) {
  const TagPopulation tags = tags_around(state.range(0), Eigen::Vector3d::Zero());
  AntennaParameters parameters;
  parameters.name = "a";
  paper(parameters).range_m = 50.0;
  std::vector<TagReply> replies;
  std::int64_t update = 0;
  for (auto _ : state) {
    read_tags(parameters, {0.0, 0.0, 1.5}, update_stamp(parameters, ++update), 1, tags, replies);
  }
  count_links(state, replies.size());
}

/// The same reads by a loop over arrays that knows nothing of populations, ranges or replies: what
/// paper_model is to be measured by.
struct PaperArrays {
  std::vector<double> x, y, z, distance, phase, rssi;
  std::vector<std::uint64_t> key, first, second;
};

PaperArrays paper_arrays(const TagPopulation& tags) {
  PaperArrays all;
  tags.for_each([&](std::uint32_t slot) {
    all.x.push_back(tags.position(slot).x());
    all.y.push_back(tags.position(slot).y());
    all.z.push_back(tags.position(slot).z());
    all.key.push_back(tags.key(slot));
  });
  for (auto* const column : {&all.distance, &all.phase, &all.rssi}) column->resize(tags.size());
  for (auto* const column : {&all.first, &all.second}) column->resize(tags.size());
  return all;
}

void read_by_hand(const PaperModel& model, const Eigen::Vector3d& p_WA, std::uint64_t stamp,
                  PaperArrays& all) {
  first_words(1, Purpose::kReadNoise, stream_key("a"), all.key, stamp, all.first, all.second);
  in_lanes(instruction_sets().back(), [&] {
    const double* const x = all.x.data();
    const double* const y = all.y.data();
    const double* const z = all.z.data();
    const std::uint64_t* const first = all.first.data();
    const std::uint64_t* const second = all.second.data();
    double* const distance = all.distance.data();
    double* const phase = all.phase.data();
    double* const rssi = all.rssi.data();
    const double half_wavelength = 0.5 * wavelength(model.frequency_hz);
    const double offset = wrap_to_two_pi(model.phase_offset_rad);
    const double at_a_metre =
        model.communication_gain * wavelength(model.frequency_hz) / (4.0 * kPi);
    const double phase_noise = model.phase_noise_rad;
    const double rssi_noise = model.rssi_noise;
    const double px = p_WA.x();
    const double py = p_WA.y();
    const double pz = p_WA.z();
    const std::size_t count = all.x.size();
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
      const double dx = x[i] - px;
      const double dy = y[i] - py;
      const double dz = z[i] - pz;
      const double d = std::sqrt(dx * dx + dy * dy + dz * dz);
      const NormalPair noise = lane_normal_pair(first[i], second[i]);
      const double turns = lane_remainder(d, half_wavelength) / half_wavelength;
      distance[i] = d;
      phase[i] = lane_wrap_to_two_pi(offset + kTwoPi * turns +
                                     lane_wrap_to_two_pi(phase_noise * noise.first));
      rssi[i] = lane_round(40.0 * lane_log10(std::abs(at_a_metre / d + rssi_noise * noise.second)));
    }
  });
}

void paper_model_by_hand(benchmark::State& state) {
  PaperArrays all = paper_arrays(tags_around(state.range(0), Eigen::Vector3d::Zero()));
  std::uint64_t stamp = 0;
  for (auto _ : state) {
    read_by_hand({}, {0.0, 0.0, 1.5}, ++stamp, all);
    benchmark::DoNotOptimize(all.rssi.data());
    benchmark::ClobberMemory();
  }
  count_links(state, all.x.size());
}

/// One link after the other; the receiver's noise and steps are not part of a link.
void link_budget(benchmark::State& state, const RadioModel& model) {
  const TagPopulation tags = tags_around(1000, Eigen::Vector3d::Zero());
  const auto world = world_at("");
  const RadioView view = view_from(model, *world, from_translation({0.0, 0.0, 1.5}), 865.7e6, 1, 1);
  std::vector<RadioPath> paths;
  double sum = 0.0;
  for (auto _ : state) {
    tags.for_each([&](std::uint32_t slot) {
      sum += link_of(view, {tags.model(slot), tags.pose(slot), tags.key(slot)}, paths).reply_dbm;
    });
  }
  benchmark::DoNotOptimize(sum);
  count_links(state, tags.size());
}

RadioModel in_free_space() {
  RadioModel model = strong_model();
  model.effects.occlusion = false;
  return model;
}

RadioModel without_any_effect() {
  RadioModel model = strong_model();
  model.effects = no_effects();
  return model;
}

/// An antenna at walking pace, 15 updates a second, that reads all it hears.
void moving_antenna(benchmark::State& state, const std::string& path,
                    const Eigen::Vector3d& middle) {
  if (path.empty() || !std::filesystem::exists(path)) {
    state.SkipWithError("no such world: set TAGFIELD_AWS_WORLD");
    return;
  }
  RadioModel model = strong_model();
  model.reflection_order = static_cast<int>(state.range(0));
  const TagPopulation tags = tags_around(state.range(1), middle);
  RadioAir air(world_at(path));
  const AntennaParameters parameters = antenna("a", std::make_shared<const RadioModel>(model));
  air.add(parameters, 1);
  std::vector<TagReply> replies;
  std::int64_t update = 0;
  for (auto _ : state) {
    const Time now = update_stamp(parameters, ++update);
    const double way = std::fmod(0.3 * to_seconds(now), 2.0);
    air.update("a", from_translation(middle + Eigen::Vector3d(way - 1.0, 0.0, 1.5)), now, tags,
               replies);
  }
  state.counters["real_time_factor"] = benchmark::Counter(
      static_cast<double>(state.iterations()) / parameters.rate_hz, benchmark::Counter::kIsRate);
  state.counters["reads"] = static_cast<double>(replies.size());
}

std::string aws_world() {
  const char* const path = std::getenv("TAGFIELD_AWS_WORLD");
  return path == nullptr ? "" : path;
}

void aws(benchmark::State& state) { moving_antenna(state, aws_world(), {-0.2, -0.2, 0.0}); }
void small_warehouse(benchmark::State& state) {
  moving_antenna(state, TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf", {1.4, 0.0, 0.0});
}

/// Four antennas of one reader by turns, noise, steps, hopping and half turns on.
void gen2(benchmark::State& state) {
  RadioModel model = strong_model();
  model.plan = known_plan("etsi_low");
  model.gen2 = Gen2Reader{};
  model.gen2->inventory.target = Target::kAlternate;
  const auto radio = std::make_shared<const RadioModel>(model);
  const TagPopulation tags = tags_around(state.range(0), Eigen::Vector3d::Zero());
  RadioAir air(world_at(""));
  for (int i = 0; i < 4; ++i) air.add(antenna(fmt::format("a{}", i), radio), 1);
  const AntennaParameters any = antenna("a0", radio);
  std::vector<TagReply> replies;
  std::int64_t update = 0;
  std::size_t reads = 0;
  for (auto _ : state) {
    const Time now = update_stamp(any, ++update);
    for (int i = 0; i < 4; ++i) {
      air.update(fmt::format("a{}", i), from_translation({2.0 * i - 3.0, 0.0, 2.0}), now, tags,
                 replies);
      reads += replies.size();
    }
  }
  const double seconds = static_cast<double>(state.iterations()) / any.rate_hz;
  state.counters["real_time_factor"] = benchmark::Counter(seconds, benchmark::Counter::kIsRate);
  state.counters["reads_per_s"] = static_cast<double>(reads) / seconds;
}

BENCHMARK(paper_model)->Arg(1000)->Arg(10000)->Arg(100000);
BENCHMARK(paper_model_by_hand)->Arg(1000)->Arg(10000)->Arg(100000);
BENCHMARK_CAPTURE(link_budget, all_effects_but_occlusion, in_free_space());
BENCHMARK_CAPTURE(link_budget, no_effect, without_any_effect());
BENCHMARK_CAPTURE(link_budget, all_effects, strong_model());
BENCHMARK(aws)
    ->ArgNames({"order", "tags"})
    ->ArgsProduct({{0, 1, 2}, {1000}})
    ->ArgsProduct({{2}, {10, 100}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(small_warehouse)
    ->ArgNames({"order", "tags"})
    ->ArgsProduct({{0, 1, 2, 3}, {1000}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(gen2)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tagfield
