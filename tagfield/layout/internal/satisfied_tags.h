// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which tags meet a plan's aim in a full run.
#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tagfield/reader/reader_hardware.h"
#include "tagfield/scenario/plan_spec.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// The data of a run needed to count tags.
struct CountedRun {
  PlanAim aim;
  std::map<std::string, std::string> zone_of_tag;  ///< "" for none.
  std::map<std::string, std::string> zone_of_reader;
  std::map<std::string, Eigen::Vector3d> p_WT;    ///< By tag,
  std::map<std::string, Eigen::Vector3d> p_WA;    ///< and antenna [m].
  std::map<std::string, ReaderHardware> readers;  ///< By antenna.
};

/// Counts during the run. The bound on a position error follows from the actual reads: their
/// carriers, and the phase noise at their signal strengths.
class SatisfiedTags final : public ReadListener {
 public:
  explicit SatisfiedTags(CountedRun run) : run_(std::move(run)) {}
  void on_read(const TagRead& read) override;

  [[nodiscard]] std::size_t satisfied() const;
  /// Number of tags that a reader of another zone read.
  [[nodiscard]] std::size_t crossed() const { return crossed_.size(); }

 private:
  /// Sums over the reads of one tag by one antenna: Σ w, Σ w f, Σ w f² with w = 1/σφ² and
  /// frequencies f [MHz] relative to 900 MHz.
  struct Link {
    double weight = 0.0;
    double first = 0.0;
    double second = 0.0;
  };
  struct OfTag {
    std::size_t reads = 0;
    std::map<std::string, Link> links;
  };
  [[nodiscard]] bool has_enough(const std::string& tag, const OfTag& of_tag) const;

  CountedRun run_;
  std::map<std::string, OfTag> tags_;
  std::set<std::string> crossed_;
};

}  // namespace tagfield
