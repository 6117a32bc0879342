// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables as NumPy's structured arrays, without a copy.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "python/core/rows.h"
#include "tagfield/base/error.h"

namespace tagfield::python {

namespace py = pybind11;

/// Which columns hold numbers of names, and those names.
using Categories = std::vector<std::pair<const char*, std::vector<std::string>>>;

/// Tells NumPy what the rows are made of; once, when the module is loaded.
void register_rows();

/// `array` as a tagfield.Table with these categories.
py::object as_table(const py::array& array, const Categories& categories);

/// The rows, which NumPy owns from now on.
template <class Row>
py::array owned_array(std::vector<Row> rows, const std::vector<py::ssize_t>& shape) {
  auto owner = std::make_unique<std::vector<Row>>(std::move(rows));
  std::vector<Row>* const kept = owner.get();
  const py::capsule base(owner.release(),
                         [](void* held) { delete static_cast<std::vector<Row>*>(held); });
  return py::array_t<Row>(shape, kept->data(), base);
}

template <class Row>
py::object table(std::vector<Row> rows, const Categories& categories) {
  const auto size = static_cast<py::ssize_t>(rows.size());
  return as_table(owned_array(std::move(rows), {size}), categories);
}

/// The name of this number. Throws Error where there is none.
inline const std::string& name_in(const std::vector<std::string>& names, std::int32_t number,
                                  const char* column, std::size_t row) {
  if (number >= 0 && static_cast<std::size_t>(number) < names.size()) {
    return names[static_cast<std::size_t>(number)];
  }
  throw Error("row " + std::to_string(row) + ": " + column + " is " + std::to_string(number) +
              ", but the table has " + std::to_string(names.size()) + " names");
}

template <class Row>
using Rows = py::array_t<Row, py::array::c_style>;

}  // namespace tagfield::python
