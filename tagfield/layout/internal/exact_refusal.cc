// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/error.h"
#include "tagfield/layout/selection.h"

namespace tagfield {

bool has_exact_solver() { return false; }

void require_exact_solver(Worth /*worth*/) {
  throw Error(
      "--exact needs CBC, which Tagfield was built without: install coinor-libcbc-dev and build "
      "again");
}

ExactChoice best_exactly(const SelectionProblem& problem, const OptionSet& /*begin*/,
                         double /*seconds*/) {
  require_exact_solver(problem.worth);
  return {};
}

}  // namespace tagfield
