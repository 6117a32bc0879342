// SPDX-License-Identifier: Apache-2.0
/// @file
/// A folder of results takes the place of an earlier one in one step.
#pragma once

#include <filesystem>

#include "tagfield/files/staged_folder.h"

namespace tagfield::files_internal {

/// Puts `staging`, a folder inside of `folder`, in the place of that, by one system call: whoever
/// looks finds all of the one or all of the other. Of the earlier files `kept` are in both. The
/// caller holds the locks on both.
///
/// Gives false, with nothing changed, where that can't be done: there is something in `folder` that
/// is not `own` (files of others, a run that goes on), the process stands in it, it is where
/// another file system is mounted, its parent can't be written to, or the file system can't swap
/// folders.
bool swap_in(const std::filesystem::path& folder, const std::filesystem::path& staging,
             const OwnFiles& own, const OwnFiles& kept);

/// Deletes what programs that were killed within swap_in() left beside `folder`.
void remove_swap_leftovers(const std::filesystem::path& folder);

}  // namespace tagfield::files_internal
