#include "tagfield/files/csv.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tagfield/base/number.h"
#include "tagfield/base/range_check.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

/// What libcsv's callbacks fill.
struct Filling {
  CsvTable* table = nullptr;
  bool header = true;  ///< Whether the table has one.
  int line = 1;
  std::vector<std::string> fields;
  std::string problem;
};

void finish_header(Filling& filling) { filling.table->header = std::move(filling.fields); }

void number_columns(Filling& filling) {
  for (std::size_t i = 1; i <= filling.fields.size(); ++i) {
    filling.table->header.push_back(std::to_string(i));
  }
}

void finish_row(Filling& filling) {
  CsvTable& table = *filling.table;
  if (filling.fields.size() != table.header.size()) {
    filling.problem = fmt::format("{} fields where the {} has {}", filling.fields.size(),
                                  filling.header ? "header" : "first line", table.header.size());
    return;
  }
  table.rows.push_back({filling.line, std::move(filling.fields)});
}

void on_field(void* bytes, std::size_t size, void* user) {
  auto& filling = *static_cast<Filling*>(user);
  filling.fields.emplace_back(size == 0 ? "" : static_cast<const char*>(bytes), size);
}

void on_row(int /*terminator*/, void* user) {
  auto& filling = *static_cast<Filling*>(user);
  if (!filling.problem.empty()) return;
  if (!filling.fields.empty()) {
    const bool first = filling.table->header.empty();
    if (first && filling.header) {
      finish_header(filling);
    } else {
      if (first) number_columns(filling);
      finish_row(filling);
    }
  }
  filling.fields.clear();
}

/// Parses line by line, so that a complaint knows its line.
void parse_lines(const std::string& text, csv_parser& parser, Filling& filling) {
  std::size_t begin = 0;
  int lines_seen = 0;
  while (begin < text.size() && filling.problem.empty()) {
    const std::size_t newline = text.find('\n', begin);
    const std::size_t end = newline == std::string::npos ? text.size() : newline + 1;
    filling.line = ++lines_seen;
    if (csv_parse(&parser, text.data() + begin, end - begin, on_field, on_row, &filling) !=
        end - begin) {
      filling.problem = csv_strerror(csv_error(&parser));
    }
    begin = end;
  }
  if (filling.problem.empty() && csv_fini(&parser, on_field, on_row, &filling) != 0) {
    filling.problem = "a quoted field without an end";
  }
}

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
  if (std::abs(value) > kMostCoordinate_m) {
    fail({file, row.line}, fmt::format("{} is {:g} m, expected a place within ±{:g} m",
                                       header[column], value, kMostCoordinate_m));
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

CsvTable read_csv(const std::string& path, const CsvForm& form) {
  std::string text = read_text_file(path);
  // A byte order mark is a spreadsheet's way to say UTF-8.
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
  CsvTable table;
  table.file = path;
  if (text.find('\0') != std::string::npos) fail({path, 0}, "is not a text file");
  csv_parser parser{};
  if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) != 0) {
    throw Error("can't start the CSV reader");
  }
  const std::unique_ptr<csv_parser, void (*)(csv_parser*)> guard(&parser, csv_free);
  csv_set_delim(&parser, static_cast<unsigned char>(form.delimiter));
  Filling filling{&table, form.header, 1, {}, ""};
  parse_lines(text, parser, filling);
  if (!filling.problem.empty()) fail({path, filling.line}, filling.problem);
  if (table.header.empty()) {
    fail({path, 0}, form.header ? "is empty, expected a table with a header line" : "is empty");
  }
  return table;
}

std::string csv_field(std::string_view text) {
  // Spaces at the ends of a bare field are dropped by many readers, this one among them.
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
