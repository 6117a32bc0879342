// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "apps/tagfield/plan_arguments.h"
#include "apps/tagfield/top_view_file.h"
#include "python/core/calls.h"
#include "python/core/loaded.h"
#include "tagfield/layout/layout_scenario.h"
#include "tagfield/report/plan_page.h"

namespace tagfield::python {
namespace {

struct PlannedHere {
  AntennaPlan plan;
  std::string layout;  ///< As a scenario.
  std::vector<Silhouette> outlines;
};

/// What is done of all, links and layouts and a check taking about so much each.
double share_of_all(const PlanQuestion& question, const std::string& stage, double share) {
  const double links = 0.5;
  const double layouts = question.check_seeds > 0 ? 0.3 : 0.5;
  if (stage == "links") return links * share;
  if (stage == "layouts") return links + layouts * share;
  return links + layouts + (1.0 - links - layouts) * share;
}

PlannedHere planned(const std::string& path, const std::vector<Override>& overrides,
                    const WorldOptions& world, const std::optional<std::uint64_t>& seed,
                    PlanQuestion question, const RunControl& control) {
  Diagnostics diagnostics;
  const ScenarioToPlan to_plan = load_scenario_to_plan(path, overrides, diagnostics, world);
  require_exact(question, to_plan.plan);
  question.seed = seed.value_or(to_plan.loaded.scenario.seed);
  question.threads = control.threads;
  question.stop = control.stop;
  question.on_progress = [&](const std::string& stage, double share) {
    control.on_progress(share_of_all(question, stage, share));
  };
  PlannedHere here;
  here.plan = plan_antennas(to_plan, question, diagnostics);
  here.layout = layout_to_yaml(path, overrides, to_plan, here.plan.layouts[here.plan.chosen],
                               question.seed, "");
  here.outlines = outlines_of(to_plan.loaded);
  return here;
}

py::dict plan(const std::string& path, const std::vector<Override>& overrides, bool skip_missing,
              bool allow_outside, const std::optional<std::uint64_t>& seed, std::size_t samples,
              std::size_t check_seeds, double exact_s, const std::string& links, int threads,
              const py::object& progress) {
  PlanQuestion question;
  question.samples = samples;
  question.check_seeds = check_seeds;
  question.exact_s = exact_s;
  question.links = links;
  const PlannedHere here = interruptible(threads, progress, [&](const RunControl& control) {
    return planned(path, overrides, world_options(skip_missing, allow_outside), seed, question,
                   control);
  });
  py::dict all;
  all["text"] = plan_to_text(here.plan);
  all["json"] = plan_to_json(here.plan);
  all["layouts_csv"] = plan_layouts_to_csv(here.plan);
  all["antennas_csv"] = plan_antennas_to_csv(here.plan);
  all["positions_csv"] = plan_positions_to_csv(here.plan);
  all["html"] = plan_page(here.plan, plan_figures(here.plan, here.outlines));
  all["layout"] = here.layout;
  all["warnings"] = here.plan.warnings;
  return all;
}

}  // namespace

void bind_plan(py::module_& module) {
  module.def("plan", &plan, py::arg("path"), py::arg("overrides"), py::arg("skip_missing"),
             py::arg("allow_outside"), py::arg("seed"), py::arg("samples"), py::arg("check_seeds"),
             py::arg("exact_s"), py::arg("links"), py::arg("threads"),
             py::arg("progress").none(true));
}

}  // namespace tagfield::python
