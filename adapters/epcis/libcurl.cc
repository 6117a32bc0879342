// SPDX-License-Identifier: Apache-2.0
#include "adapters/epcis/libcurl.h"

#include "tagfield/base/error.h"

namespace tagfield {

LibCurl::LibCurl() : LoadedLibrary("EPCIS capture", TAGFIELD_LIBCURL) {
  if (global_init(CURL_GLOBAL_DEFAULT) != CURLE_OK) {
    throw Error("EPCIS capture: libcurl can't be initialized");
  }
}

const LibCurl& libcurl() { return loaded<LibCurl>(); }

}  // namespace tagfield
