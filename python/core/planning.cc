// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "apps/tagfield/coverage_arguments.h"
#include "apps/tagfield/explain_text.h"
#include "python/core/arrays.h"
#include "python/core/calls.h"
#include "python/core/loaded.h"
#include "tagfield/planning/coverage.h"
#include "tagfield/planning/explanation_json.h"
#include "tagfield/planning/link_at.h"
#include "tagfield/planning/moment.h"

namespace tagfield::python {
namespace {

/// The explanation as JSON and as text.
std::pair<std::string, std::string> explain(const LoadedPtr& loaded, const std::string& antenna,
                                            const std::string& tag, double time_s,
                                            std::uint64_t seed) {
  const py::gil_scoped_release unlocked;
  Diagnostics diagnostics;
  const Scenario scenario = as_planned(loaded->parts.scenario, diagnostics);
  const TagSpec& to = tag_named("explain", scenario, tag);
  const Time time = time_from_seconds(time_s);
  const LinkExplanation link =
      antenna.empty()
          ? explain_best_link_at(scenario, to, time, seed)
          : explain_link_at(scenario, antenna_named("explain", scenario, antenna), to, time, seed);
  nlohmann::ordered_json json = to_json(link);
  json["warnings"] = diagnostics.warnings();
  return {json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
          to_text(link)};
}

Coverage covered(const LoadedPtr& loaded, const CoverageArguments& arguments,
                 const RunControl& control) {
  Diagnostics diagnostics;
  ScenarioWithWorld planned = loaded->parts;
  planned.scenario = as_planned(planned.scenario, diagnostics);
  warn_of_effects_left_out(planned.scenario, diagnostics);
  std::optional<Time> time;
  if (arguments.time_s) {
    time = time_from_seconds(*arguments.time_s);
    leave_out_absent_tags(*time, planned.scenario, diagnostics);
  }
  const std::uint64_t seed = arguments.of_scenario.seed.value_or(planned.scenario.seed);
  const std::vector<DriveSample> samples = sample_drive(planned.scenario, seed, time);
  WordedRequest worded = request_of(arguments, planned, samples, diagnostics);
  worded.request.stop = control.stop;
  worded.request.on_progress = control.on_progress;
  Coverage coverage = cover(planned.scenario, samples, worded.request);
  coverage.tag_kind = worded.tag_kind;
  coverage.orientation = worded.orientation;
  coverage.moment = worded.moment;
  coverage.warnings = diagnostics.warnings();
  return coverage;
}

py::object tags_table(const Coverage& coverage, const std::vector<std::string>& antennas) {
  Names tags;
  std::vector<TagCoverageRow> rows;
  for (const TagCoverage& tag : coverage.tags) {
    const Eigen::Vector3d& p = tag.p_WT;
    rows.push_back({tags.number_of(tag.id),
                    static_cast<std::int32_t>(tag.verdict),
                    tag.nearest,
                    tag.best.antenna,
                    {p.x(), p.y(), p.z()},
                    tag.nearest_m,
                    tag.best.power_dbm,
                    tag.best.reply_dbm,
                    tag.best.margin_db,
                    tag.best.probability});
  }
  std::vector<std::string> verdicts;
  for (const TagVerdict verdict :
       {TagVerdict::kNever, TagVerdict::kIntended, TagVerdict::kAlsoOther, TagVerdict::kWrong,
        TagVerdict::kSeldom}) {
    verdicts.emplace_back(word_of(verdict));
  }
  return table(
      std::move(rows),
      {{"tag", tags.all()}, {"verdict", verdicts}, {"nearest", antennas}, {"antenna", antennas}});
}

py::dict to_python(Coverage coverage) {
  std::vector<std::string> antennas;
  for (const CoverageAntenna& antenna : coverage.antennas) antennas.push_back(antenna.name);
  py::dict all;
  all["tags"] = tags_table(coverage, antennas);
  py::list layers;
  const CoverageGrid& grid = coverage.grid;
  const std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(grid.rows),
                                          static_cast<py::ssize_t>(grid.columns)};
  for (CoverageLayer& layer : coverage.layers) {
    const double share = share_read(layer);
    layers.append(py::make_tuple(
        layer.height_m, share,
        as_table(owned_array(std::move(layer.cells), shape), {{"antenna", antennas}})));
  }
  all["layers"] = layers;
  all["corner_m"] = py::cast(grid.corner_m);
  all["step_m"] = grid.step_m;
  all["tag_kind"] = coverage.tag_kind;
  all["orientation"] = coverage.orientation;
  all["moment"] = coverage.moment;
  all["by_paper"] = is_by_paper(coverage);
  all["warnings"] = coverage.warnings;
  return all;
}

py::dict coverage(const LoadedPtr& loaded, const py::dict& asked, int threads,
                  const py::object& progress) {
  CoverageArguments arguments;
  arguments.threads = threads;
  arguments.antennas = asked["antennas"].cast<std::vector<std::string>>();
  arguments.heights_m = asked["heights_m"].cast<std::vector<double>>();
  arguments.step_m = asked["step_m"].cast<std::optional<double>>();
  arguments.time_s = asked["time_s"].cast<std::optional<double>>();
  arguments.region = asked["region"].cast<std::string>();
  arguments.orientation = asked["orientation"].cast<std::string>();
  arguments.tag_profile = asked["tag_profile"].cast<std::string>();
  arguments.tag_settings = asked["tag_settings"].cast<std::vector<std::string>>();
  arguments.of_scenario.seed = asked["seed"].cast<std::optional<std::uint64_t>>();
  return to_python(interruptible(threads, progress, [&](const RunControl& control) {
    return covered(loaded, arguments, control);
  }));
}

}  // namespace

void bind_planning(py::module_& module) {
  module.def("explain", &explain, py::arg("loaded"), py::arg("antenna"), py::arg("tag"),
             py::arg("time_s"), py::arg("seed"));
  module.def("coverage", &coverage, py::arg("loaded"), py::arg("asked"), py::arg("threads"),
             py::arg("progress").none(true));
}

}  // namespace tagfield::python
