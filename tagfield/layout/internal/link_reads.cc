// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/internal/link_reads.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tagfield/base/units.h"
#include "tagfield/gen2/inventory.h"
#include "tagfield/planning/local_link.h"
#include "tagfield/reader/reader_hardware.h"

namespace tagfield {
namespace {

constexpr double kReply_dbm = -50.0;  ///< The same for all tags, so that there is no capture.
/// Signal strength falls with the fourth power of the distance and scatters, as assumed by `fixed`.
constexpr double kSlope_db = 40.0;
constexpr double kFading_db = 4.0;

/// The carriers' variance [Hz²].
double spread_of(const RadioModel& model) {
  if (hopped_channels(model) < 2) return 0.0;
  const std::vector<double>& carriers = model.plan.carriers_hz;
  const auto count = static_cast<double>(carriers.size());
  double mean = 0.0;
  for (const double carrier : carriers) mean += carrier / count;
  double variance = 0.0;
  for (const double carrier : carriers) variance += (carrier - mean) * (carrier - mean) / count;
  return variance;
}

}  // namespace

double port_dwell_s(const RadioModel& model) {
  return model.gen2 ? model.gen2->port_dwell_s : Gen2Reader{}.port_dwell_s;
}

double reads_a_turn(const RadioModel& model, double rate_hz, std::size_t ports, std::size_t tags) {
  constexpr int kTurns = 20;
  const double dwell_s = port_dwell_s(model);
  // Without an inventory all ports read simultaneously, each at its updates.
  if (!takes_inventory(model)) {
    return rate_hz * dwell_s * static_cast<double>(ports);
  }
  TagMemories memories;
  Inventory inventory(model.gen2->link, model.gen2->inventory, memories, 1, 1);
  std::vector<TagOnAir> heard;
  for (std::size_t tag = 0; tag < tags; ++tag) {
    heard.push_back({static_cast<std::uint32_t>(tag), kReply_dbm, 1.0});
  }
  std::vector<Singulation> read;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double begin_s = dwell_s * static_cast<double>(ports) * turn;
    const Time begin = time_from_seconds(begin_s);
    inventory.run_until(begin, read);
    inventory.set_field(begin, heard);
    inventory.start(begin);
    const Time end = time_from_seconds(begin_s + dwell_s);
    inventory.run_until(end, read);
    if (ports > 1) inventory.stop(end);
  }
  return static_cast<double>(read.size()) / (kTurns * static_cast<double>(tags));
}

double ReadsATurn::of(const RadioModel& model, double rate_hz, double tags) {
  // Two significant digits suffice.
  const double step = std::pow(10.0, std::floor(std::log10(std::max(tags, 1.0))) - 1.0);
  const auto count =
      static_cast<std::size_t>(std::max(1.0, std::round(std::round(tags / step) * step)));
  const auto [known, is_new] = known_.try_emplace({&model, count}, 0.0);
  if (is_new) known->second = reads_a_turn(model, rate_hz, ports_, count);
  return known->second;
}

double information_of_phases(double spread_over_noise) {
  constexpr double kPerMeter = 4.0 * kPi / kSpeedOfLight;
  return kPerMeter * kPerMeter * spread_over_noise;
}

double information_of_strength(double distance_m) {
  const double slope = kSlope_db / (std::log(10.0) * std::max(distance_m, 0.1));  // [dB/m]
  return std::pow(slope / kFading_db, 2.0);
}

PositionInformation information_along(double information, const Eigen::Vector3d& p_WA,
                                      const Eigen::Vector3d& p_WT) {
  const Eigen::Vector3d way = p_WT - p_WA;
  const Eigen::Vector2d u = way.head<2>() / std::max(way.norm(), 1e-9);
  return {0, static_cast<float>(information * u.x() * u.x()),
          static_cast<float>(information * u.x() * u.y()),
          static_cast<float>(information * u.y() * u.y())};
}

RangeInformation range_information(const RadioModel& model, const LinkStates& states,
                                   double less_db, double distance_m) {
  RangeInformation information;
  if (states.is_empty()) return information;
  double heard = 0.0;
  double precision = 0.0;  // 1/σφ², summed.
  for (std::size_t place = 0; place < kFadingPositions; ++place) {
    for (std::size_t carrier = 0; carrier < states.carriers(); ++carrier) {
      const double margin_db = states.margin_db(place, carrier) - less_db;
      if (margin_db < 0.0) continue;
      const double reply_dbm = model.hardware.sensitivity_dbm + 2.0 * margin_db;
      heard += 1.0;
      precision += std::pow(phase_sigma(model.hardware, reply_dbm), -2.0);
    }
  }
  if (heard == 0.0) return information;
  information.precision = precision / heard;
  information.by_strength = information_of_strength(distance_m);
  return information;
}

double expected_spread(const RadioModel& model, double reads, double visited) {
  const double channels =
      std::clamp(std::min(visited, reads), 1.0, static_cast<double>(hopped_channels(model)));
  // For channels drawn without replacement, approximately the variance of all minus that of their
  // mean.
  return reads * spread_of(model) * (1.0 - 1.0 / channels);
}

PositionInformation position_information(const RangeInformation& range, double reads, double spread,
                                         const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT) {
  if (!(reads > 0.0)) return {};
  return information_along(
      information_of_phases(spread * range.precision) + range.by_strength * std::min(reads, 1.0),
      p_WA, p_WT);
}

}  // namespace tagfield
