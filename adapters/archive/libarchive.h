// SPDX-License-Identifier: Apache-2.0
/// @file
/// libarchive, loaded when a table is read from an archive.
#pragma once

#include <archive.h>
#include <archive_entry.h>

#include "tagfield/base/loaded_library.h"

namespace tagfield {

/// Functions of libarchive, named without the prefix "archive_".
struct LibArchive : LoadedLibrary {
  LibArchive() : LoadedLibrary("Archives", TAGFIELD_LIBARCHIVE) {}
  decltype(&archive_entry_filetype) entry_filetype = function("archive_entry_filetype");
  decltype(&archive_entry_hardlink) entry_hardlink = function("archive_entry_hardlink");
  decltype(&archive_entry_pathname) entry_pathname = function("archive_entry_pathname");
  decltype(&archive_entry_symlink) entry_symlink = function("archive_entry_symlink");
  decltype(&archive_error_string) error_string = function("archive_error_string");
  decltype(&archive_filter_count) filter_count = function("archive_filter_count");
  decltype(&archive_format) format = function("archive_format");
  decltype(&archive_read_data) read_data = function("archive_read_data");
  decltype(&archive_read_free) read_free = function("archive_read_free");
  decltype(&archive_read_new) read_new = function("archive_read_new");
  decltype(&archive_read_next_header) read_next_header = function("archive_read_next_header");
  decltype(&archive_read_open_filename) read_open_filename = function("archive_read_open_filename");
  decltype(&archive_read_support_filter_gzip) read_support_filter_gzip =
      function("archive_read_support_filter_gzip");
  decltype(&archive_read_support_filter_xz) read_support_filter_xz =
      function("archive_read_support_filter_xz");
  decltype(&archive_read_support_filter_zstd) read_support_filter_zstd =
      function("archive_read_support_filter_zstd");
  decltype(&archive_read_support_format_raw) read_support_format_raw =
      function("archive_read_support_format_raw");
  decltype(&archive_read_support_format_tar) read_support_format_tar =
      function("archive_read_support_format_tar");
};

inline const LibArchive& libarchive() { return loaded<LibArchive>(); }

}  // namespace tagfield
