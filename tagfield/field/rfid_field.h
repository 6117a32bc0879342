/// @file
/// A field of tags and antennas that another simulator moves: it says in steps what changed, and
/// what the antennas read comes out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/channel/radio_world.h"
#include "tagfield/field/radio_air.h"
#include "tagfield/field/tag_population.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// What belongs to one antenna as long as it lives.
struct FieldAntenna {
  AntennaParameters parameters;
  std::uint64_t seed = 1;
  std::string sensor;        ///< Name of the sensor that it is.
  std::string name_space;    ///< Of its topics; "" for none.
  std::string frame_id;      ///< Of the antenna.
  std::string parent_frame;  ///< Of what carries it; "" where that is not told.
};

/// A tag that appears. Numbers are the other simulator's; one may be used again after its tag went.
struct TagAdded {
  std::uint32_t number = 0;
  std::string id;     ///< Unique among the tags present.
  std::string label;  ///< What the other simulator calls it.
  RigidTransform X_WT;
  std::shared_ptr<const TagModel> model{};  ///< Its kind; default_tag_model() where it is null.
};

struct TagMoved {
  std::uint32_t number = 0;
  RigidTransform X_WT;
};

/// What stands in the other simulator's world, for physical models.
struct FieldWorld {
  Scene scene;
  RadioWorldOptions materials;
};

/// An antenna to be updated.
struct AntennaDue {
  std::shared_ptr<const FieldAntenna> antenna;
  RigidTransform X_WA;
  std::optional<RigidTransform> X_PA;  ///< In its parent frame, where it has one.
};

/// What happened up to `stamp`: first antennas and tags went, then the world changed, then antennas
/// and tags came, then tags moved, and then antennas update.
struct FieldStep {
  Time stamp;
  std::vector<std::uint32_t> removed;
  std::vector<TagAdded> added;
  std::vector<TagMoved> moved;
  std::vector<AntennaDue> due;
  std::vector<std::string> antennas_removed;  ///< Names.
  std::vector<std::shared_ptr<const FieldAntenna>> antennas_added;
  std::shared_ptr<const FieldWorld> world;  ///< Null where it is the one before; at first empty.
};

/// All tags present, with their labels by slot.
struct FieldTags {
  explicit FieldTags(double cell_m) : population(cell_m) {}
  TagPopulation population;
  std::vector<std::string> labels;
};

/// One antenna's update. References hold during the call only.
struct AntennaUpdate {
  Time stamp;
  const FieldAntenna& antenna;
  const RigidTransform& X_WA;
  const std::optional<RigidTransform>& X_PA;
  const std::vector<TagReply>& replies;
  const FieldTags& tags;
};

/// Who wants to know what comes of it.
class FieldListener {
 public:
  FieldListener() = default;
  virtual ~FieldListener() = default;
  FieldListener(const FieldListener&) = delete;
  FieldListener& operator=(const FieldListener&) = delete;
  /// Tags came or went.
  virtual void tags_changed(Time stamp, const FieldTags& tags) = 0;
  /// Those in `slots` moved.
  virtual void tags_moved(Time stamp, const std::vector<std::uint32_t>& slots,
                          const FieldTags& tags) = 0;
  virtual void antenna_updated(const AntennaUpdate& update) = 0;
  /// An antenna is there, and will be updated.
  virtual void antenna_added(const FieldAntenna& antenna) = 0;
  virtual void antenna_removed(const std::string& antenna) = 0;
};

/// Takes the steps. Antennas of physical models share one air; they must be added before they
/// update, and when time goes back they begin anew. Not thread-safe.
class RfidField {
 public:
  explicit RfidField(std::vector<std::unique_ptr<FieldListener>> listeners);

  /// Applies the step and tells the listeners. Poses that are not finite are left out: a tag stays
  /// where it was, an antenna skips its update. Throws Error on a tag ID that is present already or
  /// a number that is not.
  void step(const FieldStep& step);

  /// What was odd since the last call, each only once: guessed materials, a world that can't be
  /// made ready for waves, which then stays the one before.
  std::vector<std::string> take_warnings();

  /// Made so far.
  [[nodiscard]] std::int64_t reads() const { return reads_; }

 private:
  void add_antenna(const std::shared_ptr<const FieldAntenna>& antenna);
  void remove_antenna(const std::string& antenna);
  void set_world(const FieldWorld& world);
  void begin_anew();
  void remove(std::uint32_t number);
  void add(const TagAdded& tag);
  void move(const std::vector<TagMoved>& moved);
  void update(const AntennaDue& due, Time stamp);
  void read(const AntennaDue& due, Time stamp);
  [[nodiscard]] std::uint32_t slot_of(std::uint32_t number) const;

  std::vector<std::unique_ptr<FieldListener>> listeners_;
  FieldTags tags_;
  std::vector<std::shared_ptr<const FieldAntenna>> physical_;  ///< As they came.
  std::shared_ptr<const RadioWorld> world_;  ///< Made when the first physical antenna comes.
  std::optional<RadioAir> air_;              ///< Likewise.
  std::optional<Time> updated_;              ///< Stamp of the last step in which antennas were due.
  Diagnostics diagnostics_;
  std::size_t warnings_taken_ = 0;
  std::vector<std::optional<std::uint32_t>> slots_;  ///< By number.
  std::vector<std::uint32_t> moved_slots_;           ///< Kept to save allocations.
  std::vector<TagReply> replies_;                    ///< Likewise.
  std::int64_t reads_ = 0;
};

}  // namespace tagfield
