// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tag reads as CSV: `stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm`, and `doppler_hz`
/// if a read reports it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// The header line, and appending of a read's line to `text`: with the column doppler_hz, or
/// without it if no read reports it.
std::string reads_header(bool has_doppler);
void append_row(const TagRead& read, bool has_doppler, std::string& text);

/// Text of the table, a row per read in the given order. Stamps are exact, phase has six decimals.
std::string reads_to_csv(const std::vector<TagRead>& reads);

/// Reads the table of a simulated or a real reader from a file. A phase outside [0, 2π) is wrapped.
/// `reader` may be missing. Throws Error "FILE:LINE: …" on a missing column, text instead of a
/// number, a frequency that is not positive. `on_progress`, if given, is called regularly with the
/// share of the file that has been read. `diagnostics`, if given, is warned of carriers that can't
/// be in Hz and of phases that can hardly be in radians.
std::vector<TagRead> read_reads_csv(const std::string& path,
                                    const std::function<void(double)>& on_progress = {},
                                    Diagnostics* diagnostics = nullptr);

/// Same, read by read, for tables that don't fit in memory. When an error is thrown, the reads
/// before the bad line have been passed.
void for_each_read(const std::string& path, const std::function<void(TagRead)>& take,
                   const std::function<void(double)>& on_progress = {},
                   Diagnostics* diagnostics = nullptr);

}  // namespace tagfield
