// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/link_matrix.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/layout/internal/link_store.h"
#include "tagfield/layout/test/small_store.h"
#include "tagfield/planning/local_link.h"

namespace tagfield {
namespace {

ScenarioToPlan store(const std::string& more = "") {
  Diagnostics unheard;
  return load_scenario_to_plan(folder_of_test().with("store.yaml", small_store(more)), {}, unheard);
}

LinkMatrix evaluated(const ScenarioToPlan& to_plan, LinkMatrixCounts& counts,
                     const std::string& folder = "", int threads = 1) {
  LinkMatrixRequest request;
  request.folder = folder;
  request.threads = threads;
  return evaluate_links(to_plan, request, counts);
}

TEST(LinkMatrix, HasAStateForEachPlaceAndCarrier) {
  const ScenarioToPlan to_plan = store();
  LinkMatrixCounts counts;
  const LinkMatrix matrix = evaluated(to_plan, counts);
  ASSERT_EQ(to_plan.plan.mounts.size(), 9U);
  EXPECT_EQ(matrix.columns.size(), 9U);
  EXPECT_EQ(matrix.rows.size(), 36U * 12U);
  // Equal to the link itself, up to the stored resolution of a quarter of a dB.
  const LinkRow& row = matrix.rows[100];
  const PlanMount& mount = to_plan.plan.mounts[4];
  const RadioModel& model = *physical(mount.antenna);
  const std::vector<double> carriers = sampled_carriers(model);
  ASSERT_EQ(matrix.carriers[4], carriers.size());
  const RadioView view = view_from(model, *to_plan.loaded.scenario.radio_world, mount.X_WA.front(),
                                   carriers[carriers.size() / 2], 0, 1);
  std::vector<RadioPath> paths;
  const TagEnd tag{*to_plan.plan.tags[row.group].model, row.X_WT};
  const std::vector<double> margins = fading_margins_db(view, tag, carriers, 0, paths);
  const LinkStates states = matrix.states(4, 100);
  for (std::size_t place = 0; place < kFadingPositions; ++place) {
    for (std::size_t carrier = 0; carrier < carriers.size(); ++carrier) {
      EXPECT_NEAR(states.margin_db(place, carrier), margins[place * carriers.size() + carrier],
                  0.25);
    }
  }
}

TEST(LinkMatrix, IsTheSameForAnyNumberOfThreadsAndFromDisk) {
  const ScenarioToPlan to_plan = store();
  TemporaryFolder folder;
  LinkMatrixCounts counts;
  const LinkMatrix alone = evaluated(to_plan, counts);
  const std::string links = (folder.path() / "links").string();
  const LinkMatrix together = evaluated(to_plan, counts, links, 4);
  EXPECT_EQ(alone.steps, together.steps);
  EXPECT_EQ(counts.kept, 0U);
  EXPECT_EQ(evaluated(to_plan, counts, links).steps, alone.steps);
  EXPECT_EQ(counts.kept, 9U);
  // An incomplete column is computed again.
  const auto first = *std::filesystem::directory_iterator(links);
  std::filesystem::resize_file(first.path(), 30);
  LinkMatrixCounts again;
  EXPECT_EQ(evaluated(to_plan, again, links).steps, alone.steps);
  EXPECT_EQ(again.kept, 8U);
  EXPECT_EQ(again.damaged, 1U);
}

TEST(LinkMatrix, OfAnotherScenarioIsNotTakenFromDisk) {
  TemporaryFolder folder;
  LinkMatrixCounts counts;
  const std::string links = (folder.path() / "links").string();
  evaluated(store(), counts, links);
  std::string other = small_store();
  other.replace(other.find("powers_dbm: [20]"), 16, "powers_dbm: [23]");
  Diagnostics unheard;
  const ScenarioToPlan stronger =
      load_scenario_to_plan(folder_of_test().with("store.yaml", other), {}, unheard);
  evaluated(stronger, counts, links);
  EXPECT_EQ(counts.kept, 0U);
  // The margin is subtracted on use, not in the cache.
  evaluated(store("  margin_db: 3\n"), counts, links);
  EXPECT_EQ(counts.kept, 9U);
}

TEST(LinkStore, RefusesFilesOfOthers) {
  TemporaryFolder folder;
  const std::vector<std::int8_t> column = {1, -2, 3, 4};
  const std::string hash = content_hash("x");
  store_column(folder.path().string(), hash, column);
  bool damaged = false;
  EXPECT_EQ(stored_column(folder.path().string(), hash, 4, damaged), column);
  EXPECT_FALSE(stored_column(folder.path().string(), hash, 5, damaged));
  EXPECT_TRUE(damaged);
  EXPECT_FALSE(stored_column(folder.path().string(), content_hash("y"), 4, damaged));
  EXPECT_FALSE(damaged);
}

TEST(PlanStops, AreAlongThePath) {
  PlanTags tags;
  tags.path = {{Time{}, from_translation({0, 0, 0})},
               {time_from_seconds(2.0), from_translation({2, 0, 0})}};
  const std::vector<PlanStop> stops = stops_of(tags, 10.0);
  ASSERT_EQ(stops.size(), 4U);
  EXPECT_DOUBLE_EQ(stops[1].begin_s, 0.5);
  EXPECT_DOUBLE_EQ(stops[1].end_s, 1.0);
  EXPECT_TRUE(stops[1].p_W.isApprox(Eigen::Vector3d(0.75, 0, 0)));
}

}  // namespace
}  // namespace tagfield
