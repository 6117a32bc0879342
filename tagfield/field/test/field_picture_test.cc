// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/field_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/field/rfid_field.h"

namespace tagfield {
namespace {

/// Records the times at which it would draw.
class Picture final : public FieldPicture {
 public:
  using FieldPicture::FieldPicture;
  std::vector<Time> drawn;
  std::map<std::string, ReadColor> colors;
  std::map<std::string, SeenAntenna> seen;

 protected:
  void draw(Time stamp) override {
    drawn.push_back(stamp);
    colors.clear();
    seen = antennas();
    for (const auto& [id, tag] : tags()) colors[id] = color_of(tag, stamp);
  }
};

class PictureOfAField : public testing::Test {
 protected:
  PictureOfAField() {
    Outlets outlets;
    attach(picture, outlets);
    field = std::make_unique<RfidField>(outlets);
    antenna->parameters.name = "gate";
    paper(antenna->parameters).range_m = 6.0;
    paper(antenna->parameters).model.rssi_noise = 0.0;
    FieldStep step;
    step.antennas_added = {antenna};
    field->step(step);
  }

  void step(double seconds, const std::vector<TagAdded>& added = {},
            const std::vector<std::uint32_t>& removed = {}) {
    FieldStep step;
    step.stamp = time_from_seconds(seconds);
    step.added = added;
    step.removed = removed;
    step.due = {{antenna, from_translation({0.0, 0.0, 0.0}), std::nullopt}};
    field->step(step);
  }

  std::shared_ptr<FieldAntenna> antenna = std::make_shared<FieldAntenna>();
  std::shared_ptr<Picture> picture = std::make_shared<Picture>(std::chrono::milliseconds(500));
  std::unique_ptr<RfidField> field;
};

TEST(ReadColor, GoesFromFaintBlueOverGreenToFullRed) {
  EXPECT_EQ(read_color(0.0).blue, 1.0);
  EXPECT_EQ(read_color(0.5).green, 1.0);
  EXPECT_EQ(read_color(1.0).red, 1.0);
  EXPECT_EQ(read_color(1.0).alpha, 1.0);
  EXPECT_LT(read_color(0.0).alpha, read_color(0.5).alpha);
  EXPECT_GT(read_color(0.0).alpha, 0.0);
  for (const double share : {-1.0, 2.0, std::nan(""), 0.3}) {
    const ReadColor color = read_color(share);
    EXPECT_NEAR(color.red + color.green + color.blue, 1.0, 1e-12) << share;
  }
}

TEST_F(PictureOfAField, IsDrawnAtItsIntervals) {
  for (int i = 0; i <= 15; ++i) step(i / 15.0);
  EXPECT_EQ(picture->drawn.size(), 2U);  // At 0 and at 8/15 s.
  step(0.0);                             // Time jumped back.
  EXPECT_EQ(picture->drawn.size(), 3U);
}

TEST_F(PictureOfAField, NearTagsAreRedFarOnesBlueUnreadOnesGrey) {
  step(0.0, {{0, "near", "", from_translation({1.0, 0.0, 0.0})},
             {1, "far", "", from_translation({4.0, 0.0, 0.0})},
             {2, "away", "", from_translation({90.0, 0.0, 0.0})}});
  EXPECT_EQ(picture->colors.at("near").red, 1.0);
  EXPECT_EQ(picture->colors.at("far").blue, 1.0);
  EXPECT_EQ(picture->colors.at("away").red, silent_color().red);
  EXPECT_EQ(picture->seen.at("gate").range_m, 6.0);
}

TEST_F(PictureOfAField, AnotherTagInTheSameSlotHasNotBeenRead) {
  step(0.0, {{0, "near", "", from_translation({1.0, 0.0, 0.0})}});
  step(0.5, {{0, "away", "", from_translation({90.0, 0.0, 0.0})}}, {0});
  EXPECT_EQ(picture->colors.count("near"), 0U);
  EXPECT_EQ(picture->colors.at("away").alpha, silent_color().alpha);
  EXPECT_EQ(picture->colors.at("away").green, silent_color().green);
}

TEST_F(PictureOfAField, ForgetsAnAntennaThatWent) {
  step(0.0);
  FieldStep gone;
  gone.stamp = time_from_seconds(0.1);
  gone.antennas_removed = {"gate"};
  field->step(gone);
  auto other = std::make_shared<FieldAntenna>();
  other->parameters.name = "other";
  FieldStep next;
  next.antennas_added = {other};
  next.stamp = time_from_seconds(1.0);
  next.due = {{other, from_translation({0.0, 0.0, 0.0}), std::nullopt}};
  field->step(next);
  EXPECT_EQ(picture->seen.count("gate"), 0U);
  EXPECT_EQ(picture->seen.count("other"), 1U);
}

}  // namespace
}  // namespace tagfield
