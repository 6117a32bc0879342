// SPDX-License-Identifier: Apache-2.0
/// @file
/// Keys that set the members of plain structs: the meaning of each, its allowed values, and how a
/// value is parsed. One table of them serves files, the command line and the help texts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// A parameter of an antenna or a tag as written in the file; other rooms interpret it.
struct RawParameter {
  std::string key;
  std::string value;
  Location location;  ///< Empty if the file is unknown.
  /// It comes from a profile, which describes a device completely, though some of it may not apply
  /// here.
  bool in_profile = false;
};

/// A key with its unit and meaning.
struct SettingHelp {
  std::string key;
  std::string unit;  ///< Or the allowed words, "a | b".
  std::string meaning;
  std::string range{};      ///< "over 0"; "" if the meaning includes it.
  std::string otherwise{};  ///< The default; "" if the meaning includes it.
};

/// One key: its help, and how a value is written into a T. Throws Error without the location.
template <class T>
struct Setting {
  SettingHelp help;
  std::function<void(T&, const std::string&)> set;
  std::function<std::string(const T&)> text{};  ///< The value as `set` accepts it; optional.
};

// Parsers of a value's text. Each throws Error that says what was expected, without the location.

double number_in(const std::string& text);
int whole_in(const std::string& text);
bool truth_in(const std::string& text);
std::vector<std::string> words_in(const std::string& text);
std::vector<double> numbers_in(const std::string& text);
/// The index of the choice that the text names.
std::size_t choice_in(const std::string& text, const std::vector<std::string>& choices);

/// "a | b | c".
std::string one_of(const std::vector<std::string>& choices);

/// The allowed range of a number: from `least`, or strictly above it, to `most`.
struct ValueRange {
  double least = 0.0;
  bool over = false;  ///< `least` itself is excluded.
  double most = 1e15;
};
inline constexpr ValueRange kOverZero{0.0, true};
inline constexpr ValueRange kAtLeastZero{};
inline constexpr ValueRange kAtLeastOne{1.0};

/// Same, but lengths are limited to kMaxLength_m; help texts don't mention this limit.
ValueRange limited(ValueRange range, const std::string& unit);

/// "over 0 and at most 1".
std::string to_string(const ValueRange& range);
double number_in(const std::string& text, const ValueRange& range);
double whole_number_in(const std::string& text, const ValueRange& range);
std::string text_of(double number);

/// A setting of a numeric member of any type.
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

/// A setting of a Boolean member.
template <class T, class Owner>
Setting<T> setting(const char* key, const char* meaning, bool Owner::*member) {
  return {{key, "true | false", meaning},
          [member](T& model, const std::string& text) { model.*member = truth_in(text); },
          [member](const T& model) { return model.*member ? "true" : "false"; }};
}

/// Null if the table has no such key.
template <class T>
const Setting<T>* find_setting(const std::vector<Setting<T>>& table, const std::string& key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Setting<T>& setting) {
    return setting.help.key == key;
  });
  return found == table.end() ? nullptr : &*found;
}

/// The help texts of a table; settings that have `text` include the values of `defaults`.
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

/// Whether there is a help text for that key.
bool has_key(const std::vector<SettingHelp>& helps, const std::string& key);

/// Sets members of `model` from the parameters whose keys are in the table; later ones override
/// earlier ones. Throws Error "FILE:LINE: KEY …" on a value that is invalid or out of range.
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

/// Throws Error "KEY …" on a member whose value its setting would refuse.
template <class T>
void check_settings(const std::vector<Setting<T>>& table, T model) {
  for (const Setting<T>& setting : table) {
    apply_settings(table, {{setting.help.key, setting.text(model), {}}}, model);
  }
}

/// The location of the parameter that an error message names first, or `otherwise`.
Location place_of(const std::string& complaint, const std::vector<RawParameter>& parameters,
                  const Location& otherwise);

}  // namespace tagfield
