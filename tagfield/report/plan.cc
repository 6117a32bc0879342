// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

using PlanJson = nlohmann::ordered_json;

PlanJson plan_json(const ExpectedCount& count) {
  return {{"mean", count.mean}, {"low", count.low}, {"high", count.high}};
}

PlanJson plan_json(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

PlanJson plan_json(const PlannedAntenna& antenna) {
  return {{"name", antenna.name},
          {"mount", antenna.mount},
          {"reader", antenna.reader},
          {"zone", antenna.zone},
          {"position_m", plan_json(antenna.p_W)},
          {"boresight", plan_json(antenna.boresight_W)},
          {"power_dbm", antenna.power_dbm},
          {"cost", antenna.cost}};
}

PlanJson plan_json(const PlannedLayout& layout) {
  PlanJson json = {{"antennas", PlanJson::array()},
                   {"readers", layout.readers},
                   {"cost", layout.cost},
                   {"score", layout.score},
                   {"share", layout.share},
                   {"bound", layout.bound},
                   {"gap", std::max(0.0, layout.bound - layout.score)},
                   {"exact", layout.is_exact},
                   {"read", plan_json(layout.read)}};
  if (layout.zones.size() > 1) json["cross"] = plan_json(layout.cross);
  for (const PlannedAntenna& antenna : layout.antennas) {
    json["antennas"].push_back(plan_json(antenna));
  }
  json["zones"] = PlanJson::array();
  for (const PlannedZone& zone : layout.zones) {
    json["zones"].push_back({{"zone", zone.zone},
                             {"tags", zone.tags},
                             {"read", plan_json(zone.read)},
                             {"cross", plan_json(zone.cross)}});
  }
  return json;
}

PlanJson hard_json(const AntennaPlan& plan) {
  PlanJson all = PlanJson::array();
  for (const HardPlace& hard : plan.hard) {
    const PlannedPlace& place = plan.places[hard.place];
    all.push_back({{"group", place.group},
                   {"position_m", plan_json(place.p_W)},
                   {"probability", hard.probability},
                   {"best_antenna", hard.best_antenna},
                   {"distance_m", hard.distance_m},
                   {"median_margin_db", hard.median_db},
                   {"why", hard.why}});
  }
  return all;
}

double worst_cross(const PlannedLayout& layout) {
  double worst = 0.0;
  for (const PlannedZone& zone : layout.zones) {
    if (zone.tags > 0) worst = std::max(worst, zone.cross.mean / static_cast<double>(zone.tags));
  }
  return worst;
}

}  // namespace

std::string words_for(const PlannedAim& aim) {
  switch (aim.kind) {
    case PlannedAim::Kind::kReadProbability:
      return "read";
    case PlannedAim::Kind::kReads:
      return fmt::format("read at least {:g} times", aim.value);
    case PlannedAim::Kind::kPosition:
      return fmt::format("locatable to within {:g} m", aim.value);
  }
  return "";
}

std::string plan_layouts_to_csv(const AntennaPlan& plan) {
  std::string text =
      "antennas,readers,cost,score,share,bound,read_mean,read_low,read_high,cross_worst\n";
  for (const PlannedLayout& layout : plan.layouts) {
    text += fmt::format("{},{},{:g},{:.6f},{:.6f},{:.6f},{:.2f},{:.2f},{:.2f},{:.5f}\n",
                        layout.antennas.size(), layout.readers, layout.cost, layout.score,
                        layout.share, layout.bound, layout.read.mean, layout.read.low,
                        layout.read.high, worst_cross(layout));
  }
  return text;
}

std::string plan_antennas_to_csv(const AntennaPlan& plan) {
  std::string text =
      "antennas,antenna,mount,reader,zone,x_m,y_m,z_m,boresight_x,boresight_y,boresight_z,"
      "power_dbm,cost\n";
  for (const PlannedLayout& layout : plan.layouts) {
    for (const PlannedAntenna& antenna : layout.antennas) {
      const Eigen::Vector3d& p = antenna.p_W;
      const Eigen::Vector3d& b = antenna.boresight_W;
      text += fmt::format("{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:g},{:g}\n",
                          layout.antennas.size(), csv_field(antenna.name), csv_field(antenna.mount),
                          csv_field(antenna.reader), csv_field(antenna.zone), p.x() + 0.0,
                          p.y() + 0.0, p.z() + 0.0, b.x() + 0.0, b.y() + 0.0, b.z() + 0.0,
                          antenna.power_dbm, antenna.cost);
    }
  }
  return text;
}

std::string plan_positions_to_csv(const AntennaPlan& plan) {
  std::string text = "group,zone,x_m,y_m,z_m";
  for (const PlannedLayout& layout : plan.layouts) {
    text += fmt::format(",p_{}", layout.antennas.size());
  }
  for (const PlannedLayout& layout : plan.layouts) {
    if (!layout.errors_m.empty()) text += fmt::format(",error_m_{}", layout.antennas.size());
  }
  text += '\n';
  for (std::size_t i = 0; i < plan.places.size(); ++i) {
    const PlannedPlace& place = plan.places[i];
    text += fmt::format("{},{},{:.4f},{:.4f},{:.4f}", csv_field(place.group), csv_field(place.zone),
                        place.p_W.x() + 0.0, place.p_W.y() + 0.0, place.p_W.z() + 0.0);
    for (const PlannedLayout& layout : plan.layouts) {
      text += fmt::format(",{:.4f}", layout.places[i]);
    }
    for (const PlannedLayout& layout : plan.layouts) {
      if (layout.errors_m.empty()) continue;
      text += std::isfinite(layout.errors_m[i]) ? fmt::format(",{:.4f}", layout.errors_m[i]) : ",";
    }
    text += '\n';
  }
  return text;
}

std::string plan_to_json(const AntennaPlan& plan) {
  PlanJson json = {
      {"scenario", plan.scenario},       {"dwell_s", plan.dwell_s}, {"tags", plan.tags},
      {"positions", plan.places.size()}, {"options", plan.options}, {"limits", plan.limits},
      {"stopped_by", plan.stopped_by}};
  using Kind = PlannedAim::Kind;
  const auto aim = [&](Kind kind) {
    return plan.aim.kind == kind ? PlanJson(plan.aim.value) : PlanJson(nullptr);
  };
  json["aim_read_probability"] = aim(Kind::kReadProbability);
  json["aim_dwell_reads"] = aim(Kind::kReads);
  json["aim_position_error_m"] = aim(Kind::kPosition);
  json["counts"] = words_for(plan.aim);
  json["aim_share"] = plan.aim.share ? PlanJson(*plan.aim.share) : PlanJson(nullptr);
  json["aim_minimize"] = plan.aim.is_for_least_cost ? "cost" : "antennas";
  json["reaches_aim"] = plan.reaches_aim;
  json["cross_limit"] = plan.cross_limit ? PlanJson(*plan.cross_limit) : PlanJson(nullptr);
  json["guaranteed_share_of_best"] =
      plan.guaranteed ? PlanJson(*plan.guaranteed) : PlanJson(nullptr);
  json["confidence"] = 0.95;
  json["chosen_antennas"] = plan.layouts.empty() ? 0 : plan.layouts[plan.chosen].antennas.size();
  json["layouts"] = PlanJson::array();
  for (const PlannedLayout& layout : plan.layouts) json["layouts"].push_back(plan_json(layout));
  json["hard"] = hard_json(plan);
  json["sensitivity"] = PlanJson::array();
  for (const PlanVariant& variant : plan.sensitivity) {
    json["sensitivity"].push_back({{"what", variant.what}, {"read", plan_json(variant.read)}});
  }
  json["check"] = nullptr;
  if (plan.check) {
    json["check"] = {
        {"seeds", plan.check->seeds}, {"read", plan.check->read}, {"inside", plan.check->inside}};
    if (!plan.check->cross.empty()) {
      json["check"]["cross"] = plan.check->cross;
      json["check"]["cross_inside"] = plan.check->cross_inside;
    }
  }
  json["warnings"] = plan.warnings;
  return json.dump(2, ' ', false, PlanJson::error_handler_t::replace) + "\n";
}

}  // namespace tagfield
