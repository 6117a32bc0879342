// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/recorded_run.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tagfield/files/files.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

/// A recording whose tables are in a folder of its own.
class RecordedRun : public ::testing::Test {
 protected:
  RecordedRun()
      : folder_(fs::temp_directory_path() /
                (std::string("recorded_run_") +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
    recording_.reads = file("reads.csv", "");
    recording_.truth = path("truth.csv");
  }
  ~RecordedRun() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  std::string file(const std::string& name, const std::string& text) const {
    write_text_file(path(name), text);
    return path(name);
  }
  std::map<std::string, Eigen::Vector3d> truth_of(const std::string& text) {
    file("truth.csv", text);
    return read_tag_truth(recording_, rail_, 0.7);
  }
  std::string complaint_of(const std::string& text) {
    try {
      truth_of(text);
    } catch (const Error& error) {
      const std::string said = error.what();
      return said.substr(std::min(said.size(), folder_.string().size() + 1));
    }
    return "";
  }

  static AntennaPose at(double x, double y) {
    AntennaPose pose;
    pose.antenna = "1";
    pose.X_WA = from_translation({x, y, 0.5});
    return pose;
  }

  fs::path folder_;
  SuiteRecording recording_;
  std::vector<AntennaPose> rail_ = {at(0.0, 1.63), at(0.5, 1.63), at(1.0, 1.63)};
};

TEST_F(RecordedRun, TruthIsByPlaces) {
  const auto places = truth_of("tag,x_m,y_m,z_m\na,1,2,3\nb,4,5,6\n");
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places.at("b"), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(truth_of("y_m,x_m,tag\n1,2,a\n").at("a"), Eigen::Vector3d(2, 1, 0.7));
}

TEST_F(RecordedRun, TruthIsByDistancesFromTheWay) {
  recording_.area.side = TagSide::kPlusY;
  EXPECT_EQ(truth_of("tag,x_m,range_m\na,0.3,0.5\n").at("a"), Eigen::Vector3d(0.3, 2.13, 0.7));
  recording_.area.side = TagSide::kMinusY;
  EXPECT_EQ(truth_of("tag,x_m,range_m\na,0.3,0.5\n").at("a"), Eigen::Vector3d(0.3, 1.13, 0.7));
  rail_ = {at(2.0, 0.0), at(2.0, 1.0)};
  recording_.area.side = TagSide::kMinusX;
  EXPECT_EQ(truth_of("tag,y_m,range_m\na,0.3,0.5\n").at("a"), Eigen::Vector3d(1.5, 0.3, 0.7));
  recording_.area.side = TagSide::kPlusX;
  EXPECT_EQ(truth_of("tag,y_m,range_m\na,0.3,0.5\n").at("a"), Eigen::Vector3d(2.5, 0.3, 0.7));
}

TEST_F(RecordedRun, TruthOfOneExperiment) {
  recording_.experiment = "two";
  const auto places = truth_of("experiment,tag,x_m,y_m\none,a,1,1\ntwo,a,2,2\ntwo,b,3,3\n");
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places.at("a").x(), 2.0);
}

TEST_F(RecordedRun, ComplainsOfTheTruth) {
  EXPECT_EQ(complaint_of("tag,x_m,y_m\na,1,2\na,1,2\n"), "truth.csv:3: tag 'a' is listed twice");
  EXPECT_EQ(complaint_of("tag,x_m,y_m\n"), "truth.csv: has no tags");
  EXPECT_EQ(
      complaint_of("tag,x_m,range_m\na,1,2\n"),
      "truth.csv: range_m is a distance from the antennas' path, so it needs side: +x, -x, +y "
      "or -y");
  recording_.area.side = TagSide::kLeft;
  EXPECT_NE(complaint_of("tag,x_m,range_m\na,1,2\n"), "");
  recording_.area.side = TagSide::kPlusX;
  EXPECT_EQ(
      complaint_of("tag,y_m,range_m\na,1,2\n"),
      "truth.csv: range_m is a distance from a straight path, but the antennas are up to 0.50 "
      "m off it");
  recording_.experiment = "three";
  EXPECT_EQ(complaint_of("experiment,tag,x_m,y_m\none,a,1,1\n"),
            "truth.csv: has no tags of the experiment 'three'");
}

TEST_F(RecordedRun, SaysWhichFileIsMissing) {
  EXPECT_EQ(missing_file(recording_), recording_.truth);
  file("truth.csv", "");
  EXPECT_EQ(missing_file(recording_), std::nullopt);
  recording_.poses = path("no_poses.csv");
  EXPECT_EQ(missing_file(recording_), recording_.poses);
}

TEST_F(RecordedRun, LoadsReadsAndPlaces) {
  file("truth.csv", "tag,x_m,y_m\na,1,2\nb,3,4\n");
  const ReadRecording read = [&](const SuiteRecording& of) {
    EXPECT_EQ(of.reads, recording_.reads);
    RecordedReads tables;
    for (const char* tag : {"a", "stranger", "stranger"}) {
      tables.reads.emplace_back();
      tables.reads.back().tag = tag;
    }
    tables.poses = rail_;
    return tables;
  };
  Diagnostics diagnostics;
  const Recording run = load_recording(recording_, read, diagnostics);
  EXPECT_EQ(run.reads.size(), 3U);
  EXPECT_EQ(run.believed_poses.size(), 3U);
  ASSERT_EQ(run.truth.tag_positions.size(), 2U);
  EXPECT_EQ(run.truth.tag_positions[1].p_WT, Eigen::Vector3d(3, 4, 0.5));  // The antennas' height.
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(diagnostics.warnings()[0].find("1 tag in the reads (such as 'stranger'"),
            std::string::npos)
      << diagnostics.warnings()[0];
  EXPECT_THROW(load_recording(recording_, {}, diagnostics), Error);
}

TEST_F(RecordedRun, TellsWhatIsKnown) {
  recording_.heights = file("heights.csv", "tag,height_m\na,1.5\n");
  recording_.tag_height_m = 0.9;
  recording_.area.side = TagSide::kLeft;
  const KnownBeforehand known = known_of(recording_, PoseErrorModel{0.02, 0.0, 5.0});
  EXPECT_EQ(known.heights.of_all, 0.9);
  EXPECT_EQ(known.heights.of_tag.at("a"), 1.5);
  EXPECT_EQ(known.area.side, TagSide::kLeft);
  EXPECT_EQ(known.pose_error.value().sigma_m, 0.02);
  EXPECT_FALSE(known_of(recording_, {}).pose_error);
}

}  // namespace
}  // namespace tagfield
