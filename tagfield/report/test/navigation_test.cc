// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tagfield/base/units.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/map/map_file.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/tables.h"
#include "tagfield/report/page.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/test/balanced_tags.h"
#include "tagfield/report/test/run_folder.h"
#include "tagfield/report/test/text_holds.h"

namespace tagfield {
namespace {

Summary navigated_summary() {
  Summary summary = summary_of({});
  summary.pose = "slam";
  summary.pose_error = PoseErrorSummary{0.01, 5.0, 0.0, 0.0141, statistics({0.004})};
  NavigationSummary navigation;
  navigation.walls_found = 0.9996;
  navigation.floor_known = 0.987;
  navigation.mapping_path_m = 26.91;
  navigation.mapping_s = 79.45;
  navigation.position_error_m = statistics({0.010, 0.014});
  navigation.yaw_error_rad = statistics({radians(0.5)});
  navigation.goals = 5;
  navigation.goals_reached = 4;
  navigation.closest_m = 0.49;
  navigation.goals_unreached = {{7, {3.0, 1.5, 0.0}, "no way <there>"}};
  navigation.kidnapped =
      FindingSummary{20, 20, 18, 1, statistics({10.0, 30.0}), statistics({2.0, 6.0})};
  summary.navigation = navigation;
  return summary;
}

/// 4 m × 2 m from (-1, -1) on: free, except for a column of walls and one unknown cell.
OccupancyGrid small_map() {
  OccupancyGrid grid;
  grid.resolution_m = 0.5;
  grid.width = 8;
  grid.height = 4;
  grid.origin = {-1.0, -1.0};
  grid.cells.assign(32, 0);
  for (int y = 0; y < 4; ++y) grid.cells[grid.index(7, y)] = 100;
  grid.cells[0] = -1;
  return grid;
}

std::string way_csv(double aside_m) {
  std::vector<AntennaPose> poses;
  for (int i = 0; i < 5; ++i) {
    poses.push_back({time_from_seconds(i), "robot", from_planar(0.3 * i, aside_m, 0.0)});
  }
  return poses_to_csv(poses);
}

/// A run whose believed mapping path is offset by 20 mm from the true one.
void put_navigation(const RunFolder& folder) {
  folder.put("summary.json", to_json(navigated_summary()));
  folder.put("map.yaml", map_to_yaml(small_map(), "map.pgm"));
  folder.put("map.pgm", map_to_pgm(small_map()));
  folder.put("mapping_path.csv", way_csv(0.02));
  folder.put("truth/mapping_path.csv", way_csv(0.0));
}

/// From `from_s` on, the moving antenna's believed pose is off by 30 mm and 2°.
void put_believed_poses(const RunFolder& folder, double from_s) {
  std::vector<AntennaPose> poses = read_poses_csv(folder.path() + "/antenna_poses.csv");
  for (AntennaPose& pose : poses) {
    if (pose.antenna == "fixed" || to_seconds(pose.stamp) < from_s) continue;
    pose.X_WA.translation += Eigen::Vector3d(0.018, -0.024, 0.5);
    pose.X_WA.rotation = from_planar(0.0, 0.0, radians(-2.0)).rotation * pose.X_WA.rotation;
  }
  folder.put("antenna_poses.csv", poses_to_csv(poses));
}

TEST(RobotMapFigure, ShowsCellsAndWays) {
  const RunFolder folder(FolderPlan{});
  put_navigation(folder);
  const Figure figure = robot_map_figure(read_run_files(folder.path()));
  EXPECT_EQ(figure.missing, "");
  // The wall in cells: a column from x = 7 to 8; the free rest lacks the cell (0, 0).
  EXPECT_TRUE(holds(figure.svg.body, "d=\"M7,0h1v4h-1v-4z\" class=\"map-occupied\""));
  EXPECT_TRUE(holds(figure.svg.body, "d=\"M1,0h6v4h-7v-3h1v-1z\" class=\"map-free\""))
      << figure.svg.body;
  EXPECT_TRUE(holds(figure.svg.body, "class=\"mapping\""));
  EXPECT_TRUE(holds(figure.svg.body, "class=\"mapping-true\""));
  EXPECT_TRUE(holds(figure.caption, "20 mm apart on average")) << figure.caption;
  EXPECT_EQ(unbalanced_tag(standalone_svg(figure.svg, "a", "b")), "");
}

TEST(RobotMapFigure, OfAGivenMapHasNoWay) {
  const RunFolder folder(FolderPlan{});
  put_navigation(folder);
  folder.remove("mapping_path.csv");
  folder.remove("truth/mapping_path.csv");
  const Figure figure = robot_map_figure(read_run_files(folder.path()));
  EXPECT_EQ(figure.title, "Map given to the robot");
  EXPECT_FALSE(holds(figure.svg.body, "class=\"mapping"));
}

TEST(RobotMapFigure, SaysThatTheMapIsMissing) {
  const RunFolder folder(FolderPlan{});
  folder.put("summary.json", to_json(navigated_summary()));
  EXPECT_EQ(robot_map_figure(read_run_files(folder.path())).missing, "there is no map.yaml.");
}

TEST(PoseErrorFigure, HoldsMeanAndQuantile) {
  const RunFolder folder(FolderPlan{});
  put_navigation(folder);
  put_believed_poses(folder, 0.0);
  const Figure figure = pose_error_figure(read_run_files(folder.path()));
  EXPECT_TRUE(holds(figure.svg.body, ">mean 30 mm<")) << figure.svg.body;
  EXPECT_TRUE(holds(figure.svg.body, ">95 % within 30 mm<"));
  EXPECT_TRUE(holds(figure.svg.body, ">mean 2.00°<"));
}

TEST(PoseErrorFigure, CountsTheTimeWithoutError) {
  const RunFolder folder(FolderPlan{});  // 200 poses from 0 to 19.9 s.
  put_navigation(folder);
  put_believed_poses(folder, 10.0);
  const Figure figure = pose_error_figure(read_run_files(folder.path()));
  EXPECT_TRUE(holds(figure.svg.body, ">mean 15 mm<"));
  EXPECT_TRUE(holds(figure.svg.body, ">mean 1.00°<"));
  EXPECT_TRUE(holds(figure.svg.body, "maximum: 30 mm at 1"));
}

TEST(PoseErrorFigure, NeedsTheTruth) {
  FolderPlan plan;
  plan.truth = false;
  const RunFolder folder(plan);
  EXPECT_EQ(pose_error_figure(read_run_files(folder.path())).missing,
            "no antenna moves whose true path is known.");
}

TEST(NavigationTable, SaysInWords) {
  EXPECT_EQ(navigation_table(summary_of({})), "");
  const std::string table = navigation_table(navigated_summary());
  EXPECT_EQ(unbalanced_tag(table), "");
  EXPECT_TRUE(holds(table, "Walls found</th><td>99.9 %</td>")) << table;
  EXPECT_TRUE(holds(table, "False walls</th><td>0 %</td>"));
  EXPECT_TRUE(holds(table, "Mapping</th><td>26.9 m</td>"));
  EXPECT_TRUE(holds(table, "in 79 s of simulated time"));
  EXPECT_TRUE(holds(table, "Position off by</th><td>12 mm</td>"));
  EXPECT_TRUE(holds(table, "by less than 14 mm, 14 mm at most"));
  EXPECT_TRUE(holds(table, "Heading off by</th><td>0.50°</td>"));
  EXPECT_TRUE(holds(table, "4 of 5"));
  EXPECT_TRUE(holds(table, "Minimum distance</th><td>490 mm</td>"));
  EXPECT_TRUE(holds(table, "Not reached</th><td>(3.00, 1.50) m</td>")) << table;
  EXPECT_TRUE(holds(table, "with seed 7: no way &lt;there&gt;"));
  EXPECT_TRUE(holds(table, "Collisions</th><td>0</td>"));
  EXPECT_TRUE(holds(table, "Kidnapped</th><td>18 of 20</td>"));
  EXPECT_TRUE(holds(table,
                    "4.0 m and 20 s on average, 6.0 m and 30 s at most; mistook another place for "
                    "its own 1 time"));
  EXPECT_FALSE(holds(table, "Unknown starts"));
}

TEST(RunFacts, StateNoNoiseOfARobotThatFindsItsWay) {
  Summary summary = navigated_summary();
  EXPECT_FALSE(holds(run_facts(summary), "Stated pose error"));
  EXPECT_TRUE(holds(run_facts(summary), "With the true pose the same reads give 4.0 mm"));
  summary.pose = "odometry";
  EXPECT_FALSE(holds(run_facts(summary), "Stated pose error"));
  summary.pose = "noisy";
  EXPECT_TRUE(holds(run_facts(summary), "Stated pose error"));
}

TEST(WriteReport, ShowsNavigationOnlyWhereThereWasSome) {
  const RunFolder folder(FolderPlan{});
  put_navigation(folder);
  write_report(folder.path());
  const std::string page = folder.text("report.html");
  EXPECT_TRUE(holds(page, "<figure id=\"fig06_robot_map\">"));
  EXPECT_TRUE(holds(page, "<figure id=\"pose_error\">"));
  EXPECT_FALSE(holds(page, "( of the paper)"));
  EXPECT_EQ(unbalanced_tag(page), "");
  folder.put("summary.json", to_json(summary_of({})));
  write_report(folder.path());
  EXPECT_FALSE(holds(folder.text("report.html"), "fig06_robot_map"));
  EXPECT_FALSE(holds(folder.text("report.html"), "<h2>Navigation"));
}

}  // namespace
}  // namespace tagfield
