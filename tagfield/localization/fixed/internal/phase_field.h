// SPDX-License-Identifier: Apache-2.0
/// @file
/// Position likelihood from the phases of stationary antennas, and how far it can be trusted.
#pragma once

#include "tagfield/localization/fixed/internal/fixed_scene.h"

namespace tagfield {

/// Maximum-likelihood field of reflections, from a few tags at the positions that their RSSI
/// suggests.
PhaseField likeliest_field(const FixedScene& scene, const LocalizationProblem& problem,
                           const FixedOptions& options, int threads);

/// Density of the position of the tag with this index from RSSI, from phases, weighted by `trust`,
/// and from where the other tags are. Scene and options must outlive the result.
LogDensity density_of(const FixedScene& scene, std::size_t number, double trust,
                      const FixedOptions& options);

/// Reliability of the phases' ranges: the exponent of their likelihoods at which the ranges of
/// several antennas, which overdetermine the position, agree best with one another and with the
/// RSSI. Below 1 where reflections are not a diffuse field.
double trust_of(const FixedScene& scene, const LocalizationProblem& problem,
                const FixedOptions& options, int threads);

}  // namespace tagfield
