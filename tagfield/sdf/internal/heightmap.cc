// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/heightmap.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tagfield/files/files.h"

namespace tagfield::sdf_internal {
namespace {

constexpr std::size_t kMaxBytes = 100'000'000;
constexpr png_uint_32 kMaxPixels = 16'385;  ///< In a row or column.

struct RedChannel {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> reds;  ///< Top row first.

  [[nodiscard]] double at(int row, int column) const {
    return reds[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(column)];
  }
};

/// libpng's simplified interface, which frees its memory on success and on failure.
RedChannel read_png(const std::string& path) {
  const std::string bytes = read_text_file(path, kMaxBytes);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    fail({path, 0}, fmt::format("not a PNG image that a heightmap can be read from ({})",
                                static_cast<const char*>(image.message)));
  }
  if (image.width > kMaxPixels || image.height > kMaxPixels) {
    png_image_free(&image);
    fail({path, 0}, fmt::format("a heightmap may have {0} x {0} pixels at most", kMaxPixels));
  }
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr) == 0) {
    fail({path, 0}, fmt::format("PNG image can't be read whole ({})",
                                static_cast<const char*>(image.message)));
  }
  RedChannel reds{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (std::size_t i = 0; i < rgb.size(); i += 3) reds.reds.push_back(rgb[i]);
  return reds;
}

/// Indices of the pixels that are used in a row or column of `count`.
std::vector<int> used_pixels(int count) {
  const int step = (count - 2) / (kMaxHeights - 1) + 1;
  std::vector<int> used;
  for (int i = 0; i < count - 1; i += step) used.push_back(i);
  used.push_back(count - 1);
  return used;
}

void add_triangles(TriangleMesh& mesh, std::size_t rows, std::size_t columns) {
  const auto vertex = [columns](std::size_t row, std::size_t column) {
    return static_cast<std::uint32_t>(row * columns + column);
  };
  for (std::size_t r = 0; r + 1 < rows; ++r) {
    for (std::size_t c = 0; c + 1 < columns; ++c) {
      // Rows run in the direction of −y, so these are counterclockwise seen from above.
      mesh.triangles.push_back({vertex(r, c), vertex(r + 1, c), vertex(r + 1, c + 1)});
      mesh.triangles.push_back({vertex(r, c), vertex(r + 1, c + 1), vertex(r, c + 1)});
    }
  }
}

}  // namespace

TriangleMesh heightmap_mesh(const Heightmap& map, const std::string& path, const Location& location,
                            Context& context) {
  const RedChannel image = read_png(path);
  if (image.width < 2 || image.height < 2) fail({path, 0}, "a heightmap needs 2 x 2 pixels");
  const std::vector<int> rows = used_pixels(image.height);
  const std::vector<int> columns = used_pixels(image.width);
  if (std::max(image.width, image.height) > kMaxHeights) {
    context.diagnostics.warn(location,
                             fmt::format("of the heightmap's {} x {} pixels {} x {} are "
                                         "used",
                                         image.width, image.height, columns.size(), rows.size()));
  }
  const double brightest = *std::max_element(image.reds.begin(), image.reds.end());
  const double metres = brightest > 0.0 ? map.size.z() / brightest : 0.0;
  TriangleMesh mesh;
  for (const int row : rows) {
    for (const int column : columns) {
      mesh.vertices.push_back(
          map.origin +
          Eigen::Vector3d(map.size.x() * (static_cast<double>(column) / (image.width - 1) - 0.5),
                          map.size.y() * (0.5 - static_cast<double>(row) / (image.height - 1)),
                          metres * image.at(row, column)));
    }
  }
  add_triangles(mesh, rows.size(), columns.size());
  return mesh;
}

}  // namespace tagfield::sdf_internal
