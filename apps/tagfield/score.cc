// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/table.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/experiment/judge.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/files/tag_positions_csv.h"
#include "tagfield/files/truth_csv.h"
#include "tagfield/report/estimates_csv.h"
#include "tagfield/report/run_files.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

struct ScoreArguments {
  std::string estimates;
  std::string run;
  bool as_json = false;
};

std::map<std::string, double> true_heights(const Truth& truth) {
  std::map<std::string, double> heights;
  for (const TagPosition& tag : truth.tag_positions) heights[tag.tag] = tag.p_WT.z();
  return heights;
}

using ReadsOfTags = std::map<std::string, std::size_t>;

std::set<std::string> tags_of(const std::map<std::string, double>& heights,
                              const ReadsOfTags& reads) {
  std::set<std::string> tags;
  for (const auto& [tag, height] : heights) tags.insert(tag);
  for (const auto& [tag, count] : reads) tags.insert(tag);
  return tags;
}

/// The estimates, and for each other tag of the run that it was never read or has no row in the
/// table.
std::vector<TagEstimate> with_tags_without_row(std::vector<TagEstimate> estimates,
                                               const Truth& truth, const ReadsOfTags& reads,
                                               const std::string& table) {
  std::set<std::string> with_row;
  for (const TagEstimate& estimate : estimates) with_row.insert(estimate.tag);
  std::vector<TagEstimate> all = with_all_tags(std::move(estimates), truth, {});
  for (TagEstimate& estimate : all) {
    if (with_row.count(estimate.tag) > 0 || reads.count(estimate.tag) == 0) continue;
    estimate.reason = "no row in " + table;
  }
  return all;
}

/// Reads the estimates; one without a height is evaluated at the height of its tag.
std::vector<TagEstimate> read_estimates(const std::string& file,
                                        const std::map<std::string, double>& heights,
                                        Diagnostics& diagnostics) {
  bool is_level = false;
  const auto height = [&](const std::string& tag) {
    is_level = true;
    const auto found = heights.find(tag);
    return found == heights.end() ? 0.0 : found->second;
  };
  std::vector<TagEstimate> estimates = read_estimates_csv(file, height);
  if (is_level)
    diagnostics.warn({file, 0}, "has positions without z_m: their errors are horizontal");
  return estimates;
}

int score(const ScoreArguments& arguments) {
  finish_commit(arguments.run);
  const fs::path folder(arguments.run);
  const std::vector<TagRead> reads = read_reads_csv((folder / "reads.csv").string());
  const Truth truth = read_truth(arguments.run);
  std::map<std::string, Eigen::Vector3d> references;
  const fs::path of_references = folder / "reference_tags.csv";
  if (is_there(of_references)) references = read_tag_positions_csv(of_references.string());

  Diagnostics diagnostics;
  const std::map<std::string, double> heights = true_heights(truth);
  std::vector<TagEstimate> estimates = read_estimates(arguments.estimates, heights, diagnostics);
  const ReadsOfTags of_tags = count_by_tag(reads);
  drop_strangers({arguments.estimates, 0}, "the run has", tags_of(heights, of_tags), estimates,
                 diagnostics);
  Summary summary;
  summary.scenario = arguments.run;
  summary.method = summary.method_asked = fs::path(arguments.estimates).filename().string();
  summary.pose = "given";
  summary.reads = reads.size();
  summary.tags = judged(with_tags_without_row(std::move(estimates), truth, of_tags, summary.method),
                        reads, truth, references);
  summary.warnings = diagnostics.warnings();
  print_warnings(diagnostics);
  fmt::print("{}", arguments.as_json ? to_json(summary) : table_of(summary));
  return kExitOk;
}

}  // namespace

void add_score_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<ScoreArguments>();
  CLI::App* command = app.add_subcommand(
      "score", "Judge positions that another program estimated from a run's reads");
  command
      ->add_option("ESTIMATES", arguments->estimates,
                   "CSV: tag,x_m,y_m and, where they are known, z_m,verdict,expected_error_m, …")
      ->required();
  command
      ->add_option("--run", arguments->run,
                   "Folder of the run: its reads.csv, and truth/ to judge by")
      ->required();
  add_json_option(*command, arguments->as_json, "what summary.json holds");
  command->footer(
      "An estimator in any language can take part: it reads reads.csv and antenna_poses.csv of a "
      "run,\n"
      "writes a table, and is judged as Tagfield's own methods are:\n\n"
      "  tagfield run scenarios/paper_warehouse.yaml --out runs/a --record-only\n"
      "  python3 mine.py runs/a\n"
      "  tagfield score runs/a/estimates.csv --run runs/a\n\n"
      "A tag with several rows, best first, is ambiguous; one without a row is not located. The\n"
      "columns are those of estimates.csv (docs/files.md). 'tagfield bench --command' compares "
      "such\n"
      "a program with others over many seeds.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return score(*arguments); }; });
}

}  // namespace tagfield
