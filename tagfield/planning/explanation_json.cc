// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/explanation_json.h"

#include <nlohmann/json.hpp>
#include <vector>

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

/// Null for the power of a signal that never arrives.
Json power(double db) { return db < -250.0 ? Json(nullptr) : Json(db); }

Json to_json(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json to_json(const RigidTransform& X) {
  const Eigen::Quaterniond& q = X.rotation;
  return {{"position_m", to_json(X.translation)}, {"quaternion", {q.x(), q.y(), q.z(), q.w()}}};
}

Json to_json(const std::vector<BudgetLine>& lines) {
  Json all = Json::array();
  for (const BudgetLine& line : lines) all.push_back({{"what", line.what}, {"db", power(line.db)}});
  return all;
}

Json to_json(const std::vector<SurfaceOnPath>& surfaces) {
  Json all = Json::array();
  for (const SurfaceOnPath& at : surfaces) {
    all.push_back({{"object", at.object},
                   {"solid", at.solid},
                   {"material", at.material},
                   {"opaque", at.opaque},
                   {"position_m", to_json(at.p_W)},
                   {"thickness_m", at.thickness_m},
                   {"gain_db", power(at.gain_db)}});
  }
  return all;
}

Json to_json(const PathExplanation& path) {
  return {{"bounces", path.order},
          {"length_m", path.length_m},
          {"excess_m", path.excess_m},
          {"blocked", path.blocked},
          {"relative_db", path.relative_db ? Json(*path.relative_db) : Json(nullptr)},
          {"relative_phase_rad", path.relative_phase_rad},
          {"by_way_of", to_json(path.bounces)},
          {"around", path.edge ? to_json(std::vector{*path.edge}).front() : Json(nullptr)},
          {"through", to_json(path.crossings)},
          {"past_bodies_db", path.bodies_db ? Json(*path.bodies_db) : Json(nullptr)}};
}

Json to_json(const std::vector<MaterialOnLink>& materials) {
  Json all = Json::array();
  for (const MaterialOnLink& material : materials) {
    all.push_back({{"name", material.name},
                   {"permittivity", material.permittivity},
                   {"conductivity_s_m", material.conductivity_s_m},
                   {"extrapolated", !material.is_measured_here}});
  }
  return all;
}

Json to_json(const PaperLink& link) {
  Json json = {{"range_m", link.range_m},
               {"perturbed_range_m", link.perturbed_range_m},
               {"update_s", to_seconds(link.update)},
               {"read_probability", link.read_probability},
               {"phase_rad", link.phase_rad},
               {"rssi_dbm", link.rssi_dbm}};
  if (link.sensitivity_dbm) json["sensitivity_dbm"] = *link.sensitivity_dbm;
  return json;
}

Json to_json(const LinkInterference& all) {
  Json by = Json::array();
  for (const InterferingReader& one : all.by) {
    by.push_back({{"reader", one.reader},
                  {"antenna", one.antenna},
                  {"offset_hz", one.offset_hz},
                  {"time_share", one.time_share},
                  {"received_dbm", power(one.received_dbm)},
                  {"in_replies_dbm", power(one.in_replies_dbm)},
                  {"at_tag_dbm", power(one.at_tag_dbm)}});
  }
  return {{"by", by},
          {"noise_dbm", all.noise_dbm},
          {"noise_and_interference_dbm", all.total_dbm},
          {"sinr_db", power(all.sinr_db)},
          {"required_sinr_db", all.required_sinr_db},
          {"capture_db", all.by.empty() ? Json(nullptr) : power(all.capture_db)},
          {"required_capture_db", all.required_capture_db}};
}

Json to_json(const std::vector<NearTag>& tags) {
  Json all = Json::array();
  for (const NearTag& near : tags) {
    all.push_back({{"tag", near.id}, {"distance_m", near.distance_m}, {"alone_db", near.alone_db}});
  }
  return all;
}

Json to_json(const PhysicalLink& link) {
  Json json = {{"tag_dbm", power(link.tag_dbm)},
               {"tag_sensitivity_dbm", link.tag_sensitivity_dbm},
               {"tag_margin_db", power(link.tag_margin_db())},
               {"reply_dbm", power(link.reply_dbm)},
               {"reader_sensitivity_dbm", link.reader_sensitivity_dbm},
               {"reader_margin_db", power(link.reader_margin_db())},
               {"snr_db", power(link.snr_db)},
               {"phase_rad", link.phase_rad},
               {"phase_sigma_rad", link.phase_sigma_rad},
               {"channel", link.channel},
               {"frequency_hz", link.frequency_hz}};
  if (link.takes_inventory) {
    json["turn_s"] = link.turn ? Json(to_seconds(*link.turn)) : Json(nullptr);
    json["decode_probability"] = link.decode_probability.value_or(0.0);
  }
  json["to_tag"] = to_json(link.to_tag);
  json["to_reader"] = to_json(link.to_reader);
  json["near_tags"] = to_json(link.near_tags);
  json["interference"] = link.interference ? to_json(*link.interference) : Json(nullptr);
  json["materials"] = to_json(link.materials);
  json["paths"] = Json::array();
  for (const PathExplanation& path : link.paths) json["paths"].push_back(to_json(path));
  return json;
}

}  // namespace

Json to_json(const LinkExplanation& link) {
  Json json = {{"verdict", link.verdict},
               {"read", link.read},
               {"antenna", link.antenna},
               {"antennas_compared", link.antennas_compared},
               {"reader", link.reader},
               {"tag", link.tag},
               {"time_s", to_seconds(link.time)},
               {"distance_m", link.distance_m},
               {"antenna_pose", to_json(link.X_WA)},
               {"tag_pose", to_json(link.X_WT)},
               {"model", link.paper ? "paper" : "physical"}};
  json.update(link.paper ? to_json(*link.paper) : to_json(*link.physical));
  return json;
}

}  // namespace tagfield
