// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/radio_world.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace tagfield {
namespace {

Scene scene_of(const std::vector<std::string>& names) {
  Scene scene;
  for (const std::string& name : names) scene.collisions.push_back({name, Box{{1, 1, 1}}, {}});
  return scene;
}

std::string material_of(const RadioWorld& world, std::size_t solid) {
  return world.materials[world.material_of[solid]].name;
}

MaterialRule rule(const std::string& name, const std::string& material) {
  return {name, find_material(known_materials(), material), {"s.yaml", 7}};
}

TEST(RadioWorld, GuessesFromTheInnermostNameOutwardsAndSaysSo) {
  Diagnostics diagnostics;
  const RadioWorld world = radio_world(
      scene_of({"rack_1::link::frame", "rack_1::link::cardboard_box", "hall::link::north_wall",
                "aws_robomaker_warehouse_ShelfE_01_001::link::collision", "thing::link::c"}),
      {}, diagnostics);
  EXPECT_EQ(material_of(world, 0), "metal");
  EXPECT_EQ(material_of(world, 1), "cardboard");
  EXPECT_EQ(material_of(world, 2), "concrete");
  EXPECT_EQ(material_of(world, 3), "metal");
  EXPECT_EQ(material_of(world, 4), "concrete");
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(
      diagnostics.warnings()[0].find("metal for aws_robomaker_warehouse_ShelfE_01_001, rack_1"),
      std::string::npos)
      << diagnostics.warnings()[0];
  EXPECT_TRUE(world.scene.is_opaque(0));
  EXPECT_FALSE(world.scene.is_opaque(1));
}

TEST(RadioWorld, AStatedDefaultIsNoGuess) {
  RadioWorldOptions options;
  options.otherwise = "brick";
  for (const bool is_stated : {false, true}) {
    options.states_otherwise = is_stated;
    Diagnostics plain;
    const RadioWorld world = radio_world(scene_of({"floor"}), options, plain);
    EXPECT_EQ(material_of(world, 0), "brick");
    EXPECT_EQ(plain.warnings().empty(), is_stated);
    // What names hint at remains one.
    Diagnostics both;
    radio_world(scene_of({"floor", "rack_1"}), options, both);
    ASSERT_EQ(both.warnings().size(), 1U);
    EXPECT_NE(both.warnings()[0].find("metal for rack_1"), std::string::npos);
    EXPECT_EQ(both.warnings()[0].find("floor") == std::string::npos, is_stated);
  }
}

std::string guessed(const std::string& name) {
  RadioWorldOptions options;
  options.otherwise = "marble";
  Diagnostics diagnostics;
  return material_of(radio_world(scene_of({name}), options, diagnostics), 0);
}

TEST(RadioWorld, GuessesByWholeWords) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> names = {
      {"metal",
       {"iron", "iron_shelf", "IronShelf", "shelf-iron2", "old iron", "IRON", "7IRONShelf",
        "PalletJackB_01", "pallet_jack", "palletjack", "trash_cans", "Shelves", "metallic_thing",
        "aluminum.frame", "warehouse_ShelfD_01_001", "fork_lift", "metal_box", "rack_of_wood"}},
      {"cardboard", {"boxes", "BoxA", "card_board", "ClutteringC_01", "cartons"}},
      {"wood", {"wooden_crate", "Pallets", "cafe_table", "DeskC_01", "bookshelf"}},
      {"concrete", {"WallB_01", "north_wall", "walls"}},
      {"plasterboard", {"drywall", "DryWall", "plaster_board"}},
      {"glass", {"glass_door", "shop-window"}},
      {"marble",
       {"environment", "Environment_2", "boxing_ring", "stable", "wallaby", "tracked", "ironing",
        "unboxed", "", "_", "12", "crated"}}};
  for (const auto& [material, all] : names) {
    for (const std::string& name : all) EXPECT_EQ(guessed(name), material) << name;
  }
}

// The guess doesn't depend on how the words of a name are joined.
RC_GTEST_PROP(RadioWorld, GuessesAlikeHoweverWordsAreJoined, ()) {
  const std::vector<std::string> plain = {"old", "north", "big", "left", "x"};
  std::vector<std::string> words =
      *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(plain));
  const auto at = static_cast<std::ptrdiff_t>(*rc::gen::inRange<std::size_t>(0, words.size() + 1));
  words.insert(words.begin() + at, "iron");
  std::string snake;
  std::string camel;
  for (std::string word : words) {
    snake += word + *rc::gen::element<std::string>("_", "-", " ", "3", ".", "::");
    word[0] = static_cast<char>(word[0] - 'a' + 'A');
    camel += word;
  }
  RC_ASSERT(guessed(snake) == "metal");
  RC_ASSERT(guessed(camel) == "metal");
}

TEST(RadioWorld, LastRuleThatFitsCounts) {
  RadioWorldOptions options;
  options.rules = {rule("rack*", "wood"), rule("rack_2::link", "glass"), rule("*::shelf", "brick")};
  Diagnostics diagnostics;
  const RadioWorld world =
      radio_world(scene_of({"rack_1::link::a", "rack_2::link::a", "rack_2::link::shelf"}), options,
                  diagnostics);
  EXPECT_EQ(material_of(world, 0), "wood");
  EXPECT_EQ(material_of(world, 1), "glass");
  EXPECT_EQ(material_of(world, 2), "brick");
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(RadioWorld, RuleMayNameAVisualOrWhatItWears) {
  Scene scene = scene_of({"a::link::c", "b::link::c"});
  scene.collisions[0].looks = {"a::link::painted", "Gazebo/Wood"};
  scene.collisions[1].looks = {"b::link::shine"};
  RadioWorldOptions options;
  options.rules = {rule("Gazebo/Wood", "plywood"), rule("b::link::shine", "metal")};
  Diagnostics diagnostics;
  const RadioWorld world = radio_world(scene, options, diagnostics);
  EXPECT_EQ(material_of(world, 0), "plywood");
  EXPECT_EQ(material_of(world, 1), "metal");
}

TEST(RadioWorld, WarnsOfARuleThatFitsNothing) {
  RadioWorldOptions options;
  options.rules = {rule("*", "brick"), rule("shelv", "wood")};
  Diagnostics diagnostics;
  radio_world(scene_of({"shelf::link::c"}), options, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_EQ(diagnostics.warnings()[0],
            "s.yaml:7: no solid part of the world is called 'shelv'; 'wood' is not used there");
}

TEST(RadioWorld, MayBeEmpty) {
  Diagnostics diagnostics;
  const RadioWorld world = radio_world(Scene{}, {}, diagnostics);
  EXPECT_TRUE(permittivities(world, 900e6).empty());
  EXPECT_TRUE(diagnostics.warnings().empty());
}

}  // namespace
}  // namespace tagfield
