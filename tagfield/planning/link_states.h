// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a link has to spare in each of its fading states, a byte each.
#pragma once

#include <cstdint>
#include <vector>

namespace tagfield {

/// Margins [dB] of one link in each fading state, as fading_margins_db() has them, coarsely: in
/// steps of ¼ dB within ±32 dB.
class LinkStates {
 public:
  LinkStates() = default;
  explicit LinkStates(const std::vector<double>& margins_db);
  explicit LinkStates(std::vector<std::int8_t> steps) : steps_(std::move(steps)) {}

  /// Whether nothing arrives in any state, or nothing was told.
  [[nodiscard]] bool is_empty() const { return steps_.empty(); }
  [[nodiscard]] std::size_t carriers() const;
  /// Margin in a state [dB].
  [[nodiscard]] double margin_db(std::size_t place, std::size_t carrier) const;
  /// Share of the carriers on which the tag is heard in that place with `less_db` less power.
  [[nodiscard]] double share_heard(std::size_t place, double less_db = 0.0) const;
  /// Mean of that over the places.
  [[nodiscard]] double share_heard(double less_db = 0.0) const;
  [[nodiscard]] double best_db() const;
  [[nodiscard]] const std::vector<std::int8_t>& steps() const { return steps_; }

 private:
  std::vector<std::int8_t> steps_;  ///< By place, then carrier.
};

}  // namespace tagfield
