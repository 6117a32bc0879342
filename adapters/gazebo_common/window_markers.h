// SPDX-License-Identifier: Apache-2.0
/// @file
/// A field's tags and antennas as markers in Gazebo's own window.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "tagfield/field/field_picture.h"

namespace tagfield {

/// Draws twice per simulated second, and only while a window is open: each tag as a small
/// octahedron coloured by the RSSI of its last read, each antenna as an arrow, its range as a
/// sphere.
class WindowMarkers final : public FieldPicture {
 public:
  WindowMarkers();
  ~WindowMarkers() override;

 protected:
  void draw(Time stamp) override;

 private:
  struct Window;
  std::unique_ptr<Window> window_;
};

}  // namespace tagfield
