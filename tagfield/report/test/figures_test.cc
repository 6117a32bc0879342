// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

#include "tagfield/report/test/balanced_tags.h"
#include "tagfield/report/test/run_folder.h"

namespace tagfield {
namespace {

using Names = std::vector<std::string>;

struct Made {
  Names drawn;
  Names missing;
  std::vector<Figure> figures;
};

Made make(const FolderPlan& plan) {
  const RunFolder folder(plan);
  Made made;
  made.figures = all_figures(read_run_files(folder.path()));
  for (const Figure& figure : made.figures) {
    (figure.missing.empty() ? made.drawn : made.missing).push_back(figure.name);
  }
  return made;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

const Figure& find(const Made& made, const std::string& name) {
  return *std::find_if(made.figures.begin(), made.figures.end(),
                       [&](const Figure& figure) { return figure.name == name; });
}

TEST(AllFigures, OfOneSeedAreThePapers) {
  EXPECT_EQ(make({}).drawn, (Names{"fig09_map", "fig10_errors", "fig12_phase_distance",
                                   "fig13_rssi_path", "fig14_rssi_fixed", "fig14_rssi_values"}));
}

TEST(AllFigures, OfSeveralSeedsHoldADistribution) {
  FolderPlan plan;
  plan.seeds = {1, 2};
  const Made made = make(plan);
  EXPECT_EQ(std::count(made.drawn.begin(), made.drawn.end(), "fig10_distribution"), 1);
}

TEST(AllFigures, OfALiftedAntennaHoldItsHeight) {
  FolderPlan plan;
  plan.lift_m = 0.5;
  const Made made = make(plan);
  EXPECT_EQ(std::count(made.drawn.begin(), made.drawn.end(), "fig11_antenna_height"), 1);
}

TEST(AllFigures, WithoutAFixedAntennaSaySo) {
  FolderPlan plan;
  plan.fixed = false;
  EXPECT_EQ(make(plan).missing, (Names{"fig14_rssi_fixed"}));
}

TEST(AllFigures, WithoutAMovingAntennaSaySo) {
  FolderPlan plan;
  plan.moving = false;
  EXPECT_EQ(make(plan).missing, (Names{"fig12_phase_distance", "fig13_rssi_path"}));
}

TEST(AllFigures, OfAReaderThatHopsHoldAHologramForThePhase) {
  FolderPlan plan;
  plan.carriers_hz = {865.7e6, 866.3e6, 866.9e6};
  const Made made = make(plan);
  EXPECT_EQ(std::count(made.drawn.begin(), made.drawn.end(), "fig12_phase_distance"), 0);
  ASSERT_EQ(std::count(made.drawn.begin(), made.drawn.end(), "hologram"), 1);
  EXPECT_NE(find(made, "hologram").caption.find("on 3 carriers"), std::string::npos);
}

TEST(AllFigures, OfAReaderThatHopsAtRestHoldThePhaseByCarrier) {
  FolderPlan plan;
  plan.moving = false;
  const RunFolder folder(plan);
  folder.put("reads.csv",
             "stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n"
             "0,reader,fixed,tag1,865.7e6,1,-50\n0.1,reader,fixed,tag1,866.3e6,2,-50\n");
  Made made;
  for (const Figure& figure : all_figures(read_run_files(folder.path()))) {
    made.drawn.push_back(figure.name);
  }
  EXPECT_EQ(std::count(made.drawn.begin(), made.drawn.end(), "phase_by_carrier"), 1);
}

TEST(Hologram, IsBrightestWhereThePhasesComeFrom) {
  FolderPlan plan;
  plan.carriers_hz = {865.7e6, 866.3e6, 866.9e6};
  const Made made = make(plan);
  // From the data on the page: the cells around the true position, at the centre, agree with all
  // phases of the generated run, whatever each carrier's offset.
  std::istringstream rows(find(made, "hologram").data);
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "x_m,y_m,agreement");
  double most = 0.0;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  while (std::getline(rows, row)) {
    std::array<double, 3> cell{};
    std::sscanf(row.c_str(), "%lf,%lf,%lf", &cell[0], &cell[1], &cell[2]);
    sum += Eigen::Vector2d(cell[0], cell[1]);
    ++count;
    if (cell[2] <= most) continue;
    most = cell[2];
    at = {cell[0], cell[1]};
  }
  ASSERT_EQ(count, 64 * 64);
  // The true position is the window's centre, a corner of cells of 2 cm.
  EXPECT_LT((at - sum / count).norm(), 0.05);
  EXPECT_GT(most, 0.9);
}

TEST(AllFigures, WithoutReadsSaySo) {
  FolderPlan plan;
  plan.reads = false;
  EXPECT_EQ(make(plan).missing,
            (Names{"fig12_phase_distance", "fig13_rssi_path", "fig14_rssi_fixed"}));
}

TEST(AllFigures, WithoutTruthSayThatErrorsAreUnknown) {
  FolderPlan plan;
  plan.truth = false;
  plan.top_view = false;
  EXPECT_EQ(make(plan).missing, (Names{"fig10_errors"}));
}

TEST(AllFigures, AreWellFormed) {
  FolderPlan plan;
  plan.lift_m = 1.0;
  plan.seeds = {1, 2, 3};
  plan.tags = {"<script>", "\"&'", "ta\x01g"};
  for (const Figure& figure : make(plan).figures) {
    EXPECT_EQ(unbalanced_tag(standalone_svg(figure.svg, figure.title, figure.caption)), "")
        << figure.name;
    EXPECT_GT(figure.svg.height, 100.0) << figure.name;
  }
}

TEST(MapFigure, MarksEachTagAndEstimate) {
  const Figure figure = find(make({}), "fig09_map");
  EXPECT_EQ(count_of(figure.svg.body, "true position:"), 3U);
  EXPECT_EQ(count_of(figure.svg.body, "estimate: "), 3U);
  EXPECT_EQ(count_of(figure.svg.body, "class=\"wall\""), 1U);
  EXPECT_EQ(count_of(figure.svg.body, "class=\"believed\""), 0U);
}

TEST(MapFigure, JoinsWhatIsAmbiguous) {
  const RunFolder folder(FolderPlan{});
  Summary summary = summary_of({});
  summary.tags[0].estimate.verdict = Verdict::kAmbiguous;
  summary.tags[0].estimate.candidates.push_back({{1.0, 1.0, 1.0}, 0.0, 0.0});
  folder.put("summary.json", to_json(summary));
  const Figure figure = map_figure(read_run_files(folder.path()));
  EXPECT_EQ(count_of(figure.svg.body, "class=\"pair\""), 1U);
}

TEST(MapFigure, LeavesOutAnEstimateFarAstray) {
  const RunFolder folder(FolderPlan{});
  Summary summary = summary_of({});
  summary.tags[0].estimate.candidates[0].p_WT.x() = 1e6;
  folder.put("summary.json", to_json(summary));
  const Figure figure = map_figure(read_run_files(folder.path()));
  EXPECT_NE(figure.caption.find("1 estimate lies beyond"), std::string::npos) << figure.caption;
}

TEST(PhaseFigure, AgreesWithTheTruthWherePhaseHasNoNoise) {
  const Figure figure = find(make({}), "fig12_phase_distance");
  EXPECT_GT(count_of(figure.svg.body, "class=\"measured\""), 300U);
  EXPECT_EQ(count_of(figure.svg.body, "<polyline"), 1U);
}

TEST(PhaseFigure, DoesWithoutTruth) {
  FolderPlan plan;
  plan.truth = false;
  const Figure figure = find(make(plan), "fig12_phase_distance");
  EXPECT_EQ(count_of(figure.svg.body, "true-line"), 0U);
}

TEST(ErrorFigure, OfManyTagsIsAHistogram) {
  FolderPlan plan;
  plan.tags = many_tags(60);
  const Figure figure = find(make(plan), "fig10_errors");
  EXPECT_EQ(count_of(figure.svg.body, "class=\"bar\""), 1U);  // All errors are 10 mm.
  EXPECT_NE(figure.svg.body.find("60 errors"), std::string::npos);
}

TEST(ErrorFigure, TakesErrorsOfNothing) {
  FolderPlan plan;
  plan.error_m = 0.0;
  plan.seeds = {1, 2};
  const Made made = make(plan);
  EXPECT_EQ(unbalanced_tag(find(made, "fig10_errors").svg.body), "");
  EXPECT_EQ(unbalanced_tag(find(made, "fig10_distribution").svg.body), "");
}

TEST(AllFigures, OfThousandsOfTagsStaySmall) {
  FolderPlan plan;
  plan.tags = many_tags(3000);
  plan.moving = false;
  for (const Figure& figure : make(plan).figures) {
    EXPECT_LT(figure.svg.body.size(), 500'000U) << figure.name;
  }
}

TEST(Thinning, KeepsToTheMost) {
  EXPECT_EQ(thinning(0, 10), 1U);
  EXPECT_EQ(thinning(10, 10), 1U);
  EXPECT_EQ(thinning(11, 10), 2U);
  EXPECT_EQ(thinning(100, 10), 10U);
}

}  // namespace
}  // namespace tagfield
