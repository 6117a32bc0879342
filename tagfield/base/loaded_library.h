// SPDX-License-Identifier: Apache-2.0
/// @file
/// Shared libraries that are loaded on first use. If they were linked, those of outlets and of
/// other rarely used parts would be loaded at every start, and double the start-up time.
#pragma once

#include <string>

namespace tagfield {

/// The address of a function, convertible to a pointer of the requested type.
class LoadedFunction {
 public:
  explicit LoadedFunction(void* address) : address_(address) {}
  template <typename Function>
  operator Function*() const {  // NOLINT(google-explicit-constructor): what it is for.
    return reinterpret_cast<Function*>(address_);  // NOLINT: as dlsym() is used.
  }

 private:
  void* address_;
};

/// A library that stays loaded until the process ends. Derive from it, with a member for each
/// function that is used:
///
///     struct LibExample : LoadedLibrary {
///       LibExample() : LoadedLibrary("Examples", "libexample.so.1") {}
///       decltype(&example_open) open = function("example_open");
///     };
class LoadedLibrary {
 public:
  /// `file` is a name that the system's loader finds, or a path. Throws Error, whose message begins
  /// with `purpose`, if it can't be loaded.
  LoadedLibrary(std::string purpose, std::string file);

 protected:
  /// Throws Error if the library has no function of that name.
  [[nodiscard]] LoadedFunction function(const char* name) const;

 private:
  std::string purpose_;
  std::string file_;
  void* handle_;
};

/// The single instance of a type derived from LoadedLibrary, loaded on the first call. Thread-safe.
/// Throws Error if the library is missing.
template <typename Library>
const Library& loaded() {
  static const Library library;
  return library;
}

}  // namespace tagfield
