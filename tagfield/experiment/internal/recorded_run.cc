// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/recorded_run.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "tagfield/base/file_kind.h"
#include "tagfield/files/csv.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

/// Maximum deviation of antennas from a line for a tag's distance from it to be defined [m].
constexpr double kLineWidth_m = 0.02;

/// Mean of the antennas' heights [m].
double mean_height(const std::vector<AntennaPose>& poses) {
  double sum = 0.0;
  for (const AntennaPose& pose : poses) sum += pose.X_WA.translation.z();
  return poses.empty() ? 0.0 : sum / static_cast<double>(poses.size());
}

/// Which coordinate `range_m` stands for, and in which direction it grows.
struct Away {
  Eigen::Index axis = 1;
  double sign = 1.0;
};

Away away_of(const SuiteRecording& recording) {
  if (recording.area.side) {
    switch (*recording.area.side) {
      case TagSide::kPlusX:
        return {0, 1.0};
      case TagSide::kMinusX:
        return {0, -1.0};
      case TagSide::kPlusY:
        return {1, 1.0};
      case TagSide::kMinusY:
        return {1, -1.0};
      default:
        break;
    }
  }
  throw Error(
      recording.truth +
      ": range_m is a distance from the antennas' path, so it needs side: +x, -x, +y or -y");
}

/// Coordinate of the antennas' path on that axis [m].
double line_of(const SuiteRecording& recording, const std::vector<AntennaPose>& poses,
               Eigen::Index axis) {
  double sum = 0.0;
  for (const AntennaPose& pose : poses) sum += pose.X_WA.translation[axis];
  const double line = poses.empty() ? 0.0 : sum / static_cast<double>(poses.size());
  for (const AntennaPose& pose : poses) {
    const double off = std::abs(pose.X_WA.translation[axis] - line);
    if (off <= kLineWidth_m) continue;
    throw Error(
        fmt::format("{}: range_m is a distance from a straight path, but the antennas are up to "
                    "{:.2f} m off it",
                    recording.truth, off));
  }
  return line;
}

/// Reads positions from the rows of a table in either of its two formats.
class PlaceColumns {
 public:
  PlaceColumns(const CsvTable& table, const SuiteRecording& recording,
               const std::vector<AntennaPose>& poses, double height_m)
      : table_(table), height_m_(height_m) {
    if (table.has_column("z_m")) z_ = table.column("z_m");
    if (!table.has_column("range_m")) {
      columns_ = {table.column("x_m"), table.column("y_m")};
      return;
    }
    away_ = away_of(recording);
    line_m_ = line_of(recording, poses, away_->axis);
    columns_[0] = table.column(away_->axis == 1 ? "x_m" : "range_m");
    columns_[1] = table.column(away_->axis == 1 ? "range_m" : "y_m");
  }

  [[nodiscard]] Eigen::Vector3d read(const CsvRow& row) const {
    Eigen::Vector3d place(table_.length(row, columns_[0]), table_.length(row, columns_[1]),
                          z_ ? table_.length(row, *z_) : height_m_);
    if (away_) place[away_->axis] = line_m_ + away_->sign * place[away_->axis];
    return place;
  }

 private:
  const CsvTable& table_;
  double height_m_;
  std::array<std::size_t, 2> columns_{};
  std::optional<std::size_t> z_;
  std::optional<Away> away_;
  double line_m_ = 0.0;
};

void warn_of_strangers(const SuiteRecording& recording, const Recording& run,
                       Diagnostics& diagnostics) {
  std::set<std::string> known;
  for (const TagPosition& tag : run.truth.tag_positions) known.insert(tag.tag);
  std::set<std::string> strangers;
  for (const TagRead& read : run.reads) {
    if (known.count(read.tag) == 0) strangers.insert(read.tag);
  }
  if (strangers.empty()) return;
  diagnostics.warn(
      {recording.truth, 0},
      fmt::format("lacks the positions of {} in the reads (such as '{}'), which do not count",
                  counted(strangers.size(), "tag"), *strangers.begin()));
}

}  // namespace

std::optional<std::string> missing_file(const SuiteRecording& recording) {
  for (const std::string& path :
       {recording.reads, recording.poses, recording.truth, recording.heights}) {
    if (!path.empty() && !is_there(path)) return path;
  }
  return std::nullopt;
}

std::map<std::string, Eigen::Vector3d> read_tag_truth(const SuiteRecording& recording,
                                                      const std::vector<AntennaPose>& poses,
                                                      double height_m) {
  const CsvTable table = read_csv(recording.truth);
  const std::size_t tag = table.column("tag");
  std::optional<std::size_t> experiment;
  if (!recording.experiment.empty()) experiment = table.column("experiment");
  const PlaceColumns columns(table, recording, poses, height_m);
  std::map<std::string, Eigen::Vector3d> places;
  for (const CsvRow& row : table.rows) {
    if (experiment && row.fields[*experiment] != recording.experiment) continue;
    if (!places.emplace(table.text(row, tag), columns.read(row)).second) {
      fail({recording.truth, row.line}, fmt::format("tag '{}' is listed twice", row.fields[tag]));
    }
  }
  if (!places.empty()) return places;
  throw Error(recording.experiment.empty() ? fmt::format("{}: has no tags", recording.truth)
                                           : fmt::format("{}: has no tags of the experiment '{}'",
                                                         recording.truth, recording.experiment));
}

KnownBeforehand known_of(const SuiteRecording& recording, const StatedPoseError& believed) {
  KnownBeforehand known;
  known.heights.of_all = recording.tag_height_m;
  if (!recording.heights.empty()) known.heights.of_tag = read_tag_heights_csv(recording.heights);
  known.area = recording.area;
  if (const auto* stated = std::get_if<PoseErrorModel>(&believed)) known.pose_error = *stated;
  return known;
}

Recording load_recording(const SuiteRecording& recording, const ReadRecording& read,
                         Diagnostics& diagnostics) {
  if (!read) throw Error("recordings are not read here");
  RecordedReads tables = read(recording);
  Recording run;
  run.reads = std::move(tables.reads);
  run.believed_poses = std::move(tables.poses);
  const double height_m = recording.tag_height_m.value_or(mean_height(run.believed_poses));
  const Time begin = run.reads.empty() ? Time{} : run.reads.front().stamp;
  for (const auto& [tag, p_WT] : read_tag_truth(recording, run.believed_poses, height_m)) {
    run.truth.tag_positions.push_back({begin, tag, p_WT});
  }
  warn_of_strangers(recording, run, diagnostics);
  return run;
}

}  // namespace tagfield
