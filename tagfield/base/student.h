// SPDX-License-Identifier: Apache-2.0
/// @file
/// Student's t distribution.
#pragma once

namespace tagfield {

/// Its 97.5 % quantile for an integer number of `degrees` of freedom ≥ 1: in closed form for 1 and
/// 2, from 3 on by the Cornish-Fisher expansion, accurate to 1 %.
double student_975(double degrees);

}  // namespace tagfield
