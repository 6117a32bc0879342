// SPDX-License-Identifier: Apache-2.0
/// @file
/// Student's t distribution.
#pragma once

namespace tagfield {

/// Its 97.5 % quantile for whole `degrees` of freedom ≥ 1: closed for 1 and 2, from 3 on Cornish
/// and Fisher's expansion, which is good to 1 %.
double student_975(double degrees);

}  // namespace tagfield
