// SPDX-License-Identifier: Apache-2.0
/// @file
/// Small run folders for the tests: an antenna that drives along a square, a stationary one, three
/// tags.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/report/summary.h"

namespace tagfield {

/// The content of a folder to make.
struct FolderPlan {
  std::vector<std::string> tags = {"tag1", "tag2", "tag10"};
  std::vector<std::uint64_t> seeds = {1};
  bool truth = true;
  bool top_view = true;
  bool moving = true;     ///< Has a moving antenna.
  bool fixed = true;      ///< Has a fixed one.
  bool reads = true;      ///< Whether the antennas read anything.
  double lift_m = 0.0;    ///< Height by which the moving antenna rises along its path.
  double error_m = 0.01;  ///< Of every estimate, along x.
  /// Used in turn for successive updates; each has a phase offset of its own.
  std::vector<double> carriers_hz = {865.7e6};
};

/// A folder that is deleted with this object.
class RunFolder {
 public:
  explicit RunFolder(const FolderPlan& plan);

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Text of a file in it; "" if there is none.
  [[nodiscard]] std::string text(const std::string& name) const;
  void put(const std::string& name, const std::string& text) const;
  void remove(const std::string& name) const;

 private:
  TemporaryFolder parent_;
  std::string path_;
};

/// t0, t1, …
std::vector<std::string> many_tags(int count);

/// The summary that goes with a plan.
Summary summary_of(const FolderPlan& plan);

}  // namespace tagfield
