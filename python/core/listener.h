// SPDX-License-Identifier: Apache-2.0
/// @file
/// A Python object as an outlet of a run.
#pragma once

#include <pybind11/pybind11.h>

#include "tagfield/stream/listeners.h"

namespace tagfield::python {

/// Binds Read, Antenna (an outlet's), Pose and Place, which outlets in Python are given.
void bind_records(pybind11::module_& module);

/// Attaches a Python function, which is called with each read, or an object with any of the methods
/// of tagfield.Outlet. What these raise ends the run and is raised there.
void attach_python(const pybind11::object& outlet, Outlets& outlets);

}  // namespace tagfield::python
