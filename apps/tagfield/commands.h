// SPDX-License-Identifier: Apache-2.0
/// @file
/// The subcommands. Each adds itself to the command line and, once parsed, runs.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tagfield {

/// Runs the chosen subcommand; returns the exit code.
using Action = std::function<int()>;

/// Adds all of the commands below.
void add_commands(CLI::App& app, Action& chosen);

void add_new_command(CLI::App& app, Action& chosen);
void add_run_command(CLI::App& app, Action& chosen);
void add_localize_command(CLI::App& app, Action& chosen);
void add_report_command(CLI::App& app, Action& chosen);
void add_check_command(CLI::App& app, Action& chosen);
void add_explain_command(CLI::App& app, Action& chosen);
void add_coverage_command(CLI::App& app, Action& chosen);
void add_plan_command(CLI::App& app, Action& chosen);
void add_track_command(CLI::App& app, Action& chosen);
void add_calibrate_command(CLI::App& app, Action& chosen);
void add_bench_command(CLI::App& app, Action& chosen);
void add_score_command(CLI::App& app, Action& chosen);
void add_compare_command(CLI::App& app, Action& chosen);
void add_sweep_command(CLI::App& app, Action& chosen);
void add_events_command(CLI::App& app, Action& chosen);
void add_stream_command(CLI::App& app, Action& chosen);
void add_serve_command(CLI::App& app, Action& chosen);
void add_view_command(CLI::App& app, Action& chosen);
void add_gazebo_command(CLI::App& app, Action& chosen);
void add_doctor_command(CLI::App& app, Action& chosen);
void add_completion_command(CLI::App& app, Action& chosen);
void add_man_command(CLI::App& app, Action& chosen);

}  // namespace tagfield
