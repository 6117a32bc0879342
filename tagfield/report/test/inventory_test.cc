// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tagfield/report/internal/inventory_figures.h"
#include "tagfield/report/internal/inventory_section.h"
#include "tagfield/report/run_files.h"
#include "tagfield/report/summary.h"
#include "tagfield/report/svg.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

InventorySummary run_of(double read, std::optional<double> time_s) {
  InventorySummary run;
  run.tags = 10;
  run.duration_s = 2.0;
  run.read = run.min_read = run.max_read = read;
  run.reads = 4.0 * read;
  run.median_reads = 4.0;
  run.reached = {{0.5, time_s}};
  run.readers = {{"door", "door", read, read, 4.0 * read}};
  run.antennas = {{"a", "door", read, read, 4.0 * read}};
  run.zones = {{"near <door>", {"door"}, 10, read, read, 1.0, {{"yard", 1.0, 3.0}}}};
  run.levels = {{0.5, 0.5, 4, 2.0}, {1.5, 1.5, 6, read - 2.0}};
  return run;
}

TEST(Inventory, OfSeveralRunsIsTheirMean) {
  const InventorySummary mean = mean_of({run_of(6.0, 0.4), run_of(9.0, 0.8)});
  EXPECT_DOUBLE_EQ(mean.read, 7.5);
  EXPECT_DOUBLE_EQ(mean.min_read, 6.0);
  EXPECT_DOUBLE_EQ(mean.max_read, 9.0);
  EXPECT_DOUBLE_EQ(mean.antennas[0].reads, 30.0);
  EXPECT_DOUBLE_EQ(mean.zones[0].read, 7.5);
  EXPECT_DOUBLE_EQ(mean.zones[0].cross[0].reads, 3.0);
  EXPECT_DOUBLE_EQ(mean.levels[1].read, 5.5);
  EXPECT_NEAR(*mean.reached[0].time_s, 0.6, 1e-12);
  // A share that one run did not reach has no mean time.
  EXPECT_FALSE(mean_of({run_of(6.0, 0.4), run_of(4.0, std::nullopt)}).reached[0].time_s);
}

TEST(Inventory, OfRunsThatReadAllTagsIsExactlyAll) {
  // A fifth of 23, added five times, is 23.000000000000004.
  InventorySummary run;
  run.tags = 23;
  run.read = run.min_read = run.max_read = 23.0;
  run.antennas = {{"a", "door", 23.0, 23.0, 349.0}};
  run.zones = {{"yard", {"door"}, 23, 23.0, 23.0, 23.0, {{"gate", 23.0, 61.0}}}};
  run.levels = {{0.5, 0.5, 0, 0.0}, {1.5, 1.5, 23, 23.0}};
  for (std::size_t runs = 1; runs <= 60; ++runs) {
    const InventorySummary mean = mean_of(std::vector<InventorySummary>(runs, run));
    EXPECT_EQ(mean.read, 23.0) << runs;
    EXPECT_EQ(mean.antennas[0].reads, 349.0) << runs;
    EXPECT_EQ(mean.zones[0].read_by_own, 23.0) << runs;
    EXPECT_EQ(mean.zones[0].cross[0].reads, 61.0) << runs;
    EXPECT_EQ(mean.levels[1].read, 23.0) << runs;
  }
  Summary summary;
  summary.inventory = mean_of(std::vector<InventorySummary>(5, run));
  EXPECT_EQ(inventory_tables(summary).find("99.9 %"), std::string::npos);
  // One of 10,000 missed in one of two runs must not round up to all.
  EXPECT_EQ(percent_of(9999.5, 10000.0), "99.9 %");
  EXPECT_EQ(percent_of(0.5, 10000.0), "0.1 %");
  EXPECT_EQ(percent_of(10000.0, 10000.0), "100 %");
  EXPECT_EQ(percent_of(0.0, 10000.0), "0 %");
}

TEST(Inventory, IsOnThePage) {
  Summary summary;
  summary.method = "none";
  summary.inventory = run_of(9.0, std::nullopt);
  EXPECT_TRUE(is_inventory_alone(summary));
  EXPECT_EQ(inventory_sentence(*summary.inventory, 1),
            "9 of 10 tags read in 2.0 s (90.0 %), 1 missed.");
  const std::string numbers = inventory_numbers(*summary.inventory);
  EXPECT_NE(numbers.find("90.0 %"), std::string::npos);
  EXPECT_NE(numbers.find("not reached"), std::string::npos);
  const std::string tables = inventory_tables(summary);
  EXPECT_NE(tables.find("near &lt;door&gt;"), std::string::npos);
  EXPECT_NE(tables.find("yard: 1 tag (3 reads)"), std::string::npos);
  EXPECT_NE(tables.find("1.50 m"), std::string::npos);
  EXPECT_EQ(tables.find("<th scope=\"col\"></th>"), std::string::npos);
}

TEST(Inventory, NamesOfAntennasAreNotCutOff) {
  RunFiles run;
  run.summary.inventory = run_of(9.0, 0.5);
  const std::vector<std::string> names = {"dock_door_north_left_upper_port_1",
                                          "dock_door_north_right_upper_port_1",
                                          "WWWWWWWWWWWWWWWWWW"};
  run.summary.inventory->antennas.clear();
  for (const std::string& name : names) {
    run.summary.inventory->antennas.push_back({name, "door", 9.0, 3.0, 36.0});
  }
  const std::string body = inventory_antennas_figure(run).svg.body;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NE(body.find("<title>" + names[i] + "</title>"), std::string::npos) << names[i];
  }
  // No letter is wider than the font is high, so the widest name has room to the left.
  const std::size_t place = body.find("text-anchor=\"end\"");
  ASSERT_NE(place, std::string::npos);
  const std::size_t x = body.rfind("x=\"", place);
  EXPECT_GE(std::stod(body.substr(x + 3)), kFontSize * 18.0);
}

TEST(Inventory, ComesBackFromItsJson) {
  Summary summary;
  summary.method = "none";
  summary.inventory = run_of(9.0, 0.5);
  summary.inventory->without = {{"a", 3.0}};
  const std::string text = to_json(summary);
  EXPECT_EQ(to_json(summary_from_json(text, "summary.json")), text);
}

}  // namespace
}  // namespace tagfield
