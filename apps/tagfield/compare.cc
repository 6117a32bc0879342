// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/files/files.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/report/comparison_page.h"
#include "tagfield/report/run_files.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

struct CompareArguments {
  std::string first;
  std::string second;
  std::string out;
  bool as_json = false;
};

/// The last part of a path, for display.
std::string name_of_run(const std::string& folder) {
  const fs::path path = fs::path(folder).lexically_normal();
  const std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  return name.empty() || name == "." || name == ".." ? folder : name;
}

Summary summary_of_run(const std::string& folder) {
  if (!is_folder(folder)) fail({folder, 0}, "no such folder");
  finish_commit(folder);
  const std::string file = (fs::path(folder) / "summary.json").string();
  if (!is_there(file)) {
    fail({folder, 0}, "holds no summary.json: expected the folder of 'run' or 'localize'");
  }
  return summary_from_json(read_text_file(file), file);
}

/// Top view of the world, from the first run that has one.
std::vector<Silhouette> geometry_of_runs(const CompareArguments& arguments) {
  for (const std::string& folder : {arguments.first, arguments.second}) {
    const std::string file = (fs::path(folder) / "top_view.json").string();
    if (is_there(file)) return read_top_view(file);
  }
  return {};
}

RunComparison comparison_of(const CompareArguments& arguments) {
  std::string first = name_of_run(arguments.first);
  std::string second = name_of_run(arguments.second);
  if (first == second) {
    first = arguments.first;
    second = arguments.second;
  }
  return compared(summary_of_run(arguments.first), first, summary_of_run(arguments.second), second);
}

std::string length_or_none(const std::optional<ErrorStatistics>& error,
                           double ErrorStatistics::*member) {
  return error ? fmt::format("{:.1f}", 1e3 * (*error).*member) : "-";
}

/// Without separators of thousands, as all tables in the terminal.
std::string mean_count(const ComparedRun& run, std::size_t count) {
  return fmt::format("{:.10g}", std::round(10.0 * per_run(run, count)) / 10.0);
}

std::string mean_of_all(const ComparedRun& run, std::size_t ComparedRun::*part,
                        std::size_t ComparedRun::*all) {
  return fmt::format("{} of {}", mean_count(run, run.*part), mean_count(run, run.*all));
}

void print(const RunComparison& comparison) {
  const ComparedRun& first = comparison.runs[0];
  const ComparedRun& second = comparison.runs[1];
  const auto row = [](const std::string& name, const std::string& a, const std::string& b) {
    fmt::print("{:<22} {:>24} {:>24}\n", name, a, b);
  };
  row("", shortened(first.name, 24), shortened(second.name, 24));
  const auto counts = [&](const std::string& name, std::size_t ComparedRun::*part,
                          std::size_t ComparedRun::*all) {
    row(name, mean_of_all(first, part, all), mean_of_all(second, part, all));
  };
  if (first.runs > 1 || second.runs > 1) {
    row("runs (counts are means)", fmt::format("{}", first.runs), fmt::format("{}", second.runs));
  }
  if (any_locates(comparison)) {
    counts("tags located", &ComparedRun::located, &ComparedRun::outcomes);
  }
  counts("tags read", &ComparedRun::read, &ComparedRun::tags);
  row("reads", mean_count(first, first.reads), mean_count(second, second.reads));
  const auto errors = [&](const std::string& name, double ErrorStatistics::*member) {
    row(name, length_or_none(first.error_m, member), length_or_none(second.error_m, member));
  };
  if (any_locates(comparison)) {
    errors("mean error [mm]", &ErrorStatistics::mean);
    errors("median error [mm]", &ErrorStatistics::median);
    errors("95 % below [mm]", &ErrorStatistics::p95);
    errors("maximum error [mm]", &ErrorStatistics::max);
  }
  fmt::print("{}\n", comparison_sentence(comparison));
}

void write(const RunComparison& comparison, const std::vector<Silhouette>& geometry,
           const std::string& out) {
  if (is_there(fs::path(out) / "summary.json")) {
    fail({out, 0}, "holds a run: expected another folder for the comparison (--out)");
  }
  StagedFolder folder(out);
  const std::vector<Figure> figures = comparison_figures(comparison, geometry);
  for (const Figure& figure : figures) {
    if (!figure.missing.empty()) continue;
    folder.add("figures/" + figure.name + ".svg",
               standalone_svg(figure.svg, figure.title, figure.caption));
  }
  folder.add("compare.html", comparison_page(comparison, figures));
  folder.add("compare.json", comparison_to_json(comparison));
  folder.add("compare.csv", comparison_to_csv(comparison));
  folder.commit({"figures"});
}

int compare(const CompareArguments& arguments) {
  const RunComparison comparison = comparison_of(arguments);
  const std::string out = arguments.out.empty() ? "runs/" + name_of_run(arguments.first) + "_and_" +
                                                      name_of_run(arguments.second)
                                                : arguments.out;
  Diagnostics diagnostics;
  for (const std::string& warning : comparison.warnings) diagnostics.warn(warning);
  catch_interrupts();
  write(comparison, geometry_of_runs(arguments), out);
  print_warnings(diagnostics);
  if (arguments.as_json) {
    fmt::print("{}", comparison_to_json(comparison));
  } else {
    print(comparison);
    fmt::print("page: {}/compare.html\n", out);
  }
  return kExitOk;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Compare two runs: errors tag by tag, reads, and what may be chance");
  command->add_option("RUN", arguments->first, "Folder of a run, or of 'localize'")->required();
  command->add_option("OTHER", arguments->second, "Another one, of the same tags")->required();
  command->add_option("--out", arguments->out, "Folder for the page (default runs/RUN_and_OTHER)");
  add_json_option(*command, arguments->as_json, "compare.json");
  command->footer(
      "The folder then holds compare.html, its figures/, compare.csv with one row per tag, and\n"
      "compare.json. Runs of several seeds are compared by each tag's mean over them. Which of "
      "two\n"
      "settings is better over many conditions is for 'bench' and 'sweep'. For example\n"
      "  tagfield run scenarios/paper_warehouse.yaml --out runs/hyperbola\n"
      "  tagfield run scenarios/paper_warehouse.yaml --set localization.method=joint --out "
      "runs/joint\n"
      "  tagfield compare runs/hyperbola runs/joint");
  command->callback([arguments, &chosen] { chosen = [arguments] { return compare(*arguments); }; });
}

}  // namespace tagfield
