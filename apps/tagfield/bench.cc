// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/bench/bench.h"

#include <fmt/format.h>

#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/command_method.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/method_text.h"
#include "apps/tagfield/program_version.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/shared_folder.h"
#include "apps/tagfield/suite_recording.h"
#include "tagfield/experiment/bench/bench_figures.h"
#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/bench/bench_page.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/store/run_store.h"
#include "tagfield/experiment/store/work_hash.h"
#include "tagfield/experiment/sweep/design.h"
#include "tagfield/files/files.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/localization/locate.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

struct BenchArguments {
  std::string suite;
  std::string out;
  std::optional<std::uint64_t> seeds;
  std::vector<std::string> methods;
  std::vector<std::string> conditions;
  std::vector<std::string> commands;  ///< "NAME=COMMAND"
  bool allow_commands = false;
  int threads = default_threads();
  bool no_page = false;
  bool no_timing = false;
  bool resume = false;
  bool list_methods = false;
  bool as_json = false;
  WorldOptions world{};
};

int list_methods() {
  fmt::print("{}", methods_help());
  return kExitOk;
}

/// Adds the methods of the command line.
void add_commands(const BenchArguments& arguments, Suite& suite) {
  for (const std::string& argument : arguments.commands) {
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size()) {
      fail({"--command " + argument, 0}, "expected NAME=COMMAND");
    }
    SuiteMethod method;
    method.name = method.method = argument.substr(0, equals);
    method.command = argument.substr(equals + 1);
    for (const SuiteMethod& other : suite.methods) {
      if (other.name != method.name) continue;
      fail({"--command " + argument, 0}, "the suite has a method of that name");
    }
    suite.methods.push_back(std::move(method));
  }
}

/// All methods that the suite may name. Its own commands must be allowed explicitly, as suites are
/// untrusted.
std::vector<Method> methods_for(const Suite& suite, const BenchArguments& arguments) {
  std::vector<Method> methods = built_in_methods();
  for (const SuiteMethod& method : suite.methods) {
    if (method.command.empty()) continue;
    if (!method.location.file.empty() && !arguments.allow_commands) {
      fail(method.location, fmt::format("method '{}' is a command, which runs with your "
                                        "permissions: it is run only with --allow-commands: {}",
                                        method.name, method.command));
    }
    for (const Method& other : methods) {
      if (other.name == method.name) {
        fail(method.location, fmt::format("there is a method '{}' already", method.name));
      }
    }
    methods.push_back(command_method(method.name, method.command));
  }
  return methods;
}

Suite suite_of(const BenchArguments& arguments) {
  if (arguments.suite.empty()) throw Error("bench: SUITE is missing (see tagfield bench --help)");
  suggest_shared_file(arguments.suite);
  Suite suite = load_suite(arguments.suite);
  set_world_options(arguments.world, suite);
  add_commands(arguments, suite);
  suite = only(suite, arguments.methods, arguments.conditions);
  if (suite.sweep) {
    fail(suite.sweep->location, "has a 'sweep': run it with tagfield sweep " + arguments.suite);
  }
  if (!arguments.seeds) return suite;
  suite.count = *arguments.seeds;
  for (Condition& condition : suite.conditions) condition.count.reset();
  return suite;
}

/// Keeps finished runs until all are done: an interrupted bench can be continued, also with more
/// seeds.
std::unique_ptr<RunStore> store_of(const BenchArguments& arguments, const Suite& suite,
                                   const std::string& out) {
  std::vector<std::string> words;
  for (const SuiteMethod& method : suite.methods) words.push_back(method.name);
  for (const Condition& condition : suite.conditions) words.push_back(condition.name);
  const LogHead head{program_version(), work_hash(read_text_file(arguments.suite), suite, words)};
  Diagnostics of_store;
  auto store = std::make_unique<RunStore>(out + "/" + kResumeLog, head,
                                          arguments.resume ? Resume::kYes : Resume::kNo, of_store);
  print_warnings(of_store);
  return store;
}

Bench run_with_progress(const PreparedSuite& prepared, int threads, RunStore& store) {
  ProgressBar bar("bench");
  RunControl control;
  control.threads = threads;
  control.stop = &interrupted();
  control.on_progress = [&bar](double share) { bar.show(share); };
  return run_bench(prepared, control, &store);
}

void write(const Bench& bench, const BenchArguments& arguments, Timing timing,
           StagedFolder& folder) {
  folder.add("bench.json", bench_to_json(bench, timing));
  folder.add("bench.csv", bench_to_csv(bench, timing));
  folder.add("tags.csv", bench_tags_to_csv(bench));
  if (!arguments.no_page) {
    const std::vector<Figure> figures = bench_figures(bench, timing);
    for (const Figure& figure : figures) {
      if (!figure.missing.empty()) continue;
      folder.add("figures/" + figure.name + ".svg",
                 standalone_svg(figure.svg, figure.title, figure.caption));
    }
    folder.add("bench.html", bench_page(bench, figures, timing));
  }
  folder.commit({"bench.html", "figures"});
}

int bench(const BenchArguments& arguments) {
  if (arguments.list_methods) return list_methods();
  const Suite suite = suite_of(arguments);
  Diagnostics diagnostics;
  const PreparedSuite prepared = prepare(
      suite, methods_for(suite, arguments), diagnostics,
      [&](const SuiteRecording& recording) { return read_recording(recording, diagnostics); });
  const std::string out =
      arguments.out.empty() ? "runs/bench_" + folder_name(suite.name) : arguments.out;
  catch_interrupts();  // From here on an interruption would leave files in the folder.
  StagedFolder folder(out);
  const std::unique_ptr<RunStore> store = store_of(arguments, suite, out);
  folder.keep(kResumeLog);
  Bench result = run_with_progress(prepared, arguments.threads, *store);
  for (const std::string& warning : result.warnings) diagnostics.warn(warning);
  result.warnings = diagnostics.warnings();
  const Timing timing = arguments.no_timing ? Timing::kWithoutTimes : Timing::kWithTimes;
  print_warnings(diagnostics);
  write(result, arguments, timing, folder);
  if (result.complete) store->drop();
  if (arguments.as_json) {
    fmt::print("{}", bench_to_json(result, timing));
    return result.complete ? kExitOk : kExitInterrupted;
  }
  fmt::print("{}", bench_to_text(result, timing));
  if (!result.complete)
    fmt::print("INCOMPLETE: the bench was interrupted; --resume continues it\n");
  fmt::print("{}: {}\n", arguments.no_page ? "folder" : "page",
             arguments.no_page ? out : out + "/bench.html");
  return result.complete ? kExitOk : kExitInterrupted;
}

void add_options(CLI::App& command, BenchArguments& arguments) {
  command.add_option("SUITE", arguments.suite, "Suite file (YAML)");
  command.add_option("--seeds", arguments.seeds, "Number of seeds in each condition")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000}));
  command.add_option("--methods", arguments.methods, "Only these methods of the suite: A,B")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false);
  command
      .add_option("--conditions", arguments.conditions, "Only these conditions of the suite: A,B")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false);
  command
      .add_option("--command", arguments.commands,
                  "NAME=COMMAND: one more method, your own program. It gets a folder as its last "
                  "argument, reads reads.csv and antenna_poses.csv there and writes estimates.csv. "
                  "Can be given several times")
      ->take_all()
      ->allow_extra_args(false);
  command.add_flag("--allow-commands", arguments.allow_commands,
                   "Run the commands that the suite itself names as methods");
  command.add_option("--out", arguments.out, "Folder for the results (default runs/bench_NAME)");
  add_world_options(command, arguments.world);
  add_json_option(command, arguments.as_json, "bench.json");
  command.add_option("--threads", arguments.threads, "Threads; only times depend on it")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--no-page", arguments.no_page, "Write the data only, no bench.html");
  command.add_flag("--no-timing", arguments.no_timing,
                   "Leave times out, so that the same suite gives the same bytes");
  command.add_flag("--resume", arguments.resume,
                   "Resume a bench that was cut off, in the same folder");
  command.add_flag("--list-methods", arguments.list_methods, "List the methods")
      ->excludes("--json");
}

}  // namespace

void add_bench_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command = app.add_subcommand(
      "bench", "Compare localization methods in many conditions with many seeds");
  add_options(*command, *arguments);
  command->footer(
      "A suite names methods and conditions. Each condition is simulated once with each seed, or\n"
      "was recorded, and all its methods locate the same reads:\n\n"
      "  scenario: ../paper_warehouse.yaml      # relative to the suite\n"
      "  seeds: 100\n"
      "  methods: [hyperbola, {name: coarse, method: hyperbola, localization: {stride_m: 1}}]\n"
      "  conditions:\n"
      "    - {name: true pose}\n"
      "    - {name: noisy, set: {antennas.mobile.phase_noise_rad: 0.5}}\n"
      "    - {name: lossy, lose: {share: 0.3, burst_s: 1, every_s: 10}}\n"
      "    - {name: late, fault: {timestamp_delay_s: 0.2}}\n"
      "    - {name: rail, recording: {reads: d1.tar.zst, format: adarf, side: +y, truth: "
      "t.csv}}\n\n"
      "The folder then holds bench.html, bench.json, bench.csv with a row for each condition and\n"
      "method, and tags.csv with a row for each tag of each run. For example\n"
      "  tagfield bench scenarios/bench/paper_warehouse.yaml --seeds 5\n"
      "Ctrl-C ends it early and keeps the runs that are done; --resume continues it, also after a\n"
      "kill. docs/bench.md lists all keys and columns, and says how errors are judged.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return bench(*arguments); }; });
}

}  // namespace tagfield
