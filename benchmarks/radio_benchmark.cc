// SPDX-License-Identifier: Apache-2.0
// Speed of the signal models: links per second of the paper's model and of the link budget, an
// antenna that moves among tags with reflections, and Gen2 inventory with four antennas.
// BENCHMARK.md has the results and the commands.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "tagfield/base/file_kind.h"
#include "tagfield/base/lane_math.h"
#include "tagfield/base/lanes.h"
#include "tagfield/base/stream_words.h"
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
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(links));
}

void paper_model(benchmark::State& state) {
  const TagPopulation tags = tags_around(state.range(0), Eigen::Vector3d::Zero());
  AntennaParameters parameters;
  parameters.name = "a";
  paper(parameters).range_m = 50.0;
  std::int64_t update = 0;
  std::size_t links = 0;
  TagsInRange near;
  for (auto _ : state) {
    links = 0;
    // Moving, so that ranges and distances are part of what is timed.
    const Eigen::Vector3d p_WA(1e-6 * static_cast<double>(update), 0.0, 1.5);
    read_tags(parameters, p_WA, update_stamp(parameters, ++update), 1, tags, near,
              [&](const PaperReads& reads) {
                benchmark::DoNotOptimize(reads.rssis_dbm.data());
                links += reads.slots.size();
              });
  }
  count_links(state, links);
}

/// The same reads by a loop over arrays without populations, ranges or replies: the reference for
/// paper_model.
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

/// All links of an antenna; the receiver's noise and quantization are not part of a link.
void link_budget(benchmark::State& state, const RadioModel& model) {
  const TagPopulation tags = tags_around(1000, Eigen::Vector3d::Zero());
  const auto world = world_at("");
  const RadioView view = view_from(model, *world, from_translation({0.0, 0.0, 1.5}), 865.7e6, 1, 1);
  std::vector<RadioPath> paths;
  std::vector<TagEnd> ends;
  std::vector<RadioLink> links(tags.size());
  for (auto _ : state) {
    ends.clear();
    tags.for_each([&](std::uint32_t slot) {
      ends.push_back({tags.model(slot), tags.pose(slot), tags.key(slot)});
    });
    links_of(view, ends, paths, links);
    benchmark::DoNotOptimize(links.data());
    benchmark::ClobberMemory();
  }
  count_links(state, tags.size());
}

/// Same, as requested by RadioAir in empty space.
void straight_links(benchmark::State& state, const RadioModel& model) {
  const TagPopulation tags = tags_around(1000, Eigen::Vector3d::Zero());
  const auto world = world_at("");
  const RadioView view = view_from(model, *world, from_translation({0.0, 0.0, 1.5}), 865.7e6, 1, 1);
  std::vector<TagInView> seen;
  std::vector<RadioLink> links(tags.size());
  for (auto _ : state) {
    seen.clear();
    tags.for_each([&](std::uint32_t slot) {
      seen.push_back({&tags.model(slot), {&tags.rotation(slot), &tags.position(slot)}});
    });
    straight_links_of(view, seen, links);
    benchmark::DoNotOptimize(links.data());
    benchmark::ClobberMemory();
  }
  count_links(state, tags.size());
}

/// The budget with patterns and polarization of upright dipoles on tags in arbitrary orientations,
/// by a loop over arrays: the reference for link_budget.
struct DipoleArrays {
  std::vector<double> x, y, z, qw, qx, qy, qz, re, im, tag_dbm, reply_dbm, slope_x, slope_y,
      slope_z;
};

void link_by_hand(const RadioModel& model, const Eigen::Vector3d& p_WA, double wave_number,
                  DipoleArrays& all) {
  in_lanes(instruction_sets().back(), [&] {
    const double px = p_WA.x();
    const double py = p_WA.y();
    const double pz = p_WA.z();
    const double radiated_dbm = model.transmit_power_dbm - model.cable_loss_db;
    const double cable_loss_db = model.cable_loss_db;
    const double modulation_db = default_tag_model()->modulation_db;
    const double peak = peak_gain(model.antenna) * peak_gain(default_tag_model()->antenna);
    const double spread = 1.0 / (2.0 * wave_number);
    const std::size_t count = all.x.size();
    const double* const x = all.x.data();
    const double* const y = all.y.data();
    const double* const z = all.z.data();
    const double* const qw = all.qw.data();
    const double* const qx = all.qx.data();
    const double* const qy = all.qy.data();
    const double* const qz = all.qz.data();
    double* const re = all.re.data();
    double* const im = all.im.data();
    double* const tag_dbm = all.tag_dbm.data();
    double* const reply_dbm = all.reply_dbm.data();
    double* const slope_x = all.slope_x.data();
    double* const slope_y = all.slope_y.data();
    double* const slope_z = all.slope_z.data();
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
      const double dx = x[i] - px;
      const double dy = y[i] - py;
      const double dz = z[i] - pz;
      const double d = std::sqrt(dx * dx + dy * dy + dz * dz);
      const double ux = dx / d;
      const double uy = dy / d;
      const double uz = dz / d;
      // The tag's wire, and the components of both wires perpendicular to the path.
      const double wx = 2.0 * (qx[i] * qz[i] + qw[i] * qy[i]);
      const double wy = 2.0 * (qy[i] * qz[i] - qw[i] * qx[i]);
      const double wz = 1.0 - 2.0 * (qx[i] * qx[i] + qy[i] * qy[i]);
      const double along = wx * ux + wy * uy + wz * uz;
      const double sine_squared = (1.0 - uz * uz) * (1.0 - along * along);
      const double amplitudes =
          lane_sine_cosine(0.5 * kPi * uz).cosine * lane_sine_cosine(0.5 * kPi * along).cosine;
      const double fits = (wz - uz * along) / std::sqrt(sine_squared);
      const double gain =
          std::sqrt(peak * amplitudes * amplitudes / sine_squared) * spread / d * fits;
      re[i] = gain;
      im[i] = d;
      slope_x[i] = -2.0 * wave_number * ux;
      slope_y[i] = -2.0 * wave_number * uy;
      slope_z[i] = -2.0 * wave_number * uz;
    }
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
      const double gain = re[i];
      const SineCosine phase = lane_sine_cosine(wave_number * im[i]);
      re[i] = gain * phase.cosine;
      im[i] = -gain * phase.sine;
      const double power_db = 10.0 * lane_log10(gain * gain);
      tag_dbm[i] = radiated_dbm + power_db;
      reply_dbm[i] = tag_dbm[i] + modulation_db + power_db - cable_loss_db;
    }
  });
}

void link_budget_by_hand(benchmark::State& state) {
  const TagPopulation tags = tags_around(1000, Eigen::Vector3d::Zero());
  DipoleArrays all;
  tags.for_each([&](std::uint32_t slot) {
    const RigidTransform X_WT = tags.pose(slot);
    all.x.push_back(X_WT.translation.x());
    all.y.push_back(X_WT.translation.y());
    all.z.push_back(X_WT.translation.z());
    all.qw.push_back(X_WT.rotation.w());
    all.qx.push_back(X_WT.rotation.x());
    all.qy.push_back(X_WT.rotation.y());
    all.qz.push_back(X_WT.rotation.z());
  });
  for (auto* const column :
       {&all.re, &all.im, &all.tag_dbm, &all.reply_dbm, &all.slope_x, &all.slope_y, &all.slope_z}) {
    column->resize(tags.size());
  }
  const RadioModel model = strong_model();
  for (auto _ : state) {
    link_by_hand(model, {0.0, 0.0, 1.5}, kTwoPi / wavelength(865.7e6), all);
    benchmark::DoNotOptimize(all.reply_dbm.data());
    benchmark::ClobberMemory();
  }
  count_links(state, tags.size());
}

RadioModel in_free_space() {
  RadioModel model = strong_model();
  model.effects.occlusion = false;
  return model;
}

/// A portal's antenna.
RadioModel circular_patch() {
  RadioModel model = in_free_space();
  model.antenna.shape = PatternShape::kPatch;
  model.antenna.beam_width_rad = radians(65.0);
  model.antenna.vertical_beam_width_rad = radians(65.0);
  model.antenna.polarization = PolarizationKind::kRightCircular;
  return model;
}

RadioModel circular_patch_with_occlusion() {
  RadioModel model = circular_patch();
  model.effects.occlusion = true;
  return model;
}

RadioModel without_any_effect() {
  RadioModel model = strong_model();
  model.effects = no_effects();
  return model;
}

/// An antenna at walking pace or at rest, 15 updates per second, that reads every tag that it
/// receives.
void one_antenna(benchmark::State& state, const std::string& path, const Eigen::Vector3d& middle,
                 double speed_m_s = 0.3, int threads = 1) {
  if (path.empty() || !is_there(path)) {
    state.SkipWithError("no such world: set TAGFIELD_AWS_WORLD");
    return;
  }
  RadioModel model = strong_model();
  model.reflection_order = static_cast<int>(state.range(0));
  const TagPopulation tags = tags_around(state.range(1), middle);
  RadioAir air(world_at(path), threads);
  const AntennaParameters parameters = antenna("a", std::make_shared<const RadioModel>(model));
  air.add(parameters, 1);
  std::vector<TagReply> replies;
  std::int64_t update = 0;
  for (auto _ : state) {
    const Time now = update_stamp(parameters, ++update);
    const double way = std::fmod(speed_m_s * to_seconds(now), 2.0);
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

void aws(benchmark::State& state) { one_antenna(state, aws_world(), {-0.2, -0.2, 0.0}); }
void aws_by_threads(benchmark::State& state) {
  one_antenna(state, aws_world(), {-0.2, -0.2, 0.0}, 0.3, static_cast<int>(state.range(2)));
}
void aws_at_rest(benchmark::State& state) {
  one_antenna(state, aws_world(), {-0.2, -0.2, 0.0}, 0.0);
}
void small_warehouse(benchmark::State& state) {
  one_antenna(state, TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf", {1.4, 0.0, 0.0});
}

/// Four antennas of one reader in turn, with noise, quantization, hopping and π ambiguity.
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
BENCHMARK(link_budget_by_hand);
BENCHMARK_CAPTURE(link_budget, all_effects_but_occlusion, in_free_space());
BENCHMARK_CAPTURE(link_budget, no_effect, without_any_effect());
BENCHMARK_CAPTURE(straight_links, all_effects_but_occlusion, in_free_space());
BENCHMARK_CAPTURE(straight_links, circular_patch, circular_patch());
BENCHMARK_CAPTURE(straight_links, no_effect, without_any_effect());
BENCHMARK_CAPTURE(link_budget, circular_patch, circular_patch());
BENCHMARK_CAPTURE(link_budget, circular_patch_with_occlusion, circular_patch_with_occlusion());
BENCHMARK_CAPTURE(link_budget, all_effects, strong_model());
BENCHMARK(aws)
    ->ArgNames({"order", "tags"})
    ->ArgsProduct({{0, 1, 2, 3}, {1000}})
    ->ArgsProduct({{2}, {10, 100}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(aws_by_threads)
    ->ArgNames({"order", "tags", "threads"})
    ->ArgsProduct({{0, 1, 2}, {1000}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(aws_at_rest)
    ->ArgNames({"order", "tags"})
    ->ArgsProduct({{2, 3}, {1000}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(small_warehouse)
    ->ArgNames({"order", "tags"})
    ->ArgsProduct({{0, 1, 2, 3}, {1000}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(gen2)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tagfield

BENCHMARK_MAIN();
