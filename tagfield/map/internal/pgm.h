// SPDX-License-Identifier: Apache-2.0
/// @file
/// Grey images in the PGM format (netpbm).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tagfield {

/// A grey image, with rows from top to bottom.
struct GreyImage {
  int width = 0;
  int height = 0;
  int white = 255;  ///< Maximum grey value, 1 to 65,535.
  std::vector<std::uint16_t> greys;
};

/// Reads the bytes of a P5 (binary) or P2 (plain) image; `file` is for messages. Throws Error
/// "FILE: byte N: …" on anything that is not exactly one image; a newline after the last grey is
/// accepted. Allocates memory only for as many greys as the bytes can contain.
GreyImage read_pgm(const std::string& bytes, const std::string& file);

}  // namespace tagfield
