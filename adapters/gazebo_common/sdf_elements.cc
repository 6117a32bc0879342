// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_common/sdf_elements.h"

namespace tagfield {
namespace {

void gather(const sdf::ElementPtr& parent, std::vector<RawParameter>& parameters) {
  for (sdf::ElementPtr child = parent->GetFirstElement(); child; child = child->GetNextElement()) {
    const sdf::ParamPtr value = child->GetValue();
    parameters.push_back({child->GetName(), value ? value->GetAsString() : "", {}});
    gather(child, parameters);
  }
}

}  // namespace

std::vector<sdf::ElementPtr> children(const sdf::ElementPtr& parent, const std::string& name) {
  std::vector<sdf::ElementPtr> found;
  if (!parent || !parent->HasElement(name)) return found;
  for (sdf::ElementPtr child = parent->GetElement(name); child;
       child = child->GetNextElement(name)) {
    found.push_back(child);
  }
  return found;
}

std::vector<RawParameter> parameters_in(const sdf::ElementPtr& parent) {
  std::vector<RawParameter> parameters;
  gather(parent, parameters);
  return parameters;
}

}  // namespace tagfield
