// SPDX-License-Identifier: Apache-2.0
/// @file
/// LLRP 1.0.1 encoding: messages, parameters, numbers in network byte order. "§" below is a section
/// of EPCglobal's Low Level Reader Protocol, version 1.0.1.
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

/// An error in a message: its status, and one line of text.
class Fault : public std::runtime_error {
 public:
  Fault(Status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  [[nodiscard]] Status status() const { return status_; }

 private:
  Status status_;
};

/// Reads numbers one after the other. Throws Fault beyond the end of the bytes.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* begin, std::size_t size) : begin_(begin), left_(size) {}
  explicit ByteReader(const Bytes& bytes) : ByteReader(bytes.data(), bytes.size()) {}

  [[nodiscard]] std::size_t left() const { return left_; }
  /// Throws Fault if bytes are left.
  void require_end() const;
  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  ByteReader part(std::size_t size);
  Bytes bytes(std::size_t size);
  /// A list of u16, preceded by its length.
  std::vector<std::uint16_t> u16_list();
  /// Bits in whole bytes, preceded by their number.
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

/// A parameter as contained in a message.
struct Parameter {
  std::uint16_t type = 0;
  ByteReader content;
  Bytes whole;  ///< With its header.
};

/// The rest of `reader` as parameters. Throws Fault if that is not a whole number of them.
std::vector<Parameter> parameters_of(ByteReader reader);

/// The parameter of this type, if any. Throws Fault if there are two.
std::optional<Parameter> find(const std::vector<Parameter>& all, std::uint16_t type);
/// Same, but throws Fault if there is none.
Parameter require(const std::vector<Parameter>& all, std::uint16_t type);
/// Throws Fault if a parameter's type is not in `known`; custom parameters are always accepted.
void require_known(const std::vector<Parameter>& all, std::initializer_list<std::uint16_t> known);

/// Appends numbers one after the other.
class ByteWriter {
 public:
  void u8(std::uint8_t value) { number(value, 1); }
  void u16(std::uint16_t value) { number(value, 2); }
  void s16(std::int16_t value) { number(static_cast<std::uint16_t>(value), 2); }
  void u32(std::uint32_t value) { number(value, 4); }
  void u64(std::uint64_t value) { number(value, 8); }
  /// Writes a u8 that uses only its highest bit.
  void flag(bool value) { u8(value ? 0x80 : 0); }
  void bytes(const Bytes& bytes);
  void text(std::string_view text);  ///< Preceded by its length.
  /// Writes a parameter with a header of type and length; `write` adds its content.
  void parameter(std::uint16_t type, const std::function<void()>& write);
  /// As above, for a vendor's custom parameter.
  void custom(std::uint32_t vendor, std::uint32_t subtype, const std::function<void()>& write);
  /// Writes the header of a fixed-length parameter, type 1 to 127.
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
/// Far longer than any message from a client.
inline constexpr std::size_t kMaxMessage = std::size_t{1} << 20U;

/// The ID that is the whole body. Throws Fault if it is not.
std::uint32_t id_in(const Message& message);
/// The message's only parameter. Throws Fault if it is not of this type.
Parameter only_parameter(const Message& message, std::uint16_t type);

/// Encodes the message, with its header.
Bytes to_bytes(const Message& message);

/// The message's length according to its header of kHeaderSize bytes. Throws Fault if the message
/// is too short, too long, or of another version.
std::size_t length_in(const std::uint8_t* header);
/// Decodes one whole message, `length_in()` bytes.
Message message_of(const Bytes& bytes);

}  // namespace tagfield::llrp
