// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/inventory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

constexpr double kShares[] = {0.5, 0.95, 0.99};
constexpr std::size_t kMaxMoments = 200;
constexpr std::size_t kMaxLevels = 8;
constexpr double kSameLevel_m = 0.05;

constexpr std::size_t kNoZone = std::numeric_limits<std::size_t>::max();

/// The zone of a tag and its reads.
struct TagTally {
  std::size_t zone = kNoZone;
  double height_m = 0.0;
  double first_s = 0.0;
  std::size_t reads = 0;
  std::map<std::string, std::size_t> by_reader;
  std::set<std::string> antennas;
};

using Tallies = std::map<std::string, TagTally>;

/// One zone per reader, if there are several.
std::vector<ZoneSpec> zones_by_nearness(const std::vector<std::string>& readers) {
  std::vector<ZoneSpec> zones;
  if (readers.size() < 2) return zones;
  for (const std::string& reader : readers) zones.push_back({"near " + reader, {}, {reader}, {}});
  return zones;
}

/// The antenna that a tag has come nearest to.
struct NearestAntenna {
  double distance_m = std::numeric_limits<double>::infinity();
  std::size_t antenna = 0;

  void approach(const Scenario& scenario, const Eigen::Vector3d& p_WT) {
    for (std::size_t i = 0; i < scenario.antennas.size(); ++i) {
      const double distance = (scenario.antennas[i].X_PA.translation - p_WT).norm();
      if (!(distance < distance_m)) continue;
      distance_m = distance;
      antenna = i;
    }
  }
};

/// Number of the reader that each tag has come nearest to.
std::map<std::string, std::size_t> nearest_readers(const Scenario& scenario,
                                                   const std::vector<std::string>& groups,
                                                   const std::vector<std::string>& readers,
                                                   const std::vector<TagPosition>& positions) {
  std::map<std::string, NearestAntenna> nearest;
  for (const TagPosition& at : positions) nearest[at.tag].approach(scenario, at.p_WT);
  std::map<std::string, std::size_t> numbers;
  for (const auto& [tag, of_tag] : nearest) {
    const auto reader = std::find(readers.begin(), readers.end(), groups[of_tag.antenna]);
    numbers[tag] = static_cast<std::size_t>(reader - readers.begin());
  }
  return numbers;
}

/// Where each tag appeared.
std::map<std::string, Eigen::Vector3d> first_positions(const std::vector<TagPosition>& positions) {
  std::map<std::string, Eigen::Vector3d> first;
  for (const TagPosition& at : positions) first.try_emplace(at.tag, at.p_WT);
  return first;
}

class Tally {
 public:
  Tally(const Scenario& scenario, const Recording& recording)
      : groups_(reader_groups(scenario)), readers_(distinct(groups_)), zones_(scenario.zones) {
    const bool by_nearness = zones_.empty() && all_antennas_rest(scenario);
    if (by_nearness) zones_ = zones_by_nearness(readers_);
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      group_of_[scenario.antennas[i].parameters.name] = groups_[i];
    }
    const std::vector<TagPosition>& positions = recording.truth.tag_positions;
    for (const TagSpec& tag : scenario.tags) {
      tallies_[tag.id].height_m = tag.motion.front().X_WB.translation.z();
    }
    for (const auto& [id, p_WT] : first_positions(positions)) {
      const auto found = tallies_.find(id);
      if (found == tallies_.end()) continue;
      found->second.height_m = p_WT.z();
      if (!by_nearness) found->second.zone = zone_at(zones_, p_WT);
    }
    if (by_nearness && !zones_.empty()) {
      for (const auto& [id, zone] : nearest_readers(scenario, groups_, readers_, positions)) {
        const auto found = tallies_.find(id);
        if (found != tallies_.end()) found->second.zone = zone;
      }
    }
    for (const TagRead& read : recording.reads) add(read);
  }

  [[nodiscard]] InventorySummary summary(const Scenario& scenario, double duration_s) const;

 private:
  void add(const TagRead& read) {
    const auto found = tallies_.find(read.tag);
    if (found == tallies_.end()) return;
    TagTally& tag = found->second;
    if (tag.reads++ == 0) tag.first_s = to_seconds(read.stamp);
    tag.first_s = std::min(tag.first_s, to_seconds(read.stamp));
    const auto group = group_of_.find(read.antenna);
    ++tag.by_reader[group == group_of_.end() ? read.reader : group->second];
    tag.antennas.insert(read.antenna);
    ++reads_by_antenna_[read.antenna];
  }
  [[nodiscard]] std::vector<InventoryShare> shares_of_readers() const;
  [[nodiscard]] std::vector<InventoryShare> shares_of_antennas(const Scenario& scenario) const;
  [[nodiscard]] std::vector<ZoneInventory> by_zone() const;
  [[nodiscard]] std::vector<LevelInventory> by_level() const;
  void add_times(InventorySummary& summary) const;

  std::vector<std::string> groups_;
  std::vector<std::string> readers_;
  std::vector<ZoneSpec> zones_;
  std::map<std::string, std::string> group_of_;
  std::map<std::string, std::size_t> reads_by_antenna_;
  Tallies tallies_;
};

std::vector<InventoryShare> Tally::shares_of_readers() const {
  std::vector<InventoryShare> shares;
  for (const std::string& reader : readers_) {
    InventoryShare share{reader, reader};
    for (const auto& [id, tag] : tallies_) {
      const auto found = tag.by_reader.find(reader);
      if (found == tag.by_reader.end()) continue;
      share.tags += 1.0;
      share.reads += static_cast<double>(found->second);
      if (tag.by_reader.size() == 1) share.only += 1.0;
    }
    shares.push_back(share);
  }
  return shares;
}

std::vector<InventoryShare> Tally::shares_of_antennas(const Scenario& scenario) const {
  std::vector<InventoryShare> shares;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    InventoryShare share{scenario.antennas[i].parameters.name, groups_[i]};
    for (const auto& [id, tag] : tallies_) {
      if (tag.antennas.count(share.name) == 0) continue;
      share.tags += 1.0;
      if (tag.antennas.size() == 1) share.only += 1.0;
    }
    const auto reads = reads_by_antenna_.find(share.name);
    if (reads != reads_by_antenna_.end()) share.reads = static_cast<double>(reads->second);
    shares.push_back(share);
  }
  return shares;
}

void add_to_zone(const TagTally& tag, ZoneInventory& zone) {
  ++zone.tags;
  if (tag.reads > 0) zone.read += 1.0;
  bool is_own = false;
  bool is_crossed = false;
  for (const auto& [reader, reads] : tag.by_reader) {
    const auto meant = std::find(zone.readers.begin(), zone.readers.end(), reader);
    if (meant != zone.readers.end()) {
      is_own = true;
      continue;
    }
    is_crossed = true;
    for (CrossRead& cross : zone.cross) {
      if (cross.reader != reader) continue;
      cross.tags += 1.0;
      cross.reads += static_cast<double>(reads);
    }
  }
  if (is_own) zone.read_by_own += 1.0;
  if (is_crossed) zone.crossed += 1.0;
}

std::vector<ZoneInventory> Tally::by_zone() const {
  std::vector<ZoneInventory> all;
  for (const ZoneSpec& zone : zones_) {
    ZoneInventory row;
    row.zone = zone.name;
    row.readers = zone.readers;
    for (const std::string& reader : readers_) {
      const bool is_meant =
          std::find(zone.readers.begin(), zone.readers.end(), reader) != zone.readers.end();
      if (!is_meant) row.cross.push_back({reader});
    }
    all.push_back(row);
  }
  ZoneInventory elsewhere;
  elsewhere.zone = "elsewhere";
  for (const auto& [id, tag] : tallies_) {
    add_to_zone(tag, tag.zone < all.size() ? all[tag.zone] : elsewhere);
  }
  elsewhere.crossed = 0.0;  // Tags outside all zones are meant for whoever reads them.
  if (!all.empty() && elsewhere.tags > 0) all.push_back(elsewhere);
  return all;
}

/// Levels of a rack, or kMaxLevels equal ranges of height if the tags are on more levels than
/// that.
std::vector<LevelInventory> Tally::by_level() const {
  std::vector<double> heights;
  for (const auto& [id, tag] : tallies_) heights.push_back(tag.height_m);
  std::sort(heights.begin(), heights.end());
  std::vector<LevelInventory> levels;
  for (const double height : heights) {
    if (levels.empty() || height > levels.back().high_m + kSameLevel_m) {
      levels.push_back({height, height});
    }
    levels.back().high_m = height;
  }
  if (levels.size() > kMaxLevels) {
    const double low = heights.front();
    const double step = (heights.back() - low) / static_cast<double>(kMaxLevels);
    levels.clear();
    for (std::size_t i = 0; i < kMaxLevels; ++i) {
      const auto number = static_cast<double>(i);
      levels.push_back({low + number * step, low + (number + 1.0) * step});
    }
  }
  for (const auto& [id, tag] : tallies_) {
    const auto above =
        std::find_if(levels.begin(), levels.end(),
                     [&, z = tag.height_m](const auto& level) { return z <= level.high_m; });
    LevelInventory& level = above == levels.end() ? levels.back() : *above;
    ++level.tags;
    if (tag.reads > 0) level.read += 1.0;
  }
  return levels;
}

void Tally::add_times(InventorySummary& summary) const {
  std::vector<double> firsts;
  std::vector<double> counts;
  for (const auto& [id, tag] : tallies_) {
    summary.reads += static_cast<double>(tag.reads);
    if (tag.reads == 0) continue;
    firsts.push_back(tag.first_s);
    counts.push_back(static_cast<double>(tag.reads));
  }
  std::sort(firsts.begin(), firsts.end());
  std::sort(counts.begin(), counts.end());
  summary.read = static_cast<double>(firsts.size());
  summary.min_read = summary.max_read = summary.read;
  if (!counts.empty()) {
    const std::size_t middle = counts.size() / 2;
    summary.median_reads =
        counts.size() % 2 == 1 ? counts[middle] : 0.5 * (counts[middle - 1] + counts[middle]);
  }
  const auto all = static_cast<double>(tallies_.size());
  for (const double share : kShares) {
    const auto needed = static_cast<std::size_t>(std::ceil(share * all - 1e-9));
    ReachedShare& reached = summary.reached.emplace_back();
    reached.share = share;
    if (needed > 0 && needed <= firsts.size()) reached.time_s = firsts[needed - 1];
  }
  const std::size_t step = std::max<std::size_t>(1, firsts.size() / kMaxMoments);
  for (std::size_t i = 0; i < firsts.size(); i += step) {
    summary.curve.push_back({firsts[i], static_cast<double>(i + 1) / all});
  }
  if (!firsts.empty()) summary.curve.push_back({firsts.back(), summary.read / all});
}

InventorySummary Tally::summary(const Scenario& scenario, double duration_s) const {
  InventorySummary summary;
  summary.tags = tallies_.size();
  summary.duration_s = duration_s;
  add_times(summary);
  summary.readers = shares_of_readers();
  summary.antennas = shares_of_antennas(scenario);
  summary.zones = by_zone();
  summary.levels = by_level();
  return summary;
}

}  // namespace

bool all_antennas_rest(const Scenario& scenario) {
  return std::all_of(
      scenario.antennas.begin(), scenario.antennas.end(), [](const AntennaSpec& antenna) {
        return antenna.on.empty() && antenna.lift.travel_m == 0.0 && antenna.recorded.size() < 2;
      });
}

std::string why_inventory_alone(const Scenario& scenario) {
  const std::string& method = scenario.localization.method;
  if (method == kNoLocalization) return "the scenario asks for no localization";
  if (!is_by_phase(method) || !all_antennas_rest(scenario)) return "";
  return fmt::format("all antennas stand still, and '{}' needs one that moves", method);
}

InventorySummary inventory_of(const Scenario& scenario, const Recording& recording,
                              double duration_s) {
  return Tally(scenario, recording).summary(scenario, duration_s);
}

}  // namespace tagfield
