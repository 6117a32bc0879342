// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/method.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

struct GuessOptions {
  double x_m = 1.0;
  double y_m = 2.0;
};

/// A method that locates all tags at the position in its options.
Method guess() {
  using O = GuessOptions;
  const OptionTable<O> table{{setting<O>("x_m", "m", "east", &O::x_m, {-10.0, false, 10.0}),
                              setting<O>("y_m", "m", "north", &O::y_m, {-10.0, false, 10.0})},
                             [](const O& of) {
                               if (of.x_m > of.y_m) throw Error("x_m must not be over y_m");
                             }};
  return one_by_one(
      "guess", "always one place", table, O{},
      [](const LocalizationProblem&, const std::string& tag, const SamplesOfTag&, const O& of) {
        Candidate there;
        there.p_WT = {of.x_m, of.y_m, 0.0};
        TagEstimate estimate;
        estimate.tag = tag;
        estimate.candidates = {there};
        return estimate;
      });
}

Eigen::Vector3d guessed(const Method& method) {
  LocalizationProblem problem;
  problem.samples["t"];
  Diagnostics diagnostics;
  const LocalizationResult result = method.locate(problem, 1, diagnostics);
  EXPECT_EQ(result.method, "guess");
  return result.estimates.at(0).candidates.at(0).p_WT;
}

TEST(Method, TakesItsSettingsAndPassesOverThoseOfOthers) {
  EXPECT_EQ(guessed(guess()), Eigen::Vector3d(1.0, 2.0, 0.0));
  const Method method = configured(guess(), {{"x_m", "-3", {}}, {"stride_m", "no number", {}}});
  EXPECT_EQ(guessed(method), Eigen::Vector3d(-3.0, 2.0, 0.0));
}

TEST(Method, RefusesSettingsOutOfTheirRangeOrThatDontGoTogether) {
  const auto complaint = [](const MethodSettings& settings) {
    return error_of([&] { configured(guess(), settings); });
  };
  EXPECT_EQ(complaint({{"x_m", "11", {"a.yaml", 3}}}), "a.yaml:3: x_m must be at most 10, is 11");
  EXPECT_EQ(complaint({{"y_m", "5", {"a.yaml", 3}}, {"x_m", "6", {"a.yaml", 4}}}),
            "a.yaml:4: x_m must not be over y_m");
}

TEST(Method, SettingsThatNoneUsesAreRefusedWithWhoDoes) {
  const std::vector<Method> all = built_in_methods();
  const MethodSettings stride = {{"stride_m", "1", {"a.yaml", 5}}};
  refuse_unused(stride, {find_method(all, "ml"), find_method(all, "hyperbola")}, all);
  EXPECT_EQ(error_of([&] { refuse_unused(stride, {find_method(all, "ml")}, all); }),
            "a.yaml:5: stride_m is not used by ml: it is a setting of hyperbola");
  EXPECT_EQ(
      error_of([&] {
        refuse_unused({{"strid_m", "1", {}}}, {guess()}, all);
      }),
      "strid_m is not used by guess: it is a setting of no method (did you mean 'stride_m'?)");
  const std::string said = error_of([&] {
    refuse_unused({{"xyz", "1", {}}}, {find_method(all, "auto")}, all);
  });
  EXPECT_EQ(said.rfind("xyz is not used by auto: it is a setting of no method (known: ", 0), 0U)
      << said;
  EXPECT_EQ(said.find("max_range_m"), said.rfind("max_range_m")) << said;
}

TEST(Method, ASettingThatNoneUsesIsRefusedAfterOneThatIsUsed) {
  const std::vector<Method> all = built_in_methods();
  const MethodSettings both = {{"stride_m", "1", {"a.yaml", 5}}, {"particles", "9", {"a.yaml", 6}}};
  EXPECT_EQ(error_of([&] { refuse_unused(both, {find_method(all, "hyperbola")}, all); }),
            "a.yaml:6: particles is not used by hyperbola: it is a setting of particle");
}

TEST(Method, AutoTakesTheSettingsOfThoseThatItMayChoose) {
  const Method automatic = find_method(built_in_methods(), "auto");
  for (const char* const key : {"neighbours", "slope_db", "min_share", "cell_m"}) {
    EXPECT_TRUE(has_key(automatic.settings, key)) << key;
  }
  for (const char* const key : {"stride_m", "particles"}) {
    EXPECT_FALSE(has_key(automatic.settings, key)) << key;
  }
}

TEST(Method, EverySettingOfEveryMethodTakesItsOwnDefault) {
  std::size_t count = 0;
  for (const Method& method : built_in_methods()) {
    MethodSettings defaults;
    for (const SettingHelp& help : method.settings) {
      EXPECT_FALSE(help.meaning.empty()) << help.key;
      defaults.push_back({help.key, help.otherwise, {}});
      ++count;
    }
    configured(method, defaults);
  }
  EXPECT_GT(count, 30U);
}

TEST(LocateTags, TakesMethodsOfOnesOwn) {
  LocalizationOptions options;
  options.methods.push_back(guess());
  options.method = "guess";
  options.settings = {{"x_m", "-1", {}}};
  Diagnostics diagnostics;
  TagRead read;
  read.tag = "t";
  EXPECT_EQ(locate_tags({read}, {}, options, diagnostics).estimates.at(0).candidates.at(0).p_WT.x(),
            -1.0);
}

}  // namespace
}  // namespace tagfield
