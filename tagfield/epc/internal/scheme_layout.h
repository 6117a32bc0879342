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

/// A scheme of three parts: header (8 bits), filter and what follows it. Where there is a company
/// prefix, a partition (3 bits) shares `both_bits` and `total_digits` out between prefix and
/// reference.
struct SchemeLayout {
  EpcScheme scheme = EpcScheme::kSgtin;
  std::string_view name;  ///< In pure identity URIs; tag URIs have "-96" after it.
  std::uint8_t header = 0;
  std::string_view reference;  ///< What the field after the company prefix is called.
  int both_bits = 0;           ///< Of company prefix and reference; 0 where there is no prefix.
  int total_digits = 0;        ///< Of both; the most of them where `is_padded` is not set.
  bool is_padded = false;      ///< The reference has all its digits, leading zeros too.
  std::string_view serial;     ///< What the last field is called; "" for none.
  int serial_bits = 0;
};

const SchemeLayout& layout_of(EpcScheme scheme);
/// The scheme of the name; null where there is none.
const SchemeLayout* layout_named(std::string_view name);
/// The scheme of the header; null where it is no 96-bit scheme's.
const SchemeLayout* layout_of_header(std::uint8_t header);
/// All names, for complaints: "sgtin, sscc, …".
std::string scheme_names();

/// How long a company prefix may be.
inline constexpr int kLeastCompanyDigits = 6;
inline constexpr int kMostCompanyDigits = 12;
/// Bits of a company prefix of 12 digits, of 11, … of 6: by partition.
inline constexpr std::array<int, 7> kCompanyBits = {40, 37, 34, 30, 27, 24, 20};

/// A field of decimal digits.
struct DecimalField {
  std::string_view name;
  int bits = 0;
  int digits = 0;          ///< So many, or at most so many where it is not padded.
  bool is_padded = false;  ///< With leading zeros to `digits`; else without any but "0" itself.
};

/// The number that it is. Throws Error, without naming the EPC, where the text doesn't fit.
std::uint64_t number_of(const DecimalField& field, const std::string& text);
/// The text of a number; none where it has more digits than the field may have.
std::optional<std::string> text_of(const DecimalField& field, std::uint64_t number);

}  // namespace tagfield
