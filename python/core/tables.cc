// SPDX-License-Identifier: Apache-2.0
#include "python/core/tables.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield::python {
namespace {

void put(const Eigen::Vector3d& from, double (&to)[3]) { std::copy_n(from.data(), 3, to); }

void put_unknown(double (&to)[3]) { std::fill_n(to, 3, kUnknown); }

void put(const std::optional<Eigen::Matrix3d>& from, double (&to)[3][3]) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) to[i][j] = from ? (*from)(i, j) : kUnknown;
  }
}

/// Reads of a user's own making. Phases come out in [0, 2π).
void require_sound(ReadRow& row, std::size_t number) {
  const auto refuse = [&](const char* what) {
    throw Error("reads: row " + std::to_string(number) + ": " + what);
  };
  if (!std::isfinite(row.phase_rad)) refuse("phase_rad is not finite");
  if (!std::isfinite(row.rssi_dbm)) refuse("rssi_dbm is not finite");
  if (!(std::isfinite(row.frequency_hz) && row.frequency_hz > 0.0)) {
    refuse("frequency_hz is not a number greater than 0");
  }
  row.phase_rad = wrap_to_two_pi(row.phase_rad);
}

Eigen::Vector3d vector_of(const double (&from)[3]) { return {from[0], from[1], from[2]}; }

RigidTransform transform_of(const PoseRow& row, std::size_t number) {
  const double* const q = row.quaternion_xyzw;
  const auto rotation = as_rotation(Eigen::Quaterniond(q[3], q[0], q[1], q[2]));
  if (!rotation) {
    throw Error("poses: row " + std::to_string(number) +
                ": quaternion_xyzw must be of length 1 (0.9 to 1.1 is accepted)");
  }
  RigidTransform transform{*rotation, vector_of(row.position_m)};
  if (!is_finite(transform)) {
    throw Error("poses: row " + std::to_string(number) + ": position_m is not finite");
  }
  return transform;
}

CandidateRow row_of(const Candidate& candidate, std::int32_t tag, std::size_t number) {
  auto row = CandidateRow();
  row.tag = tag;
  row.number = static_cast<std::int32_t>(number);
  put(candidate.p_WT, row.position_m);
  put(candidate.covariance, row.covariance_m2);
  row.expected_error_m = candidate.expected_error_m;
  row.rms_m = candidate.rms_m;
  return row;
}

EstimateRow row_of(const TagOutcome& outcome, Names& tags, Names& reasons) {
  const TagEstimate& estimate = outcome.estimate;
  auto row = EstimateRow();
  row.tag = tags.number_of(estimate.tag);
  row.verdict = static_cast<std::int32_t>(estimate.verdict);
  row.reason = reasons.number_of(estimate.reason);
  row.reads = static_cast<std::int64_t>(outcome.reads);
  row.reads_used = static_cast<std::int64_t>(estimate.reads);
  put_unknown(row.position_m);
  put(std::nullopt, row.covariance_m2);
  row.expected_error_m = row.rms_m = kUnknown;
  if (!estimate.candidates.empty()) {
    const Candidate& best = estimate.candidates.front();
    row.expected_error_m = best.expected_error_m;
    row.rms_m = best.rms_m;
    if (estimate.verdict == Verdict::kLocated) {
      put(best.p_WT, row.position_m);
      put(best.covariance, row.covariance_m2);
    }
  }
  put_unknown(row.truth_m);
  if (outcome.truth_m) put(*outcome.truth_m, row.truth_m);
  row.error_m = row.horizontal_error_m = kUnknown;
  if (const auto error = error_of(outcome)) {
    row.error_m = *error;
    const Eigen::Vector3d off = estimate.candidates.front().p_WT - *outcome.truth_m;
    row.horizontal_error_m = off.head<2>().norm();
  }
  row.reference = outcome.reference;
  return row;
}

}  // namespace

ReadRow row_of(const TagRead& read, RunTables& names) {
  auto row = ReadRow();  // All bytes are set, of what lies between the columns too.
  row.stamp_ns = read.stamp.time_since_epoch().count();
  row.reader = names.readers.number_of(read.reader);
  row.antenna = names.antennas.number_of(read.antenna);
  row.tag = names.tags.number_of(read.tag);
  row.frequency_hz = read.frequency_hz;
  row.phase_rad = read.phase_rad;
  row.rssi_dbm = read.rssi_dbm;
  row.doppler_hz = read.doppler_hz.value_or(kUnknown);
  return row;
}

PoseRow row_of(const AntennaPose& pose, Names& names) {
  auto row = PoseRow();
  row.stamp_ns = pose.stamp.time_since_epoch().count();
  row.name = names.number_of(pose.antenna);
  put(pose.X_WA.translation, row.position_m);
  const Eigen::Quaterniond& q = pose.X_WA.rotation;
  const double quaternion[4] = {q.x(), q.y(), q.z(), q.w()};
  std::copy_n(quaternion, 4, row.quaternion_xyzw);
  put(pose.covariance, row.covariance);
  return row;
}

void TableRecorder::on_tag_added(const TagPosition& tag, const std::string& /*label*/) {
  auto row = TagRow();
  row.stamp_ns = tag.stamp.time_since_epoch().count();
  row.tag = tables_.tags.number_of(tag.tag);
  put(tag.p_WT, row.position_m);
  tables_.true_tags.push_back(row);
}

void TableRecorder::on_distance(const TrueDistance& distance) {
  tables_.distances.push_back({distance.stamp.time_since_epoch().count(),
                               tables_.antennas.number_of(distance.antenna),
                               tables_.tags.number_of(distance.tag), distance.distance_m});
}

py::dict to_python(RunTables tables) {
  const std::vector<std::string>& antennas = tables.antennas.all();
  const std::vector<std::string>& tags = tables.tags.all();
  const std::vector<std::string>& robots = tables.robots.all();
  py::dict all;
  all["reads"] = table(std::move(tables.reads),
                       {{"reader", tables.readers.all()}, {"antenna", antennas}, {"tag", tags}});
  all["poses"] = table(std::move(tables.poses), {{"name", antennas}});
  all["true_antennas"] = table(std::move(tables.true_antennas), {{"name", antennas}});
  all["true_robots"] = table(std::move(tables.true_robots), {{"name", robots}});
  all["true_tags"] = table(std::move(tables.true_tags), {{"tag", tags}});
  all["true_distances"] =
      table(std::move(tables.distances), {{"antenna", antennas}, {"tag", tags}});
  return all;
}

py::dict tables_of(const std::vector<TagRead>& reads, const std::vector<AntennaPose>& poses) {
  RunTables tables;
  tables.reads.reserve(reads.size());
  for (const TagRead& read : reads) tables.reads.push_back(row_of(read, tables));
  tables.poses.reserve(poses.size());
  for (const AntennaPose& pose : poses) tables.poses.push_back(row_of(pose, tables.antennas));
  return to_python(std::move(tables));
}

std::vector<TagRead> reads_from(const Rows<ReadRow>& rows, const std::vector<std::string>& readers,
                                const std::vector<std::string>& antennas,
                                const std::vector<std::string>& tags) {
  std::vector<TagRead> reads;
  const auto size = static_cast<std::size_t>(rows.size());
  reads.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    ReadRow row = rows.data()[i];
    require_sound(row, i);
    TagRead read{Time(Duration(row.stamp_ns)),
                 name_in(readers, row.reader, "reader", i),
                 name_in(antennas, row.antenna, "antenna", i),
                 name_in(tags, row.tag, "tag", i),
                 row.frequency_hz,
                 row.phase_rad,
                 row.rssi_dbm};
    if (row.doppler_hz == row.doppler_hz) read.doppler_hz = row.doppler_hz;
    reads.push_back(std::move(read));
  }
  return reads;
}

std::vector<AntennaPose> poses_from(const Rows<PoseRow>& rows,
                                    const std::vector<std::string>& names) {
  std::vector<AntennaPose> poses;
  const auto size = static_cast<std::size_t>(rows.size());
  poses.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const PoseRow& row = rows.data()[i];
    AntennaPose pose{Time(Duration(row.stamp_ns)), name_in(names, row.name, "name", i),
                     transform_of(row, i)};
    if (row.covariance[0][0] == row.covariance[0][0]) {
      pose.covariance = Eigen::Map<const Eigen::Matrix3d>(&row.covariance[0][0]);
    }
    poses.push_back(std::move(pose));
  }
  return poses;
}

std::vector<TagPosition> places_from(const Rows<TagRow>& rows,
                                     const std::vector<std::string>& tags) {
  std::vector<TagPosition> places;
  for (py::ssize_t i = 0; i < rows.size(); ++i) {
    const TagRow& row = rows.data()[i];
    places.push_back({Time(Duration(row.stamp_ns)),
                      name_in(tags, row.tag, "tag", static_cast<std::size_t>(i)),
                      vector_of(row.position_m)});
  }
  return places;
}

py::dict estimates_of(const std::vector<TagOutcome>& outcomes) {
  Names tags;
  Names reasons;
  std::vector<EstimateRow> estimates;
  std::vector<CandidateRow> candidates;
  for (const TagOutcome& outcome : outcomes) {
    estimates.push_back(row_of(outcome, tags, reasons));
    const std::vector<Candidate>& places = outcome.estimate.candidates;
    for (std::size_t i = 0; i < places.size(); ++i) {
      candidates.push_back(row_of(places[i], estimates.back().tag, i + 1));
    }
  }
  const std::vector<std::string> verdicts = {to_string(Verdict::kLocated),
                                             to_string(Verdict::kAmbiguous),
                                             to_string(Verdict::kNotLocated)};
  py::dict all;
  all["estimates"] = table(std::move(estimates),
                           {{"tag", tags.all()}, {"verdict", verdicts}, {"reason", reasons.all()}});
  all["candidates"] = table(std::move(candidates), {{"tag", tags.all()}});
  return all;
}

}  // namespace tagfield::python
