#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/table.h"
#include "tagfield/localization/estimates_csv.h"
#include "tagfield/localization/locate.h"
#include "tagfield/report/page.h"
#include "tagfield/report/summary.h"
#include "tagfield/stream/files.h"
#include "tagfield/stream/poses_csv.h"
#include "tagfield/stream/reads_csv.h"
#include "tagfield/stream/tag_heights_csv.h"

namespace tagfield {
namespace {

struct LocalizeArguments {
  std::string reads;
  std::string poses;
  std::string method = "hyperbola";
  std::string heights_file;
  std::string out = "runs/localized";
  LocalizationOptions options;
};

/// Longest way of any one antenna [m].
double longest_path(const std::vector<AntennaPose>& poses) {
  std::map<std::string, Trajectory> by_antenna;
  for (const AntennaPose& pose : poses) {
    by_antenna[pose.antenna].push_back({pose.stamp, pose.X_WA});
  }
  double longest = 0.0;
  for (const auto& [antenna, trajectory] : by_antenna) {
    longest = std::max(longest, path_length(trajectory));
  }
  return longest;
}

Summary summary_of(const LocalizeArguments& arguments, const std::vector<TagRead>& reads,
                   const std::vector<AntennaPose>& poses, const std::vector<TagEstimate>& estimates,
                   const Diagnostics& diagnostics) {
  Summary summary;
  summary.scenario = arguments.reads;
  summary.method = arguments.method;
  summary.pose = "given";
  summary.path_length_m = longest_path(poses);
  summary.reads = reads.size();
  summary.warnings = diagnostics.warnings();
  const std::map<std::string, std::size_t> counts = count_by_tag(reads);
  for (const TagEstimate& estimate : estimates) {
    TagOutcome outcome;
    outcome.estimate = estimate;
    outcome.reads = counts.at(estimate.tag);
    summary.tags.push_back(std::move(outcome));
  }
  return summary;
}

/// What an earlier run may have left in the folder: its truth and world are not those of other
/// reads.
std::vector<std::filesystem::path> stale_files(const LocalizeArguments& arguments) {
  namespace fs = std::filesystem;
  std::vector<fs::path> stale = {"report.html", "figures"};
  const fs::path of_reads = fs::weakly_canonical(arguments.reads).parent_path();
  if (of_reads != fs::weakly_canonical(arguments.out)) {
    stale.insert(stale.end(), {"truth", "top_view.json", "tag_heights.csv"});
  }
  return stale;
}

int localize_files(const LocalizeArguments& arguments) {
  Diagnostics diagnostics;
  const std::vector<TagRead> reads = read_reads_csv(arguments.reads);
  const std::vector<AntennaPose> poses = read_poses_csv(arguments.poses);
  LocalizationOptions options = arguments.options;
  if (!arguments.heights_file.empty()) {
    options.heights.of_tag = read_tag_heights_csv(arguments.heights_file);
  }
  if (reads.empty()) diagnostics.warn({arguments.reads, 0}, "no reads: cannot localize anything");
  StagedFolder folder(arguments.out);
  const std::vector<TagEstimate> estimates = locate_tags(reads, poses, options, diagnostics);
  const Summary summary = summary_of(arguments, reads, poses, estimates, diagnostics);
  print_warnings(diagnostics);
  folder.add("reads.csv", reads_to_csv(reads));
  folder.add("antenna_poses.csv", poses_to_csv(poses));
  folder.add("estimates.csv", estimates_to_csv(estimates));
  folder.add("summary.json", to_json(summary));
  folder.commit(stale_files(arguments));
  write_report(arguments.out);
  fmt::print("{}page: {}/report.html\n", table_of(summary), arguments.out);
  return kExitOk;
}

}  // namespace

void add_localize_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<LocalizeArguments>();
  LocalizationOptions& options = arguments->options;
  options.threads = default_threads();
  CLI::App* command = app.add_subcommand(
      "localize", "Locate tags from reads and antenna poses, simulated or of a real reader");
  command
      ->add_option("READS", arguments->reads,
                   "CSV: stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm")
      ->required();
  command->add_option("--poses", arguments->poses, "CSV: stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw")
      ->required();
  command->add_option("--method", arguments->method, "How (default hyperbola, the paper's)")
      ->check(CLI::IsMember({"hyperbola"}));
  command
      ->add_option("--tag-height", options.heights.of_all,
                   "Height of the tags [m, world]; without it, that of the antenna in the mean")
      ->check(CLI::Number);
  command->add_option("--tag-heights", arguments->heights_file,
                      "CSV: tag,height_m; goes before --tag-height");
  command->add_option("--stride", options.hyperbola.stride_m, "Travel between hyperbolae [m]")
      ->check(CLI::PositiveNumber);
  command->add_option("--out", arguments->out, "Folder for the results (default runs/localized)");
  command->add_option("--threads", options.threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->footer(
      "Phase must grow with distance (eq. 3 of the paper); turn the sign of readers that do the\n"
      "opposite. The antenna must have moved along a curve: from a straight path both mirror\n"
      "images are given.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return localize_files(*arguments); }; });
}

}  // namespace tagfield
