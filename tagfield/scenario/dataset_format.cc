// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/dataset_format.h"

#include "tagfield/base/units.h"
#include "tagfield/reader/channel_plan.h"
#include "tagfield/scenario/yaml_map.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

/// A column by name, or by number if there is no header.
std::string column_of(YamlMap& map, const std::string& key = "column") {
  return map.at(key).text();
}

CsvForm csv_of(YamlMap map) {
  CsvForm form;
  const std::string delimiter = map.text("delimiter", ",");
  constexpr char kCharacters[] = {',', ';', '\t'};
  if (map.has("delimiter")) {
    if (delimiter.size() == 1) {
      form.delimiter = delimiter[0];
    } else {
      form.delimiter = kCharacters[choice(map.at("delimiter"), {"comma", "semicolon", "tab"})];
    }
  }
  form.header = map.boolean("header", true);
  map.finish();
  return form;
}

StampForm stamp_of(YamlMap map) {
  StampForm form;
  if (map.has("column")) {
    form.column = column_of(map);
    constexpr double kSeconds[] = {1.0, 1e-3, 1e-6, 1e-9, 1.0};
    const std::size_t unit =
        map.has("unit") ? choice(map.at("unit"), {"s", "ms", "us", "ns", "iso"}) : 0;
    form.seconds = kSeconds[unit];
    form.iso = unit == 4;
  } else {
    form.rows_apart_s = map.at("rows_apart_s").number(NumberRange::kPositive);
  }
  map.finish();
  return form;
}

AntennaForm antenna_form(YamlMap map) {
  AntennaForm form;
  if (map.has("column")) {
    form.column = column_of(map);
  } else {
    form.name = map.at("name").text();
  }
  map.finish();
  return form;
}

PositionForm position_of_rows(YamlMap map) {
  PositionForm form;
  const YamlValue columns = map.at("columns");
  const std::vector<YamlValue> list = columns.list();
  if (list.size() < 2 || list.size() > 3) columns.fail("must name the columns of x, y and maybe z");
  for (std::size_t i = 0; i < list.size(); ++i) form.columns[i] = list[i].text();
  constexpr double kMetres[] = {1.0, 0.01, 0.001};
  if (map.has("unit")) form.metres = kMetres[choice(map.at("unit"), {"m", "cm", "mm"})];
  if (list.size() == 2) form.z_m = map.at("z_m").number();
  map.finish();
  return form;
}

PhaseForm phase_of(YamlMap map) {
  PhaseForm form;
  form.column = column_of(map);
  const double units[] = {1.0, radians(1.0), kTwoPi / 4096.0};
  form.radians = units[choice(map.at("unit"), {"radians", "degrees", "steps_4096"})];
  form.falls = map.boolean("falls_with_distance", false);
  map.finish();
  return form;
}

std::vector<double> carriers_of(const YamlValue& channels) {
  std::vector<double> carriers_hz = channels.numbers(1);
  for (const double hertz : carriers_hz) {
    if (!(hertz > 0.0)) channels.fail("must be over 0");
  }
  return carriers_hz;
}

/// A region's channels by name.
std::vector<double> plan_of(const YamlValue& name) {
  try {
    return known_plan(name.text()).carriers_hz;
  } catch (const Error& error) {
    name.fail(error.what());
  }
}

FrequencyForm frequency_of(YamlMap map) {
  FrequencyForm form;
  if (!map.has("column")) {
    form.hertz = map.at("hz").number(NumberRange::kPositive);
  } else if (map.has("channels_hz") || map.has("channels")) {
    form.column = column_of(map);
    form.channels_hz =
        map.has("channels") ? plan_of(map.at("channels")) : carriers_of(map.at("channels_hz"));
    form.first_channel =
        static_cast<int>(map.number("first_channel", 1.0, NumberRange::kNotNegative));
  } else {
    form.column = column_of(map);
    constexpr double kHertz[] = {1.0, 1e3, 1e6};
    form.hertz = kHertz[choice(map.at("unit"), {"hz", "khz", "mhz"})];
  }
  map.finish();
  return form;
}

PoseTableForm pose_table_of(YamlMap map) {
  PoseTableForm form;
  if (map.has("table")) form.csv = csv_of(YamlMap(map.at("table")));
  form.stamp = stamp_of(YamlMap(map.at("stamp")));
  form.antenna = antenna_form(YamlMap(map.at("antenna")));
  form.position = position_of_rows(YamlMap(map.at("position")));
  map.finish();
  return form;
}

std::map<std::string, Eigen::Vector3d> standing_antennas(const YamlValue& value) {
  std::map<std::string, Eigen::Vector3d> antennas;
  YamlMap map(value);
  for (const auto& entry : value.node()) {
    const auto name = entry.first.as<std::string>();
    antennas[name] = position_of(map.at(name));
  }
  return antennas;
}

void read_places(YamlMap& map, DatasetForm& form) {
  if (map.has("position")) form.position = position_of_rows(YamlMap(map.at("position")));
  if (map.has("poses")) form.poses = pose_table_of(YamlMap(map.at("poses")));
  if (map.has("antennas")) form.antennas = standing_antennas(map.at("antennas"));
  if (form.position && form.poses) map.self().fail("has both 'position' and 'poses'");
}

}  // namespace

DatasetForm read_dataset_form(const std::string& path) {
  const YAML::Node root = read_yaml(path);
  YamlMap map(YamlValue(root, path, ""));
  static_cast<void>(map.text("name", ""));
  static_cast<void>(map.text("description", ""));
  DatasetForm form;
  if (map.has("table")) form.csv = csv_of(YamlMap(map.at("table")));
  form.stamp = stamp_of(YamlMap(map.at("stamp")));
  YamlMap tag(map.at("tag"));
  form.tag_column = column_of(tag);
  tag.finish();
  form.antenna = antenna_form(YamlMap(map.at("antenna")));
  if (map.has("phase")) form.phase = phase_of(YamlMap(map.at("phase")));
  if (map.has("rssi")) {
    YamlMap rssi(map.at("rssi"));
    form.rssi_column = column_of(rssi);
    constexpr double kDecibels[] = {1.0, 0.01};
    if (rssi.has("unit")) form.decibels = kDecibels[choice(rssi.at("unit"), {"dbm", "cdbm"})];
    rssi.finish();
  }
  form.frequency = frequency_of(YamlMap(map.at("frequency")));
  read_places(map, form);
  map.finish();
  return form;
}

}  // namespace tagfield
