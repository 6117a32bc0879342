// SPDX-License-Identifier: Apache-2.0
/// @file
/// CDR, the encoding of ROS 2 messages (OMG DDSI-RTPS, XCDR version 1, little endian): each number
/// is aligned to its own size, strings and sequences are preceded by their length.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tagfield::ros2 {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "CDR is written as the machine has it");

/// Encapsulation header of each message: CDR, little endian.
inline constexpr std::string_view kCdrHeader{"\0\1\0\0", 4};

/// Appends values to a message's bytes.
class CdrWriter {
 public:
  CdrWriter() : bytes_(kCdrHeader) {}

  template <class Number>
  void put(Number number) {
    bytes_.resize(bytes_.size() + padding(bytes_.size() - kCdrHeader.size(), sizeof(Number)), '\0');
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof(Number));
  }
  void put_bytes(const void* bytes, std::size_t size) {
    bytes_.append(static_cast<const char*>(bytes), size);
  }
  void put_length(std::size_t length) { put(static_cast<std::uint32_t>(length)); }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

  static std::size_t padding(std::size_t at, std::size_t size) { return (size - at % size) % size; }

 private:
  std::string bytes_;
};

/// Extracts values from the untrusted bytes of a message. Once a requested value is not available,
/// all further values are 0 and is_whole() is false.
class CdrReader {
 public:
  /// Supports little endian only; is_whole() is false for others.
  explicit CdrReader(std::string_view bytes) {
    is_whole_ = bytes.substr(0, kCdrHeader.size()) == kCdrHeader;
    if (is_whole_) rest_ = bytes.substr(kCdrHeader.size());
  }

  template <class Number>
  Number take() {
    const std::size_t skipped = CdrWriter::padding(at_, sizeof(Number));
    Number number{};
    if (!require(skipped + sizeof(Number))) return number;
    std::memcpy(&number, rest_.data() + at_ + skipped, sizeof(Number));
    at_ += skipped + sizeof(Number);
    return number;
  }
  std::string_view take_bytes(std::size_t size) {
    if (!require(size)) return {};
    at_ += size;
    return rest_.substr(at_ - size, size);
  }
  /// Length of a sequence: no more than the number of remaining bytes.
  std::size_t take_length() {
    const auto length = take<std::uint32_t>();
    return require(length) ? length : 0;
  }

  [[nodiscard]] bool is_whole() const { return is_whole_; }
  void refuse() { is_whole_ = false; }

 private:
  bool require(std::size_t size) {
    is_whole_ = is_whole_ && size <= rest_.size() - at_;
    return is_whole_;
  }

  std::string_view rest_;
  std::size_t at_ = 0;
  bool is_whole_ = false;
};

template <class Number>
std::enable_if_t<std::is_arithmetic_v<Number>> write(CdrWriter& cdr, Number number) {
  cdr.put(number);
}

inline void write(CdrWriter& cdr, const std::string& text) {
  cdr.put_length(text.size() + 1);
  cdr.put_bytes(text.c_str(), text.size() + 1);
}

template <class T, std::size_t N>
void write(CdrWriter& cdr, const std::array<T, N>& values) {
  for (const T& value : values) write(cdr, value);
}

template <class T>
void write(CdrWriter& cdr, const std::vector<T>& values) {
  cdr.put_length(values.size());
  for (const T& value : values) write(cdr, value);
}

template <class Number>
std::enable_if_t<std::is_arithmetic_v<Number>> read(CdrReader& cdr, Number& number) {
  if constexpr (std::is_same_v<Number, bool>) {
    number = cdr.take<std::uint8_t>() != 0;
  } else {
    number = cdr.take<Number>();
  }
}

/// The length includes a trailing NUL.
inline void read(CdrReader& cdr, std::string& text) {
  const std::string_view bytes = cdr.take_bytes(cdr.take_length());
  if (bytes.empty() || bytes.back() != '\0') {
    cdr.refuse();
    text.clear();
  } else {
    text = bytes.substr(0, bytes.size() - 1);
  }
}

template <class T, std::size_t N>
void read(CdrReader& cdr, std::array<T, N>& values) {
  for (T& value : values) read(cdr, value);
}

template <class T>
void read(CdrReader& cdr, std::vector<T>& values) {
  const std::size_t length = cdr.take_length();
  std::size_t count = 0;
  while (cdr.is_whole() && count < length) {
    if (count == values.size()) values.emplace_back();  // Otherwise reuses an element.
    read(cdr, values[count++]);
  }
  values.resize(count);
}

/// Encodes a message.
template <class Message>
std::string to_cdr(const Message& message) {
  CdrWriter cdr;
  write(cdr, message);
  return cdr.bytes();
}

/// Decodes `bytes` into `message`; whether they are such a message.
template <class Message>
bool from_cdr(std::string_view bytes, Message& message) {
  CdrReader cdr(bytes);
  read(cdr, message);
  return cdr.is_whole();
}

}  // namespace tagfield::ros2
