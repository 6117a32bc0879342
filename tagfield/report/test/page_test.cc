// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/page.h"

#include <gtest/gtest.h>

#include "tagfield/base/error.h"
#include "tagfield/report/page_script.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/test/balanced_tags.h"
#include "tagfield/report/test/run_folder.h"
#include "tagfield/report/test/text_holds.h"

namespace tagfield {
namespace {

/// The page made from a plan.
std::string page_of(const FolderPlan& plan) {
  const RunFolder folder(plan);
  write_report(folder.path());
  return folder.text("report.html");
}

std::size_t scripts_in(const std::string& page) {
  std::size_t count = 0;
  for (std::size_t at = page.find("<script"); at != std::string::npos;
       at = page.find("<script", at + 1)) {
    ++count;
  }
  return count;
}

TEST(WriteReport, LetsNoScriptRunButTheViewsAndItsOwn) {
  const RunFolder folder(FolderPlan{});
  write_report(folder.path());
  const std::string own = std::string("'") + table_script().hash + "' '" + figure_script().hash +
                          "' '" + link_script().hash + "'";
  EXPECT_TRUE(holds(folder.text("report.html"), "; script-src " + own + "; "));
  write_report(folder.path(), [](const RunFiles&) {
    return RunView{"<div id=\"view\"></div>\n", "sha256-abc="};
  });
  const std::string page = folder.text("report.html");
  EXPECT_TRUE(holds(page, "default-src 'none'; script-src 'sha256-abc=' " + own + "; "));
  EXPECT_TRUE(holds(page, "<h2>The run over time</h2>\n<div id=\"view\"></div>\n</section>\n"));
  EXPECT_EQ(unbalanced_tag(page), "");
}

TEST(WriteReport, DrawsEachFigureOnThePageAndAsAFile) {
  const RunFolder folder(FolderPlan{});
  write_report(folder.path());
  const std::string page = folder.text("report.html");
  EXPECT_EQ(unbalanced_tag(page), "");
  for (const std::string name : {"fig09_map", "fig10_errors", "fig12_phase_distance",
                                 "fig13_rssi_path", "fig14_rssi_fixed", "fig14_rssi_values"}) {
    EXPECT_TRUE(holds(page, std::string("<figure id=\"").append(name).append("\">"))) << name;
    EXPECT_EQ(unbalanced_tag(folder.text(std::string("figures/").append(name).append(".svg"))), "")
        << name;
    EXPECT_FALSE(folder.text(std::string("figures/").append(name).append(".svg")).empty()) << name;
  }
}

TEST(WriteReport, GivesTheSameBytes) { EXPECT_EQ(page_of({}), page_of({})); }

TEST(WriteReport, AsksForNothing) {
  const std::string page = page_of({});
  EXPECT_TRUE(holds(page, "default-src 'none'"));
  EXPECT_EQ(scripts_in(page), 3U);  // For tables, for figures, and for the links between them.
  for (const std::string alien : {"<link", "<img", "src=", "http://", "https://"}) {
    EXPECT_FALSE(holds(page, alien)) << alien;
  }
  // Links save data embedded in the page.
  for (std::size_t at = page.find("href="); at != std::string::npos;
       at = page.find("href=", at + 1)) {
    EXPECT_EQ(page.substr(at, 20), "href=\"data:text/csv;");
  }
}

TEST(WriteReport, OffersWhatEachFigureShows) {
  FolderPlan plan;
  plan.error_m = 0.0125;
  const std::string page = page_of(plan);
  EXPECT_TRUE(holds(page,
                    "download=\"fig10_errors.csv\" href=\"data:text/csv;charset=utf-8,"
                    "tag,seed,error_mm%0Atag1,1,12.5%0A"));
  for (const std::string name : {"fig09_map", "fig12_phase_distance", "fig13_rssi_path",
                                 "fig14_rssi_fixed", "fig14_rssi_values"}) {
    EXPECT_TRUE(holds(page, std::string("download=\"").append(name).append(".csv\""))) << name;
  }
}

TEST(WriteReport, OpensWithTracksWhereTheyLieBesideIt) {
  const RunFolder folder(FolderPlan{});
  folder.put("tracks.json",
             R"({"tracked":2,"ambiguous":1,"not_tracked":0,"along_m":{"mean":0.004},"across_m":)"
             R"({"mean":0.006},"orders":[{"passed":"line","pairs":1,"right":1}]})");
  folder.put("order.csv",
             "passed,rank,tag,stamp_s,sigma_s,before_next\nline,1,tag2,1.0,0.01,0.99\n"
             "line,2,<b>,1.5,0.01,\n");
  write_report(folder.path());
  const std::string page = folder.text("report.html");
  EXPECT_TRUE(holds(page, "2 of 3 tags tracked, 1 ambiguous."));
  EXPECT_TRUE(holds(page, "2 tags passed the line, first to last: tag2, &lt;b&gt;."));
  EXPECT_TRUE(holds(page, "Neighbours in the right order: at the line 1 of 1."));
  EXPECT_TRUE(holds(page, "<figure id=\"passings\">"));
  EXPECT_TRUE(holds(page, "<h2>Order</h2>"));
  EXPECT_EQ(unbalanced_tag(page), "");
  folder.put("order.csv", "passed,tag\nline,tag2\n");
  EXPECT_THROW(write_report(folder.path()), Error);
}

TEST(WriteReport, OfTagsThatMovedDoesNotOpenWithNoneLocated) {
  const RunFolder folder(FolderPlan{});
  Summary summary = summary_of({});
  for (TagOutcome& tag : summary.tags) {
    tag.moved = true;
    tag.truth_m.reset();
    tag.estimate.verdict = Verdict::kNotLocated;
    tag.estimate.candidates.clear();
    tag.reads = 7;
  }
  folder.put("summary.json", to_json(summary));
  write_report(folder.path());
  const std::string page = folder.text("report.html");
  EXPECT_FALSE(holds(page, "0 of 3"));
  EXPECT_TRUE(holds(page, "3 of 3 tags read, "));
}

TEST(WriteReport, LeadsWithFigures) {
  const RunFolder folder(FolderPlan{});
  Summary summary = summary_of({});
  summary.compared_methods.resize(2);
  summary.effects.resize(1);
  folder.put("summary.json", to_json(summary));
  write_report(folder.path(), [](const RunFiles&) {
    return RunView{"<div id=\"view\"></div>\n", "sha256-abc="};
  });
  const std::string page = folder.text("report.html");
  EXPECT_TRUE(holds(page, "<h2>Methods</h2>"));
  EXPECT_LT(page.find("<div id=\"view\">"), page.find("<figure"));
  EXPECT_LT(page.rfind("<figure"), page.find("<table"));
  EXPECT_EQ(unbalanced_tag(page), "");
}

TEST(WriteReport, MakesHostileNamesHarmless) {
  FolderPlan plan;
  plan.tags = {"<script>alert(1)</script>", "\"><img src=x onerror=alert(1)>", "'"};
  const std::string page = page_of(plan);
  EXPECT_EQ(scripts_in(page), 3U);
  EXPECT_FALSE(holds(page, "<img"));
  EXPECT_EQ(unbalanced_tag(page), "");
}

TEST(WriteReport, RemovesFiguresOfAnOlderReport) {
  const RunFolder folder(FolderPlan{});
  folder.put("figures/fig99_old.svg", "<svg/>");
  folder.put("figures/somebodys.svg", "<svg/>");
  folder.put(".tagfield", "figures/fig99_old.svg\n");
  write_report(folder.path());
  EXPECT_EQ(folder.text("figures/fig99_old.svg"), "");
  EXPECT_EQ(folder.text("figures/somebodys.svg"), "<svg/>");
}

TEST(WriteReport, ReplacesNothingIfAFileIsBad) {
  const RunFolder folder(FolderPlan{});
  folder.put("report.html", "old");
  folder.put(".tagfield", "report.html\n");
  folder.put("reads.csv", "nonsense");
  EXPECT_THROW(write_report(folder.path()), Error);
  EXPECT_EQ(folder.text("report.html"), "old");
}

TEST(WriteReport, ComesWithoutReads) {
  FolderPlan plan;
  plan.reads = false;
  EXPECT_TRUE(holds(page_of(plan), "the moving antenna read no tag."));
}

TEST(WriteReport, NeedsItsFiles) {
  for (const std::string name : {"summary.json", "reads.csv", "antenna_poses.csv"}) {
    const RunFolder folder(FolderPlan{});
    folder.remove(name);
    EXPECT_THROW(write_report(folder.path()), Error) << name;
  }
}

TEST(PageHeader, MarksAnInterruptedRun) {
  Summary summary = summary_of({});
  EXPECT_FALSE(holds(page_header(summary, std::nullopt), "Incomplete"));
  summary.complete = false;
  EXPECT_TRUE(holds(page_header(summary, std::nullopt), "Incomplete run."));
}

TEST(PoseErrorText, SaysPlainlyWhatSetsTheError) {
  Summary summary = summary_of({});
  EXPECT_EQ(pose_error_text(summary), "");
  summary.pose_error = PoseErrorSummary{0.01, 5.0, 0.0, 0.0141, statistics({0.004})};
  EXPECT_EQ(pose_error_text(summary),
            "The robot believed its antenna 14 mm (rms) off its true position. With the true pose "
            "the same reads give 4.0 mm on average; with the believed one 10 mm: pose error, not "
            "phase noise, sets this figure.");
}

TEST(PoseErrorText, DoesWithoutAComparison) {
  Summary summary = summary_of({});
  summary.pose_error = PoseErrorSummary{0.01, 5.0, 0.0, 0.0141, std::nullopt};
  EXPECT_EQ(pose_error_text(summary),
            "The robot believed its antenna 14 mm (rms) off its true position.");
}

TEST(ComparedPoseText, SaysWhatOtherPosesGive) {
  Summary summary = summary_of({});
  EXPECT_EQ(compared_pose_text(summary), "");
  summary.compared_pose = ComparedPose{"odometry", 0.25, statistics({0.2, 0.4}), 2};
  EXPECT_EQ(compared_pose_text(summary),
            "The same reads with other antenna poses, wheel odometry, 250 mm (rms) off these: 2 of "
            "3 tags located, off by 300 mm on average and by 400 mm at most.");
  EXPECT_TRUE(holds(run_facts(summary), "wheel odometry, 250 mm"));
}

TEST(RunFacts, ListWarnings) {
  Summary summary = summary_of({});
  summary.warnings = {"a <warning>"};
  EXPECT_TRUE(holds(run_facts(summary), "a &lt;warning&gt;"));
}

}  // namespace
}  // namespace tagfield
