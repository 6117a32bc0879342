// SPDX-License-Identifier: Apache-2.0
#include "python/core/arrays.h"

#include "tagfield/report/coverage.h"

namespace tagfield::python {

void register_rows() {
  PYBIND11_NUMPY_DTYPE(ReadRow, stamp_ns, reader, antenna, tag, frequency_hz, phase_rad, rssi_dbm,
                       doppler_hz);
  PYBIND11_NUMPY_DTYPE(PoseRow, stamp_ns, name, position_m, quaternion_xyzw, covariance);
  PYBIND11_NUMPY_DTYPE(TagRow, stamp_ns, tag, position_m);
  PYBIND11_NUMPY_DTYPE(DistanceRow, stamp_ns, antenna, tag, distance_m);
  PYBIND11_NUMPY_DTYPE(EstimateRow, tag, verdict, reason, reads, reads_used, position_m,
                       covariance_m2, expected_error_m, rms_m, truth_m, error_m, horizontal_error_m,
                       reference);
  PYBIND11_NUMPY_DTYPE(CandidateRow, tag, number, position_m, covariance_m2, expected_error_m,
                       rms_m);
  PYBIND11_NUMPY_DTYPE(SampleRow, stamp_ns, antenna, phase_rad, frequency_hz, rssi_dbm, position_m);
  PYBIND11_NUMPY_DTYPE(TrackRow, tag, verdict, reason, number, reads, points, rms_rad, coherence,
                       expected_error_m);
  PYBIND11_NUMPY_DTYPE(TrackPointRow, stamp_ns, tag, number, position_m, velocity_m_s, covariance);
  PYBIND11_NUMPY_DTYPE(PassingRow, stamp_ns, place, tag, sigma_s);
  PYBIND11_NUMPY_DTYPE(CoverageCell, power_dbm, reply_dbm, margin_db, probability, antenna);
  PYBIND11_NUMPY_DTYPE(TagCoverageRow, tag, verdict, nearest, antenna, position_m, nearest_m,
                       power_dbm, reply_dbm, margin_db, probability);
  PYBIND11_NUMPY_DTYPE(LinkRow, distance_m, tag_dbm, reply_dbm, phase_rad, readable);
}

py::object as_table(const py::array& array, const Categories& categories) {
  py::dict named;
  for (const auto& [column, names] : categories) named[column] = py::tuple(py::cast(names));
  return py::module_::import("tagfield._tables").attr("Table")(array, named);
}

}  // namespace tagfield::python
