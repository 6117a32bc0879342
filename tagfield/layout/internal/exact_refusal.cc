// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/error.h"
#include "tagfield/layout/selection.h"

namespace tagfield {

bool has_exact_solver() { return false; }

ExactChoice best_exactly(const SelectionProblem& /*problem*/, const OptionSet& /*begin*/,
                         double /*seconds*/) {
  throw Error(
      "--exact needs CBC, which Tagfield was built without: install coinor-libcbc-dev and build "
      "again");
}

}  // namespace tagfield
