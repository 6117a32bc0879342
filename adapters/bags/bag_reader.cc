// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_reader.h"

void tagfield_read_bag(const std::string& path, const tagfield::BagOptions& options,
                       tagfield::Diagnostics& diagnostics, tagfield::BagRecording& recording) {
  recording = tagfield::read_bag(path, options, diagnostics);
}
