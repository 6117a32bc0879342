// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/tracing_forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "tagfield/channel/radio_world.h"
#include "tagfield/field/radio_air.h"
#include "tagfield/propagation/trace_paths.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/robot_spec.h"

namespace tagfield {
namespace {

constexpr double kLongRun_s = 600.0;
constexpr double kLongTrial_s = 10.0;
constexpr std::size_t kTagsTried = 20;
constexpr std::size_t kTagImagesTried = 3;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int order_of(const AntennaSpec& antenna) {
  const RadioModel* const model = physical(antenna.parameters);
  return model == nullptr || !model->effects.reflections ? 0 : model->reflection_order;
}

const RobotSpec* carrier_of(const Scenario& scenario, const AntennaSpec& antenna) {
  const auto found = std::find_if(scenario.robots.begin(), scenario.robots.end(),
                                  [&](const RobotSpec& robot) { return robot.name == antenna.on; });
  return found == scenario.robots.end() ? nullptr : &*found;
}

double updates_of(const Scenario& scenario, const AntennaSpec& antenna) {
  const RobotSpec* const robot = carrier_of(scenario, antenna);
  if (robot == nullptr) return 0.0;
  const double seconds =
      scenario.duration_s.value_or(planned_length(*robot) / robot->style.speed_m_s);
  return seconds * antenna.parameters.rate_hz;
}

struct Trial {
  double once = 0.0;    ///< For the images of tags that keep them [s].
  double update = 0.0;  ///< For each update [s].
  std::size_t images = 0;
};

/// One update of an antenna at `p_W`.
Trial try_order(const Scenario& scenario, const Eigen::Vector3d& p_W, int order) {
  TraceOptions options;
  options.order = order;
  const RadioScene& scene = scenario.radio_world->scene;
  const bool of_tags = tags_keep_images(scenario);
  const std::size_t tried = std::min(of_tags ? kTagImagesTried : kTagsTried, scenario.tags.size());
  const double all = static_cast<double>(scenario.tags.size()) / static_cast<double>(tried);
  double for_images = 0.0;
  const auto images_at = [&](const Eigen::Vector3d& p) {
    const auto start = Clock::now();
    ImageSet images = images_of(scene, p, options);
    for_images += seconds_since(start);
    return images;
  };
  const auto start = Clock::now();
  ImageSet images = of_tags ? ImageSet{} : images_at(p_W);
  std::vector<RadioPath> paths;
  for (std::size_t i = 0; i < tried; ++i) {
    const TagSpec& tag = scenario.tags[i * scenario.tags.size() / tried];
    const Eigen::Vector3d& p_WT = tag.motion.front().X_WB.translation;
    if (of_tags) images = images_at(p_WT);
    trace_paths(scene, images, of_tags ? p_W : p_WT, options, paths);
  }
  const double for_paths = (seconds_since(start) - for_images) * all;
  return of_tags ? Trial{for_images * all, for_paths, images.images.size()}
                 : Trial{0.0, for_images + for_paths, images.images.size()};
}

/// The moving antenna with the highest order of reflection; null if none has any.
const AntennaSpec* farthest(const Scenario& scenario) {
  const AntennaSpec* most = nullptr;
  for (const AntennaSpec& antenna : scenario.antennas) {
    const bool counts = order_of(antenna) > 0 && updates_of(scenario, antenna) > 0.0;
    if (counts && (most == nullptr || order_of(antenna) > order_of(*most))) most = &antenna;
  }
  return most;
}

Eigen::Vector3d start_of(const Scenario& scenario, const AntennaSpec& antenna) {
  const RobotSpec& robot = *carrier_of(scenario, antenna);
  return from_planar(robot.start.x, robot.start.y, robot.start.yaw) * antenna.X_PA.translation;
}

std::string in_words(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  return seconds < 7200.0 ? fmt::format("{:.0f} min", seconds / 60.0)
                          : fmt::format("{:.0f} h", seconds / 3600.0);
}

}  // namespace

bool tags_keep_images(const Scenario& scenario) {
  return scenario.tags.size() <= kMaxTagsWithImages &&
         std::none_of(scenario.tags.begin(), scenario.tags.end(), moves);
}

std::optional<TracingForecast> tracing_forecast(const Scenario& scenario, int order) {
  if (scenario.radio_world == nullptr || scenario.tags.empty()) return std::nullopt;
  const AntennaSpec* const antenna = farthest(scenario);
  if (antenna == nullptr) return std::nullopt;
  double updates = 0.0;
  for (const AntennaSpec& other : scenario.antennas) {
    if (order_of(other) > 0) updates += updates_of(scenario, other);
  }
  const Eigen::Vector3d p_W = start_of(scenario, *antenna);
  const auto forecast_of = [&](const Trial& trial, int of_order, bool is_measured) {
    return TracingForecast{of_order, trial.once + trial.update * updates, is_measured};
  };
  Trial trial = try_order(scenario, p_W, 0);
  TracingForecast forecast = forecast_of(trial, 0, true);
  // Each image is mirrored at no more facets than the antenna itself.
  double max_growth = 1.0;
  for (int next = 1; next <= order; ++next) {
    if (forecast.is_measured && (trial.once + trial.update) * max_growth <= kLongTrial_s) {
      trial = try_order(scenario, p_W, next);
      if (next == 1) max_growth = std::max(1.0, static_cast<double>(trial.images));
      forecast = forecast_of(trial, next, true);
    } else {
      trial.once *= max_growth;
      trial.update *= max_growth;
      forecast = forecast_of(trial, next, false);
    }
  }
  return forecast;
}

void warn_of_long_tracing(const Scenario& scenario, Diagnostics& diagnostics) {
  const AntennaSpec* const antenna = farthest(scenario);
  if (antenna == nullptr) return;
  const int order = order_of(*antenna);
  const auto forecast = tracing_forecast(scenario, order);
  if (!forecast || forecast->seconds < kLongRun_s) return;
  std::string advice;
  for (int lower = order - 1; lower >= 0 && advice.empty(); --lower) {
    const auto fits = tracing_forecast(scenario, lower);
    if (fits->seconds >= kLongRun_s && lower > 0) continue;
    advice = fmt::format("; reflection_order {} takes about {}", lower, in_words(fits->seconds));
  }
  diagnostics.warn(
      fmt::format("tracing reflections of order {} among {} facets will take {} {} of one core{}",
                  order, scenario.radio_world->scene.facets().size(),
                  forecast->is_measured ? "about" : "up to", in_words(forecast->seconds), advice));
}

}  // namespace tagfield
