// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which tags have in a full run what a plan aims at.
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

/// What a count of tags needs to know of a run.
struct CountedRun {
  PlanAim aim;
  std::map<std::string, std::string> zone_of_tag;  ///< "" for none.
  std::map<std::string, std::string> zone_of_reader;
  std::map<std::string, Eigen::Vector3d> p_WT;    ///< By tag,
  std::map<std::string, Eigen::Vector3d> p_WA;    ///< and antenna [m].
  std::map<std::string, ReaderHardware> readers;  ///< By antenna.
};

/// Counts while the run goes on. A place is bounded by the reads that there were: their carriers,
/// and the phase noise that their strengths mean.
class SatisfiedTags final : public ReadListener {
 public:
  explicit SatisfiedTags(CountedRun run) : run_(std::move(run)) {}
  void on_read(const TagRead& read) override;

  [[nodiscard]] std::size_t satisfied() const;
  /// Tags that a reader of another zone read.
  [[nodiscard]] std::size_t crossed() const { return crossed_.size(); }

 private:
  /// Of one tag and antenna: Σ w, Σ w f, Σ w f² with w = 1/σφ² and frequencies f [MHz] off 900 MHz.
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
