// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/number_checks.h"
#include "apps/tagfield/output_file.h"
#include "tagfield/calibration/calibration.h"
#include "tagfield/calibration/carry_over.h"
#include "tagfield/files/files.h"
#include "tagfield/files/tag_positions_csv.h"
#include "tagfield/localization/problem.h"
#include "tagfield/scenario/calibration_profile.h"

namespace tagfield {
namespace {

struct CalibrateArguments {
  std::vector<std::string> reads;  ///< Of one or several experiments,
  std::vector<std::string> poses;  ///< each with its own poses, or all with the same,
  std::string format;              ///< Format of third-party tables, or "".
  std::vector<std::string> tags;   ///< and similarly for tags at known positions.
  std::string out;
  CalibrationOptions options;
  bool as_json = false;
  bool force = false;
  int threads = default_threads();
};

std::string figure(const char* what, const CalibratedValue& value, double scale, const char* unit) {
  if (!value.observable) {
    return fmt::format("  {:<12} not observable: left at {:.1f} {}\n", what, scale * value.value,
                       unit);
  }
  return fmt::format("  {:<12} {:8.2f} ± {:.2f} {}\n", what, scale * value.value,
                     scale * value.sigma, unit);
}

std::string table_of(const Calibration& calibration) {
  std::string text;
  for (const auto& [name, antenna] : calibration.antennas) {
    text +=
        fmt::format("{}: {} reads, phase {} with distance, noise {:.3f} rad\n", name, antenna.reads,
                    antenna.phase_sign > 0 ? "grows" : "falls", antenna.noise_rad);
    for (int i = 0; i < 3; ++i) {
      const char* const names[] = {"position x", "position y", "position z"};
      text += figure(names[i], antenna.phase_centre_m[i], 1e3, "mm");
    }
    text += figure("late by", antenna.time_offset_s, 1e3, "ms");
    for (const ChannelOffset& offset : antenna.offsets) {
      text += fmt::format("  offset at {:.3f} MHz {:.3f} ± {:.3f} rad\n",
                          1e-6 * offset.frequency_hz, offset.value_rad, offset.sigma_rad);
    }
    if (antenna.offsets.empty()) {
      text += fmt::format("  no offsets: those of the tags scatter by {:.2f} rad\n",
                          antenna.tag_scatter_rad);
    }
  }
  return text;
}

nlohmann::ordered_json json_of(const CalibratedValue& value) {
  return {{"value", value.value}, {"sigma", value.sigma}, {"observable", value.observable}};
}

std::string to_json(const Calibration& calibration) {
  nlohmann::ordered_json json = {{"name", calibration.name},
                                 {"pi_ambiguity", calibration.pi_ambiguity},
                                 {"antennas", nlohmann::ordered_json::object()}};
  for (const auto& [name, antenna] : calibration.antennas) {
    nlohmann::ordered_json& one = json["antennas"][name];
    one = {{"reads", antenna.reads},
           {"phase_sign", antenna.phase_sign},
           {"phase_centre_m", nlohmann::ordered_json::array()},
           {"time_offset_s", json_of(antenna.time_offset_s)},
           {"noise_rad", antenna.noise_rad},
           {"tag_scatter_rad", antenna.tag_scatter_rad},
           {"offsets", nlohmann::ordered_json::array()}};
    for (const CalibratedValue& place : antenna.phase_centre_m)
      one["phase_centre_m"].push_back(json_of(place));
    for (const ChannelOffset& offset : antenna.offsets) {
      one["offsets"].push_back({{"frequency_hz", offset.frequency_hz},
                                {"value_rad", offset.value_rad},
                                {"sigma_rad", offset.sigma_rad},
                                {"reads", offset.reads}});
    }
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// The value for an experiment, or the one for all; "" if none is given.
std::string of_experiment(const std::vector<std::string>& all, std::size_t number,
                          std::size_t experiments, const char* option) {
  if (all.empty()) return "";
  if (all.size() == 1) return all.front();
  if (all.size() == experiments) return all[number];
  throw Error(
      fmt::format("calibrate: {} is given {} times, expected once or once for each of the {} "
                  "READS",
                  option, all.size(), experiments));
}

Calibration calibration_of(const CalibrateArguments& arguments, std::size_t number,
                           Diagnostics& diagnostics) {
  const std::size_t count = arguments.reads.size();
  const std::string& file = arguments.reads[number];
  const std::string poses_file = of_experiment(arguments.poses, number, count, "--poses");
  const std::string tags_file = of_experiment(arguments.tags, number, count, "--tags");
  const auto [reads, poses] =
      read_tables({"calibrate", file, poses_file, arguments.format}, diagnostics);
  const auto tags = read_tag_positions_csv(tags_file);
  if (!has_phases(reads)) fail({file, 0}, "the reads have no phases, or all the same one");
  Calibration calibration =
      calibrate(reads, poses, tags, arguments.options, arguments.threads, diagnostics);
  if (calibration.antennas.empty()) {
    print_warnings(diagnostics);
    fail({file, 0}, "nothing to calibrate by: expected at least 30 reads of the tags in " +
                        tags_file + " by an antenna in " +
                        (poses_file.empty() ? file : poses_file) +
                        " whose phases follow their distances");
  }
  return calibration;
}

/// The combined calibration of all experiments.
Calibration calibration_of_all(const CalibrateArguments& arguments, Diagnostics& diagnostics) {
  std::vector<Calibration> experiments;
  for (std::size_t i = 0; i < arguments.reads.size(); ++i) {
    experiments.push_back(calibration_of(arguments, i, diagnostics));
  }
  if (experiments.size() == 1) return experiments.front();
  Calibration carried = carried_over(experiments, diagnostics);
  if (!carried.antennas.empty()) return carried;
  print_warnings(diagnostics);
  throw Error(fmt::format(
      "calibrate: nothing that these {} experiments yield carries over from one to another: a "
      "calibration by them would not improve the next, so no profile is written",
      experiments.size()));
}

/// All files that the profile must not replace.
std::vector<std::string> inputs_of(const CalibrateArguments& arguments) {
  std::vector<std::string> inputs = arguments.poses;
  inputs.insert(inputs.end(), arguments.tags.begin(), arguments.tags.end());
  inputs.insert(inputs.end(), arguments.reads.begin(), arguments.reads.end());
  return inputs;
}

int calibrate_command(const CalibrateArguments& arguments) {
  require_replaceable({"--out", arguments.out, "a profile of a calibration", {"kind: calibration"}},
                      inputs_of(arguments), arguments.force);
  if (arguments.reads.size() == 2) {
    throw Error(
        "calibrate: two experiments do not show what carries over: expected one READS, "
        "or three or more");
  }
  Diagnostics diagnostics;
  Calibration calibration = calibration_of_all(arguments, diagnostics);
  print_warnings(diagnostics);
  calibration.name =
      "calibration by " + std::filesystem::path(arguments.reads.front()).filename().string() +
      (arguments.reads.size() > 1 ? fmt::format(" and {} more", arguments.reads.size() - 1) : "");
  catch_interrupts();  // The rest takes only a moment, and no incomplete files remain.
  write_text_file(arguments.out, to_yaml(calibration));
  if (arguments.as_json) {
    fmt::print("{}", to_json(calibration));
  } else {
    fmt::print("{}profile: {}\n", table_of(calibration), arguments.out);
  }
  return kExitOk;
}

}  // namespace

void add_calibrate_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = app.add_subcommand(
      "calibrate",
      "Find antennas' phase centres, latency, phase offsets, noise from tags at known positions");
  command
      ->add_option("READS", arguments->reads,
                   "CSV: stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm. With several "
                   "experiments (three or more) it keeps what carries over from each to the others")
      ->required();
  command
      ->add_option("--poses", arguments->poses,
                   "The antennas' believed poses (CSV: stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw); "
                   "for several experiments once for each, or one for all")
      ->take_all()
      ->allow_extra_args(false);
  add_format_option(*command, arguments->format);
  command
      ->add_option(
          "--tags", arguments->tags,
          "Tags at known positions (CSV: tag,x_m,y_m,z_m); for several experiments likewise")
      ->required()
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--out", arguments->out, "Profile to write (YAML)")->required();
  add_force_option(*command, arguments->force);
  command
      ->add_option(
          "--phase-centre-sigma", arguments->options.phase_centre_sigma_m,
          "How far off each component of an antenna's position may be, one sigma [m] (default 0.1)")
      ->check(fault_of_positive);
  command
      ->add_option("--time-sigma", arguments->options.time_offset_sigma_s,
                   "How late or early stamps may be, one sigma [s] (default 0.05)")
      ->check(fault_of_positive);
  add_json_option(*command, arguments->as_json, "the values of the profile");
  command->add_option("--threads", arguments->threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->footer(
      "Drive past five or more tags at measured positions, along curves and at a varying speed:\n"
      "what such a drive does not determine is left as it was, with a warning. Then\n"
      "  tagfield localize reads.csv --poses poses.csv --calibration PROFILE.yaml");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return calibrate_command(*arguments); }; });
}

}  // namespace tagfield
