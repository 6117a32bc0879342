// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/link_timing.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/error.h"
#include "tagfield/base/range_check.h"

namespace tagfield {
namespace {

constexpr double kDelimiter_s = 12.5e-6;
constexpr double kRandomBit = 0.5;  // Mean number of ones in an unknown bit.

double data1_s(const LinkSettings& link) { return link.data1_tari * link.tari_s; }

/// Duration of `bits` bits of which `ones` are ones, possibly a mean.
double bits_s(const LinkSettings& link, int bits, double ones) {
  return (bits - ones) * link.tari_s + ones * data1_s(link);
}

/// Ones in the session's two bits.
int ones_of(Session session) {
  const int code = static_cast<int>(session);
  return code % 2 + code / 2;
}

/// Ones in the two bits of M: FM0 00, Miller 2 01, Miller 4 10, Miller 8 11.
int ones_of(Encoding encoding) {
  if (encoding == Encoding::kFm0) return 0;
  return encoding == Encoding::kMiller8 ? 2 : 1;
}

double value_of(DivideRatio ratio) { return ratio == DivideRatio::k8 ? 8.0 : 64.0 / 3.0; }

/// `scale` converts the value to `unit`. The bounds themselves are allowed, with a tolerance for
/// rounding.
void check_range(const char* name, double value, double least, double most, double scale,
                 const char* unit) {
  constexpr double kRounding = 1e-9;
  if (value >= least * (1.0 - kRounding) && value <= most * (1.0 + kRounding)) return;
  throw Error(fmt::format("{} must be from {:.5g} to {:.5g}{}, is {:.6g}", name, least * scale,
                          most * scale, unit, value * scale));
}

}  // namespace

void check(const LinkSettings& link) {
  check_range("tari", link.tari_s, 6.25e-6, 25e-6, 1e6, " us");
  check_range("data1", link.data1_tari, 1.5, 2.0, 1.0, " Tari");
  check_range("blf", link.blf_hz, 40e3, 640e3, 1e-3, " kHz");
  check_range("TRcal (the divide ratio over blf)", trcal_s(link), 1.1 * rtcal_s(link),
              3.0 * rtcal_s(link), 1e6, " us (1.1 to 3 RTcal)");
  check_range("t2", link.t2_tpri, 3.0, 20.0, 1.0, " Tpri");
  check_range("t3", link.t3_tpri, 0.0, 1000.0, 1.0, " Tpri");
  require(link.epc_bits >= 0 && link.epc_bits <= 496 && link.epc_bits % 16 == 0, "epc_bits",
          "a multiple of 16 from 0 to 496", link.epc_bits);
}

double rtcal_s(const LinkSettings& link) { return link.tari_s + data1_s(link); }
double trcal_s(const LinkSettings& link) { return value_of(link.divide_ratio) / link.blf_hz; }
double tpri_s(const LinkSettings& link) { return 1.0 / link.blf_hz; }

double reply_bit_s(const LinkSettings& link) {
  return static_cast<int>(link.encoding) * tpri_s(link);
}

double frame_sync_s(const LinkSettings& link) { return kDelimiter_s + link.tari_s + rtcal_s(link); }
double preamble_s(const LinkSettings& link) { return frame_sync_s(link) + trcal_s(link); }

double query_s(const LinkSettings& link, Session session) {
  // 1000, DR, M, TRext, Sel 00, session; then target, Q and CRC-5.
  const int known = 1 + (link.divide_ratio == DivideRatio::k64_3 ? 1 : 0) + ones_of(link.encoding) +
                    (link.pilot ? 1 : 0) + ones_of(session);
  return preamble_s(link) + bits_s(link, 22, known + 10 * kRandomBit);
}

double query_adjust_s(const LinkSettings& link, Session session) {
  // 1001, session, and 110 for up or 011 for down.
  return frame_sync_s(link) + bits_s(link, 9, 4 + ones_of(session));
}

double query_rep_s(const LinkSettings& link, Session session) {
  return frame_sync_s(link) + bits_s(link, 4, ones_of(session));
}

double ack_s(const LinkSettings& link) {
  return frame_sync_s(link) + bits_s(link, 18, 1 + 16 * kRandomBit);
}

double reply_s(const LinkSettings& link, int bits) {
  const int preamble = link.encoding == Encoding::kFm0 ? 6 : 10;
  const int pilot = link.pilot ? 12 : 0;
  const int dummy = 1;
  return (preamble + pilot + bits + dummy) * reply_bit_s(link);
}

double rn16_s(const LinkSettings& link) { return reply_s(link, 16); }
double epc_reply_s(const LinkSettings& link) { return reply_s(link, 16 + link.epc_bits + 16); }

double t1_s(const LinkSettings& link) { return std::max(rtcal_s(link), 10.0 * tpri_s(link)); }
double t2_s(const LinkSettings& link) { return link.t2_tpri * tpri_s(link); }
double t3_s(const LinkSettings& link) { return link.t3_tpri * tpri_s(link); }
double t4_s(const LinkSettings& link) { return 2.0 * rtcal_s(link); }

double empty_slot_s(const LinkSettings& link) {
  return std::max(t1_s(link) + t3_s(link), t4_s(link));
}

double collided_slot_s(const LinkSettings& link) { return t1_s(link) + rn16_s(link) + t2_s(link); }

double epc_begins_s(const LinkSettings& link) {
  return collided_slot_s(link) + ack_s(link) + t1_s(link);
}

double read_slot_s(const LinkSettings& link) {
  return epc_begins_s(link) + epc_reply_s(link) + t2_s(link);
}

}  // namespace tagfield
