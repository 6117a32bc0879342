// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/plan_page.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace tagfield {
namespace {

AntennaPlan two_layouts() {
  AntennaPlan plan;
  plan.scenario = "a <shop>";
  plan.dwell_s = 5.0;
  plan.tags = 10;
  plan.options = 4;
  plan.places = {{"shelf</script>", "north", {0, 0, 1}}, {"shelf", "south", {2, 1, 2}}};
  for (const double p : {0.5, 1.0}) {
    PlannedLayout layout;
    layout.antennas.resize(plan.layouts.size() + 1);
    for (PlannedAntenna& antenna : layout.antennas) {
      antenna.name = antenna.mount = "m, 1";
      antenna.reader = "reader_1";
    }
    layout.score = layout.share = p;
    layout.read = {10.0 * p, 8.0 * p, 10.0 * p};
    layout.places = {p, 1.0};
    layout.zones = {{"north", 5, {}, {0.5, 0.0, 1.0}}, {"south", 5, {}, {}}};
    plan.layouts.push_back(layout);
  }
  plan.chosen = 1;
  plan.hard = {{0, 0.5, "m, 1", 1.0, -2.0, "too weak"}};
  plan.sensitivity = {{"as planned", {10, 9, 10}}};
  return plan;
}

TEST(PlanPage, HoldsAllAndNothingBreaksOut) {
  const AntennaPlan plan = two_layouts();
  const std::vector<Figure> figures = plan_figures(plan, {});
  ASSERT_EQ(figures.size(), 3U);  // Two levels and the curve.
  const std::string page = plan_page(plan, figures);
  EXPECT_NE(page.find("a &lt;shop&gt;"), std::string::npos);
  EXPECT_EQ(page.find("shelf</script>"), std::string::npos);
  EXPECT_NE(page.find("id=\"plan-count\""), std::string::npos);
  EXPECT_NE(page.find("too weak"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
  EXPECT_NE(page.find("data-key=\"reader0\""), std::string::npos);
  EXPECT_NE(page.find("aria-label=\"Zones\""), std::string::npos);
  EXPECT_EQ(page.find("role=\"region\" tabindex"), std::string::npos);  // Each has a name.
  const std::string begin = "id=\"plan-data\">";
  const std::size_t at = page.find(begin) + begin.size();
  const auto data = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
  EXPECT_EQ(data["layouts"][0]["places"], (std::vector<int>{50, 100}));
}

TEST(AntennaPlan, IsTables) {
  const AntennaPlan plan = two_layouts();
  EXPECT_EQ(plan_layouts_to_csv(plan),
            "antennas,readers,cost,score,share,bound,read_mean,read_low,read_high,cross_worst\n"
            "1,0,0,0.500000,0.500000,1.000000,5.00,4.00,5.00,0.10000\n"
            "2,0,0,1.000000,1.000000,1.000000,10.00,8.00,10.00,0.10000\n");
  EXPECT_EQ(plan_positions_to_csv(plan).substr(0, 33), "group,zone,x_m,y_m,z_m,p_1,p_2\nsh");
  EXPECT_NE(plan_antennas_to_csv(plan).find("2,\"m, 1\",\"m, 1\",reader_1,"), std::string::npos);
  const auto json = nlohmann::json::parse(plan_to_json(plan));
  EXPECT_EQ(json["chosen_antennas"], 2);
  EXPECT_EQ(json["layouts"][0]["gap"], 0.5);
  EXPECT_EQ(json["layouts"][0]["share"], 0.5);
  EXPECT_EQ(json["counts"], "read");
  EXPECT_EQ(json["aim_read_probability"], 1.0);
  EXPECT_TRUE(json["aim_position_error_m"].is_null());
}

TEST(AntennaPlan, HoldsBoundsOnPlaces) {
  AntennaPlan plan = two_layouts();
  plan.aim = {PlannedAim::Kind::kPosition, 0.25, 0.9};
  plan.aim.is_for_least_cost = true;
  plan.layouts[0].errors_m = {std::numeric_limits<double>::infinity(), 0.31};
  plan.layouts[1].errors_m = {0.12, 0.11};
  const std::string table = plan_positions_to_csv(plan);
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "group,zone,x_m,y_m,z_m,p_1,p_2,error_m_1,error_m_2");
  EXPECT_NE(table.find("0.5000,1.0000,,0.1200\n"), std::string::npos) << table;
  EXPECT_NE(table.find("1.0000,1.0000,0.3100,0.1100\n"), std::string::npos) << table;
  const auto json = nlohmann::json::parse(plan_to_json(plan));
  EXPECT_EQ(json["aim_position_error_m"], 0.25);
  EXPECT_EQ(json["aim_minimize"], "cost");
  const std::string page = plan_page(plan, plan_figures(plan, {}));
  EXPECT_NE(page.find("each tag locatable to within 0.25 m in 5 s, to 90 % at the least cost"),
            std::string::npos);
  EXPECT_NE(page.find("error 0.12 m at best"), std::string::npos);
  EXPECT_EQ(page.find("inf m"), std::string::npos);
}

}  // namespace
}  // namespace tagfield
