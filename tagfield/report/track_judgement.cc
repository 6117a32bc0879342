// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/track_judgement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tagfield/report/internal/checked_json.h"

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

std::map<std::string, Trajectory> true_positions(const Truth& truth) {
  std::map<std::string, Trajectory> places;
  for (const TagPosition& row : truth.tag_positions) {
    Trajectory& of_tag = places[row.tag];
    if (!of_tag.empty() && of_tag.back().stamp >= row.stamp) continue;
    of_tag.push_back({row.stamp, from_translation(row.p_WT)});
  }
  return places;
}

/// Velocity between the rows around a timestamp [m/s].
Eigen::Vector3d true_velocity(const Trajectory& places, Time stamp) {
  if (places.size() < 2) return Eigen::Vector3d::Zero();
  auto after =
      std::lower_bound(places.begin(), places.end(), stamp,
                       [](const StampedPose& pose, Time time) { return pose.stamp < time; });
  after = std::clamp(after, places.begin() + 1, places.end() - 1);
  const auto before = after - 1;
  return (after->X_WB.translation - before->X_WB.translation) /
         to_seconds(after->stamp - before->stamp);
}

void add_errors(const TrackPoint& point, const Trajectory& places, TrackOutcome& outcome) {
  const Eigen::Vector3d v = true_velocity(places, point.stamp);
  const Eigen::Vector2d error = (point.p_WT - held_position_at(places, point.stamp)).head<2>();
  const double speed = v.head<2>().norm();
  Eigen::Vector2d along(1.0, 0.0);
  if (speed > 0.0) along = v.head<2>() / speed;
  outcome.along_m.push_back(std::abs(along.dot(error)));
  outcome.across_m.push_back(std::abs(along.x() * error.y() - along.y() * error.x()));
  outcome.speed_m_s.push_back(std::abs(point.v_WT.head<2>().norm() - speed));
}

double nees_of(const TrackPoint& point, const Trajectory& places) {
  const Eigen::Vector2d error = (point.p_WT - held_position_at(places, point.stamp)).head<2>();
  const Eigen::Matrix2d covariance = point.covariance.topLeftCorner<2, 2>();
  return 0.5 * error.dot(covariance.inverse() * error);
}

Json rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json statistics_json(const std::optional<ErrorStatistics>& statistics) {
  if (!statistics) return nullptr;
  return {{"count", statistics->count},
          {"mean", rounded(statistics->mean)},
          {"median", rounded(statistics->median)},
          {"p95", rounded(statistics->p95)},
          {"max", rounded(statistics->max)}};
}

Json tag_json(const TrackOutcome& outcome) {
  Json json = {{"seed", outcome.seed},
               {"tag", outcome.tag},
               {"verdict", to_string(outcome.verdict)},
               {"reads", outcome.reads},
               {"expected_error_m", rounded(outcome.expected_error_m)}};
  json["along_m"] = statistics_json(statistics(outcome.along_m));
  json["across_m"] = statistics_json(statistics(outcome.across_m));
  json["reason"] = outcome.reason;
  return json;
}

Json order_json(const OrderOutcome& order) {
  Json json = {{"passed", order.name}, {"pairs", order.pairs}, {"right", order.right}};
  json["right_share"] =
      order.pairs > 0 ? rounded(static_cast<double>(order.right) / static_cast<double>(order.pairs))
                      : Json(nullptr);
  return json;
}

}  // namespace

std::vector<TrackOutcome> judge_tracks(std::uint64_t seed, const std::vector<TagTrack>& tracks,
                                       const Truth& truth) {
  const std::map<std::string, Trajectory> places = true_positions(truth);
  std::vector<TrackOutcome> outcomes;
  for (const TagTrack& tag : tracks) {
    TrackOutcome outcome;
    outcome.seed = seed;
    outcome.tag = tag.tag;
    outcome.verdict = tag.verdict;
    outcome.reason = tag.reason;
    outcome.reads = tag.reads;
    const auto of_tag = places.find(tag.tag);
    if (!tag.tracks.empty()) {
      const Track& best = tag.tracks.front();
      outcome.expected_error_m = best.expected_error_m;
      if (of_tag != places.end() && !best.points.empty()) {
        for (const TrackPoint& point : best.points) add_errors(point, of_tag->second, outcome);
        outcome.nees = nees_of(best.points[best.points.size() / 2], of_tag->second);
      }
    }
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

std::vector<TagTrack> true_tracks(const Truth& truth) {
  std::vector<TagTrack> tracks;
  for (const auto& [tag, places] : true_positions(truth)) {
    if (places.size() < 2) continue;
    Track track;
    for (const StampedPose& pose : places) {
      TrackPoint point;
      point.stamp = pose.stamp;
      point.p_WT = pose.X_WB.translation;
      point.v_WT = true_velocity(places, pose.stamp);
      track.points.push_back(point);
    }
    TagTrack one;
    one.tag = tag;
    one.verdict = TrackVerdict::kTracked;
    one.tracks.push_back(std::move(track));
    tracks.push_back(std::move(one));
  }
  return tracks;
}

std::vector<OrderOutcome> judge_orders(const std::vector<PassingOrder>& found,
                                       const std::vector<PassingOrder>& truth) {
  std::vector<OrderOutcome> outcomes;
  for (const PassingOrder& order : found) {
    const auto real = std::find_if(truth.begin(), truth.end(), [&](const PassingOrder& other) {
      return other.name == order.name;
    });
    if (real == truth.end()) continue;
    std::map<std::string, Time> stamps;
    for (const Passing& passing : order.passings) stamps[passing.tag] = passing.stamp;
    OrderOutcome outcome{order.name, 0, 0};
    std::optional<Time> last;
    for (const Passing& passing : real->passings) {
      const auto stamp = stamps.find(passing.tag);
      if (stamp == stamps.end()) continue;
      if (last) {
        ++outcome.pairs;
        if (*last < stamp->second) ++outcome.right;
      }
      last = stamp->second;
    }
    outcomes.push_back(outcome);
  }
  return outcomes;
}

void add_orders(const std::vector<OrderOutcome>& more, std::vector<OrderOutcome>& orders) {
  for (const OrderOutcome& outcome : more) {
    const auto known = std::find_if(orders.begin(), orders.end(), [&](const OrderOutcome& other) {
      return other.name == outcome.name;
    });
    if (known == orders.end()) {
      orders.push_back(outcome);
    } else {
      known->pairs += outcome.pairs;
      known->right += outcome.right;
    }
  }
}

std::optional<ErrorStatistics> track_statistics(const TrackSummary& summary,
                                                std::vector<double> TrackOutcome::*kind) {
  std::vector<double> all;
  for (const TrackOutcome& outcome : summary.tags) {
    if (outcome.verdict != TrackVerdict::kTracked) continue;
    const std::vector<double>& values = outcome.*kind;
    all.insert(all.end(), values.begin(), values.end());
  }
  return statistics(std::move(all));
}

std::size_t count(const TrackSummary& summary, TrackVerdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(summary.tags.begin(), summary.tags.end(),
                    [&](const TrackOutcome& outcome) { return outcome.verdict == verdict; }));
}

std::optional<double> mean_nees(const TrackSummary& summary) {
  double sum = 0.0;
  double number = 0.0;
  for (const TrackOutcome& outcome : summary.tags) {
    if (outcome.verdict != TrackVerdict::kTracked || !outcome.nees) continue;
    sum += *outcome.nees;
    number += 1.0;
  }
  if (number <= 0.0) return std::nullopt;
  return sum / number;
}

std::string to_json(const TrackSummary& summary) {
  Json json = {{"name", summary.name}, {"method", summary.method}, {"seeds", summary.seeds}};
  json["tracked"] = count(summary, TrackVerdict::kTracked);
  json["ambiguous"] = count(summary, TrackVerdict::kAmbiguous);
  json["not_tracked"] = count(summary, TrackVerdict::kNotTracked);
  json["along_m"] = statistics_json(track_statistics(summary, &TrackOutcome::along_m));
  json["across_m"] = statistics_json(track_statistics(summary, &TrackOutcome::across_m));
  json["speed_m_s"] = statistics_json(track_statistics(summary, &TrackOutcome::speed_m_s));
  const std::optional<double> nees = mean_nees(summary);
  json["nees"] = nees ? rounded(*nees) : Json(nullptr);
  json["orders"] = Json::array();
  for (const OrderOutcome& order : summary.orders) json["orders"].push_back(order_json(order));
  json["tags"] = Json::array();
  for (const TrackOutcome& outcome : summary.tags) json["tags"].push_back(tag_json(outcome));
  json["warnings"] = summary.warnings;
  return json.dump(2) + "\n";
}

TrackNumbers numbers_of(const TrackSummary& summary) {
  TrackNumbers numbers;
  numbers.tracked = count(summary, TrackVerdict::kTracked);
  numbers.ambiguous = count(summary, TrackVerdict::kAmbiguous);
  numbers.not_tracked = count(summary, TrackVerdict::kNotTracked);
  if (const auto along = track_statistics(summary, &TrackOutcome::along_m)) {
    numbers.along_m = along->mean;
  }
  if (const auto across = track_statistics(summary, &TrackOutcome::across_m)) {
    numbers.across_m = across->mean;
  }
  numbers.orders = summary.orders;
  return numbers;
}

TrackNumbers track_numbers_from_json(const std::string& text, const std::string& file) {
  const nlohmann::json json = parsed_json(text, file);
  const JsonLocation top{&json, file, ""};
  const auto mean_of = [&](const char* key) -> std::optional<double> {
    const JsonLocation place = member(top, key);
    if (is_null(place)) return std::nullopt;
    return number_at(member(place, "mean"));
  };
  TrackNumbers numbers;
  numbers.tracked = whole_at(member(top, "tracked"));
  numbers.ambiguous = whole_at(member(top, "ambiguous"));
  numbers.not_tracked = whole_at(member(top, "not_tracked"));
  numbers.along_m = mean_of("along_m");
  numbers.across_m = mean_of("across_m");
  for (const JsonLocation& order : elements(member(top, "orders"))) {
    numbers.orders.push_back({text_at(member(order, "passed")), whole_at(member(order, "pairs")),
                              whole_at(member(order, "right"))});
  }
  return numbers;
}

}  // namespace tagfield
