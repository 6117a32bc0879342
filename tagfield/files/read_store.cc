// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/read_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

constexpr std::size_t kRecordsInMemory = 256;

[[noreturn]] void fail_at(const std::filesystem::path& folder, const char* what) {
  fail({folder.string(), 0}, fmt::format("reads that don't fit in memory can't be {} there: {}",
                                         what, std::strerror(errno)));
}

/// A file without a name, visible only to this program.
int unnamed_file(const std::filesystem::path& folder) {
  std::string name = (folder / ".tagfield-reads-XXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) fail_at(folder, "kept");
  (void)::unlink(name.c_str());
  return file;
}

}  // namespace

struct ReadStore::Record {
  std::int64_t stamp_ns;
  double frequency_hz, phase_rad, rssi_dbm, doppler_hz;
  std::uint32_t tag, antenna, reader, has_doppler;
};

struct ReadStore::PartFile {
  explicit PartFile(int opened) : file(opened) { recent.reserve(kRecordsInMemory); }
  ~PartFile() { (void)::close(file); }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  int file;
  std::size_t written = 0;  ///< Records.
  std::vector<Record> recent;
};

/// Mapping of names to numbers and back.
class ReadStore::Names {
 public:
  std::uint32_t number(const std::string& name) {
    const auto [entry, is_new] =
        numbers_.try_emplace(name, static_cast<std::uint32_t>(numbers_.size()));
    if (is_new) names_.push_back(&entry->first);
    return entry->second;
  }
  [[nodiscard]] const std::string& name(std::uint32_t number) const { return *names_[number]; }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::vector<const std::string*> names_;
};

PartPlan plan_parts(const ReadOverview& overview, std::size_t reads_of_part,
                    const std::set<std::string>& everywhere) {
  const std::size_t most = std::max(reads_of_part, overview.count / kMaxParts + 1);
  PartPlan plan;
  std::size_t in_part = 0;
  for (const std::string& tag : overview.tags) {
    if (everywhere.count(tag) > 0) continue;
    const std::size_t reads = overview.count_by_tag.at(tag);
    if (in_part > 0 && in_part + reads > most && plan.count < kMaxParts) {
      ++plan.count;
      in_part = 0;
    }
    in_part += reads;
    plan.part[tag] = plan.count - 1;
  }
  return plan;
}

ReadStore::ReadStore(std::filesystem::path folder, PartPlan plan)
    : folder_(std::move(folder)),
      plan_(std::move(plan)),
      tags_(std::make_unique<Names>()),
      antennas_(std::make_unique<Names>()),
      readers_(std::make_unique<Names>()) {
  for (std::size_t i = 0; i <= plan_.count; ++i) {
    files_.push_back(std::make_unique<PartFile>(unnamed_file(folder_)));
  }
}

ReadStore::~ReadStore() = default;

std::size_t ReadStore::parts() const { return plan_.count; }

void ReadStore::add(const TagRead& read) {
  const auto planned = plan_.part.find(read.tag);
  PartFile& file = *files_[planned == plan_.part.end() ? plan_.count : planned->second];
  file.recent.push_back({read.stamp.time_since_epoch().count(), read.frequency_hz, read.phase_rad,
                         read.rssi_dbm, read.doppler_hz.value_or(0.0), tags_->number(read.tag),
                         antennas_->number(read.antenna), readers_->number(read.reader),
                         read.doppler_hz ? 1U : 0U});
  if (file.recent.size() == kRecordsInMemory) flush(file);
}

void ReadStore::flush(PartFile& file) const {
  const char* from = reinterpret_cast<const char*>(file.recent.data());
  std::size_t left = file.recent.size() * sizeof(Record);
  while (left > 0) {
    const ssize_t count = ::write(file.file, from, left);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_at(folder_, "kept");
    from += count;
    left -= static_cast<std::size_t>(count);
  }
  file.written += file.recent.size();
  file.recent.clear();
}

std::vector<TagRead> ReadStore::part(std::size_t index, std::size_t most_of_a_tag) {
  std::vector<TagRead> reads;
  append(*files_[plan_.count], most_of_a_tag, reads);
  append(*files_[index], most_of_a_tag, reads);
  return reads;
}

void ReadStore::for_each(PartFile& file, const std::function<void(const Record&)>& take) const {
  flush(file);
  std::vector<Record> block(kRecordsInMemory);
  for (std::size_t at = 0; at < file.written; at += block.size()) {
    const std::size_t count = std::min(block.size(), file.written - at);
    char* const to = reinterpret_cast<char*>(block.data());
    std::size_t done = 0;
    while (done < count * sizeof(Record)) {
      const ssize_t got = ::pread(file.file, to + done, count * sizeof(Record) - done,
                                  static_cast<off_t>(at * sizeof(Record) + done));
      if (got < 0 && errno == EINTR) continue;
      if (got == 0) errno = EIO;
      if (got <= 0) fail_at(folder_, "read back");
      done += static_cast<std::size_t>(got);
    }
    for (std::size_t i = 0; i < count; ++i) take(block[i]);
  }
}

TagRead ReadStore::read_of(const Record& record) const {
  TagRead read{Time(Duration(record.stamp_ns)),
               readers_->name(record.reader),
               antennas_->name(record.antenna),
               tags_->name(record.tag),
               record.frequency_hz,
               record.phase_rad,
               record.rssi_dbm,
               std::nullopt};
  if (record.has_doppler != 0U) read.doppler_hz = record.doppler_hz;
  return read;
}

void ReadStore::append(PartFile& file, std::size_t most_of_a_tag, std::vector<TagRead>& reads) {
  struct Share {
    std::size_t count = 0;
    std::size_t every = 1;
    std::size_t seen = 0;
  };
  std::unordered_map<std::uint32_t, Share> shares;
  for_each(file, [&](const Record& record) { ++shares[record.tag].count; });
  std::size_t kept = reads.size();
  for (auto& [tag, share] : shares) {
    share.every = (share.count + most_of_a_tag - 1) / most_of_a_tag;
    kept += (share.count + share.every - 1) / share.every;
  }
  reads.reserve(kept);
  for_each(file, [&](const Record& record) {
    Share& share = shares[record.tag];
    if (share.seen++ % share.every == 0) reads.push_back(read_of(record));
  });
}

}  // namespace tagfield
