// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_recording.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "adapters/bags/test/bag_writer.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/base/units.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

constexpr double kFrequency = 865.7e6;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector3d kTag(2.0, 1.0, 0.5);

Time at(double seconds) { return time_from_seconds(seconds); }

/// A circle of 1 m radius at 0.5 m height, 0.5 rad/s.
Eigen::Vector3d on_circle(double seconds) {
  return {std::cos(0.5 * seconds), std::sin(0.5 * seconds), 0.5};
}

double phase_at(double distance_m) {
  return wrap_to_two_pi(4.0 * kPi * distance_m / wavelength(kFrequency));
}

TagRead read_at(Time stamp, const Eigen::Vector3d& p_WA, const std::string& tag = "tag") {
  return {stamp, "reader", "a", tag, kFrequency, phase_at((kTag - p_WA).norm()), -50.0};
}

std::string bag_in(const TemporaryFolder& folder) { return folder.file("run.bag"); }

BagRecording recording_of(const std::string& path, BagOptions options = {}) {
  Diagnostics diagnostics;
  return read_bag(path, options, diagnostics);
}

/// Writes a bag with `body` and reads it back.
template <typename Body>
BagRecording written(const Body& body, const BagOptions& options = {},
                     Diagnostics* diagnostics = nullptr) {
  const TemporaryFolder folder;
  {
    BagWriter writer(bag_in(folder));
    body(writer);
  }
  Diagnostics unused;
  return read_bag(bag_in(folder), options, diagnostics != nullptr ? *diagnostics : unused);
}

/// The error message for such a bag, from "run.bag" on.
template <typename Body>
std::string complaint_of(const Body& body) {
  const std::string message = error_of([&] { written(body); });
  const std::size_t name = message.find("run.bag");
  return name == std::string::npos ? message : message.substr(name);
}

/// One full circle at 15 Hz: reads, truth, and odometry at 20 Hz whose x is 0.1 m too large.
void write_turn(BagWriter& writer) {
  writer.transform("/tf_static", at(0.0), "world", "odom", {});
  writer.transform("/tf_static", at(0.0), "base", "antenna", from_translation({0.0, 0.0, 0.5}));
  writer.tag_positions(at(0.0), {{"tag", kTag}});
  for (int i = 0; i < 260; ++i) {
    const Eigen::Vector3d base = on_circle(0.05 * i) + Eigen::Vector3d(0.1, 0.0, -0.5);
    writer.transform("/tf", at(0.05 * i), "odom", "base", from_translation(base));
  }
  for (int i = 0; i < 190; ++i) {
    const double seconds = i / 15.0;
    const Eigen::Vector3d p_WA = on_circle(seconds);
    writer.reads(at(seconds), "a", {read_at(at(seconds), p_WA)});
    writer.antenna_truth(at(seconds), "a", from_translation(p_WA), {{"tag", (kTag - p_WA).norm()}});
  }
}

TEST(ReadBag, GivesReadsThatLocateTheTagWithTheTruePose) {
  const BagRecording bag = written(write_turn);
  ASSERT_EQ(bag.reads.size(), 190U);
  LocalizationOptions options;
  options.known.heights.of_all = kTag.z();
  Diagnostics diagnostics;
  const auto with_truth =
      locate_tags(bag.reads, bag.truth.antenna_poses, options, diagnostics).estimates;
  ASSERT_EQ(with_truth.at(0).verdict, Verdict::kLocated) << with_truth[0].reason;
  EXPECT_LT((with_truth[0].candidates[0].p_WT - kTag).norm(), 1e-3);
  // A constant error of the believed poses shifts the tag by the same amount.
  const auto believed = locate_tags(bag.reads, bag.believed.poses, options, diagnostics).estimates;
  ASSERT_EQ(believed.at(0).verdict, Verdict::kLocated) << believed[0].reason;
  const Eigen::Vector3d shifted = kTag + Eigen::Vector3d(0.1, 0.0, 0.0);
  EXPECT_LT((believed[0].candidates[0].p_WT - shifted).norm(), 3e-3);
}

TEST(ReadBag, InterpolatesTransformsAtTheStampsOfReads) {
  const BagRecording bag = written(write_turn);
  EXPECT_EQ(bag.believed.source, "odometry");
  EXPECT_EQ(bag.believed.frame, "world");
  ASSERT_EQ(bag.believed.poses.size(), 190U);
  for (const AntennaPose& pose : bag.believed.poses) {
    const double steps = to_seconds(pose.stamp) / 0.05;
    const double before = 0.05 * std::floor(steps + 1e-9);
    const double share = steps - std::floor(steps + 1e-9);
    const Eigen::Vector3d expected =
        (1.0 - share) * on_circle(before) + share * on_circle(before + 0.05);
    const Eigen::Vector3d p_WA = pose.X_WA.translation - Eigen::Vector3d(0.1, 0.0, 0.0);
    EXPECT_LT((p_WA - expected).norm(), 1e-7) << format_stamp(pose.stamp);
  }
}

TEST(ReadBag, KeepsTruthAndStampsExactly) {
  const Time stamp(Duration(1'700'000'000'123'456'789));
  const RigidTransform X = from_xyz_rpy({0.1 + 0.2, -1.0 / 3.0, 2.0}, {0.1, 0.2, 0.3});
  const BagRecording bag = written([&](BagWriter& writer) {
    writer.reads(stamp, "a", {{stamp, "r", "a", "t", kFrequency, 1.0 / 7.0, -61.0}});
    writer.antenna_truth(stamp, "a", X, {{"t", 1.0 / 3.0}});
    writer.antenna_truth(stamp + Duration(1), "a", from_translation({1.0, 2.0, 3.0}));
    writer.tag_positions(stamp, {{"t", {1.0 / 3.0, 2.0, 3.0}}});
    writer.robot("/p3at/ground_truth/odom", stamp, X);
    writer.robot("/p3at/odom", stamp, X);
  });
  ASSERT_EQ(bag.reads.size(), 1U);
  EXPECT_EQ(bag.reads[0].stamp, stamp);
  EXPECT_EQ(bag.reads[0].reader, "r");
  EXPECT_EQ(bag.reads[0].phase_rad, 1.0 / 7.0);
  ASSERT_EQ(bag.truth.antenna_poses.size(), 2U);
  EXPECT_EQ(bag.truth.antenna_poses[0].stamp, stamp);
  EXPECT_EQ(bag.truth.antenna_poses[0].X_WA.translation, X.translation);
  EXPECT_EQ(bag.truth.antenna_poses[0].X_WA.rotation.coeffs(), X.rotation.coeffs());
  ASSERT_EQ(bag.truth.distances.size(), 1U);
  EXPECT_EQ(bag.truth.distances[0].distance_m, 1.0 / 3.0);
  ASSERT_EQ(bag.truth.robot_poses.size(), 1U);
  EXPECT_EQ(bag.truth.robot_poses[0].antenna, "p3at");
  EXPECT_EQ(bag.truth.tag_positions.at(0).p_WT.x(), 1.0 / 3.0);
  EXPECT_EQ(bag.truth_frame, "world");
}

TEST(ReadBag, KeepsEachUpdateOfAnAntennaAndOneRowOfATagAtRest) {
  const BagRecording bag = written([](BagWriter& writer) {
    writer.reads(at(0.0), "fixed", {});
    for (const double t : {0.0, 1.0, 2.0}) {
      writer.antenna_truth(at(t), "fixed", from_translation({1.0, 0.0, 2.0}));
      writer.antenna_truth(at(t), "lifted", from_translation({0.0, 0.0, t}));
      writer.tag_positions(at(t),
                           {{"rests", {1.0, 1.0, 1.0}}, {"moves", {std::floor(t / 2), 0.0, 0.0}}});
    }
  });
  ASSERT_EQ(bag.truth.antenna_poses.size(), 6U);
  EXPECT_EQ(bag.truth.antenna_poses[0].antenna, "fixed");
  EXPECT_EQ(bag.truth.antenna_poses[4].antenna, "fixed");
  EXPECT_EQ(bag.truth.antenna_poses[5].antenna, "lifted");
  ASSERT_EQ(bag.truth.tag_positions.size(), 3U);
  EXPECT_EQ(bag.truth.tag_positions[2].tag, "moves");
  EXPECT_EQ(bag.truth.tag_positions[2].stamp, at(2.0));
}

TEST(ReadBag, SortsByStampWhateverTheOrderOfReceipt) {
  const BagRecording bag = written([](BagWriter& writer) {
    writer.receipt = at(10.0);
    for (const double t : {0.3, 0.1, 0.2}) {
      writer.receipt += Duration(1);
      writer.reads(at(t), "a", {read_at(at(t), {0.0, 0.0, 0.0})});
    }
  });
  ASSERT_EQ(bag.reads.size(), 3U);
  EXPECT_EQ(bag.reads[0].stamp, at(0.1));
  EXPECT_EQ(bag.reads[2].stamp, at(0.3));
}

TEST(ReadBag, KnowsTransformsAtTimeZero) {
  // tf2 itself would interpret stamp 0 as "the latest".
  const BagRecording bag = written([](BagWriter& writer) {
    writer.reads(at(0.0), "a", {});
    for (const double t : {0.0, 1.0}) {
      writer.transform("/tf", at(t), "world", "antenna", from_translation({1.0 + t, 0.0, 0.0}));
    }
  });
  ASSERT_EQ(bag.believed.poses.size(), 1U);
  EXPECT_EQ(bag.believed.poses[0].X_WA.translation.x(), 1.0);
}

TEST(ReadBag, TakesTheFirstFrameThatCanExpressTheAntennas) {
  const auto write = [](BagWriter& writer) {
    for (const double t : {0.0, 1.0, 2.0}) {
      writer.reads(at(t), "a", {});
      writer.transform("/ns/tf", at(t), "/odom", "/antenna", from_translation({t, 0.0, 0.0}));
      writer.transform("/tf", at(t), "map", "odom", from_translation({0.0, 5.0, 0.0}));
    }
  };
  const BagRecording mapped = written(write);
  EXPECT_EQ(mapped.believed.frame, "map");
  EXPECT_EQ(mapped.believed.source, "tf");
  EXPECT_EQ(mapped.believed.poses.at(2).X_WA.translation, Eigen::Vector3d(2.0, 5.0, 0.0));
  BagOptions by_wheels;
  by_wheels.frames = {"world", "odom"};
  const BagRecording driven = written(write, by_wheels);
  EXPECT_EQ(driven.believed.source, "odometry");
  EXPECT_EQ(driven.believed.poses.at(2).X_WA.translation, Eigen::Vector3d(2.0, 0.0, 0.0));
  BagOptions nowhere;
  nowhere.frames = {"moon"};
  EXPECT_TRUE(written(write, nowhere).believed.poses.empty());
}

TEST(ReadBag, GivesNoPoseWhereTransformsHaveNotBegunOrRunInARing) {
  const BagRecording bag = written([](BagWriter& writer) {
    writer.reads(at(0.5), "a", {});
    writer.reads(at(1.0), "a", {});
    writer.reads(at(1.0), "b", {}, "ring");
    for (const double t : {1.0, 2.0}) {
      writer.transform("/tf", at(t), "odom", "antenna", from_translation({t, 0.0, 0.0}));
      writer.transform("/tf", at(t), "gnir", "ring", {});
      writer.transform("/tf", at(t), "ring", "gnir", {});
    }
  });
  ASSERT_EQ(bag.believed.poses.size(), 1U);
  EXPECT_EQ(bag.believed.poses[0].stamp, at(1.0));
}

TEST(ReadBag, PlacesAFixedAntennaThatTfDoesNotKnowWhereItIs) {
  const BagRecording bag = written([](BagWriter& writer) {
    for (const double t : {0.0, 1.0}) {
      writer.reads(at(t), "a", {});
      writer.reads(at(t), "fixed", {}, "nowhere");
      writer.antenna_truth(at(t), "fixed", from_translation({3.0, 0.0, 2.0}));
      writer.antenna_truth(at(t), "a", from_translation({t, 0.0, 2.0}));
      writer.transform("/tf", at(t), "world", "antenna", from_translation({t, 0.1, 2.0}));
    }
  });
  ASSERT_EQ(bag.believed.poses.size(), 3U);
  EXPECT_EQ(bag.believed.poses[1].antenna, "fixed");
  EXPECT_EQ(bag.believed.poses[1].X_WA.translation.x(), 3.0);
}

TEST(ReadBag, TakesTagArraysWhereThereAreNoTagReads) {
  Diagnostics diagnostics;
  const BagRecording bag = written(
      [](BagWriter& writer) {
        for (int i = 0; i < 190; ++i) {
          const Eigen::Vector3d p = on_circle(i / 15.0);
          const double distance = (kTag - p).norm();
          // The published plugin wraps to (-π, π].
          writer.tag_array("/gazebo/mobile/data", at(i / 15.0), from_translation(p),
                           {{"box::link", distance, wrap_to_pi(phase_at(distance)), -50.0}});
        }
      },
      {}, &diagnostics);
  ASSERT_EQ(bag.reads.size(), 190U);
  EXPECT_EQ(bag.reads[0].antenna, "mobile");
  EXPECT_EQ(bag.reads[0].tag, "box::link");
  EXPECT_EQ(bag.believed.source, "given");
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_TRUE(contains(diagnostics.warnings()[0], "865.7 MHz is assumed"));
  for (const TagRead& read : bag.reads) EXPECT_GE(read.phase_rad, 0.0);
  LocalizationOptions options;
  options.known.heights.of_all = kTag.z();
  const auto estimates = locate_tags(bag.reads, bag.believed.poses, options, diagnostics).estimates;
  ASSERT_EQ(estimates.at(0).verdict, Verdict::kLocated);
  EXPECT_LT((estimates[0].candidates[0].p_WT - kTag).norm(), 1e-3);
}

TEST(ReadBag, TakesTheFrequencyOfTagArraysThatItIsGiven) {
  Diagnostics diagnostics;
  BagOptions options;
  options.frequency_hz = 915e6;
  const BagRecording bag = written(
      [](BagWriter& writer) {
        writer.tag_array("/s/data", at(1.0), {}, {{"t", 1.0, 0.5, -50.0}});
      },
      options, &diagnostics);
  EXPECT_EQ(bag.reads.at(0).frequency_hz, 915e6);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(ReadBag, CountsOnlyWhatComesAfterAReset) {
  Diagnostics diagnostics;
  const BagRecording bag = written(
      [](BagWriter& writer) {
        writer.transform("/tf_static", at(0.0), "world", "antenna", {});
        writer.tag_positions(at(0.0), {{"tag", kTag}});
        int received = 0;
        for (const double t : {10.0, 11.0, 12.0, 0.5, 1.5}) {
          writer.receipt = at(20.0 + ++received);
          writer.reads(at(t), "a", {read_at(at(t), {0.0, 0.0, 0.0})});
          writer.antenna_truth(at(t), "a", from_translation({t, 0.0, 0.0}));
        }
      },
      {}, &diagnostics);
  ASSERT_EQ(bag.reads.size(), 2U);
  EXPECT_EQ(bag.reads[0].stamp, at(0.5));
  ASSERT_EQ(bag.truth.antenna_poses.size(), 2U);
  EXPECT_EQ(bag.truth.tag_positions.size(), 1U);
  EXPECT_EQ(bag.believed.poses.size(), 1U);
  EXPECT_DOUBLE_EQ(bag.duration_s, 1.0);
  ASSERT_FALSE(diagnostics.warnings().empty());
  EXPECT_TRUE(contains(diagnostics.warnings()[0], "time goes back from 12.000000000 s to 0.5"));
}

TEST(ReadBag, WarnsOfReadsThatRepeatAnother) {
  Diagnostics diagnostics;
  const BagRecording bag = written(
      [](BagWriter& writer) {
        for (int i = 0; i < 3; ++i) {
          writer.reads(at(1.0), "a", {read_at(at(1.0), {1.0 * i, 0.0, 0.0})});
        }
      },
      {}, &diagnostics);
  ASSERT_EQ(bag.reads.size(), 1U);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_TRUE(contains(diagnostics.warnings()[0], "2 reads repeat"));
}

/// All reads and distances that are not held.
BagRecording read_again(const BagRecording& bag) {
  BagRecording all;
  bag.unreported->tell(
      {[&](const TagRead& read) { all.reads.push_back(read); },
       [&](const TrueDistance& distance) { all.truth.distances.push_back(distance); },
       {}});
  return all;
}

TEST(ReadBag, TellsReadsThatAreTooManyToBeHeld) {
  const TemporaryFolder folder;
  {
    BagWriter writer(bag_in(folder));
    write_turn(writer);
  }
  const BagRecording held = recording_of(bag_in(folder));
  ASSERT_FALSE(held.unreported);
  BagOptions options;
  options.max_reads = 190;
  EXPECT_FALSE(recording_of(bag_in(folder), options).unreported);
  options.max_reads = 189;
  const BagRecording bag = recording_of(bag_in(folder), options);
  ASSERT_TRUE(bag.unreported);
  EXPECT_TRUE(bag.reads.empty());
  EXPECT_TRUE(bag.truth.distances.empty());
  EXPECT_TRUE(bag.unreported->has_distances);
  EXPECT_EQ(bag.unreported->overview.count, 190U);
  EXPECT_EQ(bag.unreported->overview.tags, std::vector<std::string>{"tag"});
  EXPECT_EQ(bag.unreported->overview.last, held.reads.back().stamp);
  for (int times = 0; times < 2; ++times) {
    const BagRecording all = read_again(bag);
    EXPECT_EQ(reads_to_csv(all.reads), reads_to_csv(held.reads));
    ASSERT_EQ(all.truth.distances.size(), held.truth.distances.size());
    for (std::size_t i = 0; i < all.truth.distances.size(); ++i) {
      EXPECT_EQ(all.truth.distances[i].stamp, held.truth.distances[i].stamp);
      EXPECT_EQ(all.truth.distances[i].distance_m, held.truth.distances[i].distance_m);
    }
  }
  // Everything else is unchanged.
  ASSERT_EQ(bag.believed.poses.size(), held.believed.poses.size());
  EXPECT_EQ(bag.believed.poses.back().X_WA.translation,
            held.believed.poses.back().X_WA.translation);
  EXPECT_EQ(bag.truth.antenna_poses.size(), held.truth.antenna_poses.size());
  EXPECT_EQ(bag.truth.tag_positions.size(), 1U);
  EXPECT_EQ(bag.duration_s, held.duration_s);
  // With a truth, the believed poses are left out.
  options.max_reads_believed = 190;
  EXPECT_EQ(recording_of(bag_in(folder), options).believed.poses.size(),
            held.believed.poses.size());
  options.max_reads_believed = 189;
  EXPECT_TRUE(recording_of(bag_in(folder), options).believed.poses.empty());
}

TEST(ReadBag, TellsOnlyReadsAfterTheLastReset) {
  BagOptions options;
  options.max_reads = 1;
  const TemporaryFolder folder;
  {
    BagWriter writer(bag_in(folder));
    int received = 0;
    for (const double t : {10.0, 11.0, 12.0, 0.5, 1.5, 5.0, 0.25, 1.25, 2.25}) {
      writer.receipt = at(20.0 + ++received);
      writer.reads(at(t), "a", {read_at(at(t), {0.0, 0.0, 0.0})});
    }
  }
  const BagRecording bag = recording_of(bag_in(folder), options);
  ASSERT_TRUE(bag.unreported);
  EXPECT_EQ(bag.unreported->overview.count, 3U);
  const std::vector<TagRead> reads = read_again(bag).reads;
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_EQ(reads.front().stamp, at(0.25));
  EXPECT_EQ(reads.back().stamp, at(2.25));
  EXPECT_FALSE(bag.unreported->has_distances);
}

TEST(ReadBag, RefusesABagThatHasOtherReadsTheSecondTime) {
  BagOptions options;
  options.max_reads = 0;
  const TemporaryFolder folder;
  const auto write = [&](int reads) {
    BagWriter writer(bag_in(folder));
    for (int i = 0; i < reads; ++i) {
      writer.reads(at(1.0 + i), "a", {read_at(at(1.0 + i), {0.0, 0.0, 0.0})});
    }
  };
  write(3);
  const BagRecording bag = recording_of(bag_in(folder), options);
  ASSERT_TRUE(bag.unreported);
  write(2);
  const std::string message = error_of([&] { read_again(bag); });
  EXPECT_TRUE(contains(message, "run.bag: had 3 reads at first and 2 when they were read again"))
      << message;
}

TEST(ReadBag, ReadsCompressedBags) {
  for (const char* compression : {"bz2", "lz4"}) {
    const TemporaryFolder folder;
    {
      BagWriter writer(bag_in(folder), compression);
      write_turn(writer);
    }
    EXPECT_EQ(recording_of(bag_in(folder)).reads.size(), 190U) << compression;
  }
}

TEST(ReadBag, TellsHowFarItIs) {
  BagOptions options;
  double last = 0.0;
  options.on_progress = [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  };
  written(write_turn, options);
  EXPECT_DOUBLE_EQ(last, 1.0);
}

// --- Refused files ---------------------------------------------------------------------

TEST(ReadBag, RefusesWhatIsNoBag) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& path) {
    return error_of([&] { recording_of(path); });
  };
  EXPECT_TRUE(contains(complaint(folder.file("none.bag")), "none.bag: no such file"));
  EXPECT_TRUE(contains(complaint(folder.path().string()), "is a folder"));
  EXPECT_TRUE(contains(complaint(folder.with("e.bag", "")), "e.bag: is empty"));
  EXPECT_TRUE(contains(complaint(folder.with("t.bag", "a,b\n1,2\n")), "is not a rosbag of ROS 1"));
  EXPECT_TRUE(contains(complaint(folder.with("v.bag", "#ROSBAG V9.9\n")), "v.bag: "));
}

TEST(IsBag, GoesByNameAndByContent) {
  const TemporaryFolder folder;
  EXPECT_TRUE(is_bag("x/run.bag"));
  EXPECT_TRUE(is_bag("run.bag.active"));
  EXPECT_TRUE(is_bag(folder.with("recording", "#ROSBAG V2.0\n")));
  EXPECT_FALSE(is_bag(folder.with("reads.csv", "stamp_s\n")));
  EXPECT_FALSE(is_bag(folder.path().string()));
}

TEST(ReadBag, RefusesBagsWithoutReads) {
  EXPECT_TRUE(contains(complaint_of([](BagWriter&) {}), "has no reads: no topic of type"));
  EXPECT_TRUE(contains(complaint_of([](BagWriter& writer) { writer.tag_positions(at(1.0), {}); }),
                       "has no reads"));
  EXPECT_TRUE(written([](BagWriter& writer) { writer.reads(at(1.0), "a", {}); }).reads.empty());
}

TEST(ReadBag, NamesMessageAndFieldOfBadNumbers) {
  const auto with_read = [](auto change) {
    return complaint_of([&](BagWriter& writer) {
      TagRead read = read_at(at(2.0), {0.0, 0.0, 0.0});
      writer.reads(at(1.0), "a", {});
      change(read);
      writer.reads(at(2.0), "a", {read_at(at(2.0), {0.0, 0.0, 0.0}, "fine"), read});
    });
  };
  const std::string at_second = "run.bag: topic /any/reads, message 2: reads[1].";
  EXPECT_TRUE(
      contains(with_read([](TagRead& r) { r.phase_rad = kNaN; }), at_second + "phase is nan"));
  EXPECT_TRUE(contains(with_read([](TagRead& r) { r.rssi_dbm = -1.0 / 0.0; }), "rssi is -inf"));
  EXPECT_TRUE(contains(with_read([](TagRead& r) { r.frequency_hz = 0.0; }), "frequency is 0"));
  EXPECT_TRUE(contains(with_read([](TagRead& r) { r.frequency_hz = kNaN; }), "frequency is nan"));
  EXPECT_TRUE(contains(with_read([](TagRead& r) { r.tag = ""; }), "epc is empty"));
  EXPECT_TRUE(contains(with_read([](TagRead& r) { r.tag = std::string("a\0b", 3); }), "control"));
  EXPECT_TRUE(
      contains(with_read([](TagRead& r) { r.tag = std::string(5000, 'x'); }), "5000 bytes"));
  EXPECT_TRUE(contains(with_read([](TagRead& r) { r.antenna = "b"; }), "antenna is 'b', expected"));
}

/// tf2 itself holds 68 years.
TEST(ReadBag, TransformsMayBeDecadesApart) {
  const BagRecording bag = written([](BagWriter& writer) {
    writer.reads(at(1.0), "a", {});
    writer.transform("/tf", at(1.0), "odom", "antenna", from_translation({2.0, 0.0, 0.0}));
    writer.transform("/tf", at(3e9), "odom", "antenna", from_translation({1.0, 0.0, 0.0}));
  });
  ASSERT_EQ(bag.believed.poses.size(), 1U);
  EXPECT_EQ(bag.believed.poses[0].X_WA.translation.x(), 2.0);
}

TEST(ReadBag, GivesNoPoseInGapsOfTransformsThatMoveTheAntenna) {
  const BagRecording bag = written([](BagWriter& writer) {
    for (const double t : {0.2, 1.0, 1.5, 2.5, 3.5}) writer.reads(at(t), "a", {});
    for (const auto& [t, x] : std::map<double, double>{
             {0.0, 0.0}, {0.4, 0.1}, {1.4, 0.4}, {1.8, 0.5}, {3.0, 0.5}, {4.0, 0.505}}) {
      writer.transform("/tf", at(t), "odom", "antenna", from_translation({x, 0.0, 0.0}));
    }
  });
  std::vector<Time> stamps;
  for (const AntennaPose& pose : bag.believed.poses) stamps.push_back(pose.stamp);
  EXPECT_EQ(stamps, (std::vector<Time>{at(0.2), at(1.5), at(2.5), at(3.5)}));
}

TEST(ReadBag, NamesBadPosesOfAllKinds) {
  const auto also = [](auto body) {
    return complaint_of([&](BagWriter& writer) {
      writer.reads(at(1.0), "a", {});
      body(writer);
    });
  };
  const RigidTransform far = from_translation({1e300, 0.0, 0.0});
  const RigidTransform lost = from_translation({0.0, kNaN, 0.0});
  RigidTransform twisted;
  twisted.rotation.coeffs().setZero();
  EXPECT_TRUE(contains(also([&](BagWriter& w) { w.antenna_truth(at(1.0), "a", far); }),
                       "topic /any/truth, message 1: pose.position.x is 1e+300"));
  EXPECT_TRUE(contains(also([&](BagWriter& w) { w.antenna_truth(at(1.0), "a", twisted); }),
                       "pose.orientation has length 0, expected 1"));
  EXPECT_TRUE(contains(also([&](BagWriter& w) {
                         w.antenna_truth(at(1.0), "a", {}, {{"t", kNaN}});
                       }),
                       "distances[0] is nan"));
  EXPECT_TRUE(contains(also([&](BagWriter& w) {
                         w.tag_positions(at(1.0), {{"t", {0, 0, kNaN}}});
                       }),
                       "tags[0].position.z is nan"));
  EXPECT_TRUE(contains(also([&](BagWriter& w) { w.robot("/ground_truth/odom", at(1.0), lost); }),
                       "pose.pose.position.y is nan"));
  EXPECT_TRUE(contains(also([&](BagWriter& w) { w.transform("/tf", at(1.0), "odom", "x", lost); }),
                       "transforms[0].translation.y is nan"));
  EXPECT_TRUE(contains(also([&](BagWriter& w) { w.transform("/tf", at(1.0), "x", "/x", {}); }),
                       "child_frame_id is 'x' as its parent"));
}

TEST(ReadBag, RefusesOtherVersionsOfItsMessages) {
  const std::string complaint = complaint_of([](BagWriter& writer) {
    writer.raw("/r", "tagfield_msgs/TagReads", "0123456789abcdef0123456789abcdef", {});
  });
  EXPECT_TRUE(contains(complaint, "topic /r is of another version of tagfield_msgs/TagReads"));
}

TEST(ReadBag, BelievesNoCountThatCannotBe) {
  // seq, sec, nsec, frame "", antenna "a", and 4,294,967,295 reads.
  std::vector<std::uint8_t> bytes(12, 0);
  for (const int byte : {0, 0, 0, 0, 1, 0, 0, 0, 0x61, 0xff, 0xff, 0xff, 0xff}) {
    bytes.push_back(static_cast<std::uint8_t>(byte));
  }
  const auto complaint = [](const std::vector<std::uint8_t>& raw) {
    return complaint_of([&](BagWriter& writer) {
      writer.raw("/r", "tagfield_msgs/TagReads", md5_of_tag_reads(), raw);
    });
  };
  EXPECT_TRUE(contains(complaint(bytes), "message 1: has a list of 4294967295 elements"));
  bytes.resize(15);
  EXPECT_TRUE(contains(complaint(bytes), "ends too early"));
  EXPECT_TRUE(contains(complaint({}), "ends too early"));
}

RC_GTEST_PROP(ReadBag, GivesErrorOrContentForAnyBytes, (std::vector<std::uint8_t> bytes)) {
  const std::string complaint = complaint_of([&](BagWriter& writer) {
    writer.raw("/r", "tagfield_msgs/TagReads", md5_of_tag_reads(), bytes);
  });
  RC_ASSERT(complaint == "(no error)" || contains(complaint, "topic /r, message 1: "));
}

RC_GTEST_PROP(ReadBag, GivesErrorOrContentForDamagedCopies, ()) {
  const TemporaryFolder folder;
  {
    BagWriter writer(bag_in(folder));
    write_turn(writer);
  }
  std::string bytes = folder.text_of("run.bag");
  const auto last = static_cast<int>(bytes.size());
  for (int i = *rc::gen::inRange(1, 4); i > 0; --i) {
    bytes[static_cast<std::size_t>(*rc::gen::inRange(0, last))] = *rc::gen::arbitrary<char>();
  }
  const std::string damaged = folder.with("damaged.bag", bytes);
  const std::string complaint = error_of([&] { recording_of(damaged); });
  RC_ASSERT(complaint == "(no error)" || contains(complaint, "damaged.bag: "));
}

TEST(ReadBag, GivesErrorOrAllForTornCopies) {
  const TemporaryFolder folder;
  {
    BagWriter writer(bag_in(folder));
    write_turn(writer);
  }
  const std::string whole = folder.text_of("run.bag");
  std::size_t refused = 0;
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 200) {
    const std::string torn = folder.with("torn.bag", whole.substr(0, size));
    const std::string complaint = error_of([&] { recording_of(torn); });
    EXPECT_TRUE(contains(complaint, "torn.bag: ")) << size;
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << size;
    refused += complaint == "(no error)" ? 0U : 1U;
  }
  EXPECT_GT(refused, 200U);
}

TEST(ReadBag, FollowsNoSizeOrPlaceInTheFileThatCannotBe) {
  const TemporaryFolder folder;
  {
    BagWriter writer(bag_in(folder));
    write_turn(writer);
  }
  // The error message for a bag with one byte replaced, `offset` after the last `before`.
  const auto with_byte = [&](const std::string& before, std::ptrdiff_t offset, char byte) {
    std::string bytes = folder.text_of("run.bag");
    const std::size_t place = bytes.rfind(before) + before.size();
    bytes.at(place + static_cast<std::size_t>(offset)) = byte;
    const std::string path = folder.with("changed.bag", bytes);
    return error_of([&] { recording_of(path); });
  };
  // The size of the last field in the file's header: rosbag would read beyond it.
  EXPECT_TRUE(contains(with_byte("chunk_count=", -15, 0x7f), "a record goes beyond its end"));
  EXPECT_TRUE(contains(with_byte("index_pos=", 0, 1), "the index is not at its stated position"));
  EXPECT_TRUE(contains(with_byte("chunk_pos=", 0, 1), "a chunk is not at its stated position"));
  EXPECT_TRUE(contains(with_byte("start_tim", 0, '_'), "a record has no field 'start_time'"));
  EXPECT_TRUE(contains(with_byte("topi", 0, '_'), "a record has no field 'topic'"));
}

TEST(ReadBag, LooksIntoCompressedChunksToo) {
  for (const char* compression : {"bz2", "lz4"}) {
    const TemporaryFolder folder;
    {
      BagWriter writer(bag_in(folder), compression);
      write_turn(writer);
    }
    std::string bytes = folder.text_of("run.bag");
    const std::size_t name = bytes.find(std::string("compression=") + compression);
    ASSERT_NE(name, std::string::npos);
    bytes.at(name + 400) = static_cast<char>(bytes.at(name + 400) + 1);
    const std::string path = folder.with("changed.bag", bytes);
    EXPECT_TRUE(contains(error_of([&] { recording_of(path); }), "a chunk can't be decompressed"))
        << compression;
  }
}

}  // namespace
}  // namespace tagfield
