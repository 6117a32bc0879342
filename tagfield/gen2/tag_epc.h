// SPDX-License-Identifier: Apache-2.0
/// @file
/// The EPC that a tag with a given ID sends.
#pragma once

#include <string>

#include "tagfield/gen2/memory_banks.h"

namespace tagfield {

/// sent_bits() of the ID, one to 31 words.
Words epc_of_id(const std::string& id);

/// "3074257BF7194E4000001A85".
std::string to_hex(const Words& words);

}  // namespace tagfield
