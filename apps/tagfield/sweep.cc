// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/sweep_work.h"
#include "tagfield/experiment/sweep/merge.h"

namespace tagfield {
namespace {

struct SweepArguments {
  std::string suite;
  std::string out;
  std::string shard;
  std::string merge;
  std::string status;
  std::vector<std::string> again;
  double save_every_s = kSaveEvery_s;
  int threads = default_threads();
  bool resume = false;
  bool no_page = false;
  bool as_json = false;
  WorldOptions world{};
};

/// Executes the runs and prints the outcome.
RunsDone run_with_bar(const OpenSweep& sweep, const std::string& label, std::vector<RunKey> runs,
                      ResultLog& log, int threads) {
  ProgressBar bar(label);
  RunControl control;
  control.threads = threads;
  control.stop = &interrupted();
  RunList list(std::move(runs));
  std::size_t done = 0;
  return do_runs(
      sweep.plan, sweep.means, [&] { return list.next(); }, log, control,
      [&] { bar.show(static_cast<double>(++done) / static_cast<double>(list.size())); });
}

/// Executes the remaining runs of a shard in the open rungs.
RunsDone run_shard(const OpenSweep& sweep, const Shard& shard, const SweepArguments& arguments) {
  ResultLog log(shard_log(sweep.folder, shard), sweep.head, arguments.save_every_s);
  const ClosedRungs closed = read_closed_rungs(sweep.folder, sweep.head);
  const std::vector<RunKey> own =
      runs_of_shard(runs_of(sweep.plan, closed), shard.index, shard.count);
  Diagnostics damaged;
  std::vector<RunKey> left = not_done(own, logs_for(sweep.folder, shard), sweep.head, damaged);
  print_warnings(damaged);
  const std::size_t count = left.size();
  const RunsDone done = run_with_bar(sweep, fmt::format("shard {}/{}", shard.index, shard.count),
                                     std::move(left), log, arguments.threads);
  if (arguments.as_json) return done;
  fmt::print("shard {}/{}: {} runs done now, {} before, {} failed\n", shard.index, shard.count,
             done.ok + done.failed, own.size() - count, done.failed);
  return done;
}

int exit_code_of(const RunsDone& done) {
  if (interrupted()) return kExitInterrupted;
  return done.failed > 0 ? kExitIncomplete : kExitOk;
}

OpenSweep opened(const SweepArguments& arguments) {
  OpenSweep sweep = open_sweep(arguments.suite, arguments.out, arguments.world);
  print_warnings(sweep.diagnostics);
  return sweep;
}

int sweep_shard(const SweepArguments& arguments) {
  const Shard shard = parse_shard(arguments.shard);
  const OpenSweep sweep = opened(arguments);
  const RunsDone done = run_shard(sweep, shard, arguments);
  if (arguments.as_json) {
    print_status(sweep.folder, true);
    return exit_code_of(done);
  }
  fmt::print("when all shards are done:  tagfield sweep --merge {}\n", sweep.folder);
  return exit_code_of(done);
}

/// Executes the whole sweep, rung by rung.
int sweep_all(const SweepArguments& arguments) {
  const OpenSweep sweep = opened(arguments);
  for (;;) {
    run_shard(sweep, {1, 1}, arguments);
    const Merged merged = merge_sweep(sweep.folder, !arguments.no_page, arguments.as_json);
    const bool is_last = interrupted() || !merged.closed_a_rung || merged.complete;
    if (is_last) fmt::print("{}", merged.json);
    if (interrupted()) return kExitInterrupted;
    if (is_last) return merged.exit_code;
  }
}

/// Runs to repeat: those that failed, or the given ones.
std::vector<RunKey> runs_again(const OpenSweep& sweep, const std::vector<std::string>& names) {
  std::vector<RunKey> runs;
  if (names.size() == 1 && names.front() == "failed") {
    Diagnostics damaged;
    for (const FoundRun& run : index_runs(all_logs(sweep.folder), sweep.head, damaged).runs) {
      if (run.failed) runs.push_back(run.key);
    }
    return runs;
  }
  const std::vector<RunKey> all = runs_of(sweep.plan, read_closed_rungs(sweep.folder, sweep.head));
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const RunKey& key) { return to_string(key) == name; });
    if (found == all.end()) {
      throw Error(
          fmt::format("--again: there is no run '{}', expected POINT:SEED or 'failed'", name));
    }
    runs.push_back(*found);
  }
  return runs;
}

int sweep_again(const SweepArguments& arguments) {
  const OpenSweep sweep = opened(arguments);
  std::vector<RunKey> runs = runs_again(sweep, arguments.again);
  if (runs.empty()) {
    if (arguments.as_json) return print_status(sweep.folder, true);
    fmt::print("no run has failed\n");
    return kExitOk;
  }
  ResultLog log(new_log_of_runs_again(sweep.folder), sweep.head, arguments.save_every_s);
  const RunsDone done = run_with_bar(sweep, "again", std::move(runs), log, arguments.threads);
  if (!arguments.as_json) {
    fmt::print("{} runs done, {} failed\n", done.ok + done.failed, done.failed);
  }
  const Merged merged = merge_sweep(sweep.folder, !arguments.no_page, arguments.as_json);
  fmt::print("{}", merged.json);
  return interrupted() ? kExitInterrupted : merged.exit_code;
}

int sweep(const SweepArguments& arguments) {
  const int asked = (arguments.suite.empty() ? 0 : 1) + (arguments.merge.empty() ? 0 : 1) +
                    (arguments.status.empty() ? 0 : 1);
  if (asked != 1) {
    throw Error(
        "sweep: expected SUITE, or --merge DIR, or --status DIR (see tagfield sweep --help)");
  }
  if (!arguments.merge.empty()) {
    const Merged merged = merge_sweep(arguments.merge, !arguments.no_page, arguments.as_json);
    fmt::print("{}", merged.json);
    return merged.exit_code;
  }
  if (!arguments.status.empty()) return print_status(arguments.status, arguments.as_json);
  catch_interrupts();
  if (!arguments.again.empty()) return sweep_again(arguments);
  return arguments.shard.empty() ? sweep_all(arguments) : sweep_shard(arguments);
}

void add_sweep_options(CLI::App& command, SweepArguments& arguments) {
  command.add_option("SUITE", arguments.suite, "Suite file (YAML), with a section 'sweep'");
  command.add_option("--out", arguments.out, "Folder of the sweep (default runs/sweep_NAME)");
  command.add_option("--shard", arguments.shard,
                     "Do part I of N, from 1/N to N/N, without merging");
  command.add_option("--merge", arguments.merge, "Merge the results of all shards in a folder")
      ->option_text("DIR");
  command.add_option("--status", arguments.status, "Show the progress of all shards")
      ->option_text("DIR");
  command
      .add_option("--again", arguments.again,
                  "Repeat these runs, POINT:SEED, or all that failed: 'failed'")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false)
      ->excludes("--shard");
  command
      .add_option("--save-every", arguments.save_every_s,
                  "Seconds of work that are lost at most when a process is killed (default 5)")
      ->check(CLI::Range(0.0, 3600.0));
  command.add_option("--threads", arguments.threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--resume", arguments.resume,
                   "Resume a sweep that was cut off, which is the default");
  command.add_flag("--no-page", arguments.no_page, "Write the data only, no sweep.html");
  add_world_options(command, arguments.world);
  add_json_option(
      command, arguments.as_json,
      "results.json, or the progress (--status, --shard, --again without a failed run)");
}

}  // namespace

void add_sweep_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<SweepArguments>();
  CLI::App* command = app.add_subcommand(
      "sweep",
      "Try many values of a scenario's keys with many seeds, on as many machines as there are");
  add_sweep_options(*command, *arguments);
  command->footer(
      "A suite as for 'tagfield bench', and in it which keys take which values:\n\n"
      "  scenario: ../paper_warehouse.yaml      # relative to the suite\n"
      "  seeds: 100\n"
      "  methods: [hyperbola, joint]\n"
      "  sweep:\n"
      "    grid:                                # or list, or latin_hypercube\n"
      "      pose.sigma_m: [0.005, 0.01, 0.02]\n"
      "      antennas.mobile.phase_noise_rad: {from: 0.05, to: 0.8, steps: 5, scale: log}\n\n"
      "On one machine:\n"
      "  tagfield sweep scenarios/sweep/pose_and_noise.yaml\n"
      "On many, which share a folder; any shard can be killed and started again:\n"
      "  tagfield sweep SUITE --shard 3/100 --out DIR     # and 99 others\n"
      "  tagfield sweep --status DIR\n"
      "  tagfield sweep --merge DIR                       # the same bytes whatever N\n"
      "examples/09_cluster has this for GNU parallel, Slurm, HTCondor and mpirun. The folder then\n"
      "holds sweep.html, results.sqlite, results.json, points.csv and runs.csv; docs/sweep.md "
      "lists\n"
      "keys, tables and queries. Exit code 3 means that runs failed or are missing.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return sweep(*arguments); }; });
}

}  // namespace tagfield
