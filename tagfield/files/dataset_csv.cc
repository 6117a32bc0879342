// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/dataset_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "tagfield/base/file_kind.h"
#include "tagfield/base/number.h"
#include "tagfield/base/read_range.h"
#include "tagfield/base/units.h"
#include "tagfield/files/folder_entries.h"

namespace tagfield {
namespace {

/// Interpreted by localization as an RSSI that was not reported [dBm].
constexpr double kUnknownRssi = -200.0;

/// Days from 1970-01-01 of a date of the Gregorian calendar: whole eras of 400 years, then days of
/// a year that begins in March, so that a leap day comes last.
std::int64_t days_of_date(std::int64_t year, std::int64_t month, std::int64_t day) {
  const std::int64_t from_march = (month + 9) % 12;
  const std::int64_t y = month <= 2 ? year - 1 : year;
  const std::int64_t day_of_year = (153 * from_march + 2) / 5 + day - 1;
  return 365 * y + y / 4 - y / 100 + y / 400 + day_of_year - 719468;
}

std::int64_t days_in(std::int64_t year, std::int64_t month) {
  const bool is_last = month == 12;
  return days_of_date(is_last ? year + 1 : year, is_last ? 1 : month + 1, 1) -
         days_of_date(year, month, 1);
}

/// A number of `digits` digits at `at` in `text`; none otherwise.
std::optional<int> digits_at(const std::string& text, std::size_t at, std::size_t digits) {
  if (text.size() < at + digits) return std::nullopt;
  int value = 0;
  for (std::size_t i = at; i < at + digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

/// Fraction of a second [ns] after the seconds ("", ".25", ".250000Z"); none otherwise.
std::optional<std::int64_t> nanoseconds_of(std::string rest) {
  if (!rest.empty() && rest.back() == 'Z') rest.pop_back();
  if (rest.empty()) return 0;
  if (rest[0] != '.' || rest.size() < 2 || rest.size() > 10) return std::nullopt;
  const std::size_t digits = rest.size() - 1;
  const std::optional<int> value = digits_at(rest, 1, digits);
  if (!value) return std::nullopt;
  std::int64_t scaled = *value;
  for (std::size_t i = digits; i < 9; ++i) scaled *= 10;
  return scaled;
}

std::optional<Time> parse_iso(const std::string& text) {
  const auto year = digits_at(text, 0, 4);
  const auto month = digits_at(text, 5, 2);
  const auto day = digits_at(text, 8, 2);
  const auto hour = digits_at(text, 11, 2);
  const auto minute = digits_at(text, 14, 2);
  const auto second = digits_at(text, 17, 2);
  if (!year || !month || !day || !hour || !minute || !second) return std::nullopt;
  const bool marked = text[4] == '-' && text[7] == '-' && (text[10] == 'T' || text[10] == ' ') &&
                      text[13] == ':' && text[16] == ':';
  const bool in_range = *year >= 1970 && *year <= 2114 && *month >= 1 && *month <= 12 &&
                        *day >= 1 && *day <= days_in(*year, *month) && *hour < 24 && *minute < 60 &&
                        *second <= 60;
  const auto fraction = nanoseconds_of(text.substr(19));
  if (!marked || !in_range || !fraction) return std::nullopt;
  const std::int64_t seconds =
      ((days_of_date(*year, *month, *day) * 24 + *hour) * 60 + *minute) * 60 + *second;
  return Time(Duration(seconds * 1'000'000'000 + *fraction));
}

/// Index of a column in a table; none for "".
std::optional<std::size_t> place_of(const CsvTable& table, const std::string& column) {
  if (column.empty()) return std::nullopt;
  return table.column(column);
}

/// Reads stamps from rows.
struct StampReader {
  const CsvTable& table;
  const StampForm& form;
  std::optional<std::size_t> column;

  StampReader(const CsvTable& from, const StampForm& how)
      : table(from), form(how), column(place_of(from, how.column)) {}

  [[nodiscard]] Time read(const CsvRow& row, std::size_t index) const {
    if (!column) return time_from_seconds(static_cast<double>(index) * form.rows_apart_s);
    if (!form.iso) return in_units(row);
    const std::optional<Time> stamp = parse_iso(row.fields[*column]);
    if (stamp) return *stamp;
    fail({table.file, row.line},
         fmt::format("{} is '{}', expected a date as 2024-05-01T12:30:00.25", form.column,
                     row.fields[*column]));
  }

 private:
  [[nodiscard]] Time in_units(const CsvRow& row) const {
    if (form.seconds == 1.0) return table.stamp(row, *column);
    const double seconds = table.number(row, *column) * form.seconds;
    try {
      return time_from_seconds(seconds);
    } catch (const Error&) {
      fail({table.file, row.line}, fmt::format("{} is '{}', which is not a time in this unit",
                                               form.column, row.fields[*column]));
    }
  }
};

/// Reads antenna names from rows.
struct AntennaReader {
  const CsvTable& table;
  const AntennaForm& form;
  std::optional<std::size_t> column;

  AntennaReader(const CsvTable& from, const AntennaForm& how)
      : table(from), form(how), column(place_of(from, how.column)) {}

  [[nodiscard]] std::string read(const CsvRow& row) const {
    return column ? table.text(row, *column) : form.name;
  }
};

/// Reads positions from rows.
struct PositionReader {
  const CsvTable& table;
  const PositionForm& form;
  std::array<std::optional<std::size_t>, 3> columns;

  PositionReader(const CsvTable& from, const PositionForm& how) : table(from), form(how) {
    for (std::size_t i = 0; i < 3; ++i) columns[i] = place_of(from, how.columns[i]);
  }

  [[nodiscard]] Eigen::Vector3d read(const CsvRow& row) const {
    Eigen::Vector3d place(0.0, 0.0, form.z_m);
    for (std::size_t i = 0; i < 3; ++i) {
      if (columns[i]) {
        place[static_cast<Eigen::Index>(i)] = table.length(row, *columns[i], form.metres);
      }
    }
    return place;
  }
};

/// Reads carriers from rows.
struct FrequencyReader {
  const CsvTable& table;
  const FrequencyForm& form;
  std::optional<std::size_t> column;

  FrequencyReader(const CsvTable& from, const FrequencyForm& how)
      : table(from), form(how), column(place_of(from, how.column)) {}

  [[nodiscard]] double read(const CsvRow& row) const {
    if (!column) return form.hertz;
    const double value = table.number(row, *column);
    return form.channels_hz.empty() ? carrier(row, value) : channel(row, value);
  }

 private:
  [[nodiscard]] double carrier(const CsvRow& row, double value) const {
    const double hertz = form.hertz * value;
    if (is_carrier(hertz)) return hertz;
    fail({table.file, row.line},
         fmt::format("{} is '{}', which is {:g} Hz, expected {:g} to {:g}: is the unit right?",
                     form.column, row.fields[*column], hertz, kMinCarrierHz, kMaxCarrierHz));
  }
  [[nodiscard]] double channel(const CsvRow& row, double value) const {
    const double last = form.first_channel + static_cast<double>(form.channels_hz.size()) - 1.0;
    if (value == std::floor(value) && value >= form.first_channel && value <= last) {
      return form.channels_hz[static_cast<std::size_t>(value - form.first_channel)];
    }
    fail({table.file, row.line},
         fmt::format("{} is '{}', expected a channel from {} to {:g}", form.column,
                     row.fields[*column], form.first_channel, last));
  }
};

std::string without_spaces(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return text;
}

/// Poses without duplicates of stamp and antenna.
class PoseList {
 public:
  void add(Time stamp, const std::string& antenna, const Eigen::Vector3d& place) {
    if (seen_.insert({antenna, stamp}).second) {
      poses_.push_back({stamp, antenna, from_translation(place)});
    }
  }
  [[nodiscard]] std::vector<AntennaPose> take() { return std::move(poses_); }

 private:
  std::set<std::pair<std::string, Time>> seen_;
  std::vector<AntennaPose> poses_;
};

/// A dataset while its tables are being read.
struct Gathered {
  std::vector<TagRead> reads;
  PoseList poses;
};

void add_table(const std::string& path, const DatasetForm& form, Gathered& all) {
  const CsvTable table = read_csv(path, form.csv);
  const StampReader stamp(table, form.stamp);
  const AntennaReader antenna(table, form.antenna);
  const FrequencyReader frequency(table, form.frequency);
  const std::size_t tag = table.column(form.tag_column);
  const std::optional<std::size_t> phase = place_of(table, form.phase.column);
  const std::optional<std::size_t> rssi = place_of(table, form.rssi_column);
  std::optional<PositionReader> position;
  if (form.position) position.emplace(table, *form.position);
  const double turn = form.phase.falls ? -form.phase.radians : form.phase.radians;
  for (const CsvRow& row : table.rows) {
    TagRead read;
    read.stamp = stamp.read(row, all.reads.size());
    read.antenna = antenna.read(row);
    read.tag = without_spaces(table.text(row, tag));
    read.frequency_hz = frequency.read(row);
    if (phase) read.phase_rad = wrap_to_two_pi(turn * table.number(row, *phase));
    read.rssi_dbm = rssi ? form.decibels * table.number(row, *rssi) : kUnknownRssi;
    if (!is_rssi(read.rssi_dbm)) {
      fail({table.file, row.line},
           fmt::format("{} is {} dBm, expected {} to {}: which unit is it in?", form.rssi_column,
                       read.rssi_dbm, -kMaxRssiDbm, kMaxRssiDbm));
    }
    if (position) all.poses.add(read.stamp, read.antenna, position->read(row));
    all.reads.push_back(std::move(read));
  }
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// End of the number that begins at `at`.
std::size_t digits_end(const std::string& text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// Whether `a` sorts before `b`, comparing numbers in them by value: "9.csv" before "10.csv".
bool in_natural_order(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const std::size_t end_a = digits_end(a, i);
    const std::size_t end_b = digits_end(b, j);
    const std::size_t first_a = std::min(a.find_first_not_of('0', i), end_a);
    const std::size_t first_b = std::min(b.find_first_not_of('0', j), end_b);
    if (end_a - first_a != end_b - first_b) return end_a - first_a < end_b - first_b;
    const int order = a.compare(first_a, end_a - first_a, b, first_b, end_b - first_b);
    if (order != 0) return order < 0;
    i = end_a;
    j = end_b;
  }
  return i == a.size() && j < b.size();
}

/// The file itself, or the tables of a folder.
std::vector<std::string> tables_of(const std::string& path) {
  namespace fs = std::filesystem;
  if (!is_folder(path)) return {path};
  std::vector<std::string> names;
  for (const fs::path& entry : entries_of(path)) {
    if (entry.extension() == ".csv") names.push_back(entry.filename().string());
  }
  if (names.empty()) fail({path, 0}, "is a folder without tables, expected *.csv in it");
  std::sort(names.begin(), names.end());
  std::stable_sort(names.begin(), names.end(), in_natural_order);
  for (std::string& name : names) name = (fs::path(path) / name).string();
  return names;
}

}  // namespace

Dataset read_dataset_csv(const std::string& path, const DatasetForm& form) {
  Gathered all;
  for (const std::string& table : tables_of(path)) add_table(table, form, all);
  for (const auto& [name, place] : form.antennas) all.poses.add(Time{}, name, place);
  return {std::move(all.reads), all.poses.take()};
}

std::vector<AntennaPose> read_dataset_poses_csv(const std::string& path,
                                                const PoseTableForm& form) {
  const CsvTable table = read_csv(path, form.csv);
  const StampReader stamp(table, form.stamp);
  const AntennaReader antenna(table, form.antenna);
  const PositionReader position(table, form.position);
  PoseList poses;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const CsvRow& row = table.rows[i];
    poses.add(stamp.read(row, i), antenna.read(row), position.read(row));
  }
  return poses.take();
}

}  // namespace tagfield
