// SPDX-License-Identifier: Apache-2.0
// tagfield_sweep_mpi: a sweep under mpirun, whose ranks take new runs as they finish others.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <memory>
#include <new>
#include <string_view>

#include "adapters/mpi/shared_work.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/command_reference.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/sweep_work.h"
#include "tagfield/files/files.h"

namespace {

using namespace tagfield;

struct MpiArguments {
  std::string suite;
  std::string out;
  double save_every_s = kSaveEvery_s;
  bool no_page = false;
};

/// The remaining runs of all ranks in the open rungs; empty on ranks other than 0.
std::vector<RunKey> left_on_first(const mpi::Session& session, const OpenSweep& sweep) {
  if (session.rank() != 0) return {};
  Diagnostics damaged;
  std::vector<RunKey> left =
      not_done(runs_of(sweep.plan, read_closed_rungs(sweep.folder, sweep.head)),
               all_logs(sweep.folder), sweep.head, damaged);
  print_warnings(damaged);
  return left;
}

/// Executes the remaining runs together with the other ranks.
void run_together(const mpi::Session& session, const OpenSweep& sweep,
                  const MpiArguments& arguments) {
  RunList list(left_on_first(session, sweep));
  const std::size_t count = list.size();
  std::size_t given = 0;
  std::unique_ptr<ProgressBar> bar;
  if (session.rank() == 0) bar = std::make_unique<ProgressBar>("sweep");
  mpi::SharedWork work(
      session,
      [&]() -> std::optional<mpi::Piece> {
        const std::optional<RunKey> key = list.next();
        if (!key) return std::nullopt;
        bar->show(static_cast<double>(given++) / static_cast<double>(count));
        return mpi::Piece{key->point, key->seed};
      },
      count);
  const Shard rank{static_cast<std::size_t>(session.rank()) + 1,
                   static_cast<std::size_t>(session.ranks())};
  ResultLog log(rank_log(sweep.folder, rank), sweep.head, arguments.save_every_s);
  RunControl control;
  control.stop = &interrupted();
  const NextRun next = [&]() -> std::optional<RunKey> {
    const std::optional<mpi::Piece> piece = work.next();
    if (!piece) return std::nullopt;
    return RunKey{piece->first, piece->second};
  };
  do_runs(sweep.plan, sweep.means, next, log, control, {});
}

/// Merges on rank 0 and broadcasts the result.
Merged merge_on_first(const mpi::Session& session, const OpenSweep& sweep, bool with_page) {
  Merged merged;
  if (session.rank() == 0) merged = merge_sweep(sweep.folder, with_page);
  merged.complete = session.from_first(merged.complete ? 1 : 0) != 0;
  merged.closed_a_rung = session.from_first(merged.closed_a_rung ? 1 : 0) != 0;
  merged.exit_code =
      static_cast<int>(session.from_first(static_cast<std::uint64_t>(merged.exit_code)));
  return merged;
}

int sweep_together(const mpi::Session& session, const MpiArguments& arguments) {
  catch_interrupts();
  const OpenSweep sweep = open_sweep(arguments.suite, arguments.out);
  if (session.rank() == 0) print_warnings(sweep.diagnostics);
  for (;;) {
    session.barrier();  // So that all ranks have checked the folder, or see the open rung.
    run_together(session, sweep, arguments);
    session.barrier();
    const bool stopped = session.sum(interrupted() ? 1 : 0) > 0;
    const Merged merged = merge_on_first(session, sweep, !arguments.no_page);
    if (stopped) return kExitInterrupted;
    if (!merged.closed_a_rung || merged.complete) return merged.exit_code;
  }
}

/// Parses the command line; the exit code if there is nothing else to do, as after --help.
std::optional<int> parse(int argc, char** argv, MpiArguments& arguments) {
  CLI::App app(
      "Do a sweep with all ranks of mpirun\n\n"
      "A sweep as 'tagfield sweep' does it (see tagfield sweep --help): each rank takes new runs "
      "when\n"
      "it has finished others. A sweep that was begun with shards can be resumed here, and the\n"
      "other way round.",
      "tagfield_sweep_mpi");
  app.add_option("SUITE", arguments.suite, "Suite file (YAML)")->required();
  app.add_option("--out", arguments.out, "Folder of the sweep (default runs/sweep_NAME)");
  app.add_option("--save-every", arguments.save_every_s,
                 "Seconds of work that are lost at most when a process is killed (default 5)")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_flag("--no-page", arguments.no_page, "Write the data only, no sweep.html");
  app.footer("For example:\n  mpirun -np 4 tagfield_sweep_mpi SUITE --out DIR");
  // For the build only, which installs the page with the others.
  if (argc == 3 && std::string_view(argv[1]) == "--man-page") {
    write_text_file(argv[2], man_page(app, TAGFIELD_VERSION, ""));
    return kExitOk;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "tagfield_sweep_mpi: {} (see --help)\n", error.what());
    return kExitBadInput;
  }
  return std::nullopt;
}

/// Reports an error and aborts all ranks, so that one common to all is reported once.
[[noreturn]] void complain(const mpi::Session& session, const std::string& what, int code) {
  fmt::print(stderr, "tagfield_sweep_mpi: {}{}\n",
             session.ranks() > 1 ? fmt::format("rank {}: ", session.rank()) : "", what);
  std::fflush(stderr);
  mpi::Session::abort(code);
}

int parse_and_sweep(int argc, char** argv) {
  MpiArguments arguments;
  if (const std::optional<int> code = parse(argc, argv, arguments)) return *code;
  const mpi::Session session(argc, argv);
  try {
    return sweep_together(session, arguments);
  } catch (const Error& error) {
    complain(session, error.what(), kExitBadInput);
  } catch (const std::bad_alloc&) {
    complain(session, "there is not enough memory for this", kExitBadInput);
  } catch (const std::exception& error) {
    complain(session, fmt::format("internal error: {}", error.what()), kExitFailure);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_sweep(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tagfield_sweep_mpi: {}\n", error.what());
    return kExitFailure;
  }
}
