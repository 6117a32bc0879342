// SPDX-License-Identifier: Apache-2.0
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

TEST(Permittivity, FollowsTheRecommendationsTableOverFrequency) {
  // Table 3 of P.2040-3, computed with bc: ε' = a·f^b, σ = c·f^d, η'' = 17.97510·σ/f.
  struct Figure {
    const char* material;
    double hertz;
    double real;
    double conductivity;
    double imaginary;
  };
  const Figure figures[] = {{"brick", 2.4e9, 3.91, 0.027378, -0.205},
                            {"wood", 5.8e9, 1.99, 0.030928, -0.0958},
                            {"medium_dry_ground", 1e9, 15.0, 0.035, -0.6291},
                            {"medium_dry_ground", 5e9, 12.7700, 0.48238, -1.7342},
                            {"wet_ground", 2.4e9, 21.1362, 0.46814, -3.5062},
                            {"very_dry_ground", 10e9, 3.0, 0.049670, -0.08928},
                            {"floorboard", 60e9, 3.66, 1.11333, -0.33354}};
  for (const Figure& figure : figures) {
    SCOPED_TRACE(figure.material);
    const Material& material = find_material(known_materials(), figure.material);
    const auto eta = permittivity(material, figure.hertz);
    EXPECT_NEAR(eta.real(), figure.real, 1e-4 * figure.real);
    EXPECT_NEAR(conductivity(material, figure.hertz), figure.conductivity,
                1e-3 * figure.conductivity);
    EXPECT_NEAR(eta.imag(), figure.imaginary, -2e-3 * figure.imaginary);
  }
}

TEST(IsMeasuredAt, SaysWhereTheTableIsStretched) {
  const auto at = [](const char* name, double hertz) {
    return is_measured_at(find_material(known_materials(), name), hertz);
  };
  EXPECT_FALSE(at("concrete", 865.7e6));
  EXPECT_TRUE(at("concrete", 2.4e9));
  EXPECT_TRUE(at("wood", 865.7e6));
  EXPECT_TRUE(at("glass", 865.7e6));
  EXPECT_FALSE(at("floorboard", 2.4e9));
  EXPECT_FALSE(at("wet_ground", 24e9));
  EXPECT_TRUE(at("cardboard", 865.7e6));
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
