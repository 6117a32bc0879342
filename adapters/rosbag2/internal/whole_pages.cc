// SPDX-License-Identifier: Apache-2.0
#include "adapters/rosbag2/internal/whole_pages.h"

#include <sqlite3.h>

#include <array>

namespace tagfield::rosbag2_internal {
namespace {

constexpr const char* kName = "tagfield-whole-pages";

/// Header in front of the file object of SQLite's own VFS.
struct CutFile {
  sqlite3_file file;
  sqlite3_int64 page_bytes;  ///< Page size of a database, else 1.
};

sqlite3_file* own(sqlite3_file* file) {
  return reinterpret_cast<sqlite3_file*>(reinterpret_cast<CutFile*>(file) + 1);
}

int file_size(sqlite3_file* file, sqlite3_int64* size) {
  const int result = own(file)->pMethods->xFileSize(own(file), size);
  *size -= *size % reinterpret_cast<CutFile*>(file)->page_bytes;
  return result;
}

const sqlite3_io_methods kMethods = {
    1,
    [](sqlite3_file* f) { return own(f)->pMethods->xClose(own(f)); },
    [](sqlite3_file* f, void* bytes, int size, sqlite3_int64 at) {
      return own(f)->pMethods->xRead(own(f), bytes, size, at);
    },
    [](sqlite3_file*, const void*, int, sqlite3_int64) { return SQLITE_READONLY; },
    [](sqlite3_file*, sqlite3_int64) { return SQLITE_READONLY; },
    [](sqlite3_file*, int) { return SQLITE_OK; },
    file_size,
    [](sqlite3_file*, int) { return SQLITE_OK; },
    [](sqlite3_file*, int) { return SQLITE_OK; },
    [](sqlite3_file*, int* is_reserved) { return *is_reserved = 0; },
    [](sqlite3_file* f, int what, void* argument) {
      return own(f)->pMethods->xFileControl(own(f), what, argument);
    },
    [](sqlite3_file* f) { return own(f)->pMethods->xSectorSize(own(f)); },
    [](sqlite3_file* f) { return own(f)->pMethods->xDeviceCharacteristics(own(f)); },
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr};

/// Page size from bytes 16 and 17 of a database, big-endian; 1 stands for 65536.
sqlite3_int64 page_bytes_of(sqlite3_file* file) {
  std::array<unsigned char, 2> bytes{};
  if (file->pMethods->xRead(file, bytes.data(), bytes.size(), 16) != SQLITE_OK) return 1;
  const int size = bytes[0] * 256 + bytes[1];
  if (size == 1) return 65536;
  return size >= 512 ? size : 1;
}

int open_file(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  auto* const base = static_cast<sqlite3_vfs*>(vfs->pAppData);
  file->pMethods = nullptr;
  const int result = base->xOpen(base, name, own(file), flags, out_flags);
  if (own(file)->pMethods == nullptr) return result;
  const bool is_database = (flags & SQLITE_OPEN_MAIN_DB) != 0;
  reinterpret_cast<CutFile*>(file)->page_bytes = is_database ? page_bytes_of(own(file)) : 1;
  file->pMethods = &kMethods;
  return result;
}

sqlite3_vfs made() {
  sqlite3_vfs* const base = sqlite3_vfs_find("unix-none");
  sqlite3_vfs vfs = *base;
  vfs.zName = kName;
  vfs.pNext = nullptr;
  vfs.pAppData = base;
  vfs.szOsFile += static_cast<int>(sizeof(CutFile));
  vfs.xOpen = open_file;
  return vfs;
}

}  // namespace

const char* whole_pages() {
  static sqlite3_vfs vfs = made();
  static const int registered = sqlite3_vfs_register(&vfs, 0);
  return registered == SQLITE_OK ? kName : "unix-none";
}

}  // namespace tagfield::rosbag2_internal
