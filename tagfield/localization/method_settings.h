/// @file
/// Settings of the localization methods that have any.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tagfield {

/// "hyperbola": docs/localization.md.
struct HyperbolaOptions {
  double stride_m = 0.3;            ///< Travel of the antenna between two hyperbolae.
  std::size_t max_hyperbolae = 50;  ///< Of one tag; more are thinned out (time grows as n³).
  double max_step = 0.8;            ///< See unwrap().
  bool refine = true;               ///< Finish with Gauss-Newton from the best intersections.
};

/// Of methods that search all the area in reach for bright places.
struct SearchOptions {
  double max_range_m = 12.0;  ///< Half of the reads are from nearer; over 0.
  double cell_m = 0.25;       ///< Of the coarsest grid; over 0.
  std::size_t maxima = 12;    ///< So many are returned at most.
  std::size_t reads = 800;    ///< Coarse levels take so many at most, evenly thinned.
  /// Whole apertures on all of the area at once: some twenty times the work. Reflections bend the
  /// phase over decimetres, so that short apertures are brightest elsewhere.
  bool thorough = false;
};

/// "sar": docs/methods.md, as those below.
struct SarOptions {
  SearchOptions search;
  double min_share = 0.35;  ///< See CoherentJudgement; in (0, 1].
};

/// "dah".
struct DahOptions {
  SearchOptions search;
  double least_noise_rad = 0.1;  ///< Standard deviation of a phase, if not more is seen; over 0.
  double min_share = 0.5;        ///< See CoherentJudgement; in (0, 1].
};

/// "particle".
struct ParticleOptions {
  std::size_t particles = 3000;  ///< From 100 to 1000000.
  double max_range_m = 12.0;     ///< Half of the reads are from nearer; over 0.
  double max_height_m = 3.0;     ///< Above or below the antennas, where the height is unknown.
  double least_noise_rad = 0.1;  ///< Standard deviation of a phase, if not more is seen; over 0.
  double min_share = 0.5;        ///< See CoherentJudgement; in (0, 1].
  std::uint64_t seed = 1;        ///< Streams are by seed and the tag's ID.
};

/// "trilateration".
struct TrilaterationOptions {
  /// RSSI falls by so many decibels for ten times the distance: 40 there and back in free space.
  double slope_db = 40.0;
  double slope_sigma_db = 8.0;  ///< How uncertain that is before the data are seen; 0: it is known.
  /// How tags of one kind differ [dB]; with reference tags the others' height of the line is theirs
  /// but for this.
  double tag_sigma_db = 2.0;
  double bin_m = 0.2;         ///< Reads over so much travel are averaged; over 0.
  double max_range_m = 12.0;  ///< No tag is read from further away; over 0.
  /// In place of the problem's limits, which are for phase.
  double max_expected_error_m = 3.0;
  double max_misfit_db = 10.0;  ///< A worse rms is no law of distance.
};

/// "landmarc".
struct LandmarcOptions {
  std::size_t neighbours = 4;  ///< k, at least 1.
  double bin_s = 1.0;          ///< RSSI is averaged over so long; over 0.
  /// An antenna that reads one of two tags only is taken to get the weakest RSSI of all from the
  /// other, less this [dB], at least 0.
  double unread_margin_db = 3.0;
  double max_expected_error_m = 5.0;  ///< In place of the problem's limit, which is for phase.
};

/// All of them.
struct MethodSettings {
  HyperbolaOptions hyperbola;
  SarOptions sar;
  DahOptions dah;
  ParticleOptions particle;
  TrilaterationOptions trilateration;
  LandmarcOptions landmarc;
};

}  // namespace tagfield
