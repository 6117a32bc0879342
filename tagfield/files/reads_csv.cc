#include "tagfield/files/reads_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tagfield/base/units.h"
#include "tagfield/files/csv.h"

namespace tagfield {

std::string reads_header(bool has_doppler) {
  return fmt::format("stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm{}\n",
                     has_doppler ? ",doppler_hz" : "");
}

void append_row(const TagRead& read, bool has_doppler, std::string& text) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{},{},{},{},{},{:.6f},{}", format_stamp(read.stamp), csv_field(read.reader),
                 csv_field(read.antenna), csv_field(read.tag), read.frequency_hz, read.phase_rad,
                 read.rssi_dbm);
  if (has_doppler) text += ',';
  if (read.doppler_hz) fmt::format_to(out, "{}", *read.doppler_hz);
  text += '\n';
}

std::string reads_to_csv(const std::vector<TagRead>& reads) {
  const bool has_doppler = std::any_of(
      reads.begin(), reads.end(), [](const TagRead& read) { return read.doppler_hz.has_value(); });
  std::string text = reads_header(has_doppler);
  for (const TagRead& read : reads) append_row(read, has_doppler, text);
  return text;
}

std::vector<TagRead> read_reads_csv(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t stamp = table.column("stamp_s");
  const std::size_t antenna = table.column("antenna");
  const std::size_t tag = table.column("tag");
  const std::size_t frequency = table.column("frequency_hz");
  // Phases may be missing, not called otherwise.
  const bool has_phase =
      std::any_of(table.header.begin(), table.header.end(),
                  [](const std::string& name) { return name.find("phase") != std::string::npos; });
  const std::size_t phase = has_phase ? table.column("phase_rad") : 0;
  const std::size_t rssi = table.column("rssi_dbm");
  const bool named_reader = table.has_column("reader");
  const std::size_t reader = named_reader ? table.column("reader") : 0;
  const bool has_doppler = table.has_column("doppler_hz");
  const std::size_t doppler = has_doppler ? table.column("doppler_hz") : 0;
  std::vector<TagRead> reads;
  reads.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    TagRead read;
    read.stamp = table.stamp(row, stamp);
    if (named_reader) read.reader = row.fields[reader];
    read.antenna = table.text(row, antenna);
    read.tag = table.text(row, tag);
    read.frequency_hz = table.number(row, frequency);
    if (!(read.frequency_hz > 0.0)) {
      fail({path, row.line}, "frequency_hz must be greater than 0");
    }
    if (has_phase) read.phase_rad = wrap_to_two_pi(table.number(row, phase));
    read.rssi_dbm = table.number(row, rssi);
    const bool tells_doppler = has_doppler && !row.fields[doppler].empty();
    if (tells_doppler) read.doppler_hz = table.number(row, doppler);
    reads.push_back(std::move(read));
  }
  return reads;
}

}  // namespace tagfield
