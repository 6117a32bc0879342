// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/rf_modes.h"

#include <algorithm>
#include <cmath>

namespace tagfield::llrp {
namespace {

constexpr double kMinPower_dbm = 10.0;
constexpr double kUsualPower_dbm = 30.0;
constexpr double kStep_db = 0.25;

LinkSettings link(double tari_s, double blf_hz, Encoding encoding) {
  LinkSettings settings;
  settings.tari_s = tari_s;
  settings.blf_hz = blf_hz;
  settings.encoding = encoding;
  return settings;
}

}  // namespace

const std::vector<RfMode>& rf_modes() {
  static const std::vector<RfMode> all = {
      {0, link(6.25e-6, 640e3, Encoding::kFm0)},     {1, link(6.25e-6, 640e3, Encoding::kMiller2)},
      {2, link(20e-6, 274e3, Encoding::kMiller4)},   {3, link(20e-6, 171e3, Encoding::kMiller8)},
      {4, link(7.14e-6, 640e3, Encoding::kMiller4)}, {1000, std::nullopt},
  };
  return all;
}

const RfMode* find_mode(std::uint16_t id) {
  const std::vector<RfMode>& all = rf_modes();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const RfMode& mode) { return mode.id == id; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<double> power_table(double max_dbm) {
  std::vector<double> table;
  const double most = std::max(max_dbm, kUsualPower_dbm);
  for (double dbm = std::min(kMinPower_dbm, max_dbm); dbm <= most + 1e-9; dbm += kStep_db) {
    table.push_back(dbm);
  }
  return table;
}

std::uint16_t power_index_of(const std::vector<double>& table, double dbm) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (std::abs(table[i] - dbm) < std::abs(table[nearest] - dbm)) nearest = i;
  }
  return static_cast<std::uint16_t>(nearest + 1);
}

}  // namespace tagfield::llrp
