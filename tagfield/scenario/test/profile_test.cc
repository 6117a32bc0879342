// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/profile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tagfield/base/error.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shipped(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::directory_iterator(fs::path(TAGFIELD_SOURCE_DIR) / "profiles" / folder)) {
    files.push_back(entry.path());
  }
  return files;
}

std::string written(const std::string& text) {
  const fs::path path = fs::path(testing::TempDir()) / "profile_under_test.yaml";
  std::ofstream(path) << text;
  return path.string();
}

std::string profile_complaint(const std::string& text) {
  const std::string path = written(text);
  try {
    read_profile(path);
  } catch (const Error& error) {
    const std::string message = error.what();
    return message.substr(message.find(path) + path.size());
  }
  return "";
}

TEST(ShippedProfiles, AreEnoughAndMakeModelsWithoutAWarning) {
  EXPECT_GE(shipped("readers").size(), 3U);
  EXPECT_GE(shipped("antennas").size(), 3U);
  EXPECT_GE(shipped("tags").size(), 4U);
  Diagnostics diagnostics;
  for (const fs::path& reader : shipped("readers")) {
    for (const fs::path& antenna : shipped("antennas")) {
      std::vector<RawParameter> both = read_profile(reader).parameters;
      const auto more = read_profile(antenna).parameters;
      both.insert(both.end(), more.begin(), more.end());
      const auto model = radio_model_from(PropagationModel::kMultipath, both, {}, diagnostics);
      EXPECT_TRUE(model->gen2) << reader;
    }
  }
  for (const fs::path& tag : shipped("tags")) {
    const Profile profile = read_profile(tag);
    EXPECT_EQ(profile.kind, ProfileKind::kTag);
    EXPECT_LT(tag_model_from("t", profile.parameters, {}, diagnostics)->sensitivity_dbm, -15.0);
  }
  for (const std::string& warning : diagnostics.warnings()) ADD_FAILURE() << warning;
}

TEST(ReadProfile, WantsASourceForEachFigure) {
  EXPECT_EQ(profile_complaint("name: x\nkind: tag\nfigures:\n  gain_dbi: {value: 2}\n"),
            ":4: figures.gain_dbi has no 'source'");
}

TEST(ReadProfile, NamesAKeyThatIsNone) {
  EXPECT_EQ(
      profile_complaint("name: x\nkind: tag\nfigures:\n  gain_db: {value: 2, source: s}\n"),
      ":4: figures.gain_db is not a setting of a profile of this kind (did you mean 'gain_dbi'?)");
  EXPECT_NE(profile_complaint("name: x\nkind: boat\nfigures: {}\n"), "");
}

}  // namespace
}  // namespace tagfield
