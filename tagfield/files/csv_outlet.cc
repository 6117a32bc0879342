// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/csv_outlet.h"

#include <fmt/format.h>

#include "tagfield/base/error.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/truth_csv.h"

namespace tagfield {
namespace {

std::shared_ptr<GrowingFile> grown(StagedFolder& folder, const char* name,
                                   const std::string& header) {
  std::shared_ptr<GrowingFile> file = folder.grow(name);
  file->text() += header;
  return file;
}

template <class... Row>
void add(GrowingFile& file, const Row&... row) {
  append_row(row..., file.text());
  file.sync();
}

}  // namespace

CsvOutlet::CsvOutlet(StagedFolder& folder)
    : reads_(folder.grow("reads.csv")),
      poses_(grown(folder, "antenna_poses.csv", poses_header("antenna", false))),
      antennas_(grown(folder, "truth/antenna_poses.csv", poses_header("antenna", false))),
      robots_(grown(folder, "truth/robot_poses.csv", poses_header("robot", false))),
      tags_(grown(folder, "truth/tags.csv", kTagsHeader)),
      distances_(grown(folder, kDistancesFile, kDistancesHeader)) {}

CsvOutlet::~CsvOutlet() { begin_reads(); }

void CsvOutlet::begin_reads() {
  if (!has_begun_) reads_->text() += reads_header(has_doppler_);
  has_begun_ = true;
}

void CsvOutlet::on_read(const TagRead& read) {
  begin_reads();
  add(*reads_, read, has_doppler_);
}

void CsvOutlet::on_update(const AntennaInfo& /*antenna*/, Time /*stamp*/) { begin_reads(); }

void CsvOutlet::on_antenna_added(const AntennaInfo& antenna) {
  if (has_begun_ && antenna.reports_doppler && !has_doppler_) {
    throw Error(
        fmt::format("reads.csv: antenna '{}' reports Doppler, but comes after reads that were "
                    "written without it",
                    antenna.name));
  }
  has_doppler_ = has_doppler_ || antenna.reports_doppler;
}

void CsvOutlet::on_antenna_removed(const std::string& name) {
  believed_.forget(name);
  placed_.forget(name);
}

void CsvOutlet::on_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  if (believed_.is_new(antenna)) add(*poses_, pose, false);
}

void CsvOutlet::on_tag_added(const TagPosition& tag, const std::string& /*label*/) {
  add(*tags_, tag);
}

void CsvOutlet::on_tag_moved(const TagPosition& tag) { add(*tags_, tag); }
void CsvOutlet::on_robot_pose(const AntennaPose& robot) { add(*robots_, robot, false); }

void CsvOutlet::on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  if (placed_.is_new(antenna)) add(*antennas_, pose, false);
}

void CsvOutlet::on_distance(const TrueDistance& distance) { add(*distances_, distance); }

}  // namespace tagfield
