// SPDX-License-Identifier: Apache-2.0
/// @file
/// Margins of a link in each of its fading states, one byte each.
#pragma once

#include <cstdint>
#include <vector>

namespace tagfield {

/// Margins [dB] of one link in each fading state, as computed by fading_margins_db(), quantized to
/// ¼ dB within ±32 dB.
class LinkStates {
 public:
  LinkStates() = default;
  explicit LinkStates(const std::vector<double>& margins_db);
  explicit LinkStates(std::vector<std::int8_t> steps) : steps_(std::move(steps)) {}

  /// Whether nothing arrives in any state, or no margins were given.
  [[nodiscard]] bool is_empty() const { return steps_.empty(); }
  [[nodiscard]] std::size_t carriers() const;
  /// Margin in a state [dB].
  [[nodiscard]] double margin_db(std::size_t place, std::size_t carrier) const;
  /// Fraction of the carriers on which the tag is heard at that position with `less_db` less power.
  [[nodiscard]] double share_heard(std::size_t place, double less_db = 0.0) const;
  /// Mean of that over the positions.
  [[nodiscard]] double share_heard(double less_db = 0.0) const;
  [[nodiscard]] double best_db() const;
  [[nodiscard]] const std::vector<std::int8_t>& steps() const { return steps_; }

 private:
  std::vector<std::int8_t> steps_;  ///< By position, then carrier.
};

}  // namespace tagfield
