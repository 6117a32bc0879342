/// @file
/// What a tag sends for its ID.
#pragma once

#include <string>

#include "tagfield/gen2/memory_banks.h"

namespace tagfield {

/// Hexadecimal IDs of whole words, 4 to 124 digits, are the EPC itself; URIs of one ("urn:epc:…")
/// have its 96 bits. Of others of at most twelve bytes these are the first of 96 bits, the rest 0;
/// longer ones have 96 bits of a hash. Throws Error on a URI that is malformed.
Words epc_of_id(const std::string& id);

/// "3074257BF7194E4000001A85".
std::string to_hex(const Words& words);

}  // namespace tagfield
