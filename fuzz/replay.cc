// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target on files, without libFuzzer: past findings, and a corpus.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/input.h"

// An escaping exception ends the process, as with libFuzzer.
int main(int count, char** arguments) {  // NOLINT(bugprone-exception-escape)
  for (int i = 1; i < count; ++i) {
    std::ifstream file(arguments[i], std::ios::binary);
    if (!file) {
      std::fprintf(stderr, "%s: can't be read\n", arguments[i]);
      return 2;
    }
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file),
                                  std::istreambuf_iterator<char>()};
    const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
    // Shows which file caused a failure.
    std::printf("%s\n", arguments[i]);
    std::fflush(stdout);
    LLVMFuzzerTestOneInput(data.data(), data.size());
  }
  return 0;
}
