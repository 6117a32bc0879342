// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/internal/satisfied_tags.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tagfield/layout/internal/link_reads.h"
#include "tagfield/layout/plan_problem.h"

namespace tagfield {
namespace {

constexpr double kMiddle_hz = 900e6;
constexpr double kMega = 1e6;

}  // namespace

void SatisfiedTags::on_read(const TagRead& read) {
  OfTag& of_tag = tags_[read.tag];
  ++of_tag.reads;
  if (is_crossing(run_.zone_of_reader.at(read.reader), run_.zone_of_tag.at(read.tag))) {
    crossed_.insert(read.tag);
  }
  if (!run_.aim.position_error_m) return;
  Link& link = of_tag.links[read.antenna];
  const double weight = std::pow(phase_sigma(run_.readers.at(read.antenna), read.rssi_dbm), -2.0);
  const double megahertz = (read.frequency_hz - kMiddle_hz) / kMega;
  link.weight += weight;
  link.first += weight * megahertz;
  link.second += weight * megahertz * megahertz;
}

bool SatisfiedTags::has_enough(const std::string& tag, const OfTag& of_tag) const {
  if (run_.aim.dwell_reads) return static_cast<double>(of_tag.reads) >= *run_.aim.dwell_reads;
  if (!run_.aim.position_error_m) return true;
  const Eigen::Vector3d& p_WT = run_.p_WT.at(tag);
  std::vector<PositionInformation> all;
  for (const auto& [antenna, link] : of_tag.links) {
    const Eigen::Vector3d& p_WA = run_.p_WA.at(antenna);
    const double spread = std::max(0.0, link.second - link.first * link.first / link.weight);
    all.push_back(information_along(information_of_phases(spread * kMega * kMega) +
                                        information_of_strength((p_WT - p_WA).norm()),
                                    p_WA, p_WT));
  }
  return error_bound_m(all) <= *run_.aim.position_error_m;
}

std::size_t SatisfiedTags::satisfied() const {
  return static_cast<std::size_t>(std::count_if(tags_.begin(), tags_.end(), [&](const auto& one) {
    return has_enough(one.first, one.second);
  }));
}

}  // namespace tagfield
