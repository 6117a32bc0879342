/// @file
/// sdformat's complaints, sorted into errors and warnings.
#pragma once

#include <sdf/Error.hh>
#include <sdf/Root.hh>
#include <string>

#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// sdformat's message on one line, without a full stop.
std::string plain_words(std::string message);
std::string plain_words(const sdf::Error& error);

/// Where `error` says it is: at least the world file.
Location location_of_error(const Context& context, const sdf::Error& error);

/// Throws Error if one of `errors` is about a frame that nobody knows and that a model, link,
/// collision or frame refers to. (Joints may: they are not used.)
void require_known_frames(const Context& context, const sdf::Root& root, const sdf::Errors& errors);

/// A warning for each of `errors`, apart from those that only follow from others. Sets the
/// context's frame_trouble if there is some.
void warn_of(Context& context, const sdf::Errors& errors);

}  // namespace tagfield::sdf_internal
