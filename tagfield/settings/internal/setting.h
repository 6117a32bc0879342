// SPDX-License-Identifier: Apache-2.0
/// @file
/// One key of the physical models: its meaning and how its value is parsed.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"

namespace tagfield::settings_internal {

using tagfield::choice_in;
using tagfield::Setting;

/// A number whose unit is `factor` times that of the member.
template <class T>
Setting<T> number(const char* key, const char* unit, const char* meaning,
                  std::function<double&(T&)> member, double factor = 1.0) {
  return {{key, unit, meaning}, [member, factor](T& model, const std::string& text) {
            member(model) = factor * number_in(text);
          }};
}

template <class T>
Setting<T> word(const char* key, const std::vector<std::string>& choices, const char* meaning,
                std::function<void(T&, std::size_t)> set) {
  return {{key, one_of(choices), meaning}, [choices, set](T& model, const std::string& text) {
            set(model, choice_in(text, choices));
          }};
}

}  // namespace tagfield::settings_internal
