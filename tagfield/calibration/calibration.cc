// SPDX-License-Identifier: Apache-2.0
#include "tagfield/calibration/calibration.h"

#include <fmt/format.h>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// A name as a quoted YAML string, with any characters.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') result += '\\';
    if (static_cast<unsigned char>(character) < 0x20) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(character));
    } else {
      result += character;
    }
  }
  return result + '"';
}

std::string figure(const CalibratedValue& value) {
  return fmt::format("{{value: {:.9g}, sigma: {:.9g}, observable: {}}}", value.value, value.sigma,
                     value.observable);
}

Eigen::Vector3d place_of(const AntennaCalibration& antenna) {
  return {antenna.phase_centre_m[0].value, antenna.phase_centre_m[1].value,
          antenna.phase_centre_m[2].value};
}

}  // namespace

void apply_calibration(const Calibration& calibration, std::vector<TagRead>& reads,
                       std::vector<AntennaPose>& poses, KnownBeforehand& known) {
  for (TagRead& read : reads) {
    const auto antenna = calibration.antennas.find(read.antenna);
    if (antenna == calibration.antennas.end()) continue;
    if (antenna->second.phase_sign < 0) read.phase_rad = wrap_to_two_pi(-read.phase_rad);
    read.stamp -= duration_from_seconds(antenna->second.time_offset_s.value);
  }
  for (AntennaPose& pose : poses) {
    const auto antenna = calibration.antennas.find(pose.antenna);
    if (antenna == calibration.antennas.end()) continue;
    pose.X_WA = pose.X_WA * from_translation(place_of(antenna->second));
  }
  for (const auto& [name, antenna] : calibration.antennas) {
    for (const ChannelOffset& offset : antenna.offsets) {
      known.offsets.push_back({name, offset.frequency_hz, offset.value_rad});
    }
  }
  if (calibration.pi_ambiguity) known.pi_ambiguity = true;
}

std::string to_yaml(const Calibration& calibration) {
  std::string text = fmt::format("name: {}\nkind: calibration\npi_ambiguity: {}\nantennas:\n",
                                 quoted(calibration.name), calibration.pi_ambiguity);
  if (calibration.antennas.empty()) text.insert(text.size() - 1, " {}");
  for (const auto& [name, antenna] : calibration.antennas) {
    text += fmt::format("  {}:\n    reads: {}\n    phase_sign: {}\n    noise_rad: {:.9g}\n",
                        quoted(name), antenna.reads, antenna.phase_sign, antenna.noise_rad);
    text += "    phase_centre_m:  # of the phase centre, in the antenna's believed frame\n";
    for (int i = 0; i < 3; ++i) {
      text += fmt::format("      {}: {}\n", "xyz"[i], figure(antenna.phase_centre_m[i]));
    }
    text += fmt::format("    time_offset_s: {}  # by which stamps of reads are late\n",
                        figure(antenna.time_offset_s));
    text += fmt::format("    tag_scatter_rad: {:.9g}\n", antenna.tag_scatter_rad);
    text += fmt::format("    offsets:{}\n", antenna.offsets.empty() ? " []" : "");
    for (const ChannelOffset& offset : antenna.offsets) {
      text += fmt::format(
          "      - {{frequency_hz: {:.9g}, value_rad: {:.9g}, sigma_rad: {:.9g}, reads: {}}}\n",
          offset.frequency_hz, offset.value_rad, offset.sigma_rad, offset.reads);
    }
  }
  return text;
}

}  // namespace tagfield
