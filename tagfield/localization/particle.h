/// @file
/// Particles that stand for the places where a tag may be: spread over all the area in reach, then
/// drawn ever more by the likelihood of the wrapped phases, whose offsets are eliminated.
/// docs/methods.md has the equations and the figures.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/method_settings.h"

namespace tagfield {

/// "particle": all tags, one by one. Throws Error on options out of their range.
Method particle_method(const ParticleOptions& options);

}  // namespace tagfield
