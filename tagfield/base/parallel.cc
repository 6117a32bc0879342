// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace tagfield {
namespace {

/// The exception of the lowest index so far.
class FirstError {
 public:
  void keep(std::size_t index, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_ || index < index_) {
      index_ = index;
      error_ = std::move(error);
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::size_t index_ = 0;
  std::exception_ptr error_;
};

}  // namespace

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  FirstError first_error;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        first_error.keep(i, std::current_exception());
        next = count;
      }
    }
  };
  const std::size_t helpers =
      std::min<std::size_t>(count, static_cast<std::size_t>(std::max(threads, 1)));
  std::vector<std::jthread> pool;
  try {
    for (std::size_t i = 1; i < helpers; ++i) pool.emplace_back(work);
  } catch (const std::system_error&) {
    // The machine can't start more threads; the existing ones do the work.
  }
  work();
  pool.clear();  // Waits for all threads.
  first_error.rethrow();
}

}  // namespace tagfield
