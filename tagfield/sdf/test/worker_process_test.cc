// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/worker_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/sanitized.h"

namespace tagfield {
namespace {

/// Does what the request names.
std::string work(const std::string& request) {
  if (request == "complain") throw Error("mesh.dae:3: is odd");
  if (request == "crash") (void)std::raise(SIGSEGV);
  if (request == "leave") std::exit(0);
  for (volatile unsigned i = 0; request == "hang";) i = i + 1;
  std::vector<std::vector<char>> all;
  while (request == "fill") all.emplace_back(10'000'000, 'x');
  return request + request;
}

std::string error_of(WorkerProcess& process, const std::string& request, unsigned seconds = 20) {
  try {
    process.ask("mesh.dae", {seconds, 300'000'000}, request);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(WorkerProcess, AnswersOneRequestAfterTheOther) {
  WorkerProcess process(work);
  std::string long_text(3'000'000, '\0');  // Far more than fits into a pipe's buffer.
  long_text.back() = 'x';
  for (const std::string& text : {std::string(), std::string("R"), long_text}) {
    EXPECT_EQ(process.ask("it", {}, text), text + text);
  }
}

TEST(WorkerProcess, PassesComplaintsOn) {
  WorkerProcess process(work);
  EXPECT_EQ(error_of(process, "complain"), "mesh.dae:3: is odd");
  EXPECT_EQ(process.ask("it", {}, "on"), "onon");
}

TEST(WorkerProcess, BeginsAgainAfterASignal) {
  WorkerProcess process(work);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(error_of(process, "crash"),
              "mesh.dae: the library that reads it crashed (Segmentation fault)");
    EXPECT_EQ(process.ask("it", {}, "on"), "onon");
  }
}

TEST(WorkerProcess, NoticesThatItEnds) {
  WorkerProcess process(work);
  EXPECT_EQ(error_of(process, "leave"), "mesh.dae: the library that reads it ended");
}

TEST(WorkerProcess, EndsWhatTakesTooLong) {
  WorkerProcess process(work);
  EXPECT_EQ(error_of(process, "hang", 1), "mesh.dae: takes more than 1 s of processor time");
  EXPECT_EQ(process.ask("it", {}, "on"), "onon");
}

TEST(WorkerProcess, EndsWhatTakesTooMuchMemory) {
  if (kSanitized) GTEST_SKIP() << "sanitizers reserve more memory than this leaves";
  WorkerProcess process(work);
  EXPECT_EQ(error_of(process, "fill"), "mesh.dae: takes more than 300 MB of memory");
  EXPECT_EQ(process.ask("it", {}, "on"), "onon");
}

}  // namespace
}  // namespace tagfield
