// SPDX-License-Identifier: Apache-2.0
// The Python module tagfield._core: what of Tagfield is in C++. Users import tagfield, whose
// modules in python/tagfield say what everything is for.
#include <pybind11/pybind11.h>

#include <new>

#include "python/core/arrays.h"
#include "python/core/listener.h"
#include "python/core/loaded.h"
#include "python/core/method.h"
#include "tagfield/base/error.h"

PYBIND11_MODULE(_core, module) {
  namespace of = tagfield::python;
  module.doc() = "Tagfield's core. Import tagfield instead.";
  module.attr("__version__") = TAGFIELD_VERSION;
  pybind11::register_exception<tagfield::Error>(module, "Error", PyExc_ValueError);
  of::register_rows();
  of::bind_records(module);
  of::bind_methods(module);
  of::bind_scenarios(module);
  of::bind_simulation(module);
  of::bind_planning(module);
  of::bind_links(module);
  of::bind_reads(module);
  of::bind_bench(module);
  of::bind_plan(module);
}
