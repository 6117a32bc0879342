// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/free_space_gains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

/// So many links at a time that all of theirs stays in the nearest cache.
constexpr std::size_t kLinks = 64;
using Lane = std::array<double, kLinks>;
struct Vectors {
  Lane x;
  Lane y;
  Lane z;
};

/// Rotations as unit quaternions.
struct Rotations {
  Lane w;
  Vectors v;
};

/// Of one end of each link, in W: its axes, the way from it, and what it makes of that.
struct EndLanes {
  Rotations R_WE;  ///< What the axes are columns of.
  Vectors boresight;
  Vectors left;
  Vectors up;
  Vectors way;      ///< Unit vectors.
  Vectors way_own;  ///< The same in the end's frame.
  Lane power;       ///< Gain.
  Vectors re;       ///< Of the field's direction.
  Vectors im;
  Lane across;  ///< Length of what of the wires lies across the way.
};

struct Links {
  Lane length;
  Lane re;  ///< Of the gain.
  Lane im;
  EndLanes antenna;
  EndLanes tag;
};

/// The rotations' columns.
void set_axes(std::size_t count, EndLanes& end) {
  const Rotations& R = end.R_WE;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = R.w[i];
    const double x = R.v.x[i];
    const double y = R.v.y[i];
    const double z = R.v.z[i];
    end.boresight.x[i] = 1.0 - 2.0 * (y * y + z * z);
    end.boresight.y[i] = 2.0 * (x * y + w * z);
    end.boresight.z[i] = 2.0 * (x * z - w * y);
    end.left.x[i] = 2.0 * (x * y - w * z);
    end.left.y[i] = 1.0 - 2.0 * (x * x + z * z);
    end.left.z[i] = 2.0 * (y * z + w * x);
    end.up.x[i] = 2.0 * (x * z + w * y);
    end.up.y[i] = 2.0 * (y * z - w * x);
    end.up.z[i] = 1.0 - 2.0 * (x * x + y * y);
  }
}

void set_ways(const Vector3d& p_WA, const Vectors& p_WT, std::size_t count, Links& links) {
  const double from_x = p_WA.x();
  const double from_y = p_WA.y();
  const double from_z = p_WA.z();
  for (std::size_t i = 0; i < count; ++i) {
    const double x = p_WT.x[i] - from_x;
    const double y = p_WT.y[i] - from_y;
    const double z = p_WT.z[i] - from_z;
    const double length = std::sqrt(x * x + y * y + z * z);
    const double inverse = 1.0 / length;
    links.length[i] = length;
    links.antenna.way.x[i] = x * inverse;
    links.antenna.way.y[i] = y * inverse;
    links.antenna.way.z[i] = z * inverse;
    links.tag.way.x[i] = -(x * inverse);
    links.tag.way.y[i] = -(y * inverse);
    links.tag.way.z[i] = -(z * inverse);
  }
}

inline double along(const Vectors& axis, const Vectors& way, std::size_t i) {
  return axis.x[i] * way.x[i] + axis.y[i] * way.y[i] + axis.z[i] * way.z[i];
}

void turn_ways(std::size_t count, EndLanes& end) {
  for (std::size_t i = 0; i < count; ++i) {
    end.way_own.x[i] = along(end.boresight, end.way, i);
    end.way_own.y[i] = along(end.left, end.way, i);
    end.way_own.z[i] = along(end.up, end.way, i);
  }
}

/// What the patterns of patches need, of all directions.
struct PatchLobe {
  double peak;
  double back;
  double exponent;  ///< In the x, y plane,
  double vertical;  ///< in the x, z plane.
};

double lobe_exponent_of(double beam_width_rad) {
  return std::log(0.5) / std::log(std::cos(0.5 * beam_width_rad));
}

void add_patch_gains(const PatchLobe& lobe, std::size_t count, EndLanes& end) {
  for (std::size_t i = 0; i < count; ++i) {
    const double y = end.way_own.y[i] * end.way_own.y[i];
    const double z = end.way_own.z[i] * end.way_own.z[i];
    const double off = y + z;
    const double middle = 0.5 * (lobe.exponent + lobe.vertical);
    const double between = (y * lobe.exponent + z * lobe.vertical) / choose(off > 0.0, off, 1.0);
    const double exponent = choose(off > 0.0, between, middle);
    const double x = end.way_own.x[i];
    const double in_front = lane_exp(exponent * lane_log(choose(x > 1e-300, x, 1e-300)));
    end.power[i] = lobe.peak * choose(in_front > lobe.back, in_front, lobe.back);
  }
}

void add_dipole_gains(double peak, double of_left, double of_up, std::size_t count, EndLanes& end) {
  for (std::size_t i = 0; i < count; ++i) {
    const double cosine = of_left * end.way_own.y[i] + of_up * end.way_own.z[i];
    const double sine_squared = 1.0 - cosine * cosine;
    const double amplitude = lane_sine_cosine(0.5 * kPi * cosine).cosine;
    const double safe = choose(sine_squared > 1e-15, sine_squared, 1.0);
    end.power[i] = choose(sine_squared > 1e-15, peak * (amplitude * amplitude / safe), 0.0);
  }
}

void add_gains(const AntennaPattern& pattern, const ChannelEffects& effects, InstructionSet set,
               std::size_t count, EndLanes& end) {
  const bool is_even = !effects.patterns || pattern.shape == PatternShape::kIsotropic;
  const double peak = peak_gain(pattern);
  if (is_even) {
    std::fill_n(end.power.begin(), count, peak);
  } else if (pattern.shape == PatternShape::kPatch) {
    const PatchLobe lobe{peak, std::exp(-0.1 * std::numbers::ln10 * pattern.front_to_back_db),
                         lobe_exponent_of(pattern.beam_width_rad),
                         lobe_exponent_of(pattern.vertical_beam_width_rad)};
    in_lanes(set, [&] { add_patch_gains(lobe, count, end); });
  } else if (pattern.shape == PatternShape::kDipole) {
    const double of_left = std::sin(pattern.tilt_rad);
    const double of_up = std::cos(pattern.tilt_rad);
    in_lanes(set, [&] { add_dipole_gains(peak, of_left, of_up, count, end); });
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      end.power[i] = gain(pattern, {end.way_own.x[i], end.way_own.y[i], end.way_own.z[i]});
    }
  }
}

/// What of a wire along of_left·left + of_up·up lies across the way, of length 1.
void add_linear_fields(double of_left, double of_up, std::size_t count, EndLanes& end) {
  for (std::size_t i = 0; i < count; ++i) {
    const double part = of_left * end.way_own.y[i] + of_up * end.way_own.z[i];
    const auto across = [&](const Lane& left, const Lane& up, const Lane& way) {
      return (of_left * left[i] + of_up * up[i]) - part * way[i];
    };
    const double x = across(end.left.x, end.up.x, end.way.x);
    const double y = across(end.left.y, end.up.y, end.way.y);
    const double z = across(end.left.z, end.up.z, end.way.z);
    const double length = std::sqrt(x * x + y * y + z * z);
    end.across[i] = length;
    const double inverse = 1.0 / length;
    end.re.x[i] = x * inverse;
    end.re.y[i] = y * inverse;
    end.re.z[i] = z * inverse;
    end.im.x[i] = 0.0;
    end.im.y[i] = 0.0;
    end.im.z[i] = 0.0;
  }
}

/// Of crossed wires along up + j·hand·left.
void add_circular_fields(double hand, std::size_t count, EndLanes& end) {
  for (std::size_t i = 0; i < count; ++i) {
    const double u_y = end.way_own.y[i];
    const double u_z = end.way_own.z[i];
    // Each wire's part across the way has the square 1 − u², of both 2 − u_y² − u_z² ≥ 1.
    const double length = std::sqrt(2.0 - u_y * u_y - u_z * u_z);
    end.across[i] = length;
    const double inverse = 1.0 / length;
    end.re.x[i] = (end.up.x[i] - u_z * end.way.x[i]) * inverse;
    end.re.y[i] = (end.up.y[i] - u_z * end.way.y[i]) * inverse;
    end.re.z[i] = (end.up.z[i] - u_z * end.way.z[i]) * inverse;
    end.im.x[i] = hand * (end.left.x[i] - u_y * end.way.x[i]) * inverse;
    end.im.y[i] = hand * (end.left.y[i] - u_y * end.way.y[i]) * inverse;
    end.im.z[i] = hand * (end.left.z[i] - u_y * end.way.z[i]) * inverse;
  }
}

void add_fields(const AntennaPattern& pattern, std::size_t count, EndLanes& end) {
  const bool is_wire =
      pattern.shape == PatternShape::kDipole || pattern.polarization == PolarizationKind::kLinear;
  if (is_wire) {
    add_linear_fields(std::sin(pattern.tilt_rad), std::cos(pattern.tilt_rad), count, end);
  } else {
    add_circular_fields(pattern.polarization == PolarizationKind::kRightCircular ? 1.0 : -1.0,
                        count, end);
  }
}

/// √(G G')·λ/(4πd)·e^{−jkd} times what the tag takes in of the field.
void add_links(const Carrier& carrier, bool polarization, std::size_t count, Links& links) {
  const EndLanes& a = links.antenna;
  const EndLanes& t = links.tag;
  const double at_a_metre = carrier.lambda_m / (4.0 * kPi);
  const double wave_number = carrier.wave_number;
  for (std::size_t i = 0; i < count; ++i) {
    const double amplitude = std::sqrt(a.power[i] * t.power[i]) * (at_a_metre / links.length[i]);
    const SineCosine phase = lane_sine_cosine(wave_number * links.length[i]);
    links.re[i] = amplitude * phase.cosine;
    links.im[i] = -(amplitude * phase.sine);
  }
  if (!polarization) return;
  for (std::size_t i = 0; i < count; ++i) {
    const double re = along(a.re, t.re, i) - along(a.im, t.im, i);
    const double im = along(a.re, t.im, i) + along(a.im, t.re, i);
    const double both = links.re[i] * re - links.im[i] * im;
    links.im[i] = links.re[i] * im + links.im[i] * re;
    links.re[i] = both;
  }
}

/// Whether the loops' functions hold: neither too far, nor in one place, nor along a wire.
bool holds(const Links& links, const Carrier& carrier, bool polarization, std::size_t i) {
  const double length = links.length[i];
  constexpr double kMostTurn_rad = 1e5;  // of lane_sine_cosine()
  if (!(length > 1e-150 && carrier.wave_number * length <= kMostTurn_rad)) return false;
  return !polarization || (links.antenna.across[i] > 1e-9 && links.tag.across[i] > 1e-9);
}

void add_some(const RadioEnd& antenna, const AntennaPattern& tag,
              std::span<const RigidTransform* const> X_WT, const Carrier& carrier,
              const ChannelEffects& effects, std::span<std::complex<double>> gains,
              InstructionSet set) {
  const std::size_t count = X_WT.size();
  Links links;
  Vectors p_WT;
  const auto fill = [](const Eigen::Quaterniond& q, std::size_t i, Rotations& R) {
    R.w[i] = q.w();
    R.v.x[i] = q.x();
    R.v.y[i] = q.y();
    R.v.z[i] = q.z();
  };
  for (std::size_t i = 0; i < count; ++i) {
    fill(antenna.X_WA.rotation, i, links.antenna.R_WE);
    fill(X_WT[i]->rotation, i, links.tag.R_WE);
    p_WT.x[i] = X_WT[i]->translation.x();
    p_WT.y[i] = X_WT[i]->translation.y();
    p_WT.z[i] = X_WT[i]->translation.z();
  }
  in_lanes(set, [&] {
    set_axes(count, links.antenna);
    set_axes(count, links.tag);
    set_ways(antenna.X_WA.translation, p_WT, count, links);
    turn_ways(count, links.antenna);
    turn_ways(count, links.tag);
  });
  add_gains(antenna.pattern, effects, set, count, links.antenna);
  add_gains(tag, effects, set, count, links.tag);
  in_lanes(set, [&] {
    if (effects.polarization) {
      add_fields(antenna.pattern, count, links.antenna);
      add_fields(tag, count, links.tag);
    }
    add_links(carrier, effects.polarization, count, links);
  });
  for (std::size_t i = 0; i < count; ++i) {
    gains[i] = holds(links, carrier, effects.polarization, i)
                   ? std::complex<double>(links.re[i], links.im[i])
                   : free_space_gain(antenna, {tag, *X_WT[i]}, carrier, effects);
  }
}

}  // namespace

void free_space_gains(const RadioEnd& antenna, const AntennaPattern& tag,
                      std::span<const RigidTransform* const> X_WT, const Carrier& carrier,
                      const ChannelEffects& effects, std::span<std::complex<double>> gains,
                      InstructionSet set) {
  for (std::size_t begin = 0; begin < X_WT.size(); begin += kLinks) {
    const std::size_t count = std::min(kLinks, X_WT.size() - begin);
    add_some(antenna, tag, X_WT.subspan(begin, count), carrier, effects,
             gains.subspan(begin, count), set);
  }
}

}  // namespace tagfield
