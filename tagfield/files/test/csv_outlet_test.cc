// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/csv_outlet.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/truth_csv.h"

namespace tagfield {
namespace {

AntennaInfo antenna(const std::string& name, bool is_fixed, bool reports_doppler = false) {
  AntennaInfo info;
  info.name = name;
  info.is_fixed = is_fixed;
  info.reports_doppler = reports_doppler;
  return info;
}

TagRead read_at(int number) {
  TagRead read;
  read.stamp = time_from_seconds(0.1 * number);
  read.reader = "r";
  read.antenna = "gate";
  read.tag = "tag, \"odd\"";
  read.frequency_hz = 865.7e6;
  read.phase_rad = 0.01 * number;
  read.rssi_dbm = -50.0;
  return read;
}

/// Two antennas, one of them fixed, and three reads.
void tell_all(CsvOutlet& outlet, Recorder& recorder) {
  const auto both = [&](const auto& tell) {
    tell(outlet);
    tell(recorder);
  };
  both([](auto& to) { to.on_antenna_added(antenna("gate", true)); });
  both([](auto& to) { to.on_tag_added({time_from_seconds(0.0), "t", {1, 2, 3}}, ""); });
  for (int i = 1; i <= 3; ++i) {
    const Time stamp = time_from_seconds(0.1 * i);
    for (const auto& [name, fixed] : {std::pair("gate", true), std::pair("arm", false)}) {
      const AntennaPose pose{stamp, name, from_planar(0.1 * i, 0.2, 0.3)};
      const AntennaInfo info = antenna(name, fixed);
      both([&](auto& to) { to.on_pose(info, pose); });
      both([&](auto& to) { to.on_antenna_pose(info, pose); });
    }
    both([&](auto& to) { to.on_robot_pose({stamp, "robot", from_planar(i, 0, 0)}); });
    both([&](auto& to) { to.on_tag_moved({stamp, "t", {1, 2, 3.0 + i}}); });
    both([&](auto& to) { to.on_distance({stamp, "gate", "t", 1.0 / i}); });
    both([&](auto& to) { to.on_read(read_at(i)); });
  }
}

TEST(CsvOutlet, WritesTheSameAsTheWholeRecordingAtOnce) {
  const TemporaryFolder run;
  Recording recording;
  Recorder recorder(recording);
  {
    StagedFolder folder(run.path());
    {
      CsvOutlet outlet(folder);
      tell_all(outlet, recorder);
    }
    folder.commit();
  }
  EXPECT_EQ(run.text_of("reads.csv"), reads_to_csv(recording.reads));
  EXPECT_EQ(run.text_of("antenna_poses.csv"), poses_to_csv(recording.believed_poses));
  const TemporaryFolder other;
  StagedFolder whole(other.path());
  stage_truth(recording.truth, whole);
  whole.commit();
  for (const std::string name : {"antenna_poses", "robot_poses", "tags", "distances"}) {
    const std::string file = "truth/" + name + ".csv";
    EXPECT_EQ(run.text_of(file), other.text_of(file)) << file;
    EXPECT_GT(run.text_of(file).size(), 50U) << file;
  }
  // A fixed antenna has one row, the other one has a row per update.
  EXPECT_EQ(recording.believed_poses.size(), 4U);
}

TEST(CsvOutlet, HasAColumnForDopplerWhereAnAntennaTellsIt) {
  const TemporaryFolder run;
  StagedFolder folder(run.path());
  {
    CsvOutlet outlet(folder);
    outlet.on_antenna_added(antenna("gate", true, true));
    TagRead read = read_at(1);
    read.doppler_hz = 1.5;
    outlet.on_read(read);
  }
  folder.commit();
  EXPECT_NE(run.text_of("reads.csv").find(",doppler_hz\n"), std::string::npos);
  EXPECT_NE(run.text_of("reads.csv").find(",-50,1.5\n"), std::string::npos);
}

TEST(CsvOutlet, RefusesDopplerThatComesTooLateForItsColumn) {
  const TemporaryFolder run;
  StagedFolder folder(run.path());
  CsvOutlet outlet(folder);
  outlet.on_read(read_at(1));
  EXPECT_TRUE(contains(error_of([&] { outlet.on_antenna_added(antenna("late", true, true)); }),
                       "'late' reports Doppler"));
}

TEST(CsvOutlet, LeavesNothingWhereARunDidNotBegin) {
  const TemporaryFolder run;
  {
    StagedFolder folder(run.path());
    CsvOutlet outlet(folder);
  }
  EXPECT_TRUE(run.names().empty());
}

/// Simulates a program that is killed while writing.
void write_and_die(const std::filesystem::path& path) {
  StagedFolder folder(path);
  CsvOutlet outlet(folder);
  for (int i = 0; i < 20'000; ++i) outlet.on_read(read_at(i));
  raise(SIGKILL);
}

TEST(CsvOutlet, AKilledProgramLeavesWholeLinesInAFolderThatSaysIncomplete) {
  const TemporaryFolder run;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) write_and_die(run.path());
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const std::string name = "incomplete-" + std::to_string(child) + "/reads.csv";
  const std::string text = run.text_of(name);
  ASSERT_GT(text.size(), 100'000U);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(run.names().count("reads.csv"), 0U);
  const std::vector<TagRead> reads = read_reads_csv(run.file(name));
  EXPECT_EQ(static_cast<std::ptrdiff_t>(reads.size()) + 1,
            std::count(text.begin(), text.end(), '\n'));
}

}  // namespace
}  // namespace tagfield
