// SPDX-License-Identifier: Apache-2.0
#include "adapters/archive/unpacked_archive.h"

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

struct Packed {
  std::string name;
  std::string text;
  unsigned type = AE_IFREG;
  std::string link;  ///< Target of a link.
};

std::string text_in(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class Archives : public ::testing::Test {
 protected:
  Archives()
      : folder_(fs::temp_directory_path() /
                (std::string("archives_") +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~Archives() override { fs::remove_all(folder_); }

  /// An archive of these files; if the name contains ".csv.", the compressed text of the first
  /// only.
  [[nodiscard]] std::string packed(const std::string& name,
                                   const std::vector<Packed>& files) const {
    std::string path = (folder_ / name).string();
    archive* out = archive_write_new();
    if (name.find(".zst") != std::string::npos) archive_write_add_filter_zstd(out);
    if (name.find("gz") != std::string::npos) archive_write_add_filter_gzip(out);
    if (name.find(".csv.") == std::string::npos) {
      archive_write_set_format_pax_restricted(out);
    } else {
      archive_write_set_format_raw(out);
    }
    archive_write_open_filename(out, path.c_str());
    for (const Packed& file : files) add(out, file);
    archive_write_free(out);
    return path;
  }

  static void add(archive* out, const Packed& file) {
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, file.name.c_str());
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_filetype(entry, file.type);
    archive_entry_set_size(entry, static_cast<la_int64_t>(file.text.size()));
    if (file.type == AE_IFLNK) {
      archive_entry_set_symlink(entry, file.link.c_str());
    } else if (!file.link.empty()) {
      archive_entry_set_hardlink(entry, file.link.c_str());
    }
    archive_write_header(out, entry);
    archive_write_data(out, file.text.data(), file.text.size());
    archive_entry_free(entry);
  }

  [[nodiscard]] std::string complaint_of(const std::string& path,
                                         const ArchiveLimits& limits = {}) const {
    try {
      const UnpackedArchive unpacked(path, limits);
      return unpacked.tables().string();
    } catch (const Error& error) {
      const std::string said = error.what();
      return said.substr(said.rfind(folder_.string(), 0) == 0 ? folder_.string().size() + 1 : 0);
    }
  }

  fs::path folder_;
};

TEST_F(Archives, AreKnownByTheirNames) {
  for (const char* name : {"a.tar", "x/a.tar.zst", "a.tar.gz", "a.tgz", "a.tar.xz", "a.csv.zst"}) {
    EXPECT_TRUE(is_archive(name)) << name;
  }
  for (const char* name : {"a.csv", "a.zst", "a.bag", "a.tar.csv", ".tar", "a"}) {
    EXPECT_FALSE(is_archive(name)) << name;
  }
  const fs::path folder = folder_ / "folder.tar";
  fs::create_directory(folder);
  EXPECT_FALSE(is_archive(folder.string()));
}

TEST_F(Archives, BecomeAFolderOfTables) {
  for (const char* name : {"a.tar", "a.tar.zst", "a.tgz"}) {
    const std::string path = packed(name, {{"set", "", AE_IFDIR, ""},
                                           {"set/run/1.csv", "one\n", AE_IFREG, ""},
                                           {"set/run/2.csv", "two\n", AE_IFREG, ""},
                                           {"set/notes.txt", "left alone", AE_IFREG, ""}});
    fs::path folder;
    {
      const UnpackedArchive unpacked(path);
      folder = unpacked.folder();
      EXPECT_EQ(unpacked.tables(), folder / "set/run");
      EXPECT_EQ(text_in(unpacked.tables() / "1.csv"), "one\n");
      EXPECT_EQ(text_in(unpacked.tables() / "2.csv"), "two\n");
      EXPECT_FALSE(fs::exists(folder / "set/notes.txt"));
    }
    EXPECT_FALSE(fs::exists(folder)) << name;
  }
}

TEST_F(Archives, MayBeOneTable) {
  const std::string text(200'000, 'x');
  for (const char* name : {"log.csv.zst", "log.csv.gz"}) {
    const UnpackedArchive unpacked(packed(name, {{"data", text, AE_IFREG, ""}}));
    EXPECT_EQ(unpacked.tables().filename(), "log.csv");
    EXPECT_EQ(text_in(unpacked.tables()), text);
  }
  const UnpackedArchive one(packed("one.tar", {{"deep/t.csv", "1", AE_IFREG, ""}}));
  EXPECT_EQ(one.tables(), one.folder() / "deep/t.csv");
}

TEST_F(Archives, NothingGetsOutOfTheirFolder) {
  const std::string outside = (folder_ / "outside.csv").string();
  EXPECT_EQ(complaint_of(packed("up.tar", {{"../outside.csv", "x", AE_IFREG, ""}})),
            "up.tar: holds '../outside.csv', which leads out of it: it is not unpacked");
  EXPECT_EQ(complaint_of(packed("up.tar", {{"a/../../outside.csv", "x", AE_IFREG, ""}})),
            "up.tar: holds 'a/../../outside.csv', which leads out of it: it is not unpacked");
  EXPECT_EQ(complaint_of(packed("root.tar", {{outside, "x", AE_IFREG, ""}})),
            "root.tar: holds '" + outside + "', which leads out of it: it is not unpacked");
  EXPECT_FALSE(fs::exists(outside));
}

TEST_F(Archives, LinksAreRefused) {
  EXPECT_EQ(complaint_of(packed("soft.tar", {{"a", "", AE_IFLNK, folder_.string()},
                                             {"a/outside.csv", "x", AE_IFREG, ""}})),
            "soft.tar: holds the link 'a': it is not unpacked");
  EXPECT_EQ(complaint_of(packed("hard.tar", {{"a.csv", "", AE_IFREG, "/etc/passwd"}})),
            "hard.tar: holds the link 'a.csv': it is not unpacked");
  EXPECT_EQ(complaint_of(packed("pipe.tar", {{"a.csv", "", AE_IFIFO, ""}})),
            "pipe.tar: holds 'a.csv', which is not a file: it is not unpacked");
  EXPECT_FALSE(fs::exists(folder_ / "outside.csv"));
}

TEST_F(Archives, AreBounded) {
  const std::string zeros(1'000'000, '0');
  const std::string bomb = packed("bomb.tar.zst", {{"a.csv", zeros, AE_IFREG, ""}});
  EXPECT_LT(fs::file_size(bomb), 10'000U);
  EXPECT_EQ(complaint_of(bomb, {999'999, 10}),
            "bomb.tar.zst: holds more than 999999 bytes: it is not unpacked");
  const std::string two =
      packed("two.tar", {{"a.txt", "", AE_IFREG, ""}, {"b.csv", "", AE_IFREG, ""}});
  EXPECT_EQ(complaint_of(two, {100, 1}), "two.tar: holds more than 1 files: it is not unpacked");
  EXPECT_NE(complaint_of(two, {100, 2}).find("b.csv"), std::string::npos);
}

TEST_F(Archives, ThatMakeNoSenseAreRefused) {
  EXPECT_EQ(complaint_of(packed("none.tar", {{"a.txt", "x", AE_IFREG, ""}})),
            "none.tar: holds no tables (*.csv)");
  EXPECT_EQ(complaint_of(packed("two.tar",
                                {{"a/1.csv", "x", AE_IFREG, ""}, {"b/1.csv", "x", AE_IFREG, ""}})),
            "two.tar: holds tables in several folders, expected those of one recording");
  EXPECT_EQ(complaint_of(packed("twice.tar",
                                {{"a.csv", "x", AE_IFREG, ""}, {"./a.csv", "x", AE_IFREG, ""}})),
            "twice.tar: holds 'a.csv' twice: it is not unpacked");
  EXPECT_EQ(complaint_of(packed("long.tar", {{std::string(300, 'a') + ".csv", "x", AE_IFREG, ""}})),
            "long.tar: can't be unpacked: File name too long");
  std::ofstream(folder_ / "text.tar.zst") << "no archive at all";
  EXPECT_EQ(complaint_of((folder_ / "text.tar.zst").string()).rfind("text.tar.zst: can't be", 0),
            0U);
  std::ofstream(folder_ / "text.csv.gz") << "a,b\n1,2\n";
  EXPECT_EQ(complaint_of((folder_ / "text.csv.gz").string()),
            "text.csv.gz: can't be unpacked: it is not compressed");
  EXPECT_EQ(complaint_of((folder_ / "gone.tar").string()).rfind("gone.tar: can't be", 0), 0U);
  std::string numbers;
  for (int i = 0; i < 20'000; ++i) numbers += std::to_string(i) + "\n";
  const std::string whole = packed("cut.tar.gz", {{"a.csv", numbers, AE_IFREG, ""}});
  fs::resize_file(whole, fs::file_size(whole) / 2);
  EXPECT_EQ(complaint_of(whole).rfind("cut.tar.gz: can't be unpacked", 0), 0U);
}

}  // namespace
}  // namespace tagfield
