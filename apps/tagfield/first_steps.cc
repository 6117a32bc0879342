// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/first_steps.h"

#include <fmt/format.h>

#include <filesystem>

#include "apps/tagfield/shared_folder.h"

namespace tagfield {

namespace fs = std::filesystem;

std::string first_steps() {
  const fs::path here = "scenarios/paper_warehouse.yaml";
  std::error_code error;
  const fs::path scenario =
      fs::exists(here, error) ? here : shared_folder("scenarios") / here.filename();
  return fmt::format(
      "Tagfield simulates UHF RFID, and locates tags by phase and RSSI. To begin:\n\n"
      "  tagfield run {}\n"
      "      ten tags in a warehouse, located by a robot; ends with the path of a page to open\n"
      "  tagfield new hall\n"
      "      a folder with a scenario, a world and a script to make your own\n"
      "  tagfield localize reads.csv --poses poses.csv\n"
      "      locates tags from reads of a real reader; also from rosbags and MCAP files\n"
      "  tagfield doctor\n"
      "      what works on this machine, and how to get the rest\n\n"
      "'tagfield --help' lists all commands, 'tagfield run --help' describes one.\n",
      scenario.string());
}

}  // namespace tagfield
