/// @file
/// A field of tags and antennas that a driver moves in steps: what the antennas read is told to
/// whoever listens.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/field/field_step.h"
#include "tagfield/field/radio_air.h"
#include "tagfield/field/tag_population.h"
#include "tagfield/field/telling.h"

namespace tagfield {

/// Takes the steps of a driver, which may be a clock with robots, another simulator, or a
/// recording. Antennas must be added before they update; when time goes back all begin anew. Not
/// thread-safe.
class RfidField {
 public:
  /// `world`: as waves see it at first; empty space where it is null.
  explicit RfidField(Outlets outlets, std::shared_ptr<const RadioWorld> world = nullptr);

  /// Applies the step and tells the listeners. Poses that are not finite are left out: a tag stays
  /// where it was, an antenna skips its update. Throws Error on a tag ID that is present already,
  /// and on a tag's number or an antenna's name that is not.
  void step(const FieldStep& step);
  /// Tells what was kept back because something earlier could still have come.
  void finish();

  /// What was odd since the last call, each only once: guessed materials, a world that can't be
  /// made ready for waves, which then stays the one before.
  std::vector<std::string> take_warnings();

  /// Made so far.
  [[nodiscard]] std::int64_t reads() const { return reads_; }

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
  void update(const AntennaDue& due, Time stamp);

  Telling telling_;
  TagPopulation tags_;             ///< Slots are the driver's numbers.
  std::vector<Antenna> antennas_;  ///< As they came.
  std::shared_ptr<const RadioWorld> world_;
  RadioAir air_;
  std::optional<Time> updated_;  ///< Stamp of the last step in which antennas were due.
  Diagnostics diagnostics_;
  std::size_t warnings_taken_ = 0;
  std::vector<std::uint32_t> moved_;  ///< Numbers; kept to save allocations.
  std::vector<TagReply> replies_;     ///< Likewise.
  std::int64_t reads_ = 0;
};

}  // namespace tagfield
