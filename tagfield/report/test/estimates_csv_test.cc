// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/estimates_csv.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

TEST(EstimatesToCsv, GivesARowACandidate) {
  TagEstimate located{"a", Verdict::kLocated, "", {{{1.0, 2.0, 3.0}, 0.004, 0.01}}, 700};
  TagEstimate both = located;
  both.tag = "b, the second";
  both.verdict = Verdict::kAmbiguous;
  both.reason = "mirror";
  both.candidates.push_back({{1.0, -2.0, 3.0}, 0.005, 0.01});
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.topLeftCorner<2, 2>() << 1e-4, -2e-5, -2e-5, 4e-4;
  located.candidates[0].covariance = covariance;
  const TagEstimate none{"c", Verdict::kNotLocated, "cannot localize: no reads", {}, 0};
  EXPECT_EQ(
      estimates_to_csv({located, both, none}),
      "tag,verdict,candidate,x_m,y_m,z_m,rms_m,expected_error_m,reads,"
      "cov_xx,cov_xy,cov_yy,cov_zz,reason\n"
      "a,located,1,1.000000,2.000000,3.000000,0.004000,0.010000,700,0.0001,-2e-05,0.0004,0,\n"
      "\"b, the second\",ambiguous,1,1.000000,2.000000,3.000000,0.004000,0.010000,700,,,,,mirror\n"
      "\"b, the second\",ambiguous,2,1.000000,-2.000000,3.000000,0.005000,0.010000,700,,,,,mirror\n"
      "c,not_located,,,,,,,0,,,,,cannot localize: no reads\n");
}

}  // namespace
}  // namespace tagfield
