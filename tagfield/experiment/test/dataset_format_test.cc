// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/dataset_format.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/experiment/experiment.h"
#include "tagfield/localization/locate.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

std::string shipped(const std::string& name) {
  return std::string(TAGFIELD_SOURCE_DIR) + "/profiles/datasets/" + name + ".yaml";
}

std::string written(const std::string& name, const std::string& text) {
  const fs::path path = fs::path(testing::TempDir()) / name;
  std::ofstream(path) << text;
  return path.string();
}

const Recording& warehouse() {
  static const Recording recording = [] {
    Diagnostics diagnostics;
    const Scenario scenario = load_scenario(
        std::string(TAGFIELD_SOURCE_DIR) + "/scenarios/paper_warehouse.yaml", {}, diagnostics);
    return simulate(scenario, 1, {}).recording;
  }();
  return recording;
}

std::vector<TagEstimate> located(const std::vector<TagRead>& reads,
                                 const std::vector<AntennaPose>& poses) {
  LocalizationOptions options;
  options.known.heights.of_all = 1.5;
  Diagnostics diagnostics;
  return locate_tags(reads, poses, options, diagnostics).estimates;
}

/// Estimates from the original records.
const std::vector<TagEstimate>& expected() {
  static const auto estimates = located(warehouse().reads, warehouse().truth.antenna_poses);
  return estimates;
}

void expect_as_expected(const std::vector<TagEstimate>& estimates, double tolerance_m) {
  ASSERT_EQ(estimates.size(), expected().size());
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    EXPECT_EQ(estimates[i].verdict, expected()[i].verdict) << estimates[i].reason;
    if (expected()[i].candidates.empty() || estimates[i].candidates.empty()) continue;
    const Eigen::Vector3d apart =
        estimates[i].candidates[0].p_WT - expected()[i].candidates[0].p_WT;
    EXPECT_LT(apart.norm(), tolerance_m) << estimates[i].tag;
  }
}

/// Position of the read's antenna, which has a pose at each of its updates.
Eigen::Vector3d place_of(const TagRead& read) {
  static const std::map<Time, Eigen::Vector3d> places = [] {
    std::map<Time, Eigen::Vector3d> all;
    for (const AntennaPose& pose : warehouse().truth.antenna_poses) {
      all[pose.stamp] = pose.X_WA.translation;
    }
    return all;
  }();
  return places.at(read.stamp);
}

TEST(DatasetFormat, LogsInStepsThatFallWithDistance) {
  std::string text = "timestamp,antenna,rssi,epc,phase_angle,channel_index,doppler\n";
  for (const TagRead& read : warehouse().reads) {
    const double steps = std::fmod(4096.0 - std::round(read.phase_rad / kTwoPi * 4096.0), 4096.0);
    // EPCs are often written in groups.
    text +=
        fmt::format("{:.0f},{},{},{} {},{:.0f},1,0\n", to_seconds(read.stamp) * 1e6, read.antenna,
                    read.rssi_dbm, read.tag.substr(0, 2), read.tag.substr(2), steps);
  }
  const Dataset dataset =
      read_dataset_csv(written("log.csv", text), read_dataset_form(shipped("llrp_log")));
  EXPECT_TRUE(dataset.poses.empty());
  ASSERT_EQ(dataset.reads.size(), warehouse().reads.size());
  EXPECT_EQ(dataset.reads[0].tag, warehouse().reads[0].tag);
  EXPECT_EQ(dataset.reads[0].frequency_hz, 865.7e6);
  expect_as_expected(located(dataset.reads, warehouse().truth.antenna_poses), 1e-3);
}

TEST(DatasetFormat, PlacesInTheRowsAndNoTime) {
  std::string text = "EPC,antennaindex,frequency,time,RSSI,phase,x,y,z\n";
  for (const TagRead& read : warehouse().reads) {
    const Eigen::Vector3d p = place_of(read);
    text +=
        fmt::format("{},1,{:.3f},,{},{:.7f},{:.6f},{:.6f},{:.6f}\n", read.tag,
                    read.frequency_hz * 1e-6, read.rssi_dbm, read.phase_rad, p.x(), p.y(), p.z());
  }
  const Dataset dataset =
      read_dataset_csv(written("points.csv", text), read_dataset_form(shipped("aperture_points")));
  EXPECT_NEAR(dataset.reads[0].frequency_hz, 865.7e6, 1.0);
  expect_as_expected(located(dataset.reads, dataset.poses), 1e-3);
}

TEST(DatasetFormat, NoHeaderAndOddUnits) {
  std::string text;
  for (const TagRead& read : warehouse().reads) {
    const Eigen::Vector3d p = place_of(read);
    text += fmt::format("{:.6f};{};{:.5f};{:.0f};{:.1f};{:.3f};{:.3f}\n",
                        to_seconds(read.stamp) * 1e3, read.tag, read.phase_rad * 180.0 / kPi,
                        read.rssi_dbm * 100.0, read.frequency_hz * 1e-3, p.x() * 1e3, p.y() * 1e3);
  }
  const Dataset dataset =
      read_dataset_csv(written("rows.csv", text), read_dataset_form(shipped("robot_rows")));
  EXPECT_EQ(dataset.reads.size(), warehouse().reads.size());
  EXPECT_NEAR(dataset.reads[0].rssi_dbm, warehouse().reads[0].rssi_dbm, 1e-9);
  EXPECT_NEAR(dataset.poses[0].X_WA.translation.z(), 1.5, 1e-12);
  expect_as_expected(located(dataset.reads, dataset.poses), 1e-3);
}

/// The run begins shortly before midnight on 29 February of a leap year, and ends in March.
std::string iso_of(Time stamp) {
  const double seconds = to_seconds(stamp) + 86390.0;
  const int day = seconds < 86400.0 ? 29 : 1;
  const int month = seconds < 86400.0 ? 2 : 3;
  const double of_day = std::fmod(seconds, 86400.0);
  const int whole = static_cast<int>(of_day);
  return fmt::format("2024-{:02}-{:02}T{:02}:{:02}:{:02}.{:09.0f}Z", month, day, whole / 3600,
                     whole / 60 % 60, whole % 60, std::floor((of_day - whole) * 1e9));
}

TEST(DatasetFormat, TwoTablesAndDates) {
  constexpr double kStart = 1709164800.0 + 86390.0;  // 2024-02-29T00:00:00Z plus 86390 s
  std::string reads = "time,epc,port,phase_deg,rssi_dbm,frequency_hz\n";
  for (const TagRead& read : warehouse().reads) {
    reads += fmt::format("{},{},7,{:.5f},{},{}\n", iso_of(read.stamp), read.tag,
                         360.0 - read.phase_rad * 180.0 / kPi, read.rssi_dbm, read.frequency_hz);
  }
  std::string poses = "time_s\tport\tx_cm\ty_cm\tz_cm\n";
  for (const AntennaPose& pose : warehouse().truth.antenna_poses) {
    const Eigen::Vector3d p = 100.0 * pose.X_WA.translation;
    poses += fmt::format("{:.9f}\t7\t{:.4f}\t{:.4f}\t{:.4f}\n", kStart + to_seconds(pose.stamp),
                         p.x(), p.y(), p.z());
  }
  const DatasetForm form = read_dataset_form(shipped("two_tables"));
  ASSERT_TRUE(form.poses.has_value());
  const Dataset dataset = read_dataset_csv(written("reads.csv", reads), form);
  EXPECT_NEAR(to_seconds(dataset.reads[0].stamp), kStart + to_seconds(warehouse().reads[0].stamp),
              1e-5);
  expect_as_expected(
      located(dataset.reads, read_dataset_poses_csv(written("places.tsv", poses), *form.poses)),
      2e-3);
}

TEST(DatasetFormat, StandingAntennasHaveTheirPlacesInTheProfile) {
  const std::string profile = written("standing.yaml",
                                      "stamp: {column: t}\ntag: {column: epc}\n"
                                      "antenna: {column: port}\nphase: {column: p, unit: radians}\n"
                                      "frequency: {hz: 915e6}\n"
                                      "antennas: {1: [0, 2.1, 0.5], 2: [2.1, 2.1, 0.5]}\n");
  const Dataset dataset = read_dataset_csv(
      written("standing.csv", "t,epc,port,p\n0.5,E2 80,1,7.0\n"), read_dataset_form(profile));
  ASSERT_EQ(dataset.reads.size(), 1u);
  EXPECT_EQ(dataset.reads[0].tag, "E280");
  EXPECT_NEAR(dataset.reads[0].phase_rad, 7.0 - kTwoPi, 1e-12);
  EXPECT_EQ(dataset.reads[0].rssi_dbm, -200.0);
  ASSERT_EQ(dataset.poses.size(), 2u);
  EXPECT_EQ(dataset.poses[1].antenna, "2");
}

/// The error message without the file's name; "" if there is none.
template <typename Read>
std::string complaint(const std::string& path, const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos);
    const std::size_t at = message.find(path);
    return at == std::string::npos ? message : message.substr(at + path.size());
  }
  return "";
}

std::string complaint_of_rows(const std::string& rows) {
  const std::string path =
      written("bad.csv", "timestamp,antenna,rssi,epc,phase_angle,channel_index\n" + rows);
  const DatasetForm form = read_dataset_form(shipped("llrp_log"));
  return complaint(path, [&] { read_dataset_csv(path, form); });
}

TEST(DatasetFormat, ComplaintsNameTheLine) {
  EXPECT_EQ(complaint_of_rows("1,a,-50,E2,100,1\n"), "");
  EXPECT_EQ(complaint_of_rows("1,a,-50,E2,100,5\n"),
            ":2: channel_index is '5', expected a channel from 1 to 4");
  EXPECT_EQ(complaint_of_rows("1,a,-50,E2,100,1\n1,a,-50,E2,abc,1\n"),
            ":3: phase_angle is 'abc', expected a finite number");
  EXPECT_EQ(complaint_of_rows("1e30,a,-50,E2,100,1\n"),
            ":2: timestamp is '1e30', which is not a time in this unit");
  EXPECT_EQ(complaint_of_rows("1,a,-5000,E2,100,1\n"),
            ":2: rssi is -5000 dBm, expected -300 to 300: which unit is it in?");
  EXPECT_EQ(complaint_of_rows("1,a,-50,,100,1\n"), ":2: epc is empty");
  EXPECT_EQ(complaint_of_rows("1,a,-50\n"), ":2: 3 fields where the header has 6");
  const std::string dates =
      written("dates.csv", "time,epc,port,phase_deg,rssi_dbm,frequency_hz\nnoon,E2,1,0,-50,9e8\n");
  EXPECT_EQ(
      complaint(dates, [&] { read_dataset_csv(dates, read_dataset_form(shipped("two_tables"))); }),
      ":2: time is 'noon', expected a date as 2024-05-01T12:30:00.25");
}

TEST(DatasetFormat, DatesAreThoseOfTheCalendar) {
  const auto complaint_of = [](const std::string& date) {
    const std::string path =
        written("dates.csv", "time,epc,port,phase_deg,rssi_dbm,frequency_hz\n" + date +
                                 "T00:00:00,E2,1,0,-50,9e8\n");
    return complaint(path,
                     [&] { read_dataset_csv(path, read_dataset_form(shipped("two_tables"))); });
  };
  for (const char* date : {"2024-02-29", "2000-02-29", "2023-02-28", "2023-12-31", "2023-04-30"}) {
    EXPECT_EQ(complaint_of(date), "") << date;
  }
  for (const char* date : {"2023-02-29", "2024-02-30", "2100-02-29", "2023-04-31", "2023-12-32"}) {
    EXPECT_NE(complaint_of(date).find("expected a date as"), std::string::npos) << date;
  }
}

TEST(DatasetFormat, ComplaintsOfProfilesNameTheLineToo) {
  const std::string path = written("form.yaml", "stamp: {column: t, unit: hours}\n");
  EXPECT_NE(complaint(path, [&] { read_dataset_form(path); }).find(":1: stamp.unit"),
            std::string::npos);
  const std::string missing = written("form2.yaml", "stamp: {column: t}\n");
  EXPECT_NE(complaint(missing, [&] { read_dataset_form(missing); }).find("tag"), std::string::npos);
}

TEST(DatasetFormat, AllShippedFormsCanBeRead) {
  std::size_t count = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(TAGFIELD_SOURCE_DIR) / "profiles" / "datasets")) {
    EXPECT_NO_THROW(read_dataset_form(entry.path().string())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 4u);
}

TEST(DatasetFormat, AFolderOfTablesGoesByTheNumbersInItsNames) {
  const fs::path folder = fs::path(testing::TempDir()) / "stops";
  fs::create_directories(folder);
  for (const int stop : {10, 2, 1}) {
    std::ofstream(folder / fmt::format("{}.csv", stop))
        << "epc,antennaIndex,frequency,time,RSSI,phase,dopplerShift,velocity,x,y,z,angle\n"
        << fmt::format("a,1,920625000,0,-45,1.5,0,0,{},1.63,0,0\n", 0.02 * stop);
  }
  const Dataset dataset = read_dataset_csv(folder.string(), read_dataset_form(shipped("adarf")));
  ASSERT_EQ(dataset.reads.size(), 3U);
  ASSERT_EQ(dataset.poses.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double stops[] = {1.0, 2.0, 10.0};
    EXPECT_DOUBLE_EQ(dataset.poses[i].X_WA.translation.x(), 0.02 * stops[i]);
    EXPECT_EQ(dataset.reads[i].stamp, time_from_seconds(0.001 * static_cast<double>(i)));
  }
  fs::create_directories(folder / "none");
  EXPECT_THROW(read_dataset_csv((folder / "none").string(), read_dataset_form(shipped("adarf"))),
               Error);
}

TEST(DatasetFormat, ChannelsByTheNameOfTheirPlan) {
  const std::string text =
      "stamp: {rows_apart_s: 0.01}\ntag: {column: t}\nantenna: {name: a}\n"
      "phase: {column: p, unit: steps_4096}\nfrequency: {column: c, channels: NAME, "
      "first_channel: 1}\n";
  const auto form_of = [&](const std::string& name) {
    std::string named = text;
    named.replace(named.find("NAME"), 4, name);
    return read_dataset_form(written("plan.yaml", named));
  };
  EXPECT_EQ(form_of("fcc").frequency.channels_hz.size(), 50U);
  EXPECT_DOUBLE_EQ(form_of("fcc").frequency.channels_hz.front(), 902.75e6);
  EXPECT_EQ(form_of("etsi_low").frequency.channels_hz.size(), 4U);
  EXPECT_THROW(form_of("fccc"), Error);
}

}  // namespace
}  // namespace tagfield
