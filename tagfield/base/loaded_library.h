// SPDX-License-Identifier: Apache-2.0
/// @file
/// Shared libraries that are loaded when they are first needed: linked, those of outlets and of
/// other parts that few runs use would come with every start, and double what it takes.
#pragma once

#include <string>

namespace tagfield {

/// The address of a function, which becomes a pointer of the type that is asked for.
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

/// A library that stays loaded until the process ends. To be derived from, with a member for each
/// function that is used:
///
///     struct LibExample : LoadedLibrary {
///       LibExample() : LoadedLibrary("Examples", "libexample.so.1") {}
///       decltype(&example_open) open = function("example_open");
///     };
class LoadedLibrary {
 public:
  /// `file` is a name that the system's loader finds, or a path. Throws Error, which begins with
  /// `purpose`, where it can't be loaded.
  LoadedLibrary(std::string purpose, std::string file);

 protected:
  /// Throws Error where the library has none of that name.
  [[nodiscard]] LoadedFunction function(const char* name) const;

 private:
  std::string purpose_;
  std::string file_;
  void* handle_;
};

/// The one of a type that is derived from LoadedLibrary, loaded the first time that it is called.
/// From any thread. Throws Error where it is not there.
template <typename Library>
const Library& loaded() {
  static const Library library;
  return library;
}

}  // namespace tagfield
