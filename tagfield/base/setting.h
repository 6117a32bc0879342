// SPDX-License-Identifier: Apache-2.0
/// @file
/// Keys that set the members of plain structs: what each is for, what it may be, how its value is
/// taken. One table of them serves files, the command line and what people are told.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// A parameter of an antenna or a tag as it stood in the file; rooms further on give it meaning.
struct RawParameter {
  std::string key;
  std::string value;
  Location location;  ///< Unknown where the file is not.
  /// From a profile, which says all of a device, though some of it may be of no use here.
  bool in_profile = false;
};

/// A key, its unit and meaning.
struct SettingHelp {
  std::string key;
  std::string unit;  ///< Or its words, "a | b".
  std::string meaning;
  std::string range{};      ///< "over 0"; "" where the meaning says it.
  std::string otherwise{};  ///< What holds where it is not given; "" where the meaning says it.
};

/// One key: what it is for, and how its value gets into a T. Throws Error without the place.
template <class T>
struct Setting {
  SettingHelp help;
  std::function<void(T&, const std::string&)> set;
  std::function<std::string(const T&)> text{};  ///< The value, as `set` takes it; not of all.
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

/// What a number may be: from `least`, or over it, to `most`.
struct ValueRange {
  double least = 0.0;
  bool over = false;  ///< `least` itself is out of it.
  double most = 1e15;
};
inline constexpr ValueRange kOverZero{0.0, true};
inline constexpr ValueRange kAtLeastZero{};
inline constexpr ValueRange kAtLeastOne{1.0};

/// The same, but no length over kMostLength_m; goes without saying in helps.
ValueRange limited(ValueRange range, const std::string& unit);

/// "over 0 and at most 1".
std::string to_string(const ValueRange& range);
double number_in(const std::string& text, const ValueRange& range);
double whole_number_in(const std::string& text, const ValueRange& range);
std::string text_of(double number);

/// A member that is a number of any kind.
template <class T, class Owner, class Number>
Setting<T> setting(const char* key, const char* unit, const char* meaning, Number Owner::*member,
                   const ValueRange& range) {
  return {{key, unit, meaning, to_string(range)},
          [member, limits = limited(range, unit)](T& model, const std::string& text) {
            model.*member =
                static_cast<Number>(std::is_integral_v<Number> ? whole_number_in(text, limits)
                                                               : number_in(text, limits));
          },
          [member](const T& model) { return text_of(static_cast<double>(model.*member)); }};
}

/// A member that is true or false.
template <class T, class Owner>
Setting<T> setting(const char* key, const char* meaning, bool Owner::*member) {
  return {{key, "true | false", meaning},
          [member](T& model, const std::string& text) { model.*member = truth_in(text); },
          [member](const T& model) { return model.*member ? "true" : "false"; }};
}

/// Null where the table has no such key.
template <class T>
const Setting<T>* find_setting(const std::vector<Setting<T>>& table, const std::string& key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Setting<T>& setting) {
    return setting.help.key == key;
  });
  return found == table.end() ? nullptr : &*found;
}

/// What people are told of a table; of settings that can say it, with the values of `defaults`.
template <class T>
std::vector<SettingHelp> helps_of(const std::vector<Setting<T>>& table, const T& defaults = {}) {
  std::vector<SettingHelp> all;
  all.reserve(table.size());
  for (const Setting<T>& setting : table) {
    all.push_back(setting.help);
    if (setting.text) all.back().otherwise = setting.text(defaults);
  }
  return all;
}

/// Whether there is help on that key.
bool has_key(const std::vector<SettingHelp>& helps, const std::string& key);

/// Sets `model` by those of the parameters that the table has, later ones before earlier ones.
/// Throws Error "FILE:LINE: KEY …" on a value that is none or out of its range.
template <class T>
void apply_settings(const std::vector<Setting<T>>& table,
                    const std::vector<RawParameter>& parameters, T& model) {
  for (const RawParameter& parameter : parameters) {
    const Setting<T>* const setting = find_setting(table, parameter.key);
    if (setting == nullptr) continue;
    try {
      setting->set(model, parameter.value);
    } catch (const Error& error) {
      fail(parameter.location, parameter.key + " " + error.what());
    }
  }
}

/// Throws Error "KEY …" on a member that its setting would refuse.
template <class T>
void check_settings(const std::vector<Setting<T>>& table, T model) {
  for (const Setting<T>& setting : table) {
    apply_settings(table, {{setting.help.key, setting.text(model), {}}}, model);
  }
}

/// The place of the parameter that a complaint names first, or `otherwise`.
Location place_of(const std::string& complaint, const std::vector<RawParameter>& parameters,
                  const Location& otherwise);

}  // namespace tagfield
