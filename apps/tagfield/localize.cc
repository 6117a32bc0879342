#include "apps/tagfield/localize.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "adapters/ros1/bag_recording.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/judge.h"
#include "apps/tagfield/recording.h"
#include "apps/tagfield/table.h"
#include "apps/tagfield/top_view_file.h"
#include "simulator/calibration_profile.h"
#include "simulator/experiment.h"
#include "simulator/scenario_yaml.h"
#include "tagfield/localization/estimates_csv.h"
#include "tagfield/report/page.h"
#include "tagfield/stream/poses_csv.h"
#include "tagfield/stream/reads_csv.h"
#include "tagfield/stream/tag_heights_csv.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

std::optional<ScenarioWithWorld> scenario_of(const LocalizeArguments& arguments,
                                             Diagnostics& diagnostics) {
  if (arguments.scenario.empty()) return std::nullopt;
  return load_scenario_with_world(arguments.scenario, {}, diagnostics);
}

/// Those of the scenario, with what the command line says instead.
LocalizationOptions options_of(const LocalizeArguments& arguments,
                               const std::optional<ScenarioWithWorld>& loaded) {
  LocalizationOptions options;
  if (loaded) options = localization_options(loaded->scenario, arguments.threads);
  options.threads = arguments.threads;
  if (!arguments.method.empty()) options.method = arguments.method;
  if (arguments.stride_m) options.settings.hyperbola.stride_m = *arguments.stride_m;
  TagHeights& heights = options.known.heights;
  if (arguments.tag_height_m || !arguments.heights_file.empty()) heights = {};
  heights.of_all = arguments.tag_height_m ? arguments.tag_height_m : heights.of_all;
  if (!arguments.heights_file.empty()) {
    heights.of_tag = read_tag_heights_csv(arguments.heights_file);
  }
  return options;
}

std::vector<std::string> order_of(const std::optional<ScenarioWithWorld>& loaded) {
  std::vector<std::string> order;
  if (!loaded) return order;
  for (const TagSpec& tag : loaded->scenario.tags) order.push_back(tag.id);
  return order;
}

/// The same reads with the other poses.
std::optional<ComparedPose> compared(const RecordingToLocalize& recording,
                                     const LocalizationOptions& options,
                                     const std::vector<std::string>& order) {
  if (recording.other.poses.empty()) return std::nullopt;
  Diagnostics of_other;  // Would be taken for warnings about the run's own poses.
  const std::vector<TagEstimate> estimates = with_all_tags(
      locate_tags(recording.reads, recording.other.poses, options, of_other).estimates,
      recording.truth, order);
  Summary summary;
  summary.tags = judged(estimates, recording.reads, recording.truth);
  ComparedPose result;
  result.pose = recording.other.name;
  result.position_rms_m = position_rms(recording.other.poses, recording.poses.poses).value_or(0.0);
  result.error_m = error_statistics(summary);
  result.located = count(summary, Verdict::kLocated);
  return result;
}

Summary summary_of(const LocalizeArguments& arguments, const RecordingToLocalize& recording,
                   const std::optional<ScenarioWithWorld>& loaded, const std::string& method,
                   const std::vector<TagEstimate>& estimates) {
  Summary summary;
  summary.scenario = loaded ? loaded->scenario.name : arguments.recording;
  if (loaded) summary.description = loaded->scenario.description;
  summary.method = method;
  summary.pose = recording.poses.name;
  summary.path_length_m = recording.path_length_m;
  summary.reads = recording.reads.size();
  summary.simulated_s = recording.duration_s;
  summary.tags = judged(estimates, recording.reads, recording.truth);
  return summary;
}

bool is_empty(const Truth& truth) {
  return truth.antenna_poses.empty() && truth.robot_poses.empty() && truth.tag_positions.empty() &&
         truth.distances.empty();
}

void stage(const RecordingToLocalize& recording, const std::optional<ScenarioWithWorld>& loaded,
           const LocalizationOptions& options, const std::vector<TagEstimate>& estimates,
           StagedFolder& folder) {
  folder.add("reads.csv", reads_to_csv(recording.reads));
  folder.add("antenna_poses.csv", poses_to_csv(recording.poses.poses));
  if (!recording.other.poses.empty()) {
    folder.add("compared_poses.csv", poses_to_csv(recording.other.poses));
  }
  folder.add("estimates.csv", estimates_to_csv(estimates));
  if (!is_empty(recording.truth)) stage_truth(recording.truth, folder);
  if (!loaded) return;
  if (!options.known.heights.of_tag.empty()) {
    folder.add("tag_heights.csv", tag_heights_to_csv(options.known.heights.of_tag));
  }
  stage_top_view(*loaded, folder);
}

/// What an earlier run may have left in the folder: its truth and world are not those of other
/// reads.
std::vector<fs::path> stale_files(const LocalizeArguments& arguments, const std::string& out) {
  std::vector<fs::path> stale = {"report.html", "figures", "compared_poses.csv"};
  const fs::path of_reads = fs::weakly_canonical(arguments.recording).parent_path();
  if (of_reads != fs::weakly_canonical(out) || is_bag(arguments.recording)) {
    stale.insert(stale.end(), {"truth", "top_view.json", "tag_heights.csv"});
  }
  return stale;
}

std::string folder_of(const LocalizeArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  if (!is_bag(arguments.recording)) return "runs/localized";
  return "runs/" + fs::path(arguments.recording).stem().string();
}

void refuse_options_of_bags(const LocalizeArguments& arguments) {
  if (!arguments.frame.empty()) throw Error("localize: --frame goes with a bag only");
  if (arguments.frequency_hz) throw Error("localize: --frequency goes with a bag only");
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : built_in_methods({})) names.push_back(method.name);
  return names;
}

}  // namespace

int localize(const LocalizeArguments& arguments) {
  const bool bag = is_bag(arguments.recording);
  if (!bag) refuse_options_of_bags(arguments);
  if (bag && !arguments.format.empty()) throw Error("localize: --format goes with CSV only");
  Diagnostics diagnostics;
  const auto loaded = scenario_of(arguments, diagnostics);
  RecordingToLocalize recording =
      bag ? bag_recording(arguments, diagnostics) : csv_recording(arguments);
  LocalizationOptions options = options_of(arguments, loaded);
  if (!arguments.calibration.empty()) {
    apply_calibration(read_calibration(arguments.calibration), recording.reads,
                      recording.poses.poses, options.known);
  }
  if (recording.reads.empty()) {
    diagnostics.warn({arguments.recording, 0}, "no reads: cannot localize anything");
  }
  const std::string out = folder_of(arguments);
  StagedFolder folder(out);
  const std::vector<std::string> order = order_of(loaded);
  const LocalizationResult located =
      locate_tags(recording.reads, recording.poses.poses, options, diagnostics);
  const std::vector<TagEstimate> estimates =
      with_all_tags(located.estimates, recording.truth, order);
  Summary summary = summary_of(arguments, recording, loaded, located.method, estimates);
  summary.compared_pose = compared(recording, options, order);
  summary.warnings = diagnostics.warnings();
  print_warnings(diagnostics);
  stage(recording, loaded, options, estimates, folder);
  folder.add("summary.json", to_json(summary));
  folder.commit(stale_files(arguments, out));
  write_report(out);
  fmt::print("{}page: {}/report.html\n", table_of(summary), out);
  return kExitOk;
}

void add_localize_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<LocalizeArguments>();
  CLI::App* command = app.add_subcommand(
      "localize", "Locate tags from a rosbag, or from reads and antenna poses as CSV");
  command
      ->add_option("READS", arguments->recording,
                   "Rosbag (RUN.bag), or CSV: stamp_s,reader,antenna,tag,frequency_hz,phase_rad,"
                   "rssi_dbm")
      ->required();
  command->add_option("--poses", arguments->poses,
                      "With CSV, the poses (CSV: stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw). With a "
                      "bag: true, tf, odometry (tf without a map), or auto (default): the true "
                      "ones and tf beside them, else tf");
  command->add_option("--format", arguments->format,
                      "Form of other people's CSV (YAML, as profiles/datasets/llrp_log.yaml); "
                      "docs/datasets.md");
  command->add_option("--frame", arguments->frame,
                      "With a bag: fixed frame of tf (default: the first of map, world, odom that "
                      "can express the antennas)");
  command
      ->add_option("--frequency", arguments->frequency_hz,
                   "With a bag of rfid_sensor/TagArray: the carrier [Hz] (default 865.7e6)")
      ->check(CLI::PositiveNumber);
  command->add_option("--scenario", arguments->scenario,
                      "Scenario (YAML): its name, order and known heights of the tags, settings of "
                      "localization, and its world for the page");
  command->add_option("--method", arguments->method, "How (default hyperbola, the paper's)")
      ->check(CLI::IsMember(method_names()));
  command
      ->add_option("--tag-height", arguments->tag_height_m,
                   "Height of the tags [m, world]; without it, that of the antenna in the mean")
      ->check(CLI::Number);
  command->add_option("--tag-heights", arguments->heights_file,
                      "CSV: tag,height_m; goes before --tag-height");
  command->add_option("--calibration", arguments->calibration,
                      "Profile by 'tagfield calibrate': corrects antenna places, stamps, phases");
  command->add_option("--stride", arguments->stride_m, "Travel between hyperbolae [m]")
      ->check(CLI::PositiveNumber);
  command->add_option("--out", arguments->out,
                      "Folder for the results (default runs/localized, of a bag runs/NAME)");
  command->add_option("--threads", arguments->threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->footer(
      "Phase must grow with distance (eq. 3 of the paper); turn the sign of readers that do the\n"
      "opposite. The antenna must have moved along a curve: from a straight path both mirror\n"
      "images are given. A bag's truth judges the estimates and is not used to make them.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return localize(*arguments); }; });
}

}  // namespace tagfield
