// SPDX-License-Identifier: Apache-2.0
#include "adapters/rosbag2/recording_files.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

std::string metadata_of(const std::string& files, const std::string& mode = "\"\"") {
  return "rosbag2_bagfile_information:\n  version: 8\n  storage_identifier: sqlite3\n"
         "  relative_file_paths: [" +
         files + "]\n  compression_format: \"\"\n  compression_mode: " + mode + "\n";
}

std::vector<std::string> names_of(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(fs::path(file).filename().string());
  return names;
}

TEST(RecordingFiles, AreKnownByNameAndBeginning) {
  const TemporaryFolder folder;
  EXPECT_TRUE(is_ros2_recording("x/run.mcap"));
  EXPECT_TRUE(is_ros2_recording("run.db3"));
  EXPECT_FALSE(is_ros2_recording("run.csv"));
  EXPECT_FALSE(is_ros2_recording(folder.path().string()));
  EXPECT_TRUE(is_ros2_recording(folder.with("a", "SQLite format 3\n")));
  EXPECT_TRUE(is_ros2_recording(folder.with("b", "\x89MCAP0\r\n")));
  EXPECT_FALSE(is_ros2_recording(folder.with("c", "SQLite")));
  (void)folder.with("run_0.db3", "");
  EXPECT_TRUE(is_ros2_recording(folder.path().string()));
}

TEST(RecordingFiles, OfAFolderAreThoseOfItsMetadataInTheirOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"b_0.db3", "a_1.db3", "other.db3"}) (void)folder.with(name, "");
  (void)folder.with("metadata.yaml", metadata_of("b_0.db3, gone.db3, a_1.db3"));
  Diagnostics diagnostics;
  const auto files = files_of_recording(folder.path().string(), diagnostics);
  EXPECT_EQ(names_of(files), (std::vector<std::string>{"b_0.db3", "a_1.db3"}));
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_TRUE(contains(diagnostics.warnings()[0], "metadata.yaml:4"));
  EXPECT_TRUE(contains(diagnostics.warnings()[0], "gone.db3 is not there"));
}

TEST(RecordingFiles, WithoutMetadataGoByTheirNumbers) {
  const TemporaryFolder folder;
  for (const char* name : {"run_10.mcap", "run_2.mcap", "run_1.mcap", "notes.txt"}) {
    (void)folder.with(name, "");
  }
  Diagnostics diagnostics;
  EXPECT_EQ(names_of(files_of_recording(folder.path().string(), diagnostics)),
            (std::vector<std::string>{"run_1.mcap", "run_2.mcap", "run_10.mcap"}));
  EXPECT_EQ(diagnostics.warnings().size(), 1U);
}

TEST(RecordingFiles, OutsideOfTheFolderAreRefused) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "bag");
  (void)folder.with("secret.db3", "");
  fs::create_symlink(folder.path() / "secret.db3", folder.path() / "bag/link.db3");
  const std::string bag = folder.file("bag");
  const std::string secret = folder.file("secret.db3");
  Diagnostics diagnostics;
  for (const std::string& name : {std::string("../secret.db3"), secret, std::string("link.db3"),
                                  std::string("x/../../secret.db3")}) {
    (void)folder.with("bag/metadata.yaml", metadata_of(name));
    EXPECT_TRUE(contains(error_of([&] { files_of_recording(bag, diagnostics); }),
                         "which is not in this folder"))
        << name;
  }
}

TEST(RecordingFiles, CompressedAsAWholeOrNotThereAreRefused) {
  const TemporaryFolder folder;
  (void)folder.with("run.db3", "");
  const std::string path = folder.path().string();
  Diagnostics diagnostics;
  const auto complaint = [&](const std::string& metadata) {
    (void)folder.with("metadata.yaml", metadata);
    return error_of([&] { files_of_recording(path, diagnostics); });
  };
  EXPECT_TRUE(contains(complaint(metadata_of("run.db3.zstd")), "compressed as a whole"));
  EXPECT_TRUE(contains(complaint(metadata_of("run.db3", "MESSAGE")), "compression_mode"));
  EXPECT_TRUE(contains(complaint(metadata_of("gone.db3")), "has none of the files"));
  EXPECT_TRUE(contains(complaint(metadata_of("")), "has none of the files"));
  EXPECT_TRUE(contains(complaint("a: ["), "metadata.yaml:1: not valid YAML"));
  EXPECT_TRUE(contains(complaint("{}"), "rosbag2_bagfile_information"));
}

}  // namespace
}  // namespace tagfield
