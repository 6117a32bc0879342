// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/known_world.h"

#include <algorithm>
#include <complex>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

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

/// Cache of images for positions that are requested repeatedly: antennas by many tags and many
/// positions of a tag, and a tag by all antennas and each iteration of a fit. Thread-safe.
class KeptImages {
 public:
  std::shared_ptr<const ImageSet> at(const RadioScene& scene, const Eigen::Vector3d& p_W,
                                     const TraceOptions& tracing) {
    const Key key{tracing.order, p_W.x(), p_W.y(), p_W.z()};
    {
      const std::lock_guard lock(mutex_);
      const auto found = images_.find(key);
      if (found != images_.end() && found->second.first == tracing) return found->second.second;
    }
    auto images = std::make_shared<const ImageSet>(images_of(scene, p_W, tracing));
    const std::lock_guard lock(mutex_);
    if (count_ > kMost) {
      images_.clear();
      count_ = 0;
    }
    images_[key] = {tracing, images};
    count_ += images->images.size() + 1;
    return images;
  }

 private:
  static constexpr std::size_t kMost = 1000000;  ///< Number of images, about 100 MB.
  using Key = std::tuple<int, double, double, double>;
  std::mutex mutex_;
  std::map<Key, std::pair<TraceOptions, std::shared_ptr<const ImageSet>>> images_;
  std::size_t count_ = 0;  ///< Of all sets' images.
};

struct KnownWorld {
  std::shared_ptr<const RadioWorld> world;
  mutable KeptImages images;
  std::map<std::string, AntennaParameters> antennas;
  std::map<std::string, KnownTag> tags;
};

/// What replies from one tag position have in common.
struct PlacedTag {
  const TagModel& model;
  RigidTransform X_WT;
  const ImageSet& images;
};

/// A path as a straight wave from its image source, with the effect of its length divided out.
/// `reversed`: it was traced from the tag.
TracedWave wave_of(const RadioPath& path, bool reversed, const Complex& gain,
                   const Eigen::Vector3d& p_WT, double wave_number) {
  const Eigen::Vector3d arrival_W = reversed ? Eigen::Vector3d(-path.departure_W) : path.arrival_W;
  const Eigen::Vector3d departure_W =
      reversed ? Eigen::Vector3d(-path.arrival_W) : path.departure_W;
  return {p_WT - path.length_m * arrival_W,
          gain * path.length_m * std::polar(1.0, wave_number * path.length_m), departure_W,
          path.bounce_count == 0};
}

/// A reader's antenna in the known world.
struct KnownAntenna {
  const RadioModel& model;
  const RadioWorld& world;
  TraceOptions tracing;
  KeptImages& images;
};

std::vector<TracedWave> waves_from(const KnownAntenna& known, const Carrier& carrier,
                                   const RigidTransform& X_WA, const PlacedTag& tag,
                                   std::vector<RadioPath>& paths) {
  const auto& [model, world, tracing, images] = known;
  const ChannelEffects effects{model.effects.patterns, model.effects.polarization};
  const RadioEnd antenna{model.antenna, X_WA};
  const RadioEnd at_tag{tag.model.antenna, tag.X_WT};
  // The tag's images can be used for all antenna poses, but only inside the same solids.
  const bool reversed = shells_around(world.scene, X_WA.translation) == tag.images.around;
  if (reversed) {
    trace_paths(world.scene, tag.images, X_WA.translation, tracing, paths);
  } else {
    trace_paths(world.scene, *images.at(world.scene, X_WA.translation, tracing),
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

TracedReply reply_to(const KnownAntenna& known, const Carrier& carrier, const RigidTransform& X_WA,
                     const PlacedTag& tag, std::vector<RadioPath>& paths) {
  TracedReply reply;
  reply.forward = waves_from(known, carrier, X_WA, tag, paths);
  if (known.model.X_AR) {
    reply.backward = waves_from(known, carrier, X_WA * *known.model.X_AR, tag, paths);
  }
  return reply;
}

/// Whether the model of an antenna's waves has reflections.
bool reflects(const AntennaParameters& antenna) {
  const RadioModel* const model = physical(antenna);
  return model != nullptr && model->effects.reflections && model->reflection_order > 0;
}

KnownTag tag_named(const KnownWorld& known, const std::string& tag) {
  const auto found = known.tags.find(tag);
  return found == known.tags.end() ? KnownTag{default_tag_model()} : found->second;
}

std::vector<TracedReply> trace_from(const KnownAntenna& known, const TracedFrom& from,
                                    const PlacedTag& tag) {
  std::map<double, Carrier> carriers;
  std::vector<RadioPath> paths;
  std::vector<TracedReply> replies(from.X_WA.size());
  for (std::size_t i = 0; i < from.X_WA.size(); ++i) {
    auto carrier = carriers.find(from.carriers_hz[i]);
    if (carrier == carriers.end()) {
      carrier =
          carriers.emplace(from.carriers_hz[i], carrier_in(known.world, from.carriers_hz[i])).first;
    }
    replies[i] = reply_to(known, carrier->second, from.X_WA[i], tag, paths);
  }
  return replies;
}

TracedReplies trace(const KnownWorld& known, const std::string& tag, const Eigen::Vector3d& p_WT,
                    const std::map<std::string, TracedFrom>& antennas) {
  const KnownTag kind = tag_named(known, tag);
  TracedReplies replies;
  for (const auto& [antenna, from] : antennas) {
    std::vector<TracedReply>& of_antenna = replies[antenna];
    const auto parameters = known.antennas.find(antenna);
    if (parameters == known.antennas.end()) {
      of_antenna.resize(from.X_WA.size());
      continue;
    }
    const RadioModel& model = *physical(parameters->second);
    const TraceOptions tracing =
        bare_view(model, *known.world, RigidTransform{}, kSpeedOfLight, 0, 0).tracing;
    const auto images = known.images.at(known.world->scene, p_WT, tracing);
    const PlacedTag placed{*kind.model, {kind.rotation, p_WT}, *images};
    of_antenna = trace_from({model, *known.world, tracing, known.images}, from, placed);
  }
  return replies;
}

}  // namespace

TraceReplies traced_replies(const Scenario& scenario) {
  const bool any_reflects =
      std::any_of(scenario.antennas.begin(), scenario.antennas.end(),
                  [](const AntennaSpec& antenna) { return reflects(antenna.parameters); });
  if (!any_reflects) return nullptr;
  auto known = std::make_shared<KnownWorld>();
  known->world = radio_world_of(scenario);
  for (const AntennaSpec& antenna : scenario.antennas) {
    if (physical(antenna.parameters) == nullptr || !meets_world(antenna.parameters)) continue;
    known->antennas.emplace(antenna.parameters.name, antenna.parameters);
  }
  if (known->world->scene.facets().empty()) return nullptr;
  for (const TagSpec& tag : scenario.tags) {
    if (moves(tag)) continue;
    const auto model = tag.model ? tag.model : default_tag_model();
    known->tags[tag.id] = {model, tag.motion.front().X_WB.rotation};
  }
  return [known](const std::string& tag, const Eigen::Vector3d& p_WT,
                 const std::map<std::string, TracedFrom>& antennas) {
    return trace(*known, tag, p_WT, antennas);
  };
}

}  // namespace tagfield
