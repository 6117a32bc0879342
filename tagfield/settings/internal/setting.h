/// @file
/// One key of the physical models: what it is for, and how its value is taken.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tagfield/settings/radio_settings.h"

namespace tagfield::settings_internal {

/// One key: what it is for, and how its value gets into a T. Throws Error without the place.
template <class T>
struct Setting {
  SettingHelp help;
  std::function<void(T&, const std::string&)> set;
};

// What a value's text is. Each throws Error that says what was expected, without the place.

double number_in(const std::string& text);
int whole_in(const std::string& text);
bool truth_in(const std::string& text);
std::vector<std::string> words_in(const std::string& text);
std::vector<double> numbers_in(const std::string& text);
/// Which of the choices it is.
std::size_t choice_in(const std::string& text, const std::vector<std::string>& choices);

/// "a | b | c".
std::string one_of(const std::vector<std::string>& choices);

/// A number with a unit that is `factor` of the member's.
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
