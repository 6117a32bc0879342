// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/live_json.h"

#include <map>
#include <nlohmann/json.hpp>

#include "tagfield/scenario/tag_kinds.h"

namespace tagfield::http {

Json antennas_json(const LiveWorld& world) {
  Json all = Json::array();
  const auto kinds = kinds_of_tags(world.scenario());
  for (const LiveAntenna& antenna : world.antennas()) {
    Json json = antenna_json(antenna.spec, world.antenna_pose(antenna),
                             static_cast<std::size_t>(antenna.port), kinds);
    json["on"] = antenna.is_on;
    json["faulty"] = antenna.is_faulty;
    all.push_back(std::move(json));
  }
  return {{"antennas", std::move(all)}};
}

Json tags_json(const LiveWorld& world) {
  std::map<std::string, bool> moving;
  for (const TagSpec& tag : world.scenario().tags) moving[tag.id] = moves(tag);
  Json all = Json::array();
  for (const LivePose& tag : world.tags()) {
    const Eigen::Quaterniond& q = tag.X_W.rotation;
    all.push_back({{"id", tag.name},
                   {"position", point_json(tag.X_W.translation)},
                   {"rotation", {q.x(), q.y(), q.z(), q.w()}},
                   {"moves", moving[tag.name]}});
  }
  return {{"tags", std::move(all)}};
}

Json estimate_rows(const std::vector<LiveEstimate>& estimates) {
  Json all = Json::array();
  for (const LiveEstimate& one : estimates) {
    const TagEstimate& estimate = one.estimate;
    Json row = {estimate.tag};
    if (estimate.verdict == Verdict::kLocated) {
      const Candidate& place = estimate.candidates.front();
      for (const double number : {place.p_WT.x(), place.p_WT.y(), place.p_WT.z()}) {
        row.push_back(number);
      }
      row.push_back(covariance_json(place));
    } else {
      row.push_back(nullptr);
    }
    all.push_back(std::move(row));
  }
  return all;
}

Json estimates_json(const LiveEstimates& estimates) {
  Json all = Json::array();
  for (const LiveEstimate& one : estimates.since(0)) {
    const TagEstimate& estimate = one.estimate;
    Json candidates = Json::array();
    for (const Candidate& place : estimate.candidates) {
      candidates.push_back({{"position", point_json(place.p_WT)},
                            {"covariance", covariance_json(place)},
                            {"expectedError", place.expected_error_m},
                            {"rms", place.rms_m}});
    }
    all.push_back({{"id", estimate.tag},
                   {"verdict", to_string(estimate.verdict)},
                   {"reason", estimate.reason},
                   {"method", one.method},
                   {"time", to_seconds(one.last_read)},
                   {"reads", estimate.reads},
                   {"candidates", std::move(candidates)}});
  }
  return {{"estimates", std::move(all)}, {"warnings", estimates.warnings()}};
}

}  // namespace tagfield::http
