// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/commands.h"

namespace tagfield {

void add_commands(CLI::App& app, Action& chosen) { add_run_command(app, chosen); }

}  // namespace tagfield
