// SPDX-License-Identifier: Apache-2.0
/// @file
/// How the 96-bit schemes lay out their fields: GS1 EPC Tag Data Standard 1.13, section 14.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tagfield/epc/epc.h"

namespace tagfield {

/// A scheme with three parts: header (8 bits), filter, and the rest. If there is a company prefix,
/// a partition (3 bits) divides `both_bits` and `total_digits` between prefix and reference.
struct SchemeLayout {
  EpcScheme scheme = EpcScheme::kSgtin;
  std::string_view name;  ///< In pure identity URIs; tag URIs append "-96".
  std::uint8_t header = 0;
  std::string_view reference;  ///< Name of the field after the company prefix.
  int both_bits = 0;        ///< Of company prefix and reference together; 0 if there is no prefix.
  int total_digits = 0;     ///< Of both together; the maximum if `is_padded` is not set.
  bool is_padded = false;   ///< The reference has all its digits, including leading zeros.
  std::string_view serial;  ///< Name of the last field; "" for none.
  int serial_bits = 0;
};

const SchemeLayout& layout_of(EpcScheme scheme);
/// The scheme with this name; null if there is none.
const SchemeLayout* layout_named(std::string_view name);
/// The scheme with this header; null if it belongs to no 96-bit scheme.
const SchemeLayout* layout_of_header(std::uint8_t header);
/// All names, for error messages: "sgtin, sscc, …".
std::string scheme_names();

/// Allowed length of a company prefix.
inline constexpr int kMinCompanyDigits = 6;
inline constexpr int kMaxCompanyDigits = 12;
/// Bits of a company prefix by partition: for 12, 11, … 6 digits.
inline constexpr std::array<int, 7> kCompanyBits = {40, 37, 34, 30, 27, 24, 20};

/// A field of decimal digits.
struct DecimalField {
  std::string_view name;
  int bits = 0;
  int digits = 0;          ///< Exact number, or the maximum if not padded.
  bool is_padded = false;  ///< With leading zeros up to `digits`; otherwise only "0" has one.
};

/// The number given by the text. Throws Error, without naming the EPC, if the text doesn't fit.
std::uint64_t number_of(const DecimalField& field, const std::string& text);
/// The text of a number; none if it has more digits than the field allows.
std::optional<std::string> text_of(const DecimalField& field, std::uint64_t number);

}  // namespace tagfield
