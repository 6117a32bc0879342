// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/csv.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>

#include "tagfield/base/number.h"
#include "tagfield/base/range_check.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxRowBytes = 1'000'000;  // A row is buffered until it is complete.

/// State filled by libcsv's callbacks.
struct Filling {
  CsvTable table;  ///< Without rows.
  const std::function<void(const CsvTable&)>& begin;
  const std::function<void(const CsvRow&)>& take;
  bool header = true;       ///< Whether the table has one.
  int lines_seen = 0;       ///< The last one may continue in the next block.
  bool in_line = false;     ///< Whether it continues.
  std::size_t unended = 0;  ///< Bytes of an incomplete row.
  CsvRow row;               ///< Its fields are reused.
  std::size_t count = 0;    ///< Number of filled fields.
  std::string problem;
  std::exception_ptr thrown;  ///< By `begin` or `take`: kept out of libcsv, which is C.
};

void take_header(Filling& filling) {
  CsvTable& table = filling.table;
  for (std::size_t i = 0; i < filling.count; ++i) {
    table.header.push_back(filling.header ? filling.row.fields[i] : std::to_string(i + 1));
  }
  filling.begin(table);
}

void take_row(Filling& filling) {
  const std::size_t columns = filling.table.header.size();
  if (filling.count != columns) {
    filling.problem = fmt::format("{} fields where the {} has {}", filling.count,
                                  filling.header ? "header" : "first line", columns);
    return;
  }
  filling.row.line = filling.lines_seen;
  filling.row.fields.resize(columns);
  filling.take(filling.row);
}

void on_field(void* bytes, std::size_t size, void* user) {
  auto& filling = *static_cast<Filling*>(user);
  std::vector<std::string>& fields = filling.row.fields;
  if (filling.count == fields.size()) fields.emplace_back();
  fields[filling.count++].assign(size == 0 ? "" : static_cast<const char*>(bytes), size);
}

void on_row(int /*terminator*/, void* user) {
  auto& filling = *static_cast<Filling*>(user);
  filling.unended = 0;
  if (!filling.problem.empty() || filling.thrown) return;
  try {
    const bool first = filling.table.header.empty();
    if (filling.count > 0 && first) take_header(filling);
    if (filling.count > 0 && (!first || !filling.header)) take_row(filling);
  } catch (...) {
    filling.thrown = std::current_exception();
  }
  filling.count = 0;
}

void require_no_problem(const Filling& filling) {
  if (filling.thrown) std::rethrow_exception(filling.thrown);
  if (!filling.problem.empty()) {
    fail({filling.table.file, filling.lines_seen}, filling.problem);
  }
}

/// Parses line by line, so that error messages can state the line.
void parse(std::string_view text, csv_parser& parser, Filling& filling) {
  if (text.find('\0') != std::string_view::npos) {
    fail({filling.table.file, 0}, "is not a text file");
  }
  while (!text.empty()) {
    const std::size_t newline = text.find('\n');
    const std::string_view line =
        text.substr(0, newline == std::string_view::npos ? newline : newline + 1);
    if (!filling.in_line) ++filling.lines_seen;
    filling.in_line = newline == std::string_view::npos;
    filling.unended += line.size();
    if (filling.unended > kMaxRowBytes) {
      filling.problem = fmt::format("a row of over {} bytes", kMaxRowBytes);
    } else if (csv_parse(&parser, line.data(), line.size(), on_field, on_row, &filling) !=
               line.size()) {
      filling.problem = csv_strerror(csv_error(&parser));
    }
    require_no_problem(filling);
    text.remove_prefix(line.size());
  }
}

void finish(csv_parser& parser, Filling& filling) {
  if (csv_fini(&parser, on_field, on_row, &filling) != 0) {
    filling.problem = "a quoted field without an end";
  }
  require_no_problem(filling);
}

/// Removes a byte order mark, with which spreadsheets mark UTF-8, wherever block boundaries are.
class WithoutMark {
 public:
  std::string_view operator()(std::string_view block) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    if (is_past_) return block;
    begin_ += block;
    if (begin_.size() < kMark.size()) return {};
    is_past_ = true;
    return std::string_view(begin_).substr(begin_.rfind(kMark, 0) == 0 ? kMark.size() : 0);
  }
  /// Contents of a file that is shorter than the mark.
  [[nodiscard]] std::string_view rest() const { return is_past_ ? std::string_view() : begin_; }

 private:
  bool is_past_ = false;
  std::string begin_;
};

}  // namespace

std::size_t CsvTable::column(std::string_view name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) {
    fail({file, 1},
         fmt::format("no column '{}'; the columns are {}", name, fmt::join(header, ",")));
  }
  if (std::count(header.begin(), header.end(), name) > 1) {
    fail({file, 1}, fmt::format("has the column '{}' twice", name));
  }
  return static_cast<std::size_t>(found - header.begin());
}

bool CsvTable::has_column(std::string_view name) const {
  return std::find(header.begin(), header.end(), name) != header.end();
}

double CsvTable::number(const CsvRow& row, std::size_t column) const {
  const std::string& field = row.fields[column];
  const std::optional<double> value = parse_number(field);
  if (!value) {
    fail({file, row.line},
         fmt::format("{} is '{}', expected a finite number", header[column], field));
  }
  return *value;
}

std::array<std::size_t, 3> CsvTable::position_columns() const {
  return {column("x_m"), column("y_m"), column("z_m")};
}

Eigen::Vector3d CsvTable::position(const CsvRow& row,
                                   const std::array<std::size_t, 3>& columns) const {
  return {length(row, columns[0]), length(row, columns[1]), length(row, columns[2])};
}

double CsvTable::length(const CsvRow& row, std::size_t column, double metres) const {
  const double value = metres * number(row, column);
  if (std::abs(value) > kMaxCoordinate_m) {
    fail({file, row.line}, fmt::format("{} is {:g} m, expected a position within ±{:g} m",
                                       header[column], value, kMaxCoordinate_m));
  }
  return value;
}

Time CsvTable::stamp(const CsvRow& row, std::size_t column) const {
  try {
    return parse_stamp(row.fields[column]);
  } catch (const Error& error) {
    fail({file, row.line}, fmt::format("{}: {}", header[column], error.what()));
  }
}

const std::string& CsvTable::text(const CsvRow& row, std::size_t column) const {
  if (row.fields[column].empty()) {
    fail({file, row.line}, fmt::format("{} is empty", header[column]));
  }
  return row.fields[column];
}

void read_csv_rows(const std::string& path, const std::function<void(const CsvTable&)>& begin,
                   const std::function<void(const CsvRow&)>& take, const CsvForm& form,
                   const std::function<void(double)>& on_progress) {
  csv_parser parser{};
  if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) != 0) {
    throw Error("can't start the CSV reader");
  }
  const std::unique_ptr<csv_parser, void (*)(csv_parser*)> guard(&parser, csv_free);
  csv_set_delim(&parser, static_cast<unsigned char>(form.delimiter));
  Filling filling{{path, {}, {}}, begin, take, form.header, 0, false, 0, {}, 0, "", nullptr};
  WithoutMark without_mark;
  std::error_code no_size;
  const auto size = static_cast<double>(std::filesystem::file_size(path, no_size));
  std::size_t done = 0;
  try {
    read_in_blocks(path, [&](std::string_view block) {
      parse(without_mark(block), parser, filling);
      done += block.size();
      if (on_progress && !no_size) on_progress(static_cast<double>(done) / std::max(size, 1.0));
    });
    parse(without_mark.rest(), parser, filling);
    finish(parser, filling);
  } catch (const std::bad_alloc&) {
    fail({path, filling.lines_seen}, "more rows than there is memory for");
  }
  if (filling.table.header.empty()) {
    fail({path, 0}, form.header ? "is empty, expected a table with a header line" : "is empty");
  }
}

CsvTable read_csv(const std::string& path, const CsvForm& form) {
  CsvTable table;
  std::vector<CsvRow> rows;
  read_csv_rows(
      path, [&](const CsvTable& begun) { table = begun; },
      [&](const CsvRow& row) { rows.push_back(row); }, form);
  table.rows = std::move(rows);
  return table;
}

std::string csv_field(std::string_view text) {
  // Many readers, including this one, drop leading and trailing spaces of an unquoted field.
  const auto is_space = [](char character) { return character == ' ' || character == '\t'; };
  const bool bare = text.find_first_of(",\"\r\n") == std::string_view::npos &&
                    (text.empty() || (!is_space(text.front()) && !is_space(text.back())));
  if (bare) return std::string(text);
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

}  // namespace tagfield
