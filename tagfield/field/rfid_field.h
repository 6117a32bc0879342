// SPDX-License-Identifier: Apache-2.0
/// @file
/// A field of tags and antennas that a driver moves in steps: what the antennas read is told to
/// whoever listens.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tagfield/field/field_step.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

struct RadioWorld;

/// Takes the steps of a driver, which may be a clock with robots, another simulator, or a
/// recording. Antennas must be added before they update; when time goes back all begin anew. Not
/// thread-safe.
class RfidField {
 public:
  /// `world`: as waves see it at first; empty space where it is null.
  explicit RfidField(Outlets outlets, std::shared_ptr<const RadioWorld> world = nullptr);
  ~RfidField();
  RfidField(RfidField&&) noexcept;
  RfidField& operator=(RfidField&&) noexcept;

  /// Applies the step and tells the listeners. Poses that are not finite are left out: a tag stays
  /// where it was, an antenna skips its update. Throws Error on a tag ID that is present already,
  /// and on a tag's number or an antenna's name that is not.
  void step(const FieldStep& step);
  /// Tells what was kept back because something earlier could still have come.
  void finish();

  /// What was odd since the last call, each only once: guessed materials, a world that can't be
  /// made ready for waves, which then stays the one before.
  std::vector<std::string> take_warnings();

  /// Made so far.
  [[nodiscard]] std::int64_t reads() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
