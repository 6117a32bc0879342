// SPDX-License-Identifier: Apache-2.0
// Runs a door over files, where libFuzzer is not there: past findings, and a corpus.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/input.h"

// What a door lets out ends the process, as under libFuzzer.
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
    // Whoever looks at what failed sees at which file.
    std::printf("%s\n", arguments[i]);
    std::fflush(stdout);
    LLVMFuzzerTestOneInput(data.data(), data.size());
  }
  return 0;
}
