// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/layout/layout_scenario.h"
#include "tagfield/layout/plan_check.h"
#include "tagfield/layout/test/small_store.h"

namespace tagfield {
namespace {

struct Planned {
  std::string path;
  ScenarioToPlan to_plan;
  LinkMatrix matrix;
  AntennaPlan plan;
};

Planned planned(const std::string& text, int threads = 1) {
  Planned all;
  Diagnostics unheard;
  all.path = folder_of_test().with("store.yaml", text);
  all.to_plan = load_scenario_to_plan(all.path, {}, unheard);
  LinkMatrixCounts counts;
  LinkMatrixRequest links;
  all.matrix = evaluate_links(all.to_plan, links, counts);
  PlanRequest request;
  request.samples = 24;
  request.threads = threads;
  all.plan = make_plan(all.to_plan, all.matrix, request);
  return all;
}

std::string complaint_of(const std::string& text) {
  try {
    planned(text);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(AntennaPlan, ReadsMoreWithMoreAntennas) {
  const AntennaPlan plan = planned(small_store()).plan;
  ASSERT_EQ(plan.layouts.size(), 4U);
  EXPECT_EQ(plan.tags, 60U);
  for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
    const PlannedLayout& layout = plan.layouts[i];
    EXPECT_EQ(layout.antennas.size(), i + 1);
    EXPECT_DOUBLE_EQ(layout.cost, 100.0 * static_cast<double>(i + 1));
    EXPECT_LE(layout.score, layout.bound + 1e-12);
    EXPECT_LE(layout.read.low, layout.read.mean);
    EXPECT_LE(layout.read.mean, layout.read.high);
    if (i > 0) {
      EXPECT_GE(layout.score, plan.layouts[i - 1].score - 1e-12);
    }
  }
  EXPECT_EQ(plan.chosen, 3U);
  EXPECT_EQ(plan.stopped_by, "limits.antennas");
  ASSERT_EQ(plan.sensitivity.size(), 7U);
  EXPECT_LE(plan.sensitivity[2].read.mean, plan.sensitivity[0].read.mean);
}

TEST(AntennaPlan, IsTheSameForAnyNumberOfThreads) {
  EXPECT_EQ(plan_to_json(planned(small_store(), 1).plan),
            plan_to_json(planned(small_store(), 4).plan));
}

TEST(AntennaPlan, StopsWhereTheAimIsReached) {
  const AntennaPlan plan = planned(small_store("  aim: {share: 0.3}\n")).plan;
  EXPECT_GE(plan.layouts[plan.chosen].score, 0.3);
  EXPECT_TRUE(plan.chosen == 0 || plan.layouts[plan.chosen - 1].score < 0.3);
  EXPECT_TRUE(plan.reaches_aim);
  EXPECT_FALSE(planned(small_store("  aim: {share: 1}\n")).plan.reaches_aim);
}

TEST(AntennaPlan, ChoosesTheCheapestThatIsEnough) {
  // One good mount costs more than two poor ones.
  const std::string text =
      "name: row\nmodel: link_budget\nduration_s: 2\n"
      "plan:\n"
      "  tags:\n"
      "    - {name: row, box: [0, 0, 1, 4, 0, 1], spacing_m: [0.5, 1, 1]}\n"
      "  mounts:\n"
      "    - {name: far, points: [[2, 3, 1]], rpy_deg: [[0, 0, -90]], cost: 500,\n"
      "       profiles: [speedway_r420, panel_6dbi], powers_dbm: [30]}\n"
      "    - {name: near, points: [[1, 1, 1], [3, 1, 1]], rpy_deg: [[0, 0, -90]], cost: 100,\n"
      "       profiles: [speedway_r420, panel_6dbi], powers_dbm: [24]}\n"
      "  limits: {antennas: 3, readers: 1, ports: 4}\n";
  const AntennaPlan few = planned(text + "  aim: {share: 0.95}\n").plan;
  ASSERT_EQ(few.layouts[few.chosen].antennas.size(), 1U);
  EXPECT_DOUBLE_EQ(few.layouts[few.chosen].cost, 500.0);
  const AntennaPlan cheap = planned(text + "  aim: {share: 0.95, minimize: cost}\n").plan;
  const PlannedLayout& layout = cheap.layouts[cheap.chosen];
  EXPECT_DOUBLE_EQ(layout.cost, 200.0);
  EXPECT_EQ(layout.antennas.size(), 2U);
  EXPECT_TRUE(cheap.reaches_aim);
  EXPECT_GE(layout.score, 0.95);
  for (std::size_t i = 0; i + 1 < cheap.layouts.size(); ++i) {
    EXPECT_LT(cheap.layouts[i].antennas.size(), cheap.layouts[i + 1].antennas.size());
  }
  EXPECT_NE(complaint_of(text + "  aim: {minimize: cost}\n").find("no effect without 'share'"),
            std::string::npos);
}

TEST(AntennaPlan, SaysWhichLimitIsAtFault) {
  const auto with_limits = [](const std::string& limits) {
    std::string text = small_store();
    const std::string before = "{antennas: 4, readers: 1, ports: 4}";
    return text.replace(text.find(before), before.size(), limits);
  };
  EXPECT_NE(complaint_of(with_limits("{cost: 50}")).find("plan.limits.cost allows no antenna"),
            std::string::npos);
  // Tags that no power reaches.
  std::string far = small_store();
  const std::string box = "[0, 0, 0.5, 5, 3, 1.5]";
  far.replace(far.find(box), box.size(), "[900, 0, 0.5, 901, 3, 1.5]");
  EXPECT_NE(complaint_of(far).find("no mount reaches any tag"), std::string::npos);
}

TEST(AntennaPlan, GivesEachZoneReadersOfItsOwn) {
  std::string text = small_store();
  text.replace(text.find("ports: 4"), 8, "ports: 2");
  text.replace(text.find("readers: 1"), 10, "readers: 2");
  const Planned all = planned(text);
  const PlannedLayout& layout = all.plan.layouts.back();
  ASSERT_EQ(layout.antennas.size(), 4U);
  EXPECT_EQ(layout.readers, 2U);
  EXPECT_EQ(layout.antennas[0].reader, "reader_1");
  EXPECT_EQ(layout.antennas[3].reader, "reader_2");
}

TEST(AntennaPlan, IsWithinItsRangeOfFullSimulations) {
  const Planned all = planned(small_store());
  RunControl control;
  const PlanCheck check = check_plan(all.to_plan, all.plan.layouts.back(), 1, 20, control);
  ASSERT_EQ(check.read.size(), 20U);
  // 95 % of runs are within the range: for 20 runs, the probability that fewer than 16 are is
  // 0.003.
  EXPECT_GE(check.inside, 16U);
}

TEST(AntennaPlan, AimsAtReads) {
  std::string text = small_store();
  text.replace(text.find("powers_dbm"), 0, "inventory: gen2\n      ");
  const PlannedLayout once = planned(text).plan.layouts.back();
  const Planned all = planned(text + "  aim: {dwell_reads: 10}\n");
  const PlannedLayout& layout = all.plan.layouts[all.plan.chosen];
  for (const PlannedLayout& other : all.plan.layouts) EXPECT_LE(other.share, layout.share);
  EXPECT_GT(layout.read.mean, 0.0);
  EXPECT_LT(layout.read.mean, once.read.mean);
  EXPECT_DOUBLE_EQ(layout.share, layout.read.mean / 60.0);
  const PlanCheck check = check_plan(all.to_plan, layout, 1, 20, {});
  EXPECT_GE(check.inside, 16U);
}

/// A room with mounts at its corners and in the middle of its walls, and a reader that hops over a
/// wide band.
std::string room_to_locate_in(const std::string& aim) {
  return "name: room\nmodel: link_budget\nduration_s: 10\n"
         "plan:\n"
         "  tags:\n"
         "    - {name: shelf, box: [1, 1, 0.9, 3, 3, 0.9], spacing_m: [1, 1, 1], count: 9}\n"
         "  mounts:\n"
         "    - {name: south, line: [[0, 0, 1.2], [4, 0, 1.2]], spacing_m: 2,\n"
         "       rpy_deg: [[0, 0, 90]], profiles: [speedway_r420, panel_6dbi], channel_plan: fcc}\n"
         "    - {name: north, line: [[0, 4, 1.2], [4, 4, 1.2]], spacing_m: 2,\n"
         "       rpy_deg: [[0, 0, -90]], profiles: [speedway_r420, panel_6dbi], channel_plan: "
         "fcc}\n"
         "  limits: {antennas: 4, readers: 1, ports: 4}\n" +
         aim;
}

TEST(AntennaPlan, AimsAtPlaces) {
  const Planned all = planned(room_to_locate_in("  aim: {position_error_m: 0.03, share: 1}\n"));
  const AntennaPlan& plan = all.plan;
  const PlannedLayout& layout = plan.layouts[plan.chosen];
  // Two distances leave two possible positions.
  ASSERT_GE(layout.antennas.size(), 3U);
  EXPECT_DOUBLE_EQ(plan.layouts[1].read.mean, 0.0);
  EXPECT_DOUBLE_EQ(layout.read.mean, 9.0);
  EXPECT_TRUE(plan.reaches_aim);
  ASSERT_EQ(layout.errors_m.size(), plan.places.size());
  for (const double error_m : layout.errors_m) EXPECT_LT(error_m, 0.03);
  for (const double error_m : plan.layouts[1].errors_m) EXPECT_TRUE(std::isinf(error_m));
  const PlanCheck check = check_plan(all.to_plan, layout, 1, 5, {});
  EXPECT_EQ(check.read, std::vector<double>(5, 9.0));
  // An aim that no antennas can meet is not claimed.
  const AntennaPlan never =
      planned(room_to_locate_in("  aim: {position_error_m: 0.001, share: 1}\n")).plan;
  EXPECT_FALSE(never.reaches_aim);
  EXPECT_DOUBLE_EQ(never.layouts.back().read.mean, 0.0);
}

TEST(AntennaPlan, BadAimsAreErrors) {
  EXPECT_NE(complaint_of(small_store("  aim: {dwell_reads: 2, read_probability: 0.9}\n"))
                .find("is given beside 'read_probability', expected one of them"),
            std::string::npos);
  EXPECT_NE(complaint_of(small_store("  aim: {dwell_reads: 0.5}\n")).find("must be at least 1"),
            std::string::npos);
  EXPECT_NE(complaint_of(small_store("  aim: {position_error_m: 0}\n")).find("position_error_m"),
            std::string::npos);
}

/// An antenna that reads a near shelf of its own zone and, with a margin of some 2 dB at 3 m, one
/// of another zone.
std::string two_zones(const std::string& limits) {
  return "name: zones\nmodel: link_budget\nduration_s: 2\n"
         "plan:\n"
         "  dwell_s: 2\n"
         "  margin_db: 6\n"
         "  tags:\n"
         "    - {name: near, zone: a, box: [1, -0.2, 1, 1.2, 0.2, 1], spacing_m: 0.2, count: 6,\n"
         "       orientations: [[0, 0, 0]]}\n"
         "    - {name: far, zone: b, box: [2.8, -0.2, 1, 3, 0.2, 1], spacing_m: 0.2, count: 6,\n"
         "       orientations: [[0, 0, 0]]}\n"
         "  mounts:\n"
         "    - {name: post, zone: a, points: [[0, 0, 1]], rpy_deg: [[0, 0, 0]], powers_dbm: "
         "[20],\n"
         "       profiles: [speedway_r420, panel_6dbi]}\n"
         "  limits: {antennas: 1, readers: 1, ports: 4" +
         limits + "}\n";
}

TEST(AntennaPlan, CountsCrossReadsWithoutTheMarginToSpare) {
  const Planned all = planned(two_zones(""));
  const PlannedLayout& layout = all.plan.layouts.back();
  ASSERT_EQ(layout.zones.size(), 2U);
  // With 6 dB less, only its own tags are read; without the margin, the others are read, too.
  EXPECT_DOUBLE_EQ(layout.read.mean, 6.0);
  EXPECT_DOUBLE_EQ(layout.cross.mean, 6.0);
  EXPECT_DOUBLE_EQ(layout.zones[1].cross.mean, 6.0);
  const PlanCheck check = check_plan(all.to_plan, layout, 1, 3, {});
  EXPECT_EQ(check.read, std::vector<double>(3, 6.0));
  EXPECT_EQ(check.cross, std::vector<double>(3, 6.0));
  EXPECT_EQ(check.cross_inside, 3U);
  EXPECT_NE(
      complaint_of(two_zones(", cross_reads: 0.05")).find("plan.limits.cross_reads allows no"),
      std::string::npos);
}

TEST(AntennaPlan, IsWrittenAsAScenarioThatRuns) {
  const Planned all = planned(small_store());
  TemporaryFolder folder;
  const PlannedLayout& layout = all.plan.layouts.back();
  const std::string text =
      layout_to_yaml(all.path, {}, all.to_plan, layout, 1, folder.path().string());
  Diagnostics diagnostics;
  const Scenario written =
      load_scenario_with_world(folder.with("layout.yaml", text), {}, diagnostics).scenario;
  const Scenario meant = scenario_of_layout(all.to_plan, layout, 1, 0);
  ASSERT_EQ(written.antennas.size(), meant.antennas.size());
  ASSERT_EQ(written.tags.size(), meant.tags.size());
  for (std::size_t i = 0; i < written.antennas.size(); ++i) {
    const AntennaSpec& one = written.antennas[i];
    const AntennaSpec& other = meant.antennas[i];
    EXPECT_EQ(one.parameters.reader, other.parameters.reader);
    EXPECT_TRUE(one.X_PA.translation.isApprox(other.X_PA.translation, 1e-9));
    EXPECT_LT((one.X_PA.rotation * Eigen::Vector3d::UnitX() -
               other.X_PA.rotation * Eigen::Vector3d::UnitX())
                  .norm(),
              1e-9);
  }
  for (std::size_t i = 0; i < written.tags.size(); ++i) {
    EXPECT_EQ(written.tags[i].id, meant.tags[i].id);
    EXPECT_LT(written.tags[i].motion.front().X_WB.rotation.angularDistance(
                  meant.tags[i].motion.front().X_WB.rotation),
              1e-6);
  }
  EXPECT_EQ(written.localization.method, kNoLocalization);
}

}  // namespace
}  // namespace tagfield
