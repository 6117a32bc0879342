// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/rfid_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/field/internal/read_delivery.h"
#include "tagfield/field/radio_air.h"
#include "tagfield/field/tag_population.h"

namespace tagfield {
namespace {

/// Half of the published antennas' range, so that a query visits some 30 columns.
constexpr double kCell = 3.5;

std::shared_ptr<const RadioWorld> made(const FieldWorld& world, Diagnostics& diagnostics) {
  return std::make_shared<const RadioWorld>(radio_world(world.scene, world.materials, diagnostics));
}

std::shared_ptr<const RadioWorld> empty_unless(std::shared_ptr<const RadioWorld> world) {
  Diagnostics nothing_to_say;
  return world ? std::move(world) : made({}, nothing_to_say);
}

std::shared_ptr<const AntennaInfo> info_of(const FieldAntenna& antenna) {
  const AntennaParameters& parameters = antenna.parameters;
  return std::make_shared<const AntennaInfo>(
      AntennaInfo{parameters.name, parameters.reader, antenna.sensor, antenna.name_space,
                  antenna.frame_id, antenna.parent_frame, nominal_range_m(parameters),
                  antenna.is_fixed, meets_world(parameters)});
}

}  // namespace

class RfidField::Impl {
 public:
  Impl(Outlets outlets, std::shared_ptr<const RadioWorld> world, int threads);

  void step(const FieldStep& step);
  void finish() { delivery_.tell(Time::max()); }
  [[nodiscard]] std::vector<TagRead> held_reads(const std::string& reader) const {
    return delivery_.kept_reads(reader);
  }
  std::vector<std::string> take_warnings();
  [[nodiscard]] std::int64_t reads() const { return delivery_.reads(); }

 private:
  struct Antenna {
    std::shared_ptr<const FieldAntenna> antenna;
    std::shared_ptr<const AntennaInfo> info;
  };
  void add_antenna(const std::shared_ptr<const FieldAntenna>& antenna);
  void remove_antenna(const std::string& name);
  void set_world(const FieldWorld& world);
  void begin_anew();
  void require_tag(std::uint32_t number) const;
  const std::shared_ptr<const AntennaInfo>& info(
      const std::shared_ptr<const FieldAntenna>& antenna);
  void remove(std::uint32_t number, Time stamp);
  void add(const TagAdded& tag);
  void move(const std::vector<TagMoved>& moved);
  void tell_places(const FieldStep& step);
  void take_over(const std::shared_ptr<const FieldAntenna>& antenna, Time stamp);
  void update(const AntennaDue& due, Time stamp);

  ReadDelivery delivery_;
  TagPopulation tags_;             ///< Slots are the driver's numbers.
  std::vector<Antenna> antennas_;  ///< In the order in which they were added.
  std::shared_ptr<const RadioWorld> world_;
  int threads_;
  RadioAir air_;
  std::optional<Time> updated_;  ///< Stamp of the last step in which antennas were due.
  Diagnostics diagnostics_;
  std::size_t warnings_taken_ = 0;
  std::vector<std::uint32_t> moved_;  ///< Numbers; kept to save allocations.
  std::vector<TagReply> replies_;     ///< Same.
};

RfidField::Impl::Impl(Outlets outlets, std::shared_ptr<const RadioWorld> world, int threads)
    : delivery_(std::move(outlets)),
      tags_(kCell),
      world_(empty_unless(std::move(world))),
      threads_(threads),
      air_(world_, threads) {}

void RfidField::Impl::add_antenna(const std::shared_ptr<const FieldAntenna>& antenna) {
  const std::shared_ptr<const AntennaInfo> info = info_of(*antenna);
  antennas_.push_back({antenna, info});
  if (meets_world(antenna->parameters)) air_.add(antenna->parameters, antenna->seed);
  for (const auto& listener : delivery_.outlets().reads) listener->on_antenna_added(*info);
}

void RfidField::Impl::remove_antenna(const std::string& name) {
  air_.remove(name);
  antennas_.erase(std::remove_if(antennas_.begin(), antennas_.end(),
                                 [&](const Antenna& known) { return known.info->name == name; }),
                  antennas_.end());
  for (const auto& listener : delivery_.outlets().reads) listener->on_antenna_removed(name);
}

void RfidField::Impl::set_world(const FieldWorld& world) {
  try {
    world_ = made(world, diagnostics_);
  } catch (const Error& error) {
    diagnostics_.warn(fmt::format("the world is not used for propagation: {}", error.what()));
    return;
  }
  air_.set_world(world_);
}

/// Resets the air with the current antennas, without any state.
void RfidField::Impl::begin_anew() {
  delivery_.tell(Time::max());
  for (const auto& listener : delivery_.outlets().reads) listener->on_restart();
  air_ = RadioAir(world_, threads_);
  for (const Antenna& known : antennas_) {
    const FieldAntenna& antenna = *known.antenna;
    if (meets_world(antenna.parameters)) air_.add(antenna.parameters, antenna.seed);
  }
}

std::vector<std::string> RfidField::Impl::take_warnings() {
  const std::vector<std::string>& all = diagnostics_.warnings();
  std::vector<std::string> fresh(
      std::next(all.begin(), static_cast<std::ptrdiff_t>(warnings_taken_)), all.end());
  warnings_taken_ = all.size();
  return fresh;
}

void RfidField::Impl::require_tag(std::uint32_t number) const {
  if (!tags_.has(number)) throw Error(fmt::format("there is no tag of number {}", number));
}

/// The antenna's info, found by name; a driver may provide more information than when it was added.
const std::shared_ptr<const AntennaInfo>& RfidField::Impl::info(
    const std::shared_ptr<const FieldAntenna>& antenna) {
  const std::string& name = antenna->parameters.name;
  const auto known = std::find_if(antennas_.begin(), antennas_.end(),
                                  [&](const Antenna& entry) { return entry.info->name == name; });
  if (known == antennas_.end()) {
    throw Error(fmt::format("there is no antenna '{}' in the field", name));
  }
  if (known->antenna != antenna) *known = {antenna, info_of(*antenna)};
  return known->info;
}

void RfidField::Impl::remove(std::uint32_t number, Time stamp) {
  require_tag(number);
  delivery_.add_removed(stamp, tags_.id(number));
  air_.forget_tag(number);
  tags_.remove(number);
}

void RfidField::Impl::add(const TagAdded& tag) {
  if (!is_finite(tag.X_WT)) {
    throw Error(fmt::format("tag '{}' is not at a finite position", tag.id));
  }
  tags_.add(tag.number, tag.id, tag.X_WT.translation);
  tags_.turn(tag.number, tag.X_WT.rotation);
  if (tag.model) tags_.set_model(tag.number, tag.model);
}

void RfidField::Impl::move(const std::vector<TagMoved>& moved) {
  moved_.clear();
  for (const TagMoved& tag : moved) {
    if (!is_finite(tag.X_WT)) continue;
    require_tag(tag.number);
    tags_.move(tag.number, tag.X_WT.translation);
    tags_.turn(tag.number, tag.X_WT.rotation);
    moved_.push_back(tag.number);
  }
}

/// New tags at rest, by number; then those that moved, including new ones.
void RfidField::Impl::tell_places(const FieldStep& step) {
  if (delivery_.outlets().truth.empty()) return;
  std::map<std::uint32_t, const TagAdded*> fresh;
  for (const TagAdded& tag : step.added) fresh[tag.number] = &tag;
  std::map<std::uint32_t, const TagAdded*> at_rest = fresh;
  for (const std::uint32_t number : moved_) at_rest.erase(number);
  const auto place = [&](std::uint32_t number, Time since) {
    return TagPosition{since, tags_.id(number), tags_.position(number)};
  };
  for (const auto& [number, tag] : at_rest) {
    delivery_.add(step.stamp, place(number, tag->since), tag->label);
  }
  for (const std::uint32_t number : moved_) {
    const auto found = fresh.find(number);
    const bool is_new = found != fresh.end();
    delivery_.add(step.stamp, place(number, step.stamp),
                  is_new ? std::optional(found->second->label) : std::nullopt);
  }
  if (!step.removed.empty() || !step.added.empty() || !moved_.empty()) {
    delivery_.add_placed(step.stamp);
  }
  for (const AntennaPose& robot : step.robots) delivery_.add_robot(robot);
}

/// Takes the replies of an antenna's update at `stamp`.
void RfidField::Impl::take_over(const std::shared_ptr<const FieldAntenna>& antenna, Time stamp) {
  const bool all_now = std::all_of(replies_.begin(), replies_.end(),
                                   [&](const TagReply& reply) { return reply.stamp == stamp; });
  if (all_now) {
    delivery_.add(antenna, stamp, tags_, replies_);
    return;
  }
  for (const TagReply& reply : replies_) {
    delivery_.add(to_read(antenna->parameters, tags_.id(reply.slot), reply), reply.distance_m);
  }
}

void RfidField::Impl::update(const AntennaDue& due, Time stamp) {
  const AntennaParameters& parameters = due.antenna->parameters;
  const std::shared_ptr<const AntennaInfo>& antenna = info(due.antenna);
  if (!is_finite(due.X_WA)) return;
  if (meets_world(parameters)) {
    air_.update(parameters.name, due.X_WA, stamp, tags_, replies_);
    if (due.is_last) air_.expect_no_more_of(parameters.name);
    take_over(due.antenna, stamp);
  } else {
    delivery_.add(due.antenna, stamp, tags_, due.X_WA.translation);
  }
  delivery_.add(antenna, stamp, due.X_WA, due.X_PA);
}

void RfidField::Impl::step(const FieldStep& step) {
  if (!step.due.empty() && updated_ && step.stamp < *updated_) begin_anew();
  for (const std::string& antenna : step.antennas_removed) remove_antenna(antenna);
  if (step.world) set_world(*step.world);
  for (const auto& antenna : step.antennas_added) add_antenna(antenna);
  for (const std::uint32_t number : step.removed) remove(number, step.stamp);
  for (const TagAdded& tag : step.added) add(tag);
  move(step.moved);
  if (!step.due.empty()) {
    air_.see(step.bodies ? *step.bodies : std::vector<MovingBody>{}, step.stamp);
  }
  tell_places(step);
  if (!step.due.empty()) updated_ = step.stamp;
  for (const AntennaDue& due : step.due) {
    if (meets_world(due.antenna->parameters)) air_.expect(due.antenna->parameters.name, due.X_WA);
  }
  for (const AntennaDue& due : step.due) update(due, step.stamp);
  delivery_.tell(std::min(step.stamp, air_.complete_until()));
}

RfidField::RfidField(Outlets outlets, std::shared_ptr<const RadioWorld> world, int threads)
    : impl_(std::make_unique<Impl>(std::move(outlets), std::move(world), threads)) {}
RfidField::~RfidField() = default;
RfidField::RfidField(RfidField&&) noexcept = default;
RfidField& RfidField::operator=(RfidField&&) noexcept = default;

void RfidField::step(const FieldStep& step) { impl_->step(step); }

void RfidField::finish() { impl_->finish(); }

std::vector<TagRead> RfidField::held_reads(const std::string& reader) const {
  return impl_->held_reads(reader);
}

std::vector<std::string> RfidField::take_warnings() { return impl_->take_warnings(); }

std::int64_t RfidField::reads() const { return impl_->reads(); }

}  // namespace tagfield
