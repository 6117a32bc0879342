// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/yaml_map.h"

#include <gtest/gtest.h>

#include <functional>

namespace tagfield {
namespace {

YamlMap map_of(const std::string& text) {
  return YamlMap(YamlValue(YAML::Load(text), "f.yaml", ""));
}

std::string map_complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no map_complaint";
}

TEST(YamlMap, TakesWhatIsThereAndDefaultsForTheRest) {
  YamlMap map = map_of("a: 1.5e3\nb: word\nc: true\nd: [1, 2]\n");
  EXPECT_EQ(map.number("a", 0.0), 1500.0);
  EXPECT_EQ(map.text("b", ""), "word");
  EXPECT_TRUE(map.boolean("c", false));
  EXPECT_EQ(map.at("d").numbers(2, 2), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(map.number("e", 7.0), 7.0);
  map.finish();
}

TEST(YamlMap, NamesTheLineOfABadValue) {
  YamlMap map = map_of("a: 1\nb: fast\nc: .nan\nd: -1\ne: 0\nf: [1, x]\n");
  EXPECT_EQ(map_complaint([&] { map.number("b", 0.0); }),
            "f.yaml:2: b is 'fast', expected a number");
  EXPECT_EQ(map_complaint([&] { map.number("c", 0.0); }), "f.yaml:3: c must be finite, is nan");
  EXPECT_EQ(map_complaint([&] { map.number("d", 0.0, NumberRange::kNotNegative); }),
            "f.yaml:4: d must be 0 or more, is -1");
  EXPECT_EQ(map_complaint([&] { map.number("e", 0.0, NumberRange::kPositive); }),
            "f.yaml:5: e must be greater than 0, is 0");
  EXPECT_EQ(map_complaint([&] { static_cast<void>(map.at("f").numbers(2, 2)); }),
            "f.yaml:6: f[1] is 'x', expected a number");
  EXPECT_EQ(map_complaint([&] { map.at("missing"); }), "f.yaml:1: has no 'missing'");
}

TEST(YamlMap, NamesTheNearestKeyToAnUnknownOne) {
  YamlMap map = map_of("frequency_hz: 1\nrnage_m: 2\n");
  map.number("frequency_hz", 0.0);
  map.number("range_m", 0.0);
  EXPECT_EQ(map_complaint([&] { map.finish(); }),
            "f.yaml:2: unknown key 'rnage_m' (did you mean 'range_m'?)");
}

TEST(YamlMap, RecognizesTheKeyOnOfYaml11) {
  YamlMap map = map_of("true: cart\n");
  (void)map.text("on", "");
  EXPECT_EQ(map_complaint([&] { map.finish(); }),
            "f.yaml:1: unknown key 'true' (is it the key 'on', written by a program for YAML 1.1? "
            "Quote it there: 'on')");
}

TEST(YamlMap, RefusesAKeyThatStandsTwice) {
  EXPECT_EQ(map_complaint([] { map_of("a: 1\nb: 2\na: 3\n"); }), "f.yaml:3: has 'a' twice");
}

TEST(YamlMap, HasKeysOfText) {
  const std::string says = " has a key that is not text";
  EXPECT_EQ(map_complaint([] { map_of("a: 1\n? [b, c]\n: 2\n"); }), "f.yaml:2:" + says);
  EXPECT_EQ(map_complaint([] { map_of("a: 1\n? {b: c}\n: 2\n"); }), "f.yaml:2:" + says);
  // For an empty key the parser only reports the position after it.
  EXPECT_EQ(map_complaint([] { map_of("a: 1\n?\n"); }), "f.yaml:3:" + says);
}

TEST(SetInYaml, ReplacesAndAdds) {
  YAML::Node root = YAML::Load("a: {b: 1}\nlist: [{name: x, v: 1}, {id: y, v: 2}]\n");
  set_in_yaml(root, "a.b", "5");
  set_in_yaml(root, "a.c.d", "[1, 2]");
  set_in_yaml(root, "list.0.v", "7");
  set_in_yaml(root, "list.y.v", "8");
  EXPECT_EQ(root["a"]["b"].as<int>(), 5);
  EXPECT_EQ(root["a"]["c"]["d"][1].as<int>(), 2);
  EXPECT_EQ(root["list"][0]["v"].as<int>(), 7);
  EXPECT_EQ(root["list"][1]["v"].as<int>(), 8);
}

TEST(SetInYaml, ReplacesInAllThatMatch) {
  YAML::Node root = YAML::Load("list: [{name: x1, v: 1}, {id: x2, v: 2}, {name: y, v: 3}]\n");
  set_in_yaml(root, "list.x?.v", "7");
  set_in_yaml(root, "list.*.w", "8");
  EXPECT_EQ(root["list"][0]["v"].as<int>(), 7);
  EXPECT_EQ(root["list"][1]["v"].as<int>(), 7);
  EXPECT_EQ(root["list"][2]["v"].as<int>(), 3);
  EXPECT_EQ(root["list"][2]["w"].as<int>(), 8);
  EXPECT_EQ(map_complaint([&] { set_in_yaml(root, "list.z*.v", "1"); }),
            "--set list.z*.v: the list has no element 'z*'");
}

TEST(SetInYaml, RefusesPathsThatLeadNowhere) {
  YAML::Node root = YAML::Load("a: 1\nlist: [{name: x}]\n");
  EXPECT_EQ(map_complaint([&] { set_in_yaml(root, "list.z.v", "1"); }),
            "--set list.z.v: the list has no element 'z'");
  EXPECT_EQ(map_complaint([&] { set_in_yaml(root, "a.b.c", "1"); }),
            "--set a.b.c: 'b' is not inside a list or a mapping");
  EXPECT_EQ(map_complaint([&] { set_in_yaml(root, "a..c", "1"); }),
            "--set a..c: expected words between the dots");
  EXPECT_NE(map_complaint([&] { set_in_yaml(root, "a", "[1"); }).find("not a YAML value"),
            std::string::npos);
}

}  // namespace
}  // namespace tagfield
