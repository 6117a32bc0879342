// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario with its world, as Python holds it.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/method.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/simulator/navigation_world.h"

namespace tagfield::python {

/// Never changed once it is there, so that any number of threads may run it.
struct LoadedScenario {
  ScenarioWithWorld parts;
  Diagnostics diagnostics;

  /// Made ready for robots that find their way by themselves; null where none does.
  [[nodiscard]] const NavigationWorld* ways() const;

 private:
  mutable std::mutex mutex_;
  mutable std::optional<NavigationWorld> ways_;
};
using LoadedPtr = std::shared_ptr<LoadedScenario>;

inline WorldOptions world_options(bool skip_missing, bool allow_outside) {
  WorldOptions options;
  options.skip_missing = skip_missing;
  options.allow_outside = allow_outside;
  return options;
}

/// A world that Python builds.
struct World {
  Scene scene;
};

/// Binds World, Loaded, load(), load_text() and run_seeds().
void bind_scenarios(pybind11::module_& module);

/// Binds Simulation: a scenario step by step.
void bind_simulation(pybind11::module_& module);

/// Binds explain() and coverage().
void bind_planning(pybind11::module_& module);

/// Binds Link: one antenna's links to any places.
void bind_links(pybind11::module_& module);

/// Binds localize(), track(), calibrate(), judge() and read_tables().
void bind_reads(pybind11::module_& module);

/// Binds bench().
void bind_bench(pybind11::module_& module);

/// Binds plan().
void bind_plan(pybind11::module_& module);

}  // namespace tagfield::python
