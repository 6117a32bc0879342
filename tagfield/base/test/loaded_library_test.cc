// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/loaded_library.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

struct LibMath : LoadedLibrary {
  LibMath() : LoadedLibrary("Bessel functions", "libm.so.6") {}
  double (*j0)(double) = function("j0");
};

struct LibWithoutIt : LoadedLibrary {
  LibWithoutIt() : LoadedLibrary("Bessel functions", "libm.so.6") {}
  double (*none)(double) = function("no_such_function");
};

std::string complaint(void (*load)()) {
  try {
    load();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(LoadedLibrary, ItsFunctionsAreCalled) {
  // The first zero of J0, Abramowitz and Stegun, table 9.5.
  EXPECT_NEAR(LibMath().j0(2.4048255577), 0.0, 1e-10);
}

TEST(LoadedLibrary, OneThatIsNotThereIsNamedWithItsPurpose) {
  const std::string text = complaint([] { LoadedLibrary("Exact plans", "libnowhere.so.7"); });
  EXPECT_EQ(text.rfind("Exact plans: a library can't be loaded: libnowhere.so.7", 0), 0U) << text;
}

TEST(LoadedLibrary, AFunctionThatIsNotThereIsNamed) {
  EXPECT_EQ(complaint([] { LibWithoutIt(); }),
            "Bessel functions: libm.so.6 has no no_such_function()");
}

}  // namespace
}  // namespace tagfield
