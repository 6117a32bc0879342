// SPDX-License-Identifier: Apache-2.0
/// @file
/// LLRP 1.0.1 on the wire: messages, parameters, numbers in network byte order. "§" below is a
/// section of EPCglobal's Low Level Reader Protocol, version 1.0.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tagfield::llrp {

using Bytes = std::vector<std::uint8_t>;

/// StatusCode (§14.2.1).
enum class Status : std::uint16_t {
  kSuccess = 0,
  kParameterError = 100,
  kFieldError = 101,
  kUnexpectedParameter = 102,
  kMissingParameter = 103,
  kDuplicateParameter = 104,
  kOverflowParameter = 105,
  kUnsupportedMessage = 109,
  kUnsupportedVersion = 110,
  kUnsupportedParameter = 111,
  kInvalid = 300,
  kDeviceError = 401,
};

/// What is wrong with a message: its status, and one line.
class Fault : public std::runtime_error {
 public:
  Fault(Status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  [[nodiscard]] Status status() const { return status_; }

 private:
  Status status_;
};

/// Takes numbers one after the other. Throws Fault where the bytes end before.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* begin, std::size_t size) : begin_(begin), left_(size) {}
  explicit ByteReader(const Bytes& bytes) : ByteReader(bytes.data(), bytes.size()) {}

  [[nodiscard]] std::size_t left() const { return left_; }
  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  ByteReader part(std::size_t size);
  Bytes bytes(std::size_t size);
  /// A list of u16 with their number before.
  std::vector<std::uint16_t> u16_list();
  /// Bits with their number before, in whole bytes.
  struct Bits {
    std::uint16_t count = 0;
    Bytes bytes;
  };
  Bits bits();

 private:
  std::uint64_t number(std::size_t size);

  const std::uint8_t* begin_;
  std::size_t left_;
};

/// A parameter as it stands in a message.
struct Parameter {
  std::uint16_t type = 0;
  ByteReader content;
  Bytes whole;  ///< With its header.
};

/// The rest of `reader` as parameters. Throws Fault where that is no whole number of them.
std::vector<Parameter> parameters_of(ByteReader reader);

/// The one of this type; none where there is none. Throws Fault where there are two.
std::optional<Parameter> find(const std::vector<Parameter>& all, std::uint16_t type);
/// Likewise, but throws Fault where there is none.
Parameter require(const std::vector<Parameter>& all, std::uint16_t type);
/// Throws Fault where one is of a type that is none of `known`; custom ones may be of any.
void require_known(const std::vector<Parameter>& all, std::initializer_list<std::uint16_t> known);

/// Puts numbers one after the other.
class ByteWriter {
 public:
  void u8(std::uint8_t value) { number(value, 1); }
  void u16(std::uint16_t value) { number(value, 2); }
  void s16(std::int16_t value) { number(static_cast<std::uint16_t>(value), 2); }
  void u32(std::uint32_t value) { number(value, 4); }
  void u64(std::uint64_t value) { number(value, 8); }
  /// As u8 with only its highest bit in use.
  void flag(bool value) { u8(value ? 0x80 : 0); }
  void bytes(const Bytes& bytes);
  void text(std::string_view text);  ///< With its length before.
  /// A parameter with a header of type and length; `write` puts in what it holds.
  void parameter(std::uint16_t type, const std::function<void()>& write);
  /// One of a vendor's.
  void custom(std::uint32_t vendor, std::uint32_t subtype, const std::function<void()>& write);
  /// The header of one with a fixed length, type 1 to 127.
  void fixed(std::uint8_t type) { u8(static_cast<std::uint8_t>(0x80U | type)); }

  [[nodiscard]] const Bytes& written() const { return bytes_; }

 private:
  void number(std::uint64_t value, std::size_t size);

  Bytes bytes_;
};

struct Message {
  std::uint16_t type = 0;
  std::uint32_t id = 0;
  Bytes body;
};

inline constexpr std::size_t kHeaderSize = 10;
/// No message of a client's comes near that.
inline constexpr std::size_t kMostMessage = std::size_t{1} << 20U;

/// With its header.
Bytes to_bytes(const Message& message);

/// The message's length as the header tells it, from its kHeaderSize bytes. Throws Fault where it
/// is too short, too long, or of another version.
std::size_t length_in(const std::uint8_t* header);
/// All of one message, `length_in()` bytes.
Message message_of(const Bytes& bytes);

}  // namespace tagfield::llrp
