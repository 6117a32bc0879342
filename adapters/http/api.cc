// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/api.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "adapters/http/json_arguments.h"
#include "adapters/http/live_json.h"
#include "adapters/http/target.h"
#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/planning/coverage.h"
#include "tagfield/planning/explanation_json.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/tag_kinds.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield::http {
namespace {

/// Halls extend to 100 km at most, as in scenarios.
constexpr double kMaxPlace_m = 1e5;
constexpr double kMaxStep_s = 1e6;
constexpr const char* kDefaultMaterial = "metal";  ///< Of obstacles.
constexpr std::size_t kMaxCoverageCells = 40'000;
constexpr double kMinCell_m = 0.25;  ///< Default minimum.
/// Limits on what clients can add to the scenario.
constexpr std::size_t kMaxTags = 200'000;
constexpr std::size_t kMaxAntennas = 1'000;
constexpr std::size_t kMaxObstacles = 10'000;

RigidTransform pose_of(const std::vector<double>& n) {
  RigidTransform X = from_translation({n[0], n[1], n[2]});
  X.rotation = Eigen::AngleAxisd(n[5], Eigen::Vector3d::UnitZ()) *
               Eigen::AngleAxisd(n[4], Eigen::Vector3d::UnitY()) *
               Eigen::AngleAxisd(n[3], Eigen::Vector3d::UnitX());
  return X;
}

RigidTransform place_of(JsonArguments& body) {
  const std::vector<double> p = body.numbers("position", 3, kMaxPlace_m);
  return from_translation({p[0], p[1], p[2]});
}

template <class Items>
void require_room(const Items& items, std::size_t most, const char* what) {
  if (items.size() >= most) throw Error(fmt::format("there are {} {} already", most, what));
}

const TagSpec& tag_in(const LiveWorld& world, const std::string& id) {
  for (const TagSpec& tag : world.scenario().tags) {
    if (tag.id == id) return tag;
  }
  throw Error(fmt::format("there is no tag with the ID '{}'", id));
}

const LiveAntenna& antenna_in(const LiveWorld& world, const std::string& name) {
  for (const LiveAntenna& antenna : world.antennas()) {
    if (antenna.spec.parameters.name == name) return antenna;
  }
  throw Error(fmt::format("there is no antenna called '{}'", name));
}

/// A tag of the same kind as another one of the world, or as its first.
TagSpec tag_of(JsonArguments& body, const LiveWorld& world) {
  TagSpec tag;
  tag.id = body.text("id");
  tag.motion = {{world.now(), place_of(body)}};
  tag.appears = world.now();
  const std::vector<TagSpec>& others = world.scenario().tags;
  if (body.has("like")) {
    const TagSpec& other = tag_in(world, body.text("like"));
    tag.model = other.model;
    tag.motion.front().X_WB.rotation = other.motion.front().X_WB.rotation;
  } else if (!others.empty()) {
    tag.model = others.front().model;
  }
  return tag;
}

/// Throws Error if no antenna's waves would be affected, as nothing would change.
void require_notice(const LiveWorld& world) {
  const auto& antennas = world.antennas();
  const bool any = std::any_of(antennas.begin(), antennas.end(), [](const LiveAntenna& antenna) {
    const RadioModel* const model = physical(antenna.spec.parameters);
    return model != nullptr && model->effects.bodies;
  });
  if (!any) {
    throw Error("no antenna here is affected: antennas of the paper's model read through anything");
  }
}

ObstacleSpec obstacle_of(JsonArguments& body, const LiveWorld& world) {
  ObstacleSpec obstacle;
  obstacle.name = body.text("name");
  const std::vector<double> p = body.numbers("position", 2, kMaxPlace_m);
  obstacle.motion = {{Time{}, from_translation({p[0], p[1], 0.0})}};
  if (body.has("radius") == body.has("size")) {
    throw Error("either 'radius' (round) or 'size' ([length, width]) is needed");
  }
  if (body.has("radius")) {
    obstacle.radius_m = body.number("radius", 1e-3, 1e3);
  } else {
    const std::vector<double> size = body.numbers("size", 2, 1e3);
    if (!(size[0] >= 1e-3 && size[1] >= 1e-3)) throw Error("both of 'size' must be 1 mm or more");
    obstacle.size_m = {size[0], size[1]};
  }
  obstacle.yaw_rad = radians(body.number("yaw_deg", -360.0, 360.0, 0.0));
  BodySpec solid;
  solid.height_m = body.number("height", 1e-3, 1e3, solid.height_m);
  const std::string material = body.has("material") ? body.text("material") : kDefaultMaterial;
  solid.material = find_material(world.scenario().materials.materials, material);
  obstacle.body = solid;
  return obstacle;
}

/// A request for a floor's coverage.
struct CoverageQuestion {
  Scenario scenario;
  std::vector<DriveSample> samples;
  CoverageRequest request;
  double height_m = 0.0;
};

double reach_of(double range_m) { return std::min(range_m, 100.0); }

/// The smallest cell size within the limit on their number, with a small margin, in whole
/// centimetres.
double fitting_cell(double range_m) {
  const double most_in_a_row = std::sqrt(static_cast<double>(kMaxCoverageCells)) - 2.0;
  return std::ceil(100.0 * 2.0 * reach_of(range_m) / most_in_a_row) / 100.0;
}

/// A grid around the antenna, as far as it may read.
CoverageGrid grid_around(const Eigen::Vector3d& p_WA, double range_m, double cell_m) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(reach_of(range_m));
  const Eigen::AlignedBox2d region(p_WA.head<2>() - reach, p_WA.head<2>() + reach);
  return grid_over(region, cell_m, kMaxCoverageCells);
}

double number_in(const Target& target, const std::string& key, double least, double most,
                 double otherwise) {
  const auto text = target.query(key);
  if (!text) return otherwise;
  char* end = nullptr;
  const double number = std::strtod(text->c_str(), &end);
  if (text->empty() || *end != '\0' || !(number >= least && number <= most)) {
    throw Error(fmt::format("'{}' must be from {:g} to {:g}", key, least, most));
  }
  return number;
}

std::string word_in(const Target& target, const std::string& key) {
  const auto text = target.query(key);
  if (!text) throw Error(fmt::format("'?{}=…' is missing", key));
  return *text;
}

CoverageQuestion coverage_question(const LiveWorld& world, const Target& target,
                                   std::uint64_t seed) {
  const LiveAntenna& antenna = antenna_in(world, word_in(target, "antenna"));
  CoverageQuestion question;
  const Scenario& scenario = world.scenario();
  question.scenario.materials = scenario.materials;
  question.scenario.radio_world = radio_world_of(scenario);
  question.scenario.antennas = {antenna.spec};
  const RigidTransform X_WA = world.antenna_pose(antenna);
  question.samples = {{world.now(), {X_WA}, {}}};
  question.height_m = number_in(target, "height", -1e3, 1e3, 1.0);
  CoverageRequest& request = question.request;
  request.antennas = {0};
  request.tag = scenario.tags.empty() || !scenario.tags.front().model ? default_tag_model()
                                                                      : scenario.tags.front().model;
  request.heights_m = {question.height_m};
  const double range_m = largest_range_m(antenna.spec.parameters, kinds_of_tags(scenario));
  const double cell_m =
      number_in(target, "cell", 0.01, 10.0, std::max(kMinCell_m, fitting_cell(range_m)));
  request.grid = grid_around(X_WA.translation, range_m, cell_m);
  request.bodies = world.bodies();
  request.seed = seed;
  return question;
}

ApiResponse coverage_response(const CoverageQuestion& question) {
  const Coverage coverage = cover(question.scenario, question.samples, question.request);
  const CoverageGrid& grid = coverage.grid;
  Json margins = Json::array();
  Json probabilities = Json::array();
  for (const CoverageCell& cell : coverage.layers.front().cells) {
    const bool has_power = cell.margin_db > kMinPower_db;
    margins.push_back(has_power ? Json(std::round(cell.margin_db * 100.0) / 100.0) : Json(nullptr));
    probabilities.push_back(std::round(cell.probability * 1e4) / 1e4);
  }
  return {200, json_text({{"x0", grid.corner_m.x()},
                          {"y0", grid.corner_m.y()},
                          {"cell", grid.step_m},
                          {"columns", grid.columns},
                          {"rows", grid.rows},
                          {"height", question.height_m},
                          {"margin_db", std::move(margins)},
                          {"probability", std::move(probabilities)}})};
}

}  // namespace

ApiResponse api_error(int status, const std::string& message) {
  return {status, json_text({{"error", message}})};
}

bool is_command(const ApiRequest& request) { return request.method != "GET"; }

class Api::Impl {
 public:
  Impl(const Scene& scene, const Scenario& scenario, std::uint64_t seed)
      : solids(solids_json(scene, scenario)), paths(paths_json(scenario)), seed(seed) {}

  struct Call {
    LiveWorld& world;
    const Target& target;
    JsonArguments& body;
    const std::atomic<bool>& stop;
  };
  using Handler = ApiAnswer (Impl::*)(Call&);
  struct Route {
    const char* method;
    const char* path;
    Handler handler;
    std::vector<std::string> parameters;  ///< Of the query.
  };
  static const std::vector<Route>& all_routes();

  [[nodiscard]] Json status_json(const LiveWorld& world) const {
    return {{"name", world.scenario().name},
            {"mode", "live"},
            {"time", to_seconds(world.now())},
            {"speed", world.speed()},
            {"pace", world.pace()},
            {"paused", world.is_paused()},
            {"tags", world.tags().size()},
            {"antennas", world.antennas().size()},
            {"readers", world.readers()},
            {"duration", nullptr},
            {"plan", !plan.empty()}};
  }
  [[nodiscard]] ApiAnswer done(const LiveWorld& world) const {
    return ApiResponse{200, json_text(status_json(world))};
  }
  static std::string name_in(const Call& call) { return call.target.parts[2]; }

  ApiAnswer status(Call& call) { return done(call.world); }
  ApiAnswer scene(Call& call) {
    Json json = solids;
    json["obstacles"] = obstacles_json(call.world.scenario(), call.world.now());
    json["paths"] = paths;
    return ApiResponse{200, json_text(json)};
  }
  ApiAnswer antennas(Call& call) { return ApiResponse{200, json_text(antennas_json(call.world))}; }
  ApiAnswer tags(Call& call) { return ApiResponse{200, json_text(tags_json(call.world))}; }
  ApiAnswer located(Call& /*call*/) {
    if (!estimates)
      throw Error("tags are not located here; 'tagfield serve --locate' locates them");
    return ApiResponse{200, json_text(estimates_json(*estimates))};
  }
  ApiAnswer planned(Call& /*call*/) {
    if (plan.empty()) throw Error("there is no plan here; 'tagfield serve --plan DIR' shows one");
    return ApiResponse{200, plan};
  }
  ApiAnswer explain(Call& call) {
    return ApiResponse{200, json_text(to_json(call.world.explain(word_in(call.target, "antenna"),
                                                                 word_in(call.target, "tag"))))};
  }
  ApiAnswer coverage(Call& call) {
    auto question =
        std::make_shared<CoverageQuestion>(coverage_question(call.world, call.target, seed));
    question->request.stop = &call.stop;
    return [question] { return coverage_response(*question); };
  }

  ApiAnswer pause(Call& call) {
    call.body.finish();
    call.world.pause();
    return done(call.world);
  }
  ApiAnswer resume(Call& call) {
    call.body.finish();
    call.world.resume();
    return done(call.world);
  }
  ApiAnswer step(Call& call) {
    const double seconds = call.body.number("seconds", 1e-6, kMaxStep_s);
    call.body.finish();
    if (const auto end = call.world.step_end()) {
      return api_error(409, fmt::format("a step is running, to {} s: wait until the world is "
                                        "paused, or pause it",
                                        to_seconds(*end)));
    }
    call.world.advance(duration_from_seconds(seconds));
    return done(call.world);
  }
  ApiAnswer speed(Call& call) {
    const double speed = call.body.number("speed", 0.0, 1e6);
    call.body.finish();
    call.world.set_speed(speed);
    return done(call.world);
  }

  ApiAnswer add_tag(Call& call) {
    require_room(call.world.scenario().tags, kMaxTags, "tags");
    const TagSpec tag = tag_of(call.body, call.world);
    call.body.finish();
    call.world.add_tag(tag);
    return done(call.world);
  }
  ApiAnswer remove_tag(Call& call) {
    call.world.remove_tag(name_in(call));
    return done(call.world);
  }
  ApiAnswer move_tag(Call& call) {
    RigidTransform X_WT = place_of(call.body);
    call.body.finish();
    X_WT.rotation = tag_in(call.world, name_in(call)).motion.front().X_WB.rotation;
    call.world.move_tag(name_in(call), X_WT);
    return done(call.world);
  }
  ApiAnswer detune_tag(Call& call) {
    const double db = call.body.number("db", 0.0, 100.0);
    call.body.finish();
    const auto& antennas = call.world.antennas();
    if (std::none_of(antennas.begin(), antennas.end(), [](const LiveAntenna& antenna) {
          return physical(antenna.spec.parameters) != nullptr;
        })) {
      throw Error("no antenna here is affected: the paper's model has no losses of tags");
    }
    call.world.detune_tag(name_in(call), db);
    return done(call.world);
  }

  ApiAnswer add_antenna(Call& call) {
    require_room(call.world.antennas(), kMaxAntennas, "antennas");
    AntennaSpec added;
    added.parameters = antenna_in(call.world, call.body.text("like")).spec.parameters;
    added.parameters.name = call.body.text("name");
    if (call.body.has("reader")) added.parameters.reader = call.body.text("reader");
    added.X_PA = pose_of(call.body.numbers("pose", 6, kMaxPlace_m));
    call.body.finish();
    call.world.add_antenna(added);
    return done(call.world);
  }
  ApiAnswer remove_antenna(Call& call) {
    call.world.remove_antenna(name_in(call));
    return done(call.world);
  }
  ApiAnswer move_antenna(Call& call) {
    const RigidTransform X_WA = pose_of(call.body.numbers("pose", 6, kMaxPlace_m));
    call.body.finish();
    call.world.move_antenna(name_in(call), X_WA);
    return done(call.world);
  }
  ApiAnswer disconnect(Call& call) {
    call.body.finish();
    call.world.set_antenna_faulty(name_in(call), true);
    return done(call.world);
  }
  ApiAnswer connect(Call& call) {
    call.body.finish();
    call.world.set_antenna_faulty(name_in(call), false);
    return done(call.world);
  }

  ApiAnswer add_obstacle(Call& call) {
    require_room(call.world.scenario().obstacles, kMaxObstacles, "obstacles");
    require_notice(call.world);
    const ObstacleSpec obstacle = obstacle_of(call.body, call.world);
    call.body.finish();
    call.world.add_obstacle(obstacle);
    Json json = status_json(call.world);
    json["material"] = obstacle.body->material.name;
    return ApiResponse{200, json_text(json)};
  }
  ApiAnswer remove_obstacle(Call& call) {
    call.world.remove_obstacle(name_in(call));
    return done(call.world);
  }

  Json solids;
  Json paths;
  std::uint64_t seed;
  std::shared_ptr<const LiveEstimates> estimates;
  std::string plan;  ///< JSON; "" for none.
};

const std::vector<Api::Impl::Route>& Api::Impl::all_routes() {
  static const std::vector<Route> all = {
      {"GET", "/api/status", &Impl::status, {}},
      {"GET", "/api/scene", &Impl::scene, {}},
      {"GET", "/api/antennas", &Impl::antennas, {}},
      {"GET", "/api/tags", &Impl::tags, {}},
      {"GET", "/api/estimates", &Impl::located, {}},
      {"GET", "/api/plan", &Impl::planned, {}},
      {"GET", "/api/explain", &Impl::explain, {"antenna", "tag"}},
      {"GET", "/api/coverage", &Impl::coverage, {"antenna", "height", "cell"}},
      {"POST", "/api/pause", &Impl::pause, {}},
      {"POST", "/api/resume", &Impl::resume, {}},
      {"POST", "/api/step", &Impl::step, {}},
      {"POST", "/api/speed", &Impl::speed, {}},
      {"POST", "/api/tags", &Impl::add_tag, {}},
      {"DELETE", "/api/tags/{id}", &Impl::remove_tag, {}},
      {"POST", "/api/tags/{id}/move", &Impl::move_tag, {}},
      {"POST", "/api/tags/{id}/detune", &Impl::detune_tag, {}},
      {"POST", "/api/antennas", &Impl::add_antenna, {}},
      {"DELETE", "/api/antennas/{name}", &Impl::remove_antenna, {}},
      {"POST", "/api/antennas/{name}/move", &Impl::move_antenna, {}},
      {"POST", "/api/antennas/{name}/disconnect", &Impl::disconnect, {}},
      {"POST", "/api/antennas/{name}/connect", &Impl::connect, {}},
      {"POST", "/api/obstacles", &Impl::add_obstacle, {}},
      {"DELETE", "/api/obstacles/{name}", &Impl::remove_obstacle, {}},
  };
  return all;
}

Api::Api(const Scene& scene, const Scenario& scenario, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(scene, scenario, seed)) {}
Api::~Api() = default;
Api::Api(Api&&) noexcept = default;
Api& Api::operator=(Api&&) noexcept = default;

void Api::add(std::shared_ptr<const LiveEstimates> estimates) {
  impl_->estimates = std::move(estimates);
}

void Api::add_plan(std::string json) { impl_->plan = std::move(json); }

std::vector<std::string> Api::routes() {
  std::vector<std::string> all;
  for (const Impl::Route& route : Impl::all_routes()) {
    all.push_back(fmt::format("{} {}", route.method, route.path));
  }
  return all;
}

ApiAnswer Api::answer(LiveWorld& world, const ApiRequest& request, const std::atomic<bool>& stop) {
  try {
    const std::optional<Target> target = parsed_target(request.target);
    if (!target) return api_error(400, "the address is malformed");
    bool is_path = false;
    for (const Impl::Route& route : Impl::all_routes()) {
      if (!matches(*target, route.path)) continue;
      is_path = true;
      if (request.method != route.method) continue;
      require_known(*target, route.parameters);
      JsonArguments body(request.body);
      Impl::Call call{world, *target, body, stop};
      return ((*impl_).*(route.handler))(call);
    }
    return is_path
               ? api_error(405, fmt::format("{} is not allowed at this address", request.method))
               : api_error(404, "there is no such address; see /api/openapi.json");
  } catch (const Error& error) {
    return api_error(400, error.what());
  }
}

}  // namespace tagfield::http
