// SPDX-License-Identifier: Apache-2.0
/// @file
/// A Python function as a localization method.
#pragma once

#include <pybind11/pybind11.h>

#include "tagfield/localization/method.h"

namespace tagfield::python {

/// Binds Problem and Method. A Method's function takes a Problem and gives a list of
/// (tag, why not, [(place, covariance, expected error, misfit), …]), which tagfield._methods makes
/// of what users return.
void bind_methods(pybind11::module_& module);

}  // namespace tagfield::python
