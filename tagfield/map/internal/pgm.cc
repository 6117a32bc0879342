// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/internal/pgm.h"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// Maximum side of a map; the product of two fits into an int64.
constexpr int kMaxPgmCells = 1'000'000;
constexpr int kMaxWhite = 65'535;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  [[noreturn]] void refuse(const std::string& message) const {
    fail({file_, 0}, fmt::format("byte {}: {}", at_, message));
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  std::string_view take(std::size_t count) {
    const std::string_view taken = bytes_.substr(at_, count);
    at_ += taken.size();
    return taken;
  }

  /// Skips white space, and comments from # to the end of the line.
  void skip_spaces() {
    while (left() > 0 && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') {
        const std::size_t end = bytes_.find_first_of("\r\n", at_);
        at_ = end == std::string_view::npos ? bytes_.size() : end;
      } else {
        ++at_;
      }
    }
  }

  /// Reads an integer after at least one white-space character.
  int number(const char* what, int least, int most) {
    const std::size_t before = at_;
    skip_spaces();
    if (left() == 0) refuse(fmt::format("ends where {} was expected", what));
    if (at_ == before || !is_digit(bytes_[at_])) refuse(fmt::format("expected {}", what));
    const std::size_t begin = at_;
    int value = 0;
    for (; left() > 0 && is_digit(bytes_[at_]) && value <= most; ++at_) {
      value = 10 * value + (bytes_[at_] - '0');
    }
    if (value < least || value > most) {
      at_ = begin;
      refuse(fmt::format("{} is not {} to {}", what, least, most));
    }
    return value;
  }

  /// Skips the single white-space character between header and greys of a binary image.
  void one_space() {
    if (left() == 0 || !is_space(bytes_[at_])) refuse("expected a space before the greys");
    ++at_;
  }

 private:
  std::string_view bytes_;
  const std::string& file_;
  std::size_t at_ = 0;
};

std::size_t pixels(const GreyImage& image) {
  return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

[[noreturn]] void wrong_length(const Reader& reader, const GreyImage& image, std::size_t needed) {
  reader.refuse(fmt::format("{} × {} cells need {} bytes, and {} are there", image.width,
                            image.height, needed, reader.left()));
}

void read_binary(Reader& reader, GreyImage& image) {
  reader.one_space();
  const std::size_t width = image.white > 255 ? 2 : 1;
  const std::size_t needed = pixels(image) * width;
  const bool newline_after = reader.left() == needed + 1;
  if (reader.left() != needed && !newline_after) wrong_length(reader, image, needed);
  image.greys.reserve(pixels(image));
  for (std::size_t i = 0; i < pixels(image); ++i) {
    int grey = 0;
    for (const char byte : reader.take(width)) grey = 256 * grey + static_cast<unsigned char>(byte);
    if (grey > image.white) reader.refuse(fmt::format("grey {} is above {}", grey, image.white));
    image.greys.push_back(static_cast<std::uint16_t>(grey));
  }
  if (newline_after && reader.take(1) != "\n") wrong_length(reader, image, needed);
}

void read_plain(Reader& reader, GreyImage& image) {
  // At least one space and one digit per grey.
  const std::size_t needed = 2 * pixels(image);
  if (reader.left() < needed) wrong_length(reader, image, needed);
  image.greys.reserve(pixels(image));
  for (std::size_t i = 0; i < pixels(image); ++i) {
    image.greys.push_back(static_cast<std::uint16_t>(reader.number("a grey", 0, image.white)));
  }
  reader.skip_spaces();
  if (reader.left() > 0) reader.refuse("more grey values than the size states");
}

}  // namespace

GreyImage read_pgm(const std::string& bytes, const std::string& file) {
  Reader reader(bytes, file);
  if (bytes.empty()) reader.refuse("the file is empty");
  const std::string_view magic = reader.take(2);
  if (magic != "P5" && magic != "P2") {
    fail({file, 0}, "byte 0: is not a grey PGM image (it would begin with P5 or P2)");
  }
  GreyImage image;
  image.width = reader.number("the width", 1, kMaxPgmCells);
  image.height = reader.number("the height", 1, kMaxPgmCells);
  image.white = reader.number("the maximum grey value", 1, kMaxWhite);
  if (magic == "P5") {
    read_binary(reader, image);
  } else {
    read_plain(reader, image);
  }
  return image;
}

}  // namespace tagfield
