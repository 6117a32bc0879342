// SPDX-License-Identifier: Apache-2.0
/// @file
/// Durations of EPC Gen2 commands, replies and slots on the air. Sections, tables and figures are
/// those of the GS1 EPC UHF Gen2 Air Interface Protocol, version 2.0.1 (ISO/IEC 18000-63); times
/// are nominal, without its tolerances.
#pragma once

#include "tagfield/gen2/session.h"

namespace tagfield {

/// Encoding of a tag's reply (6.3.1.3.2): FM0, or Miller with 2, 4 or 8 subcarrier cycles per bit.
enum class Encoding { kFm0 = 1, kMiller2 = 2, kMiller4 = 4, kMiller8 = 8 };

/// TRcal's divide ratio DR (6.3.1.2.8): BLF = DR/TRcal.
enum class DivideRatio { k8, k64_3 };

/// A reader's link profile. The default is a common one for many readers side by side: Tari 25 µs,
/// Miller 4 at 250 kHz with pilot tone.
struct LinkSettings {
  double tari_s = 25e-6;    ///< Length of a data-0 [s]; from 6.25e-6 to 25e-6.
  double data1_tari = 1.5;  ///< Length of a data-1 [Tari]; from 1.5 to 2.
  double blf_hz = 250e3;    ///< Backscatter link frequency; from 40e3 to 640e3.
  DivideRatio divide_ratio = DivideRatio::k64_3;
  Encoding encoding = Encoding::kMiller4;
  bool pilot = true;      ///< TRext: the longer preamble before replies.
  double t2_tpri = 10.0;  ///< T2, from a reply to the next command [1/BLF]; from 3 to 20.
  double t3_tpri = 10.0;  ///< T3, how long to wait for a reply after T1 [1/BLF]; 0 or more.
  int epc_bits = 96;      ///< A multiple of 16 from 0 to 496.
};

/// Throws Error naming the parameter and its range. TRcal = DR/BLF must be from 1.1 to 3 times
/// RTcal (6.3.1.2.8), which is also checked.
void check(const LinkSettings& link);

// The functions below return seconds and require a link accepted by check().

/// RTcal: a data-0 plus a data-1 (6.3.1.2.8).
double rtcal_s(const LinkSettings& link);
/// TRcal = DR/BLF (6.3.1.2.8, equation 1).
double trcal_s(const LinkSettings& link);
/// Tpri = 1/BLF, one cycle of the subcarrier.
double tpri_s(const LinkSettings& link);
/// One bit of a reply (Table 6.10): the encoding's number of cycles.
double reply_bit_s(const LinkSettings& link);

/// Delimiter of 12.5 µs, data-0 and RTcal (Figure 6.4).
double frame_sync_s(const LinkSettings& link);
/// A frame-sync and TRcal, before each Query (Figure 6.4).
double preamble_s(const LinkSettings& link);

// Commands, including their preamble or frame-sync. Known bits (the command, the link, the session)
// count with their values; those that vary (target, Q, CRC-5, RN16) count as half ones.

/// Query: preamble and 22 bits (6.3.2.12.2.1).
double query_s(const LinkSettings& link, Session session);
/// QueryAdjust up or down: frame-sync and 9 bits (6.3.2.12.2.2).
double query_adjust_s(const LinkSettings& link, Session session);
/// QueryRep: frame-sync and 4 bits (6.3.2.12.2.3).
double query_rep_s(const LinkSettings& link, Session session);
/// ACK: frame-sync and 18 bits (6.3.2.12.2.4).
double ack_s(const LinkSettings& link);

/// A reply of `bits` with its preamble and the final dummy bit: the preamble has 6 symbols for FM0,
/// 18 with pilot (Figures 6.11, 6.12), and 10 or 22 for Miller (Figures 6.15, 6.16).
double reply_s(const LinkSettings& link, int bits);
/// The 16-bit random number by which a tag is acknowledged.
double rn16_s(const LinkSettings& link);
/// PC, EPC and CRC-16: 128 bits for an EPC of 96.
double epc_reply_s(const LinkSettings& link);

// Link timing (6.3.1.6, Table 6.16).

/// T1, from a command to its reply: max(RTcal, 10 Tpri).
double t1_s(const LinkSettings& link);
/// T2, from a reply to the next command.
double t2_s(const LinkSettings& link);
/// T3, how long the reader waits for a reply after T1.
double t3_s(const LinkSettings& link);
/// T4, minimum time between two commands: 2 RTcal.
double t4_s(const LinkSettings& link);

// Time from the end of a slot's command (Query, QueryAdjust or QueryRep) to the next (Figure 6.18).

/// No tag replies: T1 and T3, but at least T4.
double empty_slot_s(const LinkSettings& link);
/// No RN16 is decoded: T1, RN16, T2.
double collided_slot_s(const LinkSettings& link);
/// T1, RN16, T2, ACK, T1, EPC, T2.
double read_slot_s(const LinkSettings& link);
/// Start of the EPC's reply within read_slot_s().
double epc_begins_s(const LinkSettings& link);

}  // namespace tagfield
