// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/coverage_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "tagfield/base/number.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"
#include "tagfield/map/top_view.h"
#include "tagfield/planning/moment.h"
#include "tagfield/scenario/orientations.h"
#include "tagfield/scenario/profile.h"
#include "tagfield/settings/idle_settings.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace {

/// Maximum number of links with a default step: some ten or twenty seconds.
constexpr double kMirroredLinks = 800e3;
constexpr double kDirectLinks = 1.5e6;
constexpr double kPaperLinks = 20e6;
constexpr double kMinStep = 0.1;
constexpr double kMaxStep = 1.0;
constexpr std::size_t kMaxHeights = 3;  ///< Chosen by default.

std::vector<double> numbers_in(const std::string& option, const std::string& text,
                               std::size_t count, const char* expected) {
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::istringstream stream(spaced);
  std::vector<double> numbers;
  for (std::string word; stream >> word;) {
    const std::optional<double> number = parse_number(word);
    if (!number || std::abs(*number) > 1e6) {
      throw Error(fmt::format("coverage: {} '{}': '{}' is not a number up to 1e6, expected {}",
                              option, text, word, expected));
    }
    numbers.push_back(*number);
  }
  if (numbers.size() == count) return numbers;
  throw Error(fmt::format("coverage: {} '{}' has {} numbers, expected {}", option, text,
                          numbers.size(), expected));
}

void set_orientation(const std::string& text, WordedRequest& worded) {
  Orientations& orientations = worded.request.orientations;
  if (text == "any" || text == "worst") {
    orientations.R_WT = orientations_along_axes();
    orientations.worst = text == "worst";
    worded.orientation =
        fmt::format("{} {} orientations", orientations.worst ? "worst of" : "mean of",
                    orientations.R_WT.size());
    return;
  }
  const std::vector<double> rpy =
      numbers_in("--orientation", text, 3, "ROLL,PITCH,YAW [rad], 'any' or 'worst'");
  orientations.R_WT = {from_xyz_rpy({0, 0, 0}, {rpy[0], rpy[1], rpy[2]}).rotation};
  worded.orientation = fmt::format("roll {:g}, pitch {:g}, yaw {:g} rad", rpy[0], rpy[1], rpy[2]);
}

std::vector<std::string> known_settings() {
  std::vector<std::string> keys;
  for (const SettingHelp& setting : tag_settings()) keys.push_back(setting.key);
  return keys;
}

RawParameter setting_of(const std::string& argument) {
  const auto [key, value] = [&] {
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size()) {
      fail({"--tag-set " + argument, 0}, "expected key=value");
    }
    return std::pair(argument.substr(0, equals), argument.substr(equals + 1));
  }();
  if (!is_tag_setting(key)) {
    fail({"--tag-set " + argument, 0},
         fmt::format("not a setting of a tag{}", suggestion(key, known_settings())));
  }
  return {key, value, {"--tag " + argument, 0}};
}

void warn_of_kinds(const Scenario& scenario, Diagnostics& diagnostics) {
  // Tags with settings of their own each have a model, even if these are the same.
  std::set<std::map<std::string, std::string>> kinds;
  for (const TagSpec& tag : scenario.tags) {
    std::map<std::string, std::string> settings;
    if (tag.model) {
      for (const RawParameter& one : tag.model->settings) settings[one.key] = one.value;
    }
    kinds.insert(settings);
  }
  if (kinds.size() < 2) return;
  diagnostics.warn(
      fmt::format("the tags are of {} kinds: the maps are for that of the first, '{}' (--tag NAME "
                  "or --tag-profile choose another)",
                  kinds.size(), scenario.tags.front().id));
}

/// The tag named by --tag, or null. Settings instead of a name, the former usage of --tag, are
/// added to `settings`.
const TagSpec* tag_of(const CoverageArguments& arguments, const Scenario& scenario,
                      std::vector<std::string>& settings, Diagnostics& diagnostics) {
  const TagSpec* tag = nullptr;
  for (const std::string& word : arguments.tags) {
    const bool is_known = std::any_of(scenario.tags.begin(), scenario.tags.end(),
                                      [&](const TagSpec& one) { return one.id == word; });
    if (!is_known && word.find('=') != std::string::npos) {
      settings.push_back(word);
      diagnostics.warn(fmt::format("--tag {0} is now --tag-set {0}", word));
      continue;
    }
    if (tag != nullptr) throw Error("coverage: --tag: the maps are for one tag, expected one name");
    tag = &tag_named("coverage", scenario, word);
  }
  if (tag != nullptr && !arguments.tag_profile.empty()) {
    throw Error(
        "coverage: --tag and --tag-profile both state the kind of tag, expected one of them");
  }
  return tag;
}

void set_tag(const CoverageArguments& arguments, const Scenario& scenario, Diagnostics& diagnostics,
             WordedRequest& worded) {
  std::vector<std::string> settings = arguments.tag_settings;
  const TagSpec* const tag = tag_of(arguments, scenario, settings, diagnostics);
  std::vector<RawParameter> parameters;
  std::string name = "tag";
  if (!arguments.tag_profile.empty()) {
    const Profile profile = read_profile(arguments.tag_profile);
    if (profile.kind != ProfileKind::kTag) {
      fail({arguments.tag_profile, 0}, "is not a tag's profile, expected kind: tag");
    }
    parameters = profile.parameters;
    name = profile.name;
  } else if (tag != nullptr && tag->model && !settings.empty()) {
    parameters = tag->model->settings;
    name = tag->model->name;
  }
  for (const std::string& setting : settings) {
    parameters.push_back(setting_of(setting));
    name += " " + setting;
  }
  if (parameters.empty()) {
    if (tag == nullptr) warn_of_kinds(scenario, diagnostics);
    const auto& of_one = (tag != nullptr ? *tag : scenario.tags.front()).model;
    worded.request.tag = of_one ? of_one : default_tag_model();
  } else {
    worded.request.tag = tag_model_from(name, parameters, {"--tag-set", 0}, diagnostics);
  }
  for (const std::string& setting : settings) {
    const std::string key = setting_of(setting).key;
    const auto why = why_idle(key, *worded.request.tag);
    if (why) diagnostics.warn(fmt::format("--tag-set {} has no effect {}", key, *why));
  }
  worded.tag_kind = fmt::format("{}, chip {:g} dBm", worded.request.tag->name,
                                worded.request.tag->sensitivity_dbm);
}

void set_antennas(const CoverageArguments& arguments, const Scenario& scenario,
                  WordedRequest& worded) {
  worded.request.antennas = antennas_matching("coverage", scenario, arguments.antennas);
}

/// Heights of the tags, rounded to 5 cm, or the middle one if there are many.
std::vector<double> usual_heights(const std::vector<DriveSample>& samples) {
  std::vector<double> all;
  for (const RigidTransform& X_WT : samples.front().X_WT) {
    all.push_back(std::round(X_WT.translation.z() / 0.05) * 0.05 + 0.0);
  }
  std::sort(all.begin(), all.end());
  std::vector<double> heights = all;
  heights.erase(
      std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < 1e-6; }),
      heights.end());
  if (heights.size() <= kMaxHeights) return heights;
  return {all[all.size() / 2]};
}

void extend(const Collision& collision, Eigen::AlignedBox2d& box) {
  if (std::holds_alternative<Plane>(collision.shape)) return;
  Scene alone;
  alone.collisions = {collision};
  constexpr double kAll = 1e9;
  for (const Silhouette& silhouette : top_view(alone, -kAll, kAll)) {
    for (const Polygon& ring : silhouette.rings) {
      for (const Eigen::Vector2d& point : ring) box.extend(point);
    }
  }
}

/// The extent of the world with all antennas and tags; for an empty world some metres around them.
Eigen::AlignedBox2d usual_region(const Scene& scene, const std::vector<DriveSample>& samples) {
  Eigen::AlignedBox2d world;
  for (const Collision& collision : scene.collisions) extend(collision, world);
  Eigen::AlignedBox2d bodies;
  for (const DriveSample& sample : samples) {
    for (const RigidTransform& X : sample.X_WA) bodies.extend(X.translation.head<2>());
    for (const RigidTransform& X : sample.X_WT) bodies.extend(X.translation.head<2>());
  }
  constexpr double kAround = 5.0;
  constexpr double kRim = 0.5;
  const double around = world.isEmpty() ? kAround : kRim;
  const Eigen::Vector2d rim = Eigen::Vector2d::Constant(around);
  bodies = Eigen::AlignedBox2d(bodies.min() - rim, bodies.max() + rim);
  return world.isEmpty() ? bodies : bodies.merged(world);
}

Eigen::AlignedBox2d region_of(const CoverageArguments& arguments, const Scene& scene,
                              const std::vector<DriveSample>& samples) {
  if (arguments.region.empty()) return usual_region(scene, samples);
  const std::vector<double> n =
      numbers_in("--region", arguments.region, 4, "X_LOW,Y_LOW,X_HIGH,Y_HIGH [m]");
  if (!(n[0] < n[2] && n[1] < n[3])) {
    throw Error(
        fmt::format("coverage: --region '{}' is empty, expected X_LOW < X_HIGH and Y_LOW < "
                    "Y_HIGH",
                    arguments.region));
  }
  return {Eigen::Vector2d(n[0], n[1]), Eigen::Vector2d(n[2], n[3])};
}

double affordable_links(const Scenario& scenario, const std::vector<std::size_t>& antennas) {
  double links = kPaperLinks;
  for (const std::size_t i : antennas) {
    const RadioModel* const radio = physical(scenario.antennas[i].parameters);
    if (radio == nullptr) continue;
    const bool mirrors = radio->effects.reflections && radio->reflection_order > 0;
    links = std::min(links, mirrors ? kMirroredLinks : kDirectLinks);
  }
  return links;
}

/// 0.1 m, or coarser in steps of 5 cm if that would take long.
double usual_step(const Eigen::AlignedBox2d& region, const Scenario& scenario,
                  const std::vector<DriveSample>& samples, const CoverageRequest& request) {
  CoverageRequest one = request;
  one.grid.rows = one.grid.columns = 1;
  const double links =
      links_of(samples, one) * region.volume() / affordable_links(scenario, request.antennas);
  const double step = std::ceil(std::sqrt(links) / 0.05 - 1e-9) * 0.05;
  return std::clamp(step, kMinStep, kMaxStep);
}

}  // namespace

WordedRequest request_of(const CoverageArguments& arguments, const ScenarioWithWorld& loaded,
                         const std::vector<DriveSample>& samples, Diagnostics& diagnostics) {
  const Scenario& scenario = loaded.scenario;
  WordedRequest worded;
  CoverageRequest& request = worded.request;
  set_antennas(arguments, scenario, worded);
  set_tag(arguments, scenario, diagnostics, worded);
  set_orientation(arguments.orientation, worded);
  request.heights_m = arguments.heights_m.empty() ? usual_heights(samples) : arguments.heights_m;
  request.seed = arguments.of_scenario.seed.value_or(scenario.seed);
  request.threads = arguments.threads;
  const Eigen::AlignedBox2d region = region_of(arguments, loaded.scene, samples);
  const double step =
      arguments.step_m ? *arguments.step_m : usual_step(region, scenario, samples, request);
  try {
    request.grid = grid_over(region, step);
  } catch (const Error& error) {
    throw Error(fmt::format("coverage: {}", error.what()));
  }
  if (arguments.time_s) {
    const Time time = time_from_seconds(*arguments.time_s);
    request.bodies = simulation_at(scenario, request.seed, time).bodies_at(time);
  } else {
    request.bodies = standing_bodies(scenario, diagnostics);
  }
  worded.moment = arguments.time_s ? fmt::format("at {:g} s", *arguments.time_s)
                                   : "over the whole run, the best moment of each cell";
  return worded;
}

}  // namespace tagfield
