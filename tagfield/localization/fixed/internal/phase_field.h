// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the phases of antennas at rest say of places, and how far they can be trusted.
#pragma once

#include "tagfield/localization/fixed/internal/fixed_scene.h"

namespace tagfield {

/// The likeliest field of reflections, by a few tags and where strengths put them.
PhaseField likeliest_field(const FixedScene& scene, const LocalizationProblem& problem,
                           const FixedOptions& options, int threads);

/// Of a tag's place, by strengths that go by `law` and by phases, trusted as far as `trust` says;
/// all but that must outlive it.
LogDensity density_of(const FixedScene& scene, const FixedTag& tag, const StrengthLaw& law,
                      double trust, const FixedOptions& options);

/// How far the phases' distances can be trusted: the exponent of their likelihoods under which
/// those of several antennas, which say more than a place has coordinates, agree best with one
/// another and with the strengths. Reflections that are no diffuse field leave less than 1.
double trust_of(const FixedScene& scene, const LocalizationProblem& problem,
                const FixedOptions& options, int threads);

}  // namespace tagfield
