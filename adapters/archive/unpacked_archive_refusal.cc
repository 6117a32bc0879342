// SPDX-License-Identifier: Apache-2.0
// Replaces unpacked_archive.cc in builds without libarchive.
#include "adapters/archive/unpacked_archive.h"
#include "tagfield/base/error.h"

namespace tagfield {

UnpackedArchive::UnpackedArchive(const std::string& path, const ArchiveLimits& /*limits*/)
    : path_(path) {
  fail({path, 0}, "is compressed, and this tagfield was built without libarchive: unpack it first");
}

UnpackedArchive::~UnpackedArchive() = default;

}  // namespace tagfield
