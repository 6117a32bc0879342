// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/known_world.h"

#include <complex>
#include <map>
#include <memory>

#include "tagfield/base/units.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/field/radio_link.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;

struct KnownTag {
  std::shared_ptr<const TagModel> model;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

struct KnownWorld {
  std::shared_ptr<const RadioWorld> world;
  std::map<std::string, AntennaParameters> antennas;
  std::map<std::string, KnownTag> tags;
};

/// What replies from one place have in common.
struct PlacedTag {
  const TagModel& model;
  RigidTransform X_WT;
  ImageSet images;
};

/// A path as if it came straight, without what its length does to it. `reversed`: it was traced
/// from the tag.
TracedWave wave_of(const RadioPath& path, bool reversed, const Complex& gain,
                   const Eigen::Vector3d& p_WT, double wave_number) {
  const Eigen::Vector3d arrival_W = reversed ? Eigen::Vector3d(-path.departure_W) : path.arrival_W;
  const Eigen::Vector3d departure_W =
      reversed ? Eigen::Vector3d(-path.arrival_W) : path.departure_W;
  return {p_WT - path.length_m * arrival_W,
          gain * path.length_m * std::polar(1.0, wave_number * path.length_m), departure_W,
          path.bounce_count == 0};
}

std::vector<TracedWave> waves_from(const RadioModel& model, const RadioWorld& world,
                                   const Carrier& carrier, const TraceOptions& tracing,
                                   const RigidTransform& X_WA, const PlacedTag& tag,
                                   std::vector<RadioPath>& paths) {
  const ChannelEffects effects{model.effects.patterns, model.effects.polarization};
  const RadioEnd antenna{model.antenna, X_WA};
  const RadioEnd at_tag{tag.model.antenna, tag.X_WT};
  // The tag's images serve all poses, but only from within the same solids.
  const bool reversed = shells_around(world.scene, X_WA.translation) == tag.images.around;
  if (reversed) {
    trace_paths(world.scene, tag.images, X_WA.translation, tracing, paths);
  } else {
    trace_paths(world.scene, images_of(world.scene, X_WA.translation, tracing),
                tag.X_WT.translation, tracing, paths);
  }
  std::vector<TracedWave> waves;
  waves.reserve(paths.size());
  for (const RadioPath& path : paths) {
    const Complex gain = reversed ? path_gain(path, at_tag, antenna, world, carrier, effects)
                                  : path_gain(path, antenna, at_tag, world, carrier, effects);
    waves.push_back(wave_of(path, reversed, gain, tag.X_WT.translation, carrier.wave_number));
  }
  return waves;
}

TracedReply reply_to(const RadioModel& model, const RadioWorld& world, const Carrier& carrier,
                     const TraceOptions& tracing, const RigidTransform& X_WA, const PlacedTag& tag,
                     std::vector<RadioPath>& paths) {
  TracedReply reply;
  reply.forward = waves_from(model, world, carrier, tracing, X_WA, tag, paths);
  if (model.X_AR) {
    reply.backward = waves_from(model, world, carrier, tracing, X_WA * *model.X_AR, tag, paths);
  }
  return reply;
}

KnownTag tag_named(const KnownWorld& known, const std::string& tag) {
  const auto found = known.tags.find(tag);
  return found == known.tags.end() ? KnownTag{default_tag_model()} : found->second;
}

std::vector<TracedReply> trace(const KnownWorld& known, const std::string& tag,
                               const Eigen::Vector3d& p_WT, const std::string& antenna,
                               const std::vector<RigidTransform>& X_WA,
                               const std::vector<double>& carriers_hz) {
  std::vector<TracedReply> replies(X_WA.size());
  const auto parameters = known.antennas.find(antenna);
  if (parameters == known.antennas.end()) return replies;
  const RadioModel& model = *physical(parameters->second);
  const KnownTag kind = tag_named(known, tag);
  const TraceOptions tracing =
      bare_view(model, *known.world, RigidTransform{}, kSpeedOfLight, 0, 0).tracing;
  const PlacedTag placed{
      *kind.model, {kind.rotation, p_WT}, images_of(known.world->scene, p_WT, tracing)};
  std::map<double, Carrier> carriers;
  std::vector<RadioPath> paths;
  for (std::size_t i = 0; i < X_WA.size(); ++i) {
    auto carrier = carriers.find(carriers_hz[i]);
    if (carrier == carriers.end()) {
      carrier = carriers.emplace(carriers_hz[i], carrier_in(*known.world, carriers_hz[i])).first;
    }
    replies[i] = reply_to(model, *known.world, carrier->second, tracing, X_WA[i], placed, paths);
  }
  return replies;
}

}  // namespace

TraceReplies traced_replies(const Scenario& scenario) {
  auto known = std::make_shared<KnownWorld>();
  known->world = radio_world_of(scenario);
  for (const AntennaSpec& antenna : scenario.antennas) {
    if (physical(antenna.parameters) == nullptr || !meets_world(antenna.parameters)) continue;
    known->antennas.emplace(antenna.parameters.name, antenna.parameters);
  }
  if (known->antennas.empty()) return nullptr;
  for (const TagSpec& tag : scenario.tags) {
    if (moves(tag)) continue;
    const auto model = tag.model ? tag.model : default_tag_model();
    known->tags[tag.id] = {model, tag.motion.front().X_WB.rotation};
  }
  return [known](const std::string& tag, const Eigen::Vector3d& p_WT, const std::string& antenna,
                 const std::vector<RigidTransform>& X_WA, const std::vector<double>& carriers_hz) {
    return trace(*known, tag, p_WT, antenna, X_WA, carriers_hz);
  };
}

}  // namespace tagfield
