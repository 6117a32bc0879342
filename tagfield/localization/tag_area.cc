// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/problem.h"

namespace tagfield {
namespace {

/// Positive on the requested side, negative on the other.
double side_of(TagSide side, const Eigen::Vector2d& along, const Eigen::Vector2d& apart) {
  const Eigen::Vector2d left(-along.y(), along.x());
  const double to_left = left.dot(apart);
  const auto towards = [&](const Eigen::Vector2d& axis) {
    return left.dot(axis) < 0.0 ? -to_left : to_left;
  };
  switch (side) {
    case TagSide::kLeft:
      return to_left;
    case TagSide::kRight:
      return -to_left;
    case TagSide::kPlusX:
      return towards(Eigen::Vector2d::UnitX());
    case TagSide::kMinusX:
      return -towards(Eigen::Vector2d::UnitX());
    case TagSide::kPlusY:
      return towards(Eigen::Vector2d::UnitY());
    case TagSide::kMinusY:
      return -towards(Eigen::Vector2d::UnitY());
  }
  return 0.0;
}

/// Drops candidates at the position of the first: nearer than its expected error or than 3 cm.
void drop_repeats(std::vector<Candidate>& candidates) {
  constexpr double kSamePosition = 0.03;
  if (candidates.empty()) return;
  const Candidate first = candidates.front();
  const double apart = std::max(kSamePosition, first.expected_error_m);
  candidates.erase(std::remove_if(candidates.begin() + 1, candidates.end(),
                                  [&](const Candidate& other) {
                                    return (other.p_WT - first.p_WT).norm() < apart;
                                  }),
                   candidates.end());
}

}  // namespace

const std::vector<std::string>& tag_sides() {
  static const std::vector<std::string> sides = {// In the order of TagSide.
                                                 "left", "right", "+x", "-x", "+y", "-y"};
  return sides;
}

TagSide tag_side(const std::string& word) {
  const auto found = std::find(tag_sides().begin(), tag_sides().end(), word);
  if (found != tag_sides().end()) return static_cast<TagSide>(found - tag_sides().begin());
  throw Error("the side is '" + word + "', expected left, right, +x, -x, +y or -y");
}

bool is_within(const TagArea& area, const Eigen::Vector2d& middle, const Eigen::Vector2d& along,
               const Eigen::Vector2d& p) {
  if (area.box && !area.box->contains(p)) return false;
  return !area.side || side_of(*area.side, along, p - middle) >= 0.0;
}

PathLine path_line(const std::vector<Eigen::Vector2d>& places) {
  PathLine line;
  if (places.empty()) return line;
  const auto furthest_from = [&](const Eigen::Vector2d& from) {
    return *std::max_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
      return (a - from).squaredNorm() < (b - from).squaredNorm();
    });
  };
  const Eigen::Vector2d end = furthest_from(places.front());
  const Eigen::Vector2d begin = furthest_from(end);
  line.middle = 0.5 * (begin + end);
  if ((end - begin).norm() > 0.0) line.along = (end - begin).normalized();
  return line;
}

void keep_within(const TagArea& area, const PathLine& way, double max_error_m,
                 TagEstimate& estimate) {
  std::vector<Candidate>& candidates = estimate.candidates;
  const std::size_t before = candidates.size();
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [&](const Candidate& candidate) {
                                    return !is_within(area, way.middle, way.along,
                                                      candidate.p_WT.head<2>());
                                  }),
                   candidates.end());
  if (candidates.size() == before) return;
  drop_repeats(candidates);
  if (candidates.empty() || candidates.front().expected_error_m > max_error_m) {
    candidates.clear();
    estimate.verdict = Verdict::kNotLocated;
    estimate.reason = "cannot localize: no position where tags can be explains the reads";
  } else if (candidates.size() == 1) {
    estimate.verdict = Verdict::kLocated;
    estimate.reason.clear();
  }
}

}  // namespace tagfield
