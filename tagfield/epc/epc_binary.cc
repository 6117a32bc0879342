// SPDX-License-Identifier: Apache-2.0
// The coding tables of section 14.6 of the Tag Data Standard.
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/error.h"
#include "tagfield/epc/epc.h"
#include "tagfield/epc/internal/scheme_layout.h"

namespace tagfield {
namespace {

constexpr int kFilterBits = 3;
constexpr int kPartitionBits = 3;
constexpr int kCageLetters = 6;
constexpr DecimalField kManager = {"general manager number", 28, 9, false};
constexpr DecimalField kObjectClass = {"object class", 24, 8, false};
constexpr DecimalField kGidSerial = {"serial number", 36, 11, false};
constexpr DecimalField kUsdodFilter = {"filter", 4, 2, false};

/// Appends numbers to the bits of a tag, the most significant bit first.
class BitWriter {
 public:
  void append(std::uint64_t number, int bits) {
    for (int bit = bits - 1; bit >= 0; --bit, ++at_) {
      if ((number >> bit & 1U) == 0) continue;
      bytes_[at_ / 8] = static_cast<std::uint8_t>(bytes_[at_ / 8] | 0x80U >> at_ % 8);
    }
  }
  [[nodiscard]] const EpcBytes& bytes() const { return bytes_; }

 private:
  EpcBytes bytes_{};
  std::size_t at_ = 0;
};

class BitReader {
 public:
  explicit BitReader(const EpcBytes& bytes) : bytes_(bytes) {}
  std::uint64_t take(int bits) {
    std::uint64_t number = 0;
    for (int i = 0; i < bits; ++i, ++at_) {
      number = number << 1U | (std::uint64_t{bytes_[at_ / 8]} >> (7 - at_ % 8) & 1U);
    }
    return number;
  }
  [[nodiscard]] int left() const { return static_cast<int>(8 * bytes_.size() - at_); }

 private:
  EpcBytes bytes_;
  std::size_t at_ = 0;
};

DecimalField company_field(int digits) {
  return {"company prefix", kCompanyBits[static_cast<std::size_t>(kMaxCompanyDigits - digits)],
          digits, true};
}

DecimalField reference_field(const SchemeLayout& layout, const DecimalField& company) {
  return {layout.reference, layout.both_bits - company.bits, layout.total_digits - company.digits,
          layout.is_padded};
}

DecimalField serial_field(const SchemeLayout& layout) {
  return {layout.serial, layout.serial_bits, 13, false};
}

void require_fields(const Epc& epc, std::size_t count) {
  if (epc.fields.size() == count) return;
  throw Error(fmt::format("needs {} fields between dots, has {}", count, epc.fields.size()));
}

void append_partitioned(const SchemeLayout& layout, const Epc& epc, BitWriter& bits) {
  require_fields(epc, layout.serial.empty() ? 2 : 3);
  const std::string& prefix = epc.fields[0];
  const auto digits = static_cast<int>(prefix.size());
  if (digits < kMinCompanyDigits || digits > kMaxCompanyDigits) {
    throw Error(fmt::format("company prefix '{}' must have {} to {} digits", prefix,
                            kMinCompanyDigits, kMaxCompanyDigits));
  }
  const DecimalField company = company_field(digits);
  const DecimalField reference = reference_field(layout, company);
  bits.append(static_cast<std::uint64_t>(epc.filter), kFilterBits);
  bits.append(static_cast<std::uint64_t>(kMaxCompanyDigits - digits), kPartitionBits);
  bits.append(number_of(company, prefix), company.bits);
  bits.append(number_of(reference, epc.fields[1]), reference.bits);
  if (layout.serial.empty()) return;
  bits.append(number_of(serial_field(layout), epc.fields[2]), layout.serial_bits);
}

void append_gid(const Epc& epc, BitWriter& bits) {
  require_fields(epc, 3);
  std::size_t i = 0;
  for (const DecimalField& field : {kManager, kObjectClass, kGidSerial}) {
    bits.append(number_of(field, epc.fields[i++]), field.bits);
  }
}

/// Digits and capital letters except I and O, which look like digits.
bool is_cage_letter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z' && c != 'I' && c != 'O');
}

/// A CAGE code of 5 characters gets a leading space; a DoDAAC has 6.
std::string padded_cage(const std::string& code) {
  if (code.size() + 1 < kCageLetters || code.size() > kCageLetters ||
      !std::all_of(code.begin(), code.end(), is_cage_letter)) {
    throw Error(fmt::format(
        "'{}' must be a CAGE code (5) or DoDAAC (6) of digits and capital letters except I and O",
        code));
  }
  return code.size() < kCageLetters ? ' ' + code : code;
}

void append_usdod(const SchemeLayout& layout, const Epc& epc, BitWriter& bits) {
  require_fields(epc, 2);
  bits.append(static_cast<std::uint64_t>(epc.filter), kUsdodFilter.bits);
  for (const char c : padded_cage(epc.fields[0])) bits.append(static_cast<std::uint64_t>(c), 8);
  bits.append(number_of(serial_field(layout), epc.fields[1]), layout.serial_bits);
}

EpcBytes encoded(const Epc& epc) {
  const SchemeLayout& layout = layout_of(epc.scheme);
  const int max_filter = epc.scheme == EpcScheme::kUsdod ? 15 : 7;
  if (epc.filter < 0 || epc.filter > max_filter) {
    throw Error(fmt::format("filter {} must be 0 to {}", epc.filter, max_filter));
  }
  BitWriter bits;
  bits.append(layout.header, 8);
  if (layout.both_bits > 0) append_partitioned(layout, epc, bits);
  if (epc.scheme == EpcScheme::kGid) append_gid(epc, bits);
  if (epc.scheme == EpcScheme::kUsdod) append_usdod(layout, epc, bits);
  return bits.bytes();
}

std::string take_text(const DecimalField& field, BitReader& bits) {
  const std::uint64_t number = bits.take(field.bits);
  const std::optional<std::string> text = text_of(field, number);
  if (text) return *text;
  throw Error(fmt::format("{} {} has more than {} digits", field.name, number, field.digits));
}

void take_partitioned(const SchemeLayout& layout, BitReader& bits, Epc& epc) {
  epc.filter = static_cast<int>(bits.take(kFilterBits));
  const auto partition = static_cast<int>(bits.take(kPartitionBits));
  if (partition > kMaxCompanyDigits - kMinCompanyDigits) {
    throw Error(fmt::format("partition {} must be 0 to 6", partition));
  }
  const DecimalField company = company_field(kMaxCompanyDigits - partition);
  epc.fields.push_back(take_text(company, bits));
  epc.fields.push_back(take_text(reference_field(layout, company), bits));
  if (!layout.serial.empty()) epc.fields.push_back(take_text(serial_field(layout), bits));
  if (bits.left() > 0 && bits.take(bits.left()) != 0) throw Error("its last bits must be zero");
}

void take_usdod(const SchemeLayout& layout, BitReader& bits, Epc& epc) {
  epc.filter = static_cast<int>(bits.take(kUsdodFilter.bits));
  std::string code;
  for (int i = 0; i < kCageLetters; ++i) code += static_cast<char>(bits.take(8));
  if (code.front() == ' ') code.erase(0, 1);
  padded_cage(code);
  epc.fields = {code, take_text(serial_field(layout), bits)};
}

Epc decoded(const EpcBytes& bytes) {
  const SchemeLayout* layout = layout_of_header(bytes[0]);
  if (layout == nullptr) {
    throw Error(fmt::format("header {:02X} is not that of a scheme of 96 bits", bytes[0]));
  }
  BitReader bits(bytes);
  bits.take(8);
  Epc epc;
  epc.scheme = layout->scheme;
  if (layout->both_bits > 0) take_partitioned(*layout, bits, epc);
  if (epc.scheme == EpcScheme::kGid) {
    for (const DecimalField& field : {kManager, kObjectClass, kGidSerial}) {
      epc.fields.push_back(take_text(field, bits));
    }
  }
  if (epc.scheme == EpcScheme::kUsdod) take_usdod(*layout, bits, epc);
  return epc;
}

}  // namespace

EpcBytes epc_bytes(const Epc& epc) {
  try {
    return encoded(epc);
  } catch (const Error& error) {
    const std::string uri = epc.filter == 0 ? id_uri(epc) : tag_uri(epc);
    throw Error(fmt::format("EPC '{}': {}", uri, error.what()));
  }
}

Epc epc_from_bytes(const EpcBytes& bytes) {
  try {
    return decoded(bytes);
  } catch (const Error& error) {
    throw Error(fmt::format("EPC {}: {}", hex_of(bytes), error.what()));
  }
}

}  // namespace tagfield
