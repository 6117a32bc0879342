// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/tagfield/table.h"
#include "python/core/calls.h"
#include "python/core/listener.h"
#include "python/core/loaded.h"
#include "python/core/tables.h"
#include "tagfield/base/parallel.h"
#include "tagfield/experiment/judge.h"
#include "tagfield/experiment/stoppable.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield::python {
namespace {

/// What is to be done with each seed.
struct RunOptions {
  bool locates = true;
  std::optional<Method> method;  ///< Instead of the scenario's.
};

/// One seed, without anything of Python's.
struct RunResult {
  SeedRun run;  ///< Without its recording.
  RunTables tables;
  std::string text;
  std::vector<std::string> warnings;
};

/// Throws LocatingStopped.
void locate(const LoadedScenario& loaded, const RunOptions& how, const RunControl& control,
            RunResult& result) {
  const Scenario& scenario = loaded.parts.scenario;
  Diagnostics diagnostics;
  LocalizationOptions options = localization_options(scenario, control.threads);
  make_stoppable(control.stop, options.on_locating, options.known.trace);
  options.known.map_error = map_error_of(scenario, result.run);
  if (how.method) {
    options.method = how.method->name;
    options.methods = {*how.method};
    options.settings.clear();
  }
  SeedRun& run = result.run;
  const Recording& recording = run.recording;
  LocalizationResult located =
      locate_tags(recording.reads, recording.believed_poses, options, diagnostics);
  run.method = located.method;
  run.method_why = located.why;
  run.corrected_poses = std::move(located.corrected_poses);
  run.outcomes = judged(with_all_tags(std::move(located.estimates), {}, tags_of(scenario)),
                        recording.reads, recording.truth, options.known.reference_tags, run.seed);
  result.warnings = diagnostics.warnings();
}

RunResult run_seed(const LoadedScenario& loaded, std::uint64_t seed, const RunOptions& how,
                   const RunControl& control) {
  RunResult result;
  RunControl of_run = control;
  attach(std::make_shared<TableRecorder>(result.tables), of_run.outlets);
  of_run.keeps_recording = how.locates;
  result.run = simulate(loaded.parts.scenario, seed, of_run, loaded.ways());
  if (how.locates && result.run.complete) locate(loaded, how, control, result);
  Summary summary;
  summary.scenario = loaded.parts.scenario.name;
  summary.method = result.run.method;
  summary.seeds = {seed};
  summary.reads = result.tables.reads.size();
  summary.tags = result.run.outcomes;
  if (!summary.tags.empty()) result.text = table_of(summary);
  result.run.recording = {};
  return result;
}

std::vector<RunResult> run_all(const LoadedScenario& loaded,
                               const std::vector<std::uint64_t>& seeds, const RunOptions& how,
                               const RunControl& control) {
  std::vector<RunResult> results(seeds.size());
  std::mutex mutex;
  double finished = 0.0;
  parallel_for(seeds.size(), control.threads, [&](std::size_t i) {
    if (stopped(control)) return;
    RunControl of_seed = control;
    if (seeds.size() > 1) {
      of_seed.threads = 1;
      of_seed.on_progress = nullptr;
    }
    results[i] = run_seed(loaded, seeds[i], how, of_seed);
    const std::lock_guard lock(mutex);
    finished += 1.0;
    control.on_progress(finished / static_cast<double>(seeds.size()));
  });
  return results;
}

py::dict to_python(RunResult result) {
  RunTables tables = std::move(result.tables);
  std::vector<PoseRow> corrected;
  for (const AntennaPose& pose : result.run.corrected_poses) {
    corrected.push_back(row_of(pose, tables.antennas));
  }
  const std::vector<std::string> antennas = tables.antennas.all();
  py::dict all = to_python(std::move(tables));
  all["corrected_poses"] = table(std::move(corrected), {{"name", antennas}});
  all.attr("update")(estimates_of(result.run.outcomes));
  all["seed"] = result.run.seed;
  all["simulated_s"] = result.run.simulated_s;
  all["path_length_m"] = result.run.path_length_m;
  all["method"] = result.run.method;
  all["why"] = result.run.method_why;
  all["text"] = result.text;
  all["warnings"] = result.warnings;
  return all;
}

py::list run_seeds(const LoadedPtr& loaded, const std::vector<std::uint64_t>& seeds, int threads,
                   bool locates, const std::optional<Method>& method, const py::list& outlets,
                   const py::object& progress) {
  Outlets attached;
  for (const py::handle outlet : outlets) {
    attach_python(py::reinterpret_borrow<py::object>(outlet), attached);
  }
  const bool asks_for_places =
      method || loaded->parts.scenario.localization.method != kNoLocalization;
  const RunOptions how{locates && asks_for_places, method};
  std::vector<RunResult> results = interruptible(threads, progress, [&](RunControl& control) {
    control.outlets = attached;
    return run_all(*loaded, seeds, how, control);
  });
  py::list runs;
  for (RunResult& result : results) runs.append(to_python(std::move(result)));
  return runs;
}

LoadedPtr load(const std::string& path, const std::vector<Override>& overrides, bool skip_missing,
               bool allow_outside) {
  auto loaded = std::make_shared<LoadedScenario>();
  loaded->parts = load_scenario_with_world(path, overrides, loaded->diagnostics,
                                           world_options(skip_missing, allow_outside));
  return loaded;
}

LoadedPtr load_text(const std::string& text, const std::string& name,
                    const std::vector<Override>& overrides, const World* world) {
  auto loaded = std::make_shared<LoadedScenario>();
  loaded->parts = scenario_from_text(
      text, name, overrides, world == nullptr ? nullptr : &world->scene, loaded->diagnostics);
  return loaded;
}

std::vector<std::string> antennas_of(const LoadedScenario& loaded) {
  std::vector<std::string> names;
  for (const AntennaSpec& antenna : loaded.parts.scenario.antennas) {
    names.push_back(antenna.parameters.name);
  }
  return names;
}

std::vector<std::string> robots_of(const LoadedScenario& loaded) {
  std::vector<std::string> names;
  for (const RobotSpec& robot : loaded.parts.scenario.robots) names.push_back(robot.name);
  return names;
}

py::dict tag_places_of(const LoadedScenario& loaded) {
  py::dict places;
  for (const TagSpec& tag : loaded.parts.scenario.tags) {
    places[py::str(tag.id)] = py::cast(Eigen::Vector3d(tag.motion.front().X_WB.translation));
  }
  return places;
}

/// The floor plan: outlines [m, world] of what stands there from `low_m` to `high_m`.
std::vector<std::pair<std::string, std::vector<std::vector<Eigen::Vector2d>>>> outlines_of(
    const LoadedScenario& loaded, double low_m, double high_m) {
  std::vector<std::pair<std::string, std::vector<std::vector<Eigen::Vector2d>>>> outlines;
  for (const Silhouette& silhouette : top_view(loaded.parts.scene, low_m, high_m)) {
    std::vector<std::vector<Eigen::Vector2d>> rings;
    for (const Polygon& ring : silhouette.rings) rings.emplace_back(ring.begin(), ring.end());
    outlines.emplace_back(silhouette.name, std::move(rings));
  }
  return outlines;
}

void add(World& world, const std::string& name, Shape shape, const Eigen::Vector3d& position_m,
         const Eigen::Vector3d& rpy_rad) {
  const auto same = [&](const Collision& other) { return other.name == name; };
  const auto& solids = world.scene.collisions;
  if (name.empty()) throw Error("world: a solid needs a name");
  if (std::any_of(solids.begin(), solids.end(), same)) {
    throw Error("world: there is a solid '" + name + "' already");
  }
  if (!position_m.allFinite() || !rpy_rad.allFinite()) {
    throw Error("world: '" + name + "': position_m and rpy_rad must be finite");
  }
  world.scene.collisions.push_back({name, std::move(shape), from_xyz_rpy(position_m, rpy_rad), {}});
  world.scene.models.push_back(name);
}

void require_size(const std::string& name, const char* what, double least) {
  if (least > 0.0 && least <= 1e5) return;
  throw Error("world: '" + name + "': " + what + " must be over 0 and at most 100000 m");
}

void add_box(World& world, const std::string& name, const Eigen::Vector3d& size_m,
             const Eigen::Vector3d& position_m, const Eigen::Vector3d& rpy_rad) {
  for (const double size : size_m) require_size(name, "size_m", size);
  add(world, name, Box{size_m}, position_m, rpy_rad);
}

void add_cylinder(World& world, const std::string& name, double radius_m, double length_m,
                  const Eigen::Vector3d& position_m, const Eigen::Vector3d& rpy_rad) {
  require_size(name, "radius_m", radius_m);
  require_size(name, "length_m", length_m);
  add(world, name, Cylinder{radius_m, length_m}, position_m, rpy_rad);
}

void add_sphere(World& world, const std::string& name, double radius_m,
                const Eigen::Vector3d& position_m) {
  require_size(name, "radius_m", radius_m);
  add(world, name, Sphere{radius_m}, position_m, Eigen::Vector3d::Zero());
}

void add_floor(World& world, const std::string& name, double height_m) {
  add(world, name, Plane{}, {0.0, 0.0, height_m}, Eigen::Vector3d::Zero());
}

using Vertices = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Triangles = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

void add_mesh(World& world, const std::string& name, const Vertices& vertices_m,
              const Triangles& triangles, const Eigen::Vector3d& position_m,
              const Eigen::Vector3d& rpy_rad) {
  if (vertices_m.ndim() != 2 || vertices_m.shape(1) != 3 || triangles.ndim() != 2 ||
      triangles.shape(1) != 3) {
    throw Error("world: '" + name + "': vertices_m must be (N, 3), triangles (M, 3)");
  }
  auto mesh = std::make_shared<TriangleMesh>();
  for (py::ssize_t i = 0; i < vertices_m.shape(0); ++i) {
    mesh->vertices.emplace_back(vertices_m.at(i, 0), vertices_m.at(i, 1), vertices_m.at(i, 2));
    if (mesh->vertices.back().allFinite()) continue;
    throw Error("world: '" + name + "': vertex " + std::to_string(i) + " is not finite");
  }
  for (py::ssize_t i = 0; i < triangles.shape(0); ++i) {
    std::array<std::uint32_t, 3> corners{};
    for (py::ssize_t j = 0; j < 3; ++j) {
      const std::int64_t corner = triangles.at(i, j);
      if (corner < 0 || corner >= vertices_m.shape(0)) {
        throw Error("world: '" + name + "': triangle " + std::to_string(i) + " has vertex " +
                    std::to_string(corner) + ", but there are " +
                    std::to_string(vertices_m.shape(0)));
      }
      corners.at(static_cast<std::size_t>(j)) = static_cast<std::uint32_t>(corner);
    }
    mesh->triangles.push_back(corners);
  }
  add(world, name, MeshPtr(mesh), position_m, rpy_rad);
}

std::vector<std::string> solids_of(const World& world) {
  std::vector<std::string> names;
  for (const Collision& solid : world.scene.collisions) names.push_back(solid.name);
  return names;
}

void bind_world(py::module_& module) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  py::class_<World, std::shared_ptr<World>>(module, "World")
      .def(py::init<>())
      .def_property_readonly("solids", &solids_of)
      .def("add_box", &add_box, py::arg("name"), py::arg("size_m"), py::arg("position_m"),
           py::arg("rpy_rad") = zero)
      .def("add_cylinder", &add_cylinder, py::arg("name"), py::arg("radius_m"), py::arg("length_m"),
           py::arg("position_m"), py::arg("rpy_rad") = zero)
      .def("add_sphere", &add_sphere, py::arg("name"), py::arg("radius_m"), py::arg("position_m"))
      .def("add_floor", &add_floor, py::arg("name"), py::arg("height_m"))
      .def("add_mesh", &add_mesh, py::arg("name"), py::arg("vertices_m"), py::arg("triangles"),
           py::arg("position_m") = zero, py::arg("rpy_rad") = zero);
}

}  // namespace

const NavigationWorld* LoadedScenario::ways() const {
  if (parts.scenario.pose.source != PoseSource::kSlam) return nullptr;
  const std::lock_guard lock(mutex_);
  Diagnostics unheard;
  if (!ways_) ways_ = navigation_world(parts.scenario, parts.scene, unheard);
  return &*ways_;
}

void bind_scenarios(py::module_& module) {
  bind_world(module);
  py::class_<LoadedScenario, LoadedPtr>(module, "Loaded")
      .def_property_readonly("name",
                             [](const LoadedScenario& self) { return self.parts.scenario.name; })
      .def_property_readonly(
          "description", [](const LoadedScenario& self) { return self.parts.scenario.description; })
      .def_property_readonly("seed",
                             [](const LoadedScenario& self) { return self.parts.scenario.seed; })
      .def_property_readonly(
          "duration_s", [](const LoadedScenario& self) { return self.parts.scenario.duration_s; })
      .def_property_readonly(
          "method",
          [](const LoadedScenario& self) { return self.parts.scenario.localization.method; })
      .def_property_readonly("antennas", &antennas_of)
      .def_property_readonly("robots", &robots_of)
      .def_property_readonly("tags", &tag_places_of)
      .def_property_readonly("warnings",
                             [](const LoadedScenario& self) { return self.diagnostics.warnings(); })
      .def("outlines", &outlines_of, py::arg("low_m"), py::arg("high_m"));
  module.def("load", &load, py::arg("path"), py::arg("overrides"), py::arg("skip_missing"),
             py::arg("allow_outside"), py::call_guard<py::gil_scoped_release>());
  module.def("load_text", &load_text, py::arg("text"), py::arg("name"), py::arg("overrides"),
             py::arg("world").none(true), py::call_guard<py::gil_scoped_release>());
  module.def("run_seeds", &run_seeds, py::arg("loaded"), py::arg("seeds"), py::arg("threads"),
             py::arg("locates"), py::arg("method").none(true), py::arg("outlets"),
             py::arg("progress").none(true));
}

}  // namespace tagfield::python
