// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/coverage.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "tagfield/report/coverage_figure.h"
#include "tagfield/report/coverage_page.h"
#include "tagfield/report/internal/color_bands.h"

namespace tagfield {
namespace {

/// Two cells: one read, one where no signal arrives.
Coverage two_cells() {
  Coverage coverage;
  coverage.scenario = "a <hall>";
  coverage.antennas = {{"gate, west", {{0.0, 0.0, 1.0}}, false}};
  coverage.grid = {{-0.5, 0.0}, 0.5, 2, 1};
  coverage.layers = {{1.25, {{-10.0, -50.0, 8.0, 0.75, 0}, {}}}};
  TagCoverage tag;
  tag.id = "lost";
  tag.nearest = 0;
  tag.nearest_m = 3.0;
  coverage.tags = {tag};
  return coverage;
}

TEST(Coverage, IsATableWithoutWhatIsNotThere) {
  const Coverage coverage = two_cells();
  EXPECT_EQ(coverage_file(coverage.layers.front()), "coverage_1.25m.csv");
  EXPECT_EQ(coverage_to_csv(coverage, coverage.layers.front()),
            "x_m,y_m,power_dbm,reply_dbm,margin_db,probability,antenna\n"
            "-0.2500,0.2500,-10.00,-50.00,8.00,0.750,\"gate, west\"\n"
            "0.2500,0.2500,,,,0.000,\n");
  EXPECT_EQ(
      coverage_tags_to_csv(coverage),
      "tag,x_m,y_m,z_m,verdict,nearest,nearest_m,meant_for,read_by,read_probability,power_dbm,"
      "reply_dbm,margin_db,probability\n"
      "lost,0.0000,0.0000,0.0000,never,\"gate, west\",3.000,,,0.000,,,,0.000\n");
}

TEST(Coverage, SumsUpAsJson) {
  const auto json = nlohmann::json::parse(coverage_to_json(two_cells()));
  EXPECT_EQ(json["heights"][0]["share_read"], 0.5);
  EXPECT_EQ(json["heights"][0]["min_margin_db"], 8.0);
  EXPECT_EQ(json["tag_counts"]["never"], 1);
  EXPECT_TRUE(json["tags"][0]["margin_db"].is_null());
  EXPECT_EQ(json["region_m"], (std::vector<double>{-0.5, 0.0, 0.5, 0.5}));
}

TEST(Coverage, IsAPageThatHoldsAllMaps) {
  Coverage coverage = two_cells();
  coverage.warnings = {"one", "two", "three"};
  const std::vector<Figure> figures = coverage_figures(coverage, {});
  ASSERT_EQ(figures.size(), 4U);  // Probability, margin, power; the tags.
  const std::string page = coverage_page(coverage, figures);
  EXPECT_NE(page.find("a &lt;hall&gt;"), std::string::npos);
  EXPECT_NE(page.find("id=\"margin_1.25m\""), std::string::npos);
  EXPECT_NE(page.find("never read"), std::string::npos);
  EXPECT_NE(page.find("<summary><strong>3 warnings</strong></summary>"), std::string::npos);
  EXPECT_LT(page.rfind("<figure"), page.find("<table"));
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

using Box = Eigen::AlignedBox2d;

/// The boxes of all matches of `pattern`, whose groups are four numbers or a text's place.
std::vector<Box> boxes_of(const std::string& svg, const std::regex& pattern) {
  std::vector<Box> boxes;
  for (std::sregex_iterator found(svg.begin(), svg.end(), pattern), end; found != end; ++found) {
    const Eigen::Vector2d corner(std::stod((*found)[1]), std::stod((*found)[2]));
    boxes.emplace_back(corner,
                       corner + Eigen::Vector2d(std::stod((*found)[3]), std::stod((*found)[4])));
  }
  return boxes;
}

std::vector<Box> names_of(const std::string& svg) {
  const std::regex pattern(
      R"re(<text x="([\d.]+)" y="([\d.]+)"(?: text-anchor="(\w+)")? class="rim">([^<]*)<)re");
  std::vector<Box> boxes;
  for (std::sregex_iterator found(svg.begin(), svg.end(), pattern), end; found != end; ++found) {
    const double width = text_width((*found)[4]);
    const std::string anchor = (*found)[3];
    const double left = std::stod((*found)[1]) - (anchor == "middle" ? width / 2
                                                  : anchor == "end"  ? width
                                                                     : 0.0);
    const double baseline = std::stod((*found)[2]);
    boxes.emplace_back(Eigen::Vector2d(left, baseline - 11.0),
                       Eigen::Vector2d(left + width, baseline + 3.0));
  }
  return boxes;
}

TEST(CoverageFigure, NamesOfAntennasCoverNeitherEachOtherNorAntennas) {
  Coverage coverage = two_cells();
  coverage.grid = {{-15.0, -5.0}, 15.0, 2, 1};
  coverage.antennas.clear();
  for (int i = 0; i < 4; ++i) {
    const std::string name = "doorway_" + std::to_string(i);
    coverage.antennas.push_back({name, {{1.5 * i - 3.0, 2.0, 1.0}}, false});
  }
  const std::string svg =
      coverage_figure(coverage, coverage.layers.front(), CoverageQuantity::kMargin, {}).svg.body;
  const std::vector<Box> antennas = boxes_of(
      svg,
      std::regex(
          R"re(<rect x="([\d.]+)" y="([\d.]+)" width="(14)" height="(12)" class="antenna")re"));
  const std::vector<Box> names = names_of(svg);
  EXPECT_EQ(antennas.size(), 4U);
  EXPECT_GE(names.size(), 2U);
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const Box& antenna : antennas) EXPECT_FALSE(names[i].intersects(antenna)) << i;
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(names[i].intersects(names[j])) << i << j;
  }
}

/// A row of `count` antennas, each best in three by three cells around it.
Coverage row_of_antennas(std::size_t count) {
  Coverage coverage = two_cells();
  coverage.antennas.clear();
  coverage.grid.columns = 3 * count;
  coverage.grid.rows = 3;
  coverage.grid.step_m = 1.0;
  CoverageLayer layer = coverage.layers.front();
  layer.cells.assign(9 * count, CoverageCell{});
  for (std::size_t i = 0; i < layer.cells.size(); ++i) {
    layer.cells[i].antenna = static_cast<int>((i % (3 * count)) / 3);
    layer.cells[i].probability = 1.0;
  }
  coverage.layers = {layer};
  for (std::size_t i = 0; i < count; ++i) {
    CoverageAntenna antenna;
    antenna.name = "gate_" + std::to_string(i + 1);
    coverage.antennas.push_back(antenna);
  }
  return coverage;
}

std::size_t times_in(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(CoverageFigure, AntennasBeyondEightAreTold) {
  for (const std::size_t count : {8U, 9U, 24U, 30U}) {
    const Coverage coverage = row_of_antennas(count);
    const std::string body =
        coverage_figure(coverage, coverage.layers.front(), CoverageQuantity::kAntenna, {}).svg.body;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string number = std::to_string(i + 1);
      // In the legend and, with its rim, in the cells.
      EXPECT_EQ(times_in(">" + number + ": gate_" + number + "<", body), count > 8 ? 1U : 0U);
      EXPECT_GE(times_in(">" + number + "</text>", body), count > 8 ? 2U : 0U) << number;
    }
    std::set<std::string> colors;
    for (std::size_t i = 0; i < count; ++i) colors.insert(color_of_kind(i));
    EXPECT_EQ(colors.size(), std::min<std::size_t>(count, 24));
  }
}

TEST(ColorBands, HoldTheirLowerEdge) {
  const ColorBands bands = margin_bands();
  ASSERT_EQ(bands.colors.size(), bands.edges.size() + 1);
  EXPECT_EQ(band_of(bands, -400.0), 0U);
  EXPECT_EQ(band_of(bands, -0.1), 4U);
  EXPECT_EQ(band_of(bands, 0.0), 5U);
  EXPECT_EQ(band_of(bands, 1e9), bands.edges.size());
}

TEST(ColorBands, AreSaidWithTheirEdges) {
  const ColorBands bands = margin_bands();
  EXPECT_EQ(words_of_band(bands, band_of(bands, -400.0)), "margin [dB]: below −30");
  EXPECT_EQ(words_of_band(bands, band_of(bands, 5.0)), "margin [dB]: 3 to 10");
  EXPECT_EQ(words_of_band(bands, band_of(bands, 1e9)), "margin [dB]: 30 or more");
  EXPECT_NE(band_look("#123456", "a < b").attributes.find("data-cell=\"a &lt; b\""),
            std::string::npos);
}

TEST(ColorBands, OfPowersAreFewAndRound) {
  const ColorBands bands = power_bands("power [dBm]", {-400.0, -63.0, -20.0, 12.0, 14.0});
  EXPECT_LE(bands.colors.size(), 13U);
  for (const double edge : bands.edges) EXPECT_EQ(edge, 5.0 * std::round(edge / 5.0));
  EXPECT_EQ(power_bands("", {}).colors.size(), power_bands("", {}).edges.size() + 1);
}

}  // namespace
}  // namespace tagfield
