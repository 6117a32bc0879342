// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/reads_csv.h"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "tagfield/base/read_range.h"
#include "tagfield/base/units.h"
#include "tagfield/files/csv.h"
#include "tagfield/files/units_seen.h"

namespace tagfield {

namespace {

struct ReadColumns {
  std::size_t stamp = 0, antenna = 0, tag = 0, frequency = 0, rssi = 0;
  std::optional<std::size_t> reader, phase, doppler;  ///< Optional columns.
};

/// Refuses a table from another source as a whole, as all of its columns would have to be renamed.
void require_own_format(const CsvTable& table) {
  if (table.has_column("stamp_s") || table.has_column("tag")) return;
  std::string own = reads_header(false);
  own.pop_back();  // The end of the line.
  fail({table.file, 1},
       fmt::format("not in Tagfield's own format ({}), as its columns are {}; localize, track and "
                   "calibrate read other formats by --format (docs/datasets.md)",
                   own, fmt::join(table.header, ",")));
}

ReadColumns columns_of(const CsvTable& table) {
  require_own_format(table);
  const auto if_there = [&](const char* name) {
    return table.has_column(name) ? std::optional(table.column(name)) : std::nullopt;
  };
  ReadColumns columns{table.column("stamp_s"),
                      table.column("antenna"),
                      table.column("tag"),
                      table.column("frequency_hz"),
                      0,
                      {},
                      {},
                      if_there("doppler_hz")};
  // Phases may be missing, but not under another name.
  const bool has_phase =
      std::any_of(table.header.begin(), table.header.end(),
                  [](const std::string& name) { return name.find("phase") != std::string::npos; });
  if (has_phase) columns.phase = table.column("phase_rad");
  columns.rssi = table.column("rssi_dbm");
  columns.reader = if_there("reader");
  return columns;
}

TagRead read_in(const CsvTable& table, const ReadColumns& columns, const CsvRow& row,
                UnitsSeen& units) {
  TagRead read;
  read.stamp = table.stamp(row, columns.stamp);
  if (columns.reader) read.reader = row.fields[*columns.reader];
  read.antenna = table.text(row, columns.antenna);
  read.tag = table.text(row, columns.tag);
  read.frequency_hz = table.number(row, columns.frequency);
  if (!(read.frequency_hz > 0.0)) {
    fail({table.file, row.line}, "frequency_hz must be greater than 0");
  }
  units.add_carrier(read.frequency_hz, row.line);
  if (columns.phase) {
    const double phase_rad = table.number(row, *columns.phase);
    units.add_phase(phase_rad, row.line);
    read.phase_rad = wrap_to_two_pi(phase_rad);
  }
  read.rssi_dbm = table.number(row, columns.rssi);
  // No lower bound: by the paper's law RSSI is as low as noise cancels the amplitude.
  if (read.rssi_dbm > kMaxRssiDbm) {
    fail({table.file, row.line},
         fmt::format("rssi_dbm must be at most {} dBm, is {}", kMaxRssiDbm, read.rssi_dbm));
  }
  const bool reports_doppler = columns.doppler && !row.fields[*columns.doppler].empty();
  if (reports_doppler) read.doppler_hz = table.number(row, *columns.doppler);
  return read;
}

}  // namespace

std::string reads_header(bool has_doppler) {
  return fmt::format("stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm{}\n",
                     has_doppler ? ",doppler_hz" : "");
}

void append_row(const TagRead& read, bool has_doppler, std::string& text) {
  fmt::memory_buffer row;
  const auto out = std::back_inserter(row);
  fmt::format_to(out, FMT_COMPILE("{},{},{},{},{},{:.6f},{}"), format_stamp(read.stamp),
                 csv_field(read.reader), csv_field(read.antenna), csv_field(read.tag),
                 read.frequency_hz, read.phase_rad, read.rssi_dbm);
  if (has_doppler) row.push_back(',');
  if (read.doppler_hz) fmt::format_to(out, FMT_COMPILE("{}"), *read.doppler_hz);
  row.push_back('\n');
  text.append(row.data(), row.size());
}

std::string reads_to_csv(const std::vector<TagRead>& reads) {
  const bool has_doppler = std::any_of(
      reads.begin(), reads.end(), [](const TagRead& read) { return read.doppler_hz.has_value(); });
  std::string text = reads_header(has_doppler);
  for (const TagRead& read : reads) append_row(read, has_doppler, text);
  return text;
}

void for_each_read(const std::string& path, const std::function<void(TagRead)>& take,
                   const std::function<void(double)>& on_progress, Diagnostics* diagnostics) {
  CsvTable table;
  ReadColumns columns;
  UnitsSeen units;
  read_csv_rows(
      path,
      [&](const CsvTable& begun) {
        table = begun;
        columns = columns_of(table);
      },
      [&](const CsvRow& row) { take(read_in(table, columns, row, units)); }, {}, on_progress);
  if (diagnostics != nullptr) units.tell(path, {}, *diagnostics);
}

std::vector<TagRead> read_reads_csv(const std::string& path,
                                    const std::function<void(double)>& on_progress,
                                    Diagnostics* diagnostics) {
  std::vector<TagRead> reads;
  for_each_read(
      path, [&](TagRead read) { reads.push_back(std::move(read)); }, on_progress, diagnostics);
  reads.shrink_to_fit();
  return reads;
}

}  // namespace tagfield
