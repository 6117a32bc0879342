#include "tagfield/channel/material.h"

#include <gtest/gtest.h>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

TEST(Permittivity, OfConcreteAt900MHzIsTheRecommendations) {
  // P.2040: σ = 0.0462·0.9^0.7822 = 0.04255 S/m; η'' = 17.98 σ/f[GHz] = 0.8500.
  const auto eta = permittivity(find_material(known_materials(), "concrete"), 900e6);
  EXPECT_NEAR(eta.real(), 5.24, 1e-12);
  EXPECT_NEAR(eta.imag(), -0.8500, 5e-4);
}

TEST(Permittivity, OfMetalIsAllLoss) {
  const auto eta = permittivity(find_material(known_materials(), "metal"), 900e6);
  EXPECT_LT(eta.imag(), -1e8);
}

TEST(FindMaterial, NamesTheNearestForASlip) {
  try {
    find_material(known_materials(), "concret");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "there is no material 'concret' (did you mean 'concrete'?)");
  }
}

TEST(CheckMaterial, TakesAllKnownOnes) {
  for (const Material& material : known_materials()) EXPECT_NO_THROW(check(material));
}

TEST(CheckMaterial, NamesWhatIsOutOfRange) {
  Material material = find_material(known_materials(), "wood");
  material.permittivity_a = -2.0;
  try {
    check(material);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "permittivity must be from 1 to 10000, is -2");
  }
  material = find_material(known_materials(), "wood");
  material.crossing_db = -1.0;
  EXPECT_THROW(check(material), Error);
  material.crossing_db.reset();
  material.wall_m = 0.0;
  EXPECT_THROW(check(material), Error);
}

}  // namespace
}  // namespace tagfield
