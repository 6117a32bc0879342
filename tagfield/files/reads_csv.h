// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tag reads as CSV: `stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm`, and
/// `doppler_hz` where a read tells it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// The header line, and a read's line at the end of `text`: with the column doppler_hz, or without
/// where no read tells it.
std::string reads_header(bool has_doppler);
void append_row(const TagRead& read, bool has_doppler, std::string& text);

/// Text of the table, a row a read in the order given. Stamps are exact, phase has six decimals.
std::string reads_to_csv(const std::vector<TagRead>& reads);

/// Reads the table from a file, a simulated or a real reader's. A phase outside [0, 2π) is
/// wrapped. `reader` may be missing. Throws Error "FILE:LINE: …" on a missing column, text where a
/// number belongs, a frequency that is not positive. `on_progress`, where given, gets the share of
/// the file that is done now and then.
std::vector<TagRead> read_reads_csv(const std::string& path,
                                    const std::function<void(double)>& on_progress = {});

/// The same read by read, of tables that don't fit in memory. Reads before a bad line have been
/// taken when it throws.
void for_each_read(const std::string& path, const std::function<void(TagRead)>& take,
                   const std::function<void(double)>& on_progress = {});

}  // namespace tagfield
