// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/navigation_spec.h"

#include <memory>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

const NavigationSpec& navigation_of(const Scenario& scenario) {
  static const NavigationSpec usual;
  return scenario.navigation ? *scenario.navigation : usual;
}

NavigationSpec& own_navigation(Scenario& scenario) {
  auto own = std::make_shared<NavigationSpec>(navigation_of(scenario));
  scenario.navigation = own;
  return *own;
}

}  // namespace tagfield
