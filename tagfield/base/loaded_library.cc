// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/loaded_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {

LoadedLibrary::LoadedLibrary(std::string purpose, std::string file)
    : purpose_(std::move(purpose)),
      file_(std::move(file)),
      handle_(dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) {
    throw Error(fmt::format("{}: a library can't be loaded: {}", purpose_, dlerror()));
  }
}

LoadedFunction LoadedLibrary::function(const char* name) const {
  void* const address = dlsym(handle_, name);
  if (address == nullptr) throw Error(fmt::format("{}: {} has no {}()", purpose_, file_, name));
  return LoadedFunction(address);
}

}  // namespace tagfield
