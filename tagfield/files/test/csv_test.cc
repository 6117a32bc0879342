// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "odd_names.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

using Fields = std::vector<std::string>;

CsvTable table_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_csv(folder.with("t.csv", text));
}

/// The error message for a file with this text, from its name on.
std::string complaint(const std::string& text) {
  const std::string message = error_of([&] { table_of(text); });
  const std::size_t name = message.find("t.csv");
  return name == std::string::npos ? message : message.substr(name);
}

TEST(ReadCsv, ReadsHeaderAndRows) {
  const CsvTable table = table_of("a,b\n1,2\n3,4\n");
  EXPECT_EQ(table.header, (Fields{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].fields, (Fields{"1", "2"}));
  EXPECT_EQ(table.rows[1].fields, (Fields{"3", "4"}));
  EXPECT_EQ(table.rows[1].line, 3);
}

TEST(ReadCsv, GivesPlacesWhateverTheOrderOfColumns) {
  const CsvTable table = table_of("z_m,a,x_m,y_m\n3,?,1,-2.5\n");
  EXPECT_EQ(table.position(table.rows.at(0), table.position_columns()),
            Eigen::Vector3d(1.0, -2.5, 3.0));
  EXPECT_TRUE(contains(error_of([] { (void)table_of("x_m,z_m\n").position_columns(); }), "'y_m'"));
}

TEST(ReadCsv, ReadsQuotedFields) {
  const CsvTable table = table_of("a,b,c\n\"x,y\",\"two\nlines\",\"say \"\"so\"\"\"\n");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].fields, (Fields{"x,y", "two\nlines", "say \"so\""}));
}

TEST(ReadCsv, TakesCrlf) {
  const CsvTable table = table_of("a,b\r\n1,\"2\r\n3\"\r\n4,5\r\n");
  EXPECT_EQ(table.header, (Fields{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].fields, (Fields{"1", "2\r\n3"}));
  EXPECT_EQ(table.rows[1].fields, (Fields{"4", "5"}));
  EXPECT_EQ(table.rows[1].line, 4);
}

TEST(ReadCsv, DropsAByteOrderMark) {
  EXPECT_EQ(table_of("\xEF\xBB\xBF"
                     "a,b\n1,2\n")
                .header,
            (Fields{"a", "b"}));
  EXPECT_EQ(table_of("\xEF\xBB\xBF"
                     "\"a\",\"b\"\n1,2\n")
                .header,
            (Fields{"a", "b"}));
}

TEST(ReadCsv, SkipsBlankLines) {
  const CsvTable table = table_of("\n\na,b\n\n1,2\n  \n\r\n3,4\n\n");
  EXPECT_EQ(table.header, (Fields{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].line, 5);
  EXPECT_EQ(table.rows[1].line, 8);
}

TEST(ReadCsv, NeedsNoLastNewline) {
  const CsvTable table = table_of("a,b\n1,2\n3,4");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[1].fields, (Fields{"3", "4"}));
  EXPECT_EQ(table.rows[1].line, 3);
}

TEST(ReadCsv, KeepsEmptyFields) {
  EXPECT_EQ(table_of("a,b,c\n,\"\",\n").rows.at(0).fields, (Fields{"", "", ""}));
}

TEST(ReadCsv, NamesTheLineOfARowOfAnotherLength) {
  EXPECT_EQ(complaint("a,b\n1,2\n1,2,3\n1\n"), "t.csv:3: 3 fields where the header has 2");
  EXPECT_EQ(complaint("a,b\n\n1\n"), "t.csv:3: 1 fields where the header has 2");
  EXPECT_EQ(complaint("a,b\n1"), "t.csv:2: 1 fields where the header has 2");
  EXPECT_EQ(complaint("a,b\n\"x\ny\",2\n1\n"), "t.csv:4: 1 fields where the header has 2");
}

TEST(ReadCsv, NamesTheLineOfABadQuote) {
  EXPECT_TRUE(contains(complaint("a,b\n1,2\nx\"y,2\n"), "t.csv:3: "));
  EXPECT_TRUE(contains(complaint("a,b\n\"x\"y,2\n"), "t.csv:2: "));
  EXPECT_TRUE(contains(complaint("a,b\n\"x,2\n"), "a quoted field without an end"));
}

TEST(ReadCsv, RefusesFilesThatAreNoTable) {
  EXPECT_EQ(complaint(""), "t.csv: is empty, expected a table with a header line");
  EXPECT_EQ(complaint("\n \r\n"), "t.csv: is empty, expected a table with a header line");
  EXPECT_EQ(complaint("\xEF\xBB\xBF"), "t.csv: is empty, expected a table with a header line");
  EXPECT_EQ(complaint(std::string("a,b\n1,\0\n", 8)), "t.csv: is not a text file");
}

/// An unclosed quote, or a file without line breaks, would be buffered to the end of the file.
TEST(ReadCsv, RefusesRowsThatDoNotEnd) {
  EXPECT_EQ(complaint("a,b\n1,2\n" + std::string(1'100'000, '3') + ",4\n"),
            "t.csv:3: a row of over 1000000 bytes");
  std::string open_quote = "a,b\n\"1";
  for (int i = 0; i < 200'000; ++i) open_quote += "2,3\n.";
  EXPECT_TRUE(contains(complaint(open_quote), "a row of over 1000000 bytes"));
  EXPECT_EQ(table_of("a\n" + std::string(900'000, '3') + "\n4\n").rows.size(), 2U);
}

TEST(ReadCsv, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  const std::string missing = folder.file("missing.csv");
  EXPECT_EQ(error_of([&] { read_csv(missing); }), missing + ": no such file");
  const std::string path = folder.path().string();
  EXPECT_EQ(error_of([&] { read_csv(path); }), path + ": is a folder, expected a file");
}

TEST(CsvTable, FindsColumnsInAnyOrder) {
  const CsvTable table = table_of("b,extra,a\n1,2,3\n");
  EXPECT_EQ(table.column("a"), 2u);
  EXPECT_EQ(table.column("b"), 0u);
  EXPECT_TRUE(table.has_column("extra"));
  EXPECT_FALSE(table.has_column("A"));
}

TEST(CsvTable, NamesTheColumnsWhenOneIsMissing) {
  const CsvTable table = table_of("tag,phase\n1,2\n");
  const std::string message = error_of([&] { (void)table.column("phase_rad"); });
  EXPECT_TRUE(contains(message, "t.csv:1: no column 'phase_rad'")) << message;
  EXPECT_TRUE(contains(message, "tag,phase")) << message;
}

TEST(CsvTable, RefusesAColumnThatStandsThereTwice) {
  const CsvTable table = table_of("tag,phase,tag\n1,2,3\n");
  EXPECT_TRUE(contains(error_of([&] { (void)table.column("tag"); }),
                       "t.csv:1: has the column 'tag' twice"));
  EXPECT_EQ(table.column("phase"), 1U);
}

TEST(CsvTable, ReadsNumbers) {
  const CsvTable table = table_of("n\n1.5\n+2\n-3e2\n 4 \n\"5\"\n");
  const std::vector<double> expected = {1.5, 2.0, -300.0, 4.0, 5.0};
  ASSERT_EQ(table.rows.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(table.number(table.rows[i], 0), expected[i]);
  }
}

TEST(CsvTable, RefusesWhatIsNoFiniteNumber) {
  for (const std::string bad : {"nan", "inf", "-inf", "NaN", "1e400", "abc", "\"\"", "1.2.3", "0x1",
                                "+-5", "--5", "5m", "\"1,5\"", "\" 5\""}) {
    const CsvTable table = table_of("m,n\n0,0\n0," + bad + "\n");
    const std::string message = error_of([&] { (void)table.number(table.rows[1], 1); });
    EXPECT_TRUE(contains(message, "t.csv:3: n is '")) << bad << ": " << message;
  }
}

TEST(CsvTable, ReadsStampsAndNamesBadOnes) {
  const CsvTable table = table_of("stamp_s\n1700000000.123456789\nsoon\n");
  EXPECT_EQ(table.stamp(table.rows[0], 0), Time(Duration(1'700'000'000'123'456'789)));
  const std::string message = error_of([&] { (void)table.stamp(table.rows[1], 0); });
  EXPECT_TRUE(contains(message, "t.csv:3: stamp_s: 'soon'")) << message;
}

TEST(CsvTable, WantsTextNotEmpty) {
  const CsvTable table = table_of("tag,x\nt1,1\n,2\n");
  EXPECT_EQ(table.text(table.rows[0], 0), "t1");
  EXPECT_TRUE(contains(error_of([&] { (void)table.text(table.rows[1], 0); }), ":3: tag is empty"));
}

TEST(CsvField, QuotesOnlyWhereItMust) {
  EXPECT_EQ(csv_field("plain name::1"), "plain name::1");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_field("a\rb"), "\"a\rb\"");
  EXPECT_EQ(csv_field(" a"), "\" a\"");
  EXPECT_EQ(csv_field("a\t"), "\"a\t\"");
}

RC_GTEST_PROP(CsvField, IsReadBackAsItWas, ()) {
  const std::string a = odd_name();
  const std::string b = odd_name();
  const CsvTable table =
      table_of(std::string("a,b\n") + csv_field(a) + "," + csv_field(b) + "\n1,2\n");
  RC_ASSERT(table.rows.size() == 2u);
  RC_ASSERT(table.rows[0].fields == (Fields{a, b}));
}

}  // namespace
}  // namespace tagfield
