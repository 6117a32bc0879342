#include "tagfield/report/estimates_csv.h"

#include <fmt/format.h>

#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

std::string covariance_fields(const Candidate& candidate) {
  if (!candidate.covariance) return ",,,";
  const Eigen::Matrix3d& c = *candidate.covariance;
  return fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}", c(0, 0), c(0, 1), c(1, 1), c(2, 2));
}

}  // namespace

std::string estimates_to_csv(const std::vector<TagEstimate>& estimates) {
  std::string text =
      "tag,verdict,candidate,x_m,y_m,z_m,rms_m,expected_error_m,reads,"
      "cov_xx,cov_xy,cov_yy,cov_zz,reason\n";
  for (const TagEstimate& estimate : estimates) {
    const std::string begin =
        fmt::format("{},{}", csv_field(estimate.tag), to_string(estimate.verdict));
    const std::string reason = csv_field(estimate.reason);
    if (estimate.candidates.empty()) {
      text += fmt::format("{},,,,,,,{},,,,,{}\n", begin, estimate.reads, reason);
    }
    for (std::size_t i = 0; i < estimate.candidates.size(); ++i) {
      const Candidate& candidate = estimate.candidates[i];
      const Eigen::Vector3d& p = candidate.p_WT;
      text += fmt::format("{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{}\n", begin, i + 1,
                          p.x(), p.y(), p.z(), candidate.rms_m, candidate.expected_error_m,
                          estimate.reads, covariance_fields(candidate), reason);
    }
  }
  return text;
}

}  // namespace tagfield
