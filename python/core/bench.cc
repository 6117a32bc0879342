// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/bench/bench.h"

#include <pybind11/stl.h>

#include "apps/tagfield/foreign_tables.h"
#include "python/core/calls.h"
#include "python/core/loaded.h"
#include "tagfield/experiment/bench/bench_figures.h"
#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/bench/bench_page.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/localization/locate.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield::python {
namespace {

/// A scenario as Python describes it: of a file, or of text with a world.
struct ScenarioSource {
  std::string path, text, name;
  std::vector<Override> overrides;
  std::shared_ptr<const World> world;
  WorldOptions world_options;  ///< Of a file's.
};

MakeScenario maker_of(const ScenarioSource& source) {
  return [source](const std::vector<Override>& more, Diagnostics& diagnostics,
                  const std::vector<Method>& methods) {
    std::vector<Override> overrides = source.overrides;
    overrides.insert(overrides.end(), more.begin(), more.end());
    if (!source.path.empty()) {
      return load_scenario_with_world(source.path, overrides, diagnostics, source.world_options,
                                      methods);
    }
    return scenario_from_text(source.text, source.name, overrides,
                              source.world ? &source.world->scene : nullptr, diagnostics, methods);
  };
}

std::vector<Method> methods_with(const std::vector<Method>& own) {
  std::vector<Method> methods = built_in_methods();
  methods.insert(methods.end(), own.begin(), own.end());
  return methods;
}

struct BenchRequest {
  Suite suite;
  std::vector<Method> own;
  int threads = 1;
};

Bench compared(const BenchRequest& request, const RunControl& control) {
  Diagnostics diagnostics;
  const auto read = [&](const SuiteRecording& recording) {
    ReadsAndPoses tables =
        read_tables({"recording", recording.reads, recording.poses, recording.format}, diagnostics);
    return RecordedReads{std::move(tables.reads), std::move(tables.poses)};
  };
  const PreparedSuite prepared =
      prepare(request.suite, methods_with(request.own), diagnostics, read);
  Bench bench = run_bench(prepared, control);
  std::vector<std::string> warnings = diagnostics.warnings();
  warnings.insert(warnings.end(), bench.warnings.begin(), bench.warnings.end());
  bench.warnings = warnings;
  return bench;
}

py::dict run(const BenchRequest& request, const py::object& progress) {
  const Bench bench = interruptible(request.threads, progress, [&](const RunControl& control) {
    return compared(request, control);
  });
  const Timing timing = Timing::kWithTimes;
  py::dict all;
  all["text"] = bench_to_text(bench, timing);
  all["json"] = bench_to_json(bench, timing);
  all["csv"] = bench_to_csv(bench, timing);
  all["tags_csv"] = bench_tags_to_csv(bench);
  all["html"] = bench_page(bench, bench_figures(bench, timing), timing);
  all["warnings"] = bench.warnings;
  return all;
}

py::dict bench_suite(const std::string& path, const std::vector<Method>& own,
                     const std::optional<std::uint64_t>& seeds,
                     const std::optional<std::uint64_t>& first_seed, bool skip_missing,
                     bool allow_outside, int threads, const py::object& progress) {
  BenchRequest request{load_suite(path), own, threads};
  set_world_options(world_options(skip_missing, allow_outside), request.suite);
  if (first_seed) request.suite.first_seed = *first_seed;
  for (const Method& method : own) {
    request.suite.methods.push_back({method.name, method.name, {}, {}});
  }
  if (seeds) {
    request.suite.count = *seeds;
    for (Condition& condition : request.suite.conditions) condition.count.reset();
  }
  return run(request, progress);
}

using MethodEntry = std::tuple<std::string, std::string, std::vector<Override>>;
using ConditionEntry =
    std::tuple<std::string, ScenarioSource, std::vector<Override>, std::optional<double>>;

py::dict bench(const std::string& name, const std::vector<MethodEntry>& methods,
               const std::vector<ConditionEntry>& conditions, const std::vector<Method>& own,
               std::uint64_t first_seed, std::uint64_t seeds, int threads,
               const py::object& progress) {
  BenchRequest request;
  request.own = own;
  request.threads = threads;
  request.suite.name = name;
  request.suite.first_seed = first_seed;
  request.suite.count = seeds;
  for (const auto& [label, method, settings] : methods) {
    request.suite.methods.push_back({label, method, settings, {}});
  }
  for (const auto& [label, source, settings, phase_noise_rad] : conditions) {
    Condition condition;
    condition.name = label;
    condition.make_scenario = maker_of(source);
    condition.settings = settings;
    condition.phase_noise_rad = phase_noise_rad;
    request.suite.conditions.push_back(std::move(condition));
  }
  return run(request, progress);
}

}  // namespace

void bind_bench(py::module_& module) {
  py::class_<ScenarioSource>(module, "ScenarioSource")
      .def(py::init([](std::string path, std::string text, std::string name,
                       std::vector<Override> overrides, std::shared_ptr<World> world,
                       bool skip_missing, bool allow_outside) {
             return ScenarioSource{std::move(path),  std::move(text),
                                   std::move(name),  std::move(overrides),
                                   std::move(world), world_options(skip_missing, allow_outside)};
           }),
           py::arg("path"), py::arg("text"), py::arg("name"), py::arg("overrides"),
           py::arg("world").none(true), py::arg("skip_missing"), py::arg("allow_outside"));
  module.def("bench_suite", &bench_suite, py::arg("path"), py::arg("own"), py::arg("seeds"),
             py::arg("first_seed"), py::arg("skip_missing"), py::arg("allow_outside"),
             py::arg("threads"), py::arg("progress").none(true));
  module.def("bench", &bench, py::arg("name"), py::arg("methods"), py::arg("conditions"),
             py::arg("own"), py::arg("first_seed"), py::arg("seeds"), py::arg("threads"),
             py::arg("progress").none(true));
}

}  // namespace tagfield::python
