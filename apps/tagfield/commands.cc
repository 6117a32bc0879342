// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/commands.h"

namespace tagfield {

void add_commands(CLI::App& app, Action& chosen) {
  add_new_command(app, chosen);
  add_run_command(app, chosen);
  add_localize_command(app, chosen);
  add_track_command(app, chosen);
  add_calibrate_command(app, chosen);
  add_report_command(app, chosen);
  add_check_command(app, chosen);
  add_explain_command(app, chosen);
  add_coverage_command(app, chosen);
  add_plan_command(app, chosen);
  add_bench_command(app, chosen);
  add_score_command(app, chosen);
  add_compare_command(app, chosen);
  add_sweep_command(app, chosen);
  add_events_command(app, chosen);
  add_stream_command(app, chosen);
  add_serve_command(app, chosen);
  add_view_command(app, chosen);
  add_gazebo_command(app, chosen);
  add_doctor_command(app, chosen);
  add_completion_command(app, chosen);
  add_man_command(app, chosen);
}

}  // namespace tagfield
