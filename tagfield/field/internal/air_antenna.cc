// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/internal/air_antenna.h"

#include <algorithm>
#include <string>

namespace tagfield {
namespace {

/// `kept` if it is for this position, otherwise recomputed.
std::shared_ptr<const ImageSet> images_at(const RigidTransform& X, const RadioView& view,
                                          std::shared_ptr<const ImageSet>& kept) {
  if (!kept || kept->p_WA != X.translation) {
    kept =
        std::make_shared<const ImageSet>(images_of(view.world.scene, X.translation, view.tracing));
  }
  return kept;
}

}  // namespace

RadioView bare_view_of(const AirAntenna& antenna, const RadioWorld& world,
                       const RigidTransform& X_WA, double frequency_hz) {
  return bare_view(antenna.model(), world, X_WA, frequency_hz, antenna.port.antenna_key,
                   antenna.port.seed);
}

void add_images(AirAntenna& antenna, RadioView& view) {
  view.images = images_at(view.X_WA, view, antenna.images);
  if (view.model.X_AR) view.receiver_images = images_at(view.X_WR, view, antenna.receiver_images);
}

void make_room(const std::vector<std::uint32_t>& slots, const RadioView& view,
               AirAntenna& antenna) {
  if (slots.empty() || (!view.tracing.occlusion && view.tracing.order == 0)) return;
  const std::size_t count = std::size_t{*std::max_element(slots.begin(), slots.end())} + 1;
  if (antenna.memories.size() < count) antenna.memories.resize(count);
  if (view.model.X_AR && antenna.receiver_memories.size() < count) {
    antenna.receiver_memories.resize(count);
  }
}

bool has_turn_soon(const AirAntenna& antenna, const std::vector<PortCycle>& cycles, Time now) {
  // One and a half intervals, because updates of a recording are irregular.
  const Duration interval = duration_from_seconds(1.5 / antenna.parameters.rate_hz);
  const std::string& name = antenna.parameters.name;
  return std::any_of(cycles.begin(), cycles.end(), [&](const PortCycle& cycle) {
    const auto turn = next_turn(cycle, name, now);
    return turn && *turn <= now + interval;
  });
}

}  // namespace tagfield
