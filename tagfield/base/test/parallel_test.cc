// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/parallel.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tagfield/base/sanitized.h"

namespace tagfield {
namespace {

std::string thrown_by(std::size_t count, int threads,
                      const std::function<void(std::size_t)>& body) {
  try {
    parallel_for(count, threads, body);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

class ParallelFor : public testing::TestWithParam<int> {};

TEST_P(ParallelFor, CallsEachIndexOnce) {
  for (const std::size_t count : {0u, 1u, 2u, 7u, 1000u}) {
    std::vector<std::atomic<int>> calls(count);
    parallel_for(count, GetParam(), [&](std::size_t i) { ++calls[i]; });
    EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const auto& n) { return n == 1; }));
  }
}

TEST_P(ParallelFor, GivesWhatAPlainLoopGives) {
  std::vector<std::size_t> squares(500);
  parallel_for(squares.size(), GetParam(), [&](std::size_t i) { squares[i] = i * i; });
  // Sum of squares below n: (n-1)n(2n-1)/6.
  EXPECT_EQ(std::accumulate(squares.begin(), squares.end(), std::size_t{0}),
            std::size_t{499} * 500 * 999 / 6);
}

TEST_P(ParallelFor, PassesOnTheLowestIndexThatThrew) {
  const auto threads = static_cast<std::size_t>(std::max(GetParam(), 1));
  std::atomic<std::size_t> begun{0};
  // All wait for each other, so that every index throws.
  const auto body = [&](std::size_t i) {
    ++begun;
    while (begun < threads) std::this_thread::yield();
    throw std::runtime_error(std::to_string(i));
  };
  EXPECT_EQ(thrown_by(threads, GetParam(), body), "0");
}

TEST_P(ParallelFor, StopsAfterAnException) {
  std::atomic<std::size_t> calls{0};
  const auto body = [&](std::size_t i) {
    ++calls;
    if (i == 3) throw std::runtime_error("three");
    // Later indices wait until index 3 has started.
    while (i > 3 && calls < 4) std::this_thread::yield();
  };
  EXPECT_EQ(thrown_by(10'000'000, GetParam(), body), "three");
  EXPECT_LT(calls, 10'000'000u);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(-1, 0, 1, 2, 3, 5, 8));

TEST(ParallelForOnOneThread, RunsInOrderAndStopsAtOnce) {
  std::vector<std::size_t> seen;
  const auto body = [&](std::size_t i) {
    seen.push_back(i);
    if (i == 3) throw std::runtime_error("three");
  };
  EXPECT_EQ(thrown_by(1000, 1, body), "three");
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(ParallelForOnOneThread, StaysOnTheCallersThread) {
  std::thread::id where;
  parallel_for(1, 8, [&](std::size_t) { where = std::this_thread::get_id(); });
  EXPECT_EQ(where, std::this_thread::get_id());
}

/// Runs in a process of its own: limits the address space to 64 MB more than in use, which leaves
/// room for the stacks of a few threads. Exits with 0 if all work was done.
[[noreturn]] void loop_with_few_threads() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t space = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (64U << 20U);
  const rlimit limit{space, space};
  setrlimit(RLIMIT_AS, &limit);
  constexpr std::size_t kThreads = 64;
  std::atomic<std::size_t> calls{0};
  std::set<std::thread::id> seen;
  std::mutex mutex;
  parallel_for(1000, kThreads, [&](std::size_t) {
    ++calls;
    const std::lock_guard lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  std::_Exit(calls == 1000 && seen.size() < kThreads ? 0 : 1);
}

TEST(ParallelFor, GoesOnWithTheThreadsThereAre) {
  if (kSanitized) GTEST_SKIP() << "sanitizers need the address space that this takes away";
  EXPECT_EXIT(loop_with_few_threads(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace tagfield
