// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/radio_air.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "tagfield/base/error.h"
#include "tagfield/base/parallel.h"
#include "tagfield/field/internal/air_antenna.h"
#include "tagfield/field/radio_port.h"

namespace tagfield {
namespace {

double reach(const RadioModel& model, const TagPopulation& tags) {
  double max_m = 0.0;
  for (const auto& kind : tags.models()) max_m = std::max(max_m, max_range_m(model, *kind));
  return max_m;
}

/// Enough for the images of several thousand tags in a hall at order 2.
constexpr std::size_t kMaxImageBytes = std::size_t{512} << 20U;

/// Links are computed in blocks of this many tags,
constexpr std::size_t kBlock = 4096;
/// of which one thread takes this many at a time.
constexpr std::size_t kTagsAtATime = 16;
/// With fewer tags, starting threads costs more than it saves: where waves are reflected, and where
/// only obstacles on straight lines are looked for.
constexpr std::size_t kMinTracedTags = 48;
constexpr std::size_t kMinStraightTags = 512;

/// Calls `visit(slot, tag, link)` for each tag in the slots, in empty space.
template <class Visit>
void for_each_straight_link(const std::vector<std::uint32_t>& slots, const TagPopulation& tags,
                            const RadioView& view, const Visit& visit) {
  std::array<TagInView, kStraightLinks> some;
  std::array<RadioLink, kStraightLinks> links;
  for (std::size_t begin = 0; begin < slots.size(); begin += kStraightLinks) {
    const std::span<const std::uint32_t> now =
        std::span(slots).subspan(begin, std::min(kStraightLinks, slots.size() - begin));
    for (std::size_t i = 0; i < now.size(); ++i) {
      some[i] = {&tags.model(now[i]), {&tags.rotation(now[i]), &tags.position(now[i])}};
    }
    straight_links_of(view, {some.data(), now.size()}, {links.data(), now.size()});
    for (std::size_t i = 0; i < now.size(); ++i) {
      visit(now[i], TagEnd{tags.model(now[i]), tags.pose(now[i]), tags.key(now[i])}, links[i]);
    }
  }
}

}  // namespace

RadioAir::RadioAir(std::shared_ptr<const RadioWorld> world, int threads)
    : world_(std::move(world)),
      threads_(threads),
      memories_(std::make_unique<TagMemories>()),
      tag_images_(kMaxImageBytes) {}
RadioAir::~RadioAir() = default;
RadioAir::RadioAir(RadioAir&&) noexcept = default;
RadioAir& RadioAir::operator=(RadioAir&&) noexcept = default;

void RadioAir::set_world(std::shared_ptr<const RadioWorld> world) {
  world_ = std::move(world);
  // The images are those of the previous world.
  tag_images_ = ImageCache(kMaxImageBytes);
  for (const auto& antenna : antennas_) {
    antenna->images.reset();
    antenna->receiver_images.reset();
    antenna->memories.clear();
    antenna->receiver_memories.clear();
    antenna->at_rest = {};
  }
}

void RadioAir::see(const std::vector<MovingBody>& bodies, Time now) { bodies_.see(bodies, now); }

std::vector<MovingBody> RadioAir::bodies_at(const RadioModel& model, Time stamp) const {
  return model.effects.bodies ? bodies_.at(stamp) : std::vector<MovingBody>{};
}

AirAntenna& RadioAir::antenna_named(const std::string& name) {
  for (const auto& antenna : antennas_) {
    if (antenna->parameters.name == name) return *antenna;
  }
  throw Error(fmt::format("there is no antenna '{}' in the air", name));
}

void RadioAir::add(const AntennaParameters& parameters, std::uint64_t seed) {
  auto antenna = std::make_unique<AirAntenna>();
  antenna->parameters = parameters;
  antenna->port = {stream_key(parameters.name), stream_key(parameters.reader), 0, seed};
  const RadioModel& model = antenna->model();
  if (takes_inventory(model)) {
    antenna->inventory =
        std::make_unique<Inventory>(model.gen2->link, model.gen2->inventory, *memories_,
                                    antenna->port.seed, antenna->port.antenna_key);
  }
  antennas_.push_back(std::move(antenna));
  plan_turns();
}

void RadioAir::remove(const std::string& name) {
  const auto found = std::find_if(antennas_.begin(), antennas_.end(), [&](const auto& antenna) {
    return antenna->parameters.name == name;
  });
  if (found == antennas_.end()) return;
  if ((*found)->inventory && (*found)->inventory->on()) (*found)->inventory->stop(*motion_.seen());
  antennas_.erase(found);
  plan_turns();
}

/// Plans the turns of ports, and each reader's index among all.
void RadioAir::plan_turns() {
  std::vector<AntennaParameters> all;
  for (const auto& antenna : antennas_) all.push_back(antenna->parameters);
  for (const auto& antenna : antennas_) {
    antenna->port.turn = reader_number(all, antenna->parameters.reader);
  }
  cycles_ = port_cycles(all);
}

void RadioAir::forget_tag(std::uint32_t slot) {
  for (const auto& antenna : antennas_) {
    if (antenna->inventory) antenna->inventory->forget(slot);
    for (auto* memories : {&antenna->memories, &antenna->receiver_memories}) {
      if (slot < memories->size()) (*memories)[slot] = {};
    }
    auto& pending = antenna->pending;
    pending.erase(std::remove_if(pending.begin(), pending.end(),
                                 [&](const auto& read) { return read.slot == slot; }),
                  pending.end());
  }
  memories_->forget(slot);
  tag_images_.forget(slot);
  motion_.forget(slot);
}

void RadioAir::expect_no_more_of(const std::string& name) { antenna_named(name).is_over = true; }

/// An antenna powers no tag before its first update.
Time RadioAir::complete_until() const {
  Time until = Time::max();
  for (const auto& antenna : antennas_) {
    const bool is_awaited = antenna->inventory && antenna->updated && !antenna->is_over;
    if (!is_awaited) continue;
    until = std::min({until, *antenna->updated, antenna->inventory->next_read_after()});
  }
  return until;
}

std::optional<InventoryCounts> RadioAir::counts(const std::string& name) const {
  for (const auto& antenna : antennas_) {
    if (antenna->parameters.name == name && antenna->inventory) return antenna->inventory->counts();
  }
  return std::nullopt;
}

void RadioAir::expect(const std::string& name, const RigidTransform& X_WA) {
  if (!is_finite(X_WA)) return;
  for (const auto& antenna : antennas_) {
    if (antenna->parameters.name == name) antenna->X_WA_sending = X_WA;
  }
}

void RadioAir::update(const std::string& name, const RigidTransform& X_WA, Time now,
                      const TagPopulation& tags, std::vector<TagReply>& replies) {
  replies.clear();
  AirAntenna& antenna = antenna_named(name);
  if (!is_finite(X_WA)) return;
  antenna.X_WA_sending = X_WA;
  couplings_seen_ = false;
  const Time seen = motion_.seen().value_or(now);
  if (!motion_.seen() || now > seen) {
    motion_.see(tags, now);
    run_inventories(seen, now, tags);
  }
  if (antenna.inventory) {
    read_pending(antenna, X_WA, now, tags, replies);
    refresh_field(antenna, X_WA, now, tags);
  } else {
    read_all(antenna, X_WA, now, tags, replies);
  }
  antenna.updated = now;
  antenna.X_WA = X_WA;
}

void RadioAir::run_inventories(Time begin, Time now, const TagPopulation& tags) {
  while (begin < now) {
    Time end = next_change(cycles_, begin).value_or(now);
    if (cycles_.size() > 1) end = std::min(end, begin + kReadersSideBySide);
    end = std::min(end, now);
    run_piece(begin, end, tags);
    begin = end;
  }
}

/// Runs an interval in which no reader switches ports.
void RadioAir::run_piece(Time begin, Time end, const TagPopulation& tags) {
  std::set<std::string> senders;
  for (const PortCycle& cycle : cycles_) senders.insert(antenna_on_turn(cycle, begin));
  for (const auto& antenna : antennas_) {
    if (antenna->inventory && senders.count(antenna->parameters.name) == 0) {
      antenna->inventory->stop(begin);
    }
  }
  for (const auto& antenna : antennas_) {
    if (!antenna->inventory || senders.count(antenna->parameters.name) == 0) continue;
    antenna->inventory->start(begin);
    read_.clear();
    antenna->inventory->run_until(end, read_);
    for (const Singulation& read : read_) {
      antenna->pending.push_back({read.tag, read.stamp, motion_.pose(read.tag, read.stamp, tags)});
    }
  }
}

/// Whether everything that the antenna's links depend on, except the carrier, is unchanged since
/// its last update. Otherwise clears the previous results.
bool RadioAir::sees_the_same(AirAntenna& antenna, const RigidTransform& X_WA,
                             const TagPopulation& tags) {
  AirAntenna::AtRest& rest = antenna.at_rest;
  const bool is_alone = bodies_.empty() && !is_disturbed(antenna.model());
  const bool is_same = is_alone && rest.is_known && rest.tags == tags.version() &&
                       rest.X_WA.translation == X_WA.translation &&
                       rest.X_WA.rotation.coeffs() == X_WA.rotation.coeffs();
  if (is_same) return true;
  rest = {};
  rest.X_WA = X_WA;
  rest.tags = tags.version();
  rest.is_known = is_alone;
  return false;
}

RadioLink RadioAir::link_of_read(AirAntenna& antenna, const RigidTransform& X_WA,
                                 const RigidTransform& X_WT, std::uint32_t slot, Time stamp,
                                 double frequency_hz, const TagPopulation& tags) {
  RadioView view = bare_view_of(antenna, *world_, X_WA, frequency_hz);
  view.bodies = bodies_at(antenna.model(), stamp);
  const ImageSet* const images = tag_images(view, slot, X_WT);
  if (images == nullptr) add_images(antenna, view);
  TagEnd tag{tags.model(slot), X_WT, tags.key(slot), images};
  TagSurroundings around;
  surround(tag, slot, stamp, tags, antenna, view, around);
  return link_of(view, tag, paths_);
}

void RadioAir::read_pending(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                            const TagPopulation& tags, std::vector<TagReply>& replies) {
  const Eigen::Vector3d velocity = antenna.velocity(X_WA, now);
  const bool is_same = sees_the_same(antenna, X_WA, tags);
  for (const AirAntenna::Pending& read : antenna.pending) {
    const RigidTransform X_WA_then = antenna.pose_at(read.stamp, X_WA, now);
    const CarrierNow carrier = carrier_at(antenna.model(), antenna.port, read.stamp);
    RadioLink link;
    auto& known = antenna.at_rest.read[carrier.frequency_hz];
    const auto found = known.find(read.slot);
    if (is_same && found != known.end()) {
      link = found->second;
    } else {
      link = link_of_read(antenna, X_WA_then, read.X_WT, read.slot, read.stamp,
                          carrier.frequency_hz, tags);
      if (is_same) known[read.slot] = link;
    }
    const TagEnd tag{tags.model(read.slot), read.X_WT, tags.key(read.slot)};
    replies.push_back(report(antenna.model(), antenna.port, carrier, link, tag,
                             velocity - motion_.velocity(read.slot), read.stamp,
                             antenna.interference_mw));
    replies.back().slot = read.slot;
    replies.back().distance_m = (read.X_WT.translation - X_WA_then.translation).norm();
  }
  antenna.pending.clear();
}

/// The tag's own images, if it is at rest and inside the same solids as the antenna: a single tag
/// is then traced without computing all images of the antenna. Null otherwise.
const ImageSet* RadioAir::tag_images(const RadioView& view, std::uint32_t slot,
                                     const RigidTransform& X_WT) {
  const ImageSet* const images =
      tag_images_.find(world_->scene, slot, X_WT.translation, view.tracing);
  if (images == nullptr) return nullptr;
  const auto fits = [&](const RigidTransform& X) {
    return shells_around(world_->scene, X.translation) == images->around;
  };
  return fits(view.X_WA) && (!view.model.X_AR || fits(view.X_WR)) ? images : nullptr;
}

/// The tag at its current pose. If there are few tags, each has its own images, because a moving
/// antenna would have to recompute its images at every update; if there are many, the antenna's
/// images serve all.
TagEnd RadioAir::tag_end(AirAntenna& antenna, std::uint32_t slot, const TagPopulation& tags,
                         RadioView& view, TagSurroundings& around) {
  TagEnd tag{tags.model(slot), tags.pose(slot), tags.key(slot)};
  if (tags.size() <= kMaxTagsWithImages) tag.images = tag_images(view, slot, tag.X_WT);
  if (tag.images == nullptr && !view.images) add_images(antenna, view);
  surround(tag, slot, *motion_.seen(), tags, antenna, view, around);
  if (slot < antenna.memories.size()) tag.memory = &antenna.memories[slot];
  if (slot < antenna.receiver_memories.size()) {
    tag.receiver_memory = &antenna.receiver_memories[slot];
  }
  return tag;
}

/// Sets `around` to the neighbours coupled with the tag, if its antenna simulates coupling, with
/// all poses as of `stamp`, and lets the tag refer to it.
void RadioAir::surround(TagEnd& tag, std::uint32_t slot, Time stamp, const TagPopulation& tags,
                        AirAntenna& antenna, RadioView& view, TagSurroundings& around) {
  if (!couples_tags(antenna.model())) return;
  if (!couplings_seen_) couplings_.see(tags);
  couplings_seen_ = true;
  const CoupledTag& coupled = couplings_.of(slot, view.carrier.lambda_m);
  if (coupled.neighbours.empty()) return;
  around.own = coupled.own;
  around.neighbours.clear();
  for (const auto& [other, share] : coupled.neighbours) {
    around.neighbours.push_back(
        {&tags.model(other), motion_.pose(other, stamp, tags), tags.key(other), share});
  }
  tag.around = &around;
  if (!view.images) add_images(antenna, view);
}

/// Antennas of other readers that transmit now, if the antenna simulates their interference.
std::vector<OtherSender> RadioAir::others_of(AirAntenna& antenna, Time now) {
  std::vector<OtherSender> others;
  if (!is_disturbed(antenna.model())) return others;
  std::vector<AntennaParameters> all;
  for (const auto& known : antennas_) all.push_back(known->parameters);
  for (const SendingAntenna& sending : others_sending(all, antenna.parameters, now)) {
    AirAntenna& other = *antennas_[sending.number];
    const bool is_gone = other.is_over && (!other.updated || *other.updated < now);
    if (!other.X_WA_sending || is_gone) continue;
    const CarrierNow carrier = carrier_at(other.model(), other.port, now);
    RadioView view = bare_view_of(other, *world_, *other.X_WA_sending, carrier.frequency_hz);
    view.bodies = bodies_at(other.model(), now);
    add_images(other, view);
    others.push_back({other.parameters.reader, other.parameters.name, view, sending.time_share});
  }
  return others;
}

/// Computes the interference of the others at the antenna from now on.
void RadioAir::look_at_others(AirAntenna& antenna, RadioView& view,
                              const std::vector<OtherSender>& others) {
  antenna.interference_mw = 0.0;
  if (others.empty()) return;
  if (!view.images) add_images(antenna, view);
  for (const OtherSender& other : others) {
    antenna.interference_mw += received_from(other, view, paths_).in_replies_mw;
  }
}

Disturbance RadioAir::disturbance_of(const AirAntenna& antenna,
                                     const std::vector<OtherSender>& others, const TagEnd& tag) {
  Disturbance disturbance{antenna.interference_mw, 0.0};
  for (const OtherSender& other : others) {
    disturbance.at_tag_mw += power_at_tag_mw(other, tag, paths_);
  }
  return disturbance;
}

/// Calls `visit(slot, tag, link)` for each tag in slots_.
template <class Visit>
void RadioAir::for_each_link(AirAntenna& antenna, const TagPopulation& tags, RadioView& view,
                             const Visit& visit) {
  if (is_empty_space(view) && !couples_tags(antenna.model())) {
    for_each_straight_link(slots_, tags, view, visit);
    return;
  }
  make_room(slots_, view, antenna);
  for (std::size_t begin = 0; begin < slots_.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, slots_.size() - begin);
    if (arounds_.size() < count) arounds_.resize(count);
    ends_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      ends_.push_back(tag_end(antenna, slots_[begin + i], tags, view, arounds_[i]));
    }
    compute_links(view);
    for (std::size_t i = 0; i < count; ++i) visit(slots_[begin + i], ends_[i], links_[i]);
  }
}

/// Sets links_ to those to ends_.
void RadioAir::compute_links(const RadioView& view) {
  links_.resize(ends_.size());
  const std::size_t least = view.tracing.order > 0 ? kMinTracedTags : kMinStraightTags;
  if (threads_ <= 1 || ends_.size() < least) {
    links_of(view, ends_, paths_, links_);
    return;
  }
  parallel_for((ends_.size() + kTagsAtATime - 1) / kTagsAtATime, threads_, [&](std::size_t part) {
    thread_local std::vector<RadioPath> paths;
    const std::size_t begin = part * kTagsAtATime;
    const std::size_t count = std::min(kTagsAtATime, ends_.size() - begin);
    links_of(view, std::span(ends_).subspan(begin, count), paths,
             std::span(links_).subspan(begin, count));
  });
}

void RadioAir::read_all(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                        const TagPopulation& tags, std::vector<TagReply>& replies) {
  const Eigen::Vector3d velocity = antenna.velocity(X_WA, now);
  const CarrierNow carrier = carrier_at(antenna.model(), antenna.port, now);
  RadioView view = bare_view_of(antenna, *world_, X_WA, carrier.frequency_hz);
  view.bodies = bodies_at(antenna.model(), now);
  const std::vector<OtherSender> others = others_of(antenna, now);
  look_at_others(antenna, view, others);
  tags.index().within(X_WA.translation, reach(antenna.model(), tags), slots_);
  const auto read = [&](std::uint32_t slot, const TagEnd& tag, const RadioLink& link) {
    if (!is_heard(link, tag.model, antenna.model())) return;
    const Disturbance disturbance = disturbance_of(antenna, others, tag);
    if (!is_read(antenna.model(), link, tag, disturbance)) return;
    replies.push_back(report(antenna.model(), antenna.port, carrier, link, tag,
                             velocity - motion_.velocity(slot), now, disturbance.in_replies_mw));
    replies.back().slot = slot;
    replies.back().distance_m = (tag.X_WT.translation - X_WA.translation).norm();
  };
  for_each_link(antenna, tags, view, read);
}

/// Fills field_ with the tags that have power until the next update, on the current carrier.
void RadioAir::find_powered(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                            const TagPopulation& tags) {
  const CarrierNow carrier = carrier_at(antenna.model(), antenna.port, now);
  const auto known = antenna.at_rest.powered.find(carrier.frequency_hz);
  if (known != antenna.at_rest.powered.end()) {
    field_ = known->second;
    return;
  }
  RadioView view = bare_view_of(antenna, *world_, X_WA, carrier.frequency_hz);
  view.bodies = bodies_at(antenna.model(), now);
  const std::vector<OtherSender> others = others_of(antenna, now);
  look_at_others(antenna, view, others);
  tags.index().within(X_WA.translation, reach(antenna.model(), tags), slots_);
  const auto power = [&](std::uint32_t slot, const TagEnd& tag, const RadioLink& link) {
    std::optional<TagOnAir> powered =
        on_air(antenna.model(), link, tag, disturbance_of(antenna, others, tag));
    if (!powered) return;
    powered->tag = slot;
    field_.push_back(*powered);
  };
  for_each_link(antenna, tags, view, power);
  if (antenna.at_rest.is_known) antenna.at_rest.powered[carrier.frequency_hz] = field_;
}

/// Sets the tags that have power until the next update.
void RadioAir::refresh_field(AirAntenna& antenna, const RigidTransform& X_WA, Time now,
                             const TagPopulation& tags) {
  field_.clear();
  if (has_turn_soon(antenna, cycles_, now)) find_powered(antenna, X_WA, now, tags);
  antenna.inventory->set_field(now, field_);
}

}  // namespace tagfield
