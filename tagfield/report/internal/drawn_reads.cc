// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/drawn_reads.h"

#include <filesystem>
#include <map>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "tagfield/files/reads_csv.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

/// Minimum length of a read's row [bytes].
constexpr std::size_t kMinRow = 12;

/// A read's row in the table, and its stamp.
struct StampedRow {
  std::size_t row = 0;
  Time stamp;
};

/// A tag's first and last read.
struct Ends {
  StampedRow first, last;
};

/// The results of the first pass over a table.
struct Contents {
  std::map<std::string, std::unordered_map<std::string, std::size_t>> counts;  ///< Antenna, tag.
  std::unordered_map<std::string, Ends> ends;                                  ///< By tag.
};

void add(const TagRead& read, std::size_t row, Contents& contents) {
  ++contents.counts[read.antenna][read.tag];
  const StampedRow here{row, read.stamp};
  Ends& ends = contents.ends.try_emplace(read.tag, Ends{here, here}).first->second;
  if (here.stamp < ends.first.stamp) ends.first = here;
  if (here.stamp >= ends.last.stamp) ends.last = here;
}

/// By antenna, the tag that it reads most often; ties go to the first in natural order.
std::map<std::string, std::string> busiest_tags(const Contents& contents) {
  std::map<std::string, std::string> tags;
  for (const auto& [antenna, counts] : contents.counts) {
    const std::pair<const std::string, std::size_t>* busiest = nullptr;
    for (const auto& one : counts) {
      const bool is_more =
          busiest == nullptr || one.second > busiest->second ||
          (one.second == busiest->second && natural_less(one.first, busiest->first));
      if (is_more) busiest = &one;
    }
    tags[antenna] = busiest->first;
  }
  return tags;
}

/// Selects reads in the second pass over the table.
class Choice {
 public:
  Choice(const Contents& contents, std::size_t rows, std::size_t most)
      : contents_(contents),
        busiest_(busiest_tags(contents)),
        whole_left_(most / 2),
        with_ends_(contents.ends.size() <= most / 8),
        every_(rows / (most / 4 + 1) + 1) {}

  bool takes(const TagRead& read, std::size_t row) {
    if (row % every_ == 0 || is_end(read, row)) return true;
    if (whole_left_ == 0 || busiest_.at(read.antenna) != read.tag) return false;
    --whole_left_;
    return true;
  }

 private:
  [[nodiscard]] bool is_end(const TagRead& read, std::size_t row) const {
    if (!with_ends_) return false;
    const Ends& ends = contents_.ends.at(read.tag);
    return row == ends.first.row || row == ends.last.row;
  }

  const Contents& contents_;
  std::map<std::string, std::string> busiest_;
  std::size_t whole_left_;  ///< Reads of busiest tags that may still be taken.
  bool with_ends_;
  std::size_t every_;
};

}  // namespace

DrawnReads read_drawn(const std::string& path, std::size_t most) {
  DrawnReads drawn;
  std::error_code unknown;  // If it is not a regular file, rows are counted.
  if (std::filesystem::file_size(path, unknown) <= most * kMinRow && !unknown) {
    drawn.reads = read_reads_csv(path);
    drawn.of = drawn.reads.size();
    return drawn;
  }
  Contents contents;
  for_each_read(path, [&](TagRead read) {
    add(read, drawn.of, contents);
    ++drawn.of;
    if (drawn.of <= most) drawn.reads.push_back(std::move(read));
    if (drawn.of == most + 1) drawn.reads = {};
  });
  if (drawn.of <= most) return drawn;
  Choice choice(contents, drawn.of, most);
  std::size_t row = 0;
  for_each_read(path, [&](TagRead read) {
    if (choice.takes(read, row)) drawn.reads.push_back(std::move(read));
    ++row;
  });
  return drawn;
}

}  // namespace tagfield
