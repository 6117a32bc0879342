// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/rfid_field.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "tagfield/base/test/error_text.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace {

/// Records all notifications.
struct Log final : ReadListener, TruthListener {
  std::vector<std::string> events;
  std::map<std::string, std::vector<TagRead>> reads;  ///< Of the last update, by antenna.
  std::vector<TagRead> all;                           ///< All reads, in order of arrival.
  std::map<std::string, Eigen::Vector3d> places;
  std::map<std::string, std::string> labels;

  void on_read(const TagRead& read) override {
    fresh_[read.antenna].push_back(read);
    all.push_back(read);
  }
  void on_update(const AntennaInfo& antenna, Time) override {
    events.push_back("updated " + antenna.name);
    reads[antenna.name] = std::exchange(fresh_[antenna.name], {});
  }
  void on_antenna_added(const AntennaInfo& antenna) override {
    events.push_back("added " + antenna.name);
  }
  void on_antenna_removed(const std::string& name) override { events.push_back("removed " + name); }
  void on_restart() override { events.emplace_back("restarted"); }
  void on_tag_added(const TagPosition& tag, const std::string& label) override {
    events.push_back("came " + tag.tag);
    places[tag.tag] = tag.p_WT;
    labels[tag.tag] = label;
  }
  void on_tag_moved(const TagPosition& tag) override {
    events.push_back("moved " + tag.tag);
    places[tag.tag] = tag.p_WT;
  }
  void on_tag_removed(const std::string& id) override { places.erase(id); }

 private:
  std::map<std::string, std::vector<TagRead>> fresh_;
};

/// A field with a log, and antennas that are added when they are first due.
struct LoggedField {
  std::shared_ptr<Log> log = std::make_shared<Log>();
  std::set<std::string> known;
  RfidField field;

  LoggedField() : field(outlets_of(log)) {}
  static Outlets outlets_of(const std::shared_ptr<Log>& log) {
    Outlets outlets;
    attach(log, outlets);
    return outlets;
  }
  void step(FieldStep step) {
    for (const AntennaDue& due : step.due) {
      if (known.insert(due.antenna->parameters.name).second) {
        step.antennas_added.push_back(due.antenna);
      }
    }
    field.step(step);
  }
};

AntennaDue antenna_at(const Eigen::Vector3d& p_WA, const std::string& name = "gate") {
  auto antenna = std::make_shared<FieldAntenna>();
  antenna->parameters.name = name;
  antenna->seed = 5;
  return {antenna, from_translation(p_WA), std::nullopt};
}

RigidTransform at_place(double x, double y, double z) { return from_translation({x, y, z}); }

FieldStep step_at(double seconds) {
  FieldStep step;
  step.stamp = time_from_seconds(seconds);
  return step;
}

TEST(RfidField, TellsChangesBeforeUpdates) {
  LoggedField field;
  Log& log = *field.log;
  FieldStep step = step_at(0.1);
  step.added = {{0, "A", "shelf::a", at_place(1.0, 0.0, 0.0)},
                {1, "B", "shelf::b", at_place(2.0, 0.0, 0.0)}};
  step.moved = {{1, at_place(3.0, 0.0, 0.0)}};
  step.due = {antenna_at({0.0, 0.0, 0.0})};
  step.antennas_removed = {"old"};
  field.step(step);
  EXPECT_EQ(log.events, (std::vector<std::string>{"removed old", "added gate", "came A", "came B",
                                                  "updated gate"}));
  EXPECT_EQ(log.labels.at("A"), "shelf::a");
  EXPECT_EQ(log.places.at("B"), Eigen::Vector3d(3.0, 0.0, 0.0));
  ASSERT_EQ(log.reads.at("gate").size(), 2U);
}

TEST(RfidField, ReadsAsReadTagDoes) {
  LoggedField field;
  Log& log = *field.log;
  FieldStep step = step_at(0.25);
  step.added = {{0, "A", "a", at_place(1.0, 2.0, 2.0)}};
  const AntennaDue due = antenna_at({0.0, 0.0, 0.0});
  step.due = {due};
  field.step(step);
  const TagRead expected = read_tag(due.antenna->parameters, "A", {3.0}, step.stamp, 5);
  ASSERT_EQ(log.reads.at("gate").size(), 1U);
  EXPECT_EQ(log.reads.at("gate")[0].phase_rad, expected.phase_rad);
  EXPECT_EQ(log.reads.at("gate")[0].rssi_dbm, expected.rssi_dbm);
}

TEST(RfidField, LeavesOutWhatIsNowhere) {
  LoggedField field;
  Log& log = *field.log;
  FieldStep step = step_at(0.1);
  step.added = {{0, "A", "a", at_place(1.0, 0.0, 0.0)}};
  step.moved = {{0, at_place(std::nan(""), 0.0, 0.0)}};
  step.due = {antenna_at({std::nan(""), 0.0, 0.0}, "lost"), antenna_at({0.0, 0.0, 0.0})};
  field.step(step);
  EXPECT_EQ(log.events,
            (std::vector<std::string>{"added lost", "added gate", "came A", "updated gate"}));
  EXPECT_EQ(log.reads.at("gate").size(), 1U);
}

TEST(RfidField, RefusesTagsThatAreThereOrNot) {
  LoggedField field;
  FieldStep step = step_at(0.1);
  step.added = {{0, "A", "a", at_place(1.0, 0.0, 0.0)}};
  field.step(step);
  FieldStep again = step_at(0.2);
  again.added = {{1, "A", "a", at_place(1.0, 0.0, 0.0)}};
  EXPECT_TRUE(contains(error_of([&] { field.field.step(again); }), "'A'"));
  again.added = {{0, "B", "b", at_place(1.0, 0.0, 0.0)}};
  EXPECT_TRUE(contains(error_of([&] { field.field.step(again); }), "number 0"));
  FieldStep gone = step_at(0.3);
  gone.removed = {7};
  EXPECT_TRUE(contains(error_of([&] { field.field.step(gone); }), "number 7"));
}

/// A hall with one metal wall at x = 2 m.
std::shared_ptr<const FieldWorld> walled_world() {
  auto world = std::make_shared<FieldWorld>();
  world->scene.collisions = {{"wall::link::box", Box{{0.1, 20.0, 20.0}}, at_place(2.0, 0.0, 0.0)}};
  world->materials.rules = {{"wall", find_material(known_materials(), "metal"), {}}};
  return world;
}

AntennaDue physical_antenna(const std::string& name, const std::vector<RawParameter>& settings) {
  Diagnostics diagnostics;
  auto antenna = std::make_shared<FieldAntenna>();
  antenna->parameters.name = name;
  antenna->parameters.model =
      radio_model_from(PropagationModel::kLinkBudget, settings, {}, diagnostics);
  antenna->seed = 5;
  return {antenna, at_place(0.0, 0.0, 0.0), std::nullopt};
}

TEST(RfidField, LetsWavesMeetTheWorld) {
  LoggedField field;
  Log& log = *field.log;
  FieldStep step = step_at(0.0);
  step.due = {physical_antenna("gate", {})};
  step.added = {{0, "near", "", at_place(1.5, 0.0, 0.0)},
                {1, "behind", "", at_place(3.0, 0.0, 0.0)}};
  field.step(step);
  EXPECT_EQ(log.reads.at("gate").size(), 2U);
  FieldStep walled = step_at(0.1);
  walled.due = step.due;
  walled.world = walled_world();
  field.step(walled);
  ASSERT_EQ(log.reads.at("gate").size(), 1U);
  EXPECT_EQ(log.reads.at("gate")[0].tag, "near");
  EXPECT_TRUE(field.field.take_warnings().empty());
}

TEST(RfidField, KeepsTheWorldWhereTheNextIsBroken) {
  LoggedField field;
  FieldStep step = step_at(0.0);
  auto broken = std::make_shared<FieldWorld>();
  broken->scene.collisions = {{"wall::link::box", Box{{1.0, 1.0, 1.0}}, at_place(1e12, 0.0, 0.0)}};
  step.world = broken;
  field.step(step);
  const std::vector<std::string> warnings = field.field.take_warnings();
  ASSERT_FALSE(warnings.empty());
  EXPECT_TRUE(contains(warnings.back(), "wall::link::box"));
  EXPECT_TRUE(field.field.take_warnings().empty());
}

/// Two seconds of inventory among three tags, starting at 0; the reads of all updates.
std::vector<TagRead> inventory_run(LoggedField& field, const AntennaDue& antenna) {
  const std::size_t before = field.log->all.size();
  for (int n = 0; n <= 30; ++n) {
    FieldStep step = step_at(n / 15.0);
    step.due = {antenna};
    for (std::uint32_t number = 0; number < 3; ++number) {
      step.moved.push_back({number, at_place(1.0 + number, 0.01 * n, 0.0)});
    }
    field.step(step);
  }
  field.field.finish();
  const auto begin = field.log->all.begin() + static_cast<std::ptrdiff_t>(before);
  return {begin, field.log->all.end()};
}

TEST(RfidField, ReadsTheSameAgainWhenTimeBeginsAnew) {
  LoggedField field;
  const AntennaDue antenna =
      physical_antenna("gate", {{"inventory", "gen2", {}}, {"target", "alternate", {}}});
  FieldStep begin = step_at(0.0);
  begin.added = {{0, "a", "", at_place(1, 0, 0)},
                 {1, "b", "", at_place(2, 0, 0)},
                 {2, "c", "", at_place(3, 0, 0)}};
  field.step(begin);
  const std::vector<TagRead> first = inventory_run(field, antenna);
  const std::vector<TagRead> second = inventory_run(field, antenna);
  ASSERT_GT(first.size(), 30U);
  ASSERT_EQ(second.size(), first.size());
  bool between_updates = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(second[i].stamp, first[i].stamp);
    EXPECT_EQ(second[i].phase_rad, first[i].phase_rad);
    EXPECT_TRUE(first[i].doppler_hz);
    between_updates = between_updates ||
                      first[i].stamp != update_stamp(antenna.antenna->parameters,
                                                     first_update_at(antenna.antenna->parameters,
                                                                     first[i].stamp));
  }
  EXPECT_TRUE(between_updates);
}

// Any sequence of tags that appear, disappear and move: the antenna, whose range is not perturbed
// here beyond the tags' distances, reads exactly the set held by a plain map.
RC_GTEST_PROP(RfidField, ReadsExactlyTheTagsThatAreThere, ()) {
  LoggedField field;
  Log& log = *field.log;
  std::map<std::uint32_t, std::string> present;
  int made = 0;
  for (int n = 1; n <= 20; ++n) {
    FieldStep step = step_at(n * 0.1);
    for (std::uint32_t number = 0; number < 12; ++number) {
      const int what = *rc::gen::inRange(0, 4);
      const RigidTransform place = at_place(0.1 * number, 0.1 * n, 0.0);
      if (what == 0 && present.count(number) != 0) {
        step.removed.push_back(number);
        present.erase(number);
      }
      if (what <= 1 && present.count(number) == 0) {  // A number may be removed and added in one
                                                      // step.
        present[number] = "tag" + std::to_string(made++);
        step.added.push_back({number, present[number], "", place});
      } else if (what == 2 && present.count(number) != 0) {
        step.moved.push_back({number, place});
      }
    }
    step.due = {antenna_at({0.0, 0.0, 0.0})};
    field.step(step);
    std::set<std::string> expected;
    for (const auto& [number, id] : present) expected.insert(id);
    std::set<std::string> read;
    for (const TagRead& one : log.reads["gate"]) read.insert(one.tag);
    RC_ASSERT(read == expected);
    RC_ASSERT(log.places.size() == expected.size());
  }
}

}  // namespace
}  // namespace tagfield
