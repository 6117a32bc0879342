// SPDX-License-Identifier: Apache-2.0
/// @file
/// An inventory on the page: the numbers first, then tables by reader and antenna.
#pragma once

#include <string>

#include "tagfield/report/summary.h"

namespace tagfield {

/// Whether the run is an inventory and nothing else: none of its tags is located.
bool is_inventory_alone(const Summary& summary);

/// The result in a sentence.
std::string inventory_sentence(const InventorySummary& inventory, std::size_t seeds);

/// The headline numbers.
std::string inventory_numbers(const InventorySummary& inventory);

/// Tables by zone, level, reader and antenna, with their headings; "" without an inventory.
std::string inventory_tables(const Summary& summary);

}  // namespace tagfield
