// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/map_file.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

using namespace std::string_literals;
using Cells = std::vector<std::int8_t>;

/// Output of ROS's map_saver for a map of 4 × 2 cells: the lower row is free except for one unknown
/// cell, the upper one occupied except for one.
constexpr const char* kSavedYaml =
    "image: saved.pgm\n"
    "resolution: 0.050000\n"
    "origin: [-100.000000, -51.200001, 0.000000]\n"
    "negate: 0\n"
    "occupied_thresh: 0.65\n"
    "free_thresh: 0.196\n"
    "\n";
const std::string kSavedPgm =
    "P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n4 2\n255\n\x00\x00\xcd\x00\xfe\xcd\xfe\xfe"s;

std::string yaml_with(const std::string& lines) {
  return "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
         "free_thresh: 0.196\n" +
         lines;
}

/// `yaml_with("")` with one line replaced.
std::string yaml_but(const std::string& key, const std::string& line) {
  std::string text = yaml_with("");
  const std::size_t begin = text.find(key + ":");
  return text.replace(begin, text.find('\n', begin) - begin, line);
}

OccupancyGrid read(const std::string& yaml, const std::string& pgm) {
  const TemporaryFolder& folder = folder_of_test();
  (void)folder.with("map.pgm", pgm);
  Diagnostics diagnostics;
  const OccupancyGrid grid = read_map(folder.with("map.yaml", yaml), diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  return grid;
}

/// Error message for a YAML file with a valid image, without the folder's name.
std::string refusal(const std::string& yaml) {
  const std::string message = error_of([&yaml] { read(yaml, "P5 1 1 255\nA"); });
  const std::size_t name = message.find("/map.yaml");
  return name == std::string::npos ? message : message.substr(name + 1);
}

TEST(MapFile, ReadsWhatMapSaverWrites) {
  const TemporaryFolder& folder = folder_of_test();
  (void)folder.with("saved.pgm", kSavedPgm);
  Diagnostics diagnostics;
  const OccupancyGrid grid = read_map(folder.with("saved.yaml", kSavedYaml), diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  EXPECT_EQ(grid.resolution_m, 0.05);
  EXPECT_EQ(grid.width, 4);
  EXPECT_EQ(grid.height, 2);
  EXPECT_EQ(grid.origin, Eigen::Vector2d(-100.0, -51.200001));
  // The image's last row is the grid's first.
  EXPECT_EQ(grid.cells, (Cells{0, -1, 0, 0, 100, 100, -1, 100}));
}

TEST(MapFile, WritesWhatMapServerReads) {
  OccupancyGrid grid;
  grid.width = 4;
  grid.height = 2;
  grid.origin = {-1.5, 2.25};
  grid.cells = {0, -1, 19, 0, 100, 65, 20, 64};
  EXPECT_EQ(map_to_pgm(grid), "P5\n# 0.05 m a cell\n4 2\n255\n\x00\x00\xcd\xcd\xfe\xcd\xfe\xfe"s);
  EXPECT_EQ(map_to_yaml(grid, "hall.pgm"),
            "image: \"hall.pgm\"\nresolution: 0.05\norigin: [-1.5, 2.25, 0.0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

RC_GTEST_PROP(MapFile, MapsComeBackAsTheyWere, ()) {
  OccupancyGrid grid;
  grid.width = *rc::gen::inRange(1, 20);
  grid.height = *rc::gen::inRange(1, 20);
  grid.resolution_m = 1e-3 * *rc::gen::inRange(1, 2000);
  grid.origin = {0.001 * *rc::gen::inRange(-100'000, 100'000) / 3.0,
                 0.001 * *rc::gen::inRange(-100'000, 100'000)};
  for (int i = 0; i < grid.width * grid.height; ++i) {
    grid.cells.push_back(*rc::gen::element<std::int8_t>(-1, 0, 100));
  }
  const TemporaryFolder folder;
  const std::string image = *rc::gen::element("map.pgm"s, "my map: \"#1\".pgm"s, "Plan é.pgm"s);
  (void)folder.with(image, map_to_pgm(grid));
  Diagnostics diagnostics;
  const OccupancyGrid back = read_map(folder.with("a.yaml", map_to_yaml(grid, image)), diagnostics);
  RC_ASSERT(diagnostics.warnings().empty());
  RC_ASSERT(back.width == grid.width);
  RC_ASSERT(back.height == grid.height);
  RC_ASSERT(back.resolution_m == grid.resolution_m);
  RC_ASSERT(back.origin == grid.origin);
  RC_ASSERT(back.cells == grid.cells);
}

TEST(MapFile, TrinaryGreysLieAboveBelowOrBetweenTheThresholds) {
  // Occupied is (255 − grey)/255: 0.196 and 0.65 are greys 205.02 and 89.25.
  const std::string pgm = "P2 6 1 255 255 206 205 90 89 0";
  EXPECT_EQ(read(yaml_with(""), pgm).cells, (Cells{0, 0, -1, -1, 100, 100}));
  EXPECT_EQ(read(yaml_with("mode: trinary\n"), pgm).cells, (Cells{0, 0, -1, -1, 100, 100}));
}

TEST(MapFile, NegateTurnsDarkAndLightOver) {
  const std::string pgm = "P2 6 1 255 0 49 50 165 166 255";
  EXPECT_EQ(read(yaml_but("negate", "negate: 1"), pgm).cells, (Cells{0, 0, -1, -1, 100, 100}));
  EXPECT_EQ(read(yaml_but("negate", "negate: true"), pgm).cells, (Cells{0, 0, -1, -1, 100, 100}));
}

TEST(MapFile, ScaledGreysAreSharesBetweenTheThresholds) {
  std::string yaml = yaml_but("free_thresh", "free_thresh: 0.25");
  yaml.replace(yaml.find("0.65"), 4, "0.75");
  // With 100 greys: occupied 0.2, 0.3, 0.5, 0.7, 0.8; 1 + 98·(occupied − 0.25)/0.5, truncated.
  EXPECT_EQ(read(yaml + "mode: scale\n", "P2 5 1 100 80 70 50 30 20").cells,
            (Cells{0, 10, 50, 89, 100}));
}

TEST(MapFile, RawGreysAreTheCells) {
  EXPECT_EQ(read(yaml_with("mode: raw\n"), "P2 6 1 255 0 1 64 100 101 255").cells,
            (Cells{0, 1, 64, 100, -1, -1}));
}

TEST(MapFile, SixteenBitsAreSharesOfTheGreatestGrey) {
  EXPECT_EQ(read(yaml_with(""), "P5 3 1 65535\n\x00\x00\xcd\xcd\xff\xff"s).cells,
            (Cells{100, -1, 0}));
  EXPECT_EQ(read(yaml_with(""), "P2 3 1 1000 0 800 1000").cells, (Cells{100, -1, 0}));
}

TEST(MapFile, TheImageIsBesideTheYamlWhereverThatIs) {
  const TemporaryFolder& folder = folder_of_test();
  (void)folder.with("sub/images/m.pgm", "P5 1 1 255\n\xfe");
  Diagnostics diagnostics;
  const std::string yaml = folder.with("sub/m.yaml", yaml_but("image", "image: images/m.pgm"));
  EXPECT_EQ(read_map(yaml, diagnostics).cells, Cells{0});
  const std::string absolute =
      folder.with("other.yaml", yaml_but("image", "image: " + folder.file("sub/images/m.pgm")));
  EXPECT_EQ(read_map(absolute, diagnostics).cells, Cells{0});
}

TEST(MapFile, WarnsOfUnknownKeys) {
  const TemporaryFolder& folder = folder_of_test();
  (void)folder.with("map.pgm", "P5 1 1 255\nA");
  Diagnostics diagnostics;
  read_map(folder.with("map.yaml", yaml_with("mod: scale\n")), diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_EQ(diagnostics.warnings()[0],
            folder.file("map.yaml") + ":7: unknown key 'mod' (did you mean 'mode'?)");
}

TEST(MapFile, RefusesBadYaml) {
  EXPECT_EQ(refusal(""), "map.yaml: the file is empty");
  EXPECT_EQ(refusal("\n\n"), "map.yaml:1: is not a map's YAML: expected 'image: …' and so on");
  EXPECT_EQ(refusal("just words"),
            "map.yaml:1: is not a map's YAML: expected 'image: …' and so on");
  EXPECT_TRUE(contains(refusal("image: [a\n"), "is not YAML: "));
  EXPECT_TRUE(contains(refusal("image: a\n\tb: 3"), "is not YAML: "));
  EXPECT_EQ(refusal(yaml_with("negate: 1\n")), "map.yaml:7: has 'negate' twice");
  EXPECT_EQ(refusal(yaml_with("[a, b]: 1\n")), "map.yaml:7: a key is not a word");
}

TEST(MapFile, RefusesMissingAndBadValues) {
  for (const char* key :
       {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}) {
    EXPECT_EQ(refusal(yaml_but(key, "")), "map.yaml: has no '"s + key + "'");
    EXPECT_TRUE(contains(refusal(yaml_but(key, key + ": {a: 1}"s)), key + " must be"s)) << key;
    EXPECT_TRUE(contains(refusal(yaml_but(key, key + ":"s)), key + " must be"s)) << key;
  }
  EXPECT_EQ(refusal(yaml_but("resolution", "resolution: 0.0")),
            "map.yaml:2: resolution must be greater than 0 [m]");
  EXPECT_EQ(refusal(yaml_but("resolution", "resolution: -0.05")),
            "map.yaml:2: resolution must be 0 to 1000, is -0.05");
  for (const char* bad : {".nan", ".inf", "1e999", "5cm", "~"}) {
    EXPECT_TRUE(contains(refusal(yaml_but("resolution", "resolution: "s + bad)), "resolution must"))
        << bad;
  }
  EXPECT_EQ(refusal(yaml_but("origin", "origin: [0, 0]")),
            "map.yaml:3: origin must be [x, y, yaw]");
  EXPECT_EQ(refusal(yaml_but("origin", "origin: [0, .nan, 0]")),
            "map.yaml:3: origin must be a number");
  EXPECT_EQ(refusal(yaml_but("origin", "origin: [0, 1e300, 0]")),
            "map.yaml:3: origin must be -1000000000 to 1000000000, is 1e+300");
  EXPECT_EQ(refusal(yaml_but("origin", "origin: [0, 0, 0.1]")),
            "map.yaml:3: origin has a yaw of 0.1, but must have 0");
  EXPECT_EQ(refusal(yaml_but("negate", "negate: 2")), "map.yaml:4: negate must be 0 or 1, is '2'");
  EXPECT_EQ(refusal(yaml_but("free_thresh", "free_thresh: 0.7")),
            "map.yaml:6: free_thresh must be less than occupied_thresh (0.65), is 0.7");
  EXPECT_EQ(refusal(yaml_but("occupied_thresh", "occupied_thresh: 1.1")),
            "map.yaml:5: occupied_thresh must be 0 to 1, is 1.1");
  EXPECT_EQ(refusal(yaml_with("mode: binary\n")),
            "map.yaml:7: mode 'binary' is not trinary, scale or raw");
}

TEST(MapFile, RefusesMissingFilesAndTornImages) {
  const TemporaryFolder& folder = folder_of_test();
  Diagnostics diagnostics;
  const auto message = [&](const std::string& path) {
    return error_of([&] { read_map(path, diagnostics); });
  };
  EXPECT_EQ(message(folder.file("none.yaml")), folder.file("none.yaml") + ": no such file");
  EXPECT_EQ(message(folder.path().string()),
            folder.path().string() + ": is a folder, expected a file");
  const std::string yaml = folder.with("map.yaml", yaml_with(""));
  EXPECT_EQ(message(yaml), folder.file("map.pgm") + ": no such file");
  (void)folder.with("map.pgm", "");
  EXPECT_EQ(message(yaml), folder.file("map.pgm") + ": byte 0: the file is empty");
  (void)folder.with("map.pgm", kSavedPgm.substr(0, kSavedPgm.size() - 1));
  EXPECT_EQ(message(yaml),
            folder.file("map.pgm") + ": byte 48: 4 × 2 cells need 8 bytes, and 7 are there");
  EXPECT_EQ(message("/dev/zero"), "/dev/zero: is a device, expected a file");
  const std::string long_yaml = folder.with("long.yaml", std::string(1'000'001, '#'));
  EXPECT_EQ(message(long_yaml), long_yaml + ": is longer than 1000000 bytes");
}

RC_GTEST_PROP(MapFile, TornOrSpoiltYamlIsRefusedOrRead, ()) {
  const TemporaryFolder folder;
  (void)folder.with("map.pgm", "P5 2 1 255\n\xfe\x01");
  std::string text = yaml_with("mode: scale\n");
  if (*rc::gen::arbitrary<bool>()) text.resize(*rc::gen::inRange<std::size_t>(0, text.size()));
  for (int i = *rc::gen::inRange(0, 6); i > 0 && !text.empty(); --i) {
    text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
  }
  Diagnostics diagnostics;
  try {
    const OccupancyGrid grid = read_map(folder.with("map.yaml", text), diagnostics);
    RC_ASSERT(grid.cells.size() == 2U);
    RC_ASSERT(std::isfinite(grid.resolution_m) && grid.resolution_m > 0.0);
    RC_ASSERT(grid.origin.allFinite());
  } catch (const Error& error) {
    RC_ASSERT(std::string(error.what()).rfind(folder.path().string(), 0) == 0);
  }
}

}  // namespace
}  // namespace tagfield
