// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/run_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "adapters/http/embedded.h"
#include "adapters/http/world_json.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/files/files.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/map/map_file.h"
#include "tagfield/scenario/tag_kinds.h"

namespace tagfield::http {
namespace {

constexpr std::size_t kMaxReads = 200'000;
constexpr std::size_t kMaxPoses = 100'000;  ///< Per antenna or robot.

/// Short numbers: a tenth of a millimetre, a millisecond, a hundredth of a decibel are enough for
/// display.
double to_decimals(double value, double unit) { return std::round(value * unit) / unit; }
Json short_point(const Eigen::Vector3d& p) {
  return {to_decimals(p.x(), 1e4), to_decimals(p.y(), 1e4), to_decimals(p.z(), 1e4)};
}
Json short_pose(const RigidTransform& X) {
  Json pose = short_point(X.translation);
  const Eigen::Quaterniond& q = X.rotation;
  for (const double part : {q.x(), q.y(), q.z(), q.w()}) pose.push_back(to_decimals(part, 1e5));
  return pose;
}
double short_time(Time stamp) { return to_decimals(to_seconds(stamp), 1e4); }

Json track_json(const Trajectory& poses) {
  Json times = Json::array();
  Json all = Json::array();
  const std::size_t every = 1 + poses.size() / kMaxPoses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i % every != 0 && i + 1 != poses.size()) continue;
    times.push_back(short_time(poses[i].stamp));
    all.push_back(short_pose(poses[i].X_WB));
  }
  return {{"t", std::move(times)}, {"pose", std::move(all)}};
}

Json places_json(const std::vector<TagPosition>& places) {
  Json times = Json::array();
  Json all = Json::array();
  for (const TagPosition& place : places) {
    times.push_back(short_time(place.stamp));
    all.push_back(short_point(place.p_WT));
  }
  return {{"t", std::move(times)}, {"p", std::move(all)}};
}

/// Indices of names in the order in which they are first requested.
class Numbers {
 public:
  std::size_t of(const std::string& name) {
    return numbers_.emplace(name, numbers_.size()).first->second;
  }

 private:
  std::map<std::string, std::size_t> numbers_;
};

/// Antennas missing in scene.json, as in the run's tables.
Json plain_antenna(const AntennaTrack& track) {
  const TagRead* const read = track.reads.empty() ? nullptr : track.reads.front();
  return {{"name", track.antenna},
          {"reader", read == nullptr ? "" : read->reader},
          {"port", 1},
          {"on", true},
          {"faulty", false},
          {"robot", track.moving ? "robot" : ""},
          {"model", "physical"},
          {"range", 0.0},
          {"frequency", read == nullptr ? 0.0 : read->frequency_hz},
          {"power_dbm", nullptr},
          {"beam", nullptr}};
}

Json antennas_of(const RunFiles& run, const Json& scene) {
  Json all = Json::array();
  const Json known = scene.value("antennas", Json::array());
  for (const AntennaTrack& track : run.tracks) {
    Json antenna = plain_antenna(track);
    for (const Json& other : known) {
      if (other.is_object() && other.value("name", "") == track.antenna) antenna.update(other);
    }
    antenna["pose"] = short_pose(track.best().front().X_WB);
    all.push_back(std::move(antenna));
  }
  return all;
}

/// Each tag's initial position: the true one if known, else the estimate.
Json tags_of(const RunFiles& run, Numbers& numbers) {
  Json all = Json::array();
  for (const TagOutcome* outcome : first_outcomes(run.summary)) {
    const std::string& id = outcome->estimate.tag;
    const auto places = run.true_positions.find(id);
    const bool has_place = places != run.true_positions.end() && !places->second.empty();
    const auto place =
        has_place ? std::optional(places->second.front().p_WT) : known_place(*outcome);
    if (!place) continue;
    numbers.of(id);
    all.push_back({{"id", id},
                   {"position", short_point(*place)},
                   {"rotation", {0.0, 0.0, 0.0, 1.0}},
                   {"moves", has_place && places->second.size() > 1}});
  }
  return all;
}

Json reads_of(const RunFiles& run, Numbers& tags, std::size_t known_tags, Numbers& antennas) {
  Json json;
  for (const char* key : {"t", "tag", "antenna", "rssi", "phase"}) json[key] = Json::array();
  const std::size_t every = 1 + run.reads.size() / kMaxReads;
  for (std::size_t i = 0; i < run.reads.size(); i += every) {
    const TagRead& read = run.reads[i];
    const std::size_t tag = tags.of(read.tag);
    if (tag >= known_tags) continue;  // its position is unknown
    json["t"].push_back(short_time(read.stamp));
    json["tag"].push_back(tag);
    json["antenna"].push_back(antennas.of(read.antenna));
    json["rssi"].push_back(to_decimals(read.rssi_dbm, 100.0));
    json["phase"].push_back(to_decimals(read.phase_rad, 1e3));
  }
  return json;
}

Json estimates_of(const RunFiles& run) {
  Json all = Json::array();
  for (const TagOutcome* outcome : first_outcomes(run.summary)) {
    const TagEstimate& estimate = outcome->estimate;
    if (estimate.verdict != Verdict::kLocated || estimate.candidates.empty()) continue;
    const Candidate& place = estimate.candidates.front();
    Json row = {estimate.tag};
    for (const Json& number : short_point(place.p_WT)) row.push_back(number);
    row.push_back(covariance_json(place));
    all.push_back(std::move(row));
  }
  return all;
}

Json known_scene(const std::string& text) {
  if (text.empty()) return Json::object();
  Json known = Json::parse(text, nullptr, false);
  if (!known.is_object()) throw Error("the scene is not a JSON object");
  return known;
}

/// By name.
Json robots_json(const std::vector<AntennaPose>& poses) {
  std::map<std::string, Trajectory> tracks;
  for (const AntennaPose& pose : poses) tracks[pose.antenna].push_back({pose.stamp, pose.X_WA});
  Json robots = Json::object();
  for (const auto& [name, track] : tracks) robots[name] = track_json(track);
  return robots;
}

/// Run-length encoding of the rows from the origin's corner on: number of cells and their state,
/// which is 0 free, 1 occupied, 2 unknown.
Json map_json(const OccupancyGrid& grid) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < grid.cells.size();) {
    const auto kind_of = [](std::int8_t cell) {
      return is_free(cell) ? 0 : is_occupied(cell) ? 1 : 2;
    };
    const int kind = kind_of(grid.cells[i]);
    const std::size_t begin = i;
    while (i < grid.cells.size() && kind_of(grid.cells[i]) == kind) ++i;
    runs.push_back(i - begin);
    runs.push_back(kind);
  }
  return {{"resolution", grid.resolution_m},
          {"origin", {grid.origin.x(), grid.origin.y()}},
          {"width", grid.width},
          {"height", grid.height},
          {"runs", std::move(runs)}};
}

/// The part of `text` between the first `begin` and the next `end`; "" if they are missing.
std::string_view between(std::string_view text, std::string_view begin, std::string_view end) {
  const std::size_t from = text.find(begin);
  if (from == std::string_view::npos) return {};
  const std::size_t first = from + begin.size();
  const std::size_t last = text.find(end, first);
  return last == std::string_view::npos ? std::string_view{} : text.substr(first, last - first);
}

std::optional<RunView> run_view(const RunFiles& run, const std::string& folder) {
  const std::string_view page = page_file();
  const std::string_view hash = between(page, "script-src '", "'");
  const std::string_view script = between(page, "<script>", "</script>");
  if (hash.empty() || script.empty()) return std::nullopt;
  std::string html = "<div id=\"tagfield-view\"></div>\n";
  html += "<script type=\"application/json\" id=\"tagfield-run\">";
  // Text in the run must not close the element.
  for (const char c : run_json(run, read_surroundings(folder))) {
    if (c == '<') {
      html += "\\u003c";
    } else {
      html += c;
    }
  }
  html.append("</script>\n<script>").append(script).append("</script>\n");
  return RunView{std::move(html), std::string(hash)};
}

}  // namespace

std::string scene_json(const ScenarioWithWorld& loaded) {
  Json scene = solids_json(loaded.scene, loaded.scenario);
  scene["obstacles"] = obstacles_json(loaded.scenario, Time{});
  scene["paths"] = paths_json(loaded.scenario);
  Json antennas = Json::array();
  std::map<std::string, std::size_t> ports;
  const auto kinds = kinds_of_tags(loaded.scenario);
  for (const AntennaSpec& antenna : loaded.scenario.antennas) {
    const std::size_t port = ++ports[antenna.parameters.reader];
    antennas.push_back(antenna_json(antenna, antenna.X_PA, port, kinds));
  }
  return json_text({{"scene", std::move(scene)}, {"antennas", std::move(antennas)}}) + "\n";
}

Surroundings read_surroundings(const std::string& folder) {
  Surroundings around;
  const std::string scene = folder + "/scene.json";
  if (is_there(scene)) {
    around.scene = read_text_file(scene);
    if (!Json::parse(around.scene, nullptr, false).is_object()) {
      throw Error(fmt::format("{}: is not a JSON object", scene));
    }
  }
  const std::string map = folder + "/map.yaml";
  Diagnostics unheard;
  if (is_there(map)) around.map = read_map(map, unheard);
  const std::string robots = folder + "/truth/robot_poses.csv";
  if (is_there(robots)) around.robot_poses = read_poses_csv(robots, "robot");
  return around;
}

std::string run_json(const RunFiles& run, const Surroundings& around) {
  const Json known = known_scene(around.scene);
  Json json;
  json["scene"] = known.contains("scene")
                      ? known["scene"]
                      : Json{{"name", run.summary.scenario}, {"description", ""},
                             {"solids", Json::array()},      {"meshes", Json::array()},
                             {"obstacles", Json::array()},   {"map", nullptr},
                             {"paths", Json::array()}};
  if (around.map) json["scene"]["map"] = map_json(*around.map);
  json["antennas"] = antennas_of(run, known);
  Numbers tags;
  json["tags"] = tags_of(run, tags);
  Numbers antennas;
  json["antenna_poses"] = Json::object();
  Time first = Time::max();
  Time last = Time::min();
  for (const AntennaTrack& track : run.tracks) {
    antennas.of(track.antenna);
    if (track.best().size() > 1) json["antenna_poses"][track.antenna] = track_json(track.best());
    first = std::min(first, track.best().front().stamp);
    last = std::max(last, track.best().back().stamp);
  }
  for (const TagRead& read : run.reads) {
    first = std::min(first, read.stamp);
    last = std::max(last, read.stamp);
  }
  json["duration"] = first <= last ? Json{short_time(first), short_time(last)} : Json{0.0, 0.0};
  json["robot_poses"] = robots_json(around.robot_poses);
  json["tag_positions"] = Json::object();
  for (const auto& [tag, places] : run.true_positions) {
    if (places.size() > 1) json["tag_positions"][tag] = places_json(places);
  }
  json["reads"] = reads_of(run, tags, json["tags"].size(), antennas);
  json["estimates"] = estimates_of(run);
  return json_text(json);
}

MakeView view_of(const std::string& folder) {
  return [folder](const RunFiles& run) { return run_view(run, folder); };
}

}  // namespace tagfield::http
