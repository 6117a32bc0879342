// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/read_range.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/strays.h"

namespace tagfield {
namespace {

/// An antenna that moved less than this [m] between two poses was stationary, however far apart
/// they are in time.
constexpr double kStillDistance = 0.01;

bool is_finite(const AntennaPose& pose) {
  return pose.X_WA.translation.allFinite() && pose.X_WA.rotation.coeffs().allFinite() &&
         (!pose.covariance || pose.covariance->allFinite());
}

bool is_usable(const TagRead& read) {
  return std::isfinite(read.phase_rad) && is_carrier(read.frequency_hz);
}

std::string range_words(Time first, Time last) {
  return fmt::format("from {:.3f} to {:.3f} s", to_seconds(first), to_seconds(last));
}

/// Sorts by time, keeps the first of poses with equal stamps and returns how many were dropped.
std::size_t sort_and_drop_repeats(std::vector<const AntennaPose*>& poses) {
  const std::size_t before = poses.size();
  std::stable_sort(poses.begin(), poses.end(),
                   [](const auto* a, const auto* b) { return a->stamp < b->stamp; });
  const auto same = [](const auto* a, const auto* b) { return a->stamp == b->stamp; };
  poses.erase(std::unique(poses.begin(), poses.end(), same), poses.end());
  return before - poses.size();
}

using StampRanges = std::map<std::string, StampRange>;

using StampsByAntenna = std::map<std::string, std::vector<Time>>;

/// Range of each antenna's stamps, without those of a wrong clock.
StampRanges ranges_of(StampsByAntenna&& stamps) {
  StampRanges ranges;
  for (auto& [antenna, of_antenna] : stamps) {
    ranges[antenna] = range_without_strays(std::move(of_antenna));
  }
  return ranges;
}

template <typename Row>
bool is_stray(const Row& row, const StampRanges& ranges) {
  const StampRange& range = ranges.at(row.antenna);
  return row.stamp < range.begin || row.stamp > range.end;
}

/// Warns of the rows for which is_stray() holds. `what`: "reads" or "poses".
void warn_of_strays(const StampsByAntenna& strays, const StampRanges& ranges, const char* what,
                    Diagnostics& diagnostics) {
  for (const auto& [antenna, stamps] : strays) {
    const StampRange& range = ranges.at(antenna);
    diagnostics.warn(fmt::format(
        "antenna '{}': {} {} left out, at {} s{}, far from all others, which are {}: was the clock "
        "wrong? Correct or delete stamps like that",
        antenna, stamps.size(), what, format_stamp(stamps.front()),
        stamps.size() > 1 ? " and so on" : "", range_words(range.begin, range.end)));
  }
}

/// Covariances are used only if every pose has one.
BelievedTrack track_of(const std::vector<const AntennaPose*>& poses) {
  BelievedTrack track;
  for (const AntennaPose* pose : poses) {
    track.X_WA.push_back({pose->stamp, pose->X_WA});
    if (pose->covariance) track.covariance.push_back(*pose->covariance);
  }
  if (track.covariance.size() != track.X_WA.size()) track.covariance.clear();
  return track;
}

struct ReadCount {
  std::size_t all = 0;
  std::size_t broken = 0;
  std::size_t without_pose = 0;
  std::size_t repeated = 0;
  Time first = Time::max();
  Time last = Time::min();
};

using Tracks = std::map<std::string, BelievedTrack>;

/// Message that an antenna with reads has no poses, suggesting a similar name.
std::string no_poses(const std::string& antenna, const Tracks& tracks) {
  if (tracks.empty()) return "there are no poses";
  std::vector<std::string> names;
  for (const auto& [name, track] : tracks) names.push_back(name);
  return "there are no poses of it" + suggestion(antenna, names);
}

/// Why reads of the antenna have no pose.
std::string why_without_pose(const std::string& antenna, const ReadCount& count,
                             const Tracks& tracks, double max_pose_gap_s) {
  const auto track = tracks.find(antenna);
  if (track == tracks.end()) return no_poses(antenna, tracks);
  const Time begin = track->second.X_WA.front().stamp;
  const Time end = track->second.X_WA.back().stamp;
  std::string ranges = fmt::format("reads are {}, poses {}", range_words(count.first, count.last),
                                   range_words(begin, end));
  const Duration apart = std::max(begin - count.last, count.first - end);
  if (apart > Duration::zero()) {
    return fmt::format("{}, {:.3f} s apart: are they of one clock?", ranges, to_seconds(apart));
  }
  if (count.first < begin || count.last > end) return ranges;
  return fmt::format("its poses there are over {:g} s apart", max_pose_gap_s);
}

void warn_of_reads_left_out(const std::map<std::string, ReadCount>& counts, const Tracks& tracks,
                            double max_pose_gap_s, Diagnostics& diagnostics) {
  for (const auto& [antenna, count] : counts) {
    if (count.broken > 0) {
      diagnostics.warn(fmt::format(
          "antenna '{}': {} of {} reads have no usable phase or carrier and are left out", antenna,
          count.broken, count.all));
    }
    if (count.without_pose > 0) {
      diagnostics.warn(fmt::format(
          "antenna '{}': {} of {} reads have no pose at their stamp and are left out: {}", antenna,
          count.without_pose, count.all, why_without_pose(antenna, count, tracks, max_pose_gap_s)));
    }
    if (count.repeated > 0) {
      diagnostics.warn(fmt::format(
          "antenna '{}': {} of {} reads repeat tag and stamp of another; only the first counts",
          antenna, count.repeated, count.all));
    }
  }
}

/// Sorts a series by time, keeps the first of equal stamps and returns how many were dropped.
std::size_t put_in_order(std::vector<PhaseSample>& samples) {
  const std::size_t before = samples.size();
  std::stable_sort(samples.begin(), samples.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const auto same = [](const auto& a, const auto& b) { return a.stamp == b.stamp; };
  samples.erase(std::unique(samples.begin(), samples.end(), same), samples.end());
  return before - samples.size();
}

/// Detects whether all phases are identical, and the greatest magnitude of one.
class PhasesSeen {
 public:
  void add(double phase_rad) {
    if (count_++ == 0) first_ = phase_rad;
    differ_ = differ_ || phase_rad != first_;
    if (std::isfinite(phase_rad)) greatest_rad_ = std::max(greatest_rad_, std::abs(phase_rad));
  }
  [[nodiscard]] double greatest_rad() const { return greatest_rad_; }
  /// See has_phases().
  [[nodiscard]] bool any() const { return count_ < kEnough || differ_; }

 private:
  static constexpr std::size_t kEnough = 8;
  std::size_t count_ = 0;
  double first_ = 0.0;
  double greatest_rad_ = 0.0;
  bool differ_ = false;
};

/// Result of the first pass over the reads.
struct FirstLook {
  StampRanges ranges;
  /// Number of reads by tag and antenna.
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  bool has_phases = true;
  double greatest_phase_rad = 0.0;
};

/// Readers report one or two cycles; more are unwrapped phases, or another unit.
void warn_of_many_cycles(double phase_rad, Diagnostics& diagnostics) {
  constexpr double kUsual = 2.0 * kTwoPi + 0.1;
  if (phase_rad <= kUsual) return;
  diagnostics.warn(fmt::format(
      "phases of up to {:.5g} rad: whole cycles are dropped, which is right if they are "
      "unwrapped, but not if they are in degrees or steps (a dataset's profile states "
      "the unit)",
      phase_rad));
}

FirstLook first_look(const EachRead& each_read) {
  FirstLook look;
  StampsByAntenna stamps;
  PhasesSeen phases;
  each_read([&](const TagRead& read) {
    stamps[read.antenna].push_back(read.stamp);
    ++look.counts[read.tag][read.antenna];
    phases.add(read.phase_rad);
  });
  look.ranges = ranges_of(std::move(stamps));
  look.has_phases = phases.any();
  look.greatest_phase_rad = phases.greatest_rad();
  return look;
}

}  // namespace

std::map<std::string, BelievedTrack> tracks_of(const std::vector<AntennaPose>& poses,
                                               Diagnostics& diagnostics) {
  std::map<std::string, std::vector<const AntennaPose*>> by_antenna;
  std::map<std::string, std::size_t> broken;
  StampsByAntenna stamps;
  for (const AntennaPose& pose : poses) stamps[pose.antenna].push_back(pose.stamp);
  const StampRanges ranges = ranges_of(std::move(stamps));
  StampsByAntenna strays;
  for (const AntennaPose& pose : poses) {
    if (is_stray(pose, ranges)) {
      strays[pose.antenna].push_back(pose.stamp);
    } else if (is_finite(pose)) {
      by_antenna[pose.antenna].push_back(&pose);
    } else {
      ++broken[pose.antenna];
    }
  }
  warn_of_strays(strays, ranges, "poses", diagnostics);
  for (const auto& [antenna, count] : broken) {
    diagnostics.warn(
        fmt::format("antenna '{}': {} poses are not finite and are left out", antenna, count));
  }
  std::map<std::string, BelievedTrack> tracks;
  for (auto& [antenna, of_antenna] : by_antenna) {
    const std::size_t repeats = sort_and_drop_repeats(of_antenna);
    tracks[antenna] = track_of(of_antenna);
    if (repeats == 0) continue;
    diagnostics.warn(
        fmt::format("antenna '{}': {} poses repeat the stamp of another; only the first counts",
                    antenna, repeats));
  }
  return tracks;
}

EachRead each_of(const std::vector<TagRead>& reads) {
  return EachRead([&reads](const EachRead::Take& take) {
    for (const TagRead& read : reads) take(read);
  });
}

bool has_phases(const std::vector<TagRead>& reads) {
  PhasesSeen phases;
  for (const TagRead& read : reads) phases.add(read.phase_rad);
  return phases.any();
}

SamplesByTag join_reads_with_tracks(const std::vector<TagRead>& reads,
                                    const std::map<std::string, BelievedTrack>& tracks,
                                    double max_pose_gap_s, Diagnostics& diagnostics) {
  return join_reads_with_tracks(each_of(reads), tracks, max_pose_gap_s, diagnostics).samples;
}

JoinedReads join_reads_with_tracks(const EachRead& each_read,
                                   const std::map<std::string, BelievedTrack>& tracks,
                                   double max_pose_gap_s, Diagnostics& diagnostics) {
  const Duration max_gap = duration_from_seconds(max_pose_gap_s);
  const FirstLook look = first_look(each_read);
  JoinedReads joined;
  joined.has_phases = look.has_phases;
  warn_of_many_cycles(look.greatest_phase_rad, diagnostics);
  std::map<std::string, ReadCount> counts;
  StampsByAntenna strays;
  each_read([&](const TagRead& read) {
    SamplesOfTag& of_tag = joined.samples[read.tag];
    ReadCount& count = counts[read.antenna];
    ++count.all;
    if (is_stray(read, look.ranges)) {
      strays[read.antenna].push_back(read.stamp);
      return;
    }
    count.first = std::min(count.first, read.stamp);
    count.last = std::max(count.last, read.stamp);
    if (!is_usable(read)) {
      ++count.broken;
      return;
    }
    const auto track = tracks.find(read.antenna);
    std::optional<RigidTransform> X_WA;
    if (track != tracks.end()) {
      X_WA = pose_at(track->second.X_WA, read.stamp, max_gap, kStillDistance);
    }
    if (!X_WA) {
      ++count.without_pose;
      return;
    }
    std::vector<PhaseSample>& samples = of_tag[read.antenna];
    // Exactly the number of reads: with many tags, spare capacity would take as much memory as the
    // reads.
    if (samples.empty()) samples.reserve(look.counts.at(read.tag).at(read.antenna));
    samples.push_back({read.stamp, wrap_to_two_pi(read.phase_rad), read.frequency_hz,
                       X_WA->translation, is_rssi(read.rssi_dbm) ? read.rssi_dbm : kNoRssi});
  });
  warn_of_strays(strays, look.ranges, "reads", diagnostics);
  for (auto& [tag, of_tag] : joined.samples) {
    for (auto& [antenna, samples] : of_tag) counts[antenna].repeated += put_in_order(samples);
  }
  warn_of_reads_left_out(counts, tracks, max_pose_gap_s, diagnostics);
  return joined;
}

}  // namespace tagfield
