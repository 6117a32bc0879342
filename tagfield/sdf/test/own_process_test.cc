#include "tagfield/sdf/internal/own_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

std::string error_of(const std::function<std::string()>& work, unsigned seconds = 20) {
  try {
    from_own_process("mesh.dae", {seconds, 300'000'000}, work);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FromOwnProcess, GivesWhatTheWorkGives) {
  std::string long_text(3'000'000, '\0');  // Far more than a pipe holds.
  long_text.back() = 'x';
  for (const std::string& text : {std::string(), std::string("R"), long_text}) {
    EXPECT_EQ(from_own_process("it", {}, [&] { return text; }), text);
  }
}

TEST(FromOwnProcess, PassesComplaintsOn) {
  EXPECT_EQ(error_of([]() -> std::string { throw Error("mesh.dae:3: is odd"); }),
            "mesh.dae:3: is odd");
}

TEST(FromOwnProcess, OutlivesASignal) {
  const std::string error = error_of([]() -> std::string {
    (void)std::raise(SIGSEGV);
    return "";
  });
  EXPECT_EQ(error, "mesh.dae: the library that reads it broke down (Segmentation fault)");
}

TEST(FromOwnProcess, EndsWhatTakesTooLong) {
  const std::string error = error_of(
      []() -> std::string {
        for (volatile unsigned i = 0;;) i = i + 1;
      },
      1);
  EXPECT_EQ(error, "mesh.dae: takes more than 1 s of processor time");
}

TEST(FromOwnProcess, EndsWhatTakesTooMuchMemory) {
  const std::string error = error_of([]() -> std::string {
    std::vector<std::vector<char>> all;
    while (true) all.emplace_back(10'000'000, 'x');
  });
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  EXPECT_NE(error, "");
#else
  EXPECT_EQ(error, "mesh.dae: takes more than 300 MB of memory");
#endif
}

}  // namespace
}  // namespace tagfield
