// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/internal/live_clock.h"

namespace tagfield {
namespace {

/// Lag above which the simulation does not catch up.
constexpr std::chrono::milliseconds kMaxLag(500);
constexpr std::chrono::seconds kPaceOver(1);

double seconds(LiveClock::Wall::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

LiveClock::LiveClock(double speed, bool is_paused)
    : speed_(speed), until_(is_paused ? Time::min() : Time::max()) {}

void LiveClock::anchor(Time now, Wall wall) {
  anchor_ = now;
  anchor_wall_ = wall;
}

void LiveClock::measure_from(Time now, Wall wall) {
  second_ = now;
  second_wall_ = wall;
  pace_ = 0.0;
}

void LiveClock::set_speed(double speed, Time now, Wall wall) {
  speed_ = speed;
  anchor(now, wall);
  measure_from(now, wall);
}

void LiveClock::pause() { until_ = Time::min(); }

void LiveClock::resume(Time now, Wall wall) { run_until(Time::max(), now, wall); }

void LiveClock::run_until(Time until, Time now, Wall wall) {
  const bool goes_on = !is_paused(now);
  until_ = until;
  if (goes_on) return;
  anchor(now, wall);
  measure_from(now, wall);
}

void LiveClock::run_for(Duration simulated, Time now, Wall wall) {
  const bool went_too_far = is_paused(now) && until_ != Time::min();
  run_until((went_too_far ? until_ : now) + simulated, now, wall);
}

std::optional<Time> LiveClock::step_end(Time now) const {
  if (is_paused(now) || until_ == Time::max()) return std::nullopt;
  return until_;
}

LiveClock::Wall LiveClock::due(Time end) const {
  if (!(speed_ > 0.0)) return anchor_wall_;
  const std::chrono::duration<double> after(to_seconds(end - anchor_) / speed_);
  return anchor_wall_ + std::chrono::duration_cast<Wall::duration>(after);
}

void LiveClock::stepped(Time now, Wall wall) {
  if (wall > due(now) + kMaxLag) anchor(now, wall);
  const Wall::duration passed = wall - second_wall_;
  if (passed < kPaceOver) return;
  pace_ = to_seconds(now - second_) / seconds(passed);
  second_ = now;
  second_wall_ = wall;
}

double LiveClock::pace(Time now, Wall wall) const {
  if (is_paused(now)) return 0.0;
  if (pace_ > 0.0) return pace_;
  const double passed_s = seconds(wall - second_wall_);
  return passed_s > 0.0 ? to_seconds(now - second_) / passed_s : 0.0;
}

}  // namespace tagfield
