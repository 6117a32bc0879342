// SPDX-License-Identifier: Apache-2.0
/// @file
/// Work that goes on without Python's lock, and Python's functions called from it.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <utility>

#include "tagfield/simulator/simulation.h"

namespace tagfield::python {

namespace py = pybind11;

/// An object that any thread may let go of.
using Held = std::shared_ptr<const py::object>;
inline Held held(py::object object) {
  return {new py::object(std::move(object)), [](py::object* last) {
            const py::gil_scoped_acquire lock;
            delete last;
          }};
}

/// `work(control)` without Python's lock, in a thread of its own, so that Ctrl-C ends it early;
/// then KeyboardInterrupt is thrown. `progress`, where it is not None, is called with 0 … 1 now and
/// then, and with 1 when all is done.
template <class Work>
auto interruptible(int threads, const py::object& progress, Work work) {
  std::atomic<bool> stop{false};
  std::atomic<double> share{0.0};
  RunControl control;
  control.threads = threads;
  control.stop = &stop;
  control.on_progress = [&share](double done) { share = done; };
  auto result = std::async(std::launch::async, [&] { return work(control); });
  const auto is_done = [&result] {
    const py::gil_scoped_release unlocked;
    constexpr std::chrono::milliseconds kPatience(50);
    return result.wait_for(kPatience) == std::future_status::ready;
  };
  try {
    while (!is_done()) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress.is_none()) progress(share.load());
    }
  } catch (...) {
    stop = true;
    const py::gil_scoped_release unlocked;
    result.wait();
    throw;
  }
  auto done = result.get();
  if (!progress.is_none()) progress(1.0);
  return done;
}

}  // namespace tagfield::python
