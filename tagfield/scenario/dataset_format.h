// SPDX-License-Identifier: Apache-2.0
/// @file
/// Formats of third-party tables as YAML files, profiles/datasets/NAME.yaml. docs/datasets.md has
/// the keys.
#pragma once

#include <string>

#include "tagfield/files/dataset_csv.h"

namespace tagfield {

/// Throws Error "FILE:LINE: …" if the file can't be read or is inconsistent.
DatasetForm read_dataset_form(const std::string& path);

}  // namespace tagfield
