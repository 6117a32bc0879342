// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/field_worker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

namespace tagfield {
namespace {

constexpr int kSteps = 200;  // More than fit into the queue.

/// Records reads without a lock: only the worker's thread may call it.
struct StampLog final : ReadListener {
  std::vector<Time> stamps;
  void on_read(const TagRead& read) override { stamps.push_back(read.stamp); }
};

Outlets outlets_of(const std::shared_ptr<StampLog>& log) {
  Outlets outlets;
  attach(log, outlets);
  return outlets;
}

/// One tag in front of one antenna, which updates at 10 Hz.
FieldStep step(const std::shared_ptr<const FieldAntenna>& gate, int number) {
  FieldStep step;
  step.stamp = time_from_seconds(0.1 * number);
  if (number == 0) {
    step.antennas_added = {gate};
    step.added = {{0, "A", "", from_translation({1.0, 0.0, 0.0})}};
  }
  step.due = {{gate, RigidTransform{}, std::nullopt}};
  return step;
}

std::shared_ptr<const FieldAntenna> gate() {
  auto antenna = std::make_shared<FieldAntenna>();
  antenna->parameters.name = "gate";
  return antenna;
}

TEST(FieldWorker, TakesAllStepsInOrderWhileOthersAskHowFarItIs) {
  const auto log = std::make_shared<StampLog>();
  std::atomic<bool> is_over = false;
  std::int64_t seen = 0;
  {
    FieldWorker worker(outlets_of(log), {});
    std::jthread watcher([&] {
      while (!is_over) seen = std::max(seen, worker.done().reads);
    });
    const auto antenna = gate();
    for (int i = 0; i < kSteps; ++i) worker.post(step(antenna, i));
    is_over = true;
  }
  ASSERT_EQ(log->stamps.size(), static_cast<std::size_t>(kSteps));
  EXPECT_TRUE(std::is_sorted(log->stamps.begin(), log->stamps.end()));
  EXPECT_LE(seen, kSteps);
}

TEST(FieldWorker, CountsAllReadsOnceItHasFinished) {
  FieldWorker worker({}, {});
  const auto antenna = gate();
  for (int i = 0; i < kSteps; ++i) worker.post(step(antenna, i));
  worker.finish();
  EXPECT_EQ(worker.done().reads, kSteps);
}

TEST(FieldWorker, ComplainsOfAStepAndTakesTheNext) {
  const auto log = std::make_shared<StampLog>();
  std::vector<std::string> complaints;
  {
    const FieldConsole console{
        [](const std::string&) {},
        [&](const std::string& complaint) { complaints.push_back(complaint); }};
    FieldWorker worker(outlets_of(log), console);
    const auto antenna = gate();
    worker.post(step(antenna, 0));
    worker.post(step(antenna, 0));  // The tag is already present.
    worker.post(step(antenna, 1));
  }
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_EQ(complaints[0], "there is a tag of number 0 already");
  EXPECT_EQ(log->stamps.back(), time_from_seconds(0.1));
}

}  // namespace
}  // namespace tagfield
