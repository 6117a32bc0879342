#include "simulator/placements.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "tagfield/base/number.h"
#include "tagfield/base/spelling.h"

namespace tagfield {
namespace {

double number_of(const RawParameter& parameter, const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value) {
    fail(parameter.location, fmt::format("<{}> is '{}', expected a number", parameter.key, text));
  }
  return *value;
}

std::vector<double> numbers_of(const RawParameter& parameter) {
  std::vector<double> numbers;
  std::istringstream words(parameter.value);
  for (std::string word; words >> word;) numbers.push_back(number_of(parameter, word));
  return numbers;
}

/// The published defaults, which differ from a scenario's.
AntennaParameters published_defaults() {
  AntennaParameters antenna;
  antenna.range_m = 5.0;
  antenna.model.rssi_noise = 0.005;
  antenna.model.communication_gain = 250.0;
  return antenna;
}

struct Setting {
  const char* key;
  double& (*field)(AntennaParameters&);
};

const std::array<Setting, 6>& settings() {
  static const std::array<Setting, 6> all = {{
      {"frequency", [](AntennaParameters& a) -> double& { return a.model.frequency_hz; }},
      {"noisephi", [](AntennaParameters& a) -> double& { return a.model.phase_noise_rad; }},
      {"noiserssi", [](AntennaParameters& a) -> double& { return a.model.rssi_noise; }},
      {"range", [](AntennaParameters& a) -> double& { return a.range_m; }},
      {"communication_gain",
       [](AntennaParameters& a) -> double& { return a.model.communication_gain; }},
      {"update_rate", [](AntennaParameters& a) -> double& { return a.rate_hz; }},
  }};
  return all;
}

const RawParameter* find(const Placement& placement, const std::string& key) {
  const auto found = std::find_if(placement.parameters.begin(), placement.parameters.end(),
                                  [&](const RawParameter& p) { return p.key == key; });
  return found == placement.parameters.end() ? nullptr : &*found;
}

void set_distribution(const Placement& placement, PaperModel& model) {
  const RawParameter* name = find(placement, "optional_distribution");
  if (name == nullptr || name->value == "none" || name->value.empty()) return;
  const RawParameter* parameters = find(placement, "optional_distribution_params");
  try {
    model.optional = make_distribution(
        name->value, parameters == nullptr ? std::vector<double>{} : numbers_of(*parameters));
  } catch (const Error& error) {
    fail(name->location, error.what());
  }
}

void warn_of_unknown(const Placement& placement, Diagnostics& diagnostics) {
  std::vector<std::string> known = {"optional_distribution", "optional_distribution_params"};
  for (const Setting& setting : settings()) known.emplace_back(setting.key);
  for (const RawParameter& parameter : placement.parameters) {
    if (std::find(known.begin(), known.end(), parameter.key) == known.end()) {
      diagnostics.warn(parameter.location,
                       fmt::format("<{}> is not known and left out{}", parameter.key,
                                   suggestion(parameter.key, known)));
    }
  }
}

AntennaSpec antenna_of(const Placement& placement, Diagnostics& diagnostics) {
  AntennaSpec antenna;
  antenna.parameters = published_defaults();
  antenna.parameters.name = placement.name;
  antenna.parameters.reader = placement.name;
  antenna.X_PA = placement.X_WS;
  antenna.location = placement.location;
  for (const Setting& setting : settings()) {
    double& field = setting.field(antenna.parameters);
    const RawParameter* given = find(placement, setting.key);
    if (given != nullptr) {
      field = number_of(*given, given->value);
    } else {
      diagnostics.warn(placement.location, fmt::format("antenna '{}' has no <{}>: taken as {}",
                                                       placement.name, setting.key, field));
    }
  }
  set_distribution(placement, antenna.parameters.model);
  warn_of_unknown(placement, diagnostics);
  try {
    check(antenna.parameters);
  } catch (const Error& error) {
    fail(placement.location, fmt::format("antenna '{}': {}", placement.name, error.what()));
  }
  return antenna;
}

}  // namespace

void add_placements(const Scene& scene, Scenario& scenario, Diagnostics& diagnostics) {
  for (const Placement& placement : scene.antennas) {
    scenario.antennas.push_back(antenna_of(placement, diagnostics));
  }
  for (const Placement& placement : scene.tags) {
    TagSpec tag;
    tag.id = placement.name;
    tag.motion = {{Time{}, placement.X_WS}};
    tag.location = placement.location;
    scenario.tags.push_back(std::move(tag));
  }
}

}  // namespace tagfield
