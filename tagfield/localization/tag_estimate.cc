// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/tag_estimate.h"

#include <fmt/format.h>

#include "tagfield/base/error.h"

namespace tagfield {

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kLocated:
      return "located";
    case Verdict::kAmbiguous:
      return "ambiguous";
    case Verdict::kNotLocated:
      break;
  }
  return "not_located";
}

Verdict verdict_from_string(const std::string& word) {
  for (const Verdict verdict : {Verdict::kLocated, Verdict::kAmbiguous, Verdict::kNotLocated}) {
    if (word == to_string(verdict)) return verdict;
  }
  throw Error(fmt::format("unknown verdict '{}' (known: located, ambiguous, not_located)", word));
}

}  // namespace tagfield
