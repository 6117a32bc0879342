// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/localize.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string_view>

#include "adapters/bags/bag_recording.h"
#include "adapters/http/run_json.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/localize_files.h"
#include "apps/tagfield/localize_known.h"
#include "apps/tagfield/method_text.h"
#include "apps/tagfield/odd_tables.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/recording.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/table.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/experiment/experiment.h"
#include "tagfield/experiment/judge.h"
#include "tagfield/files/files.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/report/method_summary.h"
#include "tagfield/report/page.h"
#include "tagfield/report/summary.h"
#include "tagfield/scenario/calibration_profile.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

std::optional<ScenarioWithWorld> scenario_of(const LocalizeArguments& arguments,
                                             Diagnostics& diagnostics) {
  if (arguments.scenario.empty()) return std::nullopt;
  return load_scenario_with_world(arguments.scenario, {}, diagnostics, arguments.world);
}

const Scenario* scenario_in(const std::optional<ScenarioWithWorld>& loaded) {
  return loaded ? &loaded->scenario : nullptr;
}

/// Settings of the method from the command line.
MethodSettings settings_of(const LocalizeArguments& arguments) {
  MethodSettings settings;
  for (const std::string& argument : arguments.settings) {
    auto [key, value] = parse_override(argument);
    // The setting's name in a scenario, which --set of other commands uses.
    constexpr std::string_view kSection = "localization.";
    if (key.rfind(kSection, 0) == 0) key.erase(0, kSection.size());
    settings.push_back({key, value, {"--set", 0}});
  }
  return settings;
}

/// Options of the scenario, overridden by the command line; for poses of that name.
LocalizationOptions options_of(const LocalizeArguments& arguments,
                               const std::optional<ScenarioWithWorld>& loaded,
                               const ReadOverview& reads, const std::string& poses) {
  LocalizationOptions options;
  options.method = "auto";
  if (loaded) options = localization_options(loaded->scenario, arguments.threads);
  options.threads = arguments.threads;
  if (!arguments.method.empty()) options.method = arguments.method;
  const MethodSettings given = settings_of(arguments);
  options.settings.insert(options.settings.end(), given.begin(), given.end());
  const Method method = find_method(options.methods, options.method);
  refuse_unused(given, {method}, options.methods);
  configured(method, given);
  take_known(arguments, reads, options.known);
  options.known.pose_error = pose_error_of(arguments, scenario_in(loaded), poses);
  options.known.map_error = map_error_of(arguments, poses);
  if (poses != "given" && poses != "odometry") options.known.drift = {};
  options.known.world_sigma_m = world_sigma_of(arguments, options.method, options.known);
  return options;
}

/// The scenario's order of the tags; of a run's folder that of the estimates, as for its tables.
std::vector<std::string> order_of(const LocalizeArguments& arguments,
                                  const std::optional<ScenarioWithWorld>& loaded,
                                  const std::vector<TagEstimate>& estimates) {
  if (loaded) return tags_of(loaded->scenario);
  std::vector<std::string> tags;
  if (!is_run(arguments.recording)) return tags;
  for (const TagEstimate& estimate : estimates) tags.push_back(estimate.tag);
  return tags;
}

std::vector<TagOutcome> outcomes_of(const LoadedRecording& recording,
                                    const LocalizationOptions& options,
                                    const std::vector<TagEstimate>& estimates) {
  return judged_by_counts(estimates, recording.overview.count_by_tag, recording.truth,
                          options.known.reference_tags);
}

/// The same reads localized by the scenario's other methods, after `summary`'s own; empty if there
/// are none.
std::vector<MethodSummary> compared_methods(const LoadedRecording& recording,
                                            const std::optional<ScenarioWithWorld>& loaded,
                                            LocalizationOptions options, const Summary& summary,
                                            const std::vector<std::string>& order) {
  if (!loaded || loaded->scenario.localization.compare.empty() || recording.stored) return {};
  const bool believed = recording.poses.name != "true";
  std::vector<MethodSummary> methods = {summary_of_method(summary.method, summary.tags, believed)};
  for (const std::string& name : loaded->scenario.localization.compare) {
    options.method = name;
    Diagnostics unheard;  // The first method has reported all warnings.
    const LocalizationResult result =
        locate_tags(reads_of(recording), recording.poses.poses, options, unheard);
    const bool is_new = std::none_of(methods.begin(), methods.end(), [&](const MethodSummary& of) {
      return of.method == result.method;
    });
    if (!is_new) continue;
    const auto estimates = with_all_tags(result.estimates, recording.truth, order);
    methods.push_back(
        summary_of_method(result.method, outcomes_of(recording, options, estimates), believed));
  }
  return methods;
}

/// The same reads localized with the other poses.
std::optional<ComparedPose> compared(const LoadedRecording& recording,
                                     const LocalizationOptions& options,
                                     const std::vector<std::string>& order) {
  if (recording.other.poses.empty()) return std::nullopt;
  Diagnostics of_other;  // Would be mistaken for warnings about the run's own poses.
  const std::vector<TagEstimate> estimates = with_all_tags(
      locate_tags(reads_of(recording), recording.other.poses, options, of_other).estimates,
      recording.truth, order);
  Summary summary;
  summary.tags = outcomes_of(recording, options, estimates);
  ComparedPose result;
  result.pose = recording.other.name;
  result.position_rms_m = position_rms(recording.other.poses, recording.poses.poses).value_or(0.0);
  result.error_m = error_statistics(summary);
  result.located = count(summary, Verdict::kLocated);
  return result;
}

Summary summary_of(const LocalizeArguments& arguments, const LoadedRecording& recording,
                   const std::optional<ScenarioWithWorld>& loaded,
                   const LocalizationOptions& options, const LocalizationResult& result) {
  Summary summary;
  summary.scenario = loaded ? loaded->scenario.name : arguments.recording;
  if (loaded) summary.description = loaded->scenario.description;
  summary.method = result.method;
  summary.method_asked = options.method;
  summary.method_why = result.why;
  summary.pose = recording.poses.name;
  summary.path_length_m = recording.path_length_m;
  summary.reads = recording.overview.count;
  summary.simulated_s = recording.duration_s;
  summary.tags = outcomes_of(recording, options, result.estimates);
  return summary;
}

/// Whether the reads belong to the run in the folder, whose truth and world then apply to them.
bool is_of_this_run(const LocalizeArguments& arguments, const std::string& out) {
  fs::path of_reads = fs::weakly_canonical(arguments.recording);
  if (!is_folder(of_reads)) of_reads = of_reads.parent_path();
  return of_reads == fs::weakly_canonical(out) && !is_bag(arguments.recording);
}

/// A run's folder states what its localization knew, which is used unless the command line or a
/// scenario says otherwise.
LocalizeArguments with_what_run_knew(LocalizeArguments arguments) {
  if (!is_run(arguments.recording)) return arguments;
  const auto file_of_run = [&](const char* name) {
    const fs::path file = fs::path(arguments.recording) / name;
    return is_there(file) ? file.string() : std::string();
  };
  if (arguments.odometry_file.empty() && !arguments.pose_sigma_m) {
    arguments.odometry_file = file_of_run("odometry.csv");
  }
  if (!arguments.scenario.empty()) return arguments;
  const bool states_heights = arguments.tag_height_m || !arguments.heights_file.empty() ||
                              !arguments.height_side.empty() || !arguments.old_height_side.empty();
  if (!states_heights) arguments.heights_file = file_of_run("tag_heights.csv");
  if (arguments.references_file.empty()) {
    arguments.references_file = file_of_run("reference_tags.csv");
  }
  return arguments;
}

/// Whether the recording is of a run whose poses are wheel odometry.
bool is_by_wheels(const LoadedRecording& recording, const std::string& path) {
  if (recording.poses.name == "odometry") return true;
  const fs::path summary = fs::path(path) / "summary.json";
  if (!is_run(path) || !is_file(summary)) return false;
  try {
    const std::string text = read_text_file(summary.string());
    return summary_from_json(text, summary.string()).pose == "odometry";
  } catch (const Error&) {
    return false;  // Nothing else of the summary is used.
  }
}

/// "known: runs/a/tag_heights.csv, and the truth to judge by": what was taken from a run's folder.
std::string line_of_run(const LocalizeArguments& arguments, bool has_truth) {
  if (!is_run(arguments.recording)) return "";
  std::vector<std::string> used;
  for (const std::string& file :
       {arguments.heights_file, arguments.references_file, arguments.odometry_file}) {
    if (!file.empty()) used.push_back(file);
  }
  std::string line =
      used.empty() ? "" : fmt::format("known beforehand: {}\n", fmt::join(used, ", "));
  if (has_truth) line += fmt::format("judged by: {}/truth\n", arguments.recording);
  return line;
}

std::string folder_of(const LocalizeArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  if (!is_bag(arguments.recording)) return "runs/localized";
  fs::path path = arguments.recording;
  if (is_folder(path)) path = fs::canonical(path);
  return "runs/" + path.stem().string();
}

void refuse_unknown_method(const std::string& method) {
  if (method.empty()) return;
  try {
    find_method(built_in_methods(), method);
  } catch (const Error& error) {
    throw Error(fmt::format("localize: --method: {}", error.what()));
  }
}

/// Tags at known positions, from the command line or the scenario.
std::set<std::string> references_of(const LocalizeArguments& arguments,
                                    const std::optional<ScenarioWithWorld>& loaded) {
  std::map<std::string, Eigen::Vector3d> places;
  if (!arguments.references_file.empty()) {
    places = arguments.tables.references;
  } else if (loaded) {
    places = localization_options(loaded->scenario, 1).known.reference_tags;
  }
  std::set<std::string> tags;
  for (const auto& [tag, place] : places) tags.insert(tag);
  return tags;
}

/// The recording, with warnings of suspicious contents.
LoadedRecording recording_of(const LocalizeArguments& arguments, const std::string& out,
                             const std::set<std::string>& references, Diagnostics& diagnostics) {
  // A calibration modifies them.
  const bool keep = !arguments.calibration.empty();
  if (is_bag(arguments.recording)) {
    if (!arguments.format.empty()) throw Error("localize: --format can only be used with CSV");
    return bag_recording(
        {"localize", arguments.recording, arguments.poses, arguments.ros, arguments.part_reads},
        out, references, keep, diagnostics);
  }
  refuse_ros_options("localize", arguments.ros);
  LoadedRecording recording = csv_recording(arguments, out, references, keep, diagnostics);
  warn_of_odd_reads(arguments.recording, recording.overview, diagnostics);
  warn_of_odd_poses(arguments.poses, recording.poses.poses, diagnostics);
  return recording;
}

/// Reports early if the folder is not writable. SIGINT and SIGTERM, which end the program while it
/// computes, are blocked until the traces of this test are removed.
void try_folder(const std::string& out) {
  sigset_t ending{};
  sigset_t before{};
  (void)::sigemptyset(&ending);
  (void)::sigaddset(&ending, SIGINT);
  (void)::sigaddset(&ending, SIGTERM);
  (void)::pthread_sigmask(SIG_BLOCK, &ending, &before);
  const std::shared_ptr<void> restored(
      nullptr, [&before](void*) { (void)::pthread_sigmask(SIG_SETMASK, &before, nullptr); });
  const StagedFolder tried(out);
}

bool tell_orientation(const std::vector<AntennaPose>& poses) {
  Diagnostics unheard;
  const auto tracks = tracks_of(poses, unheard);
  return std::any_of(tracks.begin(), tracks.end(),
                     [](const auto& track) { return is_orientation_known(track.second); });
}

void warn_of_what_is_missing(const LocalizeArguments& arguments, const LoadedRecording& recording,
                             const KnownBeforehand& known, Diagnostics& diagnostics) {
  if (!known.drift && !known.pose_error && is_by_wheels(recording, arguments.recording)) {
    diagnostics.warn(
        "the poses are wheel odometry: what they are off by as a whole, since the start, is not in "
        "the expected errors");
  }
  if (!arguments.circular.empty() && !tell_orientation(recording.poses.poses)) {
    diagnostics.warn(
        "--circular has no effect: the poses don't state the antennas' orientation (all are "
        "unrotated)");
  }
  if (recording.overview.count == 0) {
    diagnostics.warn({arguments.recording, 0}, "no reads: cannot localize anything");
  }
}

}  // namespace

LocalizationResult located_with_progress(const LoadedRecording& recording,
                                         const std::optional<Calibration>& calibration,
                                         LocalizationOptions options, Diagnostics& diagnostics) {
  StageBars bars;
  options.on_locating = [&bars](const std::string& what, double share) {
    bars.show("locating " + what, share);
  };
  if (!recording.stored) {
    return locate_tags(reads_of(recording), recording.poses.poses, options, diagnostics);
  }
  return locate_in_parts(parts_of(*recording.stored, calibration), recording.poses.poses, options,
                         diagnostics);
}

int localize(const LocalizeArguments& asked) {
  refuse_unknown_method(asked.method);
  LocalizeArguments arguments = with_what_run_knew(asked);
  arguments.tables = known_tables(arguments);
  Diagnostics diagnostics;
  if (!arguments.old_height_side.empty()) {
    diagnostics.warn("--height " + arguments.old_height_side + " is --vertical-side " +
                     arguments.old_height_side + " now");
  }
  const auto loaded = scenario_of(arguments, diagnostics);
  const std::string out = folder_of(arguments);
  LoadedRecording recording =
      recording_of(arguments, out, references_of(arguments, loaded), diagnostics);
  LocalizationOptions options =
      options_of(arguments, loaded, recording.overview, recording.poses.name);
  warn_of_unread_tags(asked, arguments.tables, recording.overview, diagnostics);
  warn_of_unused_options(arguments, find_method(options.methods, options.method),
                         recording.poses.name, diagnostics);
  warn_of_what_is_missing(arguments, recording, options.known, diagnostics);
  const std::optional<Calibration> calibration =
      arguments.calibration.empty() ? std::nullopt
                                    : std::optional(read_calibration(arguments.calibration));
  if (calibration) {
    apply_calibration(*calibration, recording.reads, recording.poses.poses, options.known);
  }
  if (!loaded || !options.known.heights.of_tag.empty()) {
    warn_of_unknown_heights(options.known, recording.overview.tags, diagnostics);
  }
  try_folder(out);
  LocalizationResult result = located_with_progress(recording, calibration, options, diagnostics);
  const std::vector<std::string> order = order_of(arguments, loaded, result.estimates);
  result.estimates = with_all_tags(std::move(result.estimates), recording.truth, order);
  Summary summary = summary_of(arguments, recording, loaded, options, result);
  summary.compared_pose = compared(
      recording, options_of(arguments, loaded, recording.overview, recording.other.name), order);
  if (recording.stored && loaded && !loaded->scenario.localization.compare.empty()) {
    diagnostics.warn("localization.compare has no effect where reads are located in parts");
  }
  summary.compared_methods = compared_methods(recording, loaded, options, summary, order);
  summary.warnings = diagnostics.warnings();
  print_warnings(diagnostics);
  catch_interrupts();  // The rest takes only a moment, unless reads don't fit in memory, and no
                       // incomplete files remain.
  StagedFolder folder(out);
  stage_localization(recording, loaded, options, result, arguments.tables.odometry, folder);
  const bool in_parts = recording.stored.has_value();
  if (in_parts && interrupted()) return kExitInterrupted;
  folder.add("summary.json", to_json(summary));
  const ReadOverview overview = std::move(recording.overview);
  const std::string of_run = line_of_run(arguments, !is_empty(recording.truth));
  recording = {};  // Frees its memory for the page.
  if (!loaded && is_of_this_run(arguments, out)) keep_of_this_run(out, folder);
  const std::string staging = folder.staging().string();
  stage_report(staging, http::view_of(staging), folder);
  if (in_parts && interrupted()) return kExitInterrupted;
  folder.commit({"report.html", "figures", "compared_poses.csv", "corrected_poses.csv",
                 "reference_tags.csv", "truth", "top_view.json", "tag_heights.csv",
                 "odometry.csv"});
  if (arguments.as_json) {
    fmt::print("{}", to_json(summary));
  } else {
    fmt::print("{}\n{}{}page: {}/report.html\n", summary_of_reads(overview), of_run,
               table_of(summary), out);
  }
  return kExitOk;
}

void add_localize_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<LocalizeArguments>();
  CLI::App* command =
      app.add_subcommand("localize",
                         "Locate tags from a rosbag of ROS 1 or 2 or an MCAP file, "
                         "from the folder of a run, or from reads and antenna poses as CSV");
  command
      ->add_option("READS", arguments->recording,
                   "Rosbag of ROS 1 (RUN.bag), recording of ROS 2 (RUN.mcap, RUN.db3, or "
                   "rosbag2's folder), the folder of a run, whose tag_heights.csv, "
                   "reference_tags.csv and odometry.csv are known beforehand unless options say "
                   "otherwise, or CSV: "
                   "stamp_s,reader,antenna,tag,frequency_hz,phase_rad,"
                   "rssi_dbm; of CSV also an archive, RUN.tar.zst or RUN.csv.gz")
      ->required();
  command->add_option("--poses", arguments->poses,
                      "With CSV, the poses (CSV: stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw). With a "
                      "bag: true, tf, odometry (tf without a map), or auto (default): the true "
                      "ones and tf beside them, else tf");
  add_format_option(*command, arguments->format);
  add_part_option(*command, arguments->part_reads);
  add_ros_options(*command, arguments->ros);
  command->add_option("--scenario", arguments->scenario,
                      "Scenario (YAML): its name, order and known heights of the tags, settings of "
                      "localization, and its world for the page");
  add_world_options(*command, arguments->world);
  for (const char* const name : {"--skip-missing", "--allow-outside"}) {
    command->get_option(name)->needs("--scenario");
  }
  command->add_option("--method", arguments->method,
                      "Method, one of those below (default: the scenario's, or else auto)");
  add_known_options(*command, *arguments);
  command->add_option(
      "--calibration", arguments->calibration,
      "Profile by 'tagfield calibrate': corrects antenna positions, stamps, phases");
  command
      ->add_option(
          "--set", arguments->settings,
          "A setting of the method: KEY=VALUE, with a key from below, or localization.KEY=VALUE as "
          "in 'run'. Can be given several times")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--out", arguments->out,
                      "Folder for the results (default runs/localized, of a bag runs/NAME)");
  command->add_option("--threads", arguments->threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  add_json_option(*command, arguments->as_json, "summary.json");
  command->footer(
      "Methods, and the keys of --set that they take:\n" + methods_help() +
      "\nPhase must grow with distance (eq. 3 of the paper); negate the phase of readers that do "
      "the\n"
      "opposite. The antenna must have moved along a curve: from a straight path both mirror\n"
      "images are given. The truth of a bag or a run judges the estimates and is not used to make\n"
      "them.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return localize(*arguments); }; });
}

}  // namespace tagfield
